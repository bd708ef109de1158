#include "engine/mesh/doctor/mended_surface.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/text.h"
#include "engine/mesh/flat_triangles.h"

namespace spia {

void mend_flat_triangles(MendedSurface& s, const Tally& dropped, DoctorReport& report)
{
    Tally flat;
    std::vector<int> all_flat;
    for (size_t f = 0; f < s.triangle.size(); ++f)
        if (is_flat(s.triangle[f], s.soup.position)) {
            flat.add(s.number[f]);
            all_flat.push_back(int(f));
        }
    if (flat.count + dropped.count == 0)
        return;
    const int first = flat.count == 0      ? dropped.first
                      : dropped.count == 0 ? flat.first
                                           : std::min(flat.first, dropped.first);
    FlatRepair repair;
    if (s.two_faces_per_edge && s.two_sided) {
        repair = repair_flat_triangles(s.triangle, s.soup.position);
    } else { // without a proper surface around them they stay
        repair.removed.assign(s.triangle.size(), 0);
        repair.left = all_flat;
    }
    const int mended = flat.count + dropped.count - int(repair.left.size());
    if (mended > 0) {
        Tally gone;
        for (const int number : dropped.where)
            gone.add(number);
        for (const int f : all_flat)
            if (std::find(repair.left.begin(), repair.left.end(), f) == repair.left.end())
                gone.add(s.number[size_t(f)]);
        gone.count = mended;
        gone.first = first;
        report.add(
            Fault::flat_face, Severity::repaired, gone,
            fmt::format(
                "{} no area (first: face {}): {} removed by merging two vertices, {} by flipping the longest edge, {} left out at the boundary or where the edge had other faces",
                counted(mended, "triangle had", "triangles had"), first, repair.joined, repair.flipped,
                repair.dropped + dropped.count),
            "");
    }
    // Beside a small hole in long sheet they can be right, and all that is flat there is needles:
    // of a hole of 3 mm in a profile of 6 m. They stay, as slivers.
    constexpr double nothing = 1e-10; // of the longest edge: rounding in double precision
    std::erase_if(repair.left, [&](int f) { return !is_flat(s.triangle[size_t(f)], s.soup.position, nothing); });
    if (!repair.left.empty()) {
        const Triangle& t = s.triangle[size_t(repair.left[0])];
        const int number = s.number[size_t(repair.left[0])];
        Tally left;
        for (const int f : repair.left)
            left.add(s.number[size_t(f)]);
        report.add(
            Fault::flat_face, Severity::fatal, left,
            fmt::format("{} no area and cannot be taken out without tearing the surface (first: face {} with the "
                        "vertices {}, {}, {})",
                        counted(repair.left.size(), "triangle has", "triangles have"), number, t[0], t[1], t[2]),
            "remesh the part there");
    }
    remove(s, repair.removed);
}

} // namespace spia

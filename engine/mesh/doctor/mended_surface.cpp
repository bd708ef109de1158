#include "engine/mesh/doctor/mended_surface.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/text.h"
#include "engine/mesh/doctor/largest_piece.h"
#include "engine/mesh/flat_triangles.h"

namespace spia {

Tally remove(MendedSurface& s, const std::vector<char>& marked)
{
    Tally removed;
    size_t kept = 0;
    for (size_t f = 0; f < s.triangle.size(); ++f) {
        if (marked[f]) {
            removed.add(s.number[f]);
            continue;
        }
        s.triangle[kept] = s.triangle[f];
        s.number[kept] = s.number[f];
        if (!s.piece.empty())
            s.piece[kept] = s.piece[f];
        ++kept;
    }
    s.triangle.resize(kept);
    s.number.resize(kept);
    if (!s.piece.empty())
        s.piece.resize(kept);
    return removed;
}

Tally drop_flat_at_crowded_edges(MendedSurface& s)
{
    enum : char { crowds = 1, holds = 2 };
    std::vector<char> mark(s.triangle.size(), 0);
    const auto uses = edge_uses(s.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        for (size_t i = begin; end - begin > 1 && i < end; ++i)
            mark[size_t(uses[i].face)] |= end - begin > 2 ? crowds : holds;
    });
    for (size_t f = 0; f < mark.size(); ++f)
        mark[f] = mark[f] == crowds && is_flat(s.triangle[f], s.soup.position);
    return remove(s, mark);
}

void keep_largest(MendedSurface& s, DoctorReport& report)
{
    const Pieces pieces = smooth_pieces(s.triangle, s.soup.position);
    if (pieces.count < 2)
        return;
    std::vector<char> other(s.triangle.size());
    for (size_t f = 0; f < other.size(); ++f)
        other[f] = pieces.of[f] != pieces.largest;
    const Tally removed = remove(s, other);
    report.add(
        Fault::several_components, Severity::repaired, removed,
        fmt::format(
            "the part had {} pieces, separate or connected at edges of three faces; the largest was kept, {} left out (first: face {})",
            pieces.count, counted(removed.count, "triangle was", "triangles were"), removed.first),
        "");
}

} // namespace spia

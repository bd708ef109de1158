#include "engine/exchange/iga/write_geopdes.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/exchange/iga/iga_patches.h"

namespace spia {
namespace {

std::string numbered(PatchSide side)
{
    const int number = side.side == Side::u0 ? 1 : side.side == Side::u1 ? 2 : side.side == Side::v0 ? 3 : 4;
    return fmt::format("{} {}\n", side.patch + 1, number);
}

} // namespace

void write_geopdes(const std::filesystem::path& path, const MultiPatch& patches_mm, std::string_view name,
                   LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    std::string text = "# nurbs mesh v.2.1\n# " + head_line(name, "surface", unit) + "\n";
    auto end = std::back_inserter(text);
    constexpr int parameters = 2, space = 3, subdomains = 0;
    fmt::format_to(end, "{} {} {} {} {}\n", parameters, space, patches.patch.size(), patches.interfaces.size(),
                   subdomains);
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        const NurbsSurface& patch = patches.patch[p];
        fmt::format_to(end, "PATCH {}\n{} {}\n{} {}\n{}\n{}\n", p + 1, patch.degree_u, patch.degree_v, patch.count_u,
                       patch.count_v, row_of(patch.knots_u), row_of(patch.knots_v));
        for (int k = 0; k < space; ++k)
            text += row_of(Eigen::VectorXd(patch.control.row(k).transpose().cwiseProduct(patch.weight))) + "\n";
        text += row_of(patch.weight) + "\n";
    }
    for (size_t i = 0; i < patches.interfaces.size(); ++i) {
        const PatchInterface& joint = patches.interfaces[i];
        fmt::format_to(end, "INTERFACE {}\n{}{}{}\n", i + 1, numbered(joint.first), numbered(joint.second),
                       joint.reversed ? -1 : 1);
    }
    int boundary = 0;
    for (const PatchSide& side : outer_sides(patches))
        fmt::format_to(end, "BOUNDARY {}\n1\n{}", ++boundary, numbered(side));
    write_atomically(path, text);
}

} // namespace spia

#include "engine/exchange/iga/write_mfem.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/exchange/iga/iga_patches.h"
#include "engine/exchange/iga/mfem_topology.h"

namespace spia {
namespace {

std::string topology_text(const MultiPatch& patches)
{
    constexpr int segment = 1, square = 3;
    const MfemTopology topology = mfem_topology(patches);
    std::string text = fmt::format("dimension\n2\n\nelements\n{}\n", patches.patch.size());
    auto end = std::back_inserter(text);
    for (size_t p = 0; p < topology.corner.size(); ++p)
        fmt::format_to(end, "{} {} {}\n", p + 1, square, fmt::join(topology.corner[p], " "));
    const std::vector<PatchSide> outer = outer_sides(patches);
    fmt::format_to(end, "\nboundary\n{}\n", outer.size());
    for (size_t i = 0; i < outer.size(); ++i) { // counter-clockwise, as the faces of the elements
                                                // run
        const std::array<int, 4>& corner = topology.corner[size_t(outer[i].patch)];
        const size_t side = size_t(outer[i].side);
        fmt::format_to(end, "{} {} {} {}\n", i + 1, segment, corner[side], corner[(side + 1) % 4]);
    }
    fmt::format_to(end, "\nedges\n{}\n", topology.edges.size());
    for (const MfemTopology::Edge& edge : topology.edges)
        fmt::format_to(end, "{} {} {}\n", edge.knots, edge.from, edge.to);
    fmt::format_to(end, "\nvertices\n{}\n", topology.corners);
    return text;
}

std::string patch_text(const NurbsSurface& patch)
{
    std::string text =
        fmt::format("\nknotvectors\n2\n{} {} {}\n{} {} {}\n\ndimension\n3\n\ncontrolpoints_cartesian\n", patch.degree_u,
                    patch.count_u, row_of(patch.knots_u), patch.degree_v, patch.count_v, row_of(patch.knots_v));
    for (Eigen::Index c = 0; c < patch.control.cols(); ++c) {
        Eigen::Vector4d point;
        point << patch.control.col(c), patch.weight[c];
        text += row_of(point) + "\n";
    }
    return text;
}

} // namespace

void write_mfem(const std::filesystem::path& path, const MultiPatch& patches_mm, std::string_view name, LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    std::string text = "MFEM NURBS mesh v1.0\n\n# " + head_line(name, "surface", unit) + "\n\n" +
                       topology_text(patches) + "\npatches\n";
    for (const NurbsSurface& patch : patches.patch)
        text += patch_text(patch);
    write_atomically(path, text);
}

void write_mfem_field(const std::filesystem::path& path, const MultiPatch& patches_mm, const PatchField& field_mm,
                      std::string_view name, LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    const PatchField field = field_in(unit, patches, field_mm);
    mfem_topology(patches); // no field without its mesh
    std::string text = "FiniteElementSpace\nFiniteElementCollection: NURBS\nVDim: 1\nOrdering: 0\n\n# " +
                       head_line(name, field.name + " on the surface, unit " + field.unit, unit) + "\nNURBS_patches\n";
    for (size_t p = 0; p < field.value.size(); ++p) {
        fmt::format_to(std::back_inserter(text), "\n# patch {}\n\n", p);
        for (const double value : field.value[p])
            fmt::format_to(std::back_inserter(text), "{}\n", value + 0.0);
    }
    write_atomically(path, text);
}

} // namespace spia

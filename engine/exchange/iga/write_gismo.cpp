#include "engine/exchange/iga/write_gismo.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/exchange/iga/iga_patches.h"

namespace spia {
namespace {

int side_number(Side side) { return side == Side::u0 ? 1 : side == Side::u1 ? 2 : side == Side::v0 ? 3 : 4; }

/// The direction across a side: 0 for u, 1 for v.
int across(Side side) { return side == Side::u0 || side == Side::u1 ? 0 : 1; }

bool at_end(Side side) { return side == Side::u1 || side == Side::v1; }

std::string tensor_basis(const NurbsSurface& patch)
{
    return fmt::format(R"(   <Basis type="TensorBSplineBasis2">
    <Basis type="BSplineBasis" index="0"><KnotVector degree="{}">{}</KnotVector></Basis>
    <Basis type="BSplineBasis" index="1"><KnotVector degree="{}">{}</KnotVector></Basis>
   </Basis>
)",
                       patch.degree_u, row_of(patch.knots_u), patch.degree_v, row_of(patch.knots_v));
}

/// @param coefficients one column per control point
std::string geometry(int id, const NurbsSurface& patch, const Eigen::MatrixXd& coefficients)
{
    const bool rational = is_rational(patch);
    std::string text =
        fmt::format(" <Geometry type=\"{}\" id=\"{}\">\n", rational ? "TensorNurbs2" : "TensorBSpline2", id);
    if (rational)
        text += "  <Basis type=\"TensorNurbsBasis2\">\n" + tensor_basis(patch) + "   <weights>" + row_of(patch.weight) +
                "</weights>\n  </Basis>\n";
    else
        text += tensor_basis(patch);
    text += fmt::format("  <coefs geoDim=\"{}\">\n", coefficients.rows());
    for (Eigen::Index c = 0; c < coefficients.cols(); ++c)
        text += row_of(coefficients.col(c)) + "\n";
    return text + "  </coefs>\n </Geometry>\n";
}

std::string topology(const MultiPatch& patches)
{
    std::string text =
        fmt::format(" <MultiPatch parDim=\"2\" id=\"{}\">\n  <patches type=\"id_range\">0 {}</patches>\n",
                    patches.patch.size(), patches.patch.size() - 1);
    auto end = std::back_inserter(text);
    if (!patches.interfaces.empty()) {
        text += "  <interfaces>\n";
        for (const PatchInterface& joint : patches.interfaces) {
            const Side first = joint.first.side, second = joint.second.side;
            int to[2], same[2];
            to[across(first)] = across(second);
            to[1 - across(first)] = 1 - across(second);
            same[across(first)] = at_end(first) != at_end(second);
            same[1 - across(first)] = !joint.reversed;
            fmt::format_to(end, "{} {} {} {} {} {} {} {}\n", joint.first.patch, side_number(first), joint.second.patch,
                           side_number(second), to[0], to[1], same[0], same[1]);
        }
        text += "  </interfaces>\n";
    }
    if (const auto outer = outer_sides(patches); !outer.empty()) {
        text += "  <boundary>\n";
        for (const PatchSide& side : outer)
            fmt::format_to(end, "{} {}\n", side.patch, side_number(side.side));
        text += "  </boundary>\n";
    }
    return text + " </MultiPatch>\n";
}

std::string document(const std::string& head, const std::string& content)
{
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- " + head + " -->\n<xml>\n" + content + "</xml>\n";
}

} // namespace

void write_gismo(const std::filesystem::path& path, const MultiPatch& patches_mm, std::string_view name,
                 LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    std::string content;
    for (size_t p = 0; p < patches.patch.size(); ++p)
        content += geometry(int(p), patches.patch[p], patches.patch[p].control);
    write_atomically(path, document(head_line(name, "surface", unit), content + topology(patches)));
}

void write_gismo_field(const std::filesystem::path& path, const MultiPatch& patches_mm, const PatchField& field_mm,
                       std::string_view name, LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    const PatchField field = field_in(unit, patches, field_mm);
    std::string content;
    for (size_t p = 0; p < patches.patch.size(); ++p)
        content += geometry(int(p), patches.patch[p], field.value[p].transpose());
    write_atomically(path, document(head_line(name, field.name + " on the surface, unit " + field.unit, unit),
                                    content + topology(patches)));
}

} // namespace spia

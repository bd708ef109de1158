#include "engine/exchange/iga/write_iga_dyna.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/iga/iga_patches.h"
#include "engine/exchange/text/fixed_number.h"

namespace spia {
namespace {

constexpr int narrow = 10, wide = 20; // columns of a field

std::string knot_lines(const std::vector<double>& knots)
{
    std::string text;
    for (size_t k = 0; k < knots.size(); ++k)
        text += fixed_number(knots[k], wide) + (k % 4 == 3 || k + 1 == knots.size() ? "\n" : "");
    return text;
}

std::string integers(std::initializer_list<int> numbers)
{
    std::string text;
    for (const int number : numbers)
        text += fixed_number(number, narrow);
    return text + "\n";
}

std::string patch_text(int id, const NurbsSurface& patch)
{
    constexpr int knots_follow = 0, same_sense = 0;
    std::string text = "*IGA_2D_NURBS_XYZ\n$  PATCHID        NR        NS        PR        PS\n" +
                       integers({id, patch.count_u, patch.count_v, patch.degree_u, patch.degree_v}) +
                       "$     UNIR      UNIS\n" + integers({knots_follow, knots_follow}) + knot_lines(patch.knots_u) +
                       knot_lines(patch.knots_v);
    text += "$                  X                   Y                   Z                 WGT\n";
    for (Eigen::Index c = 0; c < patch.control.cols(); ++c)
        text += fixed_number(patch.control(0, c), wide) + fixed_number(patch.control(1, c), wide) +
                fixed_number(patch.control(2, c), wide) + fixed_number(patch.weight[c], wide) + "\n";
    return text + "*IGA_FACE_XYZ\n$      FID   PATCHID       ORI\n" + integers({id, id, same_sense});
}

std::string shell_text(int id, double thickness, int form, int material)
{
    constexpr int through_thickness = 5, full_gauss = 1;
    // interpolation elements: as many as the degree
    const std::string default_count = fixed_number(0.0, narrow);
    return "*IGA_SHELL\n$      SID       PID      NISR      NISS\n" + fixed_number(id, narrow) +
           fixed_number(id, narrow) + default_count + default_count + "\n" + fmt::format("*PART\npatch {}\n", id) +
           integers({id, id, material}) + "*SECTION_IGA_SHELL\n$    SECID    ELFORM      SHRF       NIP       IRL\n" +
           fixed_number(id, narrow) + fixed_number(form, narrow) + fixed_number(form == 0 ? 5. / 6 : 1, narrow) +
           fixed_number(through_thickness, narrow) + fixed_number(full_gauss, narrow) + "\n$        T\n" +
           fixed_number(thickness, narrow) + "\n";
}

} // namespace

void write_iga_dyna(const std::filesystem::path& path, const MultiPatch& patches_mm,
                    const std::vector<double>& thickness_mm, const Material& material, std::string_view name,
                    LengthUnit unit)
{
    const MultiPatch patches = patches_in(unit, patches_mm);
    if (thickness_mm.size() != patches.patch.size())
        throw InputError(
            fmt::format("{} thicknesses do not go with {} patches", thickness_mm.size(), patches.patch.size()));
    for (size_t p = 0; p < thickness_mm.size(); ++p)
        if (!(thickness_mm[p] > 0))
            throw InputError(fmt::format("the thickness {} mm of patch {} is not positive", thickness_mm[p], p + 1));
    const double mm = millimetres(unit);
    std::string text =
        "*KEYWORD\n$ " + head_line(name, "isogeometric shells", unit) +
        ", forces N, times s\n$ Each patch has its mean thickness; thickness and plastic strain that vary are not in this file.\n";
    auto end = std::back_inserter(text);
    for (const PatchInterface& joint : patches.interfaces)
        fmt::format_to(end, "$ {} is {}, {} (u is r, v is s); control points and knots are the same\n",
                       spia::name(joint.first), spia::name(joint.second), joint.reversed ? "reversed" : "same sense");
    for (size_t p = 0; p < patches.patch.size(); ++p)
        text += patch_text(int(p) + 1, patches.patch[p]);
    constexpr int material_id = 1;
    const int form = patches.patch.size() == 1 ? 1 : 0;
    for (size_t p = 0; p < patches.patch.size(); ++p)
        text += shell_text(int(p) + 1, thickness_mm[p] / mm, form, material_id);
    // In N, s and the unit of length: kg/m3 is N s2/m4.
    const double density = material.density_kg_m3 * std::pow(mm / 1000, 4), young = material.young_MPa * mm * mm;
    text += "*MAT_ELASTIC\n$      MID        RO         E        PR\n" + fixed_number(material_id, narrow) +
            fixed_number(density, narrow) + fixed_number(young, narrow) + fixed_number(material.poisson, narrow) + "\n";
    write_atomically(path, text + "*END\n");
}

} // namespace spia

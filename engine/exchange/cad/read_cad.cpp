#include "engine/exchange/cad/read_cad.h"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <Bnd_Box.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <set>
#include <spdlog/spdlog.h>
#include <stdexcept>

#include "engine/core/error.h"
#include "engine/exchange/cad/cad_bytes.h"
#include "engine/exchange/cad/cad_chords.h"
#include "engine/exchange/cad/cad_mesh.h"
#include "engine/exchange/cad/cad_sewing.h"
#include "engine/exchange/cad/cad_shape.h"
#include "engine/exchange/cad/cad_slivers.h"
#include "engine/exchange/cad/cad_surfaces.h"
#include "engine/exchange/cad/cad_swept.h"
#include "engine/exchange/cad/child_process.h"
#include "engine/exchange/cad/occt_session.h"
#include "engine/mesh/doctor/weld.h"
#include "engine/mesh/edge_uses.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

constexpr double rounding = 1e-3; // mm; what is narrower is a slip of the file

void require_options(const CadOptions& options)
{
    if (options.sewing_tolerance && !(*options.sewing_tolerance >= 0 && std::isfinite(*options.sewing_tolerance)))
        throw InputError("the sewing tolerance must be a length in mm, or 0 to leave the faces as they are");
    if (options.deflection && !(*options.deflection > 0 && std::isfinite(*options.deflection)))
        throw InputError("the deflection must be a length in mm above 0");
    if (options.angle && !(*options.angle >= 0.01 && *options.angle <= 1.6))
        throw InputError(
            "the angle between chord ends must be from 0.01 to 1.6 radians, that is from 0.58 to 91 degrees");
}

/// Beyond these a part closes up, or has more triangles than any computer holds.
void require_sense(const CadOptions& options, double diagonal)
{
    if (options.sewing_tolerance.value_or(0) > diagonal / 20)
        throw InputError(
            fmt::format("a sewing tolerance of {:.4g} mm would close up the part itself, which is {:.4g} mm "
                        "across; give {:.3g} mm at most",
                        *options.sewing_tolerance, diagonal, diagonal / 20));
    if (options.deflection && *options.deflection < diagonal * 1e-6)
        throw InputError(fmt::format("a deflection of {:.4g} mm takes too many triangles for a part that is {:.4g} mm "
                                     "across; give {:.3g} mm at least",
                                     *options.deflection, diagonal, diagonal * 1e-6));
}

double diagonal_of(const TopoDS_Shape& shape)
{
    Bnd_Box box;
    BRepBndLib::Add(shape, box, false);
    if (box.IsVoid() || box.IsOpen() || !std::isfinite(box.SquareExtent()) || box.SquareExtent() <= 0)
        throw InputError("its faces have no finite size; trim them in the CAD system and export again");
    return std::sqrt(box.SquareExtent());
}

/// Faces at edges of three or more triangles.
std::vector<int> overlapping(const CadContent& cad, double tolerance)
{
    const Weld joined = weld(cad.soup, tolerance);
    Eigen::Matrix3Xi triangle(3, cad.soup.polygons());
    for (int t = 0; t < cad.soup.polygons(); ++t)
        for (int k = 0; k < 3; ++k)
            triangle(k, t) = joined.same_as[size_t(cad.soup.polygon(t)[size_t(k)])];
    const std::vector<EdgeUse> uses = edge_uses(triangle);
    std::set<int> faces;
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (uses[begin].low != uses[begin].high && end - begin > 2)
            for (size_t k = begin; k < end; ++k)
                faces.insert(cad.face[size_t(uses[k].face)]);
    });
    return {faces.begin(), faces.end()};
}

/// @throws InputError if the file has a unit of its own
void scale(CadShape& shape, LengthUnit unit)
{
    if (!shape.unit.empty())
        throw InputError(
            fmt::format("{} files have a unit of their own, here {}, and lengths were converted to mm; leave the unit "
                        "out ({})",
                        shape.format, shape.unit, mention(option::unit)));
    gp_Trsf scaling;
    scaling.SetScaleFactor(millimetres(unit));
    // the whole, for faces to keep common edges
    BRepBuilderAPI_Transform transform(shape.shape, scaling, true);
    for (TopoDS_Face& face : shape.face)
        face = TopoDS::Face(transform.ModifiedShape(face));
}

CadContent content_of(CadShape& shape, const CadOptions& options, std::span<const std::string> wanted,
                      const Progress& progress)
{
    CadContent result;
    result.format = shape.format;
    result.unit = shape.unit;
    result.unmeshed_left_out = options.leave_out_unmeshed;
    result.faces = int(shape.face.size());
    const std::vector<int> numbers = chosen_faces(shape.tree, wanted);
    result.taken = int(numbers.size());
    for (LostShape& lost : shape.lost)
        (may_lack(numbers, lost) ? result.lost : result.lost_elsewhere).push_back(std::move(lost.label));
    result.aside = std::move(shape.aside);
    result.tree = std::move(shape.tree);
    result.solid = std::any_of(numbers.begin(), numbers.end(), [&](int face) {
        return result.tree.item[size_t(result.tree.body_of[size_t(face)])].kind == CadItem::Kind::solid;
    });
    std::vector<TopoDS_Face> taken;
    for (const int number : numbers)
        taken.push_back(shape.face[size_t(number)]);
    const std::vector<StatedSurface> surfaces = stated_surfaces(without_swept_cylinders(taken));
    result.surface.resize(shape.face.size());
    for (size_t f = 0; f < taken.size(); ++f)
        result.surface[size_t(numbers[f])] = surfaces[f];

    const double diagonal = diagonal_of(compound_of(taken));
    require_sense(options, diagonal);
    SewnFaces sewn = sew(taken, options.sewing_tolerance, diagonal, progress.part(0, 0.5));
    result.sewing_tolerance = sewn.tolerance;
    result.shortest_edge = sewn.shortest_edge;
    result.half_an_edge = sewn.half_an_edge;
    result.free_before = sewn.free_before;
    result.free_after = sewn.free_after;
    const auto number_of = [&](int face) { return numbers[size_t(face)]; };
    for (CadGap& gap : sewn.gaps) {
        gap.face = {number_of(gap.face[0]), number_of(gap.face[1])};
        result.gaps.push_back(gap);
    }
    const Chords usual = usual_chords(sewn.face, diagonal);
    result.deflection = options.deflection.value_or(usual.deflection);
    FaceTriangles mesh =
        mesh_faces(sewn.face, result.deflection, options.angle.value_or(usual.angle), progress.part(0.5, 0.95));
    progress.checkpoint(0.95, "looking for overlapping faces");
    result.soup = std::move(mesh.soup);
    result.normal = std::move(mesh.normal);
    result.curves = std::move(mesh.curves);
    std::vector<char> meshed(taken.size(), 0);
    for (const auto& [face, on] : sewn.doubles) {
        meshed[size_t(face)] = 1; // by the other
        result.doubled.push_back({number_of(face), number_of(on)});
    }
    for (const int f : mesh.face) {
        const int face = sewn.number[size_t(f)];
        meshed[size_t(face)] = 1;
        result.face.push_back(number_of(face));
    }
    const double closed = std::max(result.sewing_tolerance, rounding);
    for (size_t f = 0; f < taken.size(); ++f)
        if (!meshed[f]) {
            if (auto narrow = sliver(taken[f], closed)) {
                narrow->face = number_of(int(f));
                result.slivers.push_back(*narrow);
            } else
                result.unmeshed.push_back(number_of(int(f)));
        }
    std::stable_sort(result.slivers.begin(), result.slivers.end(),
                     [](const CadSliver& a, const CadSliver& b) { return a.width > b.width; });
    result.overlapping = overlapping(result, 1e-6 * diagonal);
    progress.checkpoint(1, "looking for overlapping faces");
    return result;
}

CadContent coarse(CadShape& shape, const Progress& progress)
{
    constexpr double parts_of_diagonal = 500, angle = 0.5;
    CadContent result;
    result.format = shape.format;
    result.unit = shape.unit;
    result.faces = result.taken = int(shape.face.size());
    result.tree = std::move(shape.tree);
    result.deflection = diagonal_of(compound_of(shape.face)) / parts_of_diagonal;
    FaceTriangles mesh = mesh_faces(shape.face, result.deflection, angle, progress);
    result.soup = std::move(mesh.soup);
    result.face = std::move(mesh.face);
    return result;
}

/// What OpenCASCADE throws, said in our words.
template <class Work> CadContent with_own_errors(const Work& work)
{
    try {
        return work();
    } catch (const Standard_Failure& failure) {
        const std::string why = failure.GetMessageString();
        throw InputError(why.find_first_not_of(' ') == std::string::npos
                             ? "OpenCASCADE gives up on it without a reason; export it again"
                             : fmt::format("OpenCASCADE gives up on it (\"{}\"); export it again", why));
    }
}

/// Those that were measured take 2 s per MB at most; damaged ones may be healed without an end.
std::chrono::seconds long_enough(const std::filesystem::path& path, const CadOptions& options)
{
    constexpr double least = 60, most = 600, per_byte = 2e-4;
    std::error_code none;
    const double bytes = double(std::filesystem::file_size(path, none));
    return std::chrono::seconds(int(none || options.deflection ? most : std::min(most, least + per_byte * bytes)));
}

/// In a process of its own.
template <class Work> CadContent apart(const Work& work, std::chrono::seconds busy, const Progress& progress)
{
    const OcctSession session; // held here for as long as the child works
    const auto in_it = [&](const Progress& told, const ChildLog& log) {
        session.redirect(log);
        return packed(with_own_errors([&] { return work(told); }));
    };
    const auto log = [](std::string_view text) { spdlog::debug("OpenCASCADE: {}", text); };
    return unpacked(in_child(in_it, log, progress, {busy}));
}

} // namespace

std::vector<FileFormat> cad_file_formats() { return cad_shape_formats(); }

CadContent read_cad(const std::filesystem::path& path, const CadOptions& options, std::span<const std::string> wanted,
                    std::optional<LengthUnit> unit, const Progress& progress)
{
    require_options(options);
    return apart(
        [&](const Progress& told) {
            CadShape shape = read_cad_shape(path, told.part(0, 0.4));
            if (unit)
                scale(shape, *unit);
            return content_of(shape, options, wanted, told.part(0.4, 1));
        },
        long_enough(path, options), progress);
}

CadContent read_cad_unguarded(const std::filesystem::path& path)
{
    const OcctSession session;
    return with_own_errors([&] {
        CadShape shape = read_cad_shape(path, {});
        return content_of(shape, {}, {}, {});
    });
}

CadContent preview_cad(const std::filesystem::path& path, const Progress& progress)
{
    return apart(
        [&](const Progress& told) {
            CadShape shape = read_cad_shape(path, told.part(0, 0.6));
            return coarse(shape, told.part(0.6, 1));
        },
        long_enough(path, {}), progress);
}

} // namespace spia

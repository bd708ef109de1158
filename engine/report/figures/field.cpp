#include "engine/report/figures/field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/forming/flat_mesh.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Area-weighted mean of the faces around each vertex, as the engine takes it.
Eigen::VectorXd vertex_mean(const TriMesh& part, const Eigen::VectorXd& of_face)
{
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertices()), weight = sum;
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f)) {
            sum[v] += area[f] * of_face[f];
            weight[v] += area[f];
        }
    return sum.cwiseQuotient(weight);
}

/// Of the corners the value of greatest size.
Eigen::VectorXd farthest_corner(const TriMesh& part, const Eigen::VectorXd& of_vertex)
{
    Eigen::VectorXd result(part.triangles());
    for (int f = 0; f < part.triangles(); ++f) {
        result[f] = of_vertex[part.triangle(0, f)];
        for (const int v : part.triangle.col(f))
            if (std::abs(of_vertex[v]) > std::abs(result[f]))
                result[f] = of_vertex[v];
    }
    return result;
}

/// %, per face
Eigen::VectorXd area_change(const TriMesh& part, const Blank& blank)
{
    const Eigen::ArrayXd formed = area_vectors(part).colwise().norm();
    const Eigen::ArrayXd flat = area_vectors(flat_mesh(part, blank)).colwise().norm();
    return 100 * (formed / flat - 1);
}

/// radians, at each corner of a face
Eigen::Vector3d corner_angles(const TriMesh& mesh, int face)
{
    Eigen::Vector3d result;
    for (int k = 0; k < 3; ++k) {
        const auto corner = [&](int i) { return mesh.position.col(mesh.triangle((k + i) % 3, face)); };
        const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
        result[k] = std::atan2(a.cross(b).norm(), a.dot(b));
    }
    return result;
}

/// degrees, per face
Eigen::VectorXd angle_distortion(const TriMesh& part, const Blank& blank)
{
    const TriMesh flat = flat_mesh(part, blank);
    Eigen::VectorXd result(part.triangles());
    for (int f = 0; f < part.triangles(); ++f)
        result[f] = (corner_angles(part, f) - corner_angles(flat, f)).cwiseAbs().maxCoeff() * 180 / std::numbers::pi;
    return result;
}

/// The fields that the engine has itself, per face and per vertex.
Eigen::VectorXd of_sheet(const SheetFields& sheet, Field field)
{
    switch (field) {
    case Field::thickness: return sheet.thickness;
    case Field::thinning: return 100 * sheet.thinning;
    case Field::strain_major: return sheet.strain_major;
    case Field::strain_minor: return sheet.strain_minor;
    case Field::strain_equivalent: return sheet.strain_equivalent;
    case Field::stress_major: return sheet.stress_major;
    case Field::stress_minor: return sheet.stress_minor;
    case Field::stress_equivalent: return sheet.stress_equivalent;
    default: return sheet.necking.cast<double>();
    }
}

const Eigen::VectorXd& of_skin(const SkinStrains& skins, Field field)
{
    switch (field) {
    case Field::outer_strain_major: return skins.outer.strain_major;
    case Field::outer_strain_minor: return skins.outer.strain_minor;
    case Field::outer_strain_equivalent: return skins.outer.strain_equivalent;
    case Field::inner_strain_major: return skins.inner.strain_major;
    case Field::inner_strain_minor: return skins.inner.strain_minor;
    case Field::inner_strain_equivalent: return skins.inner.strain_equivalent;
    default: return skins.curvature;
    }
}

} // namespace

const std::vector<FieldInfo>& all_fields()
{
    // Major strain and stress and all lengths are positive but for rare spots; a map with a middle
    // would waste half of its colours on them.
    static const std::vector<FieldInfo> fields = {
        {Field::none, "none", "No field", "", false, "The plain sheet."},
        {Field::thickness, "thickness", "Thickness", "mm", false, "Thickness of the sheet after forming."},
        {Field::thinning, "thinning", "Thinning", "%", true,
         "Loss of thickness by forming; positive where the sheet became thinner and may tear, negative where it became "
         "thicker and may wrinkle."},
        {Field::strain_major, "strain_major", "Major strain", "", false,
         "Logarithmic strain in the direction in which the sheet was stretched most."},
        {Field::strain_minor, "strain_minor", "Minor strain", "", true,
         "Logarithmic strain in the sheet across the major one; negative where the sheet was drawn in."},
        {Field::strain_equivalent, "strain_equivalent", "Equivalent strain", "", false,
         "Equivalent plastic strain (Hill 1948), the measure of hardening."},
        {Field::stress_major, "stress_major", "Major stress", "MPa", false,
         "Stress along the direction of the major strain; positive in tension."},
        {Field::stress_minor, "stress_minor", "Minor stress", "MPa", true,
         "Stress in the sheet across the major strain; negative in compression, where the sheet may wrinkle."},
        {Field::stress_equivalent, "stress_equivalent", "Equivalent stress", "MPa", false,
         "Flow stress by Hill 1948 at the end of forming."},
        {Field::area_change, "area_change", "Area change", "%", true,
         "Area on the part against the blank; positive where the sheet was expanded, negative where compressed."},
        {Field::angle_distortion, "angle_distortion", "Angle distortion", "\u00b0", false,
         "Largest change of a triangle's corner angle from blank to part: how much the sheet was sheared."},
        {Field::necking, "necking", "Necking", "", false,
         "1 where the strain exceeds the valid range of the hardening curve and the sheet is likely to neck, otherwise 0."},
        {Field::outer_strain_major, "outer_strain_major", "Outer skin, major strain", "", false,
         "Major strain of the outer skin, including bending at radii."},
        {Field::outer_strain_minor, "outer_strain_minor", "Outer skin, minor strain", "", true,
         "Minor strain of the outer skin, including bending at radii."},
        {Field::outer_strain_equivalent, "outer_strain_equivalent", "Outer skin, equivalent strain", "", false,
         "Equivalent strain of the outer skin, including bending at radii."},
        {Field::inner_strain_major, "inner_strain_major", "Inner skin, major strain", "", false,
         "Major strain of the inner skin, including bending at radii."},
        {Field::inner_strain_minor, "inner_strain_minor", "Inner skin, minor strain", "", true,
         "Minor strain of the inner skin, including bending at radii."},
        {Field::inner_strain_equivalent, "inner_strain_equivalent", "Inner skin, equivalent strain", "", false,
         "Equivalent strain of the inner skin, including bending at radii."},
        {Field::curvature, "curvature", "Curvature", "1/mm", true,
         "Principal curvature of largest magnitude; positive where bending stretches the outer skin."},
        {Field::zone, "zone", "Forming zone", "zone", false,
         "Forming zone: crack, at risk, marginal, excessive thinning or thickening, wrinkling tendency, low strain, safe. See Forming limits."},
        {Field::limit_distance, "limit_distance", "Margin to the limit", "%", false,
         "Engineering major strain left to the forming limit curve, in percentage points; below 0 the sheet cracks."},
        {Field::deviation, "deviation", "Deviation", "mm", true,
         "Distance from the part to the NURBS surface; positive where the surface runs on the outer side of the part."},
    };
    return fields;
}

const FieldInfo& info(Field field) { return all_fields()[size_t(field)]; }

Field field_by_name(std::string_view name)
{
    if (name == "thickening")
        return Field::thinning;
    std::string names;
    for (const FieldInfo& field : all_fields()) {
        if (field.name == name)
            return field.field;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", field.name);
    }
    throw InputError(fmt::format("there is no field \"{}\"; choose one of {}", name, names));
}

bool of_skins(Field field) { return field >= Field::outer_strain_major && field <= Field::curvature; }

bool available(const Session& session, Field field)
{
    if (of_skins(field))
        return session.part && session.blank && session.blank->skins;
    switch (field) {
    case Field::none: return true;
    case Field::zone: return session.part && session.limits;
    case Field::limit_distance: return session.part && session.limits && session.limits->zones.distance.size() > 0;
    case Field::deviation: return session.part && session.surface;
    default: return session.part && session.blank;
    }
}

Eigen::VectorXd values(const Session& session, Field field, bool per_face)
{
    if (!available(session, field))
        throw InputError(fmt::format("the field \"{}\" is not there yet; {} first", info(field).name,
                                     !session.part                                      ? "open a part"
                                     : field == Field::deviation                        ? "make the NURBS surface"
                                     : field == Field::limit_distance && session.limits ? "choose a forming limit curve"
                                     : of_skins(field) && session.blank ? "ask for the strains of both skins and unfold"
                                                                        : "solve for the blank"));
    if (field == Field::none)
        return {};
    const TriMesh& part = session.part->mesh;
    if (field == Field::deviation) {
        // The part's vertices come first, those of filled holes follow.
        const Eigen::VectorXd at_vertex = session.surface->deviation.at_vertex.head(part.vertices());
        return per_face ? farthest_corner(part, at_vertex) : at_vertex;
    }
    if (field == Field::zone) {
        const std::vector<Zone> zone =
            per_face ? session.limits->zones.zone : zones_at_vertices(part, session.limits->zones.zone);
        Eigen::VectorXd number(Eigen::Index(zone.size()));
        std::transform(zone.begin(), zone.end(), number.begin(), [](Zone each) { return double(each); });
        return number;
    }
    if (field == Field::limit_distance) {
        const Eigen::VectorXd of_face = 100 * session.limits->zones.distance;
        return per_face ? of_face : vertex_mean(part, of_face);
    }
    if (field == Field::area_change || field == Field::angle_distortion) {
        const Blank& blank = session.blank->blank;
        const Eigen::VectorXd of_face =
            field == Field::area_change ? area_change(part, blank) : angle_distortion(part, blank);
        return per_face ? of_face : vertex_mean(part, of_face);
    }
    if (of_skins(field)) {
        const Eigen::VectorXd& of_face = of_skin(*session.blank->skins, field);
        return per_face ? of_face : vertex_mean(part, of_face);
    }
    return of_sheet(per_face ? session.blank->face : session.blank->node, field);
}

bool available_in_steps(Field field)
{
    return (field >= Field::thickness && field <= Field::stress_equivalent) || field == Field::necking;
}

Eigen::VectorXd values(const TriMesh& part, const SheetFields& of_face, Field field, bool per_face)
{
    if (!available_in_steps(field))
        throw InputError(fmt::format("the steps have no field \"{}\"; choose a strain, a stress or the thickness",
                                     info(field).name));
    const Eigen::VectorXd values = of_sheet(of_face, field);
    return per_face ? values : vertex_mean(part, values);
}

} // namespace spia

#include "engine/report/figures/face_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/report/figures/statistics.h"

namespace spia {
namespace {

/// Whether it is bad by being more than nothing; a thickness and a margin are bad by being less
/// than elsewhere.
bool has_zero(Field field)
{
    return field != Field::thickness && field != Field::zone && field != Field::limit_distance &&
           field != Field::necking;
}

bool is_stress(Field field)
{
    return field == Field::stress_major || field == Field::stress_minor || field == Field::stress_equivalent;
}

/// @param strained the greatest equivalent strain of the sheet
/// @param sheet  null: nothing is strained yet
FaceValues said(Eigen::VectorXd value, Field field, double size, const SheetFields* sheet)
{
    FaceValues result{std::move(value)};
    const double strained = sheet ? sheet->strain_equivalent.maxCoeff() : 0;
    if (field == Field::necking && sheet) // which is 0 or 1
        result.order = sheet->strain_equivalent;
    const double floor = noise(field, size);
    const bool nothing = is_stress(field) && strained < noise(Field::strain_equivalent, size);
    for (int f = 0; f < result.value.size(); ++f) {
        double& v = result.value[f];
        if (!std::isfinite(v))
            continue;
        if (nothing || std::abs(v) < floor)
            v = 0;
        if (result.least < 0 || v < result.value[result.least])
            result.least = f;
        if (result.greatest < 0 || v > result.value[result.greatest])
            result.greatest = f;
    }
    return result;
}

int nearest_face(const TriMesh& part, const Eigen::Vector3d& place)
{
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Matrix3d corners = part.position(Eigen::all, part.triangle.col(f));
        const double distance = (corners * closest_on_triangle(corners, place) - place).squaredNorm();
        if (distance < least) {
            least = distance;
            nearest = f;
        }
    }
    return nearest;
}

/// The greatest sample lies where no vertex is: between them, or on the surface.
void raise_to_greatest(const TriMesh& part, const Deviation& deviation, Eigen::VectorXd& of_face)
{
    if (of_face.size() == 0 || of_face.cwiseAbs().maxCoeff() >= deviation.max())
        return;
    const DeviationStatistics& way = deviation.surface_to_mesh.max > deviation.mesh_to_surface.max
                                         ? deviation.surface_to_mesh
                                         : deviation.mesh_to_surface;
    double& value = of_face[nearest_face(part, way.where)];
    value = std::copysign(deviation.max(), value);
}

} // namespace

double noise(Field field, double size)
{
    // The solver ends at 1e-8 of the nodal forces at yield (FlattenOptions::tolerance), which is
    // some 1e-11 of strain. What it is given is coarser: STL and glTF hold coordinates in 24 bits,
    // 6e-8 of a part; on edges of a thousandth of it that is 6e-5 of strain. 1e-4 lies above that,
    // and a factor of ten below the elastic limit of sheet metal (Rp/E, about 1e-3), under which
    // nothing is formed.
    constexpr double strain = 1e-4;
    switch (field) {
    case Field::strain_major:
    case Field::strain_minor:
    case Field::strain_equivalent:
    case Field::outer_strain_major:
    case Field::outer_strain_minor:
    case Field::outer_strain_equivalent:
    case Field::inner_strain_major:
    case Field::inner_strain_minor:
    case Field::inner_strain_equivalent: return strain;
    // 1/mm: flatter than the part is long by far
    case Field::curvature: return size > 0 ? 1e-3 / size : 0;
    case Field::thinning:
    case Field::area_change:
    case Field::limit_distance: return 100 * strain; // %
    case Field::thickness: return strain;            // mm, of a sheet of about 1 mm
    case Field::angle_distortion: return 0.01;       // degrees: 1e-4 of shear is 0.006
    case Field::stress_major:
    case Field::stress_minor:
    case Field::stress_equivalent:
        return 0.1;                            // MPa: hardening, of the order of 1 GPa, times the
                                               // strain
    case Field::deviation: return 1e-6 * size; // mm, as what is read in single precision
    case Field::necking:
    case Field::zone:
    case Field::none: return 0;
    }
    return 0;
}

FaceValues face_values(const Session& session, Field field)
{
    Eigen::VectorXd value = values(session, field, true);
    if (field == Field::none)
        return {};
    const TriMesh& part = session.part->mesh;
    if (field == Field::deviation)
        raise_to_greatest(part, session.surface->deviation, value);
    return said(std::move(value), field, bounding_diagonal(part), session.blank ? &session.blank->face : nullptr);
}

FaceValues face_values(const TriMesh& part, const SheetFields& of_face, Field field)
{
    return said(values(part, of_face, field, true), field, bounding_diagonal(part), &of_face);
}

std::optional<double> margin_of(const LimitsResult& limits, int face)
{
    const Eigen::VectorXd& distance = limits.zones.distance;
    return face < distance.size() && std::isfinite(distance[face]) ? std::optional(distance[face]) : std::nullopt;
}

std::vector<int> worst_faces(const TriMesh& part, const FaceValues& values, Field field, int most)
{
    if (values.least < 0 || field == Field::zone)
        return {};
    const auto [least, greatest] = values.extremes();
    const double floor = noise(field, bounding_diagonal(part));
    Eigen::VectorXd bad = values.value.unaryExpr([&](double value) { return badness(field, value); });
    if (values.order.size())
        bad = (bad.array() > 0).select(values.order, 0.0);
    if (!has_zero(field) && !(greatest - least > floor)) // the same everywhere
        return {};
    std::vector<int> faces = worst_spots(part, bad, most, false);
    if (has_zero(field))
        std::erase_if(faces, [&](int f) { return !(bad[f] > floor); });
    if (field == Field::necking)
        std::erase_if(faces, [&](int f) { return !(bad[f] > 0); });
    return faces;
}

} // namespace spia

#include "engine/unfold/step/target_friction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/forming/process/contact_pressure.h"
#include "engine/forming/process/smallest_turn.h"
#include "engine/forming/solver/membrane.h"
#include "engine/forming/solver/nearest_rotation.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/step/piece_picture.h"

namespace spia {
namespace {

using Axes = Eigen::Matrix<double, 3, 2>;

/// The feet of the piece, from edge to edge: a development that is cut does not cut the piece.
/// @param held of the first held vertex
Eigen::Matrix2Xd feet(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target,
                      const Eigen::Vector2d& held)
{
    std::optional<Eigen::Matrix2Xd> foot = unwound_piece(piece, now, target);
    if (!foot)
        throw InputError(fmt::format("the freed faces around face {} go all the way around the {}: its friction cannot "
                                     "be determined; free one side after the other",
                                     piece.face[0], name(target)));
    const Eigen::Vector2d first = foot->col(piece.held.front());
    if (!std::holds_alternative<ConeFace>(target))
        return foot->colwise() + (held - first);
    // once around the axis
    const double turn = std::atan2(first[0] * held[1] - first[1] * held[0], first.dot(held));
    return Eigen::Rotation2Dd(turn).toRotationMatrix() * *foot;
}

Axes turned(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Axes& axes)
{
    Axes out;
    for (int k = 0; k < 2; ++k)
        out.col(k) = smallest_turn(from, to, axes.col(k));
    return out;
}

Axes tangent_axes(const Eigen::Vector3d& normal)
{
    const Eigen::Vector3d u = normal.unitOrthogonal();
    return (Axes() << u, normal.cross(u)).finished();
}

/// Per vertex how ways in the tangent plane of the state lie in that of the part: as the faces
/// around it are turned in the mean.
std::vector<Eigen::Matrix3d> state_to_part(const TriMesh& part, const Eigen::Matrix3Xd& part_normal,
                                           const TriMesh& state, const Eigen::Matrix3Xd& state_normal)
{
    std::vector<Eigen::Matrix2d> moment(size_t(part.vertices()), Eigen::Matrix2d::Zero());
    const std::vector<Element> element = elements(part);
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = element[size_t(f)];
        const Eigen::Matrix3d corner = state.position(Eigen::all, state.triangle.col(f));
        const Axes in_state = corner * e.gradient.transpose();
        const Eigen::Vector3d up = e.frame.col(0).cross(e.frame.col(1)),
                              up_in_state = in_state.col(0).cross(in_state.col(1)).normalized();
        for (const int v : part.triangle.col(f)) {
            const Eigen::Vector3d n = part_normal.col(v), m = state_normal.col(v);
            moment[size_t(v)] += e.area * tangent_axes(n).transpose() * turned(up, n, e.frame) *
                                 (tangent_axes(m).transpose() * turned(up_in_state, m, in_state)).transpose();
        }
    }
    std::vector<Eigen::Matrix3d> out;
    for (int v = 0; v < part.vertices(); ++v)
        out.push_back(tangent_axes(part_normal.col(v)) * nearest_rotation(moment[size_t(v)]) *
                      tangent_axes(state_normal.col(v)).transpose());
    return out;
}

} // namespace

void require_friction_on(ContactRegion friction, std::vector<int> freed, const TriMesh& part, const std::string& what)
{
    std::sort(freed.begin(), freed.end());
    for (const int f : friction.faces)
        if (!std::binary_search(freed.begin(), freed.end(), f))
            throw InputError(fmt::format("{}: face {} rubs but is not freed; free it, too, or leave it out", what, f));
    if (friction.faces.empty())
        friction.faces = std::move(freed);
    require_contact(friction, part, what);
}

Eigen::VectorXd friction_traction(const TriMesh& part, const Eigen::Matrix3Xd& state, const UnfoldPick& pick,
                                  const std::vector<int>& freed, const TargetSurface& target)
{
    if (!pick.friction)
        return {};
    ContactRegion region = *pick.friction;
    if (region.name.empty())
        region.name = "the target";
    std::sort(region.faces.begin(), region.faces.end());
    region.faces.erase(std::unique(region.faces.begin(), region.faces.end()), region.faces.end());
    require_friction_on(region, freed, part, "the friction of the target");
    if (region.faces.empty())
        region.faces = freed;
    const TriMesh now{state, part.triangle};
    Eigen::Matrix3Xd square_to_target(3, part.triangles());
    for (int f = 0; f < part.triangles(); ++f)
        square_to_target.col(f) = outer_normal(target, now.position(Eigen::all, now.triangle.col(f)).rowwise().mean());
    const double pressure = contact_pressure(region, area_vectors(now), square_to_target).MPa;
    if (region.friction == 0)
        return {};
    Eigen::VectorXd traction = Eigen::VectorXd::Zero(part.triangles());
    traction(region.faces).setConstant(region.sides * region.friction * pressure);
    return traction;
}

SlipOnFace slip_on(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target,
                   const Eigen::Vector2d& held, const Eigen::Vector2d& origin)
{
    const TriMesh state{now, piece.mesh.triangle};
    const Eigen::Matrix3Xd part_normal = vertex_normals(piece.mesh), state_normal = vertex_normals(state);
    const std::vector<Eigen::Matrix3d> to_part = state_to_part(piece.mesh, part_normal, state, state_normal);
    SlipOnFace slip{feet(piece, now, target, held), {}};
    for (Eigen::Index v = 0; v < now.cols(); ++v) {
        const Axes on_target = tangents(target, slip.foot.col(v));
        const Eigen::Vector3d up = on_target.col(0).cross(on_target.col(1)).normalized();
        slip.into_sheet.push_back(to_part[size_t(v)] * turned(up, state_normal.col(v), on_target));
    }
    slip.foot.colwise() -= origin;
    return slip;
}

} // namespace spia

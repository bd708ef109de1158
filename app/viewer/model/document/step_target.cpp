#include "app/viewer/model/document/step_target.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/viewer/model/document/unfolding_steps.h"
#include "engine/core/error.h"
#include "engine/core/small_dense.h"
#include "engine/unfold/step/unfold_script.h"
#include "engine/unfold/target/fit_target.h"
#include "engine/unfold/target/given_face.h"

namespace spia::viewer {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

void require_direction(const Eigen::Vector3d& v, const char* what)
{
    if (!(v.allFinite() && v.norm() > 0))
        throw InputError(std::string("The ") + what + " of a target needs a length above 0.");
}

} // namespace

TargetKind kind_of(const StepTarget& target)
{
    return target.plane      ? TargetKind::plane
           : target.cylinder ? TargetKind::cylinder
           : target.cone     ? TargetKind::cone
                             : TargetKind::fitted;
}

StepTarget suggested_target(TargetKind kind, const TriMesh& before, const PlannedStep& step)
{
    if (kind == TargetKind::fitted)
        return {};
    PlannedStep known = step;
    known.pick.target = planned_target(before, step);
    if (const StepTarget target = numbers_of(known); kind_of(target) == kind)
        return target;
    const std::vector<int>& carrying = step.pick.carrying.empty() ? step.pick.fixed : step.pick.carrying;
    // to begin with, though it be lost
    const std::vector<int>& faces = carrying.empty() ? step.pick.freed : carrying;
    const TargetPlane plane = plane_through(before, faces).plane;
    if (kind == TargetKind::plane)
        return {.plane = plane};
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : before.triangle.col(f))
            box.extend(before.position.col(v));
    const double size = box.diagonal().norm();
    Eigen::Vector3d axis = Eigen::Vector3d::Unit([&] { // along the longer side of what carries it
        Eigen::Index longest;
        (box.sizes().array() * (1 - plane.normal.array().square())).maxCoeff(&longest);
        return longest;
    }());
    axis = (axis - plane.normal.dot(axis) * plane.normal).normalized();
    if (kind == TargetKind::cylinder)
        return {.cylinder = TargetCylinder{plane.origin - size * plane.normal, axis, size}};
    constexpr double half_angle_deg = 30; // the faces lie on its side, one size from the apex
    const Eigen::Vector3d along =
        std::cos(half_angle_deg / degrees) * axis - std::sin(half_angle_deg / degrees) * plane.normal;
    return {.cone = TargetCone{plane.origin - size * axis, along, half_angle_deg}};
}

std::optional<TargetSurface> face_of(const StepTarget& target, const TriMesh& part, const UnfoldPick& pick)
{
    if (target.plane.has_value() + target.cylinder.has_value() + target.cone.has_value() > 1)
        throw InputError("A step has one target: a plane, a cylinder or a cone.");
    if (const auto& plane = target.plane) {
        require_direction(plane->normal, "normal");
        return given_plane(plane->origin, plane->normal);
    }
    if (const auto& cylinder = target.cylinder) {
        require_direction(cylinder->axis, "axis");
        if (!(cylinder->radius > 0))
            throw InputError("A cylinder needs a radius above 0.");
        return given_cylinder(cylinder->origin, cylinder->axis, cylinder->radius, middle_of_pick(part, pick));
    }
    if (const auto& cone = target.cone) {
        require_direction(cone->axis, "axis");
        if (!(cone->half_angle_deg > 0 && cone->half_angle_deg < 90))
            throw InputError("The half angle of a cone lies between 0 and 90 degrees.");
        return given_cone(cone->apex, cone->axis, cone->half_angle_deg / degrees, middle_of_pick(part, pick));
    }
    return std::nullopt;
}

StepTarget numbers_of(const PlannedStep& step)
{
    StepTarget target;
    if (!step.pick.target)
        return target;
    const TargetSurface& face = *step.pick.target;
    if (const auto* plane = std::get_if<PlaneFace>(&face))
        target.plane = {plane->origin, plane->axes.col(0).cross(plane->axes.col(1))};
    else if (const auto* cylinder = std::get_if<CylinderFace>(&face))
        target.cylinder = {cylinder->origin, cylinder->axis, cylinder->radius};
    else if (const auto* cone = std::get_if<ConeFace>(&face))
        target.cone = {cone->apex, cone->axis, cone->half_angle * degrees};
    return target;
}

std::optional<TargetSurface> planned_target(const TriMesh& before, const PlannedStep& step)
{
    std::optional<TargetSurface> target = step.pick.target;
    if (!target) {
        const std::vector<int>& carrying = carrying_faces(step);
        if (carrying.empty())
            return std::nullopt;
        Eigen::AlignedBox3d box;
        for (const int f : carrying)
            for (const int v : before.triangle.col(f))
                box.extend(before.position.col(v));
        if (const auto fit = fit_target(before, carrying, std::max(1e-4, step.within_mm / box.diagonal().norm())))
            target = fit->face;
    }
    return target && step.offset_mm != 0 ? moved_out(*target, step.offset_mm) : target;
}

PlaneThrough plane_through(const TriMesh& mesh, const std::vector<int>& faces)
{
    double area = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero(), facing = Eigen::Vector3d::Zero();
    for (const int f : faces) {
        const Eigen::Matrix3d x = mesh.position(Eigen::all, mesh.triangle.col(f));
        const Eigen::Vector3d normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)) / 2;
        area += normal.norm();
        first += normal.norm() * x.rowwise().mean();
        facing += normal;
    }
    const Eigen::Vector3d centre = first / area;
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero(); // of the area, exactly
    for (const int f : faces) {
        const Eigen::Matrix3d x = mesh.position(Eigen::all, mesh.triangle.col(f)).colwise() - centre;
        const Eigen::Vector3d sum = x.rowwise().sum();
        const double size = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
        moment += size / 12 * (x * x.transpose() + sum * sum.transpose());
    }
    Eigen::Vector3d normal = eigen_pairs(moment).vector.col(0);
    if (normal.dot(facing) < 0)
        normal *= -1;
    PlaneThrough through{{centre, normal}, 0};
    for (const int f : faces)
        for (const int v : mesh.triangle.col(f))
            through.distance_mm = std::max(through.distance_mm, std::abs(normal.dot(mesh.position.col(v) - centre)));
    return through;
}

} // namespace spia::viewer

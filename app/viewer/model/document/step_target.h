#pragma once
#include <Eigen/Core>
#include <optional>

#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/plan/sequence.h"

/// The face onto which a step lays, as users give it: by numbers, as in the script of steps
/// (engine/pipeline/README.md).
namespace spia::viewer {

struct TargetPlane {
    Eigen::Vector3d origin{0, 0, 0}, normal{0, 0, 1}; ///< mm; of any length above 0

    friend bool operator==(const TargetPlane&, const TargetPlane&) = default;
};
struct TargetCylinder {
    Eigen::Vector3d origin{0, 0, 0}, axis{0, 0, 1}; ///< mm; of any length above 0
    double radius = 10;                             ///< mm

    friend bool operator==(const TargetCylinder&, const TargetCylinder&) = default;
};
struct TargetCone {
    Eigen::Vector3d apex{0, 0, 0}, axis{0, 0, 1}; ///< mm; from the apex into the cone
    double half_angle_deg = 30;

    friend bool operator==(const TargetCone&, const TargetCone&) = default;
};

/// One of them, or none: then the face is fitted to those that carry it.
struct StepTarget {
    std::optional<TargetPlane> plane = {};
    std::optional<TargetCylinder> cylinder = {};
    std::optional<TargetCone> cone = {};

    bool fitted() const { return !plane && !cylinder && !cone; }
    friend bool operator==(const StepTarget&, const StepTarget&) = default;
};

enum class TargetKind { fitted, plane, cylinder, cone };
TargetKind kind_of(const StepTarget& target);

/// Numbers to begin with: those of the planned target where it is of this kind, else a face around
/// what carries it.
/// @param before the part before the step
StepTarget suggested_target(TargetKind kind, const TriMesh& before, const PlannedStep& step);

/// @param pick of the step: a cylinder or cone is meant where its fixed faces are
/// @throws InputError if it is more than one, or its numbers are no face's
std::optional<TargetSurface> face_of(const StepTarget& target, const TriMesh& part, const UnfoldPick& pick);

/// The numbers of a step's own target; of a smooth face, which has none, a fitted one.
StepTarget numbers_of(const PlannedStep& step);

/// The target of a step before it is run: its own, or the plane, cylinder or cone through the faces
/// that carry it, moved out; none: it will be a smooth face.
/// @param before the part as it is then; @throws InputError as moved_out()
std::optional<TargetSurface> planned_target(const TriMesh& before, const PlannedStep& step);

/// The plane through faces with the least mean square distance, area by area, and how well it goes
/// through them.
struct PlaneThrough {
    TargetPlane plane;  ///< its normal on the outer side of the faces
    double distance_mm; ///< greatest of their vertices
};
/// @param mesh with its vertices where the faces are
PlaneThrough plane_through(const TriMesh& mesh, const std::vector<int>& faces);

} // namespace spia::viewer

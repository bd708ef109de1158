#pragma once
#include <optional>
#include <vector>

#include "app/viewer/model/actions/actions.h"

/// What can be dragged of the surface: its control points, each once though patches share it, and
/// the points of its lattice.
namespace spia::viewer {

/// Where they are now, deformed, mm; by number. Empty: there is no surface, or no lattice. A
/// control point is called by its number of shared_controls(), a lattice point by that of
/// Lattice::index().
Eigen::Matrix3Xd handle_positions(const Session& session, HandleKind kind);

/// The one nearest to a pixel of a view; of those at one place that in front.
std::optional<int> handle_at(const PickHandle& pick, const Camera& camera, const Eigen::Matrix3Xd& position);

/// The session's deformation with some handles moved further.
/// @throws InputError if there is no such handle
Deformation moved(const Session& session, HandleKind kind, const std::vector<int>& handles, const Eigen::Vector3d& by);

/// The same without what was done by one kind of handles. Nothing if nothing is left.
std::optional<Deformation> reset(const std::optional<Deformation>& deformation, HandleKind kind);

} // namespace spia::viewer

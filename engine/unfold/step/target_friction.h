#pragma once
#include <string>
#include <vector>

#include "engine/forming/process/external_forces.h"
#include "engine/unfold/step/freed_piece.h"
#include "engine/unfold/target/target_surface.h"
#include "engine/unfold/target/unfold_pick.h"

namespace spia {

/// The friction of a pick as a traction: sides * coefficient * pressure, a force over the area that
/// is seen square to the target.
/// @param state 3 by #V of the part, mm
/// @param freed faces of the part, ascending
/// @returns #F of the part, MPa; empty where there is none
/// @throws InputError if a face of it is not freed or a value is out of its bounds
Eigen::VectorXd friction_traction(const TriMesh& part, const Eigen::Matrix3Xd& state, const UnfoldPick& pick,
                                  const std::vector<int>& freed, const TargetSurface& target);

/// @param what in words, for the message
/// @throws InputError as require_contact(), or if a face that rubs is not one of those freed: names
/// it
void require_friction_on(ContactRegion friction, std::vector<int> freed, const TriMesh& part, const std::string& what);

/// How the sheet slips on the target: in its development to the foot of where it lies in the state;
/// from there by the smallest turn into the sheet of the state, and with that to where it lies in
/// the part.
/// @param now    3 by #V of the piece, mm: the state
/// @param target its development whole around the hinge
/// @param held   where the first held vertex lies in it, mm; @param origin of the blank in it, mm
/// @throws InputError if the piece goes all the way around the target
SlipOnFace slip_on(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target,
                   const Eigen::Vector2d& held, const Eigen::Vector2d& origin);

} // namespace spia

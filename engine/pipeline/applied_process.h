#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline/session.h"

namespace spia {

/// A contact region with the figures that follow from it.
struct AppliedContact {
    std::string name;
    int faces;
    double area_mm2;     ///< of the part
    double pressure_MPa; ///< as given, or the force over the area seen along the stamping direction
    double friction;     ///< coefficient of each side
    int sides;
    double friction_force_N; ///< sides * friction * pressure * area: the most that rubbing can hold
                             ///< back
};

struct AppliedBead {
    std::string name;
    double length_mm; ///< of its line
    double force_N_mm;
};

struct AppliedPilot {
    std::string name;
    int places; ///< one, or the corners of its curve
};

struct AppliedPiece {
    std::string name, material;
    double thickness_mm;    ///< flat
    int faces;              ///< of its own: those that no later piece covers
    double area_mm2;        ///< of these, on the part
    double edge_force_N_mm; ///< by which its edge is held: the same share of its own lock force
};

/// What the tools did to a solved part, in figures.
struct AppliedProcess {
    std::vector<AppliedContact> contact;
    std::vector<AppliedBead> drawbeads;
    double edge_restraint = 0;  ///< share of the lock force
    double lock_force_N_mm = 0; ///< of the base sheet
    double held_mm = 0;         ///< length of the edge that is held: the outer one, without seams
    double upright_mm = 0;      ///< of it where the sheet stands within 6 degrees of the stamping
                                ///< direction: slip is not seen there
    std::vector<AppliedPilot> pilots;
    std::vector<AppliedPiece> tailored;
    std::optional<Eigen::Vector3d> rolling;
};

/// @param session solved at least
AppliedProcess applied_process(const Session& session);

/// A short line for each: "contact binder: 2.5 MPa on 12 faces, friction 0.12 on 2 sides, holds up
/// to 1200 N".
std::vector<std::string> describe(const AppliedProcess& process);

/// What of the wishes unfolding by steps leaves out, for it acts on the part as a whole: "tools,
/// edge restraint"; empty: nothing.
std::string left_out_by_steps(const ProcessConditions& process);

} // namespace spia

#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/material/sheet.h"
#include "engine/forming/process/external_forces.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Tools press on these faces and rub against the slip: a binder, which rests, on both sides of the
/// sheet; a pad or the punch, which travel with the part's middle, on one.
/// The traction is sides * friction * pressure [Coulomb]; given as a force, the pressure is that
/// force over the faces' area seen along the stamping direction.
struct ContactRegion {
    std::string name;
    std::vector<int> faces;             ///< each once
    std::optional<double> pressure_MPa; ///< either this
    std::optional<double> force_N;      ///< or this, along the stamping direction
    double friction = 0;                ///< coefficient of each side
    int sides = 2;                      ///< 2: binder; 1: pad or punch
    friend bool operator==(const ContactRegion&, const ContactRegion&) = default;
};

/// A bead that restrains the sheet across a line on the part.
struct Drawbead {
    std::string name;
    std::vector<Eigen::Vector3d> line; ///< mm, on the part
    double force_N_mm = 0;             ///< per length of the line
    friend bool operator==(const Drawbead&, const Drawbead&) = default;
};

/// Pins: the vertices of the part nearest to these places do not move in the plane of the blank
/// when the sheet is formed.
struct Pilot {
    std::string name;
    std::vector<Eigen::Vector3d> line; ///< mm, on the part: one place, or a curve
    friend bool operator==(const Pilot&, const Pilot&) = default;
};

/// A piece of a tailor-welded blank.
struct TailoredPiece {
    std::string name;
    std::vector<int> faces;
    Material material;
    double thickness = 1; ///< mm
    friend bool operator==(const TailoredPiece&, const TailoredPiece&) = default;
};

/// What the tools do to the sheet, and what the sheet is made of where it is not the same all over.
struct ProcessConditions {
    std::vector<ContactRegion> contact; ///< where two overlap their tractions add up
    std::vector<Drawbead> drawbeads;
    double edge_restraint = 0; ///< of the outer edge, as a share of the lock force (see
                               ///< lock_force()): 0 free, 1 locked
    std::vector<Pilot> pilots;
    std::vector<TailoredPiece> tailored; ///< where two overlap the later one counts
    std::optional<Eigen::Vector3d>
        rolling; ///< rolling direction, seen along the stamping direction; not given: the sheet
                 ///< is isotropic in its plane (mean r)
    friend bool operator==(const ProcessConditions&, const ProcessConditions&) = default;
};

/// Force per length (N/mm) at which a strip that cannot narrow, as the sheet between tools, would
/// tear: the greatest h sigma_1 in plane strain. What a bead takes at most.
double lock_force(const Material& material, double thickness);

/// @param what the region in words, for the message
/// @throws InputError if a face does not exist or a value is out of its bounds: names the region
/// and the fault
void require_contact(const ContactRegion& region, const TriMesh& part, const std::string& what);

/// Whether some tool pulls or presses on the part as a whole, or holds it.
bool has_tools(const ProcessConditions& process);

/// The sheet with its tailored pieces.
/// @param plane axes of the blank in space; @throws InputError  names the piece and the fault
Sheet sheet_of(const Material& material, double thickness, const StressCurve::Options& curve,
               const ProcessConditions& process, const TriMesh& part, const Eigen::Matrix<double, 3, 2>& plane);

/// The forces of the process on the vertices and faces of a part.
/// @param plane     axes of the blank in space
/// @param origin    its (0, 0) in space
/// @throws InputError names the region, bead or pin and what is wrong with it: a face that does not
/// exist, a value that
///                    is not positive, a line that does not lie on the part
ExternalForces external_forces(const ProcessConditions& process, const TriMesh& part, const Material& material,
                               double thickness, const Eigen::Matrix<double, 3, 2>& plane,
                               const Eigen::Vector3d& origin);

} // namespace spia

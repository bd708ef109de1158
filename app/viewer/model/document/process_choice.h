#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/process/drawbead.h"

/// What the user says about the tools, on regions and lines of the part. process_of() in document.h
/// makes the solver's conditions of it.
namespace spia::viewer {

/// The tool on a region presses and rubs: a binder on both sides of the sheet, a pad or the punch
/// on one.
struct ToolContact {
    std::optional<double> force_N = {};      ///< along the stamping direction; either this
    std::optional<double> pressure_MPa = {}; ///< or this
    double friction = 0.12;                  ///< coefficient of each side
    friend bool operator==(const ToolContact&, const ToolContact&) = default;
};

/// The sheet of a region that is another one than the rest: of a tailored blank.
struct OwnSheet {
    std::string material; ///< a built-in grade, or the path of a material file
    double thickness = 1; ///< mm
    friend bool operator==(const OwnSheet&, const OwnSheet&) = default;
};

enum class LineKind { drawbead, pilot };

/// A line on the part: a bead that restrains the sheet across it, or places that pins hold.
struct ProcessLine {
    LineKind kind = LineKind::drawbead;
    std::string name = {};
    std::vector<Eigen::Vector3d> point = {}; ///< mm, on the part; of a pilot one is enough
    double force_N_mm = 100;                 ///< of a drawbead, per length; not used where there is
                                             ///< a shape
    std::optional<BeadShape> shape = {};     ///< from which the force follows, see drawbead_force()
    friend bool operator==(const ProcessLine&, const ProcessLine&) = default;
};

} // namespace spia::viewer

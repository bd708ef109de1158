#pragma once
#include "app/viewer/model/document/document.h"

namespace spia::viewer {

/// How the surface stands to what is asked of it.
enum class Fit {
    none,    ///< there is no surface
    within,  ///< nowhere farther from the part than the tolerance
    beyond,  ///< farther somewhere
    far_off, ///< more than ten times farther somewhere: a mistake rather than a compromise
};

/// The one measure of how well the surface fits: step, lights, Export and reports all tell it.
/// Shares are of the area, by samples of the surface against the part and of vertices, edges and
/// faces of the part against the surface, each with the area that it stands for; the worse of both
/// ways counts (Deviation::within()).
struct FitVerdict {
    Fit fit = Fit::none;
    double tolerance = 0; ///< mm, as it was fitted within; else the usual one
    double greatest = 0;  ///< mm, both ways
    double p95 = 0;       ///< mm, both ways: on 95 % of the area it is not more
    double beyond = 0;    ///< share of the area that is farther than the tolerance, 0 to 1
};

FitVerdict fit_verdict(const Session& session);

/// A share of the area, with one precision everywhere: "0.58 %", "less than 0.01 %", "more than
/// 99.99 %".
std::string area_share(double share);

/// In words, for the user: the measure alone, what to do about it is said by the lights.
/// @param lengths  in which distances are told
std::string text(const FitVerdict& verdict, LengthUnit lengths = LengthUnit::mm);

struct ViewerState;

/// What Export says first: how the surface fits, and whether the lights hold anything against the
/// result. A surface that is far off is bad only where a file would hold it.
struct ExportVerdict {
    enum class Kind { good, warning, bad } kind = Kind::good;
    std::string headline, text;
    size_t doubts = 0; ///< that are listed below it
};
ExportVerdict export_verdict(const ViewerState& state, const FitVerdict& fit, bool writes_surface);

} // namespace spia::viewer

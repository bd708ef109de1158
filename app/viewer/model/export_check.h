#pragma once
#include "app/viewer/model/document.h"

namespace spia::viewer {

/// How the surface that would be exported stands to what is asked of it.
enum class Fit {
    none,    ///< there is no surface
    within,  ///< nowhere farther from the part than the tolerance
    beyond,  ///< farther somewhere
    far_off, ///< more than ten times farther somewhere: a mistake rather than a compromise
};

struct FitVerdict {
    Fit fit = Fit::none;
    double greatest = 0; ///< mm, both ways
    double p95 = 0;      ///< mm, from the part to the surface
    double share =
        0; ///< of the part's area that is farther than the tolerance; each vertex stands for a third of its faces
};

/// @param tolerance mm, above 0
FitVerdict fit_verdict(const Session& session, double tolerance);

/// In words, for the user.
/// @param tolerance  mm; @param lengths  in which distances are told
std::string text(const FitVerdict& verdict, double tolerance, LengthUnit lengths = LengthUnit::mm);

} // namespace spia::viewer

#pragma once
#include <string_view>

namespace spia {

/// What a curve (and a surface along each direction) does at its two ends.
enum class CurveEnds {
    averaged_knots, ///< nothing is asked of them: full order up to the border
    clamped,        ///< the derivative there is the one estimated from the data next to the end
    /// The second derivative vanishes, as in the paper (4.4.4): loses two orders at the border
    /// (theory.md 5; the test AveragedKnotsHaveOrderFourUpToTheBorderAndNaturalEndsTwo).
    natural
};

constexpr std::string_view name(CurveEnds ends)
{
    return ends == CurveEnds::clamped ? "clamped" : ends == CurveEnds::natural ? "natural" : "averaged knots";
}

} // namespace spia

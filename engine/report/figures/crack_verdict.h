#pragma once
#include <string>

#include "engine/pipeline/session.h"

namespace spia {

/// Whether the sheet will crack, as far as the forming limit curve tells.
struct CrackVerdict {
    enum class Kind {
        none,     ///< there is no blank, or its limits are not known yet
        safe,     ///< every place is below the curve by the required margin
        at_limit, ///< below the curve, by less than the margin
        cracks,   ///< above the curve
        unknown   ///< there is no curve
    };
    Kind kind = Kind::none;
    double share = 0; ///< greatest engineering major strain over that of the curve at the same
                      ///< minor strain
    int face = -1;    ///< where that is
    bool sure =
        true; ///< every face is judged, none thickens so much that it may wrinkle, and the result is of all that was
              ///< asked for
    std::string text; ///< a sentence or two
};

/// @param lengths  in which places are told
CrackVerdict crack_verdict(const Session& session, LengthUnit lengths = LengthUnit::mm);

} // namespace spia

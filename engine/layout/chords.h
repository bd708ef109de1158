#pragma once
#include <vector>

#include "engine/layout/layout.h"

namespace spia {

/// The curves of a layout in strips: opposite sides of a patch belong to one strip, which runs on
/// from patch to patch. All curves of a strip have the same knots and as many cells.
struct Chords {
    std::vector<int> strip;        ///< per curve
    std::vector<char> against;     ///< per curve: 1 where it runs against the strip, so that its
                                   ///< knots are 1 - t of the strip's
    std::vector<char> symmetrical; ///< per strip: it comes back to itself the other way round; its
                                   ///< knots must be their own mirror image
    int strips = 0;
};

Chords chords_of(const Layout& layout);

} // namespace spia

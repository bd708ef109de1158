#pragma once
#include <memory>
#include <optional>
#include <string>

#include "engine/core/progress.h"
#include "engine/forming/flatten.h"
#include "engine/part/part_file.h"

namespace spia {

/// Equivalent strain of forming a blank into the part.
struct StrainFigures {
    double most = 0; ///< of a face
    double mean = 0; ///< over the area of the part
};

/// What it is worth that a part was cut at its closed corners (SeamOptions::Mode::corners): the
/// same part solved with and without.
struct CornerCut {
    StrainFigures after;                 ///< cut, the blank that there is
    std::optional<StrainFigures> before; ///< joined as in the file; not given: it has no blank
    std::string why_not;                 ///< where it has none
};

/// Solves the part once more with the corners joined again, as a free sheet of the same material
/// and thickness.
/// @param part  as it was read
/// @param cut   its blank
/// @returns null if the part was not cut, or had to be for other reasons: a tube, say
std::shared_ptr<const CornerCut> corner_cut(const PartFile& part, const FlattenResult& cut,
                                            const FlattenOptions& options, const Progress& progress = {});

/// "with the corners cut the equivalent strain is up to 0.000 (mean 0.000); joined it is up to
/// 0.819 (mean 0.121)"
std::string describe(const CornerCut& cut);

} // namespace spia

#pragma once
#include <optional>
#include <string>

#include "engine/compare/map_quality.h"
#include "engine/forming/flatten.h"
#include "tests/support/bent_family.h"

namespace spia {

/// A blank by one method.
struct MethodRun {
    std::string failure; ///< empty: there is a blank
    MapQuality quality;
    std::optional<double> off_exact; ///< mm, greatest difference of an edge's length from that in
                                     ///< the exact layout
};

/// What came of a bent part: unfolded step by step without help, at once, and by the methods that
/// know no metal.
struct BentRun {
    int triangles = 0, regions = 0, steps = 0, converged = 0; ///< steps that converged
    MethodRun local, whole, abf, arap;
    double strain = 0;    ///< greatest equivalent one of the steps' blank
    int necking = 0;      ///< triangles beyond the trusted strain: where there are some the part
                          ///< cannot be formed so
    int at_hinge_end = 0; ///< more of them, in a vertex where a hinge ends on the free rim: the
                          ///< held line is stiff, so there strain has a peak that grows with every
                          ///< refinement, as at any end of a clamp
    int overlaps = 0;     ///< places where the blank of the steps lies on itself
    double seconds = 0;   ///< of regions, proposal and steps
    bool whole_converged = false;
    double whole_strain = 0;
};

/// Never throws. @param others also ABF++ and ARAP
BentRun run_bent(const shapes::BentPart& part, const FlattenOptions& options, bool others = true);

} // namespace spia

#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/fit.h"

namespace spia {

/// What a surface is like, and where it is not good enough.
struct Judgement {
    Deviation deviation;
    bool within = false;                  ///< the tolerance, at every sample
    std::vector<BeyondTolerance> missing; ///< where knots are missing: too far away or, if nothing
                                          ///< is, folded
};

/// Judges one surface after the other by the same part and tolerance; both must outlive it.
class FitJudge {
public:
    FitJudge(const TriMesh& part, const FitOptions& options, const Progress& progress = {});

    /// Samples of the surface first, the other way only if these are near enough; then, many more
    /// in the spans in which some came close to the tolerance.
    /// @param at_once  both ways, whatever the first one shows
    Judgement judge(const NurbsSurface& surface, bool at_once, const Progress& progress) const;

    const TriMesh& mesh;
    ClosestPointSearch search;
    Eigen::Matrix3Xd face_normal; ///< unit

private:
    std::vector<BeyondTolerance> look_closely(const NurbsSurface& surface, const std::vector<BeyondTolerance>& suspects,
                                              const Progress& progress) const;

    const FitOptions& options_;
};

} // namespace spia

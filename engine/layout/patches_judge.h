#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/layout/layout.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/deviation.h"
#include "engine/nurbs/mesh_samples.h"

namespace spia {

/// How far patches are from the part, and where.
struct PatchesJudgement {
    DeviationStatistics surface_to_mesh, mesh_to_surface;
    Eigen::VectorXd at_vertex;                         ///< mm, see Deviation
    std::vector<GreatestDeviation> patch;              ///< per patch, both ways
    std::vector<std::vector<BeyondTolerance>> missing; ///< per patch: what is beyond the tolerance

    double max() const { return std::max(surface_to_mesh.max, mesh_to_surface.max); }
};

/// Judges one set of patches after the other by the same part; all arguments must outlive it.
class PatchesJudge {
public:
    PatchesJudge(const TriMesh& part, const Blank& blank, const Layout& layout, double tolerance,
                 const Progress& progress = {});

    /// A place of the part is compared with the patch in whose region of the blank it lies; where
    /// that is farther away than the tolerance, with every patch near it.
    PatchesJudgement judge(const std::vector<NurbsSurface>& patches, const Progress& progress = {}) const;

private:
    double tolerance_;
    ClosestPointSearch search_;
    Eigen::Matrix3Xd vertex_normal_;
    MeshSamples samples_;              ///< of the part
    Eigen::Matrix2Xd plane_;           ///< of the same on the blank
    std::vector<int> patch_;           ///< per sample
    std::vector<Eigen::Vector4d> box_; ///< per patch of the layout: low x, low y, high x, high y, a
                                       ///< little larger
};

} // namespace spia

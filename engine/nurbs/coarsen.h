#pragma once
#include <optional>
#include <vector>

#include "engine/core/progress.h"
#include "engine/nurbs/fit.h"

namespace spia {

struct SpanBorders {
    std::vector<double> u, v;
    bool operator==(const SpanBorders&) const = default;
};

/// Proposes halves of spans that could be joined again: those in which a surface within the
/// tolerance is better by a factor than it need be. Which factor suffices is tried: what was
/// proposed has to be fitted and judged.
class SpanMerging {
public:
    SpanMerging(const TriMesh& mesh, const FitOptions& options) : mesh_(mesh), options_(options) {}

    /// @returns none if nothing is left to try, or the surface is so large that trying costs too
    /// much
    std::optional<SpanBorders> next(const NurbsSurface& surface, const Progress& progress);

    /// Whether the last proposal was good enough.
    void tried(bool good);

private:
    const TriMesh& mesh_;
    const FitOptions& options_;
    double factor_ = 1.2; ///< nearly all at first: what can be joined depends on the neighbours,
                          ///< too
    bool along_u_ = true; ///< one direction at a time
    std::vector<SpanBorders> tried_;
};

/// Proposes fewer spans of even change (equidistributed_spans()) for a surface within the
/// tolerance, one direction at a time, fewer by a share that is halved where it was too bold.
class KnotEquidistribution {
public:
    KnotEquidistribution(const FitSource& source, const FitOptions& options) : source_(source), options_(options) {}

    /// @returns none if nothing is left to try, the data lie on lines of their own, or trying costs
    /// too much
    std::optional<SpanBorders> next(const NurbsSurface& surface, const Progress& progress);

    /// Whether the last proposal was good enough.
    void tried(bool good);

private:
    const FitSource& source_;
    const FitOptions& options_;
    double share_[2] = {0.35, 0.35}; ///< of the spans along u, v to be spared at once
    bool along_u_ = true;
    int trials_ = 0;
};

/// Proposes to leave one knot out of a small surface within the tolerance, first those whose place
/// the surface notices least.
class KnotRemoval {
public:
    explicit KnotRemoval(const FitOptions& options) : options_(options) {}

    /// @returns none if all that is left has been tried, or trying costs too much
    std::optional<SpanBorders> next(const NurbsSurface& surface, const Progress& progress);

    /// What was proposed is not proposed again, good or not.
    void tried(bool) {}

private:
    const FitOptions& options_;
    std::vector<SpanBorders> tried_;
    Eigen::Index controls_ = 0;
    size_t at_once_ = 0; ///< tried for a surface of that many control points
};

} // namespace spia

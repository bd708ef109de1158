#pragma once
#include <memory>
#include <vector>

#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// The figures of the section Comparison, made anew only when a result is another.
using ComparisonTable = Memo<std::vector<ComparedFigure>, std::shared_ptr<const Reference>,
                             std::shared_ptr<const FlattenResult>, std::shared_ptr<const LimitsResult>>;

} // namespace spia::viewer

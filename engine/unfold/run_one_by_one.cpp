#include "engine/unfold/run_one_by_one.h"

#include <algorithm>

namespace spia {

UnfoldRun run_one_by_one(const TriMesh& part, const UnfoldScript& script, const FlattenOptions& options,
                         const std::function<void(const UnfoldRun&)>& watch, const Progress& progress,
                         const UnfoldRun* before, size_t keep)
{
    const double missing = double(std::max<size_t>(1, script.size() - std::min(keep, script.size())));
    UnfoldScript begun(script.begin(), script.begin() + long(std::min(keep, script.size())));
    UnfoldRun run;
    size_t k = keep;
    do { // once where all is kept: only the blank is missing
        if (k < script.size())
            begun.push_back(script[k]);
        run = run_unfolding(part, begun, options,
                            progress.part(-double(keep) / missing, (double(begun.size()) - double(keep)) / missing),
                            k == keep ? before : &run, k);
        if (watch)
            watch(run);
        ++k;
    } while (k < script.size() && run.failure.empty());
    return run;
}

} // namespace spia

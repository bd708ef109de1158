// The steps as a file of the command line.
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/unfolding_steps.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/pipeline/files/unfold_file.h"

namespace spia::viewer {

StepsOutcome open_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                        const std::filesystem::path& file, const Progress& progress)
{
    StepsOutcome outcome;
    try {
        progress.checkpoint(0, "finding the bends");
        outcome.bends = bends_of(part, std::move(bends));
        progress.checkpoint(0.7, "reading the steps");
        ReadScript read = read_unfold_script(file, *part, outcome.bends->map);
        progress.checkpoint(1, "reading the steps");
        if (read.steps.empty())
            throw InputError(
                fmt::format("No step of {} fits this part: {}", file.filename().string(), read.findings.front()));
        outcome.opened = file;
        outcome.notes = std::move(read.findings);
        // what became of the steps counts most
        std::stable_partition(outcome.notes.begin(), outcome.notes.end(),
                              [](const std::string& note) { return note.starts_with("step "); });
        outcome.proposed = step_list(std::move(read.steps));
    } catch (const Cancelled&) {
        outcome.cancelled = true;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    return outcome;
}

StepsOutcome save_steps(std::shared_ptr<const PartFile> part, std::shared_ptr<const PartBends> bends,
                        const StepList& steps, const std::filesystem::path& file, const Progress& progress)
{
    StepsOutcome outcome;
    try {
        for (size_t k = 0; k < steps.size(); ++k)
            if (needs_pick(*steps[k])) // in a file it would mean all that stays
                throw InputError(fmt::format("Step {} \"{}\" needs fixed faces for its target before it can be saved.",
                                             k + 1, steps[k]->name));
        progress.checkpoint(0, "finding the bends");
        outcome.bends = bends_of(part, std::move(bends));
        progress.checkpoint(0.9, "writing the steps");
        const WritingJob job(progress.part(0.9, 1)); // cancelled, nothing is written
        write_atomically(file, unfold_script_json(*part, outcome.bends->map, script_of(steps)));
        outcome.saved = file;
    } catch (const Cancelled&) {
        outcome.cancelled = true;
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    return outcome;
}

} // namespace spia::viewer

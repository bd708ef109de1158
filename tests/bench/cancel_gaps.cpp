// The longest times in which a job cannot be cancelled: spia-cancel-gaps PART [TOLERANCE_MM]...
// runs the whole chain and prints, for every stage, its seconds and its longest gaps between two
// checkpoints with the steps before and after each.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/core.h>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/closest_point.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"

namespace {

using namespace spia;
using Clock = std::chrono::steady_clock;

struct Gap {
    double seconds;
    std::string before, after;
};

/// Notes the time between the checkpoints of a stage.
class Gaps {
public:
    Progress progress()
    {
        return Progress(
            [this](double fraction, std::string_view step) { note(fmt::format("{} {:.0f} %", step, 100 * fraction)); });
    }
    void note(std::string step)
    {
        const auto now = Clock::now();
        gaps_.push_back(
            {std::chrono::duration<double>(now - last_).count(), std::exchange(step_, std::move(step)), step_});
        gaps_.back().after = step_;
        last_ = now;
    }
    void print(std::string_view stage, size_t most)
    {
        note("end");
        const double all = std::chrono::duration<double>(last_ - start_).count();
        fmt::print("{:8} {:8.2f} s, {} checkpoints\n", stage, all, gaps_.size());
        std::sort(gaps_.begin(), gaps_.end(), [](const Gap& a, const Gap& b) { return a.seconds > b.seconds; });
        for (size_t k = 0; k < std::min(most, gaps_.size()) && gaps_[k].seconds > 0.05; ++k)
            fmt::print("    {:6.2f} s from \"{}\" to \"{}\"\n", gaps_[k].seconds, gaps_[k].before, gaps_[k].after);
    }

private:
    Clock::time_point start_ = Clock::now(), last_ = start_;
    std::string step_ = "begin";
    std::vector<Gap> gaps_;
};

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 2) {
        fmt::print(stderr, "spia-cancel-gaps PART [TOLERANCE_MM]...\n");
        return 2;
    }
    constexpr size_t most = 6;
    Session session;
    session.file = argv[1];
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.flatten.thickness = 0.8;
    std::optional<Gaps> gaps;
    ChainHooks hooks;
    hooks.begins = [&](Stage) { return gaps.emplace().progress(); };
    hooks.ended = [&](Stage stage, const Session& made) {
        gaps->print(made.options.tolerance ? fmt::format("fit within {} mm", *made.options.tolerance)
                                           : std::string(name(stage)),
                    most);
        if (stage == Stage::read) {
            Gaps search;
            const ClosestPointSearch made_of_part(made.part->mesh);
            search.print("search", most);
        }
    };
    session = completed(run_chain(std::move(session), Stage::read, Stage::fit, {}, hooks));
    for (int k = 2; k < argc; ++k) {
        session.options.tolerance = std::atof(argv[k]);
        session = completed(run_chain(std::move(session), Stage::fit, Stage::fit, {}, hooks));
    }
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}

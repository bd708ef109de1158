#include "app/cli/shown_chain.h"

#include <optional>
#include <utility>

#include "app/cli/terminal.h"

namespace spia::cli {

ChainRun run_shown(Session session, Stage first, Stage last, const ChainWishes& wishes,
                   const std::function<void(const Session&)>& part_is_ready)
{
    std::optional<JobDisplay> display; // of the running stage
    ChainHooks hooks;
    hooks.begins = [&](Stage stage) { return display.emplace(std::string(name(stage))).progress(); };
    hooks.ended = [&](Stage stage, const Session& made) { display->done(made.seconds.at(stage)); };
    hooks.part_is_ready = part_is_ready;
    return run_chain(std::move(session), first, last, wishes, hooks);
}

} // namespace spia::cli

#include "app/viewer/model/actions/script_player.h"

#include <fmt/core.h>

namespace spia::viewer {

using Clock = std::chrono::steady_clock;

std::optional<Action> ScriptPlayer::next(const ViewerState& state, bool busy, const std::function<Json()>& report)
{
    if (ended())
        return {};
    const Step& step = steps_.front();
    std::optional<Action> result;
    if (const auto* perform = std::get_if<Perform>(&step.what)) {
        try {
            result = action(*perform, state, step.place);
        } catch (const std::exception& error) {
            throw ScriptFailed(2, error.what());
        }
    } else if (const auto* wait = std::get_if<Wait>(&step.what)) {
        const auto now = Clock::now();
        if (!waiting_since_)
            waiting_since_ = now;
        if (busy && wait->seconds && now - *waiting_since_ > std::chrono::duration<double>(*wait->seconds))
            throw ScriptFailed(1, fmt::format("{}: the job has not ended after {} s", step.place, *wait->seconds));
        if (busy)
            return {};
        waiting_since_.reset();
    } else if (const auto* expect = std::get_if<Expect>(&step.what)) {
        std::optional<std::string> text;
        try {
            text = unmet(*expect, report());
        } catch (const std::exception& error) {
            throw ScriptFailed(2, error.what());
        }
        if (text)
            throw ScriptFailed(1, fmt::format("{}: {}", step.place, *text));
    }
    steps_.pop_front();
    return result;
}

} // namespace spia::viewer

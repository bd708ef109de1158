#pragma once
#include <chrono>
#include <deque>
#include <functional>
#include <optional>

#include "app/viewer/model/actions/script.h"
#include "engine/core/error.h"

namespace spia::viewer {

/// A script that cannot go on.
class ScriptFailed : public Error {
public:
    ScriptFailed(int code, const std::string& text) : Error(text), exit_code(code) {}
    int exit_code; ///< of the program: 1 an expectation does not hold, or a job takes too long; 2
                   ///< the script is at fault
};

/// Replays the steps of a script, one per frame.
class ScriptPlayer {
public:
    explicit ScriptPlayer(std::vector<Step> steps = {}) : steps_(steps.begin(), steps.end()) {}

    bool ended() const { return steps_.empty(); }
    /// Takes the next step. @returns its action, if it is one
    /// @param busy    whether a job is running: "wait" stays until it has ended
    /// @param report  of the state, for what is expected
    /// @throws ScriptFailed
    std::optional<Action> next(const ViewerState& state, bool busy, const std::function<Json()>& report);

private:
    std::deque<Step> steps_;
    std::optional<std::chrono::steady_clock::time_point> waiting_since_;
};

} // namespace spia::viewer

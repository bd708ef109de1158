#include "engine/core/attempts.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "engine/core/error.h"

namespace spia {
namespace {

const std::string& reason_within(const std::vector<AttemptReport>& made)
{
    const auto winner = std::find_if(made.begin(), made.end(), [](const AttemptReport& each) { return each.won; });
    return (winner != made.end() ? *winner : made.back()).reason;
}

bool run(const PlannedAttempt& attempt, AttemptReport& report)
{
    if (!attempt.may_refuse)
        return attempt.run(report);
    try {
        return attempt.run(report);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        report.reason = error.what();
        report.refusal = std::current_exception();
        return false;
    }
}

} // namespace

std::vector<AttemptReport> try_in_order(const std::vector<PlannedAttempt>& attempts)
{
    using Clock = std::chrono::steady_clock;
    std::vector<AttemptReport> made;
    std::optional<size_t> winner;
    for (const PlannedAttempt& attempt : attempts) {
        if (attempt.when && !attempt.when())
            continue;
        const auto begin = Clock::now();
        AttemptReport report{attempt.name};
        const bool kept = run(attempt, report);
        if (report.reason.empty() && !report.within.empty())
            report.reason = reason_within(report.within);
        report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        made.push_back(std::move(report));
        if (!kept)
            continue;
        winner = made.size() - 1;
        if (!attempt.accept || attempt.accept())
            break;
    }
    if (winner)
        made[*winner].won = true;
    return made;
}

} // namespace spia

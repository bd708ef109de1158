#pragma once
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace spia {

/// How one of several attempts at the same result went.
struct AttemptReport {
    std::string name;
    std::string reason = {};                ///< why it ended, in words
    double seconds = 0;                     ///< with all within
    bool won = false;                       ///< its result is the one that was given
    std::vector<AttemptReport> within = {}; ///< attempts that it is made of
    std::exception_ptr refusal = {};        ///< the Error with which it ended, if it did
};

/// A row of a table of attempts, those that give the better result or cost less first. They know by
/// reference what is kept so far, and what they keep takes its place.
struct PlannedAttempt {
    std::string name;
    std::function<bool()> when; ///< whether what is kept leaves a reason to try it; none: always
    /// Says in the report why it ended, or of what attempts it was made: then the winner's reason
    /// is its own, without one that of the last.
    /// @returns whether its result is kept
    std::function<bool(AttemptReport& report)> run;
    std::function<bool()> accept = {}; ///< whether what is kept now will do, and no other is tried;
                                       ///< none: it will
    /// Whether an Error that run throws is its reason, and the next is tried.
    bool may_refuse = false;
};

/// Makes the attempts in their order, until what one has kept will do.
/// @throws what an attempt throws that may not refuse; Cancelled always
/// @returns those that were made; the last that has kept its result has won
std::vector<AttemptReport> try_in_order(const std::vector<PlannedAttempt>& attempts);

} // namespace spia

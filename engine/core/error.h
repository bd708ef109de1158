#pragma once
#include <stdexcept>
#include <string>

namespace spia {

/// There is no result. The message says what is wrong, where, and what to do next.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The input is not what the stage needs (command line: exit code 2).
struct InputError : Error {
    using Error::Error;
};

/// The solver found no state that could be given as a result (exit code 3).
struct SolveError : Error {
    using Error::Error;
};

/// A file could not be written or read back (exit code 4).
struct ExchangeError : Error {
    using Error::Error;
};

/// The user asked the job to stop (exit code 130).
struct Cancelled : Error {
    explicit Cancelled(const std::string& what = "cancelled") : Error(what) {}
};

} // namespace spia

#pragma once
#include <mutex>

namespace spia {

/// The right to use OpenCASCADE's readers and writers, held for as long as this object lives. They keep process-wide
/// state (controllers, Interface_Static settings) and crash when two threads use them at once, so every function that
/// calls them starts with one of these. Every setting is set again in each session: the last user may have changed it.
/// What OpenCASCADE has to say goes to the log at debug level instead of stdout. For .cpp files of engine/exchange.
class OcctSession {
public:
    OcctSession();

private:
    std::lock_guard<std::mutex> lock_;
};

} // namespace spia

#pragma once
#include <functional>
#include <mutex>
#include <string_view>

namespace spia {

/// The right to use OpenCASCADE's readers and writers, held for as long as this object lives. They
/// keep process-wide state (controllers, Interface_Static settings) and crash when two threads use
/// them at once, so every function that calls them starts with one of these. Every setting is set
/// again in each session: the last user may have changed it. What OpenCASCADE has to say goes to
/// the log at debug level instead of stdout. For .cpp files of engine/exchange.
class OcctSession {
public:
    OcctSession();

    /// For work in a copy of this process, whose log nobody reads: where messages go there.
    void redirect(std::function<void(std::string_view)> log) const;

private:
    std::lock_guard<std::mutex> lock_;
};

} // namespace spia

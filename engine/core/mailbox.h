#pragma once
#include <mutex>
#include <optional>
#include <utility>

namespace spia {

/// Carries the newest of many things from one thread to another; what nobody fetched in time is
/// lost.
template <class T> class Mailbox {
public:
    void post(T thing)
    {
        const std::lock_guard lock(mutex_);
        newest_ = std::move(thing);
    }
    /// What has come since the last call, if anything.
    std::optional<T> fetch()
    {
        const std::lock_guard lock(mutex_);
        return std::exchange(newest_, std::nullopt);
    }

private:
    std::mutex mutex_;
    std::optional<T> newest_;
};

} // namespace spia

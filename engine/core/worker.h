#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace spia {

/// Something that a Worker makes. For the owner's thread.
template <class T> class Eventually {
public:
    Eventually() = default;

    bool wanted() const { return state_ != nullptr; } ///< whether it was asked for at all
    bool ready() const { return state_ && state_->done.load(std::memory_order_acquire); }
    /// Null while it is being made. @throws what making it threw
    const T* peek() const { return ready() ? &state_->checked() : nullptr; }
    /// Until it is made, or is known to fail. It must be wanted.
    void wait() const { state_->done.wait(false, std::memory_order_acquire); }
    /// Waits. @throws what making it threw
    const T& get() const
    {
        wait();
        return state_->checked();
    }

private:
    friend class Worker;
    struct State {
        std::atomic<bool> done = false;
        std::optional<T> value;   ///< belongs to the worker until done
        std::exception_ptr error; ///< likewise
        const T& checked() const
        {
            if (error)
                std::rethrow_exception(error);
            return *value;
        }
    };
    std::shared_ptr<State> state_;
};

/// One thread that makes things in the order in which they are asked for. What nobody waits for any
/// more when its turn comes is left out.
class Worker {
public:
    /// @param wake  called on the worker's thread when something is ready; it must not throw
    explicit Worker(std::function<void()> wake = [] {}) : wake_(std::move(wake)), thread_([this] { run(); }) {}
    /// Waits for the end of what is being made; leaves out the rest.
    ~Worker()
    {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        news_.notify_one();
        thread_.join();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// @param make  runs on the worker's thread; it shares nothing mutable with the owner
    template <class Make> auto later(Make make)
    {
        using T = decltype(make());
        Eventually<T> result;
        result.state_ = std::make_shared<typename Eventually<T>::State>();
        {
            const std::lock_guard lock(mutex_);
            tasks_.push_back([weak = std::weak_ptr(result.state_), make = std::move(make)] {
                const auto state = weak.lock();
                if (!state)
                    return false;
                try {
                    state->value.emplace(make());
                } catch (...) {
                    state->error = std::current_exception();
                }
                state->done.store(true, std::memory_order_release);
                state->done.notify_all();
                return true;
            });
        }
        news_.notify_one();
        return result;
    }

private:
    void run()
    {
        for (;;) {
            std::function<bool()> task;
            {
                std::unique_lock lock(mutex_);
                news_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
                if (ended_)
                    return;
                task = std::move(tasks_.front());
                tasks_.pop_front();
            }
            if (task())
                wake_();
        }
    }

    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable news_;
    std::deque<std::function<bool()>> tasks_;
    bool ended_ = false;
    std::thread thread_; ///< last: all else is there before it starts
};

} // namespace spia

#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace spia {

/// One function on a thread of its own. Its owner asks now and then how far it is, and never waits
/// but in the destructor. All members are for the owner's thread.
template <class Result> class Job {
public:
    /// @param work  runs at once; it shares nothing mutable with the owner
    /// @param wake  called on the job's thread when there is news (another step or percent, or the
    /// end): many checkpoints are only there to
    ///              be cancelled at; it must not throw
    explicit Job(
        std::function<Result(const Progress&)> work, std::function<void()> wake = [] {})
        : thread_([this, work = std::move(work), wake = std::move(wake)] {
              try {
                  const Progress progress(
                      [&](double fraction, std::string_view step) {
                          bool news = false;
                          {
                              const std::lock_guard lock(mutex_);
                              news = step_ != step || percent(fraction_) != percent(fraction);
                              fraction_ = fraction;
                              step_ = step;
                          }
                          if (news)
                              wake();
                      },
                      cancel_);
                  result_ = work(progress);
              } catch (...) {
                  error_ = std::current_exception();
              }
              finished_.store(true, std::memory_order_release);
              wake();
          })
    {
    }

    /// Cancels and waits for the next checkpoint of the work.
    ~Job()
    {
        cancel();
        if (thread_.joinable())
            thread_.join();
    }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Takes effect at the next checkpoint of the work; take() then throws Cancelled.
    void cancel() { *cancel_ = true; }
    bool cancelling() const { return *cancel_ && !finished(); }
    bool finished() const { return finished_.load(std::memory_order_acquire); }

    double fraction() const
    {
        const std::lock_guard lock(mutex_);
        return fraction_;
    }
    std::string step() const
    {
        const std::lock_guard lock(mutex_);
        return step_;
    }

    /// The result, once; waits for the end if need be. @throws what the work threw
    Result take()
    {
        if (thread_.joinable())
            thread_.join();
        if (error_)
            std::rethrow_exception(error_);
        return std::move(*result_);
    }

private:
    static int percent(double fraction) { return int(100 * fraction); }

    std::shared_ptr<std::atomic<bool>> cancel_ = std::make_shared<std::atomic<bool>>(false);
    mutable std::mutex mutex_;
    double fraction_ = 0;
    std::string step_;
    std::optional<Result> result_; ///< belongs to the thread until finished_
    std::exception_ptr error_;     ///< likewise
    std::atomic<bool> finished_ = false;
    std::thread thread_; ///< last: all else is there before it starts
};

} // namespace spia

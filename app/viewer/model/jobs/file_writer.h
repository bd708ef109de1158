#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/worker.h"

namespace spia::viewer {

/// Writes files on a thread of its own, in the order in which they are asked for; its end waits for
/// them.
class FileWriter {
public:
    /// @param wake  called on that thread when a file is written
    explicit FileWriter(std::function<void()> wake = [] {}) : worker_(std::move(wake)) {}
    ~FileWriter() { wait(); }
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    /// @param write  makes and writes the file; it shares nothing mutable with the owner
    template <class Write> void later(std::filesystem::path file, Write write)
    {
        pending_.push_back({std::move(file), worker_.later([write = std::move(write)] {
                                write();
                                return true;
                            })});
    }
    bool busy() const { return !pending_.empty(); }
    void wait() const
    {
        for (const Pending& each : pending_)
            each.written.wait();
    }

    struct Ended {
        std::filesystem::path file;
        std::string error; ///< empty: it is written
    };
    /// Those that have been written, or cannot be, since the last call.
    std::vector<Ended> take_ended();

private:
    struct Pending {
        std::filesystem::path file;
        Eventually<bool> written;
    };
    std::vector<Pending> pending_;
    Worker worker_; ///< last: it ends first
};

} // namespace spia::viewer

#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <sys/types.h>

namespace spia::fuzz {

/// What becomes of a file.
enum Outcome { refused = 40, accepted, crashed, too_much, endless, fault };

/// Reads a file. @returns whether it is accepted
using CadReader = std::function<bool(const std::filesystem::path& file)>;

/// A copy of this process that reads one file after the other until one ends it: to copy a
/// sanitized process takes longer than to read. OpenCASCADE may crash there, run out of memory or
/// be busy without end. The same of the reader's own code is a fault: a report of a sanitizer, a
/// signal, an exception, memory or most of the time taken by it, or a result that makes no sense.
class CadCopy {
public:
    /// @param file  what read() reads, whatever it holds then
    CadCopy(CadReader reads, std::filesystem::path file);
    CadCopy(const CadCopy&) = delete;
    CadCopy& operator=(const CadCopy&) = delete;
    ~CadCopy();

    Outcome read();
    bool is_new() const { return files_ <= 1; } ///< it has read no other file than the last one
    double seconds() const;                     ///< of computing; 0 if there is no copy
    std::string place() const;                  ///< where the last one was ended
    void end();                                 ///< the next file gets a new one

private:
    void start();
    Outcome outcome_of_end(bool asked_for);

    CadReader reads_;
    std::filesystem::path file_;
    pid_t copy_ = -1;
    int to_ = -1, from_ = -1, files_ = 0;
};

} // namespace spia::fuzz

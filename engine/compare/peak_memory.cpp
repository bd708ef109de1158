#include "engine/compare/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace spia {
namespace {

/// A line "NAME:   123 kB" of /proc/self/status, in MB.
std::optional<double> status_mb(const std::string& name)
{
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.compare(0, name.size() + 1, name + ":") == 0)
            return std::stod(line.substr(name.size() + 1)) / 1024;
    return std::nullopt;
}

} // namespace

PeakMemory::PeakMemory()
{
    malloc_trim(0);
    std::ofstream marks("/proc/self/clear_refs");
    marks << "5" << std::flush; // "5" resets VmHWM, see proc(5)
    if (marks)
        before_ = status_mb("VmRSS");
}

std::optional<double> PeakMemory::most_mb() const { return before_ ? status_mb("VmHWM") : std::nullopt; }

std::optional<double> PeakMemory::added_mb() const
{
    const auto most = most_mb();
    return most ? std::optional(*most - *before_) : std::nullopt;
}

} // namespace spia

#pragma once
#include <optional>

namespace spia {

/// The most memory this program holds from its construction on, read where the kernel tells (Linux,
/// /proc/self).
class PeakMemory {
public:
    PeakMemory(); ///< gives unused memory back and resets the kernel's mark

    /// MB (1024^2 bytes) resident at the most since then, everything else in the program included;
    /// none where the kernel does not tell.
    std::optional<double> most_mb() const;
    /// The same above what was held at construction: what the work in between took.
    std::optional<double> added_mb() const;

private:
    std::optional<double> before_;
};

} // namespace spia

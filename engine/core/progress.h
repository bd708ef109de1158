#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string_view>

namespace spia {

/// How far a job is, and whether its owner still wants it. Cheap to copy; the default one is
/// silent.
class Progress {
public:
    /// @param fraction 0 to 1 over the whole job; @param step what is being done, e.g. "Newton
    /// step"
    using Report = std::function<void(double fraction, std::string_view step)>;

    Progress() = default;
    explicit Progress(Report report, std::shared_ptr<const std::atomic<bool>> cancel = nullptr);

    /// Reports, then throws Cancelled if the owner asked to stop. Call once per iteration, outside
    /// parallel loops.
    void checkpoint(double fraction, std::string_view step) const;

    /// The part [from, to] of this job as a job of its own.
    Progress part(double from, double to) const;

private:
    std::shared_ptr<const Report> report_;
    std::shared_ptr<const std::atomic<bool>> cancel_;
    double from_ = 0, to_ = 1;
};

} // namespace spia

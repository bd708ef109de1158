#include "engine/core/progress.h"

#include <algorithm>

#include "engine/core/error.h"

namespace spia {

Progress::Progress(Report report, std::shared_ptr<const std::atomic<bool>> cancel)
    : report_(std::make_shared<const Report>(std::move(report))), cancel_(std::move(cancel))
{
}

void Progress::checkpoint(double fraction, std::string_view step) const
{
    if (cancel_ && cancel_->load(std::memory_order_relaxed))
        throw Cancelled();
    if (report_ && *report_)
        (*report_)(from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_), step);
}

Progress Progress::part(double from, double to) const
{
    Progress sub = *this;
    sub.from_ = from_ + from * (to_ - from_);
    sub.to_ = from_ + to * (to_ - from_);
    return sub;
}

} // namespace spia

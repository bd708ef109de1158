#include "tests/support/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spia::shapes {

Step::Step(double depth, double angle_deg, double radius) : depth_(depth), radius_(radius)
{
    // two arcs without a wall between
    const double steepest = std::acos(1 - std::min(1.0, depth / (2 * radius)));
    const double angle = std::min(angle_deg * std::numbers::pi / 180, steepest);
    const double wall_depth = std::max(0.0, depth - 2 * radius * (1 - std::cos(angle)));
    slope_ = std::tan(angle);
    arc_run_ = radius * std::sin(angle);
    run_ = 2 * arc_run_ + wall_depth / slope_;
}

double Step::operator()(double t) const
{
    const auto arc = [&](double x) { return radius_ - std::sqrt(radius_ * radius_ - x * x); };
    if (t <= 0)
        return 0;
    if (t >= run_)
        return depth_;
    if (t < arc_run_)
        return arc(t);
    if (t > run_ - arc_run_)
        return depth_ - arc(run_ - t);
    return arc(arc_run_) + slope_ * (t - arc_run_);
}

} // namespace spia::shapes

#include "engine/mesh/orient2d.h"

#include <array>
#include <cmath>
#include <limits>

namespace spia {
namespace {

struct Exact {
    double value, rest; ///< rounded, and what rounding lost: value + rest is exact
};

Exact sum(double a, double b) // Knuth's two-sum: for any order of magnitude
{
    const double value = a + b, b_seen = value - a, a_seen = value - b_seen;
    return {value, (a - a_seen) + (b - b_seen)};
}

Exact product(double a, double b)
{
    const double value = a * b;
    return {value, std::fma(a, b, -value)};
}

/// A sum of doubles without rounding: components of growing size that do not overlap, so that the
/// last one that is not zero has the sign of the whole.
class Expansion {
public:
    void add(double x) // Shewchuk's Grow-Expansion, zeros left out
    {
        int kept = 0;
        for (int i = 0; i < size_; ++i) {
            const Exact s = sum(x, component_[size_t(i)]);
            x = s.value;
            if (s.rest != 0)
                component_[size_t(kept++)] = s.rest;
        }
        if (x != 0) // the greatest may cancel and smaller ones remain
            component_[size_t(kept++)] = x;
        size_ = kept;
    }
    void add(const Exact& x)
    {
        add(x.rest);
        add(x.value);
    }
    int sign() const { return size_ == 0 ? 0 : component_[size_t(size_ - 1)] > 0 ? 1 : -1; }

private:
    std::array<double, 16> component_; // six products of two components each, and room to grow
    int size_ = 0;
};

/// det |a - c, b - c| without the differences, which would round: the terms in c alone cancel.
int exact_sign(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
    Expansion det;
    det.add(product(a[0], b[1]));
    det.add(product(-a[1], b[0]));
    det.add(product(b[0], c[1]));
    det.add(product(-b[1], c[0]));
    det.add(product(c[0], a[1]));
    det.add(product(-c[1], a[0]));
    return det.sign();
}

} // namespace

int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
    const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]), det = left - right;
    // Shewchuk's: half the gap after 1
    constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
    constexpr double bound = (3 + 16 * epsilon) * epsilon;
    const double error = bound * (std::abs(left) + std::abs(right));
    if (det > error)
        return 1;
    if (-det > error)
        return -1;
    if (!a.allFinite() || !b.allFinite() || !c.allFinite())
        return 0;
    return exact_sign(a, b, c);
}

} // namespace spia

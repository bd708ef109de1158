#include "tests/support/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spia::shapes {
namespace {

Eigen::Vector2d along(const Profile::Piece& piece, double t)
{
    const double c = std::cos(piece.heading), s = std::sin(piece.heading);
    const double turn = piece.curvature * t;
    // In the frame of the first tangent; the second row is (1 - cos turn) / curvature without
    // cancellation.
    const double ahead = piece.curvature == 0 ? t : std::sin(turn) / piece.curvature;
    const double aside = piece.curvature == 0 ? 0 : 2 * std::pow(std::sin(turn / 2), 2) / piece.curvature;
    return piece.start + Eigen::Vector2d(c * ahead - s * aside, s * ahead + c * aside);
}

} // namespace

Profile& Profile::append(double length, double curvature)
{
    assert(length > 0);
    pieces_.push_back({length_, length_ + length, curvature, end_, heading_});
    end_ = along(pieces_.back(), length);
    heading_ += length * curvature;
    length_ += length;
    return *this;
}

Profile& Profile::straight(double length) { return append(length, 0); }

Profile& Profile::bend(double radius, double angle)
{
    return append(radius * std::abs(angle), (angle > 0 ? 1 : -1) / radius);
}

Eigen::Vector2d Profile::at(double s) const
{
    const auto after = [](const Piece& piece, double value) { return piece.to < value; };
    auto piece = std::lower_bound(pieces_.begin(), pieces_.end() - 1, s, after);
    return along(*piece, s - piece->from);
}

std::vector<double> even_spacing(const Profile& profile, double wanted)
{
    std::vector<double> s = {0};
    for (const Profile::Piece& piece : profile.pieces()) {
        const int least = piece.curvature == 0 ? 1 : 2;
        const int n = std::max(least, int(std::lround((piece.to - piece.from) / wanted)));
        for (int i = 1; i <= n; ++i)
            s.push_back(piece.from + (piece.to - piece.from) * i / n);
    }
    return s;
}

} // namespace spia::shapes

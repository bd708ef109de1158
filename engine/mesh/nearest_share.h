#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace spia {

/// How far along a way from a place, 0 to 1 of it, its nearest point to another place is; 0 of a
/// way without a length.
template <class Vector> double nearest_share(const Vector& place, const Vector& from, const Vector& way)
{
    const double length = way.squaredNorm();
    return length > 0 ? std::clamp((place - from).dot(way) / length, 0.0, 1.0) : 0;
}

} // namespace spia

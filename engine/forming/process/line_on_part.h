#pragma once
#include <string>
#include <vector>

#include "engine/mesh/closest_point.h"

namespace spia {

/// A place of a polyline on the part, with the length of line it stands for and the line's
/// direction.
struct LinePlace {
    ClosestPoint on_part;
    double length; ///< mm
    Eigen::Vector3d along;
};

/// Lays polylines on a part. What is given must lie on it within a half percent of its diagonal;
/// between two such places the straight line may bridge a bulge four times as high, but nothing
/// beyond the part's edge.
class LineOnPart {
public:
    /// @param spacing of places, mm; not above 0: close enough that no face a line crosses is left
    /// out
    explicit LineOnPart(const TriMesh& part, double spacing = 0);

    /// @param what names the line in messages
    /// @throws InputError if the place is not on the part
    ClosestPoint at(const std::string& what, const Eigen::Vector3d& point) const;

    /// The middles of equal pieces of the line.
    /// @throws InputError if it leaves the part, or has no length
    std::vector<LinePlace> places(const std::string& what, const std::vector<Eigen::Vector3d>& line) const;

private:
    ClosestPoint within(const std::string& what, const Eigen::Vector3d& point, double reach) const;

    const TriMesh& part_;
    ClosestPointSearch search_;
    double spacing_, reach_; ///< mm
};

} // namespace spia

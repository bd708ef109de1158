#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia::shapes {

/// A planar curve of straight lines and arcs, drawn like with a pen; tangents are continuous where
/// pieces meet.
class Profile {
public:
    /// @param heading the angle of the first tangent against the first axis, radians
    Profile(Eigen::Vector2d start, double heading) : end_(start), heading_(heading) {}

    Profile& straight(double length);
    Profile& bend(double radius, double angle); ///< radians, positive to the left

    double length() const { return length_; }
    Eigen::Vector2d at(double s) const; ///< the point at arc length s

    struct Piece {
        double from, to;       ///< arc lengths
        double curvature;      ///< 1/mm, positive to the left, 0 on a straight piece
        Eigen::Vector2d start; ///< the point at `from`
        double heading;        ///< the angle of the tangent there
    };
    const std::vector<Piece>& pieces() const { return pieces_; }

private:
    Profile& append(double length, double curvature);

    Eigen::Vector2d end_;
    double heading_ = 0, length_ = 0;
    std::vector<Piece> pieces_;
};

/// Arc lengths of points about `wanted` mm apart, with a point wherever two pieces meet and inside
/// every arc.
std::vector<double> even_spacing(const Profile& profile, double wanted);

} // namespace spia::shapes

#include "tests/support/square_cup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/profile.h"
#include "tests/support/rings.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

/// The contour at a distance outside the punch square (inside: negative) is a square with rounded
/// corners whose radius grows with the distance; far inside, a sharp square.
struct Contour {
    double half_side, corner_radius;

    Contour(const SquareCup& shape, double distance)
        : half_side(std::max(0.0, shape.punch / 2 + distance)),
          corner_radius(std::max(0.0, shape.corner_radius + distance))
    {
    }

    double straight() const { return 2 * (half_side - corner_radius); }
    double length() const { return 4 * straight() + 2 * pi * corner_radius; }

    /// The point at arc length s, counter-clockwise from the middle of the side x > 0.
    Eigen::Vector2d at(double s) const
    {
        if (half_side <= 0)
            return {0, 0};
        const double quarter = length() / 4;
        const double turns = std::floor(s / quarter);
        const double t = s - turns * quarter;
        const double half = straight() / 2, arc = pi / 2 * corner_radius, inner = half_side - corner_radius;
        Eigen::Vector2d p;
        if (t <= half)
            p = {half_side, t};
        else if (t < half + arc) {
            const double angle = (t - half) / corner_radius;
            p = {inner + corner_radius * std::cos(angle), inner + corner_radius * std::sin(angle)};
        } else
            p = {half - (t - half - arc), half_side};
        switch (int(turns) % 4) {
        case 0: return p;
        case 1: return {-p.y(), p.x()};
        case 2: return -p;
        default: return {p.y(), -p.x()};
        }
    }
};

/// First coordinate: distance outside the punch square; second: z.
Profile profile_of(const SquareCup& shape)
{
    const double slope = pi / 2 - shape.draft_deg * pi / 180;
    const double tangent_length =
        shape.punch_radius * std::tan(slope / 2); // from the arc's ends to the corner it replaces
    const double radii_drop = (shape.punch_radius + shape.die_radius) * (1 - std::cos(slope));
    assert(radii_drop < shape.depth && tangent_length <= shape.corner_radius);
    return Profile({-shape.punch / 2, 0}, 0)
        .straight(shape.punch / 2 - tangent_length)
        .bend(shape.punch_radius, -slope)
        .straight((shape.depth - radii_drop) / std::sin(slope))
        .bend(shape.die_radius, slope)
        .straight(shape.flange_width);
}

} // namespace

double SquareCup::area() const
{
    // The contour's length is linear in the distance d: straight sides 4 (side - 2 radius), corners
    // 2 pi (radius + d). So each smooth piece of the profile counts with the contour at its
    // centroid (Pappus).
    const Profile profile = profile_of(*this);
    double total = std::pow(punch + 2 * profile.at(profile.pieces()[1].from).x(), 2);
    const double r = corner_radius + profile.at(profile.pieces()[1].from).x();
    total -= (4 - pi) * r * r; // the flat bottom
    const double sides = 4 * (punch - 2 * corner_radius);
    for (size_t k = 1; k < profile.pieces().size(); ++k) {
        const Profile::Piece& piece = profile.pieces()[k];
        const double length = piece.to - piece.from;
        double centroid = profile.at((piece.from + piece.to) / 2).x();
        if (piece.curvature != 0) {
            const double radius = 1 / std::abs(piece.curvature), half = length / radius / 2;
            // From the middle of the arc towards its centre of curvature, which lies left of the
            // tangent if curvature > 0.
            const double middle_heading = piece.heading + piece.curvature * length / 2;
            const double towards_centre = piece.curvature > 0 ? -std::sin(middle_heading) : std::sin(middle_heading);
            centroid += towards_centre * radius * (1 - std::sin(half) / half);
        }
        total += length * (sides + 2 * pi * (corner_radius + centroid));
    }
    return total;
}

TriMesh square_cup(const SquareCup& shape)
{
    const Profile profile = profile_of(shape);
    const auto place = [&](double s) { return profile.at(s); };
    const auto circumference = [&](double distance) { return Contour(shape, distance).length(); };
    // of equilateral triangles
    const double edge = std::sqrt(4 / std::sqrt(3.0) * shape.area() / shape.triangles);
    const std::vector<double> rows = even_spacing(profile, edge * std::sqrt(3.0) / 2);

    std::vector<Eigen::Matrix3Xd> rings;
    for (const RingPlan& row : plan_rings(rows, edge, 4, place, circumference)) {
        const Eigen::Vector2d at = place(row.s);
        const Contour contour(shape, at.x());
        Eigen::Matrix3Xd ring(3, row.points);
        for (int i = 0; i < row.points; ++i) {
            const Eigen::Vector2d p = contour.at(contour.length() * (i + row.phase) / row.points);
            ring.col(i) << p, at.y();
        }
        rings.push_back(std::move(ring));
    }
    return stitch_rings(rings);
}

} // namespace spia::shapes

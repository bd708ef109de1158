#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/flatten.h"
#include "engine/mesh/topology.h"
#include "tests/support/square_cup.h"

namespace spia {
namespace {

constexpr double half_blank = 75; // mm, of the square blank of 150 mm

/// Where a point of the blank's right edge (half_blank, y) lies at 15 mm of stroke: draw-in 5.3 mm
/// on the axis, 3.3 mm along the diagonal [NUMISHEET'93, measured mean of the aluminium cups], a
/// cosine between.
Eigen::Vector2d drawn_in(double y)
{
    const double axis = 5.3, corner = 3.3 / std::numbers::sqrt2, t = y / half_blank;
    const double along_x = corner + (axis - corner) * 0.5 * (1 + std::cos(std::numbers::pi * t));
    return {half_blank - along_x, y - corner * t * t};
}

/// Distance of that outline from the middle, at an angle from the x axis. mm
double outline_radius(double angle)
{
    double a = std::abs(std::remainder(angle, std::numbers::pi / 2)); // by symmetry 0 to 45 degrees
    double low = 0, high = half_blank;
    for (int k = 0; k < 60; ++k) {
        const double y = 0.5 * (low + high);
        const Eigen::Vector2d p = drawn_in(y);
        (std::atan2(p[1], p[0]) < a ? low : high) = y;
    }
    return drawn_in(0.5 * (low + high)).norm();
}

/// The middle of the sheet between the benchmark's tools at 15 mm of stroke: punch 70 mm with
/// corners of 10 and an edge of 8 mm, die of 74 mm with an edge of 5 mm. Its flange is stretched or
/// shrunk along the rays from the middle until its rim lies on the measured outline; being flat, it
/// stays the exact surface.
TriMesh numisheet_cup(double thickness)
{
    // mm, half sides
    constexpr double punch = 35, die = 37, corner = 10, punch_edge = 8, die_edge = 5, stroke = 15;
    shapes::SquareCup shape;
    shape.punch_radius = punch_edge + thickness / 2;
    shape.die_radius = die_edge + thickness / 2;
    // Between the two edges the sheet is the line that touches both circles from either side.
    const Eigen::Vector2d centres(die + die_edge - (punch - punch_edge),
                                  stroke - shape.punch_radius - shape.die_radius);
    const double slope =
        std::atan2(centres[1], centres[0]) + std::asin((shape.punch_radius + shape.die_radius) / centres.norm());
    shape.draft_deg = 90 - slope * 180 / std::numbers::pi;
    const double half_side = punch - punch_edge + shape.punch_radius * std::tan(slope / 2);
    shape.punch = 2 * half_side;
    shape.corner_radius = corner + half_side - punch;
    shape.depth = stroke;
    shape.flange_width = 28;
    shape.triangles = 12000;
    TriMesh cup = shapes::square_cup(shape);
    shape.flange_width = 1e-3; // where the flange begins
    const auto rim_radius = [](const TriMesh& mesh) {
        std::vector<std::pair<double, double>> rim; // angle, radius
        const auto loops = boundary_loops(mesh);
        for (const int v : loops.front())
            rim.emplace_back(std::atan2(mesh.position(1, v), mesh.position(0, v)),
                             mesh.position.col(v).head<2>().norm());
        std::sort(rim.begin(), rim.end());
        return [rim](double angle) { // between the two neighbours, as along a straight edge
            auto next = std::lower_bound(rim.begin(), rim.end(), std::pair(angle, 0.));
            const auto to =
                next == rim.end() ? std::pair(rim.front().first + 2 * std::numbers::pi, rim.front().second) : *next;
            const auto from = next == rim.begin()
                                  ? std::pair(rim.back().first - 2 * std::numbers::pi, rim.back().second)
                                  : *(next - 1);
            const double t = to.first > from.first ? (angle - from.first) / (to.first - from.first) : 0;
            return from.second + t * (to.second - from.second);
        };
    };
    const auto inner = rim_radius(shapes::square_cup(shape)), outer = rim_radius(cup);
    const double plane = cup.position(2, boundary_loops(cup).front().front());
    for (int v = 0; v < cup.vertices(); ++v) {
        const Eigen::Vector2d p = cup.position.col(v).head<2>();
        const double angle = std::atan2(p[1], p[0]), r = p.norm(), from = inner(angle);
        if (std::abs(cup.position(2, v) - plane) > 1e-9 || r <= from)
            continue;
        cup.position.col(v).head<2>() =
            p / r * (from + (r - from) * (outline_radius(angle) - from) / (outer(angle) - from));
    }
    return cup;
}

/// How the unfolded outline compares with the square blank, mm.
struct Square {
    double off = 0, on_axis = 0, on_diagonal = 0;
};

} // namespace

/// Aluminium 6114-T4 of the benchmark: 0.81 mm, sigma = 576.79 (0.01658 + eps)^0.3593 MPa, r
/// 0.71/0.58/0.70, friction 0.162, binder 19.6 kN. [A. Makinouchi et al. (eds.), Proc.
/// NUMISHEET'93, square cup deep drawing]
TEST(SquareCup, TheDrawnCupUnfoldsToTheSquareItWasMadeOf)
{
    FlattenOptions options;
    options.material = {"Al 6114-T4", 71000, 0.33, 2700, Swift{576.79, 0.01658, 0.3593}, 0.71, 0.58, 0.70, ""};
    options.thickness = 0.81;
    const TriMesh cup = numisheet_cup(options.thickness);
    const double plane = cup.position(2, boundary_loops(cup).front().front());
    ContactRegion binder{.name = "binder", .faces = {}, .pressure_MPa = {}, .force_N = 19600, .friction = 0.162};
    for (int f = 0; f < cup.triangles(); ++f)
        if ((cup.position(2, Eigen::all)(cup.triangle.col(f)).array() - plane).abs().maxCoeff() < 1e-9)
            binder.faces.push_back(f);
    ASSERT_GT(binder.faces.size(), 1000u);
    options.process.contact = {binder};
    options.process.rolling = Eigen::Vector3d::UnitX();
    const auto measure = [&](const FlattenResult& result) {
        Square found;
        const auto loops = boundary_loops(cup);
        for (const int v : loops.front()) {
            const Eigen::Vector2d x = result.blank.position.col(v).cwiseAbs();
            found.off = std::max(found.off, std::abs(x.maxCoeff() - half_blank));
            const double angle = std::atan2(x[1], x[0]);
            if (angle < 0.02)
                found.on_axis = x[0];
            if (std::abs(angle - std::numbers::pi / 4) < 0.02)
                found.on_diagonal = x.norm();
        }
        return found;
    };
    const FlattenResult result = flatten(cup, options);
    EXPECT_EQ(result.report.system, SolvedSystem::strict) << result.report.reason;
    const auto [off, on_axis, on_diagonal] = measure(result);
    std::printf("half width %.2f mm on the axis, %.2f mm on the diagonal, at most %.2f mm off the square\n", on_axis,
                on_diagonal, off);
    EXPECT_LT(off, 0.02 * half_blank);
    // Friction stretches the sheet, so that a smaller blank does: by less than the 2 %, but surely.
    options.process.contact.clear();
    const Square without = measure(flatten(cup, options));
    std::printf("without friction %.2f mm and %.2f mm\n", without.on_axis, without.on_diagonal);
    EXPECT_LT(on_axis, without.on_axis - 0.05);
    EXPECT_LT(on_diagonal, without.on_diagonal - 0.05);
    EXPECT_NEAR(on_axis, half_blank, 0.02 * half_blank);
    EXPECT_NEAR(on_diagonal, half_blank * std::numbers::sqrt2, 0.02 * half_blank);
}

} // namespace spia

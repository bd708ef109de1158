#include "engine/mesh/closest_point.h"
#include "engine/unfold/map_lines.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/bent_parts.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

using shapes::Profile;
using std::numbers::pi;

/// An L: 40 mm flat, a radius of 5 over 90 degrees, 30 mm flat; unrolled by hand.
shapes::DevelopablePart angle_part()
{
    return shapes::extruded(Profile({0, 0}, 0).straight(40).bend(5, pi / 2).straight(30), 120, 3000);
}

SheetLine line(std::initializer_list<Eigen::Vector3d> points, bool closed = false)
{
    SheetLine result{"drawn", Eigen::Matrix3Xd(3, Eigen::Index(points.size())), closed};
    Eigen::Index k = 0;
    for (const Eigen::Vector3d& p : points)
        result.point.col(k++) = p;
    return result;
}

} // namespace

TEST(SheetLines, ABendHasItsBordersAndTheLineBetweenThem)
{
    const shapes::DevelopablePart part = angle_part();
    const BendMap map = find_bends(part.mesh);
    const std::vector<SheetLine> lines = bend_lines(part.mesh, map, part.flat);
    ASSERT_EQ(lines.size(), 3u);
    const double arc = part.flat.row(0).maxCoeff() - 70; // of chords
    const auto expect_at = [&](const SheetLine& each, double x) {
        EXPECT_FALSE(each.closed);
        EXPECT_NEAR(length(each), 120, 1e-6) << each.name;
        for (const auto& p : each.point.colwise())
            EXPECT_NEAR(p[0], x, 1e-6) << each.name;
        for (Eigen::Index k = 1; k < each.point.cols(); ++k)
            EXPECT_GT((each.point.col(k) - each.point.col(k - 1)).norm(), 1e-3) << each.name << ": no place twice";
    };
    EXPECT_EQ(lines[0].name, "bend 1");
    expect_at(lines[0], 40 + arc / 2);
    EXPECT_EQ(lines[1].name, "bend 1, region 1");
    expect_at(lines[1], 40);
    EXPECT_EQ(lines[2].name, "bend 1, region 2");
    expect_at(lines[2], 40 + arc);
}

TEST(SheetLines, SharpEdgesAreBendLinesThemselves)
{
    const TriMesh box = shapes::lipped_box({.joined = false});
    const BendMap map = find_bends(box);
    const Eigen::Matrix2Xd seen = box.position.topRows<2>(); // from below: enough for the edges of
                                                             // the bottom
    const std::vector<SheetLine> lines = bend_lines(box, map, seen);
    ASSERT_EQ(lines.size(), 8u);
    EXPECT_EQ(lines[0].name, "bend 1");
    EXPECT_NEAR(length(lines[0]), map.bends[0].length, 1e-9);
}

TEST(SheetLines, TheTrimLineIsTheRimOfWhatWasMoved)
{
    const shapes::DevelopablePart part = angle_part();
    const BendMap map = find_bends(part.mesh);
    Eigen::Matrix3Xd state = Eigen::Matrix3Xd::Zero(3, part.flat.cols());
    state.topRows(2) = part.flat;
    const FaceSet freed = without(inverted({}, part.mesh.triangles()), map.faces_of(0));
    const std::vector<SheetLine> lines = trim_lines(part.mesh, state, freed);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_FALSE(lines[0].closed) << "the hinge is no rim";
    EXPECT_NEAR(length(lines[0]), 120 + 2 * (part.flat.row(0).maxCoeff() - 40), 1e-9);
    const TriMesh plate = shapes::plate();
    const std::vector<SheetLine> all = trim_lines(plate, plate.position, inverted({}, plate.triangles()));
    ASSERT_EQ(all.size(), 3u) << "the outline and two holes";
    for (const SheetLine& each : all)
        EXPECT_TRUE(each.closed);
}

TEST(SheetLines, WhatIsDrawnOnTheBlankFollowsThePartOverTheBendAndBack)
{
    const shapes::DevelopablePart part = angle_part();
    const double far = part.flat.row(0).maxCoeff() - 10;
    const SheetLine drawn = line({{10, 20, 0}, {far, 90, 0}, {far, 100, 0}});
    const SheetLine on_part = to_part(part.mesh, part.flat, drawn);
    EXPECT_NEAR(length(on_part), length(drawn), 1e-9) << "the part unrolls without strain, face by face";
    EXPECT_NEAR((on_part.point.col(0) - Eigen::Vector3d(10, 20, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((on_part.point.rightCols<1>() - Eigen::Vector3d(45, 100, 25)).norm(), 0, 1e-9) << "on the upright leg";
    const SheetLine back = to_blank(part.mesh, part.flat, on_part);
    EXPECT_NEAR(length(back), length(drawn), 1e-6);
    for (const auto& p : back.point.colwise()) { // on the drawn line
        const Eigen::Vector3d a = drawn.point.col(0), along = (drawn.point.col(1) - a).normalized();
        EXPECT_LT(std::min((p - a).cross(along).norm(), std::abs(p[0] - far)), 1e-6);
    }
}

TEST(SheetLines, AHoleStaysClosed)
{
    const shapes::DevelopablePart part = angle_part();
    SheetLine hole{"hole", Eigen::Matrix3Xd::Zero(3, 48), true};
    for (int k = 0; k < 48; ++k)
        hole.point.col(k) << 44 + 9 * std::cos(2 * pi * k / 48), 60 + 9 * std::sin(2 * pi * k / 48), 0;
    const SheetLine on_part = to_part(part.mesh, part.flat, hole);
    EXPECT_TRUE(on_part.closed);
    EXPECT_NEAR(length(on_part), length(hole), 1e-9);
    EXPECT_GT(on_part.point.row(2).maxCoeff(), 3) << "it climbs the bend";
}

TEST(SheetLines, WhatLeavesTheSheetIsRefusedAndNamed)
{
    const shapes::DevelopablePart part = angle_part();
    const auto fault = [](const auto& act) {
        try {
            act();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_NE(fault([&] {
                  to_part(part.mesh, part.flat, line({{10, 20, 0}, {10, 130, 0}}));
              }).find("\"drawn\" leaves the blank at 10, 130"),
              std::string::npos);
    EXPECT_NE(fault([&] {
                  to_blank(part.mesh, part.flat, line({{10, 20, 0}, {10, 20, 9}}));
              }).find("off the part"),
              std::string::npos);
    EXPECT_NE(fault([&] {
                  to_part(part.mesh, part.flat, line({{10, 20, 0}}));
              }).find("two finite points"),
              std::string::npos);
    EXPECT_THROW(to_part(part.mesh, Eigen::Matrix2Xd::Zero(2, 3), line({{10, 20, 0}, {10, 30, 0}})), InputError);
}

TEST(SheetLines, AWayAcrossAHoleLeavesTheSheetThoughItsEndsDoNot)
{
    const TriMesh part = shapes::plate({.triangles = 3000});
    const Eigen::Matrix2Xd flat = part.position.topRows<2>();
    Eigen::Vector2d hole = Eigen::Vector2d::Zero();
    const std::vector<std::vector<int>> loops = boundary_loops(part);
    ASSERT_GT(loops.size(), 1u);
    for (const int v : loops[1])
        hole += flat.col(v) / double(loops[1].size());
    const double radius = (flat.col(loops[1][0]) - hole).norm();
    const auto across = [&](double beside) {
        return line({{hole[0] - 1.5 * radius, hole[1] + beside, 0}, {hole[0] + 1.5 * radius, hole[1] + beside, 0}});
    };
    EXPECT_THROW(to_part(part, flat, across(0)), InputError);
    EXPECT_THROW(to_part(part, flat, across(0.8 * radius)), InputError);
    EXPECT_NEAR(length(to_part(part, flat, across(1.1 * radius))), 3 * radius, 1e-9);
}

TEST(SheetLines, ARoundTripOverAStretchedBlankComesBackToTheDrawnLine)
{
    // A dome is not developable: lengths change, places must not. The map is any that is one to
    // one.
    const TriMesh part = shapes::dome({.triangles = 2000}).mesh;
    Eigen::Matrix2Xd flat = part.position.topRows<2>();
    for (auto p : flat.colwise())
        p *= 1 + 0.1 * p.squaredNorm() / 1e4;
    const double r = flat.colwise().norm().maxCoeff();
    SheetLine drawn{"ring", Eigen::Matrix3Xd::Zero(3, 60), true};
    for (int k = 0; k < 60; ++k)
        drawn.point.col(k) << 0.5 * r * std::cos(2 * pi * k / 60) + 0.1 * r, 0.4 * r * std::sin(2 * pi * k / 60), 0;
    const SheetLine on_part = to_part(part, flat, drawn), back = to_blank(part, flat, on_part);
    EXPECT_GT(on_part.point.cols(), drawn.point.cols());
    double off = 0;
    for (const auto& p : back.point.colwise()) {
        double nearest = 1e9;
        for (int k = 0; k < 60; ++k) {
            const Eigen::Vector3d a = drawn.point.col(k), d = drawn.point.col((k + 1) % 60) - a;
            nearest = std::min(nearest, (a + std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) * d - p).norm());
        }
        off = std::max(off, nearest);
    }
    EXPECT_LT(off, 1e-9);
    EXPECT_NEAR(length(back), length(drawn), 1e-9 * length(drawn));
    const SheetLine again = to_part(part, flat, back);
    EXPECT_NEAR(length(again), length(on_part), 1e-9 * length(on_part));
    const ClosestPointSearch search(part);
    for (Eigen::Index k = 0; k < on_part.point.cols(); ++k) { // also between its points
        const Eigen::Vector3d middle = (on_part.point.col(k) + on_part.point.col((k + 1) % on_part.point.cols())) / 2;
        EXPECT_LT(search.nearest(middle).distance, 1e-9);
    }
}

TEST(SheetLines, OfManyLinesOnlyThoseThatLeaveTheSheetAreLeftOut)
{
    const shapes::DevelopablePart part = angle_part();
    std::vector<SheetLine> lines = {line({{10, 20, 0}, {20, 90, 0}}), line({{10, 20, 0}, {10, 130, 0}}),
                                    line({{30, 20, 0}, {60, 20, 0}})};
    lines[1].name = "too long";
    const MappedLines up = to_part(part.mesh, part.flat, lines);
    ASSERT_EQ(up.lines.size(), 2u);
    ASSERT_EQ(up.left_out.size(), 1u);
    EXPECT_NE(up.left_out[0].find("\"too long\" leaves the blank at 10, 130"), std::string::npos) << up.left_out[0];
    const MappedLines down = to_blank(part.mesh, part.flat, up.lines);
    EXPECT_EQ(down.lines.size(), 2u);
    EXPECT_THROW(to_blank(part.mesh, Eigen::Matrix2Xd::Zero(2, 3), up.lines), InputError);
}

TEST(SheetLines, ALineThatJumpsFromOneFlangeToAnotherIsLeftOut)
{
    // A hem of two layers 0.1 mm apart: a line from one to the other is near the part everywhere,
    // but no line on the blank.
    const shapes::DevelopablePart hem =
        shapes::extruded(Profile({0, 0}, 0).straight(40).bend(0.05, pi).straight(30), 60, 3000);
    const Eigen::Vector3d below(20, 20, 0), above(20, 30, 0.1);
    const MappedLines mapped = to_blank(hem.mesh, hem.flat, std::vector<SheetLine>{line({below, above})});
    ASSERT_EQ(mapped.left_out.size(), 1u);
    EXPECT_NE(mapped.left_out[0].find("jumps"), std::string::npos) << mapped.left_out[0];
}

} // namespace spia

// The DXF file of a blank as a laser and a press brake take it: circles, arcs and lines, read back
// by our own reader.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "engine/core/error.h"
#include "engine/exchange/lines/outline_curves.h"
#include "engine/exchange/lines/read_dxf.h"
#include "engine/exchange/lines/smooth_spline.h"
#include "engine/exchange/lines/write_dxf.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::shop_dxf_test {
namespace {

using std::numbers::pi;
using Kind = OutlinePiece::Kind;
using Points = std::vector<Eigen::Vector2d>;

constexpr double exact = 1e-4, within = 0.01; // mm

OutlineLoop loop_of(const Points& points)
{
    OutlineLoop loop(2, Eigen::Index(points.size()));
    for (size_t k = 0; k < points.size(); ++k)
        loop.col(Eigen::Index(k)) = points[k];
    return loop;
}

/// The points of an arc, without the last. @param turn radians, either way
void add_arc(Points& points, const Eigen::Vector2d& centre, double radius, double from, double turn, int chords)
{
    for (int k = 0; k < chords; ++k) {
        const double angle = from + turn * k / chords;
        points.emplace_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
}

OutlineLoop circle(double radius, int chords, bool clockwise = false)
{
    Points points;
    add_arc(points, {7, -3}, radius, 0.3, clockwise ? -2 * pi : 2 * pi, chords);
    return loop_of(points);
}

/// A rectangle with rounded corners, its sides cut into pieces, begun somewhere.
OutlineLoop rounded(double width, double height, double radius, int chords, int cuts, int begun)
{
    Points points;
    const Eigen::Vector2d corner[] = {
        {width - radius, radius}, {width - radius, height - radius}, {radius, height - radius}, {radius, radius}};
    for (int k = 0; k < 4; ++k) {
        const double from = (k - 1) * pi / 2;
        add_arc(points, corner[k], radius, from, pi / 2, chords);
        const Eigen::Vector2d out(std::cos(from + pi / 2), std::sin(from + pi / 2));
        const Eigen::Vector2d a = corner[k] + radius * out, b = corner[(k + 1) % 4] + radius * out;
        for (int c = 0; c < cuts; ++c)
            points.emplace_back(a + (b - a) * c / cuts);
    }
    const auto same = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm() < 1e-9; };
    // a side without length
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    if (same(points.front(), points.back()))
        points.pop_back();
    std::rotate(points.begin(), points.begin() + begun % int(points.size()), points.end());
    return loop_of(points);
}

int count_of(const OutlineCurves& curves, Kind kind)
{
    return int(
        std::count_if(curves.pieces.begin(), curves.pieces.end(), [&](const auto& p) { return p.kind == kind; }));
}

double area_of(const SheetLine& line) { return signed_area(line.point.topRows<2>()); }

DxfLines written_and_read(const ScratchFolder& folder, const BlankDrawing& drawing, const DxfOptions& options)
{
    write_dxf(folder / "x.dxf", drawing, options);
    return read_dxf(folder / "x.dxf");
}

} // namespace

TEST(OutlineCurves, ACircleOfTheFileIsFoundExactly)
{
    for (const int chords : {12, 18, 40, 400})
        for (const bool clockwise : {false, true}) {
            const OutlineCurves curves = find_curves(circle(12, chords, clockwise), exact, within);
            ASSERT_TRUE(curves.circle) << chords;
            EXPECT_NEAR(curves.radius, 12, 1e-12);
            EXPECT_NEAR((curves.centre - Eigen::Vector2d(7, -3)).norm(), 0, 1e-12);
        }
    for (const int corners : {3, 4, 6, 8})
        EXPECT_FALSE(find_curves(circle(12, corners), exact, within).circle) << "a nut is none";
}

TEST(OutlineCurves, WhatIsStatedIsTakenHoweverFewChordsItHas)
{
    // A slot with two chords to each end, which nothing but the file could tell from corners; one
    // side in three pieces.
    const double r = 5, l = 20;
    Points points;
    add_arc(points, {l, 0}, r, -pi / 2, pi, 2);
    points.insert(points.end(), {{l, r}, {l / 2, r}, {l / 3, r}});
    add_arc(points, {0, 0}, r, pi / 2, pi, 2);
    points.emplace_back(0, -r);
    const OutlineLoop slot = loop_of(points);
    const int count = int(points.size());
    ASSERT_EQ(count_of(find_curves(slot, exact, within), Kind::arc), 0);
    for (int begun = 0; begun < count; ++begun) {
        OutlineLoop turned(2, count);
        for (int k = 0; k < count; ++k)
            turned.col(k) = slot.col((k + begun) % count);
        const auto at = [&](int k) { return (k + count - begun) % count; };
        const std::vector<StatedPiece> stated = {{Kind::arc, at(0), 2, {l, 0}, r},
                                                 {Kind::line, at(2), 1},
                                                 {Kind::line, at(4), 1},
                                                 {Kind::arc, at(5), 2, {0, 0}, r}};
        const OutlineCurves curves = find_curves(turned, exact, within, stated);
        EXPECT_EQ(count_of(curves, Kind::arc), 2);
        EXPECT_EQ(count_of(curves, Kind::line), 2) << "the pieces of a side are one line";
        EXPECT_EQ(int(curves.pieces.size()), 4);
        for (const OutlinePiece& piece : curves.pieces)
            if (piece.kind == Kind::arc) {
                EXPECT_NEAR(piece.bulge, 1, 1e-15);
            }
    }
    const OutlineCurves whole =
        find_curves(circle(12, 3), exact, within, std::vector<StatedPiece>{{Kind::arc, 1, 3, {7, -3}, 12}});
    EXPECT_TRUE(whole.circle);
    EXPECT_EQ(whole.radius, 12);
}

TEST(OutlineCurves, AHoleThatTouchesTheEdgeIsTwoArcsOfItsRadius)
{
    // The outline runs around the hole from the point where both touch, and back to it.
    const double r = 4;
    for (const int chords : {3, 4, 12, 31}) {
        Points points = {{0, 0}, {0, 20}, {-30, 20}, {-30, -20}, {0, -20}};
        Points hole;
        add_arc(hole, {-r, 0}, r, 0, -2 * pi, chords);
        points.insert(points.begin(), hole.begin(), hole.end());
        const OutlineLoop loop = loop_of(points);
        const OutlineCurves curves =
            find_curves(loop, exact, within, std::vector<StatedPiece>{{Kind::arc, 0, chords, {-r, 0}, r}});
        double turned = 0;
        for (const OutlinePiece& piece : curves.pieces)
            if (piece.kind == Kind::arc) {
                const Eigen::Vector2d from = loop.col(piece.first),
                                      to = loop.col((piece.first + piece.edges) % loop.cols());
                EXPECT_NEAR((arc_centre(from, to, piece.bulge) - Eigen::Vector2d(-r, 0)).norm(), 0, 1e-9) << chords;
                turned += 4 * std::atan(piece.bulge);
            }
        EXPECT_EQ(count_of(curves, Kind::arc), 2) << chords;
        EXPECT_NEAR(turned, -2 * pi, 1e-12) << chords;
    }
}

TEST(OutlineCurves, AnEllipseIsNoCircleUnlessTheToleranceSaysSo)
{
    OutlineLoop ellipse = circle(12, 90);
    ellipse.row(0) *= 1 + 1e-2;
    EXPECT_FALSE(find_curves(ellipse, exact, within).circle);
    EXPECT_TRUE(find_curves(ellipse, exact, 0.2).circle);
}

TEST(OutlineCurves, RoundedCornersAreArcsBetweenLinesWhereverTheOutlineBegins)
{
    for (int begun = 0; begun < 40; ++begun) {
        const OutlineLoop loop = rounded(80, 50, 6, 5, 3, begun);
        const OutlineCurves curves = find_curves(loop, exact, within);
        EXPECT_EQ(count_of(curves, Kind::arc), 4) << begun;
        EXPECT_EQ(count_of(curves, Kind::line), 4) << begun;
        EXPECT_EQ(count_of(curves, Kind::points), 0) << begun;
        int edges = 0;
        for (const OutlinePiece& piece : curves.pieces) {
            edges += piece.edges;
            if (piece.kind == Kind::arc) {
                EXPECT_NEAR(piece.bulge, std::tan(pi / 8), 1e-12) << "a quarter turn";
            }
        }
        EXPECT_EQ(edges, loop.cols());
    }
    // A slot: its ends are half circles that meet straight lines of one edge.
    const OutlineCurves slot = find_curves(rounded(60, 20, 10, 9, 1, 3), exact, within);
    EXPECT_EQ(count_of(slot, Kind::arc), 2);
    EXPECT_EQ(count_of(slot, Kind::line), 2);
}

TEST(OutlineCurves, RandomOutlinesOfArcsAndLinesComeBackWithTheirRadii)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1);
    for (int trial = 0; trial < 100; ++trial) {
        // A star of straight edges, each corner rounded by a radius of its own.
        const int count = 3 + trial % 7;
        Points corner;
        for (int k = 0; k < count; ++k) {
            const double angle = 2 * pi * (k + 0.5 * any(random)) / count, far = 40 + 60 * any(random);
            corner.emplace_back(far * std::cos(angle), far * std::sin(angle));
        }
        Points points;
        std::vector<double> radii;
        bool told = true; // a corner that hardly turns is straight within the tolerance
        for (int k = 0; k < count; ++k) {
            const Eigen::Vector2d a = corner[size_t((k + count - 1) % count)], b = corner[size_t(k)],
                                  c = corner[size_t((k + 1) % count)], u = (b - a).normalized(),
                                  v = (c - b).normalized();
            const double turn = std::atan2(u[0] * v[1] - u[1] * v[0], u.dot(v));
            told &= std::abs(turn) > 0.15;
            const double room = 0.4 * std::min((b - a).norm(), (c - b).norm());
            const double radius = std::min(2 + 20 * any(random), room / std::abs(std::tan(turn / 2)));
            const Eigen::Vector2d left(-u[1], u[0]);
            const Eigen::Vector2d start = b - u * radius * std::abs(std::tan(turn / 2));
            const Eigen::Vector2d centre = start + std::copysign(radius, turn) * left;
            const Eigen::Vector2d arm = start - centre;
            const int chords = std::max(3, int(std::ceil(std::abs(turn) / 0.35)));
            add_arc(points, centre, radius, std::atan2(arm[1], arm[0]), turn, chords);
            const double last = std::atan2(arm[1], arm[0]) + turn;
            points.emplace_back(centre + radius * Eigen::Vector2d(std::cos(last), std::sin(last)));
            radii.push_back(radius);
        }
        if (!told)
            continue;
        const OutlineLoop loop = loop_of(points);
        const OutlineCurves curves = find_curves(loop, exact, within);
        std::vector<double> found;
        for (const OutlinePiece& piece : curves.pieces)
            if (piece.kind == Kind::arc) {
                const Eigen::Vector2d a = loop.col(piece.first),
                                      b = loop.col((piece.first + piece.edges) % loop.cols());
                found.push_back((a - arc_centre(a, b, piece.bulge)).norm());
            }
        ASSERT_EQ(found.size(), radii.size()) << trial;
        std::sort(found.begin(), found.end());
        std::sort(radii.begin(), radii.end());
        for (size_t k = 0; k < found.size(); ++k)
            EXPECT_NEAR(found[k], radii[k], 1e-6 * radii[k]) << trial;
    }
}

TEST(OutlineCurves, NoPointIsFartherFromItsCurveThanTheTolerance)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double tolerance : {1e-3, 0.01, 0.1}) {
        Points points;
        const double a = any(random), b = any(random);
        for (int k = 0; k < 500; ++k) {
            const double t = 2 * pi * k / 500, r = 60 + 8 * std::sin(2 * t + a) + 5 * std::sin(3 * t + b);
            points.emplace_back(r * std::cos(t), r * std::sin(t));
        }
        const OutlineLoop loop = loop_of(points);
        const OutlineCurves curves = find_curves(loop, 1e-4, tolerance);
        int drawn = 0;
        for (const OutlinePiece& piece : curves.pieces) {
            drawn += piece.kind == Kind::points ? piece.edges : 1;
            if (piece.kind != Kind::arc)
                continue;
            const Eigen::Vector2d from = loop.col(piece.first),
                                  to = loop.col((piece.first + piece.edges) % loop.cols());
            const Eigen::Vector2d centre = arc_centre(from, to, piece.bulge);
            for (int k = 0; k <= piece.edges; ++k)
                EXPECT_NEAR((loop.col((piece.first + k) % loop.cols()) - centre).norm(), (from - centre).norm(),
                            tolerance * (1 + 1e-9));
        }
        EXPECT_LT(drawn, tolerance < 0.01 ? 200 : 100) << "fewer pieces than points";
    }
}

TEST(ShopDxf, CirclesArcsAndLinesComeBackWithTheAreaOfTheShape)
{
    const ScratchFolder folder;
    const BlankDrawing drawing{{rounded(80, 50, 6, 5, 2, 1), circle(12, 18, true)}, {}, {}};
    const double plate = 80 * 50 - (4 - pi) * 36, hole = pi * 144;
    for (const DxfVersion version : {DxfVersion::r12, DxfVersion::r2000})
        for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::inch}) {
            const DxfLines read = written_and_read(folder, drawing, {.unit = unit, .version = version});
            EXPECT_TRUE(read.left_out.empty());
            ASSERT_EQ(read.lines.size(), 2u);
            EXPECT_TRUE(read.lines[0].closed && read.lines[1].closed);
            EXPECT_NEAR(area_of(read.lines[0]), plate, 1e-4 * plate) << "chords for arcs, as our reader has them";
            EXPECT_NEAR(std::abs(area_of(read.lines[1])), hole, 1e-4 * hole);
            const std::string text = content_of(folder / "x.dxf");
            EXPECT_NE(text.find(version == DxfVersion::r12 ? "AC1009" : "AC1015"), std::string::npos);
            EXPECT_EQ(text.find("AcDb") == std::string::npos, version == DxfVersion::r12) << "no marks of subclasses";
            EXPECT_NE(text.find("CIRCLE"), std::string::npos);
        }
    // Inscribed polygons are smaller.
    const DxfLines straight = written_and_read(folder, drawing, {.curves = DxfCurves::polylines});
    EXPECT_LT(std::abs(area_of(straight.lines[1])), 0.99 * hole);
}

TEST(ShopDxf, SplinesGoThroughAllPlacesAndMeetLinesAndArcsEndToEnd)
{
    const ScratchFolder folder;
    Points points;
    for (int k = 0; k <= 60; ++k)
        points.emplace_back(k, 6 * std::sin(pi * k / 30) + 0.4 * std::sin(1.1 * k));
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(60, 40), {0, 40}})
        points.emplace_back(corner);
    const OutlineLoop loop = loop_of(points);
    const DxfLines read = written_and_read(folder, {{loop}, {}, {}}, {.curves = DxfCurves::splines, .tolerance = 1e-4});
    EXPECT_NE(content_of(folder / "x.dxf").find("SPLINE"), std::string::npos);
    for (const auto p : loop.colwise()) {
        double near = 1e9;
        for (const SheetLine& line : read.lines)
            for (Eigen::Index k = 0; k + 1 < line.point.cols(); ++k) {
                const Eigen::Vector2d a = line.point.col(k).head<2>(), b = line.point.col(k + 1).head<2>();
                const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
                near = std::min(near, (a + t * (b - a) - p).norm());
            }
        EXPECT_LT(near, 3e-3) << "our reader's chords stay within 2e-5 of the extent";
    }
    // End to end: every end of an entity is that of another.
    for (const SheetLine& line : read.lines)
        for (const Eigen::Vector3d& end :
             {Eigen::Vector3d(line.point.col(0)), Eigen::Vector3d(line.point.rightCols<1>())}) {
            int meets = 0;
            for (const SheetLine& other : read.lines)
                meets += int((other.point.col(0) - end).norm() < 1e-9) +
                         int((other.point.rightCols<1>() - end).norm() < 1e-9);
            EXPECT_EQ(meets, 2);
        }
    EXPECT_THROW(
        write_dxf(folder / "y.dxf", {{loop}, {}, {}}, {.version = DxfVersion::r12, .curves = DxfCurves::splines}),
        InputError);
    EXPECT_THROW(write_dxf(folder / "y.dxf", {{loop}, {}, {}}, {.tolerance = std::nan("")}), InputError);
}

TEST(ShopDxf, ASplineThroughPointsOfACircleStaysOnItToFourthOrder)
{
    std::vector<double> off;
    for (const int chords : {24, 48}) {
        const OutlineLoop loop = circle(10, chords);
        const auto splines = smooth_splines(loop, true);
        ASSERT_EQ(splines.size(), 1u);
        EXPECT_EQ(splines[0].poles.size(), size_t(2 * chords + 2));
        EXPECT_EQ(splines[0].knots.size(), splines[0].poles.size() + 4);
        EXPECT_TRUE(std::is_sorted(splines[0].knots.begin(), splines[0].knots.end()));
        // In the middle of a piece: its four Bezier points are an end, two poles, the other end.
        const Eigen::Vector2d mid = (loop.col(0) + 3 * splines[0].poles[1] + 3 * splines[0].poles[2] + loop.col(1)) / 8;
        off.push_back(std::abs((mid - Eigen::Vector2d(7, -3)).norm() - 10));
    }
    EXPECT_GT(off[0] / off[1], 7) << "third order or better";
    EXPECT_LT(off[1], 1e-3);
}

TEST(ShopDxf, LabelsBesideBendsAreNoLinesToTheReader)
{
    const ScratchFolder folder;
    BlankDrawing drawing{{rounded(80, 50, 6, 5, 2, 1)}, {}, {}};
    DrawnBend bend{"bend 1", pi / 2, 3, 0.5, false, {}, {}};
    bend.middle = {(Eigen::Matrix2Xd(2, 2) << 40, 40, 0, 50).finished()};
    drawing.bends = {bend};
    for (const DxfVersion version : {DxfVersion::r12, DxfVersion::r2000}) {
        const DxfLines read = written_and_read(folder, drawing, {.version = version});
        EXPECT_TRUE(read.left_out.empty());
        ASSERT_EQ(read.lines.size(), 2u);
        EXPECT_EQ(read.lines[1].name, "BEND_DOWN");
        EXPECT_EQ(read.lines[1].point(0, 0), 40);
    }
    EXPECT_THROW(dxf_curves("bulges"), InputError);
    EXPECT_THROW(dxf_version("r13"), InputError);
}

/// The value of a group after a marker, from some place on.
double value_after(const std::string& text, const std::string& marker, int code, size_t from = 0)
{
    const size_t at = text.find("\n" + marker + "\n", from);
    const std::string group = fmt::format("\n{:3}\n", code);
    return at == text.npos ? std::nan("") : std::stod(text.substr(text.find(group, at + 1) + group.size()));
}

TEST(ShopDxf, ItsExtentIsThatOfTheCurves)
{
    const ScratchFolder folder;
    std::mt19937 draw(77);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    for (int i = 0; i < 30; ++i) {
        const double width = between(60, 90), height = between(30, 50), r = between(3, 14);
        const Eigen::Rotation2Dd turn(between(0, 2 * pi));
        OutlineLoop loop = rounded(width, height, r, 5, 2, int(draw() % 9));
        loop = turn.toRotationMatrix() * loop;
        Eigen::AlignedBox2d box; // of the corners' middles, and their radius around it
        for (const double x : {r, width - r})
            for (const double y : {r, height - r})
                box.extend(turn * Eigen::Vector2d(x, y));
        for (const DxfCurves curves : {DxfCurves::arcs, DxfCurves::splines}) {
            write_dxf(folder / "x.dxf", {{loop}, {}, {}}, {.curves = curves});
            const std::string text = content_of(folder / "x.dxf");
            for (const int axis : {0, 1}) {
                EXPECT_NEAR(value_after(text, "$EXTMIN", 10 * (axis + 1)), box.min()[axis] - r, 1e-4);
                EXPECT_NEAR(value_after(text, "$EXTMAX", 10 * (axis + 1)), box.max()[axis] + r, 1e-4);
            }
        }
    }
}

TEST(ShopDxf, LabelsHaveOneHeightAndAreReadFromBelowOrFromTheRight)
{
    const ScratchFolder folder;
    BlankDrawing drawing{{rounded(80, 50, 6, 5, 2, 1)}, {}, {}};
    for (const auto& [from, to] : {std::pair(Eigen::Vector2d(20, 50), Eigen::Vector2d(20 + 1e-7, 0)),
                                   {{40, 0}, {40, 20}},
                                   {{78, 25}, {60, 25.1}},
                                   {{60, 2}, {60 - 1e-7, 10}}}) {
        DrawnBend bend{"bend", pi / 2, 3, 0.5, true, {}, {}};
        bend.middle = {(Eigen::Matrix2Xd(2, 2) << from, to).finished()};
        drawing.bends.push_back(bend);
    }
    write_dxf(folder / "x.dxf", drawing, {});
    const std::string text = content_of(folder / "x.dxf");
    int labels = 0;
    double height = 0;
    for (size_t at = text.find("\nTEXT\n"); at != text.npos; at = text.find("\nTEXT\n", at + 1), ++labels) {
        const double own = value_after(text, "TEXT", 40, at), turn = value_after(text, "TEXT", 50, at);
        EXPECT_TRUE(labels == 0 || own == height);
        height = own;
        EXPECT_GT(turn, -89.9) << "upside down";
        EXPECT_LT(turn, 90.1);
    }
    EXPECT_EQ(labels, 4);
    EXPECT_GE(height, std::hypot(80, 50) / 121);
}

TEST(ShopDxf, MarksSayWhatTheyAreAndAtWhichSide)
{
    const ScratchFolder folder;
    const auto closed = [](const OutlineLoop& loop) {
        Eigen::Matrix2Xd row(2, loop.cols() + 1);
        row << loop, loop.col(0);
        return row;
    };
    using Kind = MarkLabel::Kind;
    BlankDrawing drawing{{rounded(80, 60, 5, 8, 1, 0)}};
    drawing.marks = {{closed(circle(6, 120)), {Kind::countersink, false, true, 12, 3, 6}},
                     {closed(circle(4, 120)), {Kind::counterbore, true, true, 8, 0, 5}},
                     {closed(circle(2, 120)), {Kind::mark, true, false}}};
    for (const DxfVersion version : {DxfVersion::r12, DxfVersion::r2000})
        for (const DxfCurves curves : {DxfCurves::arcs, DxfCurves::polylines}) {
            write_dxf(folder / "marks.dxf", drawing, {.version = version, .curves = curves});
            std::string text = content_of(folder / "marks.dxf");
            std::erase(text, '\r');
            const auto has = [&](const std::string& rows) { return text.find(rows) != std::string::npos; };
            const std::string data = "1001\nSPIA\n1000\nmark\n1000\n";
            EXPECT_TRUE(has(data + "countersink\n1000\nback\n1000\ndiameter\n1040\n12.0"));
            EXPECT_TRUE(has("\n1000\ndepth\n1040\n3.0"));
            EXPECT_TRUE(has(data + "counterbore\n1000\nboth\n1000\ndiameter\n1040\n8.0"));
            EXPECT_TRUE(has("hole\n1040\n6.0"));
            EXPECT_TRUE(has(data + "mark\n1000\nfront\n")) << text;
            EXPECT_TRUE(has("\n  1\ncountersink 12 x 3, back\n"));
            EXPECT_TRUE(has("\n  1\ncounterbore 8, both\n"));
            EXPECT_FALSE(has("\n  1\nmark"));
            size_t texts = 0;
            for (size_t at = 0; (at = text.find("\n  8\nMARKS_TEXT\n", at)) != std::string::npos; ++at)
                ++texts;
            EXPECT_EQ(texts, 2u);
        }
    drawing.marks.erase(drawing.marks.begin(), drawing.marks.begin() + 2);
    write_dxf(folder / "marks.dxf", drawing);
    EXPECT_EQ(content_of(folder / "marks.dxf").find("MARKS_TEXT"), std::string::npos);
}

TEST(ShopDxf, EveryObjectHasAHandleOfItsOwn)
{
    const ScratchFolder folder;
    BlankDrawing drawing{{rounded(80, 60, 5, 8, 1, 0), circle(3, 60, true)}};
    for (const bool up : {true, false}) {
        DrawnBend bend{"bend", pi / 2, 3, 0.5, up, {}, {}};
        bend.middle = {(Eigen::Matrix2Xd(2, 2) << 20, 20, 0, 60).finished()};
        bend.zone = bend.middle;
        drawing.bends.push_back(bend);
    }
    drawing.marks = {{circle(6, 120), {MarkLabel::Kind::countersink, false, true, 12, 3, 6}}};
    for (const DxfVersion version : {DxfVersion::r12, DxfVersion::r2000}) {
        write_dxf(folder / "all.dxf", drawing, {.version = version});
        std::istringstream text(content_of(folder / "all.dxf"));
        std::set<std::string> handles;
        std::string code, value, seed;
        for (bool of_seed = false; std::getline(text, code) && std::getline(text, value);) {
            const int number = std::stoi(code);
            if (number == 5 && of_seed)
                seed = value;
            else if (number == 5 || number == 105) {
                EXPECT_TRUE(handles.insert(value).second) << value << " twice";
            }
            of_seed = number == 9 && value.starts_with("$HANDSEED");
        }
        EXPECT_GT(handles.size(), 15u);
        for (const std::string& handle : handles)
            EXPECT_TRUE(seed.empty() || std::stoi(handle, nullptr, 16) < std::stoi(seed, nullptr, 16));
    }
}

} // namespace spia::shop_dxf_test

#include "app/viewer/model/picking/section.h"

#include <gtest/gtest.h>

#include "engine/report/figures/statistics.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia::viewer {

TEST(Section, ThroughALinearFieldIsThatField)
{
    const TriMesh flat = shapes::rectangle(30, 20, 7, 5);
    const Eigen::VectorXd value = (2 * flat.position.row(0) + 3 * flat.position.row(1)).transpose();
    const SectionLine line{{3, 4, 0}, {23, 11, 0}, {0, 0, -1}, false};
    const auto pieces = section(flat, value, line);
    ASSERT_GT(pieces.size(), 5u);
    const double length = (line.to - line.from).norm();
    EXPECT_NEAR(pieces.front().from_distance, 0, 1e-12);
    EXPECT_NEAR(pieces.back().to_distance, length, 1e-12);
    double covered = 0;
    for (const SectionPiece& piece : pieces) {
        covered += piece.to_distance - piece.from_distance;
        for (const auto& [place, distance, v] : {std::tuple(piece.from, piece.from_distance, piece.from_value),
                                                 std::tuple(piece.to, piece.to_distance, piece.to_value)}) {
            EXPECT_LT((place - (line.from + distance / length * (line.to - line.from))).norm(), 1e-12);
            EXPECT_NEAR(v, 2 * place[0] + 3 * place[1], 1e-12);
        }
    }
    EXPECT_NEAR(covered, length, 1e-9); // no gap, nothing twice
}

TEST(Section, OfADomeFollowsItsMeridian)
{
    shapes::Dome shape;
    shape.triangles = 4000;
    const TriMesh part = shapes::dome(shape).mesh;
    const Eigen::VectorXd height = part.position.row(2);
    const double reach = part.position.row(0).maxCoeff();
    const auto pieces = section(part, height, {{-reach, 0.1, 99}, {reach, 0.1, 99}, {0, 0, -1}, false});
    ASSERT_FALSE(pieces.empty());
    double highest = -1e9, length = 0; // of the polygon through the places on the dome
    for (const SectionPiece& piece : pieces) {
        EXPECT_NEAR(piece.from[1], 0.1, 1e-9);
        EXPECT_NEAR(piece.from_value, piece.from[2], 1e-9);
        highest = std::max(highest, piece.to_value);
        length += (piece.to - piece.from).norm();
    }
    EXPECT_NEAR(pieces.back().to_arc, length, 1e-9);
    EXPECT_GT(length, 1.01 * (pieces.back().to_distance - pieces.front().from_distance))
        << "longer than straight across";
    EXPECT_NEAR(highest, height.maxCoeff(), 0.01 * reach);
}

TEST(Section, OfAHatIsAsLongAsItsSheetAlsoDownItsWalls)
{
    // A strip with two upright walls of 10 mm, seen from above: the walls have no width along the
    // line.
    const double x[] = {0, 20, 20, 50, 50, 70}, z[] = {0, 0, 10, 10, 0, 0};
    TriMesh hat{Eigen::Matrix3Xd(3, 12), Eigen::Matrix3Xi(3, 10)};
    for (int i = 0; i < 6; ++i) {
        hat.position.col(2 * i) << x[i], 0, z[i];
        hat.position.col(2 * i + 1) << x[i], 8, z[i];
    }
    for (int i = 0; i < 5; ++i) {
        hat.triangle.col(9 - 2 * i) << 2 * i, 2 * i + 2, 2 * i + 1; // in no order
        hat.triangle.col(8 - 2 * i) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
    }
    const Eigen::VectorXd height = hat.position.row(2);
    for (const bool backwards : {false, true}) {
        const Eigen::Vector3d a(-5, 3, 30), b(75, 3, 30);
        const auto pieces = section(hat, height, {backwards ? b : a, backwards ? a : b, {0, 0, -1}, false});
        ASSERT_EQ(pieces.size(), 10u);
        EXPECT_EQ(pieces.front().from_arc, 0);
        EXPECT_NEAR(pieces.back().to_arc, 70 + 2 * 10, 1e-12);
        for (size_t k = 0; k < pieces.size(); ++k) {
            EXPECT_EQ(pieces[k].curve, 0);
            EXPECT_NEAR(pieces[k].to_arc - pieces[k].from_arc, (pieces[k].to - pieces[k].from).norm(), 1e-12);
            if (k > 0) {
                EXPECT_EQ(pieces[k].from_arc, pieces[k - 1].to_arc);
                EXPECT_LT((pieces[k].from - pieces[k - 1].to).norm(), 1e-12) << "it hangs together";
            }
        }
        const auto value_at = [&](double arc) {
            const SectionPlace at = *place_at(pieces, arc);
            return pieces[at.piece].from_value + at.share * (pieces[at.piece].to_value - pieces[at.piece].from_value);
        };
        EXPECT_NEAR(value_at(10), 0, 1e-12);
        EXPECT_NEAR(value_at(24), 4, 1e-12) << "up the wall";
        EXPECT_NEAR(value_at(45), 10, 1e-12);
        EXPECT_NEAR(value_at(67), 3, 1e-12) << "down the other";
        EXPECT_FALSE(place_at(pieces, 91) || place_at(pieces, -1));
    }
    // Unrolled it is a straight line of the same length.
    TriMesh flat = hat;
    const double unrolled[] = {0, 20, 30, 60, 70, 90};
    for (int i = 0; i < 12; ++i)
        flat.position.col(i) << unrolled[i / 2], hat.position(1, i), 0;
    const auto pieces = section(hat, height, {{-5, 3, 30}, {75, 3, 30}, {0, 0, -1}, false});
    for (const SectionPiece& piece : carried(pieces, hat, flat)) {
        EXPECT_LT((piece.from - Eigen::Vector3d(piece.from_arc, 3, 0)).norm(), 1e-9);
        EXPECT_LT((piece.to - Eigen::Vector3d(piece.to_arc, 3, 0)).norm(), 1e-9);
    }
}

TEST(Section, GoesStraightOverAHoleAndPutsLayersAboveEachOther)
{
    const TriMesh plate = shapes::rectangle(30, 20, 6, 4);
    const auto moved = [](TriMesh mesh, const Eigen::Vector3d& by) {
        mesh.position.colwise() += by;
        return mesh;
    };
    const auto both = [](const TriMesh& a, const TriMesh& b) {
        TriMesh sum{Eigen::Matrix3Xd(3, a.position.cols() + b.position.cols()),
                    Eigen::Matrix3Xi(3, a.triangle.cols() + b.triangle.cols())};
        sum.position << a.position, b.position;
        sum.triangle << a.triangle, (b.triangle.array() + a.vertices()).matrix();
        return sum;
    };
    const auto arcs = [](const TriMesh& mesh) {
        const auto pieces =
            section(mesh, Eigen::VectorXd::Zero(mesh.vertices()), {{-1, 9, 50}, {99, 9, 50}, {0, 0, -1}, false});
        std::array<std::array<double, 2>, 2> result{{{1e9, -1e9}, {1e9, -1e9}}};
        for (const SectionPiece& piece : pieces) {
            auto& [least, greatest] = result[size_t(piece.curve)];
            least = std::min(least, piece.from_arc);
            greatest = std::max(greatest, piece.to_arc);
        }
        return result;
    };
    const auto beside = arcs(both(plate, moved(plate, {42, 0, 0}))); // a gap of 12 mm
    EXPECT_NEAR(beside[0][1], 30, 1e-12);
    EXPECT_NEAR(beside[1][0], 42, 1e-12);
    EXPECT_NEAR(beside[1][1], 72, 1e-12);
    const auto above = arcs(both(plate, moved(plate, {11, 0, 5})));
    EXPECT_NEAR(above[1][0], 11, 1e-12);
    EXPECT_NEAR(above[1][1], 41, 1e-12);
}

TEST(Statistics, AHistogramSharesOutTheArea)
{
    const TriMesh flat = shapes::rectangle(30, 20, 6, 5);
    Eigen::VectorXd value(flat.triangles());
    for (int f = 0; f < flat.triangles(); ++f) // 0 on the left third, 1 on the rest
        value[f] = (flat.position(0, flat.triangle(0, f)) + flat.position(0, flat.triangle(1, f)) +
                    flat.position(0, flat.triangle(2, f))) /
                       3 >
                   10;
    const Histogram h = histogram(flat, value, 4);
    EXPECT_EQ(h.least, 0);
    EXPECT_EQ(h.greatest, 1);
    EXPECT_NEAR(h.share[0], 1. / 3, 1e-12);
    EXPECT_NEAR(h.share[3], 2. / 3, 1e-12);
    EXPECT_EQ(h.share[1] + h.share[2], 0);
}

TEST(Statistics, WorstSpotsAreTheGreatestOfTheirSurroundings)
{
    const TriMesh flat = shapes::rectangle(100, 100, 40, 40);
    Eigen::VectorXd value(flat.triangles());
    const Eigen::Vector2d peak[] = {{20, 30}, {80, 70}};
    for (int f = 0; f < flat.triangles(); ++f) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (int a = 0; a < 3; ++a)
            middle += flat.position.col(flat.triangle(a, f)).head<2>() / 3;
        value[f] =
            2 * std::exp(-(middle - peak[0]).squaredNorm() / 50) + std::exp(-(middle - peak[1]).squaredNorm() / 50);
    }
    const auto spots = worst_spots(flat, value, 2, false);
    ASSERT_EQ(spots.size(), 2u);
    EXPECT_EQ(value[spots[0]], value.maxCoeff());
    EXPECT_GT(value[spots[1]], 0.1);
    const auto near = [&](int f, const Eigen::Vector2d& at) {
        return (flat.position.col(flat.triangle(0, f)).head<2>() - at).norm();
    };
    EXPECT_LT(near(spots[0], peak[0]), 5);
    EXPECT_GT((flat.position.col(flat.triangle(0, spots[1])) - flat.position.col(flat.triangle(0, spots[0]))).norm(),
              12);
    EXPECT_EQ(value[worst_spots(flat, value, 1, true)[0]], value.minCoeff());
}

TEST(Statistics, TheThinnestTheMostSqueezedAndTheFarthestOffAreTheWorst)
{
    EXPECT_GT(badness(Field::thickness, 0.7), badness(Field::thickness, 0.9));
    EXPECT_GT(badness(Field::thinning, 20), badness(Field::thinning, -30));
    EXPECT_GT(badness(Field::strain_minor, -0.3), badness(Field::strain_minor, 0.1));
    EXPECT_GT(badness(Field::deviation, -3), badness(Field::deviation, 2));
}

} // namespace spia::viewer

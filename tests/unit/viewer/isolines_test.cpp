#include "app/viewer/views/isolines.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

const glm::dvec2 pane(800, 600);

Eigen::VectorXd values_at(const TriMesh& mesh, const std::function<double(const Eigen::Vector3d&)>& of)
{
    Eigen::VectorXd value(mesh.vertices());
    for (int v = 0; v < mesh.vertices(); ++v)
        value[v] = of(mesh.position.col(v));
    return value;
}

double length(const Isoline& line)
{
    double sum = 0;
    for (Eigen::Index i = 1; i < line.point.cols(); ++i)
        sum += (line.point.col(i) - line.point.col(i - 1)).norm();
    return sum;
}

double linear(const Eigen::Vector3d& p) { return 2 * p.x() - 3 * p.y() + 1; }

TEST(Isolines, OfALinearFieldEveryPointHasTheValueAndEachLevelIsOneLineFromBorderToBorder)
{
    TriMesh mesh = shapes::rectangle(10, 8, 9, 7);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    for (int v = 0; v < mesh.vertices(); ++v) {
        auto p = mesh.position.col(v);
        if (p.x() > 0.1 && p.x() < 9.9 && p.y() > 0.1 && p.y() < 7.9)
            p += Eigen::Vector3d(shift(random), shift(random), 0);
    }
    const std::vector<double> levels{-20.5, -7, 0.1, 9.3};
    const auto lines = isolines(mesh.position, mesh.triangle, values_at(mesh, linear), levels);
    ASSERT_EQ(lines.size(), levels.size());
    for (size_t k = 0; k < lines.size(); ++k) {
        EXPECT_EQ(lines[k].value, levels[k]);
        for (const auto point : lines[k].point.colwise())
            EXPECT_NEAR(linear(point), levels[k], 1e-12);
        const Eigen::Vector3d first = lines[k].point.leftCols<1>(), last = lines[k].point.rightCols<1>();
        EXPECT_NEAR(length(lines[k]), (last - first).norm(), 1e-12) << "a straight line does not turn back";
        for (const Eigen::Vector3d& end : {first, last})
            EXPECT_LT(std::min({end.x(), end.y(), 10 - end.x(), 8 - end.y()}), 1e-12);
    }
}

TEST(Isolines, AroundAPeakTheyCloseAndHaveTheLengthOfTheCircle)
{
    const TriMesh mesh = shapes::rectangle(20, 20, 80, 80);
    const auto value = values_at(mesh, [](const Eigen::Vector3d& p) { return std::hypot(p.x() - 10, p.y() - 10); });
    const auto lines = isolines(mesh.position, mesh.triangle, value, {3, 6});
    ASSERT_EQ(lines.size(), 2u);
    for (const Isoline& line : lines) {
        EXPECT_EQ(line.point.col(0), line.point.rightCols(1).col(0)) << "bit by bit";
        EXPECT_NEAR(length(line), 2 * M_PI * line.value, 0.02 * line.value);
    }
}

TEST(Isolines, ThroughVerticesOfJustThatValueTheyStayWhole)
{
    const TriMesh mesh = shapes::rectangle(10, 8, 10, 8); // vertices at whole numbers
    const auto value = values_at(mesh, [](const Eigen::Vector3d& p) { return p.x(); });
    const auto lines = isolines(mesh.position, mesh.triangle, value, {4});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(length(lines[0]), 8, 1e-12);
    EXPECT_TRUE(isolines(mesh.position, mesh.triangle, Eigen::VectorXd::Constant(mesh.vertices(), 4), {4}).empty());
}

TEST(Isolines, EndWhereAValueIsNoNumber)
{
    const TriMesh mesh = shapes::rectangle(10, 8, 10, 8);
    auto value = values_at(mesh, [](const Eigen::Vector3d& p) { return p.y(); });
    for (int v = 0; v < mesh.vertices(); ++v)
        if (mesh.position(0, v) == 5)
            value[v] = std::numeric_limits<double>::quiet_NaN();
    const auto lines = isolines(mesh.position, mesh.triangle, value, {2.5});
    ASSERT_EQ(lines.size(), 2u);
    for (const Isoline& line : lines)
        EXPECT_NEAR(length(line), 4, 1e-12);
}

/// Parallel lines y = 1, 2, ... on a rectangle that fills the pane: 800 x 600 pixels, 100 pixels
/// apart.
struct Ruled {
    TriMesh mesh = shapes::rectangle(8, 6, 16, 12);
    std::vector<Isoline> lines = isolines(
        mesh.position, mesh.triangle, values_at(mesh, [](const Eigen::Vector3d& p) { return p.y(); }), {1, 2, 3, 4, 5});
    Camera camera{.target = {4, 3, 0}, .height = 6, .flat = true};

    std::vector<IsolineLabel> labels(
        const Hidden& hidden = [](const glm::dvec3&) { return false; }, const std::vector<PixelBox>& taken = {}) const
    {
        const auto text = [](double value) { return std::pair(std::to_string(int(value)), glm::dvec2(30, 14)); };
        return isoline_labels(lines, camera, pane, text, hidden, taken);
    }
};

TEST(IsolineLabels, StandOnTheirLinesAFewOnEachAndApart)
{
    const Ruled ruled;
    const auto labels = ruled.labels();
    std::array<int, 6> of_level{};
    for (size_t i = 0; i < labels.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (labels[i].box.least + labels[i].box.greatest);
        const int value = std::stoi(labels[i].text);
        ++of_level[size_t(value)];
        EXPECT_NEAR(middle.y, 600 - 100 * value, 1e-6);
        EXPECT_TRUE(inside(labels[i].box, pane));
        for (size_t j = 0; j < i; ++j)
            EXPECT_FALSE(meet(grown(labels[i].box, 7), labels[j].box));
    }
    for (int value = 1; value <= 5; ++value) {
        EXPECT_GE(of_level[size_t(value)], 2);
        EXPECT_LE(of_level[size_t(value)], 4);
    }
}

TEST(IsolineLabels, AvoidWhatIsTakenOrHidden)
{
    const Ruled ruled;
    const PixelBox legend{{0, 0}, {500, 600}};
    const auto beside = ruled.labels([](const glm::dvec3&) { return false; }, {legend});
    const auto in_sight = ruled.labels([](const glm::dvec3& place) { return place.x > 300; });
    ASSERT_FALSE(beside.empty());
    ASSERT_FALSE(in_sight.empty());
    for (const IsolineLabel& label : beside)
        EXPECT_FALSE(meet(label.box, legend));
    for (const IsolineLabel& label : in_sight)
        EXPECT_LE(0.5 * (label.box.least.x + label.box.greatest.x), 300);
}

TEST(IsolineLabels, AreTheSameForTheSameViewAndFollowTheLinesIntoACorner)
{
    Ruled ruled;
    const auto once = ruled.labels(), again = ruled.labels();
    ASSERT_EQ(once.size(), again.size());
    for (size_t i = 0; i < once.size(); ++i)
        EXPECT_EQ(once[i].box.least, again[i].box.least);
    ruled.camera.target = {3.1, 2.05, 0}; // far closer than the mesh is fine: the ends of all
                                          // pieces are outside
    ruled.camera.height = 0.2;
    const auto near = ruled.labels();
    ASSERT_FALSE(near.empty());
    for (const IsolineLabel& label : near) {
        EXPECT_EQ(label.text, "2");
        EXPECT_NEAR(0.5 * (label.box.least.y + label.box.greatest.y), 300 + 0.05 * 600 / 0.2, 1e-6);
    }
}

} // namespace
} // namespace spia::viewer

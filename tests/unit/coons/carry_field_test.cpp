#include "engine/coons/carry_field.h"

#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia {
namespace {

/// A plate 12 x 9 with a square hole in its middle, faces left out of a rectangle.
TriMesh plate_with_hole()
{
    TriMesh whole = shapes::rectangle(12, 9, 24, 18);
    std::vector<int> kept;
    for (int f = 0; f < whole.triangles(); ++f) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            middle += whole.position.col(whole.triangle(k, f)) / 3;
        if ((middle.head<2>() - Eigen::Vector2d(6, 4.5)).cwiseAbs().maxCoeff() > 2)
            kept.push_back(f);
    }
    TriMesh part;
    std::vector<int> number(size_t(whole.vertices()), -1);
    std::vector<int> used;
    part.triangle.resize(3, Eigen::Index(kept.size()));
    for (size_t f = 0; f < kept.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            int& n = number[size_t(whole.triangle(k, kept[f]))];
            if (n < 0) {
                n = int(used.size());
                used.push_back(whole.triangle(k, kept[f]));
            }
            part.triangle(k, Eigen::Index(f)) = n;
        }
    part.position.resize(3, Eigen::Index(used.size()));
    for (size_t v = 0; v < used.size(); ++v)
        part.position.col(Eigen::Index(v)) = whole.position.col(used[v]);
    return part;
}

/// The middle of every face, those of the fill too.
std::vector<MeshPoint> middles(const FilledMesh& filled)
{
    std::vector<MeshPoint> places;
    for (int f = 0; f < filled.mesh.triangles(); ++f)
        places.push_back({f, Eigen::Vector3d(0.2, 0.3, 0.5), 0});
    return places;
}

double at(const FilledMesh& filled, const MeshPoint& place, int axis)
{
    double result = 0;
    for (int k = 0; k < 3; ++k)
        result += place.barycentric[k] * filled.mesh.position(axis, filled.mesh.triangle(k, place.face));
    return result;
}

TEST(CarryField, IsLinearOverFacesAndStaysBetweenTheEdgeValuesOverAHole)
{
    const TriMesh part = plate_with_hole();
    const FilledMesh filled = fill_holes(part, part.position.topRows<2>());
    ASSERT_EQ(filled.holes, 1);
    ASSERT_GT(filled.mesh.vertices(), filled.part_vertices);
    const auto places = middles(filled);
    const Eigen::VectorXd x = part.position.row(0).transpose();
    const Eigen::VectorXd carried = carry_field(filled, x, places);
    double low = 1e9, high = -1e9;
    for (size_t n = 0; n < places.size(); ++n) {
        if (!filled.is_fill(places[n].face))
            EXPECT_NEAR(carried[Eigen::Index(n)], at(filled, places[n], 0), 1e-13);
        else {
            low = std::min(low, carried[Eigen::Index(n)]);
            high = std::max(high, carried[Eigen::Index(n)]);
            EXPECT_NEAR(carried[Eigen::Index(n)], at(filled, places[n], 0), 0.5) << "near the linear field";
        }
    }
    EXPECT_GT(low, 4 - 1e-9); // the hole reaches from 4 to 8
    EXPECT_LT(low, 4.5);
    EXPECT_LT(high, 8 + 1e-9);
    EXPECT_GT(high, 7.5);
    EXPECT_TRUE(carry_field(filled, Eigen::VectorXd::Constant(part.vertices(), 0.8), places).isConstant(0.8, 1e-12));
}

TEST(CarryField, RefusesWhatDoesNotFit)
{
    const TriMesh part = plate_with_hole();
    const FilledMesh filled = fill_holes(part, part.position.topRows<2>());
    EXPECT_THROW(carry_field(filled, Eigen::VectorXd::Ones(3), {}), InputError);
    Eigen::VectorXd values = Eigen::VectorXd::Ones(part.vertices());
    EXPECT_THROW(carry_field(filled, values, {MeshPoint{}}), InputError);
    values[7] = std::nan("");
    EXPECT_THROW(carry_field(filled, values, {}), InputError);
}

} // namespace
} // namespace spia

#include "engine/nurbs/multi_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "engine/core/error.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/joined_patches.h"

namespace spia {
namespace {

/// The parameters of a place on a side.
Eigen::Vector2d on(Side side, double t)
{
    switch (side) {
    case Side::v0: return {t, 0};
    case Side::u1: return {1, t};
    case Side::v1: return {t, 1};
    case Side::u0: return {0, t};
    }
    return {};
}

std::string refusal(const MultiPatch& patches)
{
    try {
        require_watertight(patches);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

MultiPatch two_reversed()
{
    for (const patches::Sample& each : patches::samples())
        if (each.name == "rational two reversed")
            return each.patches;
    return {};
}

TEST(MultiPatch, ControlsOfASideAreThoseOfItsCurve)
{
    const NurbsSurface s = patches::curved(300, true);
    for (const Side side : sides) {
        NurbsSurface curve; // the side's curve, drawn out to a surface along x
        curve.degree_u = side_degree(s, side);
        curve.knots_u = side_knots(s, side);
        curve.degree_v = 1;
        curve.count_v = 2;
        curve.knots_v = {0, 0, 1, 1};
        const std::vector<int> row = side_controls(s, side);
        curve.count_u = int(row.size());
        curve.control.resize(3, 2 * curve.count_u);
        curve.weight.resize(2 * curve.count_u);
        for (int k = 0; k < 2 * curve.count_u; ++k) {
            curve.control.col(k) =
                s.control.col(row[size_t(k % curve.count_u)]) + k / curve.count_u * Eigen::Vector3d::UnitX();
            curve.weight[k] = s.weight[row[size_t(k % curve.count_u)]];
        }
        for (const double t : {0., 0.17, 0.5, 0.83, 1.}) {
            const Eigen::Vector2d at = on(side, t);
            EXPECT_LT((evaluate(curve, t, 0).position - evaluate(s, at.x(), at.y()).position).norm(), 1e-11);
        }
    }
}

TEST(MultiPatch, InterfacesAreFoundAndMeetAtEveryPlace)
{
    for (const patches::Sample& each : patches::samples()) {
        SCOPED_TRACE(each.name);
        EXPECT_EQ(refusal(each.patches), "");
        const MultiPatch found = joined(each.patches.patch);
        ASSERT_EQ(found.interfaces.size(), each.patches.interfaces.size());
        for (const PatchInterface& wanted : each.patches.interfaces)
            EXPECT_TRUE(std::any_of(found.interfaces.begin(), found.interfaces.end(), [&](const PatchInterface& i) {
                return i == wanted || i == PatchInterface{wanted.second, wanted.first, wanted.reversed};
            })) << name(wanted.first);
        EXPECT_EQ(outer_sides(found).size(), 4 * found.patch.size() - 2 * found.interfaces.size());
        for (const PatchInterface& joint : found.interfaces)
            for (int k = 0; k <= 10000; ++k) {
                const double t = k / 10000.;
                const Eigen::Vector2d a = on(joint.first.side, t),
                                      b = on(joint.second.side, joint.reversed ? 1 - t : t);
                const Eigen::Vector3d x = evaluate(found.patch[size_t(joint.first.patch)], a.x(), a.y()).position,
                                      y = evaluate(found.patch[size_t(joint.second.patch)], b.x(), b.y()).position;
                // The same numbers, summed in another order where the parameters run against each
                // other.
                ASSERT_LE((x - y).norm(), 1e-12 * 400) << t;
            }
    }
}

TEST(MultiPatch, OuterSidesComeInTheOrderOfPatchesAndSides)
{
    const std::vector<PatchSide> outer = outer_sides(two_reversed());
    const std::vector<PatchSide> wanted = {{0, Side::v0}, {0, Side::v1}, {0, Side::u0},
                                           {1, Side::v0}, {1, Side::u1}, {1, Side::v1}};
    EXPECT_EQ(outer, wanted);
}

TEST(MultiPatch, RefusesWhatIsNotOneCurveAndSaysWhere)
{
    const MultiPatch good = two_reversed();
    EXPECT_EQ(refusal(good), "");
    const auto says = [](const MultiPatch& patches, const char* what) {
        const std::string text = refusal(patches);
        EXPECT_NE(text.find(what), std::string::npos) << text;
    };
    MultiPatch bad = good;
    bad.interfaces[0].reversed = false;
    says(bad, "not the same curve");
    bad = good;
    double& x = bad.patch[1].control(0, bad.patch[1].index(0, 2));
    x = std::nextafter(x, 1e9);
    says(bad, "side u = 1 of patch 1 and side u = 0 of patch 2");
    says(bad, "control point 3 along the first"); // the second row runs the other way, of six
    bad = good;
    bad.patch[0].weight[bad.patch[0].index(6, 1)] += 1e-12;
    says(bad, "weights");
    bad = good;
    bad.patch[1].knots_v[4] += 1e-12;
    says(bad, "knot");
    bad = good;
    bad.interfaces[0].second.side = Side::v0;
    says(bad, "degrees");
    bad = good;
    bad.interfaces[0].second.patch = 2;
    says(bad, "names patch 3, but there are 2");
    bad = good;
    bad.interfaces.push_back(bad.interfaces[0]);
    says(bad, "two interfaces");
}

TEST(MultiPatch, ThreeSidesOnOneCurveAreRefused)
{
    const NurbsSurface left = patches::curved(300, false), right = patches::beyond(left);
    EXPECT_THROW(joined({left, right, right}), InputError);
}

TEST(MultiPatch, ASideThatIsAPointJoinsNothing)
{
    NurbsSurface fan = patches::curved(300, false);
    for (const int c : side_controls(fan, Side::v0))
        fan.control.col(c).setZero();
    EXPECT_TRUE(joined({fan}).interfaces.empty());
    const MultiPatch two = joined({fan, patches::beyond(fan)});
    EXPECT_EQ(two.interfaces.size(), 1u);
}

NurbsSurface flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                  const Eigen::Vector3d& d)
{
    NurbsSurface patch;
    patch.degree_u = patch.degree_v = 1;
    patch.count_u = patch.count_v = 2;
    patch.knots_u = patch.knots_v = {0, 0, 1, 1};
    patch.control.resize(3, 4);
    patch.control << a, b, d, c;
    patch.weight.setOnes(4);
    return patch;
}

TEST(MultiPatch, SingularNodesAreInnerCornersOfOtherThanFourPatches)
{
    // A polygon is cut into one patch per corner, that meet at its middle. The ring around these
    // makes its corners inner ones of three patches, the middles of its sides of four.
    for (const int corners : {3, 4, 5, 8}) {
        const auto at = [&](double turns, double radius) -> Eigen::Vector3d {
            const double angle = 2 * std::numbers::pi * turns / corners;
            return {radius * std::cos(angle), radius * std::sin(angle), 0};
        };
        std::vector<NurbsSurface> parts;
        for (int k = 0; k < corners; ++k) {
            const Eigen::Vector3d before = at((k + corners - 1) % corners + 0.5, 1), after = at(k + 0.5, 1);
            parts.push_back(flat(at(0, 0), before, at(k, 1.2), after));
            parts.push_back(flat(before, 2 * before, 2 * at(k, 1.2), at(k, 1.2)));
            parts.push_back(flat(at(k, 1.2), 2 * at(k, 1.2), 2 * after, after));
        }
        const MultiPatch polygon = joined(parts);
        ASSERT_EQ(polygon.interfaces.size(), size_t(5 * corners));
        EXPECT_EQ(singular_nodes(polygon), corners + (corners == 4 ? 0 : 1)) << corners << " corners";
    }
    // A closed surface: Euler's formula asks for the sum of 4 - patches at a node to be 8.
    const auto corner = [](int k) { return Eigen::Vector3d(k & 1, (k >> 1) & 1, k >> 2); };
    std::vector<NurbsSurface> faces;
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        faces.push_back(flat(corner(a), corner(b), corner(c), corner(d)));
    EXPECT_EQ(singular_nodes(joined(faces)), 8);
    EXPECT_EQ(singular_nodes(joined({faces[0]})), 0);
}

} // namespace
} // namespace spia

#include "engine/nurbs/multi_patch.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

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

} // namespace
} // namespace spia

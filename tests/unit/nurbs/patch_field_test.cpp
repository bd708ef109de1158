#include "engine/nurbs/patch_field.h"

#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/interpolate.h"
#include "tests/support/joined_patches.h"
#include "tests/support/known_surfaces.h"

namespace spia::patch_field_test {
namespace {

/// What the field has at the lines of a grid.
Eigen::VectorXd at_lines(const NurbsSurface& surface, const Eigen::VectorXd& value, const std::vector<double>& u,
                         const std::vector<double>& v)
{
    Eigen::VectorXd result(Eigen::Index(u.size() * v.size()));
    for (size_t j = 0; j < v.size(); ++j)
        for (size_t i = 0; i < u.size(); ++i)
            result[Eigen::Index(i + j * u.size())] = evaluate_field(surface, value, u[i], v[j]);
    return result;
}

/// Means of neighbouring knots: one parameter per control point, as interpolation wants them.
std::vector<double> greville(const std::vector<double>& knots, int degree)
{
    std::vector<double> result;
    for (size_t k = 1; k + size_t(degree) < knots.size(); ++k) {
        double sum = 0;
        for (int d = 0; d < degree; ++d)
            sum += knots[k + size_t(d)];
        result.push_back(sum / degree);
    }
    return result;
}

std::vector<double> even(int count)
{
    std::vector<double> result;
    for (int i = 0; i < count; ++i)
        result.push_back(double(i) / (count - 1));
    return result;
}

TEST(PatchField, OfTheCoordinatesIsTheSurface)
{
    const NurbsSurface s = surfaces::crooked();
    for (const auto& [u, v] : {std::pair{0., 0.}, {0.3, 0.7}, {0.55, 0.3}, {1., 0.2}, {-1., 2.}})
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(evaluate_field(s, s.control.row(k).transpose(), u, v), evaluate(s, u, v).position[k], 1e-12);
}

TEST(PatchField, FitGivesBackTheControlValuesOfAFieldOnTheBasis)
{
    const NurbsSurface s = surfaces::crooked(); // rational, a double knot
    Eigen::VectorXd wanted(s.control.cols());
    for (int c = 0; c < wanted.size(); ++c)
        wanted[c] = 0.8 + 0.1 * std::sin(4. * c);
    const auto u = greville(s.knots_u, s.degree_u), v = greville(s.knots_v, s.degree_v);
    EXPECT_LT((fit_field(s, u, v, at_lines(s, wanted, u, v)) - wanted).norm(), 1e-12) << "as many values as controls";
    const auto many_u = even(31), many_v = even(23);
    EXPECT_LT((fit_field(s, many_u, many_v, at_lines(s, wanted, many_u, many_v)) - wanted).norm(), 1e-7)
        << "least squares";
}

TEST(PatchField, TakesTheValuesOfTheNodesOfAnInterpolatedGrid)
{
    const QuadGrid grid = surfaces::grid(9, 6, [](double s, double t) {
        return Eigen::Vector3d(90 * s * s + 20 * s, 60 * t + 5 * s, 8 * std::sin(3 * s + t));
    });
    Eigen::VectorXd thickness(grid.nodes());
    for (int n = 0; n < grid.nodes(); ++n)
        thickness[n] = 1 - 0.002 * grid.position(2, n) * std::cos(0.3 * n);
    for (const auto ends : {InterpolateOptions::Ends::averaged_knots, InterpolateOptions::Ends::natural}) {
        InterpolateOptions options;
        options.ends = ends;
        const InterpolateResult fitted = interpolate(grid, options);
        const Eigen::VectorXd value = fit_field(fitted.surface, fitted.u, fitted.v, thickness);
        const double error =
            (at_lines(fitted.surface, value, fitted.u, fitted.v) - thickness).lpNorm<Eigen::Infinity>();
        EXPECT_LT(error, ends == InterpolateOptions::Ends::natural ? 1e-7 : 1e-13);
    }
}

TEST(PatchField, OfAHeightThatIsInterpolatedIsTheHeightOfTheSurface)
{
    // The surface's own matrices: its z at the nodes must give its z control values.
    const QuadGrid grid = surfaces::grid(
        8, 5, [](double s, double t) { return Eigen::Vector3d(100 * s, 70 * t, 10 * std::cos(4 * s) * t); });
    const InterpolateResult fitted = interpolate(grid);
    const Eigen::VectorXd z = fit_field(fitted.surface, fitted.u, fitted.v, grid.position.row(2).transpose());
    EXPECT_LT((z - fitted.surface.control.row(2).transpose()).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(PatchField, MeanIsOverTheArea)
{
    // z over a quarter of a cylinder of radius r: mean height 2 r / pi, though the parameters are
    // uneven.
    const NurbsSurface s = surfaces::quarter_cylinder(30, 50);
    EXPECT_NEAR(field_mean(s, s.control.row(2).transpose()), 2 * 30 / M_PI, 1e-3);
    EXPECT_NEAR(field_mean(s, Eigen::VectorXd::Constant(6, 0.8)), 0.8, 1e-15);
    NurbsSurface uneven = patches::curved(100, false); // a plane with the speed of its parameter
                                                       // along u rising
    for (int j = 0; j < uneven.count_v; ++j)
        for (int i = 0; i < uneven.count_u; ++i)
            uneven.control.col(uneven.index(i, j)) << i * i, 10 * j, 0;
    EXPECT_NEAR(field_mean(uneven, uneven.control.row(0).transpose()), 18, 1e-12);
}

TEST(PatchField, ASideDependsOnItsValuesAlone)
{
    const NurbsSurface s = patches::curved(200, false);
    const auto u = even(20), v = even(17);
    Eigen::VectorXd nodes = Eigen::VectorXd::LinSpaced(20 * 17, 0, 3).array().sin();
    const Eigen::VectorXd before = fit_field(s, u, v, nodes);
    for (int j = 1; j < 16; ++j)
        for (int i = 1; i < 19; ++i)
            nodes[i + 20 * j] += 0.1 * i;
    const Eigen::VectorXd after = fit_field(s, u, v, nodes);
    EXPECT_GT((after - before).norm(), 0.1);
    for (const Side side : sides)
        for (const int c : side_controls(s, side))
            EXPECT_NEAR(after[c], before[c], 1e-14);
}

TEST(PatchField, BordersAreSharedToTheLastBit)
{
    for (const patches::Sample& each : patches::samples()) {
        SCOPED_TRACE(each.name);
        PatchField field{"thickness", "mm", {}};
        for (const NurbsSurface& patch : each.patches.patch) // a function of the place
            field.value.push_back((patch.control.row(0) / 100).array().sin().transpose());
        EXPECT_NO_THROW(require_field(each.patches, field));
        const PatchField exact = field;
        if (each.patches.interfaces.empty())
            continue;
        // Every patch by a rounding of its own.
        for (size_t p = 0; p < field.value.size(); ++p)
            field.value[p].array() += 1e-14 * double(p);
        EXPECT_THROW(require_field(each.patches, field), InputError);
        share_borders(each.patches, field);
        EXPECT_NO_THROW(require_field(each.patches, field));
        for (size_t p = 0; p < field.value.size(); ++p)
            EXPECT_LT((field.value[p] - exact.value[p]).lpNorm<Eigen::Infinity>(), 1e-12);
        field.value[1].array() += 0.01;
        EXPECT_THROW(share_borders(each.patches, field), InputError) << "a jump is not rounding";
    }
}

TEST(PatchField, RefusesWhatDoesNotFit)
{
    const NurbsSurface s = patches::curved(200, false);
    const auto u = even(9), v = even(8);
    EXPECT_THROW(fit_field(s, u, v, Eigen::VectorXd::Ones(71)), InputError);
    Eigen::VectorXd nodes = Eigen::VectorXd::Ones(72);
    nodes[5] = std::nan("");
    EXPECT_THROW(fit_field(s, u, v, nodes), InputError);
    EXPECT_THROW(require_field({{s}, {}}, {"thickness", "mm", {Eigen::VectorXd::Ones(3)}}), InputError);
    EXPECT_THROW(require_field({{s}, {}}, {"thickness", "mm", {}}), InputError);
}

TEST(SharedControls, CountWhatIsSharedOnce)
{
    for (const patches::Sample& each : patches::samples()) {
        SCOPED_TRACE(each.name);
        const SharedControls shared = shared_controls(each.patches);
        // The same place, the same number; the samples have no two control points at one place for
        // another reason.
        std::vector<Eigen::Vector3d> place(size_t(shared.count), Eigen::Vector3d::Constant(std::nan("")));
        int different = 0;
        for (int p = 0; p < int(each.patches.patch.size()); ++p)
            for (int c = 0; c < int(each.patches.patch[size_t(p)].control.cols()); ++c) {
                Eigen::Vector3d& known = place[size_t(shared.of(p, c))];
                const Eigen::Vector3d here = each.patches.patch[size_t(p)].control.col(c);
                if (std::isnan(known.x())) {
                    for (const Eigen::Vector3d& other : place)
                        EXPECT_TRUE(other != here);
                    known = here;
                    ++different;
                } else
                    EXPECT_EQ(known, here);
            }
        EXPECT_EQ(different, shared.count);
    }
}

} // namespace
} // namespace spia::patch_field_test

#include "engine/nurbs/anderson_mixing.h"

#include <cmath>
#include <gtest/gtest.h>

namespace spia {
namespace {

using Eigen::VectorXd;

/// x -> rate x + (1 - rate) x*, per component, coupled by a reflection so that no coordinate stands
/// alone.
struct Creeping {
    VectorXd rate{{0.999, 0.99, 0.9, -0.5, 0.3}}, fixed_point{{1, -2, 3, 5, 8}};
    VectorXd direction = VectorXd::Ones(5) / std::sqrt(5.);

    VectorXd reflected(const VectorXd& x) const { return x - 2 * direction.dot(x) * direction; }
    VectorXd operator()(const VectorXd& x) const
    {
        return fixed_point + reflected(rate.cwiseProduct(reflected(x - fixed_point)));
    }
};

double error_after(int steps, const Creeping& g, AndersonMixing* mixing)
{
    VectorXd x = VectorXd::Zero(5);
    for (int k = 0; k < steps; ++k)
        x = mixing ? mixing->next(x, g(x)) : g(x);
    return (x - g.fixed_point).norm();
}

} // namespace

TEST(AndersonMixing, ReachesTheFixedPointOfALinearMapInAsManyStepsAsItHasDimensions)
{
    const Creeping g;
    AndersonMixing mixing(5);
    EXPECT_LT(error_after(7, g, &mixing), 1e-8);
    EXPECT_GT(error_after(7, g, nullptr), 1) << "plain steps creep";
    AndersonMixing shallow(1);
    EXPECT_GT(error_after(7, g, &shallow), 1e-4) << "with less memory it takes longer";
}

TEST(AndersonMixing, KeepsWhatIsLinearInAllImages)
{
    // All images have the same sum: so has what is mixed from them.
    const auto g = [](const VectorXd& x) {
        VectorXd y = (0.5 * x.array() + 0.3 * x.array().sin()).matrix();
        return VectorXd(y.array() + (4 - y.sum()) / double(y.size()));
    };
    AndersonMixing mixing(3);
    VectorXd x = VectorXd::LinSpaced(6, -3, 5);
    for (int k = 0; k < 14; ++k) {
        x = mixing.next(x, g(x));
        EXPECT_NEAR(x.sum(), 4, 1e-12) << k;
    }
    EXPECT_LT((g(x) - x).norm(), 1e-6);
}

TEST(AndersonMixing, ForgetsAnotherMap)
{
    const Creeping g;
    AndersonMixing mixing(5);
    error_after(4, g, &mixing);
    mixing.forget();
    const VectorXd x = VectorXd::Constant(5, 7);
    EXPECT_EQ(mixing.next(x, g(x)), g(x)) << "the first step is a plain one";
}

} // namespace spia

#include "engine/nurbs/basis.h"

#include <gtest/gtest.h>

namespace spia {

namespace {

/// Clamped, uneven, with a knot of full inner multiplicity for the lower degrees.
std::vector<double> knots_of_degree(int degree)
{
    std::vector<double> knots(size_t(degree) + 1, 0);
    for (double inner : {0.1, 0.35, 0.35, 0.7, 0.95})
        knots.push_back(inner);
    knots.insert(knots.end(), size_t(degree) + 1, 1);
    return knots;
}

/// Function i at u, straight from its definition (Cox - de Boor, 0/0 = 0), the slow way.
double function_by_definition(const std::vector<double>& t, int i, int d, double u)
{
    if (d == 0)
        return t[size_t(i)] <= u && u < t[size_t(i) + 1];
    const double rise = t[size_t(i + d)] - t[size_t(i)], fall = t[size_t(i + d) + 1] - t[size_t(i) + 1];
    return (rise > 0 ? (u - t[size_t(i)]) / rise * function_by_definition(t, i, d - 1, u) : 0) +
           (fall > 0 ? (t[size_t(i + d) + 1] - u) / fall * function_by_definition(t, i + 1, d - 1, u) : 0);
}

} // namespace

TEST(Basis, SpansAreNeverEmptyAndTheEndBelongsToTheLastOne)
{
    const std::vector<double> knots = knots_of_degree(3); // 0 0 0 0 0.1 0.35 0.35 0.7 0.95 1 1 1 1
    EXPECT_EQ(find_span(knots, 3, 0), 3);
    EXPECT_EQ(find_span(knots, 3, 0.1), 4);
    EXPECT_EQ(find_span(knots, 3, 0.2), 4);
    EXPECT_EQ(find_span(knots, 3, 0.35), 6);
    EXPECT_EQ(find_span(knots, 3, 0.94), 7);
    EXPECT_EQ(find_span(knots, 3, 1), 8);
    EXPECT_EQ(find_span(knots, 3, -1), 3) << "before the domain";
    EXPECT_EQ(find_span(knots, 3, 2), 8) << "beyond the domain";
    EXPECT_EQ(span_borders(knots, 3), (std::vector<double>{0, 0.1, 0.35, 0.7, 0.95, 1}));
}

TEST(Basis, FunctionsAreThoseOfTheDefinition)
{
    for (int degree = 1; degree <= 5; ++degree) {
        const std::vector<double> knots = knots_of_degree(degree);
        for (int i = 0; i < 100; ++i) {
            const double u = i / 100.;
            const BasisValues N = basis(knots, degree, u);
            for (int k = 0; k <= degree; ++k)
                EXPECT_NEAR(N.value[size_t(k)], function_by_definition(knots, N.first + k, degree, u), 1e-14)
                    << "degree " << degree << " u " << u << " function " << N.first + k;
        }
    }
}

TEST(Basis, FunctionsSumToOneAndTheirDerivativesToNothing)
{
    for (int degree = 1; degree <= max_degree; ++degree)
        for (int i = 0; i <= 200; ++i) {
            const BasisValues N = basis(knots_of_degree(degree), degree, i / 200.);
            double sum = 0, first = 0, second = 0, size = 0;
            for (int k = 0; k <= degree; ++k) {
                EXPECT_GE(N.value[size_t(k)], 0);
                sum += N.value[size_t(k)];
                first += N.first_derivative[size_t(k)];
                second += N.second_derivative[size_t(k)];
                size += std::abs(N.second_derivative[size_t(k)]);
            }
            EXPECT_NEAR(sum, 1, 1e-14);
            EXPECT_NEAR(first, 0, 1e-11);
            EXPECT_NEAR(second, 0, 1e-13 * (1 + size));
        }
}

TEST(Basis, DerivativesAreTheLimitsOfDifferences)
{
    for (int degree = 1; degree <= 5; ++degree) {
        const std::vector<double> knots = knots_of_degree(degree);
        for (double u : {0.03, 0.2, 0.5, 0.8, 0.97}) { // inside of spans
            const double h = 1e-4;
            const BasisValues N = basis(knots, degree, u), before = basis(knots, degree, u - h),
                              after = basis(knots, degree, u + h);
            for (size_t k = 0; k <= size_t(degree); ++k) {
                // the differences are off by h^2 / 6 and h^2 / 12 of derivatives that are below 1e7
                const double first = (after.value[k] - before.value[k]) / (2 * h);
                const double second = (after.first_derivative[k] - before.first_derivative[k]) / (2 * h);
                EXPECT_NEAR(N.first_derivative[k], first, 1e-4 * (1 + std::abs(first)));
                EXPECT_NEAR(N.second_derivative[k], second, 1e-3 * (1 + std::abs(second)));
            }
        }
    }
}

} // namespace spia

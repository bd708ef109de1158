#include "engine/forming/material/fit_hardening.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <limits>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "engine/core/error.h"
#include "engine/core/small_dense.h"

namespace spia {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A law as columns with coefficients >= 0 (MPa), which depend on one or two numbers.
struct Family {
    std::string name;
    int parameters;
    std::vector<std::pair<double, double>> range; ///< of the numbers
    std::function<MatrixXd(const VectorXd& strain, const VectorXd& number)> columns;
    std::function<Hardening(const VectorXd& number, const VectorXd& coefficient)> law;
};

MatrixXd beside_ones(const VectorXd& column)
{
    MatrixXd both(column.size(), 2);
    both << VectorXd::Ones(column.size()), column;
    return both;
}

const std::vector<Family>& families()
{
    // Numbers that span decades are searched in logarithms.
    static const std::pair<double, double> n{0.01, 0.98}, ln_e0{std::log(1e-6), std::log(0.5)},
        ln_c{std::log(0.05), std::log(900)}, p{0.06, 1};
    static const std::vector<Family> all = {
        {"swift",
         3,
         {ln_e0, n},
         [](const VectorXd& x, const VectorXd& q) -> MatrixXd { return (x.array() + std::exp(q[0])).pow(q[1]); },
         [](const VectorXd& q, const VectorXd& k) {
             return Swift{k[0], std::exp(q[0]), q[1]};
         }},
        {"hollomon",
         2,
         {n},
         [](const VectorXd& x, const VectorXd& q) -> MatrixXd { return x.array().pow(q[0]); },
         [](const VectorXd& q, const VectorXd& k) {
             return Hollomon{k[0], q[0]};
         }},
        {"voce",
         3,
         {ln_c},
         [](const VectorXd& x, const VectorXd& q) { return beside_ones(1 - (-std::exp(q[0]) * x.array()).exp()); },
         [](const VectorXd& q, const VectorXd& k) {
             return Voce{k[0], k[0] + k[1], std::exp(q[0])};
         }},
        {"ludwik",
         3,
         {n},
         [](const VectorXd& x, const VectorXd& q) { return beside_ones(x.array().pow(q[0])); },
         [](const VectorXd& q, const VectorXd& k) {
             return Ludwik{k[0], k[1], q[0]};
         }},
        {"hockett_sherby",
         4,
         {ln_c, p},
         [](const VectorXd& x, const VectorXd& q) {
             return beside_ones(1 - (-std::exp(q[0]) * x.array().pow(q[1])).exp());
         },
         [](const VectorXd& q, const VectorXd& k) {
             return HockettSherby{k[0], k[0] + k[1], std::exp(q[0]), q[1]};
         }},
    };
    return all;
}

/// Least squares with coefficients >= 0 for one or two columns.
VectorXd coefficients(const MatrixXd& columns, const VectorXd& stress)
{
    const VectorXd free = least_squares(columns, stress);
    if (free.size() == 1 || (free.minCoeff() >= 0 && free.allFinite()))
        return free;
    VectorXd best;
    for (Index keep = 0; keep < 2; ++keep) {
        VectorXd one = VectorXd::Zero(2);
        one[keep] = columns.col(keep).dot(stress) / columns.col(keep).squaredNorm();
        if (best.size() == 0 || (columns * one - stress).norm() < (columns * best - stress).norm())
            best = one;
    }
    return best;
}

/// What is left of the stress for given numbers; those are kept in their ranges by a logistic map
/// of free ones.
struct Residual : Eigen::DenseFunctor<double> {
    Residual(const Family& of, const VectorXd& x, const VectorXd& y)
        : DenseFunctor(int(of.range.size()), int(x.size())), family(of), strain(x), stress(y)
    {
    }

    VectorXd numbers(const VectorXd& free) const
    {
        VectorXd q(free.size());
        for (Index i = 0; i < free.size(); ++i) {
            const auto [low, high] = family.range[size_t(i)];
            q[i] = low + (high - low) / (1 + std::exp(-free[i]));
        }
        return q;
    }

    int operator()(const VectorXd& free, VectorXd& left) const
    {
        const MatrixXd columns = family.columns(strain, numbers(free));
        left = columns * coefficients(columns, stress) - stress;
        return 0;
    }

    int df(const VectorXd& free, MatrixXd& slope) const // central differences
    {
        constexpr double d = 1e-5;
        VectorXd above, below;
        for (Index i = 0; i < free.size(); ++i) {
            (*this)(free + d * VectorXd::Unit(free.size(), i), above);
            (*this)(free - d * VectorXd::Unit(free.size(), i), below);
            slope.col(i) = (above - below) / (2 * d);
        }
        return 0;
    }

    const Family& family;
    const VectorXd &strain, &stress;
};

VectorXd best_of_a_grid(const Residual& residual)
{
    constexpr int steps = 12;
    constexpr double far = 4; // logistic(4) = 0.98 of the range
    VectorXd best, left;
    double least = std::numeric_limits<double>::infinity();
    const int second = residual.inputs() > 1 ? steps : 0;
    for (int i = 0; i <= steps; ++i)
        for (int k = 0; k <= second; ++k) {
            VectorXd free(residual.inputs());
            free[0] = far * (2.0 * i / steps - 1);
            if (second)
                free[1] = far * (2.0 * k / steps - 1);
            residual(free, left);
            if (left.squaredNorm() < least) {
                least = left.squaredNorm();
                best = free;
            }
        }
    return best;
}

double rms(const Hardening& law, const VectorXd& strain, const VectorXd& stress)
{
    double sum = 0;
    for (Index i = 0; i < strain.size(); ++i)
        sum += std::pow(flow_stress(law, strain[i]).stress - stress[i], 2);
    return std::sqrt(sum / double(strain.size()));
}

LawFit scored(LawFit fit, const VectorXd& strain, const VectorXd& stress)
{
    if (!fit.law)
        return fit;
    const double points = double(strain.size()), rounding = 1e-9 * stress.mean();
    fit.rms_MPa = rms(*fit.law, strain, stress);
    fit.score = 2 * points * std::log(std::max(fit.rms_MPa, rounding)) + fit.parameters * std::log(points);
    return fit;
}

LawFit fit_family(const Family& family, const VectorXd& strain, const VectorXd& stress)
{
    Residual residual(family, strain, stress);
    VectorXd free = best_of_a_grid(residual);
    Eigen::LevenbergMarquardt<Residual> solver(residual);
    solver.minimize(free);
    const VectorXd q = residual.numbers(free), k = coefficients(family.columns(strain, q), stress);
    LawFit fit{family.name, {}, {}, 0, family.parameters, 0};
    constexpr double huge_MPa = 1e5; // what a material file may hold
    const double tiny_MPa = 1e-6 * stress.mean();
    if (!(k[0] > tiny_MPa))
        fit.reason = "its stress at strain 0 comes out as 0";
    else if (k.size() > 1 && !(k[1] > tiny_MPa))
        fit.reason = "the curve does not harden as this law does";
    else if (!(k.sum() < huge_MPa))
        fit.reason = "the curve shows no saturation";
    else
        fit.law = family.law(q, k);
    return fit;
}

LawFit mixture(const LawFit& swift, const LawFit& voce, const VectorXd& strain, const VectorXd& stress)
{
    LawFit fit{"swift_voce", {}, {}, 0, 7, 0};
    if (!swift.law || !voce.law) {
        fit.reason = "one of its laws could not be fitted";
        return fit;
    }
    double above = 0, below = 0;
    for (Index i = 0; i < strain.size(); ++i) {
        const double s = flow_stress(*swift.law, strain[i]).stress, v = flow_stress(*voce.law, strain[i]).stress;
        above += (stress[i] - v) * (s - v);
        below += (s - v) * (s - v);
    }
    const double alpha = below > 0 ? above / below : 0.5;
    if (!(alpha > 0 && alpha < 1))
        fit.reason = alpha < 0.5 ? "no share of Swift makes Voce better" : "no share of Voce makes Swift better";
    else
        fit.law = SwiftVoce{alpha, std::get<Swift>(*swift.law), std::get<Voce>(*voce.law)};
    return fit;
}

} // namespace

std::vector<LawFit> fit_hardening(const VectorXd& strain, const VectorXd& stress_MPa)
{
    if (strain.size() < 8 || strain.size() != stress_MPa.size())
        throw InputError(fmt::format("{} strains and {} stresses: a fit needs at least 8 of each", strain.size(),
                                     stress_MPa.size()));
    for (Index i = 0; i < strain.size(); ++i)
        if (!(strain[i] > 0 && stress_MPa[i] > 0 && std::isfinite(strain[i]) && std::isfinite(stress_MPa[i])))
            throw InputError(fmt::format("point {} ({}, {} MPa) is not above 0; leave it out of the fit", i, strain[i],
                                         stress_MPa[i]));
    std::vector<LawFit> fits;
    for (const Family& family : families())
        fits.push_back(scored(fit_family(family, strain, stress_MPa), strain, stress_MPa));
    fits.push_back(scored(mixture(fits[0], fits[2], strain, stress_MPa), strain, stress_MPa));
    return fits;
}

const LawFit& best_fit(const std::vector<LawFit>& fits)
{
    const LawFit* best = nullptr;
    for (const LawFit& fit : fits)
        if (fit.law && (!best || fit.score < best->score))
            best = &fit;
    if (!best)
        throw InputError("no hardening law could be fitted; look at the curve, it may not be one of hardening");
    return *best;
}

} // namespace spia

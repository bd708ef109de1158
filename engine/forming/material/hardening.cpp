#include "engine/forming/material/hardening.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <fmt/core.h>
#include <limits>

namespace spia {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

FlowStress evaluate(const Swift& law, double strain)
{
    const double base = law.e0 + strain, stress = law.K_MPa * std::pow(base, law.n);
    const double work = (stress * base - law.K_MPa * std::pow(law.e0, law.n + 1)) / (law.n + 1);
    return {stress, law.n * stress / base, work};
}

FlowStress evaluate(const Hollomon& law, double strain)
{
    if (strain <= 0)
        return {0, infinite, 0};
    const double stress = law.K_MPa * std::pow(strain, law.n);
    return {stress, law.n * stress / strain, stress * strain / (law.n + 1)};
}

FlowStress evaluate(const Voce& law, double strain)
{
    const double range = law.sigma_sat_MPa - law.sigma0_MPa, decay = std::exp(-law.c * strain);
    return {law.sigma_sat_MPa - range * decay, range * law.c * decay,
            law.sigma_sat_MPa * strain - range * (1 - decay) / law.c};
}

FlowStress evaluate(const Ludwik& law, double strain)
{
    const FlowStress power = evaluate(Hollomon{law.K_MPa, law.n}, strain);
    return {law.sigma0_MPa + power.stress, power.slope, law.sigma0_MPa * strain + power.work};
}

/// The work has the lower incomplete gamma function: integral of exp(-c x^p) dx = gamma(1/p, c
/// eps^p) / (p c^(1/p)).
FlowStress evaluate(const HockettSherby& law, double strain)
{
    using namespace boost::math::policies;
    using InDouble = policy<promote_double<false>>; // long double would be ten times slower for
                                                    // digits nobody needs
    if (strain <= 0)
        return {law.sigma0_MPa, law.p < 1 ? infinite : (law.sigma_sat_MPa - law.sigma0_MPa) * law.c, 0};
    const double range = law.sigma_sat_MPa - law.sigma0_MPa, x = law.c * std::pow(strain, law.p), decay = std::exp(-x);
    const double integral = boost::math::tgamma_lower(1 / law.p, x, InDouble()) / (law.p * std::pow(law.c, 1 / law.p));
    return {law.sigma_sat_MPa - range * decay, range * law.p * x / strain * decay,
            law.sigma_sat_MPa * strain - range * integral};
}

FlowStress evaluate(const SwiftVoce& law, double strain)
{
    const FlowStress a = evaluate(law.swift, strain), b = evaluate(law.voce, strain);
    const auto mixed = [&](double of_swift, double of_voce) {
        return law.alpha * of_swift + (1 - law.alpha) * of_voce;
    };
    return {mixed(a.stress, b.stress), mixed(a.slope, b.slope), mixed(a.work, b.work)};
}

/// Outside its points the table keeps its first and last slope.
FlowStress evaluate(const HardeningTable& table, double strain)
{
    const auto& x = table.strain;
    const auto& y = table.stress_MPa;
    const size_t last = x.size() - 2;
    const size_t piece = std::min(
        last, size_t(std::max<std::ptrdiff_t>(std::upper_bound(x.begin(), x.end(), strain) - x.begin() - 1, 0)));
    const auto slope = [&](size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    const double at_zero = y[0] - slope(0) * x[0];
    double work = piece == 0 ? 0 : 0.5 * (at_zero + y[0]) * x[0];
    for (size_t i = 0; i < piece; ++i)
        work += 0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]);
    const double stress = y[piece] + slope(piece) * (strain - x[piece]);
    work += piece == 0 ? 0.5 * (at_zero + stress) * strain : 0.5 * (y[piece] + stress) * (strain - x[piece]);
    return {stress, slope(piece), work};
}

} // namespace

std::string_view law_name(const Hardening& law)
{
    struct Name {
        std::string_view operator()(const Swift&) const { return "swift"; }
        std::string_view operator()(const Hollomon&) const { return "hollomon"; }
        std::string_view operator()(const Voce&) const { return "voce"; }
        std::string_view operator()(const HardeningTable&) const { return "table"; }
        std::string_view operator()(const Ludwik&) const { return "ludwik"; }
        std::string_view operator()(const HockettSherby&) const { return "hockett_sherby"; }
        std::string_view operator()(const SwiftVoce&) const { return "swift_voce"; }
    };
    return std::visit(Name{}, law);
}

std::string describe(const Hardening& law)
{
    struct Words {
        std::string operator()(const Swift& s) const
        {
            return fmt::format("Swift: {:.5g} MPa ({:.4g} + eps)^{:.4g}", s.K_MPa, s.e0, s.n);
        }
        std::string operator()(const Hollomon& h) const
        {
            return fmt::format("Hollomon: {:.5g} MPa eps^{:.4g}", h.K_MPa, h.n);
        }
        std::string operator()(const Voce& v) const
        {
            return fmt::format("Voce: {0:.5g} MPa - ({0:.5g} - {1:.5g}) MPa exp(-{2:.4g} eps)", v.sigma_sat_MPa,
                               v.sigma0_MPa, v.c);
        }
        std::string operator()(const HardeningTable& t) const
        {
            return fmt::format("table of {} points", t.strain.size());
        }
        std::string operator()(const Ludwik& l) const
        {
            return fmt::format("Ludwik: {:.5g} MPa + {:.5g} MPa eps^{:.4g}", l.sigma0_MPa, l.K_MPa, l.n);
        }
        std::string operator()(const HockettSherby& h) const
        {
            return fmt::format("Hockett-Sherby: {0:.5g} MPa - ({0:.5g} - {1:.5g}) MPa exp(-{2:.4g} eps^{3:.4g})",
                               h.sigma_sat_MPa, h.sigma0_MPa, h.c, h.p);
        }
        std::string operator()(const SwiftVoce& m) const
        {
            return fmt::format("Swift-Voce: {:.4g} [{}] + {:.4g} [{}]", m.alpha, (*this)(m.swift), 1 - m.alpha,
                               (*this)(m.voce));
        }
    };
    return std::visit(Words{}, law);
}

FlowStress flow_stress(const Hardening& law, double strain)
{
    return std::visit([&](const auto& l) { return evaluate(l, strain); }, law);
}

FlowStress StressCurve::Cubic::at(double x) const
{
    const double w = x1 - x0, t = (x - x0) / w;
    // Coefficients of the Hermite cubic in t.
    const double c1 = s0 * w, c2 = 3 * (f1 - f0) - w * (2 * s0 + s1), c3 = 2 * (f0 - f1) + w * (s0 + s1);
    return {f0 + t * (c1 + t * (c2 + t * c3)), (c1 + t * (2 * c2 + 3 * t * c3)) / w,
            w * t * (f0 + t * (c1 / 2 + t * (c2 / 3 + t * c3 / 4)))};
}

double uniform_strain(const Hardening& law, double at_most)
{
    const auto hardens = [&](double strain) {
        const FlowStress f = flow_stress(law, strain);
        return f.slope > f.stress;
    };
    if (hardens(at_most))
        return at_most;
    double low = 0, high = at_most;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (hardens(middle) ? low : high) = middle;
    }
    return high;
}

StressCurve::StressCurve(const Hardening& law, double young_MPa, const Options& options)
    : law_(law), young_(young_MPa), trusted_(options.trusted_strain), rate_(options.continuation_rate)
{
    // Every law is concave, so sigma_Y(eps) - E eps falls through zero once; bisection needs no
    // derivative at zero, where that of Hollomon, Ludwik and Hockett-Sherby is infinite.
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (flow_stress(law_, middle).stress > young_ * middle ? low : high) = middle;
    }
    yield_ = 0.5 * (low + high);
    trusted_ = std::max(trusted_, 2 * yield_);

    const double a = (1 - options.yield_smoothing) * yield_, b = (1 + options.yield_smoothing) * yield_;
    const FlowStress after = flow_stress(law_, b);
    knee_ = {a, b, young_ * a, after.stress, young_, after.slope};
    knee_work_ = 0.5 * young_ * a * a;
    law_work_ = knee_work_ + knee_.at(b).work - after.work;

    const FlowStress end = flow_stress(law_, trusted_);
    const double width = options.continuation_width;
    const double rate = std::max(rate_, end.slope / end.stress); // never softer than the law itself
    rate_ = rate;
    const double value = end.stress * std::exp(0.5 * (end.slope / end.stress + rate) * width);
    bend_ = {trusted_, trusted_ + width, end.stress, value, end.slope, rate * value};
    bend_work_ = law_work_ + end.work;
    tail_work_ = bend_work_ + bend_.at(trusted_ + width).work;
}

FlowStress StressCurve::operator()(double strain) const
{
    if (strain <= knee_.x0)
        return {young_ * strain, young_, 0.5 * young_ * strain * strain};
    if (strain < knee_.x1) {
        FlowStress f = knee_.at(strain);
        f.work += knee_work_;
        return f;
    }
    if (strain <= bend_.x0) {
        FlowStress f = flow_stress(law_, strain);
        f.work += law_work_;
        return f;
    }
    if (strain < bend_.x1) {
        FlowStress f = bend_.at(strain);
        f.work += bend_work_;
        return f;
    }
    const double stress = bend_.f1 * std::exp(rate_ * (strain - bend_.x1));
    return {stress, rate_ * stress, tail_work_ + (stress - bend_.f1) / rate_};
}

} // namespace spia

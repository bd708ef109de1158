#include "tests/support/held_flange.h"

#include <cmath>
#include <stdexcept>

namespace spia::shapes {
namespace {

struct Membrane {
    double along, around; ///< N/mm
};

Membrane forces(const HeldFlange& flange, double strain_along, double strain_around)
{
    const double r = flange.normal_anisotropy, q = r / (1 + r);
    const double equivalent =
        (1 + r) / std::sqrt(1 + 2 * r) *
        std::sqrt(strain_along * strain_along + strain_around * strain_around + 2 * q * strain_along * strain_around);
    const double yield = flange.hardening.K_MPa * std::pow(flange.hardening.e0 + equivalent, flange.hardening.n),
                 secant = equivalent * flange.young < yield ? flange.young : yield / equivalent,
                 factor = flange.thickness * std::exp(-strain_along - strain_around) * secant * (1 + r) * (1 + r) /
                          (1 + 2 * r);
    return {factor * (strain_along + q * strain_around), factor * (strain_around + q * strain_along)};
}

/// The strain along the meridian at which it carries a force.
double strain_for(const HeldFlange& flange, double force_along, double strain_around)
{
    double low = -0.8, high = 0.3;
    if ((forces(flange, low, strain_around).along - force_along) *
            (forces(flange, high, strain_around).along - force_along) >
        0)
        throw std::runtime_error("the flange is strained beyond what the one-dimensional solution is for");
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (forces(flange, middle, strain_around).along < force_along ? low : high) = middle;
    }
    return (low + high) / 2;
}

double heading_at(const Profile& profile, double s)
{
    const Profile::Piece* at = &profile.pieces().front();
    for (const Profile::Piece& piece : profile.pieces())
        if (s >= piece.from)
            at = &piece;
    return at->heading + at->curvature * (s - at->from);
}

struct State {
    double R, force; ///< mm; N_s r, N
};
State operator+(State a, State b) { return {a.R + b.R, a.force + b.force}; }
State operator*(double t, State a) { return {t * a.R, t * a.force}; }

} // namespace

FlangeBlank held_flange_blank(const HeldFlange& flange, int steps)
{
    const double length = flange.meridian.length(), held = flange.meridian.at(0).x();
    const double way = std::cos(heading_at(flange.meridian, 0)) < -1e-9 ? -1 : 1;
    const auto change = [&](double s, State y) -> State {
        const double r = flange.meridian.at(s).x(), around = std::log(r / y.R),
                     along = strain_for(flange, y.force / r, around);
        return {way * std::exp(-along) / std::hypot(1, flange.slope(y.R)),
                forces(flange, along, around).around * std::cos(heading_at(flange.meridian, s))};
    };
    FlangeBlank out{Eigen::VectorXd::LinSpaced(steps + 1, 0, length), Eigen::VectorXd(steps + 1),
                    Eigen::VectorXd(steps + 1)};
    const auto shoot = [&](double edge) {
        State y{edge, 0};
        const double h = -length / steps;
        for (int k = steps; k >= 0; --k) {
            const double s = out.s[k], r = flange.meridian.at(s).x(), around = std::log(r / y.R);
            out.R[k] = y.R;
            out.thickness[k] = flange.thickness * std::exp(-around - strain_for(flange, y.force / r, around));
            if (k == 0)
                break;
            const State a = change(s, y), b = change(s + h / 2, y + h / 2 * a), c = change(s + h / 2, y + h / 2 * b),
                        d = change(s + h, y + h * c);
            y = y + h / 6 * (a + 2 * b + 2 * c + d);
        }
        return y.R - held;
    };
    // Between the edge of a strip that was longer by a quarter and the held ring.
    double low = held + 1.25 * way * length / std::hypot(1, flange.slope(held)), high = held;
    for (int k = 0; k < 50; ++k) {
        const double middle = (low + high) / 2;
        (shoot(middle) * way > 0 ? low : high) = middle;
    }
    shoot((low + high) / 2);
    return out;
}

} // namespace spia::shapes

#pragma once
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spia {

/// Hardening laws: flow stress in MPa over the equivalent logarithmic strain (the total one: theory
/// of one-step forming).
struct Swift {
    double K_MPa, e0, n; ///< K (e0 + eps)^n
    friend bool operator==(const Swift&, const Swift&) = default;
};
struct Hollomon {
    double K_MPa, n; ///< K eps^n
    friend bool operator==(const Hollomon&, const Hollomon&) = default;
};
struct Voce {
    double sigma0_MPa, sigma_sat_MPa, c; ///< sigma_sat - (sigma_sat - sigma0) exp(-c eps)
    friend bool operator==(const Voce&, const Voce&) = default;
};
struct Ludwik {
    double sigma0_MPa, K_MPa, n; ///< sigma0 + K eps^n; the slope at strain 0 is infinite [Ludwik
                                 ///< 1909]
    friend bool operator==(const Ludwik&, const Ludwik&) = default;
};
struct HockettSherby {
    double sigma0_MPa, sigma_sat_MPa, c,
        p; ///< sigma_sat - (sigma_sat - sigma0) exp(-c eps^p)  [Hockett and Sherby 1975]
    friend bool operator==(const HockettSherby&, const HockettSherby&) = default;
};
struct SwiftVoce {
    double alpha; ///< alpha Swift + (1 - alpha) Voce, 0 < alpha < 1
    Swift swift;
    Voce voce;
    friend bool operator==(const SwiftVoce&, const SwiftVoce&) = default;
};
struct HardeningTable {
    std::vector<double> strain, stress_MPa; ///< strictly increasing strain from >= 0; linear
                                            ///< between the points
    friend bool operator==(const HardeningTable&, const HardeningTable&) = default;
};
using Hardening = std::variant<Swift, Hollomon, Voce, HardeningTable, Ludwik, HockettSherby, SwiftVoce>;

/// The name of a law in material files: swift, hollomon, voce, table, ludwik, hockett_sherby,
/// swift_voce.
std::string_view law_name(const Hardening& law);

/// A law with its numbers, for people: "Ludwik: 150 MPa + 420 MPa eps^0.45".
std::string describe(const Hardening& law);

/// Flow stress of a law, its slope, and its integral from strain zero.
struct FlowStress {
    double stress; ///< MPa
    double slope;  ///< MPa per unit strain; infinite at strain 0 for laws with a power below 1 of
                   ///< the strain
    double work;   ///< MPa: the area under the curve
};
FlowStress flow_stress(const Hardening& law, double strain);

/// Strain up to which a tensile bar strains uniformly: the slope of the true curve has fallen to
/// the stress there. [Considere 1885] Beyond it the force in a strained sheet falls, and
/// equilibrium may gather the strain in a single row of elements.
/// @param at_most answered where the law does not get there before
double uniform_strain(const Hardening& law, double at_most);

/// The uniaxial curve sigma_eq(eps_eq) that the solver sees: Hooke's line, the hardening law, and
/// beyond the strain up to which the law is trusted an exponential continuation (without it the
/// model is ill-posed past the forming limit: strain collapses into single elements). Both
/// transitions are cubics with matching value and slope, so Newton's method meets no kink.
class StressCurve {
public:
    struct Options {
        double trusted_strain = 0.5;      ///< eps_c: beyond it the curve is an extrapolation
        double continuation_rate = 2.0;   ///< kappa in exp(kappa (eps - eps_c))
        double continuation_width = 0.25; ///< strain over which the slope passes from the law's to
                                          ///< kappa sigma
        double yield_smoothing = 0.3;     ///< the elastic-plastic kink is rounded over [1 - s, 1 +
                                          ///< s] times its strain

        friend bool operator==(const Options&, const Options&) = default;
    };

    StressCurve(const Hardening& law, double young_MPa, const Options& options);

    /// @param strain equivalent strain >= 0
    FlowStress operator()(double strain) const;

    double yield_strain() const { return yield_; }          ///< where Hooke's line meets the law
    double yield_stress() const { return young_ * yield_; } ///< MPa
    double trusted_strain() const { return trusted_; }

private:
    /// Cubic through two points with given slopes; its work counts from its first point.
    struct Cubic {
        double x0, x1, f0, f1, s0, s1;
        FlowStress at(double x) const;
    };

    Hardening law_;
    double young_, yield_, trusted_, rate_;
    Cubic knee_, bend_;
    double knee_work_, law_work_, bend_work_, tail_work_; ///< work up to the start of each piece
                                                          ///< (law: offset)
};

} // namespace spia

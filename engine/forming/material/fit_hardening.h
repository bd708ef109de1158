#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/material/hardening.h"

namespace spia {

/// A law fitted to a measured curve.
struct LawFit {
    std::string name;             ///< as law_name()
    std::optional<Hardening> law; ///< none if the law does not describe the curve: see `reason`
    std::string reason = {};
    double rms_MPa = 0; ///< root mean square of the differences in stress
    int parameters = 0; ///< of the law
    double score = 0;   ///< information criterion N ln rms^2 + k ln N [Schwarz 1978]; the least is
                        ///< the best
};

/// Fits swift, hollomon, voce, ludwik, hockett_sherby and swift_voce by least squares of the
/// stress, in this order.
///
/// The stresses of a law enter linearly and are eliminated (variable projection); its one or two
/// other numbers are found by Levenberg-Marquardt from the best point of a grid. Swift-Voce mixes
/// the fitted Swift and the fitted Voce law: only alpha is fitted, since the products alpha K, (1 -
/// alpha) sigma are all that a curve can tell.
/// @param strain     plastic, logarithmic, above 0
/// @param stress_MPa true, above 0
/// @throws InputError if there are fewer than 8 points, or one is not as described
std::vector<LawFit> fit_hardening(const Eigen::VectorXd& strain, const Eigen::VectorXd& stress_MPa);

/// The fit with the least score: the closest one, unless its further parameters gain no more than
/// noise would give.
/// @throws InputError if no law could be fitted
const LawFit& best_fit(const std::vector<LawFit>& fits);

} // namespace spia

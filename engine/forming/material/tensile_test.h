#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/forming/material/two_columns.h"

namespace spia {

struct TensileOptions {
    enum class Kind { engineering, truly };
    std::optional<Kind> kind = {};        ///< of stress and strain; else the heading must say it
    std::optional<bool> in_percent = {};  ///< of strain; else by the heading, else by its size:
                                          ///< above 2 it is in percent
    std::optional<double> young_MPa = {}; ///< takes the place of the slope of the first points
    friend bool operator==(const TensileOptions&, const TensileOptions&) = default;
};

/// What a tensile test says of a sheet. Strains are logarithmic unless said otherwise.
struct TensileTest {
    Eigen::VectorXd plastic_strain;      ///< rising, from 0.002 to the necking strain
    Eigen::VectorXd stress_MPa;          ///< true stress at those strains
    double young_MPa = 0;                ///< the option's, or the slope of the first points
    bool measured_young = false;         ///< whether it is that slope
    double proof_stress_MPa = 0;         ///< Rp0.2, engineering
    double tensile_strength_MPa = 0;     ///< Rm, engineering: the greatest stress
    double uniform_strain = 0;           ///< total, where the force is greatest and necking begins
                                         ///< [Considere 1885]
    std::vector<std::string> notes = {}; ///< what was assumed or left out, in words
};

/// Turns a table of strain and stress (MPa) into the true curve over the plastic strain, up to the
/// greatest force.
///
/// Beyond the greatest force the bar necks and its strain is not uniform; those rows are left out.
/// Young's modulus is the slope of a line through the rows between 10 and 50 % of Rp0.2 [ISO
/// 6892-1], at least five of them on a line, and that line's foot is strain zero. The columns may
/// be in either order if their titles name strain and stress.
/// @param name of the table, for messages
/// @throws InputError with the line where there is one: whether the data are engineering or true is
///         not said; another unit than MPa; strains that fall or cannot be; too few rows; no
///         elastic rows and no modulus given
TensileTest tensile_test(const TwoColumns& table, const std::string& name, const TensileOptions& options = {});

} // namespace spia

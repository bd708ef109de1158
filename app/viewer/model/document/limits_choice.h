#pragma once
#include <filesystem>
#include <optional>

#include "engine/limits/limits.h"

namespace spia::viewer {

/// How the forming limits are to be judged, as chosen in the window or a project. Strains and
/// shares as fractions.
struct LimitsChoice {
    LimitsOptions::Source curve = LimitsOptions::Source::automatic;
    std::filesystem::path table;                          ///< of a curve through points, see
                                                          ///< read_forming_limit_curve()
    std::optional<double> n;                              ///< of Keeler-Brazier; not given: that of
                                                          ///< the material
    std::optional<double> margin;                         ///< not given: as usual for the metal
    double max_thinning = ZoneOptions{}.max_thinning;     ///< of the initial thickness
    double max_thickening = ZoneOptions{}.max_thickening; ///< of the initial thickness
    double low_strain = ZoneOptions{}.low_strain;         ///< engineering

    friend bool operator==(const LimitsChoice&, const LimitsChoice&) = default;
};

/// @throws InputError if the table is not to be had, with file and line
LimitsOptions limits_options(const LimitsChoice& choice);

} // namespace spia::viewer

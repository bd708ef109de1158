#pragma once
#include "engine/pipeline/session.h"

namespace spia::viewer {

/// What the user chooses about the surface; a project keeps it.
struct FitChoice {
    std::optional<double> tolerance = {}; ///< mm, two-sided; not given: the surface runs through
                                          ///< the nodes of the grid
    int degree_u = 3, degree_v = 3;       ///< 2 to 5
    CurveEnds ends = CurveEnds::averaged_knots;
    FitParameters parameters = FitParameters::blank;
    int max_control_points = FitOptions{}.max_control_points;

    friend bool operator==(const FitChoice&, const FitChoice&) = default;
};

FitChoice fit_choice(const SessionOptions& options);

/// @throws InputError if the ends cannot be had with the degrees
void set_fit(SessionOptions& options, const FitChoice& choice);

} // namespace spia::viewer

#include "app/viewer/model/document/fit_choice.h"

#include "engine/core/error.h"

namespace spia::viewer {

FitChoice fit_choice(const SessionOptions& options)
{
    return {options.tolerance,        options.interpolate.degree_u, options.interpolate.degree_v,
            options.interpolate.ends, options.fit_parameters,       options.max_control_points};
}

void set_fit(SessionOptions& options, const FitChoice& choice)
{
    if (choice.ends == CurveEnds::natural && (choice.degree_u != 3 || choice.degree_v != 3))
        throw InputError("Natural ends need degree 3: choose degree 3 or other ends.");
    options.tolerance = choice.tolerance;
    options.interpolate.degree_u = choice.degree_u;
    options.interpolate.degree_v = choice.degree_v;
    options.interpolate.ends = choice.ends;
    options.fit_parameters = choice.parameters;
    options.max_control_points = choice.max_control_points;
}

} // namespace spia::viewer

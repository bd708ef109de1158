#include "app/viewer/model/document/limits_choice.h"

#include "engine/core/error.h"

namespace spia::viewer {

LimitsOptions limits_options(const LimitsChoice& choice)
{
    LimitsOptions options;
    options.source = choice.curve;
    if (choice.curve == LimitsOptions::Source::points) {
        if (choice.table.empty())
            throw InputError("Choose the file of the forming limit curve.");
        options.curve = read_forming_limit_curve(choice.table);
    }
    options.n = choice.n;
    options.margin = choice.margin;
    options.zones.max_thinning = choice.max_thinning;
    options.zones.max_thickening = choice.max_thickening;
    options.zones.low_strain = choice.low_strain;
    return options;
}

} // namespace spia::viewer

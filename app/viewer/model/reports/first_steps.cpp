#include "app/viewer/model/reports/first_steps.h"

#include <fmt/core.h>
#include <vector>

namespace spia::viewer {

std::string first_steps(const ViewerState& state, bool exported)
{
    const Session& session = state.document.session;
    if (!session.part || state.job.running)
        return {};
    std::vector<std::string> steps;
    if (!session.surface)
        steps.emplace_back("Press \"Unfold and fit a surface\" (F5).");
    if (!session.options.corners)
        steps.emplace_back("Look at thinning on part and blank, drag the corners.");
    if (!exported)
        steps.emplace_back("Export.");
    if (steps.empty())
        return {};
    std::string text = "This is the sample part.";
    for (size_t k = 0; k < steps.size(); ++k)
        text += steps.size() > 1 ? fmt::format(" {}. {}", k + 1, steps[k]) : " " + steps[k];
    return text + " Or drop your own part on the window.";
}

} // namespace spia::viewer

#include "engine/pipeline/shortcomings/unfold_shortcomings.h"

#include <fmt/core.h>

#include "engine/core/angle.h"
#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

} // namespace

std::vector<std::string> shortcomings(const UnfoldRun& run, double diagonal, const std::vector<std::string>& findings)
{
    std::vector<std::string> poorer = findings;
    for (const UnfoldState& state : run.states)
        if (!state.converged)
            poorer.push_back(fmt::format("step \"{}\" did not converge: {}", state.name, state.reason));
        else if (state.friction_share < 1)
            poorer.push_back(fmt::format("step \"{}\" reached {:.2g} % of its friction: {}", state.name,
                                         100 * state.friction_share, state.reason));
    for (const UnfoldState& state : run.states)
        if (state.on && creased(*state.on, diagonal))
            poorer.push_back(fmt::format(
                "step \"{}\" creases the sheet at its hinge: the target is offset by {:.3g} mm and {:.1f} deg from the fixed faces",
                state.name, state.on->distance_mm, state.on->angle * degrees_per_radian));
    for (const UnfoldState& state : run.states)
        if (state.reach.without_room > 0)
            poorer.push_back(fmt::format(
                "step \"{}\": {} beyond the end of the target, up to {:.4g} mm from its fixed faces", state.name,
                counted(state.reach.without_room, "face reaches", "faces reach"), state.reach.farthest_mm));
    if (!run.states.empty() && run.states.back().necking > 0)
        poorer.push_back(fmt::format(
            "{} strained beyond the valid range of the hardening curve, extrapolated: the sheet would neck or crack "
            "there",
            counted(run.states.back().necking, "triangle is", "triangles are")));
    for (size_t k = 0; k + 1 < run.states.size(); ++k)
        if (const LandedOverlap& over = run.states[k].overlap; over.landed > 0)
            poorer.push_back(fmt::format(
                "step \"{}\" makes the sheet overlap itself at {}, so that it may be impossible; the first is near "
                "{} mm",
                run.states[k].name, counted(over.landed, "place", "places"), place_text(over.first)));
    if (!run.states.empty() && run.states.back().overlap.places > 0)
        poorer.push_back(fmt::format("{} overlaps itself at {}", run.blank ? "the blank" : "the last state",
                                     counted(run.states.back().overlap.places, "place", "places")));
    if (run.flipped > 0)
        poorer.push_back(
            fmt::format("{} flipped", counted(run.flipped, "triangle of the blank is", "triangles of the blank are")));
    if (!run.blank && run.failure.empty())
        poorer.push_back("after the last step the part is not flat");
    return poorer;
}

} // namespace spia

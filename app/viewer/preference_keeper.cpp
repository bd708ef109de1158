#include "app/viewer/preference_keeper.h"

#include <fmt/core.h>

#include "app/viewer/model/document/grades.h"

namespace spia::viewer {

PreferenceKeeper::PreferenceKeeper(ViewerModel& model, bool scripted, bool light) : scripted_(scripted)
{
    if (!scripted) {
        KeptPreferences kept = read_preferences();
        if (!kept.preferences.material.empty() && !grade_called(*model.state().grades, kept.preferences.material)) {
            kept.left_out.push_back(fmt::format("A preference was left out: there is no grade \"{}\" any more.",
                                                kept.preferences.material));
            kept.preferences.material.clear();
        }
        left_out_ = std::move(kept.left_out);
        model.apply(SetPreferences{kept.preferences});
    }
    kept_ = model.state().preferences;
    if (light) {
        ViewSettings settings = model.state().view;
        settings.dark = false;
        model.apply(SetViewSettings{settings});
        forced_light_ = true;
    }
}

void PreferenceKeeper::follow(ViewerModel& model)
{
    if (!model.busy()) // else the part that is being opened would take the messages away
        for (std::string& text : std::exchange(left_out_, {}))
            model.say(Severity::warning, std::move(text));
    Preferences now = model.state().preferences;
    forced_light_ &= !now.dark;
    if (forced_light_)
        now.dark = kept_.dark;
    if (now == kept_ || scripted_)
        return;
    kept_ = now;
    try {
        keep_preferences(now);
    } catch (const std::exception& error) {
        model.say(Severity::warning, fmt::format("The preferences are not kept: {}.", error.what()));
    }
}

} // namespace spia::viewer

#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/document/grades.h"
#include "engine/forming/material/material_library.h"

namespace spia::viewer {

void ViewerModel::Apply::operator()(const SetPreferences& action)
{
    const Preferences& wanted = action.preferences;
    std::apply([&](const auto&... m) { (m.check(wanted.*m.where, Place("the preferences").member(m.name)), ...); },
               members_of<Preferences>);
    if (!wanted.material.empty() && wanted.material != state.preferences.material)
        find_material(wanted.material, model.assets() / "materials"); // throws if there is none
    const Preferences before = std::exchange(state.preferences, wanted);
    if (wanted.dark != before.dark)
        state.view.dark = wanted.dark;
    if (wanted.mouse != before.mouse)
        state.view.mouse = wanted.mouse;
    if (wanted.map != before.map)
        document.display.map = wanted.map;
    if (session.file.empty()) // the next part is the first
        begin_as_preferred(document);
}

void ViewerModel::Apply::begin_as_preferred(Document& fresh) const
{
    const Preferences& wanted = state.preferences;
    FlattenOptions& sheet = fresh.session.options.flatten;
    if (!wanted.material.empty())
        try {
            sheet.material = find_material(wanted.material, model.assets() / "materials");
            fresh.material = wanted.material;
            fresh.material_from = SheetSource::preference;
        } catch (const InputError& error) { // it is gone
            model.say(Severity::warning,
                      fmt::format("The grade of the preferences cannot be taken: {}. Choose another one there.",
                                  error.what()));
        }
    if (wanted.thickness_mm) {
        sheet.thickness = *wanted.thickness_mm;
        fresh.thickness_from = SheetSource::preference;
    }
    fresh.session.options.best_surface = !wanted.one_patch;
    if (wanted.tolerance_mm)
        fresh.session.options.tolerance = wanted.tolerance_mm;
}

} // namespace spia::viewer

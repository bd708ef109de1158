#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/actions/cut_order.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {

void ViewerModel::Apply::change_patches(std::string name, std::optional<LayoutOptions> patches, bool best)
{
    part();
    if (patches && best)
        throw InputError("The program chooses between one patch and a layout of its own: give a layout, or best.");
    if (session.options.patches == patches && session.options.best_surface == best)
        return;
    const bool unsaved = state.document.unsaved;
    change(std::move(name));
    session.options.patches = std::move(patches);
    session.options.best_surface = best;
    if (session.blank)
        run_of_change(Stage::fit,
                      best                      ? "Making the surface"
                      : session.options.patches ? "Making the patches"
                                                : "Making one patch",
                      unsaved);
}

void ViewerModel::Apply::operator()(const AddCut&)
{
    const PartFile& file = part();
    if (!session.blank)
        throw InputError("Unfold the part first; then its sheet can be cut into patches.");
    LayoutCut cut = cut_through(file.mesh, session.blank->blank.position, document.vertices, file.source_vertex);
    for (int& vertex : cut)
        vertex = number_of(file, vertex);
    LayoutOptions patches = session.options.patches.value_or(LayoutOptions{});
    if (std::find(patches.cuts.begin(), patches.cuts.end(), cut) != patches.cuts.end())
        throw InputError("This cut exists already.");
    patches.cuts.push_back(std::move(cut));
    change_patches("Cut into patches", std::move(patches));
    document.vertices.clear();
}

void ViewerModel::Apply::operator()(const RemoveCut& action)
{
    if (!session.options.patches || size_t(action.cut) >= session.options.patches->cuts.size())
        throw InputError(fmt::format("There is no cut {}.", action.cut + 1));
    LayoutOptions patches = *session.options.patches;
    patches.cuts.erase(patches.cuts.begin() + action.cut);
    change_patches("Remove cut", std::move(patches));
}

} // namespace spia::viewer

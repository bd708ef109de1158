#include <optional>
#include <vector>

#include "app/viewer/panels/view_tools.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

void view_buttons(Frame& frame, View view)
{
    struct Item {
        const char *label, *help;
        std::optional<StandardView> from;
    };
    const bool maximised = frame.state.view.maximised == view;
    const char* enlarge = maximised ? "Four views" : "Enlarge";
    std::vector<Item> items = {{"Fit", "Fit the view  (F)", {}}}; // what matters most comes first
    if (view != View::blank)
        items = {items[0],
                 {"Iso", "Isometric view", StandardView::isometric},
                 {"Top", "Top view", StandardView::top},
                 {"Front", "Front view", StandardView::front},
                 {"Right", "Right view", StandardView::right}};
    const ImGuiStyle& style = ImGui::GetStyle();
    const float gap = 4 * frame.ui.scale;
    const auto width = [&](const char* label) { return ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + gap; };
    const auto whole = [&] {
        float sum = width(enlarge);
        for (const Item& item : items)
            sum += width(item.label);
        return sum;
    };
    const float right = ImGui::GetWindowContentRegionMax().x,
                title_end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + style.ItemSpacing.x;
    while (items.size() > 1 && whole() > right - title_end)
        items.pop_back();
    ImGui::SameLine(right - whole() + gap);
    for (const Item& item : items) {
        if (ImGui::SmallButton(item.label)) {
            if (item.from)
                frame.actions.push(LookFrom{view, *item.from});
            frame.actions.push(FitView{view});
        }
        tooltip(item.help);
        ImGui::SameLine(0, gap);
    }
    if (ImGui::SmallButton(enlarge)) {
        ViewSettings settings = frame.state.view;
        settings.maximised = maximised ? std::nullopt : std::optional(view);
        frame.actions.push(SetViewSettings{settings});
    }
    tooltip("Or double-click the title");
}

} // namespace spia::viewer

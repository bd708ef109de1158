#include "app/viewer/window_report.h"

#include <imgui.h>

namespace spia::viewer {

Json window_report(const Ui& ui, std::optional<View> maximised, const OnScreen& on_screen)
{
    const auto pair = [](ImVec2 v) { return Json{v.x, v.y}; };
    const ImGuiIO& io = ImGui::GetIO();
    Json views = Json::object();
    for (const View view : all_views)
        if (!maximised || *maximised == view)
            views[std::string(name(view))] = {{"at", pair(ui.view_from[size_t(view)])},
                                              {"size", pair(ui.view_size[size_t(view)])}};
    Json items = Json::object();
    for (const auto& [name, place] : ui.items)
        items[name] = {{"at", pair(place[0])}, {"size", pair({place[1].x - place[0].x, place[1].y - place[0].y})}};
    Json texts = Json::array();
    for (const ScreenText& text : on_screen.texts)
        texts.push_back({{"text", text.text}, {"at", pair(text.at)}, {"size", pair(text.size)}});
    return {{"size", pair(io.DisplaySize)},
            {"texts", texts},
            {"marked", on_screen.marked
                           ? Json{{"at", pair((*on_screen.marked)[0])}, {"to", pair((*on_screen.marked)[1])}}
                           : Json(nullptr)},
            {"pushed", on_screen.pushed},
            {"focus", ui.focus ? Json(name(*ui.focus)) : Json(nullptr)},
            {"views", views},
            {"items", items},
            {"mouse", ImGui::IsMousePosValid() ? pair(io.MousePos) : Json(nullptr)},
            {"buttons", {io.MouseDown[0], io.MouseDown[1], io.MouseDown[2]}}};
}

} // namespace spia::viewer

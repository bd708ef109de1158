#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "engine/pipeline/outputs.h"

namespace spia::viewer {
namespace {

struct ToolButton {
    Tool tool;
    const char *label, *help;
    int key;
};
constexpr ToolButton tools[] = {
    {Tool::look, "Look", "Turn with the left mouse button, pan with the middle one, zoom with the wheel  (V)",
     GLFW_KEY_V},
    {Tool::pick, "Face", "Pick single faces; Shift adds, Ctrl takes away. The right button turns  (P)", GLFW_KEY_P},
    {Tool::box, "Box", "Pick all faces in a box  (B)", GLFW_KEY_B},
    {Tool::lasso, "Lasso", "Pick all faces inside a drawn line  (L)", GLFW_KEY_L},
    {Tool::brush, "Brush", "Paint faces  (U)", GLFW_KEY_U},
    {Tool::flood, "Flood", "Pick all around a face up to an angle between neighbours  (R)", GLFW_KEY_R},
    {Tool::smooth_region, "Smooth", "Pick the smooth piece of sheet around a face  (N)", GLFW_KEY_N},
    {Tool::probe, "Probe", "Pin the value at a place  (O)", GLFW_KEY_O},
    {Tool::section, "Section", "Draw a line: the field is plotted along the cut  (X)", GLFW_KEY_X},
    {Tool::corners, "Corners", "Drag the four corners along the outline of the blank  (C)", GLFW_KEY_C},
};

void set_tool(Frame& frame, Tool tool)
{
    ViewSettings settings = frame.state.view;
    settings.tool = tool;
    frame.actions.push(SetViewSettings{settings});
}

void tool_bar(Frame& frame)
{
    const Palette p = palette_of(frame.state.view.dark);
    for (const ToolButton& button : tools) {
        if (button.tool != Tool::look)
            ImGui::SameLine(0, 3 * frame.ui.scale);
        if (button.tool == Tool::pick || button.tool == Tool::probe) {
            ImGui::SameLine(0, 14 * frame.ui.scale);
        }
        const bool active = frame.state.view.tool == button.tool;
        if (active) {
            ImGui::PushStyleColor(ImGuiCol_Button, p.accent);
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, p.accent);
            ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 1, 1, 1));
        }
        if (ImGui::Button(button.label))
            set_tool(frame, button.tool);
        if (active)
            ImGui::PopStyleColor(3);
        tooltip(button.help);
    }
    ViewSettings settings = frame.state.view;
    bool changed = false;
    ImGui::SameLine(0, 14 * frame.ui.scale);
    ImGui::SetNextItemWidth(120 * frame.ui.scale);
    if (settings.tool == Tool::flood) {
        float angle = float(settings.flood_angle);
        changed = ImGui::SliderFloat("##angle", &angle, 1, 90, "up to %.0f deg");
        settings.flood_angle = angle;
    } else if (settings.tool == Tool::brush) {
        float radius = float(settings.brush_radius);
        changed = ImGui::SliderFloat("##radius", &radius, 4, 100, "radius %.0f px");
        settings.brush_radius = radius;
    } else
        ImGui::Dummy({0, 0});
    if (settings.tool == Tool::box || settings.tool == Tool::lasso || settings.tool == Tool::brush) {
        ImGui::SameLine();
        changed |= ImGui::Checkbox("Hidden faces too", &settings.through);
    }
    if (changed)
        frame.actions.push(SetViewSettings{settings});
}

} // namespace

void menu_bar(Frame& frame)
{
    const ViewerState& state = frame.state;
    if (!ImGui::BeginMenuBar())
        return;
    if (ImGui::BeginMenu("File")) {
        if (ImGui::MenuItem("Open part...", "Ctrl+O"))
            frame.ui.files.open(FileDialog::Purpose::open_part, state.document.session.file);
        if (ImGui::MenuItem("Open project..."))
            frame.ui.files.open(FileDialog::Purpose::open_project, state.project);
        if (ImGui::BeginMenu("Recent", !frame.ui.recent.empty())) {
            for (const auto& file : frame.ui.recent)
                if (ImGui::MenuItem(file.string().c_str())) {
                    if (file.extension() == project_ending)
                        frame.actions.push(OpenProject{file});
                    else
                        frame.actions.push(OpenPart{file, ""});
                }
            ImGui::EndMenu();
        }
        ImGui::Separator();
        const bool part = state.document.session.part != nullptr;
        if (ImGui::MenuItem("Save project", "Ctrl+S", false, part)) {
            if (state.project.empty())
                frame.ui.files.open(
                    FileDialog::Purpose::save_project,
                    std::filesystem::path(state.document.session.file).replace_extension(project_ending));
            else
                frame.actions.push(SaveProject{});
        }
        if (ImGui::MenuItem("Save project as...", nullptr, false, part))
            frame.ui.files.open(
                FileDialog::Purpose::save_project,
                state.project.empty()
                    ? std::filesystem::path(state.document.session.file).replace_extension(project_ending)
                    : state.project);
        ImGui::Separator();
        if (ImGui::MenuItem("Export...", "Ctrl+E", false, state.document.session.blank != nullptr))
            frame.ui.show_export = true;
        if (ImGui::MenuItem("Report (HTML)...", nullptr, false, state.document.session.blank != nullptr))
            frame.ui.files.open(FileDialog::Purpose::save_report,
                                std::filesystem::path(state.document.session.file).replace_extension(".html"));
        if (ImGui::MenuItem("Picture of the window...", nullptr))
            frame.ui.files.open(FileDialog::Purpose::save_picture, "spia.png");
        ImGui::Separator();
        if (ImGui::MenuItem("Quit", "Ctrl+Q"))
            frame.actions.push(Quit{});
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Edit")) {
        const std::string undo = state.history.undo_name(), redo = state.history.redo_name();
        if (ImGui::MenuItem(undo.empty() ? "Undo" : ("Undo: " + undo).c_str(), "Ctrl+Z", false,
                            !undo.empty() && !state.job.running))
            frame.actions.push(Undo{});
        if (ImGui::MenuItem(redo.empty() ? "Redo" : ("Redo: " + redo).c_str(), "Ctrl+Y", false,
                            !redo.empty() && !state.job.running))
            frame.actions.push(Redo{});
        ImGui::Separator();
        const bool some = !state.document.selected.empty();
        if (ImGui::MenuItem("Grow selection", "+", false, some))
            frame.actions.push(GrowSelection{});
        if (ImGui::MenuItem("Shrink selection", "-", false, some))
            frame.actions.push(ShrinkSelection{});
        if (ImGui::MenuItem("Invert selection", "I", false, state.document.session.part != nullptr))
            frame.actions.push(InvertSelection{});
        if (ImGui::MenuItem("Clear selection", "Esc", false, some))
            frame.actions.push(ClearSelection{});
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("View")) {
        ViewSettings view = state.view;
        bool changed = false;
        if (ImGui::MenuItem("Fit all", "F"))
            frame.actions.push(FitView{});
        if (ImGui::MenuItem("Perspective", "5", view.camera[0].perspective)) {
            const bool perspective = !view.camera[0].perspective;
            for (const View v : all_views)
                if (v != View::blank)
                    view.camera[size_t(v)].perspective = perspective;
            changed = true;
        }
        ImGui::Separator();
        changed |= ImGui::MenuItem("Dark theme", "T", &view.dark);
        changed |= ImGui::MenuItem("Turn 3D views together", nullptr, &view.linked);
        changed |= ImGui::MenuItem("Triangle edges", "E", &view.edges);
        changed |= ImGui::MenuItem("Feature lines", nullptr, &view.features);
        ImGui::Separator();
        ImGui::MenuItem("Steps panel", "F2", &frame.ui.show_left);
        ImGui::MenuItem("Inspect panel", "F3", &frame.ui.show_right);
        if (changed)
            frame.actions.push(SetViewSettings{view});
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Help")) {
        ImGui::MenuItem("Keyboard and mouse", "F1", &frame.ui.show_shortcuts);
        ImGui::EndMenu();
    }
    const std::string title =
        state.project.empty() ? state.document.session.file.filename().string() : state.project.filename().string();
    if (!title.empty()) {
        const std::string text = title + (state.unsaved ? " *" : "");
        ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(text.c_str()).x - 14 * frame.ui.scale);
        ImGui::TextDisabled("%s", text.c_str());
    }
    ImGui::EndMenuBar();
}

/// At the right end of the status bar.
void selection_actions(Frame& frame)
{
    if (frame.state.document.selected.empty())
        return;
    const std::string text = fmt::format("{} faces selected", frame.state.document.selected.size());
    const ImGuiStyle& style = ImGui::GetStyle();
    const float gap = 6 * frame.ui.scale;
    float width = ImGui::CalcTextSize(text.c_str()).x;
    for (const char* label : {"Grow", "Shrink", "Invert", "Clear"})
        width += ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + gap;
    ImGui::SameLine(ImGui::GetWindowWidth() - width - 14 * frame.ui.scale);
    ImGui::TextColored(palette_of(frame.state.view.dark).accent, "%s", text.c_str());
    const auto act = [&](const char* label, Action action) {
        ImGui::SameLine(0, gap);
        if (ImGui::SmallButton(label))
            frame.actions.push(std::move(action));
    };
    act("Grow", GrowSelection{});
    act("Shrink", ShrinkSelection{});
    act("Invert", InvertSelection{});
    act("Clear", ClearSelection{});
}

void status_bar(Frame& frame)
{
    const ViewerState& state = frame.state;
    const Palette p = palette_of(state.view.dark);
    if (state.job.running) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(state.job.title.c_str());
        ImGui::SameLine();
        ImGui::ProgressBar(float(state.job.fraction), {180 * frame.ui.scale, ImGui::GetFrameHeight() * 0.8f}, "");
        ImGui::SameLine();
        ImGui::TextColored(p.muted, "%s", state.job.step.c_str());
        return;
    }
    ImGui::AlignTextToFramePadding();
    const auto& probe = frame.model.under_mouse();
    if (!probe || !state.document.session.part) {
        ImGui::TextColored(p.muted, "%s",
                           state.document.session.part ? "Ready" : "Open a part, or drop one on the window");
        return;
    }
    const TriMesh& part = state.document.session.part->mesh;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int a = 0; a < 3; ++a)
        at += probe->barycentric[a] * part.position.col(part.triangle(a, probe->face));
    std::string text = fmt::format("Face {}    {:.2f}, {:.2f}, {:.2f} mm", probe->face, at[0], at[1], at[2]);
    const Field field = state.document.display.field;
    if (field != Field::none && available(state.document.session, field)) {
        static std::shared_ptr<const FlattenResult>
            blank; // the values of a field are not made anew for every mouse move
        static std::shared_ptr<const SurfaceStage> surface;
        static Field of = Field::none;
        static bool per_face = false;
        static Eigen::VectorXd value;
        if (blank != state.document.session.blank || surface != state.document.session.surface || of != field ||
            per_face != state.document.display.per_face) {
            blank = state.document.session.blank;
            surface = state.document.session.surface;
            of = field;
            per_face = state.document.display.per_face;
            value = values(state.document.session, field, per_face);
        }
        double here = 0;
        if (per_face)
            here = value[probe->face];
        else
            for (int a = 0; a < 3; ++a)
                here += probe->barycentric[a] * value[part.triangle(a, probe->face)];
        text += fmt::format("    {} {}", info(field).label, value_text(here, info(field).unit));
    }
    ImGui::TextUnformatted(text.c_str());
}

/// What the program has to say, the newest on top, over the lower edge of the views.
void messages(Frame& frame, ImVec2 low_right, float width)
{
    const auto& all = frame.state.messages;
    if (all.empty())
        return;
    const Palette p = palette_of(frame.state.view.dark);
    constexpr size_t most = 3;
    ImGui::SetNextWindowPos(low_right, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowSize({std::min(width, 460 * frame.ui.scale), 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * frame.ui.scale);
    ImGui::Begin("messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    std::vector<Message> shown(all.rbegin(), all.rend()); // the gravest first, of these the newest
    std::stable_sort(shown.begin(), shown.end(),
                     [](const Message& a, const Message& b) { return a.severity > b.severity; });
    if (shown.size() > most)
        shown.resize(most);
    for (const Message& message : shown) {
        const ImVec4 colour = message.severity == Severity::error     ? p.error
                              : message.severity == Severity::warning ? p.warning
                              : message.severity == Severity::done    ? p.good
                                                                      : p.accent;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 5 * frame.ui.scale, at.y + ImGui::GetTextLineHeight() / 2},
                                                    4 * frame.ui.scale, ink(colour));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 18 * frame.ui.scale);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(message.text.c_str());
        ImGui::PopTextWrapPos();
    }
    if (all.size() > most)
        ImGui::TextDisabled("and %d more", int(all.size() - most));
    if (ImGui::SmallButton("Dismiss"))
        frame.actions.push(DismissMessages{});
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

bool escape(const Frame& frame)
{
    return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                       [](const KeyPress& press) { return press.key == GLFW_KEY_ESCAPE; });
}

void export_dialog(Frame& frame)
{
    if (frame.ui.show_export) {
        ImGui::OpenPopup("Export");
        if (frame.ui.export_folder.empty())
            frame.ui.export_folder =
                (std::filesystem::absolute(frame.state.document.session.file).parent_path() / "spia-out").string();
    }
    frame.ui.show_export = false;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(520 * frame.ui.scale, screen.x - 40), 0});
    if (!ImGui::BeginPopupModal("Export", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
        return;
    const Session& session = frame.state.document.session;
    const Palette p = palette_of(frame.state.view.dark);
    if (session.surface) {
        const double worst = session.surface->deviation.max();
        coloured(worst > 0.1 ? p.warning : p.good,
                 fmt::format("The surface is within {:.3g} mm of the part (95 % of it within {:.3g} mm).", worst,
                             session.surface->deviation.mesh_to_surface.p95));
    } else
        coloured(p.warning, "There is no surface yet: IGES and STEP are left out.");
    struct Choice {
        const char *format, *text;
    };
    static constexpr Choice choices[] = {{"iges", "IGES: the NURBS surface for CAD"},
                                         {"step", "STEP AP242: the NURBS surface for CAD"},
                                         {"glb", "glTF binary: part, blank, quads, surface with their fields"},
                                         {"vtu", "VTU: all fields, for ParaView"},
                                         {"dxf", "DXF: outline of the blank"},
                                         {"csv", "CSV: fields per vertex, outline"},
                                         {"png", "PNG: one picture of the whole chain"}};
    auto& formats = frame.ui.export_formats;
    for (const Choice& choice : choices) {
        bool on = std::find(formats.begin(), formats.end(), choice.format) != formats.end();
        if (ImGui::Checkbox(choice.text, &on)) {
            std::erase(formats, choice.format);
            if (on)
                formats.push_back(choice.format);
        }
    }
    muted(frame, "Lengths in mm (glTF: metres, as its specification wants).");
    ImGui::SetNextItemWidth(-90 * frame.ui.scale);
    text_input("##folder", frame.ui.export_folder, false, "folder");
    ImGui::SameLine();
    if (ImGui::Button("Choose...")) {
        ImGui::CloseCurrentPopup();
        frame.ui.files.open(FileDialog::Purpose::export_folder, frame.ui.export_folder);
    }
    ImGui::Dummy({0, 2});
    if (primary_button(frame, "Export", !formats.empty() && !frame.ui.export_folder.empty())) {
        frame.actions.push(ExportFiles{frame.ui.export_folder, formats});
        ImGui::CloseCurrentPopup();
    }
    if (ImGui::Button("Cancel", {-1, 0}) || escape(frame))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void shortcuts_window(Frame& frame)
{
    if (!frame.ui.show_shortcuts)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (ImGui::Begin("Keyboard and mouse", &frame.ui.show_shortcuts,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
        constexpr const char* rows[][2] = {
            {"Left button", "what the tool does; with Look: turn"},
            {"Right button", "turn, with every tool"},
            {"Middle button, Shift + right", "pan"},
            {"Wheel", "zoom to the place under the mouse"},
            {"Shift, Ctrl", "picking adds, takes away"},
            {"Double click on a title", "one view, four views"},
            {"V P B L U R N O X C", "tools: look, face, box, lasso, brush, flood, smooth, probe, section, corners"},
            {"F5, F6", "run all, unfold"},
            {"F", "fit all"},
            {"1 2 3 4, 5", "top, front, right, isometric; perspective"},
            {"E, T", "triangle edges; dark or light"},
            {"F2, F3", "show or hide the panels"},
            {"Ctrl + Z, Y", "undo, redo"},
            {"Ctrl + O, S, E, Q", "open, save, export, quit"},
            {"Esc", "clear the selection; cancel the job"}};
        if (ImGui::BeginTable("keys", 2)) {
            for (const auto& row : rows) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(row[0]);
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", row[1]);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

void unsaved_dialog(Frame& frame)
{
    if (frame.ui.held && !ImGui::IsPopupOpen("Unsaved changes"))
        ImGui::OpenPopup("Unsaved changes");
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({420 * frame.ui.scale, 0});
    if (!ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
        return;
    ImGui::PushTextWrapPos(0);
    ImGui::Text("What you changed on %s is not saved in a project.",
                frame.state.document.session.file.filename().c_str());
    ImGui::PopTextWrapPos();
    const auto go_on = [&] {
        frame.ui.confirmed = true;
        frame.actions.push(*std::exchange(frame.ui.held, std::nullopt));
        ImGui::CloseCurrentPopup();
    };
    if (primary_button(frame, "Save...")) {
        if (frame.state.project.empty()) {
            frame.ui.files.open(
                FileDialog::Purpose::save_project,
                std::filesystem::path(frame.state.document.session.file).replace_extension(project_ending));
            frame.ui.held.reset(); // once saved, the way is free
            ImGui::CloseCurrentPopup();
        } else {
            frame.actions.push(SaveProject{});
            frame.actions.push(*std::exchange(frame.ui.held, std::nullopt));
            ImGui::CloseCurrentPopup();
        }
    }
    if (ImGui::Button("Go on without saving", {-1, 0}))
        go_on();
    if (ImGui::Button("Cancel", {-1, 0}) || escape(frame)) {
        frame.ui.held.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void dialogs(Frame& frame)
{
    unsaved_dialog(frame);
    export_dialog(frame);
    shortcuts_window(frame);
    const auto path = frame.ui.files.show(frame.ui.scale);
    if (!path)
        return;
    switch (frame.ui.files.purpose()) {
    case FileDialog::Purpose::open_part: frame.actions.push(OpenPart{*path, ""}); break;
    case FileDialog::Purpose::open_project: frame.actions.push(OpenProject{*path}); break;
    case FileDialog::Purpose::save_project: frame.actions.push(SaveProject{*path}); break;
    case FileDialog::Purpose::open_material: frame.actions.push(SetMaterial{path->string()}); break;
    case FileDialog::Purpose::save_report: frame.actions.push(WriteReport{*path}); break;
    case FileDialog::Purpose::save_picture: frame.actions.push(Screenshot{*path, {}, 0, 0}); break;
    case FileDialog::Purpose::export_folder:
        frame.ui.export_folder = path->string();
        frame.ui.show_export = true;
        break;
    }
}

void shortcuts(Frame& frame)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId))
        return;
    const auto pressed = [&](int key) {
        return std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                           [&](const KeyPress& press) { return press.key == key; });
    };
    const bool control = std::any_of(frame.ui.keys.begin(), frame.ui.keys.end(),
                                     [](const KeyPress& press) { return (press.modifiers & GLFW_MOD_CONTROL) != 0; });
    const Session& session = frame.state.document.session;
    if (control) {
        if (pressed(GLFW_KEY_Z))
            frame.actions.push(io.KeyShift ? Action{Redo{}} : Action{Undo{}});
        if (pressed(GLFW_KEY_Y))
            frame.actions.push(Redo{});
        if (pressed(GLFW_KEY_O))
            frame.ui.files.open(FileDialog::Purpose::open_part, session.file);
        if (pressed(GLFW_KEY_S) && session.part) {
            if (frame.state.project.empty())
                frame.ui.files.open(FileDialog::Purpose::save_project,
                                    std::filesystem::path(session.file).replace_extension(project_ending));
            else
                frame.actions.push(SaveProject{});
        }
        if (pressed(GLFW_KEY_E) && session.blank)
            frame.ui.show_export = true;
        if (pressed(GLFW_KEY_Q))
            frame.actions.push(Quit{});
        return;
    }
    const bool dragging = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
    for (const ToolButton& tool : tools)
        if (pressed(tool.key) && !dragging)
            set_tool(frame, tool.tool);
    ViewSettings view = frame.state.view;
    if (pressed(GLFW_KEY_T)) {
        view.dark = !view.dark;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(GLFW_KEY_E)) {
        view.edges = !view.edges;
        frame.actions.push(SetViewSettings{view});
    }
    if (pressed(GLFW_KEY_5)) {
        for (const View v : all_views)
            if (v != View::blank)
                view.camera[size_t(v)].perspective = !frame.state.view.camera[0].perspective;
        frame.actions.push(SetViewSettings{view});
    }
    constexpr std::pair<int, StandardView> looks[] = {{GLFW_KEY_1, StandardView::top},
                                                      {GLFW_KEY_2, StandardView::front},
                                                      {GLFW_KEY_3, StandardView::right},
                                                      {GLFW_KEY_4, StandardView::isometric}};
    for (const auto& [key, from] : looks)
        if (pressed(key))
            frame.actions.push(LookFrom{View::part, from});
    if (pressed(GLFW_KEY_F))
        frame.actions.push(FitView{});
    if (pressed(GLFW_KEY_I) && session.part)
        frame.actions.push(InvertSelection{});
    if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD))
        frame.actions.push(GrowSelection{});
    if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT))
        frame.actions.push(ShrinkSelection{});
    if (pressed(GLFW_KEY_ESCAPE)) {
        if (frame.state.job.running)
            frame.actions.push(CancelJob{});
        else
            frame.actions.push(ClearSelection{});
    }
    if (pressed(GLFW_KEY_F1))
        frame.ui.show_shortcuts = !frame.ui.show_shortcuts;
    if (pressed(GLFW_KEY_F2))
        frame.ui.show_left = !frame.ui.show_left;
    if (pressed(GLFW_KEY_F3))
        frame.ui.show_right = !frame.ui.show_right;
    if (pressed(GLFW_KEY_F5))
        frame.actions.push(RunTo{Stage::fit});
    if (pressed(GLFW_KEY_F6))
        frame.actions.push(RunTo{Stage::solve});
}

void workbench(Frame& frame)
{
    const ImGuiIO& io = ImGui::GetIO();
    const float s = frame.ui.scale;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("workbench", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    menu_bar(frame);
    const float status = ImGui::GetFrameHeight() + 4 * s;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = io.DisplaySize.y - at.y - status;
    // Narrow windows keep room for the views.
    const float left = frame.ui.show_left ? std::min(frame.ui.left_width * s, io.DisplaySize.x * 0.3f) : 0,
                right = frame.ui.show_right && io.DisplaySize.x > 900 * s
                            ? std::min(frame.ui.right_width * s, io.DisplaySize.x * 0.25f)
                            : 0;
    const Palette p = palette_of(frame.state.view.dark);
    if (left > 0) {
        ImGui::SetCursorScreenPos(at);
        ImGui::BeginChild("left", {left, height}, false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                              ImGuiWindowFlags_NoScrollWithMouse);
        steps_panel(frame);
        ImGui::EndChild();
    }
    const float middle = io.DisplaySize.x - left - right, bar = ImGui::GetFrameHeight() + 10 * s;
    ImGui::SetCursorScreenPos({at.x + left + 6 * s, at.y + 4 * s});
    ImGui::BeginChild("tools", {middle - 12 * s, bar - 4 * s}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    tool_bar(frame);
    ImGui::EndChild();
    ImGui::SetCursorScreenPos({at.x + left, at.y + bar});
    ImGui::BeginChild("views", {middle, height - bar}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    view_area(frame);
    ImGui::EndChild();
    if (right > 0) {
        ImGui::SetCursorScreenPos({at.x + left + middle, at.y});
        ImGui::BeginChild("right", {right, height}, false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                              ImGuiWindowFlags_NoScrollWithMouse);
        inspect_panel(frame);
        ImGui::EndChild();
    }
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddLine({0, at.y + height}, {io.DisplaySize.x, at.y + height}, ink(p.line));
    ImGui::SetCursorScreenPos({at.x + 12 * s, at.y + height + 2 * s});
    status_bar(frame);
    selection_actions(frame);
    ImGui::End();
    messages(frame, {at.x + left + middle - 12 * s, at.y + height - 12 * s}, middle - 24 * s);
    dialogs(frame);
    shortcuts(frame);
}

} // namespace spia::viewer

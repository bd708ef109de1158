#include <optional>
#include <tuple>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/steps/step_parts.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

namespace {

/// A key that acts in the view that has the keyboard, for the menu to say so: elsewhere a letter
/// may be typed into a field.
constexpr const char* in_view(const char* key)
{
    constexpr std::pair<char, const char*> words[] = {{'+', "+ in a view"}, {'-', "- in a view"}, {'I', "I in a view"},
                                                      {'F', "F in a view"}, {'5', "5 in a view"}, {'1', "1 in a view"},
                                                      {'2', "2 in a view"}, {'3', "3 in a view"}, {'4', "4 in a view"},
                                                      {'H', "H in a view"}, {'T', "T in a view"}, {'E', "E in a view"}};
    for (const auto& [letter, text] : words)
        if (letter == *key)
            return text;
    return "";
}

/// The chain and the steps; what the panel of the steps has as buttons.
void run_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Run"))
        return;
    const Document& document = frame.state.document;
    const bool part = document.session.part && !frame.state.job.running;
    if (ImGui::MenuItem("Unfold and fit a surface", "F5", false, part))
        frame.actions.push(RunTo{Stage::fit});
    if (ImGui::MenuItem("Unfold", "F6", false, part))
        frame.actions.push(RunTo{Stage::solve});
    if (ImGui::MenuItem("Propose corners", nullptr, false, part && document.session.options.corners))
        frame.actions.push(ProposeCorners{});
    ImGui::Separator();
    if (ImGui::MenuItem("Propose steps", nullptr, false, part))
        frame.actions.push(ProposeSteps{});
    if (ImGui::MenuItem("Unfold step by step", nullptr, false,
                        part && !document.steps.empty() && !all_steps_done(document)))
        frame.actions.push(RunSteps{});
    if (ImGui::MenuItem("Use the blank of the steps", nullptr, false, part && blank_of_steps_waits(document)))
        frame.actions.push(UseBlankOfSteps{frame.ui.polish_steps});
    ImGui::Separator();
    if (ImGui::MenuItem("Cancel", "Esc", false, frame.state.job.running && !frame.state.job.cancelling))
        frame.actions.push(CancelJob{});
    ImGui::EndMenu();
}

/// Whose habits the mouse follows.
void mouse_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Mouse"))
        return;
    ViewSettings view = frame.state.view;
    for (const MouseStyle style : all_mouse_styles) {
        if (ImGui::MenuItem(title(style), nullptr, view.mouse == style)) {
            view.mouse = style;
            frame.actions.push(SetViewSettings{view});
        }
        std::string words;
        for (const MouseHabit& habit : habits(style))
            words += (words.empty() ? "" : "\n") + habit.how + ": " + habit.does;
        tooltip(words);
    }
    ImGui::EndMenu();
}

/// What the picked faces are.
void region_menu(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!ImGui::BeginMenu("Make a region of the selection", !document.selected.empty()))
        return;
    for (const RegionKind kind : {RegionKind::fixed, RegionKind::binder, RegionKind::pad, RegionKind::punch})
        if (ImGui::MenuItem(std::string(name(kind)).c_str()))
            make_region(frame, "", kind);
    ImGui::EndMenu();
}

void recent_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Recent", !frame.ui.recent.empty()))
        return;
    for (const auto& file : frame.ui.recent)
        if (ImGui::MenuItem(file.string().c_str())) {
            if (file.extension() == project_ending)
                frame.actions.push(OpenProject{file});
            else if (has_choices(file))
                frame.actions.push(ListFile{file});
            else
                frame.actions.push(OpenPart{file, ""});
        }
    ImGui::EndMenu();
}

void file_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("File"))
        return;
    const ViewerState& state = frame.state;
    if (ImGui::MenuItem("Open part...", "Ctrl+O"))
        choose_part(frame);
    if (ImGui::MenuItem("Open project..."))
        choose_project(frame);
    recent_menu(frame);
    ImGui::Separator();
    const bool part = state.document.session.part != nullptr;
    if (ImGui::MenuItem("Save project", "Ctrl+S", false, part)) {
        if (state.project.empty())
            choose_project_name(frame);
        else
            frame.actions.push(SaveProject{});
    }
    if (ImGui::MenuItem("Save project as...", nullptr, false, part))
        choose_project_name(frame);
    ImGui::Separator();
    if (ImGui::MenuItem("Export...", "Ctrl+E", false, state.document.session.blank != nullptr))
        frame.ui.show_export = true;
    if (ImGui::MenuItem("Report (HTML)...", nullptr, false, state.document.session.blank != nullptr))
        frame.ui.show_report = true;
    if (ImGui::MenuItem("Picture...", nullptr, false, part))
        frame.ui.show_picture = true;
    if (ImGui::MenuItem("Animation...", nullptr, false,
                        part && (state.document.session.blank || steps_done(state.document) > 0)))
        frame.ui.show_animation = true;
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q"))
        frame.actions.push(Quit{});
    ImGui::EndMenu();
}

void edit_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Edit"))
        return;
    const ViewerState& state = frame.state;
    const std::string undo = state.history.undo_name(), redo = state.history.redo_name();
    if (ImGui::MenuItem(undo.empty() ? "Undo" : ("Undo: " + undo).c_str(), "Ctrl+Z", false,
                        !undo.empty() && !state.job.running))
        frame.actions.push(Undo{});
    if (ImGui::MenuItem(redo.empty() ? "Redo" : ("Redo: " + redo).c_str(), "Ctrl+Y", false,
                        !redo.empty() && !state.job.running))
        frame.actions.push(Redo{});
    ImGui::Separator();
    const bool some = !state.document.selected.empty();
    if (ImGui::MenuItem("Grow selection", in_view("+"), false, some))
        frame.actions.push(GrowSelection{});
    if (ImGui::MenuItem("Shrink selection", in_view("-"), false, some))
        frame.actions.push(ShrinkSelection{});
    if (ImGui::MenuItem("Invert selection", in_view("I"), false, state.document.session.part != nullptr))
        frame.actions.push(InvertSelection{});
    if (ImGui::MenuItem("Clear selection", "Esc", false, some || !state.document.vertices.empty()))
        frame.actions.push(ClearSelection{});
    region_menu(frame);
    ImGui::Separator();
    if (ImGui::MenuItem("Materials..."))
        open_material_editor(frame);
    if (ImGui::MenuItem("Keep result as reference", nullptr, false, state.document.session.blank != nullptr))
        frame.actions.push(KeepReference{});
    if (ImGui::MenuItem("Remove reference", nullptr, false, state.reference != nullptr))
        frame.actions.push(DropReference{});
    ImGui::Separator();
    if (ImGui::MenuItem("Preferences...", "Ctrl+,"))
        frame.ui.show_preferences = true;
    ImGui::EndMenu();
}

void look_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Look from"))
        return;
    constexpr std::tuple<const char*, const char*, StandardView> looks[] = {
        {"Top", in_view("1"), StandardView::top},
        {"Front", in_view("2"), StandardView::front},
        {"Right", in_view("3"), StandardView::right},
        {"Isometric", in_view("4"), StandardView::isometric},
        {"Bottom", "", StandardView::bottom},
        {"Back", "", StandardView::back},
        {"Left", "", StandardView::left}};
    for (const auto& [label, key, from] : looks)
        if (ImGui::MenuItem(label, key))
            frame.actions.push(LookFrom{View::part, from});
    ImGui::EndMenu();
}

/// Which views are shown. @returns whether it was changed
bool shown_views(ViewSettings& view)
{
    bool changed = false;
    constexpr std::pair<const char*, std::optional<View>> shown[] = {{"Four views", std::nullopt},
                                                                     {"Part alone", View::part},
                                                                     {"Blank alone", View::blank},
                                                                     {"Quad mesh alone", View::quads},
                                                                     {"NURBS surface alone", View::surface}};
    for (const auto& [label, which] : shown)
        if (ImGui::MenuItem(label, nullptr, view.maximised == which)) {
            view.maximised = which;
            changed = true;
        }
    return changed;
}

void panel_items(Frame& frame)
{
    const bool narrow = is_narrow(ImGui::GetIO().DisplaySize.x, frame.ui.scale);
    SidePanels& panels = frame.ui.panels;
    for (const auto& [label, key, which] :
         {std::tuple{"Steps panel", "F2", SidePanels::steps}, {"Inspect panel", "F3", SidePanels::inspect}})
        if (ImGui::MenuItem(label, key, panels.shown(which, narrow)))
            panels.toggle(which, narrow);
}

void view_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("View"))
        return;
    const ViewerState& state = frame.state;
    ViewSettings view = state.view;
    bool changed = false;
    if (ImGui::MenuItem("Fit all", in_view("F")))
        frame.actions.push(FitView{});
    if (ImGui::MenuItem("Perspective", in_view("5"), view.camera[0].perspective)) {
        const bool perspective = !view.camera[0].perspective;
        for (const View v : all_views)
            if (v != View::blank)
                view.camera[size_t(v)].perspective = perspective;
        changed = true;
    }
    look_menu(frame);
    ImGui::Separator();
    changed |= shown_views(view);
    ImGui::Separator();
    mouse_menu(frame);
    if (ImGui::MenuItem("Clip", in_view("H"), view.clip.on, state.document.session.part != nullptr))
        toggle_clip(frame);
    changed |= ImGui::MenuItem("Dark theme", in_view("T"), &view.dark);
    changed |= ImGui::MenuItem("Rotate 3D views together", nullptr, &view.linked);
    changed |= ImGui::MenuItem("Triangle edges", in_view("E"), &view.edges);
    changed |= ImGui::MenuItem("Feature lines", nullptr, &view.features);
    ImGui::Separator();
    panel_items(frame);
    if (changed)
        frame.actions.push(SetViewSettings{view});
    ImGui::EndMenu();
}

void help_menu(Frame& frame)
{
    if (!ImGui::BeginMenu("Help"))
        return;
    if (ImGui::MenuItem("Manual"))
        open_manual(frame.ui.manual);
    ImGui::MenuItem("Keyboard and mouse", "F1", &frame.ui.show_shortcuts);
    ImGui::MenuItem("Messages", nullptr, &frame.ui.show_messages);
    ImGui::Separator();
    if (ImGui::MenuItem("About..."))
        frame.ui.show_about = true;
    ImGui::EndMenu();
}

} // namespace

void menu_bar(Frame& frame)
{
    const ViewerState& state = frame.state;
    if (!ImGui::BeginMenuBar())
        return;
    file_menu(frame);
    edit_menu(frame);
    run_menu(frame);
    view_menu(frame);
    help_menu(frame);
    const std::string title =
        state.project.empty() ? state.document.session.file.filename().string() : state.project.filename().string();
    if (!title.empty()) {
        const std::string text = title + (state.document.unsaved ? " *" : "");
        ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::CalcTextSize(text.c_str()).x - 14 * frame.ui.scale);
        ImGui::TextDisabled("%s", text.c_str());
    }
    ImGui::EndMenuBar();
}

} // namespace spia::viewer

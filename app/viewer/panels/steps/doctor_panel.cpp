#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/reports/lights.h"
#include "app/viewer/panels/option_fields.h"
#include "app/viewer/panels/widgets.h"
#include "engine/options/part_options.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

/// How the file was read that the panel is about.
const ReadOptions& read_options(const Frame& frame)
{
    return shows_refused(frame.state) ? frame.state.refused_file->read : frame.state.document.session.options.read;
}

/// Reads the file again, one thing otherwise.
template <class Edit> void read_with(Frame& frame, const Edit& edit)
{
    const ReadOptions& read = read_options(frame);
    Reading reading = reading_of(read);
    edit(reading);
    if (shows_refused(frame.state))
        frame.actions.push(
            OpenPart{frame.state.refused_file->file, read.unit ? std::string(name(*read.unit)) : "", reading});
    else
        frame.actions.push(SetReading{reading});
}

/// Each place of a fault with what is known of it; a click shows it.
void list_of_places(Frame& frame, int number, const Finding& finding)
{
    constexpr int rows = 6;
    const int places = int(finding.what.size()), entry = frame.state.fault->entry;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float shown = float(std::min(rows, places)) * line - style.ItemSpacing.y;
    ImGui::BeginChild("places", {0, shown + 2 * (style.WindowPadding.y + style.ChildBorderSize)}, true);
    ImGuiListClipper clipper;
    clipper.Begin(places, line);
    while (clipper.Step())
        for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
            const std::string label =
                fmt::format("{}   {}##{}", k + 1, engine_words(frame, finding.what[size_t(k)]), k);
            if (ImGui::Selectable(label.c_str(), k == entry) && k != entry)
                frame.actions.push(ShowFault{number, k});
        }
    int& listed = frame.ui.listed_place; // the list follows the buttons, and is scrolled by hand
                                         // otherwise
    if (std::exchange(listed, entry) != entry)
        ImGui::SetScrollY(std::max(0.f, (float(entry) - rows / 2) * line));
    ImGui::EndChild();
}

/// "Show", which stays pressed; for a fault in several places back and forth between them.
void show_buttons(Frame& frame, int number, const Finding& finding)
{
    const int places = int(finding.place.size());
    if (places == 0)
        return;
    const auto& shown = frame.state.fault;
    const bool here = shown && shown->finding == number;
    if (here)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
    const std::string label = here ? "Shown" : "Show";
    const float width = ImGui::CalcTextSize("Shown").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 2 * frame.ui.scale});
    if (ImGui::Button(label.c_str(), {width, 0}))
        frame.actions.push(here ? Action{HideFault{}} : Action{ShowFault{number, 0}});
    ImGui::PopStyleVar();
    if (here)
        ImGui::PopStyleColor();
    tooltip(here ? "Removes the marker and goes back; so does Escape" : "Zooms to the place and marks it");
    if (!here || places == 1)
        return;
    ImGui::SameLine(0, 8 * frame.ui.scale);
    const auto go = [&](int by) { frame.actions.push(ShowFault{number, (shown->entry + by + places) % places}); };
    if (small_button(frame, "<"))
        go(-1);
    ImGui::SameLine(0, 4 * frame.ui.scale);
    // on the line of the buttons' texts
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 2 * frame.ui.scale);
    ImGui::TextUnformatted(fmt::format("{} of {}", shown->entry + 1, places).c_str());
    ImGui::SameLine(0, 4 * frame.ui.scale);
    if (small_button(frame, ">"))
        go(1);
    if (!finding.what.empty())
        list_of_places(frame, number, finding);
}

/// What this program can do about a fault itself.
enum class Fix { none, keep_largest, weld, close_crack, cut_corners };

Fix fix_of(Frame& frame, const Finding& finding)
{
    if (finding.weld_gap)
        return Fix::close_crack;
    switch (finding.fault) {
    case Fault::several_components:
    case Fault::crowded_edge: return read_options(frame).doctor.keep_largest ? Fix::none : Fix::keep_largest;
    case Fault::coincident_vertex: return finding.severity == spia::Severity::note ? Fix::weld : Fix::none;
    case Fault::closed_corner: return Fix::cut_corners;
    default: return Fix::none;
    }
}

void fix_button(Frame& frame, const Finding& finding)
{
    const Fix fix = fix_of(frame, finding);
    if (fix == Fix::none)
        return;
    const auto button = [&](const char* label) {
        if (!finding.place.empty())
            beside_if_room(label);
        return small_button(frame, label);
    };
    ImGui::BeginDisabled(frame.model.busy());
    std::string hint;
    switch (fix) {
    case Fix::keep_largest:
        if (button("Keep the largest piece"))
            read_with(frame, [](Reading& reading) { reading.keep_largest = true; });
        hint =
            "Reads the part again with the largest connected piece only; faces attached at edges of three faces are left out too. Undo restores them.";
        break;
    case Fix::weld:
        if (button("Weld vertices"))
            read_with(frame, [](Reading& reading) { reading.weld = true; });
        hint = "Reads the part again and welds vertices at the same place. Undo separates them again.";
        break;
    case Fix::close_crack:
        if (button("Close the crack"))
            read_with(frame, [&](Reading& reading) {
                reading.weld = true;
                reading.weld_gap_mm = finding.weld_gap;
            });
        hint = fmt::format("Reads the part again and joins open edges up to {} apart. Undo separates them again.",
                           length_text(*finding.weld_gap, frame.lengths()));
        break;
    case Fix::cut_corners:
        if (button("Cut the corners"))
            frame.actions.push(SetSeam{{SeamOptions::Mode::corners}});
        hint = "Reads the part again and cuts it from these corners to its border. Undo joins them again.";
        break;
    case Fix::none: break;
    }
    ImGui::EndDisabled();
    tooltip(hint);
}

/// Which faces of a CAD file are read: of a solid those of one skin.
void cad_faces(Frame& frame, const PartFile& part)
{
    if (!part.cad)
        return;
    const ReadOptions& read = read_options(frame);
    std::string text;
    for (const std::string& each : read.parts)
        text += (text.empty() ? "" : ", ") + each;
    ImGui::BeginDisabled(frame.model.busy());
    ImGui::SetNextItemWidth(170 * frame.ui.scale);
    if (typed_text(frame, "Parts", text, fmt::format("all {} faces", part.cad->faces).c_str())) {
        std::vector<std::string> parts;
        std::string one;
        for (const char c : text + ",")
            if (c == ',') {
                if (!one.empty())
                    parts.push_back(std::exchange(one, ""));
            } else if (c != ' ')
                one += c;
        read_with(frame, [&](Reading& reading) { reading.parts = parts; });
    }
    tooltip("Numbers of the CAD faces to read, counted from 0, e.g. 3, 10-19");
    if (!read.parts.empty() && small_button(frame, "All faces"))
        read_with(frame, [](Reading& reading) { reading.parts.clear(); });
    ImGui::EndDisabled();
}

/// What of the file is read, and the dialog of import once more.
void choose_again(Frame& frame, const PartFile& part)
{
    const bool other = shows_refused(frame.state);
    const std::filesystem::path& file = other ? frame.state.refused_file->file : frame.state.document.session.file;
    if (!has_choices(file))
        return;
    const std::vector<std::string>& chosen = read_options(frame).parts;
    if (part.deck && !chosen.empty()) {
        std::string all;
        for (const std::string& each : chosen) {
            const auto named = std::find_if(part.deck->parts.begin(), part.deck->parts.end(), [&](const DeckPart& p) {
                return p.id && std::to_string(*p.id) == each && !p.name.empty();
            });
            all += (all.empty() ? "" : ", ") + each + (named == part.deck->parts.end() ? "" : " " + named->name);
        }
        figure(frame, chosen.size() == 1 ? "Part" : "Parts", all);
    }
    ImGui::BeginDisabled(frame.model.busy());
    if (small_button(frame, "Import options..."))
        frame.actions.push(ListFile{file, !other});
    note_place(frame, "choose in the file");
    ImGui::EndDisabled();
    tooltip("Shows the contents of the file, to read it again with other options");
}

/// Which surface stands for a solid of sheet.
void solid_skin(Frame& frame, const PartFile& part)
{
    const ReadOptions& read = read_options(frame);
    if (!part.solid && !read.skin)
        return;
    const Skin now = part.solid ? part.solid->skin : *read.skin;
    ImGui::BeginDisabled(frame.model.busy());
    ImGui::SetNextItemWidth(170 * frame.ui.scale);
    if (ImGui::BeginCombo("Skin", name(now))) {
        for (const Skin skin : {Skin::outer, Skin::inner, Skin::middle})
            if (ImGui::Selectable(name(skin), skin == now) && skin != now)
                read_with(frame, [&](Reading& reading) { reading.skin = skin; });
        ImGui::EndCombo();
    } else
        tooltip(help_text(option::skin));
    ImGui::EndDisabled();
}

/// Well-shaped triangles in the place of those of the file.
void remeshing(Frame& frame, const PartFile* part)
{
    const std::optional<RemeshOptions>& now = frame.state.document.session.options.read.remesh;
    ImGui::BeginDisabled(frame.model.busy());
    const bool done = part && part->remeshed; // that of a CAD part unasked, too
    bool wanted = now || done;
    if (ImGui::Checkbox("Remesh", &wanted))
        frame.actions.push(SetRemeshing{wanted ? std::optional(RemeshOptions{}) : std::nullopt});
    tooltip(
        "Replaces slivers and triangles that are too coarse or too fine by even ones, within the tolerance. Deviations are still measured from the triangles of the file.");
    if (wanted && (now || done)) { // also where it was refused: other sizes may do
        const RemeshOptions before = now.value_or(RemeshOptions{});
        RemeshOptions edited = before;
        double size = done ? part->remeshed->size : before.size.value_or(0),
               tolerance = done ? part->remeshed->tolerance : before.tolerance.value_or(0);
        ImGui::SetNextItemWidth(100 * frame.ui.scale);
        if (length_input(frame, "Edges", size))
            edited.size = size;
        ImGui::SetNextItemWidth(100 * frame.ui.scale);
        if (length_input(frame, "Tolerance", tolerance, {.mm = "%.3g", .inch = "%.3g"}))
            edited.tolerance = tolerance;
        if (edited != before)
            frame.actions.push(SetRemeshing{edited});
    }
    ImGui::EndDisabled();
}

/// The gauge that the file gives, if it is not the one that is used.
void deck_gauge(Frame& frame, const PartFile& part)
{
    if (!part.thickness_mm)
        return;
    muted(frame, fmt::format("Thickness {} {}{}", part.solid ? "of the solid:" : "in the file:",
                             thickness_text(*part.thickness_mm, frame.lengths()),
                             part.material.empty() ? "" : fmt::format(", material \"{}\"", part.material)));
    if (*part.thickness_mm == frame.state.document.session.options.flatten.thickness || frame.model.busy())
        return;
    if (small_button(frame, ("Use " + thickness_text(*part.thickness_mm, frame.lengths())).c_str()))
        frame.actions.push(SetThickness{*part.thickness_mm});
}

/// One line each.
void reading_notes(Frame& frame, const std::vector<std::string>& notes)
{
    for (const std::string& note : notes) {
        const std::string text = engine_words(frame, note);
        constexpr size_t most = 300; // letters: a deck can have many keywords that are not read
        const size_t end = text.size() > most ? text.rfind(' ', most) : text.npos;
        const std::string shown = end == text.npos ? text : text.substr(0, end) + " ...";
        muted(frame, "-  " + shown);
        if (shown != text)
            tooltip(text);
    }
}

} // namespace

void refused_notice(Frame& frame)
{
    const ViewerState& state = frame.state;
    if (!state.refused || !state.refused_file)
        return;
    const std::string open = state.document.session.file.filename().string();
    coloured(palette_of(state.view.dark).error, state.refused_file->file.filename().string() + " was refused.");
    if (state.refused_file->shown) {
        if (small_button(frame, ("Back to " + open).c_str()))
            frame.actions.push(CloseRefused{});
        tooltip("Closes the refused file");
        return;
    }
    if (small_button(frame, "Show its faults"))
        frame.actions.push(ShowRefused{});
    tooltip("In the view of the part, until you go back to " + open);
    ImGui::SameLine();
    if (small_button(frame, "Close"))
        frame.actions.push(CloseRefused{});
    tooltip("Forgets the refused file");
}

void doctor_panel(Frame& frame)
{
    const ViewerState& state = frame.state;
    const PartFile* part = examined(state);
    const bool refused = part && part == state.refused.get();
    if (!part) {
        if (!state.document.session.file.empty() && state.document.session.options.read.remesh)
            remeshing(frame, nullptr);
        return;
    }
    choose_again(frame, *part);
    cad_faces(frame, *part);
    solid_skin(frame, *part);
    if (!refused)
        remeshing(frame, part);
    if (!shows_refused(state))
        deck_gauge(frame, *part);
    const std::vector<std::string> notes = notes_on_reading(*part);
    const auto& findings = part->doctor.findings;
    if (findings.empty() && notes.empty())
        return;
    const Palette p = palette_of(state.view.dark);
    const auto fatal = std::count_if(findings.begin(), findings.end(),
                                     [](const Finding& f) { return f.severity == spia::Severity::fatal; });
    const size_t count = notes.size() + findings.size();
    const std::string title = refused
                                  ? fmt::format("Refused: {}", fatal == 1 ? "1 fault" : fmt::format("{} faults", fatal))
                              : count == 1 ? "1 note on the file"
                                           : fmt::format("{} notes on the file", count);
    // What can be done better with one click is not hidden behind another.
    const auto has_fix = [&](const Finding& f) { return fix_of(frame, f) != Fix::none; };
    const bool fixes = std::any_of(findings.begin(), findings.end(), has_fix);
    ImGui::PushStyleColor(ImGuiCol_Text, refused ? p.error : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    const bool open = ImGui::TreeNodeEx(refused ? "refused"
                                        : fixes ? "fixes"
                                                : "doctor",
                                        refused || fixes ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None,
                                        "%s", title.c_str());
    ImGui::PopStyleColor();
    if (open) {
        std::vector<int> order(findings.size());
        for (size_t i = 0; i < order.size(); ++i)
            order[i] = int(i);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            // the grave ones first
            const Finding &f = findings[size_t(a)], &g = findings[size_t(b)];
            return std::pair(f.severity, has_fix(f)) > std::pair(g.severity, has_fix(g));
        });
        for (const int i : order) {
            const Finding& finding = findings[size_t(i)];
            ImGui::PushID(i);
            coloured(finding.severity == spia::Severity::fatal ? p.error : ImGui::GetStyleColorVec4(ImGuiCol_Text),
                     as_sentence(engine_words(frame, finding.text)));
            if (!finding.advice.empty())
                muted(frame, as_sentence(engine_words(frame, finding.advice)));
            show_buttons(frame, i, finding);
            fix_button(frame, finding);
            ImGui::Dummy({0, 2 * frame.ui.scale});
            ImGui::PopID();
        }
        reading_notes(frame, notes);
        ImGui::TreePop();
    }
}

} // namespace spia::viewer

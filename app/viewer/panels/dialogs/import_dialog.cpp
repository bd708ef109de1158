#include "app/viewer/panels/dialogs/import_dialog.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/picking/picking.h"
#include "app/viewer/model/reports/typed_number.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/view_tools.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/text.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

bool is_cad_file(const FileItems& items) { return items.kind == FileKind::cad; }

/// The choices that stand when the file appears: those that the part was read with if it is its
/// file.
void begin_choices(const Frame& frame, const std::shared_ptr<const ListedFile>& listed)
{
    ImportChoices fresh;
    fresh.about = listed;
    fresh.worker =
        frame.ui.importing.worker ? frame.ui.importing.worker : std::make_shared<Worker>([] { glfwPostEmptyEvent(); });
    const Session& session = frame.state.document.session;
    if (frame.state.listing->again) {
        const ReadOptions& read = session.options.read;
        ChosenItems items = items_of(listed->items, read.parts);
        fresh.chosen = std::move(items.item);
        fresh.others = std::move(items.others);
        fresh.weld = read.weld;
        fresh.weld_gap = read.doctor.weld_gap;
        fresh.unit = read.unit ? std::string(name(*read.unit)) : "";
        fresh.skin = read.skin;
        fresh.keep_largest = read.doctor.keep_largest;
        fresh.leave_out_bad_faces = read.cad.leave_out_unmeshed;
        fresh.keep_triangles = read.cad.keep_triangles;
        const auto typed = [&](const std::optional<double>& mm) {
            return mm ? fmt::format("{}", shown_length(*mm, frame.lengths())) : std::string();
        };
        fresh.sewing = typed(read.cad.sewing_tolerance);
        fresh.deflection = typed(read.cad.deflection);
    } else {
        fresh.chosen.assign(listed->items.item.size(), 0);
        if (const int item = proposed_item(listed->items); item >= 0)
            fresh.chosen[size_t(item)] = 1;
    }
    frame.ui.importing = std::move(fresh);
}

/// A length that was typed: nothing if the field is empty; false if it is none of those that
/// projects keep.
bool read_length(const std::string& text, LengthUnit unit, const Between& range, std::optional<double>& mm)
{
    mm.reset();
    if (text.find_first_not_of(' ') == text.npos)
        return true;
    auto value = typed_number_of(text, {length_word(unit)});
    if (value && unit != LengthUnit::mm) // without the rounding of there and back
        value = std::stod(fmt::format("{:.12g}", kept_length(*value, unit)));
    if (!value || !(*value >= range.least && *value <= range.greatest))
        return false;
    mm = value;
    return true;
}

std::string size_words(const ListedFile& listed, LengthUnit lengths)
{
    if (!listed.picker)
        return "";
    const bool known = is_cad_file(listed.items); // else the file has a unit that only the user
                                                  // knows
    const Eigen::Vector3d size = listed.picker->box().sizes() / (known ? millimetres(lengths) : 1);
    return fmt::format("{:.4g} x {:.4g} x {:.4g}{}{}", size.x(), size.y(), size.z(), known ? " " : "",
                       known ? length_word(lengths) : "");
}

/// What the file calls its unit, as people write it.
std::string unit_words(const std::string& as_written)
{
    const std::string unit = lower_case(as_written);
    return unit == "millimetre" || unit == "millimeter" ? "mm" : unit == "metre" || unit == "meter" ? "m" : unit;
}

void summary_line(const Frame& frame, const ListedFile& listed)
{
    const FileItems& items = listed.items;
    std::string text =
        items.format + (items.unit.empty() ? ", no length unit given" : ", lengths in " + unit_words(items.unit));
    if (const std::string size = size_words(listed, frame.lengths()); !size.empty())
        text += ", " + size;
    muted(frame, text);
}

/// What an item is called; in decks numbers are known as well as names.
std::string item_words(const FileItems& items, const FileItem& item)
{
    if (item.name.empty())
        return item.choice.empty() ? item.kind : item.choice;
    return is_cad_file(items) || item.choice.empty() || item.choice == item.name ? item.name
                                                                                 : item.choice + "  " + item.name;
}

std::string item_figures(const FileItems& items, const FileItem& item, LengthUnit lengths)
{
    std::string text = fmt::format("{}, {} {}{}", item.kind, item.faces, is_cad_file(items) ? "face" : "shell",
                                   item.faces == 1 ? "" : "s");
    if (item.thickness)
        text += ", thickness " + (is_cad_file(items) ? thickness_text(*item.thickness, lengths)
                                                     : fmt::format("{:.4g}", *item.thickness));
    if (!item.material.empty())
        text += ", " + item.material;
    return text;
}

void choose(ImportChoices& choices, int item, bool add)
{
    const bool was = choices.chosen[size_t(item)] != 0;
    const auto count = std::count(choices.chosen.begin(), choices.chosen.end(), char(1));
    if (!add) {
        std::fill(choices.chosen.begin(), choices.chosen.end(), char(0));
        choices.others.clear();
    }
    choices.chosen[size_t(item)] = add ? !was : !was || count > 1;
}

/// What was chosen and is no item; a click leaves it out.
void other_choices(ImportChoices& choices)
{
    for (size_t i = 0; i < choices.others.size(); ++i) {
        ImGui::PushID(int(i));
        const bool leave_out = ImGui::Selectable(("Faces " + choices.others[i]).c_str(), true);
        ImGui::PopID();
        if (leave_out) {
            choices.others.erase(choices.others.begin() + long(i));
            break;
        }
    }
}

/// The items as a list, those that hold others before these and farther to the left.
void item_list(Frame& frame, const ListedFile& listed, ImVec2 size)
{
    ImportChoices& choices = frame.ui.importing;
    const FileItems& items = listed.items;
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    std::optional<int> hovered;
    ImGui::BeginChild("items", size, true);
    const bool everything = choices.others.empty() &&
                            std::none_of(choices.chosen.begin(), choices.chosen.end(), [](char c) { return c != 0; });
    if (ImGui::Selectable("The whole file", everything)) {
        std::fill(choices.chosen.begin(), choices.chosen.end(), char(0));
        choices.others.clear();
    }
    note_place(frame, "import whole");
    other_choices(choices);
    ImGui::Dummy({0, 2 * s});
    const float row = 2 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    if (std::exchange(choices.fresh, false)) // what is proposed is in sight
        if (const auto first = std::find(choices.chosen.begin(), choices.chosen.end(), char(1));
            first != choices.chosen.end())
            ImGui::SetScrollY(
                std::max(0.f, ImGui::GetCursorPosY() + row * float(first - choices.chosen.begin()) - size.y / 2));
    ImGuiListClipper rows; // a car has ten thousand parts
    rows.Begin(int(items.item.size()), row);
    while (rows.Step())
        for (int i = rows.DisplayStart; i < rows.DisplayEnd; ++i) {
            const FileItem& item = items.item[size_t(i)];
            ImGui::PushID(i);
            const float indent = 14 * s * float(std::min(listed.depth[size_t(i)], 8));
            if (indent > 0)
                ImGui::Indent(indent);
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float line = ImGui::GetTextLineHeight(), room = ImGui::GetContentRegionAvail().x;
            ImGui::BeginDisabled(item.choice.empty() || item.faces == 0);
            if (ImGui::Selectable("##item", choices.chosen[size_t(i)] != 0, 0, {0, 2 * line}))
                choose(choices, i, ImGui::GetIO().KeyCtrl);
            ImGui::EndDisabled();
            note_place(frame, fmt::format("import item {}", i));
            if (ImGui::IsItemHovered()) {
                hovered = i;
                tooltip(item_words(items, item) + "\n" + item_figures(items, item, frame.lengths()) +
                        (item.choice.empty() ? "" : "\nClick to choose it, Ctrl + click to add it"));
            }
            ImDrawList* draw = ImGui::GetWindowDrawList();
            draw->PushClipRect(at, {at.x + room, at.y + 2 * line}, true);
            draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), item_words(items, item).c_str());
            draw->AddText(frame.ui.fonts.small, frame.ui.fonts.small->FontSize, {at.x, at.y + line}, ink(p.muted),
                          item_figures(items, item, frame.lengths()).c_str());
            draw->PopClipRect();
            if (indent > 0)
                ImGui::Unindent(indent);
            ImGui::PopID();
        }
    ImGui::EndChild();
    if (hovered || ImGui::IsItemHovered())
        choices.hovered = hovered;
}

/// Has the shape of what is chosen made: at once if that takes no time, else the one before stays
/// until it is ready.
void follow_choice(ImportChoices& choices)
{
    using Made = std::shared_ptr<const PreviewShape>;
    const auto& making = choices.making.of({choices.about, choices.chosen}, [&] {
        return choices.worker->later([listed = choices.about, chosen = choices.chosen]() -> Made {
            return std::make_shared<PreviewShape>(preview_shape(*listed, chosen));
        });
    });
    constexpr int quick = 100'000; // triangles
    if (choices.about->mesh.triangles() <= quick)
        making.wait();
    if (making.ready())
        choices.shape = making.get();
}

/// The preview: turned and zoomed like the views; a click chooses the item there.
void preview(Frame& frame, const ListedFile& listed, ImVec2 size)
{
    ImportChoices& choices = frame.ui.importing;
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 at = ImGui::GetCursorScreenPos(), to{at.x + size.x, at.y + size.y};
    ImDrawList* draw = ImGui::GetWindowDrawList();
    ImGui::InvisibleButton("preview", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    note_place(frame, "import preview");
    const glm::dvec2 view(size.x, size.y), pixel(io.MousePos.x - at.x, io.MousePos.y - at.y);
    if (listed.mesh.triangles() == 0) {
        draw->AddText({at.x + 12, at.y + 12}, ImGui::GetColorU32(ImGuiCol_TextDisabled), "No faces to show");
        draw->AddRect(at, to, ImGui::GetColorU32(ImGuiCol_Border));
        return;
    }
    if (choices.camera == Camera{})
        choices.camera = import_camera(listed, view);
    const MouseStyle style = frame.state.view.mouse;
    const float slack = click_slack * frame.ui.scale;
    const bool left_is_free = true; // a click chooses, a drag may turn
    const Navigator::Step step =
        choices.navigator.follow(style, mouse_held(), mouse_pressed(), glm::dvec2(io.MouseDelta.x, io.MouseDelta.y),
                                 ImGui::IsItemHovered(), left_is_free, slack);
    choices.camera = step.centre ? pan(choices.camera, view / 2. - pixel, view) : moved(choices.camera, step, view);
    if (ImGui::IsItemActivated()) {
        choices.left = ImGui::IsMouseDown(0);
        choices.moved = false;
    }
    choices.moved |= ImGui::IsItemActive() && ImGui::IsMouseDragging(0, slack);
    if (ImGui::IsItemHovered() && io.MouseWheel != 0)
        choices.camera = zoom(choices.camera, wheel_factor(style), pixel, view);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
        const RayHit hit = hit_at(choices.camera, *listed.picker, pixel, view);
        choices.hovered.reset();
        if (hit.face >= 0) {
            const int p = listed.polygon[size_t(hit.face)], item = listed.items.item_of[size_t(p)];
            if (item >= 0)
                choices.hovered = item;
            ImGui::SetTooltip(
                "%s%s %d", item >= 0 ? (item_words(listed.items, listed.items.item[size_t(item)]) + ", ").c_str() : "",
                is_cad_file(listed.items) ? "face" : "shell", listed.items.face_of[size_t(p)]);
        }
    }
    if (ImGui::IsItemDeactivated() && choices.left && !choices.moved && choices.hovered &&
        !listed.items.item[size_t(*choices.hovered)].choice.empty())
        choose(choices, *choices.hovered, io.KeyCtrl);
    const ImVec2 dots = io.DisplayFramebufferScale;
    follow_choice(choices);
    if (!choices.shape) {
        draw->AddText({at.x + 12, at.y + 12}, ImGui::GetColorU32(ImGuiCol_TextDisabled), "Preparing the preview");
        draw->AddRect(at, to, ImGui::GetColorU32(ImGuiCol_Border));
        return;
    }
    const Scene& scene = choices.scene.of({choices.shape, choices.hovered},
                                          [&] { return import_scene(listed, *choices.shape, choices.hovered); });
    if (!frame.draw_small)
        return;
    if (const ImTextureID texture = frame.draw_small(scene, choices.camera, int(size.x * dots.x), int(size.y * dots.y)))
        draw->AddImage(texture, at, to, {0, 1}, {1, 0});
    draw->AddRect(at, to, ImGui::GetColorU32(ImGuiCol_Border));
}

void unit_choice(Frame& frame, const FileItems& items)
{
    ImportChoices& choices = frame.ui.importing;
    const bool stated = !items.unit.empty() && is_cad_file(items);
    ImGui::BeginDisabled(stated);
    const std::string own = items.unit.empty() ? "mm" : unit_words(items.unit);
    const std::string shown = !choices.unit.empty() ? choices.unit : own;
    if (ImGui::BeginCombo("Unit", shown.c_str())) {
        if (!items.unit.empty() && ImGui::Selectable((own + " (of the file)").c_str(), choices.unit.empty()))
            choices.unit.clear();
        for (const char* unit : {"mm", "cm", "m", "inch"})
            if (ImGui::Selectable(unit, shown == unit))
                choices.unit = unit;
        ImGui::EndCombo();
    }
    ImGui::EndDisabled();
    if (!ImGui::IsPopupOpen("##Combo", ImGuiPopupFlags_AnyPopupId))
        tooltip(stated ? "The length unit is stated in the file" : "Length unit of the coordinates in the file");
}

void skin_choice(ImportChoices& choices)
{
    if (ImGui::BeginCombo("Skin", choices.skin ? name(*choices.skin) : "automatic")) {
        if (ImGui::Selectable("automatic", !choices.skin))
            choices.skin.reset();
        for (const Skin skin : {Skin::outer, Skin::inner, Skin::middle})
            if (ImGui::Selectable(name(skin), skin == choices.skin))
                choices.skin = skin;
        ImGui::EndCombo();
    } else
        tooltip(
            "For solids: the skin to read, or the middle surface. Automatic: the middle surface where the solid is a sheet");
}

void length_field(const Frame& frame, const char* label, std::string& text, bool sound, const char* help)
{
    if (!sound)
        ImGui::PushStyleColor(ImGuiCol_Text, palette_of(frame.state.view.dark).error);
    text_input(label, text, false, "automatic");
    if (!sound)
        ImGui::PopStyleColor();
    tooltip(help);
}

/// @returns the choices as they are read; nothing if a number is none
std::optional<Reading> reading_fields(Frame& frame, const FileItems& items)
{
    ImportChoices& choices = frame.ui.importing;
    Reading reading;
    reading.parts = choices_of(items, choices.chosen);
    reading.parts.insert(reading.parts.end(), choices.others.begin(), choices.others.end());
    reading.weld = choices.weld;
    reading.weld_gap_mm = choices.weld_gap;
    const bool sewing = read_length(choices.sewing, frame.lengths(), gap_width, reading.sewing_mm),
               deflection = read_length(choices.deflection, frame.lengths(), chord_height, reading.deflection_mm);
    const float s = frame.ui.scale, width = 118 * s;
    if (ImGui::BeginTable("options", 2, ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        ImGui::SetNextItemWidth(width);
        unit_choice(frame, items);
        if (is_cad_file(items)) {
            ImGui::TableNextColumn();
            ImGui::SetNextItemWidth(width);
            skin_choice(choices);
            ImGui::TableNextColumn();
            ImGui::SetNextItemWidth(width);
            length_field(
                frame, in_unit("Close gaps up to", frame.lengths()).c_str(), choices.sewing, sewing,
                "Gaps between faces up to this width are closed. Empty: found from the gaps; 0: no gaps are closed.");
            ImGui::TableNextColumn();
            ImGui::SetNextItemWidth(width);
            length_field(frame, in_unit("Chord height", frame.lengths()).c_str(), choices.deflection, deflection,
                         "Largest distance of the triangles from the CAD faces. Empty: 1/2000 of the part's diagonal.");
        }
        ImGui::EndTable();
    }
    ImGui::Checkbox("Keep only the largest connected piece", &choices.keep_largest);
    tooltip("Of the chosen items. Otherwise a part in several pieces is refused, and the step Part lists them.");
    if (is_cad_file(items)) {
        ImGui::Checkbox("Leave out faces that cannot be meshed", &choices.leave_out_bad_faces);
        tooltip("They are listed and the rest is read. Otherwise the part is refused.");
        reading.leave_out_bad_faces = choices.leave_out_bad_faces;
        reading.keep_triangles = choices.keep_triangles;
    }
    reading.skin = choices.skin;
    reading.keep_largest = choices.keep_largest;
    return sewing && deflection ? std::optional(reading) : std::nullopt;
}

/// How much is chosen, and how to choose more.
void choice_line(const Frame& frame, const FileItems& items)
{
    const ImportChoices& choices = frame.ui.importing;
    size_t chosen = choices.others.size();
    std::string names;
    for (size_t i = 0; i < choices.chosen.size(); ++i)
        if (choices.chosen[i] != 0 && ++chosen <= 3)
            names += (names.empty() ? "" : ", ") + item_words(items, items.item[i]);
    muted(frame, chosen == 0
                     ? fmt::format("All {} of the file will be read. Click items in the list or the picture to choose",
                                   is_cad_file(items) ? "faces" : "shells")
                     : fmt::format("{} chosen{}{}{}. Ctrl + click to add", chosen, names.empty() ? "" : ": ", names,
                                   chosen > 3 ? ", ..." : ""));
}

/// What the file left to say, in one line; all of it under the mouse.
void notes_line(const Frame& frame, const FileItems& items)
{
    if (items.notes.empty())
        return;
    std::string all, line;
    for (const std::string& note : items.notes) {
        const std::string text = as_sentence(engine_words(frame, note));
        all += (all.empty() ? "" : "\n") + text;
        line += (line.empty() ? "" : ". ") + text;
    }
    const float room = ImGui::GetContentRegionAvail().x;
    const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
    if (width(line) > room) {
        while (!line.empty() && width(line + " ...") > room)
            line.resize(line.find_last_of(' ') == line.npos ? 0 : line.find_last_of(' '));
        line += " ...";
    }
    muted(frame, line);
    tooltip(all);
}

void progress_or_failure(Frame& frame, const FileListing& listing)
{
    const float s = frame.ui.scale;
    if (!listing.failure.empty()) {
        coloured(palette_of(frame.state.view.dark).error, as_sentence(engine_words(frame, listing.failure)));
        return;
    }
    muted(frame, listing.step.empty() ? "Reading the contents of the file" : as_sentence(listing.step));
    ImGui::ProgressBar(float(listing.fraction), {-1, 6 * s}, "");
}

} // namespace

void import_dialog(Frame& frame)
{
    const auto& listing = frame.state.listing;
    ImportChoices& choices = frame.ui.importing;
    if (!listing) {
        if (choices.about) // nothing of the file stays in memory
            std::exchange(choices, {}).worker.swap(choices.worker);
        return;
    }
    if (!begin_dialog(frame, "Import a part", true, 860))
        return;
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted(listing->file.filename().c_str());
    ImGui::PopFont();
    std::optional<Reading> reading;
    if (const auto& listed = listing->listed) {
        if (choices.about != listed)
            begin_choices(frame, listed);
        summary_line(frame, *listed);
        const float s = frame.ui.scale, height = std::min(380 * s, ImGui::GetIO().DisplaySize.y - 350 * s);
        const float wide = ImGui::GetContentRegionAvail().x, list = std::floor(0.38f * wide);
        item_list(frame, *listed, {list, height});
        ImGui::SameLine();
        preview(frame, *listed, {ImGui::GetContentRegionAvail().x, height});
        choice_line(frame, listed->items);
        notes_line(frame, listed->items);
        reading = reading_fields(frame, listed->items);
    } else
        progress_or_failure(frame, *listing);
    ImGui::Separator();
    const bool typing = ImGui::GetIO().WantTextInput;
    // While a job runs a part cannot be read again, and none is opened during an export.
    const bool possible = reading && !(listing->again && frame.model.busy()) && !frame.model.exporting();
    const Answer answer = answer_buttons(frame, listing->again ? "Read again" : "Open", possible,
                                         palette_of(frame.state.view.dark).accent);
    note_place(frame, "import open");
    // closes it unless it is refused
    if (possible && (answer == Answer::yes || (enter_pressed(frame) && !typing))) {
        if (listing->again)
            frame.actions.push(ReadAgain{choices.unit, *reading});
        else
            frame.actions.push(OpenPart{listing->file, choices.unit, *reading});
    } else if (answer == Answer::cancel || (pressed(frame, GLFW_KEY_ESCAPE) && !typing)) {
        frame.actions.push(CloseList{});
        ImGui::CloseCurrentPopup();
    }
    end_dialog();
}

} // namespace spia::viewer

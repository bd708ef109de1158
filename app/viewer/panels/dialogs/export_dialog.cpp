#include "app/viewer/panels/dialogs/export_dialog.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/lights.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/error.h"
#include "engine/pipeline/outputs/iga_outputs.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

constexpr double least_dxf_tolerance = 1e-6, most_dxf_tolerance = 1; // mm, as in scripts

ExportChoices::Planned planned_files(const Session& session, const ExportChoices& choices)
{
    ExportChoices::Planned planned;
    try {
        planned.files = output_files(session, choices.folder, choices.formats, choices.options);
        for (const fs::path& file : planned.files) {
            std::error_code ignored;
            planned.exists.push_back(fs::exists(file, ignored));
        }
    } catch (const InputError& error) {
        planned.problem = error.what();
    }
    return planned;
}

/// How well the surface fits and how much is held against the result, the louder the worse.
void verdict_banner(const Frame& frame, const ExportVerdict& verdict)
{
    const Palette p = palette_of(frame.state.view.dark);
    const bool loud = verdict.kind == ExportVerdict::Kind::bad, warns = verdict.kind == ExportVerdict::Kind::warning;
    const ImVec4 colour = loud ? under_white(p.error) : warns ? p.warning : p.good;
    const float s = frame.ui.scale, pad = (loud ? 12 : 8) * s, bar = 5 * s;
    const float large = loud ? 1.3f : 1.f;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, room = width - 2 * pad - bar;
    ImFont* bold = frame.ui.fonts.bold;
    ImGui::PushFont(bold);
    const std::string headline = broken(verdict.headline, room / large);
    const float head = ImGui::CalcTextSize(headline.c_str()).y * large, letter = bold->FontSize * large;
    ImGui::PopFont();
    const std::string words = broken(verdict.text, room);
    const float gap = 3 * s, height = 2 * pad + head + gap + ImGui::CalcTextSize(words.c_str()).y;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec4 ground(colour.x, colour.y, colour.z, loud ? 1.f : 0.12f);
    draw->AddRectFilled(at, {at.x + width, at.y + height}, ink(ground), 4 * s);
    draw->AddRectFilled(at, {at.x + bar, at.y + height}, ink(colour), 4 * s, ImDrawFlags_RoundCornersLeft);
    const ImU32 text_ink = loud ? IM_COL32(255, 255, 255, 255) : ImGui::GetColorU32(ImGuiCol_Text);
    draw->AddText(bold, letter, {at.x + bar + pad, at.y + pad}, loud ? text_ink : ink(colour), headline.c_str());
    draw->AddText({at.x + bar + pad, at.y + pad + head + gap}, text_ink, words.c_str());
    ImGui::Dummy({width, height});
}

/// Goes on below a child that begins there and is to have this height from the next frame on. In
/// the hidden frame in which a dialog opens the height of its content is not known before it is
/// drawn, but its own is taken from there.
void go_on_below_child(float begin, float height)
{
    ImGui::SetCursorPosY(begin + height + ImGui::GetStyle().ItemSpacing.y);
}

/// What is held against the result, each with its way out; scrolls where it is long. @returns
/// whether a click asked to see it
bool show_doubts(Frame& frame)
{
    const float least = 1, most = 118 * frame.ui.scale, begin = ImGui::GetCursorPosY();
    float& height = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("height of the list"), least);
    begin_scrolled(frame, "held against it", std::clamp(height, least, most));
    const float top = ImGui::GetCursorPosY();
    const bool looks = all_doubt_rows(frame);
    height = ImGui::GetCursorPosY() - top;
    ImGui::EndChild();
    go_on_below_child(begin, std::clamp(height, least, most));
    return looks;
}

bool format_box(std::vector<std::string>& formats, const char* format, const char* text)
{
    bool on = std::find(formats.begin(), formats.end(), format) != formats.end();
    if (ImGui::Checkbox(text, &on)) {
        std::erase(formats, format);
        if (on)
            formats.push_back(format);
    }
    return on;
}

/// Boxes in a row, a new row where the next one would not fit.
template <size_t n> void boxes(const Frame& frame, const std::array<std::pair<const char*, bool*>, n>& each)
{
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x, gap = 12 * frame.ui.scale;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {3 * frame.ui.scale, 2 * frame.ui.scale});
    bool first = true;
    for (const auto& [label, on] : each) {
        const float width = ImGui::CalcTextSize(label).x + ImGui::GetFrameHeight() + 6 * frame.ui.scale;
        if (!std::exchange(first, false) && ImGui::GetItemRectMax().x + gap + width < right)
            ImGui::SameLine(0, gap);
        ImGui::Checkbox(label, on);
    }
    ImGui::PopStyleVar();
}

/// The surface for isogeometric analysis.
void iga_formats_boxes(const Frame& frame, std::vector<std::string>& formats)
{
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("Analysis directly on the NURBS surface (IGA)");
    ImGui::PopFont();
    const std::array<std::array<const char*, 3>, 4> each = {
        {{"gismo", "G+Smo XML  surface, thickness, plastic strain",
          "Three files: the surface with its patches and borders, the thickness, the plastic strain."},
         {"mfem", "MFEM NURBS mesh  thickness, plastic strain",
          "The surface as a NURBS mesh (v1.0), thickness and plastic strain in a file each."},
         {"geopdes", "GeoPDEs text  the surface",
          "The surface as NURBS text (v2.1), also read by octave-nurbs; without thickness and strain."},
         {"iga-k", "LS-DYNA *IGA_SHELL  mean thickness",
          "*IGA_2D_NURBS_XYZ, *IGA_FACE_XYZ and *IGA_SHELL with section, part and an elastic material. One thickness for the whole surface, the mean; without plastic strain."}}};
    for (const auto& [format, label, explanation] : each) {
        format_box(formats, format, label);
        tooltip(explanation);
    }
}

/// What goes back to a solver deck, with its ids.
void solver_formats(const Frame& frame, std::vector<std::string>& formats)
{
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("Back to the solver");
    ImGui::PopFont();
    const bool deck = frame.state.document.session.part && frame.state.document.session.part->deck;
    const std::string ids = deck
                                ? "Ids, corners and unit are those of the deck."
                                : "The part is not from a solver deck: its triangles and vertices are numbered from 1.";
    const std::array<std::array<const char*, 3>, 7> each = {
        {{"dynain", "LS-DYNA dynain  thickness and plastic strain",
          "Nodes, shells with the thickness at their corners (*ELEMENT_SHELL_THICKNESS), effective plastic strain "
          "(*INITIAL_STRESS_SHELL, its stresses are 0) and strain (*INITIAL_STRAIN_SHELL), to be included in a crash deck."},
         {"nastran", "Nastran  thickness, strains as a table",
          "Bulk data with the thickness at the corners of CQUAD4 and CTRIA3 (T1 to T4), to be included, and a CSV table of the "
          "elements' strains."},
         {"mapping", "CSV  mapping tables by id",
          "Per element: thickness, thinning, plastic strain, major and minor strain. Per node: position in the blank."},
         {"blank-k", "Blank as a mesh, LS-DYNA .k", "The blank with the elements of the part; quads stay quads."},
         {"blank-bdf", "Blank as a mesh, Nastran .bdf", "The blank with the elements of the part; quads stay quads."},
         {"blank-inp", "Blank as a mesh, Abaqus .inp", "The blank with the elements of the part; quads stay quads."},
         {"blank-msh", "Blank as a mesh, Gmsh .msh",
          "The blank with the elements of the part; quads stay quads. Format 2.2, text."}}};
    for (const auto& [format, label, explanation] : each) {
        format_box(formats, format, label);
        tooltip(explanation + ("\n" + ids));
    }
}

/// The next choice of the DXF file: all are as wide as the longest label lets them.
void dxf_item()
{
    const float label = ImGui::CalcTextSize("Within, inch").x + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(std::max(1.f, ImGui::GetContentRegionAvail().x - label));
}

/// A choice of a few.
template <class T, size_t n>
bool choice(const char* label, T& value, const std::array<std::pair<T, const char*>, n>& each, const char* help)
{
    const auto now = std::find_if(each.begin(), each.end(), [&](const auto& entry) { return entry.first == value; });
    bool changed = false;
    dxf_item();
    if (ImGui::BeginCombo(label, now->second)) {
        for (const auto& [entry, text] : each)
            if (ImGui::Selectable(text, entry == value)) {
                changed = entry != value;
                value = entry;
            }
        ImGui::EndCombo();
    } else
        tooltip(help);
    return changed;
}

/// What the outline is drawn as, and for which programs.
void dxf_choices(Frame& frame, DxfOptions& dxf)
{
    if (choice("Curves", dxf.curves,
               std::array{std::pair{DxfCurves::arcs, "arcs, else polylines"},
                          std::pair{DxfCurves::splines, "arcs, else splines"},
                          std::pair{DxfCurves::polylines, "polylines only"}},
               "Circles, arcs and lines where they are found; the rest as polylines or splines through the vertices of "
               "the mesh") &&
        dxf.curves == DxfCurves::splines)
        dxf.version = DxfVersion::r2000;
    if (choice("Version", dxf.version,
               std::array{std::pair{DxfVersion::r2000, "R2000"}, std::pair{DxfVersion::r12, "R12"}},
               "R12 (AC1009) is what the oldest controls read; it has no splines. R2000 is AC1015.") &&
        dxf.version == DxfVersion::r12 && dxf.curves == DxfCurves::splines)
        dxf.curves = DxfCurves::arcs;
    ImGui::BeginDisabled(dxf.curves == DxfCurves::polylines);
    dxf_item();
    double within = dxf.tolerance;
    if (length_input(frame, "Within", within, {.mm = "%.4g", .inch = "%.5g"}))
        dxf.tolerance = std::clamp(within, least_dxf_tolerance, most_dxf_tolerance);
    tooltip("Largest distance of the outline from the curve that is drawn for it");
    ImGui::EndDisabled();
}

void formats_column(Frame& frame, ExportChoices& choices)
{
    auto& formats = choices.formats;
    GltfNodes& glb = choices.options.glb;
    CsvTables& csv = choices.options.csv;
    const float indent = ImGui::GetFrameHeight() + 6 * frame.ui.scale;
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("Formats");
    ImGui::PopFont();
    const bool surface = frame.state.document.session.surface != nullptr;
    ImGui::BeginDisabled(!surface);
    format_box(formats, "iges", "IGES  the NURBS surface for CAD");
    format_box(formats, "step", "STEP AP242  the NURBS surface for CAD");
    ImGui::EndDisabled();
    if (format_box(formats, "glb", "GLB  3D scene, results as colours")) {
        ImGui::Indent(indent);
        boxes(frame, std::array{std::pair{"Part", &glb.part}, std::pair{"Blank", &glb.blank},
                                std::pair{"Quad mesh", &glb.quad_mesh}, std::pair{"Surface", &glb.surface},
                                std::pair{"Control net", &glb.control_net}});
        ImGui::Unindent(indent);
    }
    format_box(formats, "vtu", "VTU  all results, for ParaView");
    if (format_box(formats, "dxf", "DXF  outline of the blank")) {
        ImGui::Indent(indent);
        dxf_choices(frame, choices.options.dxf);
        ImGui::Unindent(indent);
    }
    if (format_box(formats, "csv", "CSV  tables")) {
        ImGui::Indent(indent);
        boxes(frame, std::array{std::pair{"Results per vertex", &csv.fields}, std::pair{"Outline", &csv.outline},
                                std::pair{"Zones per face", &csv.faces}});
        ImGui::Unindent(indent);
    }
    format_box(formats, "png", "PNG  one picture of part, blank, grid and surface");
    ImGui::BeginDisabled(!surface);
    iga_formats_boxes(frame, formats);
    ImGui::EndDisabled();
    solver_formats(frame, formats);
}

void unit_input(const Frame& frame, LengthUnit& unit)
{
    ImGui::TextUnformatted("Lengths in");
    ImGui::SameLine(110 * frame.ui.scale);
    ImGui::SetNextItemWidth(-1);
    const std::string now(name_in_table(unit));
    if (ImGui::BeginCombo("##unit", now.c_str())) {
        for (const auto& [each, label] : names_of<LengthUnit>)
            if (ImGui::Selectable(std::string(label).c_str(), each == unit))
                unit = each;
        ImGui::EndCombo();
    }
    tooltip(
        "For IGES, STEP, isogeometric files, DXF, CSV and VTU; the file states the unit. GLB files are in metres as their specification requires, results for the solver in the unit of its deck.");
}

void files_list(const Frame& frame, const ExportChoices::Planned& planned)
{
    const Palette p = palette_of(frame.state.view.dark);
    if (!planned.problem.empty()) {
        coloured(p.error, engine_words(frame, planned.problem));
        return;
    }
    const auto replaced = std::count(planned.exists.begin(), planned.exists.end(), true);
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::Text("%d %s", int(planned.files.size()), planned.files.size() == 1 ? "file" : "files");
    ImGui::PopFont();
    if (replaced > 0) {
        ImGui::SameLine();
        ImGui::TextColored(p.warning, "%d will be replaced", int(replaced));
    }
    ImGui::PushFont(frame.ui.fonts.small);
    for (size_t k = 0; k < planned.files.size(); ++k) {
        ImGui::TextColored(planned.exists[k] ? p.warning : p.muted, "%s%s", planned.files[k].filename().c_str(),
                           planned.exists[k] ? "   replaced" : "");
        tooltip(planned.files[k].string());
    }
    ImGui::PopFont();
}

/// What the dialog shows from the click on: how far it is, then what was written and where.
/// @returns whether it is to be closed
bool outcome_of_export(Frame& frame)
{
    const Palette p = palette_of(frame.state.view.dark);
    const auto& outcome = frame.state.exported;
    if (!outcome) {
        ImGui::TextUnformatted("Writing the files");
        ImGui::ProgressBar(
            float(frame.state.job.fraction), {-1, 0},
            fmt::format("{:.0f} %  {}", 100 * frame.state.job.fraction, engine_words(frame, frame.state.job.step))
                .c_str());
        if (primary_button(frame, frame.state.job.cancelling ? "Stopping..." : "Cancel the export",
                           !frame.state.job.cancelling) ||
            pressed(frame, GLFW_KEY_ESCAPE))
            frame.actions.push(CancelJob{});
        return false;
    }
    ImGui::PushFont(frame.ui.fonts.bold);
    if (!outcome->error.empty())
        coloured(p.error, outcome->files.empty() ? "Nothing was written" : "Not all files were written");
    else if (outcome->cancelled)
        ImGui::TextUnformatted(outcome->files.empty() ? "Cancelled: nothing was written" : "Cancelled: written before");
    else
        coloured(p.good,
                 fmt::format("{} {} written", outcome->files.size(), outcome->files.size() == 1 ? "file" : "files"));
    ImGui::PopFont();
    if (!outcome->error.empty())
        coloured(ImGui::GetStyleColorVec4(ImGuiCol_Text), engine_words(frame, outcome->error));
    if (!outcome->files.empty()) {
        if (!outcome->error.empty())
            ImGui::TextUnformatted("These were:");
        muted(frame, outcome->files[0].parent_path().string());
        for (const fs::path& file : outcome->files)
            ImGui::BulletText("%s", file.filename().c_str());
    }
    return primary_button(frame, "Close") || enter_pressed(frame) || pressed(frame, GLFW_KEY_ESCAPE);
}

} // namespace

void export_dialog(Frame& frame)
{
    ExportChoices& choices = frame.ui.exporting;
    const Session& session = frame.state.document.session;
    const bool appears = std::exchange(frame.ui.show_export, false);
    if (appears) {
        follow(choices.folder, choices.suggested, suggested_file(frame, "-out").string());
        choices.planned = {}; // files may have come and gone
        choices.asked = choices.sent = false;
    }
    if (!begin_dialog(frame, "Export", appears, 720))
        return;
    if (choices.sent) {
        if (outcome_of_export(frame))
            ImGui::CloseCurrentPopup();
        end_dialog();
        return;
    }
    old_results_banner(frame);
    const float s = frame.ui.scale;
    const FitVerdict& fit = choices.verdict.of({session.surface}, [&] { return fit_verdict(session); });
    const bool writes_surface = std::ranges::any_of(
        choices.formats, [&](const std::string& format) { return holds_surface(format, choices.options); });
    const ExportVerdict verdict = export_verdict(frame.state, fit, writes_surface);
    verdict_banner(frame, verdict);
    if (verdict.doubts > 0 && show_doubts(frame))
        ImGui::CloseCurrentPopup(); // to see the views
    ImGui::Separator();

    const OutputOptions before = choices.options;
    const std::vector<std::string> formats_before = choices.formats;
    // The list is long: it scrolls where the window is low, and the buttons below it stay in sight.
    const float below = answer_buttons_height(frame) + 2 * ImGui::GetTextLineHeightWithSpacing() + 40 * s;
    const float room = ImGui::GetIO().DisplaySize.y - (ImGui::GetCursorScreenPos().y - ImGui::GetWindowPos().y) - below;
    const float least = 100 * s, most = std::max(least, room), begin = ImGui::GetCursorPosY();
    float& height = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("height of the choices"), least);
    ImGui::BeginChild("choices", {0, std::clamp(height, least, most)}, false, ImGuiWindowFlags_NavFlattened);
    const float top = ImGui::GetCursorPosY();
    if (ImGui::BeginTable("columns", 2)) {
        ImGui::TableSetupColumn("formats", ImGuiTableColumnFlags_WidthStretch, 1);
        ImGui::TableSetupColumn("where", ImGuiTableColumnFlags_WidthStretch, 1);
        ImGui::TableNextColumn();
        formats_column(frame, choices);
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        ImGui::PushFont(frame.ui.fonts.bold);
        ImGui::TextUnformatted("Files");
        ImGui::PopFont();
        ImGui::AlignTextToFramePadding();
        unit_input(frame, choices.options.unit);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted("Name");
        ImGui::SameLine(110 * s);
        ImGui::SetNextItemWidth(-1);
        text_input("##name", choices.options.name, false, session.file.stem().c_str());
        if (path_input(frame, "folder", choices.folder, "folder")) {
            ImGui::CloseCurrentPopup();
            frame.ui.files.open(FileDialog::Purpose::export_folder, choices.folder);
        }
        const auto& planned = choices.planned.of(
            {choices.folder, choices.formats, choices.options, session.blank, session.lifted, session.surface},
            [&] { return planned_files(session, choices); });
        files_list(frame, planned);
        ImGui::EndTable();
    }
    height = ImGui::GetCursorPosY() - top;
    ImGui::EndChild();
    go_on_below_child(begin, std::clamp(height, least, most));
    if (choices.options != before || choices.formats != formats_before)
        choices.asked = false;

    const auto& planned = choices.planned.of(
        {choices.folder, choices.formats, choices.options, session.blank, session.lifted, session.surface},
        [&] { return planned_files(session, choices); });
    const bool doubtful = fit.fit == Fit::far_off && std::ranges::any_of(choices.formats, is_of_surface);
    choices.asked &= doubtful;
    const bool busy = frame.model.busy();
    if (busy)
        muted(frame, "Files can be written as soon as the running job has ended.");
    if (choices.asked)
        coloured(palette_of(frame.state.view.dark).error,
                 "The exported surface does not represent the part. Click once more to export it anyway.");
    const bool ready = planned.problem.empty() && !planned.files.empty() && !choices.folder.empty() && !busy;
    const Palette p = palette_of(frame.state.view.dark);
    const Answer answer =
        answer_buttons(frame, choices.asked ? "Export anyway" : "Export", ready, choices.asked ? p.error : p.accent);
    const bool clicked = answer == Answer::yes;
    if (ready &&
        // the second time Return is not deliberate enough
        (clicked || (enter_pressed(frame) && !choices.asked))) {
        if (doubtful && !choices.asked)
            choices.asked = true;
        else {
            frame.actions.push(ExportFiles{choices.folder, choices.formats, choices.options});
            choices.asked = false;
            choices.sent = true; // what became of it is told where the eye is
        }
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/document/grades.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/lights.h"
#include "app/viewer/panels/option_fields.h"
#include "app/viewer/panels/steps/bend_rows.h"
#include "app/viewer/panels/steps/fit_editor.h"
#include "app/viewer/panels/steps/step_parts.h"
#include "app/viewer/panels/steps/surface_step.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/text.h"
#include "engine/exchange/part_formats.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"
#include "engine/report/text/number_text.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

Status status(const Frame& frame, Stage stage, bool there)
{
    const auto stale = first_stale(frame.state.document);
    if (!there)
        return Status::nothing;
    return stale && *stale <= stage ? Status::stale : Status::done;
}

/// Where a part that is no sheet was cut open.
void seam_rows(Frame& frame, const PartFile& part)
{
    figure(frame, "Seam length", length_text(part.seam_length, frame.lengths()));
    tooltip("To cut elsewhere, draw a seam with the tool Line");
    if (const auto& cut = frame.state.document.session.corner_cut) {
        const auto strain = [](const StrainFigures& each) { return fmt::format("up to {:.3f}", each.most); };
        figure(frame, "Strain, corners joined", cut->before ? strain(*cut->before) : "no blank");
        tooltip(sentence(describe(*cut)));
        figure(frame, "Strain, corners cut", strain(cut->after));
        tooltip(sentence(describe(*cut)));
    }
    if (frame.state.document.session.options.read.seam.mode == SeamOptions::Mode::automatic)
        return;
    ImGui::BeginDisabled(frame.model.busy());
    if (small_button(frame, "Choose the seam automatically"))
        frame.actions.push(SetSeam{});
    ImGui::EndDisabled();
}

void part_step(Frame& frame)
{
    const Session& session = frame.state.document.session;
    step_heading(frame, 1, "Part",
                 frame.state.refused && (!frame.state.refused_file || shows_refused(frame.state))
                     ? Status::failed
                     : light(frame, ChainStep::part, status(frame, Stage::read, session.part != nullptr)));
    if (ImGui::Button("Open..."))
        choose_part(frame);
    static const std::string formats = part_format_names() + ". You can also drop a file on the window.";
    tooltip(formats);
    if (!session.part) {
        if (frame.state.refused)
            coloured(ImGui::GetStyleColorVec4(ImGuiCol_Text), session.file.filename().string());
        doctor_panel(frame);
        return;
    }
    const PartFile& part = *session.part;
    if (shows_refused(frame.state)) {
        refused_notice(frame);
        doctor_panel(frame);
        return;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(70 * frame.ui.scale);
    static constexpr const char* units[] = {"mm", "cm", "m", "inch"};
    int unit = int(part.unit);
    const bool stated = part.cad && part.cad->unit_stated;
    ImGui::BeginDisabled(stated);
    if (ImGui::Combo("##unit", &unit, units, 4))
        frame.actions.push(SetUnit{units[unit]});
    ImGui::EndDisabled();
    tooltip(stated ? "The length unit is stated in the file" : "Length unit of the file");
    wrapped(session.file.filename().string());
    refused_notice(frame);
    const Eigen::Vector3d size = part_figures(frame).size / millimetres(frame.lengths());
    figure(frame, "Triangles", fmt::format("{}", part.mesh.triangles()));
    figure(frame, part.solid ? "Surface size" : "Size",
           fmt::format("{:.4g} x {:.4g} x {:.4g} {}", size[0], size[1], size[2], length_word(frame.lengths())));
    if (!part.seam.empty())
        seam_rows(frame, part);
    doubt_rows(frame, ChainStep::part);
    doctor_panel(frame);
}

void sheet_step(Frame& frame)
{
    const Document& document = frame.state.document;
    step_heading(frame, 2, "Sheet",
                 light(frame, ChainStep::sheet, document.session.part ? Status::done : Status::nothing));
    ImGui::SetNextItemWidth(-1);
    const std::filesystem::path named(document.material);
    const auto shown = (named.extension() == ".json" ? named.stem() : named.filename()).string();
    if (ImGui::BeginCombo("##material", shown.c_str(), ImGuiComboFlags_HeightLargest)) {
        bool own = false;
        for (const Grade& grade : *frame.state.grades) {
            if (grade.own && !std::exchange(own, true))
                ImGui::Separator();
            ImGui::BeginDisabled(!grade.material);
            if (ImGui::Selectable(fmt::format("{}##{}", grade.label(), grade.reference).c_str(),
                                  grade.reference == document.material))
                frame.actions.push(SetMaterial{grade.reference});
            ImGui::EndDisabled();
            tooltip(grade.material ? grade.material->name : grade.problem);
        }
        ImGui::Separator();
        if (ImGui::Selectable("Edit materials..."))
            open_material_editor(frame);
        if (ImGui::Selectable("Material from a file..."))
            frame.ui.files.open(FileDialog::Purpose::open_material, frame.model.assets() / "materials");
        if (ImGui::Selectable("From a tensile test..."))
            choose_tensile_test(frame);
        ImGui::EndCombo();
    }
    const Material& material = document.session.options.flatten.material;
    tooltip(fmt::format("{}\n{}", material.name, material.source));
    double thickness = document.session.options.flatten.thickness;
    // four decimals
    ImGui::SetNextItemWidth((frame.lengths() == LengthUnit::inch ? 126 : 110) * frame.ui.scale);
    const bool typing = frame.ui.typed.has_value();
    const bool changed =
        length_input(frame, "Thickness", thickness, {.mm = "%.3g", .step_mm = 0.05, .step_inch = 0.002});
    // What was assumed and is typed once more was chosen.
    const bool once_more = typing && !frame.ui.typed && enter_pressed(frame) && !frame.ui.number_refused;
    if (changed || (once_more && !is_given(document.thickness_from)))
        frame.actions.push(SetThickness{thickness});
    tooltip("Of the flat sheet, before forming");
    if (document.material_from == SheetSource::preference || document.thickness_from == SheetSource::preference)
        muted(frame, document.material_from != SheetSource::preference    ? "Thickness from preferences"
                     : document.thickness_from != SheetSource::preference ? "Grade from preferences"
                                                                          : "Grade and thickness from preferences");
    doubt_rows(frame, ChainStep::sheet);
}

/// Automatic, an axis, or any direction.
void direction_control(Frame& frame)
{
    const Session& session = frame.state.document.session;
    if (!session.part)
        return;
    const auto& chosen = session.options.flatten.direction;
    static constexpr const char* names[] = {"automatic", "x", "y", "z", "own"};
    const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    int now = chosen ? 4 : 0;
    for (int k = 0; k < 3 && chosen; ++k)
        if (*chosen == axes.col(k))
            now = k + 1;
    const Eigen::Vector3d found = session.blank ? session.blank->stamping.direction : Eigen::Vector3d(axes.col(2));
    ImGui::SetNextItemWidth(110 * frame.ui.scale);
    int wanted = now;
    if (ImGui::Combo("Direction", &wanted, names, 5) && wanted != now)
        frame.actions.push(SetDirection{wanted == 0   ? std::nullopt
                                        : wanted == 4 ? std::optional(chosen.value_or(found))
                                                      : std::optional<Eigen::Vector3d>(axes.col(wanted - 1))});
    const Eigen::Vector3d shown = (found.array().abs() < 5e-4).select(0, found); // no -0.000
    tooltip(
        session.blank && !chosen
            ? fmt::format(
                  "Stamping direction found: {:.3f}, {:.3f}, {:.3f}. It defines the first guess of the unfolding, the "
                  "plane of the blank and the outer side.",
                  shown[0], shown[1], shown[2])
            : "Stamping direction of the press. It defines the first guess of the unfolding, the plane of the blank "
              "and the outer side.");
    if (now != 4)
        return;
    Eigen::Vector3d edited = *chosen;
    ImGui::SetNextItemWidth(-1);
    if (typed_numbers(frame, "##direction", edited.data(), 3, "%.4g"))
        frame.actions.push(SetDirection{edited});
}

void skins_control(Frame& frame)
{
    const Session& session = frame.state.document.session;
    if (!session.part)
        return;
    bool skins = session.options.flatten.skins;
    if (tick(option::both_skins, skins))
        frame.actions.push(SetSkins{skins});
}

void unfold_step(Frame& frame)
{
    const Session& session = frame.state.document.session;
    step_heading(frame, 3, "Unfold",
                 light(frame, ChainStep::unfold, status(frame, Stage::solve, session.blank != nullptr)));
    const auto stale = first_stale(frame.state.document);
    const auto& steps = frame.state.document.made_with.steps;
    const bool of_steps = session.blank && steps;
    ImGui::BeginDisabled(!session.part || frame.state.job.running || (!of_steps && (!stale || *stale > Stage::solve)));
    if (ImGui::Button("Unfold"))
        frame.actions.push(RunTo{Stage::solve});
    ImGui::EndDisabled();
    tooltip(of_steps ? "Computes the flat blank of the part in one step and replaces the blank of the steps  (F6)"
                     : "Computes the flat blank of the part in one step  (F6)");
    if (!session.blank) {
        direction_control(frame);
        k_factor_control(frame);
        skins_control(frame);
        return;
    }
    const FlattenResult& flat = *session.blank;
    const Palette p = palette_of(frame.state.view.dark);
    const bool fine = flat.report.whole();
    ImGui::SameLine();
    const bool old = stale && *stale <= Stage::solve;
    const bool good = light(frame, ChainStep::unfold, Status::done) == Status::done;
    ImGui::TextColored(
        old     ? p.muted
        : !fine ? p.warning
        : good  ? p.good
                : ImGui::GetStyleColorVec4(ImGuiCol_Text),
        of_steps && !steps->polish ? ("from " + counted(steps->run->states.size(), "step", "steps")).c_str()
        : of_steps && fine         ? "from steps, polished"
        : fine                     ? "converged"
        : flat.report.converged    ? flat.report.relaxed_vertices > 0 ? "converged, relaxed" : "converged, with a note"
                                   : "not converged");
    doubt_rows(frame, ChainStep::unfold);
    direction_control(frame);
    k_factor_control(frame);
    skins_control(frame);
    const SheetFigures& sheet = sheet_figures(frame);
    const Eigen::Vector2d size = blank_size(frame).sides();
    figure(frame, "Blank", size_text(size[0], size[1], frame.lengths()));
    bend_rows(frame);
    figure(frame, "Thinning", percent_range(sheet.thinning));
    tooltip("Smallest and largest value of all faces; negative: thicker than before");
    figure(frame, "Equivalent strain",
           sheet.strain_equivalent > 0 ? "up to " + figure_text(sheet.strain_equivalent, 3) : "0");
    if (!of_steps || steps->polish)
        figure(frame, "Solved in",
               fmt::format("{}, {:.2g} s",
                           counted(flat.report.energy.size() + flat.report.newton.size(), "iteration", "iterations"),
                           flat.report.seconds));
}

/// How the grid came about.
std::string route_words(GridRoute route)
{
    switch (route) {
    case GridRoute::coons: return "Coons";
    case GridRoute::smoothed_coons: return "Coons, smoothed";
    case GridRoute::harmonic: return "harmonic";
    case GridRoute::area_balanced: return "harmonic, opened";
    case GridRoute::untangled: return "harmonic, folds removed";
    case GridRoute::spiral: return "along the winding";
    }
    return "";
}

void grid_step(Frame& frame)
{
    const Session& session = frame.state.document.session;
    step_heading(frame, 4, "Corners and grid",
                 light(frame, ChainStep::grid, status(frame, Stage::grid, session.grid != nullptr)));
    doubt_rows(frame, ChainStep::grid);
    if (!session.blank) {
        muted(frame, "Unfold the part first.");
        return;
    }
    if (made_of_patches(session)) {
        muted(frame, "Not needed: each patch of the surface has its own grid.");
        return;
    }
    ImGui::BeginDisabled(!session.options.corners);
    if (ImGui::Button("Propose corners"))
        frame.actions.push(ProposeCorners{});
    ImGui::EndDisabled();
    tooltip("Chooses the four corners automatically. You can also drag them along the outline of the blank.");
    GridOptions grid = session.options.grid;
    bool changed = false;
    const float width = 110 * frame.ui.scale;
    const bool automatic = grid.columns == 0 && grid.rows == 0;
    bool square = automatic;
    if (ImGui::Checkbox("Square cells", &square)) {
        grid.columns = square || !session.grid ? 0 : session.grid->result.planar.columns;
        grid.rows = square || !session.grid ? 0 : session.grid->result.planar.rows;
        changed = true;
    }
    tooltip("Give the number of cells along the longer sides; the other number follows");
    ImGui::SetNextItemWidth(width);
    if (automatic) {
        changed |= integer_field(frame, option::cells, grid.cells, 5);
    } else {
        double counts[] = {double(grid.columns), double(grid.rows)};
        changed |= typed_numbers(frame, "Columns, rows", counts, 2, "%.0f");
        grid.columns = int(std::clamp(counts[0], 1., option::columns.range->greatest));
        grid.rows = int(std::clamp(counts[1], 1., option::rows.range->greatest));
    }
    ImGui::SetNextItemWidth(width);
    changed |= choice_field(option::grid_method, grid.method);
    if (grid.method != GridMethod::harmonic) {
        ImGui::SetNextItemWidth(width);
        changed |= integer_field(frame, option::smoothing, grid.smoothing, 10);
    }
    ImGui::SetNextItemWidth(width);
    changed |= percent_field(frame, option::line_grading, grid.line_grading);
    changed |= tick(option::even_cells, grid.even_cells);
    if (changed)
        frame.actions.push(SetGrid{grid});
    if (session.grid) {
        const GridResult& result = session.grid->result;
        const Palette p = palette_of(frame.state.view.dark);
        figure(frame, "Cells", fmt::format("{} x {}", result.planar.columns, result.planar.rows));
        figure(frame, "Method used", route_words(result.route));
        ImGui::PushStyleColor(ImGuiCol_Text,
                              result.quality.folded_cells ? p.error : ImGui::GetStyleColorVec4(ImGuiCol_Text));
        figure(frame, "Folded cells", fmt::format("{}", result.quality.folded_cells));
        ImGui::PopStyleColor();
        const bool sliver = result.quality.min_scaled_jacobian < least_scaled_jacobian;
        ImGui::PushStyleColor(ImGuiCol_Text, sliver ? p.warning : ImGui::GetStyleColorVec4(ImGuiCol_Text));
        figure(frame, "Sharpest cell (1 is best)", fmt::format("{:.3f}", result.quality.min_scaled_jacobian));
        ImGui::PopStyleColor();
        tooltip("Scaled Jacobian: 1 in a rectangle, 0 where a cell folds");
        const auto [column, row] = result.planar.column_and_row(result.quality.worst_cell);
        figure(frame, "It is in column, row", fmt::format("{}, {}", column, row));
        tooltip(
            "Cell with the smallest value, counted from 0: column from corner 1 to 2, row from corner 1 to 4. It is circled in the quad mesh.");
        std::string lengths;
        for (const double length : side_lengths(frame))
            lengths += fmt::format("{}{:.4g}", lengths.empty() ? "" : ", ", shown_length(length, frame.lengths()));
        figure(frame, "Sides", fmt::format("{} {}", lengths, length_word(frame.lengths())));
    }
}

void surface_step(Frame& frame)
{
    const Session& session = frame.state.document.session;
    step_heading(frame, 5, "NURBS surface",
                 light(frame, ChainStep::surface, status(frame, Stage::fit, session.surface != nullptr)));
    doubt_rows(frame, ChainStep::surface);
    if (!session.blank) {
        muted(frame, "Unfold the part first.");
        return;
    }
    patches_editor(frame);
    if (!session.surface) {
        if (session.lifted || session.options.patches ||
            session.options.best_surface) // say a run was cancelled before this step
            fit_editor(frame, fit_choice(session.options));
        else
            muted(frame, frame.state.job.running ? fmt::format("Running now: {}.", frame.state.job.title)
                                                 : "Make the grid first.");
        return;
    }
    fit_editor(frame, fit_choice(session.options));
    ViewSettings view = frame.state.view;
    if (surface_look_combo(view.surface_look))
        frame.actions.push(SetViewSettings{view});
    surface_rows(frame, *session.surface);
    shape_editor(frame);
}

/// In sight as soon as there is something to export, whatever else is to be done.
void export_button(Frame& frame, bool primary)
{
    const bool pressed = primary ? primary_button(frame, "Export...")
                                 : ImGui::Button("Export...", {-1, ImGui::GetFrameHeight() * 1.15f});
    tooltip("Files for CAD, analysis and the solver  (Ctrl+E)");
    if (pressed)
        frame.ui.show_export = true;
}

} // namespace

void steps_panel(Frame& frame)
{
    const bool running = frame.state.job.running;
    const bool both = !running && frame.state.document.session.blank && first_stale(frame.state.document);
    const float footer = (both ? 2 : 1) * (ImGui::GetFrameHeight() * 1.15f + ImGui::GetStyle().ItemSpacing.y) +
                         ImGui::GetStyle().ItemSpacing.y + (running ? residual_plot_height(frame) : 0);
    begin_scrolled(frame, "steps", -footer);
    part_step(frame);
    sheet_step(frame);
    unfold_step(frame);
    grid_step(frame);
    surface_step(frame);
    ImGui::Dummy({0, 4 * frame.ui.scale});
    unfolding_section(frame);
    regions_section(frame);
    process_section(frame);
    ImGui::Dummy({0, 4 * frame.ui.scale});
    keep_in_place(frame);
    ImGui::EndChild();
    const Document& document = frame.state.document;
    ImGui::Dummy({0, 1});
    if (running) {
        residual_plot(frame);
        if (primary_button(frame, frame.state.job.cancelling ? "Stopping..." : "Cancel", !frame.state.job.cancelling))
            frame.actions.push(CancelJob{});
    } else if (!document.session.part) {
        if (primary_button(frame, "Open a part..."))
            choose_part(frame);
    } else if (first_stale(document)) {
        const char* label = document.session.surface ? "Update all"
                            : document.session.blank ? "Make grid and surface"
                                                     : "Unfold and fit a surface";
        // While steps wait to go on, the next step is there.
        const bool steps_wait = frame.ui.steps_listed && (!all_steps_done(document) || blank_of_steps_waits(document));
        if (steps_wait ? ImGui::Button(label, {-1, ImGui::GetFrameHeight() * 1.15f}) : primary_button(frame, label))
            frame.actions.push(RunTo{Stage::fit});
        tooltip("Runs every step that is missing or out of date  (F5)");
        if (document.session.blank)
            export_button(frame, false);
    } else
        export_button(frame, true);
}

} // namespace spia::viewer

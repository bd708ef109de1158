#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/actions/cut_order.h"
#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/panels/steps/surface_step.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/colours.h"
#include "engine/core/error.h"
#include "engine/report/figures/statistics.h"
#include "engine/report/text/number_text.h"

namespace spia::viewer {
namespace {

Figures figures_of(const Session& session, Field field)
{
    Figures made;
    if (!available(session, field) || field == Field::none)
        return made;
    constexpr int bins = 48, most_spots = 6;
    const TriMesh& part = session.part->mesh;
    made.face = face_values(session, field);
    made.at_vertex = values(session, field, false);
    made.histogram = histogram(part, made.face.value, bins);
    made.worst = worst_faces(part, made.face, field, most_spots);
    return made;
}

std::string_view unit(const Frame& frame) { return info(frame.state.document.display.field).unit; }

/// A value of the field that is shown, in the unit of the preferences.
std::string value_here(const Frame& frame, double value) { return value_text(value, unit(frame), frame.lengths()); }
/// The same number without its unit.
std::string number_here(const Frame& frame, double value)
{
    return unit(frame) == "%" ? figure_text(value, 1)
                              : value_text(as_shown(unit(frame), frame.lengths()).factor * value, "");
}

/// Whether it will crack: what everyone asks first.
void crack_line(Frame& frame)
{
    using Kind = CrackVerdict::Kind;
    const CrackVerdict& verdict = crack_verdict(frame);
    if (verdict.kind == Kind::none)
        return;
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec4 colour = is_old(frame.state, View::part)  ? p.muted
                          : verdict.kind == Kind::cracks   ? p.error
                          : verdict.kind == Kind::at_limit ? p.warning
                          : verdict.kind == Kind::safe     ? (verdict.sure ? p.good : p.warning)
                                                           : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    coloured(colour, verdict.text);
    tooltip(
        verdict.kind == Kind::unknown
            ? "Choose a curve in Forming limits below, or give the points of one with the material."
            : "Highest engineering major strain, in percent of the forming limit curve at the same minor strain. The "
              "zones are in Forming limits below.");
    if (verdict.face >= 0 && verdict.kind != Kind::safe && small_button(frame, "Show"))
        frame.actions.push(FlyTo{verdict.face, Field::zone});
    ImGui::Dummy({0, 2 * frame.ui.scale});
}

void field_section(Frame& frame)
{
    const Document& document = frame.state.document;
    FieldDisplay display = document.display;
    bool changed = false;
    const FieldInfo& shown = info(display.field);
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("Field on part and blank");
    ImGui::PopFont();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##field", std::string(shown.label).c_str(), ImGuiComboFlags_HeightLargest)) {
        for (const FieldInfo& field : all_fields()) {
            const bool possible = available(document.session, field.field);
            if (of_skins(field.field) && !possible)
                continue; // seven lines that few ask for
            ImGui::BeginDisabled(!possible);
            if (ImGui::Selectable(std::string(field.label).c_str(), field.field == display.field)) {
                display = with_field(display, field.field, frame.state.preferences.map);
                changed = true;
            }
            ImGui::EndDisabled();
            tooltip(std::string(field.help));
        }
        ImGui::EndCombo();
    }
    tooltip(std::string(shown.help));
    int per_face = by_face(display);
    ImGui::BeginDisabled(display.field == Field::zone); // nothing lies between two zones
    changed |= ImGui::RadioButton("Smooth", &per_face, 0);
    tooltip("Contours are averaged at the vertices. Labels, worst spots and the ends of the legend are face values.");
    ImGui::SameLine();
    changed |= ImGui::RadioButton("Per face", &per_face, 1);
    tooltip("One colour per face: the values that are compared with limits");
    ImGui::EndDisabled();
    if (per_face != int(by_face(display)))
        display.per_face = per_face == 1;
    static constexpr const char* maps[] = {"automatic colours", "blue to yellow", "blue to orange", "grey"};
    int map = display.map ? int(*display.map) + 1 : 0;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::Combo("##map", &map, maps, 4)) {
        display.map = map == 0 ? std::nullopt : std::optional(ColourMap(map - 1));
        changed = true;
    }
    if (available(document.session, display.field) && display.field != Field::none) {
        const Figures& now = figures(frame);
        const ColourScale legend =
            field_scale(display, {now.histogram.least, now.histogram.greatest}, part_figures(frame).diagonal,
                        as_shown(unit(frame), frame.lengths()).factor); // round numbers
        std::array<double, 2> range = display.range.value_or(std::array{double(legend.least), double(legend.greatest)});
        bool by_hand = display.range.has_value();
        if (ImGui::Checkbox("Range", &by_hand)) {
            display.range = by_hand ? std::optional(range) : std::nullopt;
            changed = true;
        }
        tooltip("Colours between two given values instead of the full range");
        if (by_hand) {
            ImGui::SameLine();
            ImGui::SetNextItemWidth(-1);
            const double factor = as_shown(unit(frame), frame.lengths()).factor;
            float ends[2] = {float(factor * range[0]), float(factor * range[1])};
            const float speed = float(std::max(1e-6, factor * (now.histogram.greatest - now.histogram.least) / 300));
            if (ImGui::DragFloat2("##range", ends, speed, 0, 0, "%.4g") && ends[0] < ends[1]) {
                display.range = std::array<double, 2>{ends[0] / factor, ends[1] / factor};
                changed = true;
            }
        }
    }
    ImGui::SetNextItemWidth(120 * frame.ui.scale);
    changed |= ImGui::SliderInt("Bands", &display.bands, 0, 20, display.bands == 0 ? "smooth" : "%d");
    changed |= ImGui::Checkbox("Isolines", &display.isolines);
    ImGui::SameLine();
    changed |= ImGui::Checkbox("Min and max", &display.extremes);
    changed |= ImGui::Checkbox("Principal strain directions", &display.directions);
    if (changed)
        frame.actions.push(SetDisplay{display});
}

void histogram_section(Frame& frame)
{
    const Figures& now = figures(frame);
    if (now.face.value.size() == 0 ||
        frame.state.document.display.field == Field::zone || // shares are in Forming limits
        !ImGui::CollapsingHeader("Histogram", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const Histogram& h = now.histogram;
    const ColourScale scale =
        field_scale(frame.state.document.display, {h.least, h.greatest}, part_figures(frame).diagonal);
    const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 84 * frame.ui.scale};
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const double highest = std::sqrt(*std::max_element(h.share.begin(), h.share.end()));
    const float width = size.x / float(h.share.size());
    for (size_t k = 0; k < h.share.size(); ++k) { // the root of the share: small ones stay visible
        const float height = float(std::sqrt(h.share[k]) / highest) * size.y;
        const double value = h.least + (double(k) + 0.5) / double(h.share.size()) * (h.greatest - h.least);
        const ImVec2 high{at.x + float(k) * width, at.y + size.y - height},
            low{at.x + float(k + 1) * width - 1, at.y + size.y};
        draw->AddRectFilled(high, low, ink(colour_of(scale, float(value))));
        if (h.share[k] > 0)
            draw->AddRect(high, low, ink(palette_of(frame.state.view.dark).line));
    }
    draw->AddLine({at.x, at.y + size.y}, {at.x + size.x, at.y + size.y}, ink(palette_of(frame.state.view.dark).line));
    ImGui::InvisibleButton("histogram", size);
    if (ImGui::IsItemHovered()) {
        const size_t k = std::min(h.share.size() - 1, size_t(std::max(0.f, (ImGui::GetMousePos().x - at.x) / width)));
        const double step = (h.greatest - h.least) / double(h.share.size());
        ImGui::SetTooltip("%s to %s: %.1f %% of the area", number_here(frame, h.least + double(k) * step).c_str(),
                          value_here(frame, h.least + double(k + 1) * step).c_str(), 100 * h.share[k]);
    }
    ImGui::PushFont(frame.ui.fonts.small);
    figure(frame, number_here(frame, h.least).c_str(), value_here(frame, h.greatest));
    ImGui::PopFont();
}

void worst_section(Frame& frame)
{
    const Figures& now = figures(frame);
    if (now.worst.empty() || !ImGui::CollapsingHeader("Worst spots", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const TriMesh& part = frame.state.document.session.part->mesh;
    for (size_t k = 0; k < now.worst.size(); ++k) {
        const int f = now.worst[k];
        const Eigen::Vector3d at = (part.position.col(part.triangle(0, f)) + part.position.col(part.triangle(1, f)) +
                                    part.position.col(part.triangle(2, f))) /
                                   3;
        const bool here = frame.state.spot && frame.state.spot->face == f;
        const std::string value = now.face.order.size() ? fmt::format("strain {}", figure_text(now.face.order[f], 2))
                                                        : value_here(frame, now.face.value[f]);
        if (ImGui::Selectable(fmt::format("{}.  {}##{}", k + 1, value, f).c_str(), here))
            frame.actions.push(FlyTo{f});
        tooltip("Click to zoom to it in all views; Escape goes back");
        const Eigen::Vector3d there = at / millimetres(frame.lengths());
        const std::string place = fmt::format("{}, {}, {} {}", plain_number(there[0] + 0.), plain_number(there[1] + 0.),
                                              plain_number(there[2] + 0.), length_word(frame.lengths()));
        const float right = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(place.c_str()).x,
                    value_end = ImGui::CalcTextSize("8.  -88.8 %").x + 2 * ImGui::GetStyle().ItemSpacing.x;
        if (right < value_end)
            continue; // no room; the tooltip of the view has it
        ImGui::SameLine(right);
        ImGui::TextDisabled("%s", place.c_str());
    }
}

void probes_section(Frame& frame)
{
    const Document& document = frame.state.document;
    if (document.probes.empty() || !ImGui::CollapsingHeader("Probes", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const Figures& now = figures(frame);
    for (size_t k = 0; k < document.probes.size(); ++k) {
        const Probe& probe = document.probes[k];
        ImGui::PushID(int(k));
        std::string value;
        if (now.face.value.size()) // as the label in the view has it
            value = value_here(frame, now.face.value[probe.face]);
        if (ImGui::Selectable(fmt::format("P{}   face {}   {}", k + 1, probe.face, value).c_str(), false, 0,
                              {ImGui::GetContentRegionAvail().x - 26 * frame.ui.scale, 0}))
            frame.actions.push(FlyTo{probe.face});
        ImGui::SameLine();
        if (ImGui::SmallButton("x"))
            frame.actions.push(RemoveProbe{int(k)});
        ImGui::PopID();
    }
    if (small_button(frame, "Remove all"))
        frame.actions.push(ClearProbes{});
}

void measurements_section(Frame& frame)
{
    const Document& document = frame.state.document;
    if (document.measurements.empty() || !ImGui::CollapsingHeader("Measurements", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    for (size_t k = 0; k < document.measurements.size(); ++k) {
        const Measurement& each = document.measurements[k];
        ImGui::PushID(int(k));
        if (ImGui::Selectable(fmt::format("M{}   {}", k + 1, text_of(each, frame.lengths())).c_str(), false, 0,
                              {ImGui::GetContentRegionAvail().x - 26 * frame.ui.scale, 0}))
            if (keeps_faces(each.on))
                frame.actions.push(FlyTo{each.at.front().face});
        if (keeps_faces(each.on))
            tooltip("Click to zoom to it in all views; Escape goes back");
        ImGui::SameLine();
        if (ImGui::SmallButton("x"))
            frame.actions.push(RemoveMeasurement{int(k)});
        ImGui::PushFont(frame.ui.fonts.small);
        ImGui::Indent(14 * frame.ui.scale);
        muted(frame, each.on == View::part ? title(each.kind)
                                           : fmt::format("{}, in the view {}", title(each.kind), title(each.on)));
        for (const Measured::Figure& more : each.found->more)
            figure(frame, more.name.c_str(), text_of(more, frame.lengths()));
        if (const auto flat = on_blank(document.session, each))
            figure(frame, "On the blank",
                   fmt::format("{}  ({})", fixed_length(*flat, frame.lengths(), 2),
                               fixed_length(*flat - each.found->value, frame.lengths(), 2, true)));
        ImGui::Unindent(14 * frame.ui.scale);
        ImGui::PopFont();
        ImGui::PopID();
    }
    if (small_button(frame, "Remove all##measurements"))
        frame.actions.push(ClearMeasurements{});
}

/// Straight, on the part and on the blank: what forming has made of it.
void vertex_distance(Frame& frame)
{
    const auto distance = distance_of_picked(frame.state.document);
    if (!distance)
        return;
    figure(frame, "Distance on the part", fixed_length(distance->on_part, frame.lengths(), 2));
    if (!distance->on_blank)
        return;
    figure(frame, "Distance on the blank", fixed_length(*distance->on_blank, frame.lengths(), 2));
    figure(frame, "Part minus blank",
           fmt::format("{}  ({:+.1f} %)",
                       fixed_length(distance->on_part - *distance->on_blank, frame.lengths(), 2, true),
                       100 * (distance->on_part / *distance->on_blank - 1)));
}

/// Offered for picked vertices whose ends are on the border; where they make no cut it says why.
void cut_through_vertices(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const std::vector<int>& vertices = frame.state.document.vertices;
    if (vertices.size() < 2 || !session.blank || (vertices.size() == 4 && !made_of_patches(session)))
        return;
    const std::string& why = frame.ui.no_cut.of({session.part, session.blank, vertices}, [&]() -> std::string {
        try {
            cut_through(session.part->mesh, session.blank->blank.position, vertices, session.part->source_vertex);
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    });
    ImGui::BeginDisabled(!why.empty());
    if (ImGui::Button("Cut into patches here", {-1, 0}))
        frame.actions.push(AddCut{});
    ImGui::EndDisabled();
    if (why.empty())
        tooltip(
            "Splits the surface into patches that meet along the straight lines between these vertices on the blank");
    else
        muted(frame, engine_words(frame, why));
}

/// Offered for four picked vertices; where they are no corners it says why.
void vertices_as_corners(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const std::vector<int>& vertices = frame.state.document.vertices;
    if (vertices.size() != 4)
        return;
    std::string why;
    try {
        if (const std::vector<int>* outline = frame.pickers.ready_outline(session))
            corners_of(vertices, *outline, session.part->source_vertex);
        else
            why = "Finding the outline...";
    } catch (const Error& error) {
        why = error.what();
    }
    ImGui::BeginDisabled(!why.empty());
    if (ImGui::Button("Use as corners", {-1, 0}))
        frame.actions.push(UseVerticesAsCorners{});
    ImGui::EndDisabled();
    if (why.empty())
        tooltip("Uses them as the corners of the grid, in their order along the outline");
    else
        muted(frame, engine_words(frame, why));
}

void vertices_section(Frame& frame)
{
    const Document& document = frame.state.document;
    const std::vector<int>& vertices = document.vertices;
    if (vertices.empty() || !ImGui::CollapsingHeader("Vertices", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const PartFile& part = *document.session.part;
    const Figures& now = figures(frame);
    constexpr size_t most_rows = 8;
    const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    ImGui::PushFont(frame.ui.fonts.small);
    const ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY;
    if (ImGui::BeginTable("vertices", 4, flags, {0, row * float(std::min(vertices.size(), most_rows) + 1)})) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("Vertex");
        ImGui::TableSetupColumn(in_unit("x, y, z", frame.lengths()).c_str(), ImGuiTableColumnFlags_WidthStretch);
        const bool mean = now.at_vertex.size() && is_smoothed(document.display);
        ImGui::TableSetupColumn(now.at_vertex.size()
                                    ? (std::string(info(document.display.field).label) + (mean ? ", mean" : "")).c_str()
                                    : "");
        ImGui::TableSetupColumn("");
        ImGui::TableHeadersRow();
        ImGuiListClipper rows;
        rows.Begin(int(vertices.size()));
        while (rows.Step())
            for (int k = rows.DisplayStart; k < rows.DisplayEnd; ++k) {
                const int v = vertices[size_t(k)];
                const Eigen::Vector3d at = part.mesh.position.col(v) / millimetres(frame.lengths());
                const int decimals = 1 + more_decimals(frame.lengths());
                ImGui::PushID(v);
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                if (ImGui::Selectable(fmt::format("{}", part.source_vertex[size_t(v)]).c_str(), false,
                                      ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
                    frame.actions.push(FlyToVertex{v});
                tooltip("Click to zoom to it in all views");
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(
                    fmt::format("{1:.{0}f}, {2:.{0}f}, {3:.{0}f}", decimals, at[0] + 0., at[1] + 0., at[2] + 0.)
                        .c_str());
                ImGui::TableNextColumn();
                if (now.at_vertex.size())
                    ImGui::TextUnformatted(value_here(frame, now.at_vertex[v]).c_str());
                ImGui::TableNextColumn();
                if (ImGui::SmallButton("x"))
                    frame.actions.push(SelectVertices{{v}, PickMode::remove});
                ImGui::PopID();
            }
        ImGui::EndTable();
    }
    ImGui::PopFont();
    vertex_distance(frame);
    vertices_as_corners(frame);
    cut_through_vertices(frame);
    if (vertices.size() > 1 && small_button(frame, "Remove all"))
        frame.actions.push(SelectVertices{});
}

void old_figures_note(Frame& frame)
{
    if (!is_old(frame.state, View::part))
        return;
    coloured(palette_of(frame.state.view.dark).warning,
             frame.state.job.running ? "These values belong to the previous blank; a new one is being computed."
                                     : "These values were computed with other options: Update all  (F5).");
    ImGui::Dummy({0, 2 * frame.ui.scale});
}

void looks_section(Frame& frame)
{
    if (!ImGui::CollapsingHeader("Views"))
        return;
    ViewSettings view = frame.state.view;
    bool changed = ImGui::Checkbox("Rotate 3D views together", &view.linked);
    changed |= ImGui::Checkbox("Triangle edges", &view.edges);
    changed |= ImGui::Checkbox("Feature lines", &view.features);
    changed |= ImGui::Checkbox("Show the part under the quad mesh", &view.part_under_quads);
    changed |= ImGui::Checkbox("Colour the quad mesh by quality", &view.quad_quality);
    changed |= surface_look_combo(view.surface_look);
    changed |= ImGui::Checkbox("Control net", &view.control_net);
    if (changed)
        frame.actions.push(SetViewSettings{view});
}

} // namespace

const Figures& figures(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const FieldDisplay& display = frame.state.document.display;
    return frame.ui.charts.figures.of({blank_of_field(frame.state), session.limits, session.surface, display.field},
                                      [&] { return figures_of(session_of_field(frame.state), display.field); });
}

void inspect_panel(Frame& frame)
{
    begin_scrolled(frame, "inspect", 0);
    if (frame.state.job.running && !frame.ui.panels.shown(SidePanels::steps, false))
        residual_plot(frame);
    if (!frame.state.document.session.part) {
        muted(frame, "Open a part to inspect it: thinning, strains, stresses, deviation.");
    } else {
        old_figures_note(frame);
        crack_line(frame);
        field_section(frame);
        vertices_section(frame);
        measurements_section(frame);
        histogram_section(frame);
        worst_section(frame);
        probes_section(frame);
        section_plot(frame);
        strain_diagram(frame);
        limits_section(frame);
        comparison_section(frame);
        looks_section(frame);
    }
    ImGui::EndChild();
}

} // namespace spia::viewer

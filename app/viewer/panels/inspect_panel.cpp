#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/statistics.h"
#include "app/viewer/model/vertex_picking.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/colours.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// What the charts are made of; made again when the field or the results change.
struct Figures {
    std::shared_ptr<const FlattenResult> blank;
    std::shared_ptr<const SurfaceStage> surface;
    Field field = Field::none;
    bool per_face = false;
    Eigen::VectorXd value;       ///< per face; of a smooth field the mean of its corners
    Eigen::VectorXd worst_value; ///< per face the worst of its corners
    Eigen::VectorXd at_vertex;   ///< the smooth field
    Histogram histogram;
    std::vector<int> worst;
};

const Figures& figures(const Frame& frame)
{
    static Figures made;
    const Document& document = frame.state.document;
    const Session& session = document.session;
    if (made.blank == session.blank && made.surface == session.surface && made.field == document.display.field &&
        made.per_face == document.display.per_face)
        return made;
    made = {session.blank, session.surface, document.display.field, document.display.per_face, {}, {}, {}, {}, {}};
    if (!available(session, made.field) || made.field == Field::none)
        return made;
    const TriMesh& part = session.part->mesh;
    const bool small = made.field == Field::thickness;
    made.value = values(session, made.field, true);
    made.worst_value = made.value;
    made.at_vertex = values(session, made.field, false);
    if (!made.per_face) { // the same numbers as in the views
        const Eigen::VectorXd& smooth = made.at_vertex;
        for (int f = 0; f < part.triangles(); ++f) {
            const Eigen::Vector3d corner(smooth[part.triangle(0, f)], smooth[part.triangle(1, f)],
                                         smooth[part.triangle(2, f)]);
            made.value[f] = corner.mean();
            made.worst_value[f] = small ? corner.minCoeff() : corner.maxCoeff();
        }
    }
    made.histogram = histogram(part, made.value, 48);
    made.worst = worst_spots(part, made.worst_value, 6, small);
    return made;
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
            ImGui::BeginDisabled(!possible);
            if (ImGui::Selectable(std::string(field.label).c_str(), field.field == display.field)) {
                display.field = field.field;
                display.range.reset();
                display.map.reset();
                changed = true;
            }
            ImGui::EndDisabled();
            if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
                ImGui::SetTooltip("%s", std::string(field.help).c_str());
        }
        ImGui::EndCombo();
    }
    tooltip(std::string(shown.help));
    int per_face = display.per_face;
    changed |= ImGui::RadioButton("Smooth", &per_face, 0);
    ImGui::SameLine();
    changed |= ImGui::RadioButton("Per face", &per_face, 1);
    display.per_face = per_face == 1;
    static constexpr const char* maps[] = {"automatic colours", "viridis", "diverging", "grey"};
    int map = display.map ? int(*display.map) + 1 : 0;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::Combo("##map", &map, maps, 4)) {
        display.map = map == 0 ? std::nullopt : std::optional(ColourMap(map - 1));
        changed = true;
    }
    if (available(document.session, display.field) && display.field != Field::none) {
        const Figures& now = figures(frame);
        std::array<double, 2> range = display.range.value_or(std::array{now.histogram.least, now.histogram.greatest});
        bool by_hand = display.range.has_value();
        if (ImGui::Checkbox("Range", &by_hand)) {
            display.range = by_hand ? std::optional(range) : std::nullopt;
            changed = true;
        }
        tooltip("Colours from one value to another instead of the whole range");
        if (by_hand) {
            ImGui::SameLine();
            ImGui::SetNextItemWidth(-1);
            float ends[2] = {float(range[0]), float(range[1])};
            const float speed = float(std::max(1e-6, (now.histogram.greatest - now.histogram.least) / 300));
            if (ImGui::DragFloat2("##range", ends, speed, 0, 0, "%.4g") && ends[0] < ends[1]) {
                display.range = std::array<double, 2>{ends[0], ends[1]};
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
    if (now.value.size() == 0 || !ImGui::CollapsingHeader("Histogram", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const Histogram& h = now.histogram;
    const ColourScale scale = field_scale(frame.state.document.display, {h.least, h.greatest});
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
        ImGui::SetTooltip("%s to %s: %.2f %% of the area", value_text(h.least + double(k) * step, "").c_str(),
                          value_text(h.least + double(k + 1) * step, info(now.field).unit).c_str(), 100 * h.share[k]);
    }
    ImGui::PushFont(frame.ui.fonts.small);
    figure(frame, value_text(h.least, "").c_str(), value_text(h.greatest, info(now.field).unit));
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
        const bool here = frame.state.document.selected == std::vector<int>{f};
        if (ImGui::Selectable(
                fmt::format("{}.  {}##{}", k + 1, value_text(now.worst_value[f], info(now.field).unit), f).c_str(),
                here))
            frame.actions.push(FlyTo{f});
        tooltip("Click to look at it in every view");
        const std::string place = fmt::format("{:.3g}, {:.3g}, {:.3g}", at[0] + 0., at[1] + 0., at[2] + 0.);
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(place.c_str()).x);
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
        const std::string value = now.value.size() ? value_text(now.value[probe.face], info(now.field).unit) : "";
        if (ImGui::Selectable(fmt::format("P{}   face {}   {}", k + 1, probe.face, value).c_str(), false, 0,
                              {ImGui::GetContentRegionAvail().x - 26 * frame.ui.scale, 0}))
            frame.actions.push(FlyTo{probe.face});
        ImGui::SameLine();
        if (ImGui::SmallButton("x"))
            frame.actions.push(RemoveProbe{int(k)});
        ImGui::PopID();
    }
    if (ImGui::SmallButton("Remove all"))
        frame.actions.push(ClearProbes{});
}

/// Straight, on the part and on the blank: what forming has made of it.
void vertex_distance(Frame& frame)
{
    const auto distance = distance_of_picked(frame.state.document);
    if (!distance)
        return;
    figure(frame, "Distance on the part", fmt::format("{:.2f} mm", distance->on_part));
    if (!distance->on_blank)
        return;
    figure(frame, "Distance on the blank", fmt::format("{:.2f} mm", *distance->on_blank));
    figure(frame, "Part less blank",
           fmt::format("{:+.2f} mm  ({:+.2f} %)", distance->on_part - *distance->on_blank,
                       100 * (distance->on_part / *distance->on_blank - 1)));
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
        corners_of(vertices, frame.model.pickers().outline(session), session.part->source_vertex);
    } catch (const Error& error) {
        why = error.what();
    }
    ImGui::BeginDisabled(!why.empty());
    if (ImGui::Button("Use as corners", {-1, 0}))
        frame.actions.push(UseVerticesAsCorners{});
    ImGui::EndDisabled();
    if (why.empty())
        tooltip("They become the corners of the quad grid, in their order around the outline");
    else
        muted(frame, why);
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
        ImGui::TableSetupColumn("x, y, z, mm", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn(now.at_vertex.size() ? std::string(info(now.field).label).c_str() : "");
        ImGui::TableSetupColumn("");
        ImGui::TableHeadersRow();
        ImGuiListClipper rows;
        rows.Begin(int(vertices.size()));
        while (rows.Step())
            for (int k = rows.DisplayStart; k < rows.DisplayEnd; ++k) {
                const int v = vertices[size_t(k)];
                const Eigen::Vector3d at = part.mesh.position.col(v);
                ImGui::PushID(v);
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                if (ImGui::Selectable(fmt::format("{}", part.source_vertex[size_t(v)]).c_str(), false,
                                      ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
                    frame.actions.push(FlyToVertex{v});
                tooltip("Click to look at it in every view");
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(
                    fmt::format("{:.1f}, {:.1f}, {:.1f}", at[0] + 0., at[1] + 0., at[2] + 0.).c_str());
                ImGui::TableNextColumn();
                if (now.at_vertex.size())
                    ImGui::TextUnformatted(value_text(now.at_vertex[v], info(now.field).unit).c_str());
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
    if (vertices.size() > 1 && ImGui::SmallButton("Remove all"))
        frame.actions.push(SelectVertices{});
}

/// The field along the section line.
void section_plot(Frame& frame)
{
    const auto& pieces = section_of(frame);
    if (!frame.state.document.section || !ImGui::CollapsingHeader("Section", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    if (pieces.empty()) {
        muted(frame, "The line does not cut the sheet, or no field is shown.");
    } else {
        const Palette p = palette_of(frame.state.view.dark);
        const FieldInfo& field = info(frame.state.document.display.field);
        double low = 1e300, high = -1e300;
        for (const SectionPiece& piece : pieces) {
            low = std::min({low, piece.from_value, piece.to_value});
            high = std::max({high, piece.from_value, piece.to_value});
        }
        const double length = (frame.state.document.section->to - frame.state.document.section->from).norm();
        const RoundRange y = round_range(low, high, 0, false);
        const float s = frame.ui.scale, left = 44 * s, bottom = 30 * s;
        const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 150 * s};
        const ImVec2 from{at.x + left, at.y + 6 * s}, to{at.x + size.x - 4 * s, at.y + size.y - bottom};
        const auto place = [&](double distance, double value) {
            return ImVec2(from.x + float(distance / length) * (to.x - from.x),
                          to.y - float((value - y.least) / (y.greatest - y.least)) * (to.y - from.y));
        };
        ImDrawList* draw = ImGui::GetWindowDrawList();
        ImGui::PushFont(frame.ui.fonts.small);
        for (int k = 0; k <= y.intervals; ++k) {
            const double value = y.least + (y.greatest - y.least) * k / y.intervals;
            const ImVec2 line = place(0, value);
            draw->AddLine(line, {to.x, line.y}, ink(p.line));
            if (k % ((y.intervals + 3) / 4) == 0) {
                const std::string text = fmt::format("{:.4g}", std::abs(value) < 1e-9 ? 0 : value);
                draw->AddText(
                    {line.x - 5 * s - ImGui::CalcTextSize(text.c_str()).x, line.y - ImGui::GetTextLineHeight() / 2},
                    ink(p.muted), text.c_str());
            }
        }
        const std::string far = fmt::format("{:.4g} mm", length);
        draw->AddText({from.x, to.y + 3 * s}, ink(p.muted), "0");
        draw->AddText({to.x - ImGui::CalcTextSize(far.c_str()).x, to.y + 3 * s}, ink(p.muted), far.c_str());
        ImGui::PopFont();
        for (const SectionPiece& piece : pieces)
            draw->AddLine(place(piece.from_distance, piece.from_value), place(piece.to_distance, piece.to_value),
                          ink(p.accent), 1.6f * s);
        ImGui::InvisibleButton("section", size);
        if (ImGui::IsItemHovered()) {
            const double distance = (ImGui::GetMousePos().x - from.x) / (to.x - from.x) * length;
            for (const SectionPiece& piece : pieces)
                if (distance >= piece.from_distance && distance <= piece.to_distance) {
                    const double span = piece.to_distance - piece.from_distance,
                                 t = span > 0 ? (distance - piece.from_distance) / span : 0;
                    ImGui::SetTooltip(
                        "%.4g mm: %s", distance,
                        value_text(piece.from_value + t * (piece.to_value - piece.from_value), field.unit).c_str());
                    break;
                }
        }
    }
    if (ImGui::SmallButton("Remove section"))
        frame.actions.push(ClearSection{});
}

/// Major over minor strain, a point per face; dragging a box over points selects their faces.
void strain_diagram(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!document.session.blank || !ImGui::CollapsingHeader("Strain diagram", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const SheetFields& face = document.session.blank->face;
    const Palette p = palette_of(frame.state.view.dark);
    const float side = ImGui::GetContentRegionAvail().x, height = std::min(side, 230 * frame.ui.scale);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const RoundRange x = round_range(std::min(face.strain_minor.minCoeff(), -0.05),
                                     std::max(face.strain_minor.maxCoeff(), 0.05)),
                     y = round_range(std::min(face.strain_major.minCoeff(), 0.),
                                     std::max(face.strain_major.maxCoeff(), 0.05));
    const float left = 36 * frame.ui.scale, bottom = 32 * frame.ui.scale, top = 6 * frame.ui.scale;
    const ImVec2 from{at.x + left, at.y + top}, to{at.x + side - 4, at.y + height - bottom};
    const auto place = [&](double minor, double major) {
        return ImVec2(from.x + float((minor - x.least) / (x.greatest - x.least)) * (to.x - from.x),
                      to.y - float((major - y.least) / (y.greatest - y.least)) * (to.y - from.y));
    };
    ImDrawList* draw = ImGui::GetWindowDrawList();
    ImGui::PushFont(frame.ui.fonts.small);
    const auto label = [&](ImVec2 where, const std::string& text, float align_x, float align_y) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        draw->AddText({where.x - align_x * size.x, where.y - align_y * size.y}, ink(p.muted), text.c_str());
    };
    for (int k = 0; k <= x.intervals; ++k) {
        const double value = x.least + (x.greatest - x.least) * k / x.intervals;
        const ImVec2 low = place(value, y.least);
        draw->AddLine(low, {low.x, from.y}, ink(p.line));
        if (k % ((x.intervals + 3) / 4) == 0)
            label({std::min(low.x, to.x - 8 * frame.ui.scale), low.y + 2},
                  fmt::format("{:.3g}", std::abs(value) < 1e-9 ? 0 : value), 0.5f, 0);
    }
    for (int k = 0; k <= y.intervals; ++k) {
        const double value = y.least + (y.greatest - y.least) * k / y.intervals;
        const ImVec2 low = place(x.least, value);
        draw->AddLine(low, {to.x, low.y}, ink(p.line));
        if (k % ((y.intervals + 4) / 5) == 0)
            label({low.x - 4, low.y}, fmt::format("{:.3g}", std::abs(value) < 1e-9 ? 0 : value), 1, 0.5f);
    }
    label({(from.x + to.x) / 2, at.y + height}, "minor strain", 0.5f, 1.05f);
    ImGui::PopFont();
    draw->AddLine(place(0, y.least), place(0, y.greatest), ink(p.muted), 1.5f);
    constexpr int most = 20000; // points; more cannot be told apart
    const int step = std::max(1, int(face.strain_major.size()) / most);
    const ImU32 dot = ink(ImVec4(p.accent.x, p.accent.y, p.accent.z, 0.55f)), neck = ink(p.error),
                chosen = ink(p.warning);
    const float r = 1.3f * frame.ui.scale;
    for (int f = 0; f < face.strain_major.size(); f += step) {
        const ImVec2 c = place(face.strain_minor[f], face.strain_major[f]);
        draw->AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, face.necking[f] ? neck : dot);
    }
    for (const int f : document.selected) {
        const ImVec2 c = place(face.strain_minor[f], face.strain_major[f]);
        draw->AddRectFilled({c.x - 2 * r, c.y - 2 * r}, {c.x + 2 * r, c.y + 2 * r}, chosen);
    }
    ImGui::InvisibleButton("diagram", {side, height});
    tooltip(
        "Every face as a point: major over minor strain. Red: beyond the trusted strain. Drag a box to select faces.");
    if (ImGui::IsItemActivated()) {
        frame.ui.brushing_diagram = true;
        frame.ui.brush_from = ImGui::GetMousePos();
    }
    if (!frame.ui.brushing_diagram)
        return;
    const ImVec2 now = ImGui::GetMousePos(),
                 a{std::min(now.x, frame.ui.brush_from.x), std::min(now.y, frame.ui.brush_from.y)},
                 b{std::max(now.x, frame.ui.brush_from.x), std::max(now.y, frame.ui.brush_from.y)};
    draw->AddRectFilled(a, b, ink(ImVec4(p.accent.x, p.accent.y, p.accent.z, 0.15f)));
    draw->AddRect(a, b, ink(p.accent));
    if (!ImGui::IsMouseDown(0)) {
        frame.ui.brushing_diagram = false;
        std::vector<int> inside;
        for (int f = 0; f < face.strain_major.size(); ++f) {
            const ImVec2 c = place(face.strain_minor[f], face.strain_major[f]);
            if (c.x >= a.x && c.x <= b.x && c.y >= a.y && c.y <= b.y)
                inside.push_back(f);
        }
        frame.actions.push(SelectFaces{inside, ImGui::GetIO().KeyShift ? PickMode::add : PickMode::replace});
    }
}

/// Residual over steps, logarithmic.
void residual_section(Frame& frame)
{
    const auto& residual = frame.state.job.residual;
    if (residual.size() < 2)
        return;
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted("Residual");
    ImGui::PopFont();
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 90 * frame.ui.scale};
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRect(at, {at.x + size.x, at.y + size.y}, ink(p.line));
    const auto height = [&](double r) { // 1e1 on top, 1e-10 below
        return at.y + size.y * float(std::clamp((1 - std::log10(std::max(r, 1e-10))) / 11, 0., 1.));
    };
    for (size_t k = 1; k < residual.size(); ++k)
        draw->AddLine({at.x + size.x * float(k - 1) / float(residual.size() - 1), height(residual[k - 1])},
                      {at.x + size.x * float(k) / float(residual.size() - 1), height(residual[k])}, ink(p.accent),
                      1.6f);
    ImGui::Dummy(size);
    figure(frame, fmt::format("step {}", residual.size()).c_str(), fmt::format("{:.1e}", residual.back()));
}

void looks_section(Frame& frame)
{
    if (!ImGui::CollapsingHeader("Views"))
        return;
    ViewSettings view = frame.state.view;
    bool changed = ImGui::Checkbox("Turn 3D views together", &view.linked);
    changed |= ImGui::Checkbox("Triangle edges", &view.edges);
    changed |= ImGui::Checkbox("Feature lines", &view.features);
    changed |= ImGui::Checkbox("Part under the quads", &view.part_under_quads);
    changed |= ImGui::Checkbox("Colour quads by quality", &view.quad_quality);
    changed |= ImGui::Checkbox("Colour surface by deviation", &view.surface_deviation);
    changed |= ImGui::Checkbox("Control net", &view.control_net);
    if (changed)
        frame.actions.push(SetViewSettings{view});
}

} // namespace

const std::vector<SectionPiece>& section_of(Frame& frame)
{
    struct Made {
        std::shared_ptr<const PartFile> part;
        std::shared_ptr<const FlattenResult> blank;
        std::shared_ptr<const SurfaceStage> surface;
        Field field = Field::none;
        std::optional<SectionLine> line;
        std::vector<SectionPiece> pieces;
    };
    static Made made; // the cut of a large part is not made anew in every frame
    const Document& document = frame.state.document;
    const Session& session = document.session;
    const bool same_line =
        made.line.has_value() == document.section.has_value() &&
        (!made.line ||
         (made.line->from == document.section->from && made.line->to == document.section->to &&
          made.line->depth == document.section->depth && made.line->on_blank == document.section->on_blank));
    if (same_line && made.part == session.part && made.blank == session.blank && made.surface == session.surface &&
        made.field == document.display.field)
        return made.pieces;
    made = {session.part, session.blank, session.surface, document.display.field, document.section, {}};
    const TriMesh* mesh =
        made.line ? frame.model.pickers().mesh(session, made.line->on_blank ? View::blank : View::part) : nullptr;
    if (mesh && made.field != Field::none && available(session, made.field))
        made.pieces = section(*mesh, values(session, made.field, false), *made.line);
    return made.pieces;
}

void inspect_panel(Frame& frame)
{
    ImGui::BeginChild("inspect");
    if (frame.state.job.running)
        residual_section(frame);
    if (!frame.state.document.session.part) {
        muted(frame, "Open a part to inspect it: thinning, strains, stresses, deviation.");
    } else {
        field_section(frame);
        vertices_section(frame);
        histogram_section(frame);
        worst_section(frame);
        probes_section(frame);
        section_plot(frame);
        strain_diagram(frame);
        looks_section(frame);
    }
    ImGui::EndChild();
}

} // namespace spia::viewer

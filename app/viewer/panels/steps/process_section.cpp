#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/error.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {
namespace {

/// Of the outer edge, with what it comes to.
void edge_input(Frame& frame)
{
    const Document& document = frame.state.document;
    const FlattenOptions& sheet = document.session.options.flatten;
    float percent = float(100 * document.edge_restraint);
    ImGui::SetNextItemWidth(110 * frame.ui.scale);
    if (ImGui::SliderFloat("Edge restraint", &percent, 0, 100, "%.0f %%"))
        frame.actions.push(SetProcess{std::clamp(percent / 100., 0., 1.), document.rolling});
    tooltip(
        "Restraint of the outer edge, as a share of the lock force: the force per length at which the sheet would tear "
        "between the tools");
    if (document.edge_restraint > 0)
        figure(frame, "of the edge",
               fmt::format("{:.3g} N/mm", document.edge_restraint * lock_force(sheet.material, sheet.thickness)));
}

void rolling_input(Frame& frame)
{
    const Document& document = frame.state.document;
    const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    static constexpr const char* names[] = {"isotropic", "x", "y", "z", "own"};
    int now = document.rolling ? 4 : 0;
    for (int k = 0; k < 3 && document.rolling; ++k)
        if (*document.rolling == axes.col(k))
            now = k + 1;
    int wanted = now;
    ImGui::SetNextItemWidth(110 * frame.ui.scale);
    if (ImGui::Combo("Rolling", &wanted, names, 5) && wanted != now)
        frame.actions.push(
            SetProcess{document.edge_restraint, wanted == 0   ? std::nullopt
                                                : wanted == 4 ? std::optional(document.rolling.value_or(axes.col(0)))
                                                              : std::optional<Eigen::Vector3d>(axes.col(wanted - 1))});
    tooltip(
        "Rolling direction of the sheet, seen along the stamping direction: the r-values at 0, 45 and 90\u00b0 then apply in their own directions. Isotropic: their mean in all directions.");
    if (now != 4)
        return;
    Eigen::Vector3d edited = *document.rolling;
    ImGui::SetNextItemWidth(-1);
    if (typed_numbers(frame, "##rolling", edited.data(), 3, "%.4g"))
        frame.actions.push(SetProcess{document.edge_restraint, edited});
}

bool number_input(Frame& frame, const char* label, double& value, double least, double greatest, const char* help)
{
    ImGui::SetNextItemWidth(86 * frame.ui.scale);
    const bool changed = typed_number(frame, label, value, "%.4g");
    tooltip(help);
    value = std::clamp(value, least, greatest);
    return changed;
}

/// Likewise of a length, mm.
bool bead_length(Frame& frame, const char* label, double& mm, double least, double greatest, const char* help)
{
    ImGui::SetNextItemWidth(86 * frame.ui.scale);
    const bool changed = length_input(frame, label, mm);
    tooltip(help);
    mm = std::clamp(mm, least, greatest);
    return changed;
}

/// The equivalent bead: force of a shape.
bool shape_inputs(Frame& frame, ProcessLine& bead)
{
    bool by_shape = bead.shape.has_value();
    bool changed = ImGui::Checkbox("Force from the bead geometry", &by_shape);
    tooltip("From radius, depth and friction: the work of bending and unbending, and friction on the wraps");
    if (changed)
        bead.shape = by_shape ? std::optional(BeadShape{}) : std::nullopt;
    if (!bead.shape)
        return changed;
    changed |= bead_length(frame, "Bead radius", bead.shape->radius, 1e-3, 1e3, "Radius of the male bead");
    changed |= bead_length(frame, "Shoulder radius", bead.shape->shoulder_radius, 1e-3, 1e3,
                           "Radius of the edges of the groove");
    changed |= bead_length(frame, "Depth", bead.shape->depth, 0, 1e3,
                           "Depth to which the bead pushes the sheet into the groove");
    changed |= number_input(frame, "Friction", bead.shape->friction, 0, 10, "Friction coefficient in the bead");
    return changed;
}

void line_row(Frame& frame, int number, const ProcessLine& line)
{
    const Document& document = frame.state.document;
    const bool bead = line.kind == LineKind::drawbead;
    const std::optional<double> restraint = bead_force(document, size_t(number));
    const std::string force = restraint ? fmt::format("{:.3g} N/mm", *restraint) : bead ? "" : "held";
    const float buttons = ImGui::CalcTextSize("x").x + 2 * ImGui::GetStyle().FramePadding.x;
    const bool open =
        ImGui::TreeNodeEx("line", ImGuiTreeNodeFlags_AllowItemOverlap, "%s   %s", line.name.c_str(), force.c_str());
    tooltip(bead ? "Drawbead: restrains the sheet across its line" : "Pilot: the sheet is held here");
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - buttons);
    if (ImGui::SmallButton("x"))
        frame.actions.push(RemoveLine{number});
    if (!open)
        return;
    ProcessLine edited = line;
    ImGui::SetNextItemWidth(-1);
    bool changed = typed_text(frame, "##name", edited.name, "name");
    if (bead) {
        if (!line.shape)
            changed |=
                number_input(frame, "N/mm", edited.force_N_mm, 1e-6, 1e6, "Restraining force per length of the line");
        changed |= shape_inputs(frame, edited);
    }
    if (changed)
        frame.actions.push(ChangeLine{number, edited});
    ImGui::TreePop();
}

} // namespace

void process_section(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!document.session.part)
        return;
    const bool open = ImGui::CollapsingHeader("Process");
    tooltip("Drawbeads, pilots and edge restraint. Binder, pad and punch are regions with a force or pressure.");
    if (!open)
        return;
    edge_input(frame);
    rolling_input(frame);
    for (size_t k = 0; k < document.lines.size(); ++k) {
        ImGui::PushID(int(k));
        line_row(frame, int(k), document.lines[k]);
        ImGui::PopID();
    }
    if (document.lines.empty())
        muted(frame, "Draw drawbeads on the part with the tool Line.");
    if (!document.vertices.empty() &&
        small_button(frame, fmt::format("Pin {} picked {}", document.vertices.size(),
                                        document.vertices.size() == 1 ? "vertex" : "vertices")
                                .c_str()))
        frame.actions.push(PinVertices{});
}

void end_line(Frame& frame)
{
    std::vector<Eigen::Vector3d> drawn = std::exchange(frame.ui.line, {});
    const DrawnLine kind = frame.ui.drawn_line;
    if (drawn.size() < (kind == DrawnLine::pilot ? 1u : 2u))
        return;
    if (kind != DrawnLine::seam) {
        frame.actions.push(AddLine{
            {.kind = kind == DrawnLine::pilot ? LineKind::pilot : LineKind::drawbead, .point = std::move(drawn)}});
        return;
    }
    SeamOptions seam{SeamOptions::Mode::given, {{}}};
    const PartFile& part = *frame.state.document.session.part;
    for (const Eigen::Vector3d& place : drawn) {
        Eigen::Index nearest = 0;
        (part.mesh.position.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
        // the part is cut before it is remeshed
        const int vertex = number_as_read(part, int(nearest));
        if (seam.path[0].empty() || seam.path[0].back() != vertex)
            seam.path[0].push_back(vertex);
    }
    if (seam.path[0].size() > 1)
        frame.actions.push(SetSeam{std::move(seam)});
}

} // namespace spia::viewer

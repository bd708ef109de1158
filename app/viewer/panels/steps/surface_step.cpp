#include "app/viewer/panels/steps/surface_step.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/panels/option_fields.h"
#include "app/viewer/panels/steps/fit_editor.h"
#include "app/viewer/panels/steps/patch_list.h"
#include "app/viewer/views/colour_scale.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/shortcomings/unsuited_surface.h"
#include "engine/report/text/sentence.h"
#include "engine/report/text/shown_lengths.h"

namespace spia::viewer {
namespace {

std::string cut_name(const LayoutCut& cut)
{
    return fmt::format(
        "Cut from vertex {} to {}{}", cut.front(), cut.back(),
        cut.size() > 2 ? fmt::format(", bent {}", cut.size() == 3 ? "once" : fmt::format("{} times", cut.size() - 2))
                       : "");
}

/// The patch that suffers most by a measure.
template <class Measure> size_t worst(const Certificate& certificate, const Measure& measure)
{
    size_t found = 0;
    for (size_t p = 1; p < certificate.patch.size(); ++p)
        if (measure(certificate.patch[p]) > measure(certificate.patch[found]))
            found = p;
    return found;
}

std::string of_patch(const Certificate& certificate, size_t patch)
{
    return certificate.patch.size() > 1 ? fmt::format(" (patch {})", patch + 1) : "";
}

void certificate_rows(Frame& frame, const Certificate& certificate)
{
    const Palette p = palette_of(frame.state.view.dark);
    const auto why_not = unsuited(certificate);
    ImGui::PushStyleColor(ImGuiCol_Text, why_not ? p.warning : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    figure(frame, "Folds", why_not ? "perhaps, not proved" : "none (proved)");
    ImGui::PopStyleColor();
    tooltip(
        why_not
            ? engine_words(frame, *why_not)
            : "Within each patch the surface normal never vanishes or flips; proved by the Bezier coefficients of every span. Whether it looks to the side of the part is measured beside this.");
    if (certificate.patch.empty())
        return;
    const CertificateFigures figures = certificate_figures(certificate);
    figure(frame, "Sharpest cell (1 is best)",
           fmt::format("{:.3f}", figures.least_scaled) + of_patch(certificate, figures.patch));
    tooltip(
        "Least scaled Jacobian: sine of the angle between the lines u and v. 1: at right angles, 0: the cell has collapsed");
    const size_t flat = worst(certificate, [](const PatchCertificate& c) { return c.condition; });
    figure(frame, "Most distorted cell (1 is best)",
           value_text(certificate.patch[flat].condition, "") + of_patch(certificate, flat));
    tooltip("Condition of the map from the square to the cell: 1 for a square one, large for long or skewed ones");
    const size_t slim = worst(certificate, [](const PatchCertificate& c) { return c.aspect; });
    figure(frame, "Longest cell, length to width",
           value_text(certificate.patch[slim].aspect, "") + of_patch(certificate, slim));
    if (certificate.interfaces.empty())
        return;
    figure(frame, "Joints of patches", fmt::format("{}", certificate.interfaces.size()));
    ImGui::PushStyleColor(ImGuiCol_Text, certificate.leak.empty() ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : p.error);
    figure(frame, "Gaps", certificate.leak.empty() ? "none (exact)" : "yes");
    ImGui::PopStyleColor();
    tooltip(certificate.leak.empty() ? "Neighbouring patches share the knots and control points of their common side"
                                     : engine_words(frame, certificate.leak));
    figure(frame, "Angle at joints",
           fmt::format("up to {:.3g}\u00b0", figures.greatest_angle * 180 / std::numbers::pi));
    tooltip("Angle between the normals of two patches at their common side; 0 where they join smoothly");
}

void picked_handles(Frame& frame, HandleKind kind)
{
    const Document& document = frame.state.document;
    const std::vector<int>& picked = kind == HandleKind::control ? document.controls : document.lattice_points;
    const char* what = kind == HandleKind::control ? "control point" : "lattice point";
    if (picked.empty()) {
        muted(frame, fmt::format("Pick {}s in the view of the surface with the tool Shape, and drag them.", what));
        return;
    }
    figure(frame, "Picked", fmt::format("{} {}{}", picked.size(), what, picked.size() == 1 ? "" : "s"));
    double by[3] = {0, 0, 0};
    ImGui::SetNextItemWidth(150 * frame.ui.scale);
    if (length_inputs(frame, in_unit("Move by", frame.lengths()).c_str(), by, 3, frame.lengths(), {}))
        frame.actions.push(MoveHandles{kind, {by[0], by[1], by[2]}, false});
}

} // namespace

void shape_editor(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const auto& deformation = session.options.deformation;
    const bool lattice = deformation && deformation->lattice;
    const HandleKind kind = frame.state.view.handles;
    ImGui::Dummy({0, 2 * frame.ui.scale});
    if (small_button(frame, lattice ? "Remove lattice" : "Add lattice"))
        frame.actions.push(SetLattice{lattice ? std::nullopt : std::optional(LatticeChoice{})});
    tooltip(lattice ? "Undoes its deformation" : "Around the surface; drag its points to deform the whole surface");
    if (lattice) {
        double count[3];
        for (size_t k = 0; k < 3; ++k)
            count[k] = deformation->lattice->count[k];
        ImGui::SetNextItemWidth(150 * frame.ui.scale);
        if (typed_numbers(frame, "Points", count, 3, "%.0f")) {
            LatticeChoice choice;
            for (size_t k = 0; k < 3; ++k) {
                choice.count[k] = int(std::clamp(count[k], 2., 64.));
                choice.degree[k] = std::min(3, choice.count[k] - 1);
            }
            frame.actions.push(SetLattice{choice});
        }
        tooltip("Points along x, y and z; another number resets the lattice");
    }
    if (frame.state.view.tool == Tool::shape && (kind == HandleKind::control || lattice))
        picked_handles(frame, kind);
    if (!session.deformed)
        return;
    figure(frame, "Moved by up to", length_text(session.deformed->result.largest, frame.lengths()));
    if (lattice && !frame.state.shape_dragged && session.deformed->result.off_lattice > 0) {
        figure(frame, "Lattice error", length_text(session.deformed->result.off_lattice, frame.lengths(), 2));
        tooltip(
            "Distance between the NURBS surface and the exact deformation by the lattice; more control points reduce it");
    }
    for (const HandleKind each : {HandleKind::control, HandleKind::lattice}) {
        const bool there =
            each == HandleKind::control ? !deformation->moves.empty() : lattice && !deformation->lattice->at_rest();
        if (there && small_button(frame, each == HandleKind::control ? "Reset control points" : "Reset lattice points"))
            frame.actions.push(ResetHandles{each});
    }
}

bool surface_look_combo(SurfaceLook& look)
{
    static constexpr const char* names[] = {"one colour",    "deviation",      "tolerance band",    "patches",
                                            "zebra stripes", "mean curvature", "Gaussian curvature"};
    int chosen = int(look);
    item_for("Gaussian curvature");
    const bool changed = ImGui::Combo("Colours", &chosen, names, IM_ARRAYSIZE(names));
    tooltip("Colours of the NURBS surface. Zebra stripes break at kinks and bend sharply where the curvature jumps.");
    look = SurfaceLook(chosen);
    return changed;
}

/// On which edges of the part patches end.
void edges_editor(Frame& frame, const LayoutOptions& patches)
{
    constexpr double none = option::patch_edges.range->greatest;
    LayoutOptions changed = patches;
    bool at_edges = patches.edge_deg < none;
    if (ImGui::Checkbox("End at sharp edges", &at_edges)) {
        changed.edge_deg = at_edges ? LayoutOptions{}.edge_deg : none;
        frame.actions.push(SetPatches{changed});
    }
    tooltip("Patches end at sharp edges, so that each smooth patch needs fewer control points");
    ImGui::BeginDisabled(!at_edges);
    if (!at_edges)
        changed.edge_deg = LayoutOptions{}.edge_deg; // what a tick would take
    ImGui::SetNextItemWidth(70 * frame.ui.scale);
    if (angle_field(frame, option::patch_edges, changed.edge_deg))
        frame.actions.push(SetPatches{changed});
    ImGui::EndDisabled();
}

void patches_editor(Frame& frame)
{
    const Session& session = frame.state.document.session;
    const auto& patches = session.options.patches;
    static constexpr const char* names[] = {"automatic", "one patch", "several patches"};
    const int before = patches ? 2 : session.options.best_surface ? 0 : 1;
    int chosen = before;
    ImGui::SetNextItemWidth(150 * frame.ui.scale);
    if (ImGui::Combo("Made of", &chosen, names, 3) && chosen != before)
        frame.actions.push(SetPatches{chosen == 2 ? std::optional(LayoutOptions{}) : std::nullopt, chosen == 0});
    tooltip(
        "Automatic: one patch if it is within the tolerance without folds and with few control points, else several. One patch covers the holes; CAD files trim it there. Several patches leave the holes open, as analysis needs, and join without gaps.");
    if (session.options.best_surface && session.surface && !session.surface->choice.empty())
        muted(frame, in_shown_lengths(sentence(session.surface->choice), frame.lengths()));
    if (!patches)
        return;
    for (size_t k = 0; k < patches->cuts.size(); ++k) {
        ImGui::PushID(int(k));
        if (small_button(frame, "x"))
            frame.actions.push(RemoveCut{int(k)});
        ImGui::PopID();
        tooltip("Remove this cut");
        ImGui::SameLine();
        muted(frame, cut_name(patches->cuts[k]));
    }
    if (patches->cuts.empty() && patches->corners.empty())
        edges_editor(frame, *patches);
    bool smooth = patches->smooth_joins;
    if (tick(option::smooth_joins, smooth)) {
        LayoutOptions changed = *patches;
        changed.smooth_joins = smooth;
        frame.actions.push(SetPatches{changed});
    }
    if (patches->cuts.empty())
        muted(frame, "To add a cut, pick two vertices of the border with the tool Vertex.");
}

void surface_rows(Frame& frame, const SurfaceStage& surface)
{
    const SurfaceFigures& figures = surface_figures(frame);
    if (const auto& patches = surface.patches) {
        figure(frame, "Patches", fmt::format("{}", figures.patches));
        if (patches->layout.edges > 0)
            figure(frame, "Sharp edges", fmt::format("{}", patches->layout.edges));
        figure(frame, "Singular nodes", fmt::format("{}", figures.singular_nodes));
        tooltip("Inner corners at which other than four patches meet: their lines cannot run on there");
        figure(frame, "Control points", fmt::format("{}", figures.control_points));
        tooltip("Control points shared by patches count once");
    } else {
        figure(frame, "Control points",
               fmt::format("{} x {}", surface.result.surface.count_u, surface.result.surface.count_v));
    }
    figure(frame, "Vertices of the part", fmt::format("{}", frame.state.document.session.part->mesh.vertices()));
    tooltip("A surface with more control points than these is heavy for analysis");
    const auto length = [&](double mm) { return length_text(mm, frame.lengths(), 3); };
    figure(frame, "Deviation, greatest", length(figures.deviation_max));
    figure(frame, "Deviation, rms", length(figures.deviation_rms));
    figure(frame, "On 95 % of the area within", length(figures.deviation_p95));
    fit_figures(frame, surface);
    if (!frame.state.shape_dragged) {
        const Certificate& certificate = surface_certificate(frame.state.document.session);
        certificate_rows(frame, certificate);
        patch_list(frame, surface, certificate);
    }
}

} // namespace spia::viewer

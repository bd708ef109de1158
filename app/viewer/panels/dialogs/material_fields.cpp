#include "app/viewer/panels/dialogs/material_fields.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"
#include "engine/core/error.h"
#include "engine/limits/forming_limit_curve.h"

namespace spia::viewer {
namespace {

struct Law {
    const char *name, *label;
};
constexpr Law laws[] = {{"swift", "Swift"},
                        {"hollomon", "Hollomon"},
                        {"voce", "Voce"},
                        {"ludwik", "Ludwik"},
                        {"hockett_sherby", "Hockett-Sherby"},
                        {"swift_voce", "Swift-Voce"},
                        {"table", "Points of a table"}};

/// Draws the fields of one grade; what is typed goes into `material`.
class Fields {
public:
    Fields(Frame& frame, bool editable, Material& edited, const std::vector<MaterialFault>& faults)
        : material(edited), frame_(frame), editable_(editable), faults_(faults)
    {
    }

    Material& material;
    bool changed = false;

    void number(const char* key, const char* label, const char* unit, double& value, const char* help = "")
    {
        label_of(label, help);
        ImGui::SetNextItemWidth(width());
        ImGui::BeginDisabled(!editable_);
        if (typed_number(frame_, (std::string("##") + key).c_str(), value, "%.6g"))
            changed = true;
        ImGui::EndDisabled();
        if (*help)
            tooltip(help);
        unit_of(unit);
        fault(key);
    }

    void name()
    {
        label_of("Name", "");
        ImGui::SetNextItemWidth(-1);
        ImGui::BeginDisabled(!editable_);
        changed |= typed_text(frame_, "##name", material.name, "of the grade");
        ImGui::EndDisabled();
        fault("name");
    }

    void fault(const std::string& key, int entry = -1)
    {
        for (const MaterialFault& fault : faults_)
            if (fault.key == key && fault.entry == entry)
                coloured(palette_of(frame_.state.view.dark).error, fault.what);
    }

    /// Two numbers in each row. @param scale  of what is shown to what is kept
    void points(const char* id, const char* first_key, const char* second_key, const char* titles,
                std::vector<double>& first, std::vector<double>& second, double scale, double second_scale)
    {
        const float s = frame_.ui.scale;
        muted(frame_, titles);
        ImGui::PushID(id);
        ImGui::BeginDisabled(!editable_);
        std::optional<size_t> gone;
        for (size_t k = 0; k < std::min(first.size(), second.size()); ++k) {
            ImGui::PushID(int(k));
            double a = scale * first[k], b = second_scale * second[k];
            ImGui::SetNextItemWidth(80 * s);
            if (typed_number(frame_, "##a", a, "%.5g")) {
                first[k] = a / scale;
                changed = true;
            }
            ImGui::SameLine(0, 6 * s);
            ImGui::SetNextItemWidth(80 * s);
            if (typed_number(frame_, "##b", b, "%.5g")) {
                second[k] = b / second_scale;
                changed = true;
            }
            if (editable_ && first.size() > 2) {
                ImGui::SameLine(0, 6 * s);
                if (ImGui::SmallButton("x"))
                    gone = k;
                tooltip("Removes this point");
            }
            fault(first_key, int(k));
            fault(second_key, int(k));
            ImGui::PopID();
        }
        if (editable_ && small_button(frame_, "Add a point")) { // on the way of the last two
            const size_t n = first.size();
            first.push_back(2 * first[n - 1] - first[n - 2]);
            second.push_back(2 * second[n - 1] - second[n - 2]);
            changed = true;
        }
        if (gone) {
            first.erase(first.begin() + long(*gone));
            second.erase(second.begin() + long(*gone));
            changed = true;
        }
        ImGui::EndDisabled();
        ImGui::PopID();
        fault(first_key);
    }

    bool editable() const { return editable_; }

private:
    float width() const { return 92 * frame_.ui.scale; }
    void label_of(const char* label, const char* help)
    {
        const float left = ImGui::GetCursorPosX();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(label);
        if (*help)
            tooltip(help);
        ImGui::SameLine();
        ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), left + 116 * frame_.ui.scale));
    }
    void unit_of(const char* unit)
    {
        ImGui::SameLine(0, 6 * frame_.ui.scale);
        ImGui::TextColored(palette_of(frame_.state.view.dark).muted, "%s", unit);
    }

    Frame& frame_;
    bool editable_;
    const std::vector<MaterialFault>& faults_;
};

void heading(const Frame& frame, const char* title)
{
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
}

void sheet_fields(Frame& frame, Fields& fields, const GradeFigures& figures)
{
    Material& m = fields.material;
    heading(frame, "Sheet");
    fields.name();
    fields.number("young_MPa", "Young's modulus", "MPa", m.young_MPa);
    fields.number("poisson", "Poisson's ratio", "-", m.poisson);
    fields.number("density_kg_m3", "Density", "kg/m\u00b3", m.density_kg_m3,
                  "Kept with the material; the shape of the blank does not depend on it");
    fields.number("r0", "r0", "-", m.r0, "r-value (Lankford coefficient) along the rolling direction");
    fields.number("r45", "r45", "-", m.r45, "r-value (Lankford coefficient) at 45\u00b0 to the rolling direction");
    fields.number("r90", "r90", "-", m.r90, "r-value (Lankford coefficient) across the rolling direction");
    figure(frame, "r mean", fmt::format("{:.3f}", figures.normal_anisotropy));
    tooltip("(r0 + 2 r45 + r90) / 4: the higher it is, the less the sheet thins in drawing");
    figure(frame, "delta r", fmt::format("{:+.3f}", figures.planar_anisotropy));
    tooltip("(r0 - 2 r45 + r90) / 2: planar anisotropy; 0: the same draw-in in all directions, otherwise a drawn cup "
            "has ears");
    if (!m.source.empty()) {
        muted(frame, "Source: " + m.source);
    }
}

void law_choice(Frame& frame, Fields& fields)
{
    Hardening& hardening = fields.material.hardening;
    const auto now =
        std::find_if(std::begin(laws), std::end(laws), [&](const Law& law) { return law.name == law_name(hardening); });
    ImGui::BeginDisabled(!fields.editable());
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##law", now->label)) {
        for (const Law& law : laws)
            if (ImGui::Selectable(law.label, &law == now) && &law != now)
                try {
                    hardening = as_law(hardening, law.name);
                    fields.changed = true;
                    frame.ui.materials.problem.clear();
                } catch (const Error& error) {
                    frame.ui.materials.problem = error.what();
                }
        ImGui::EndCombo();
    }
    ImGui::EndDisabled();
    tooltip("Another law is fitted to the present curve between the strains 0.002 and 0.5");
}

void hardening_fields(Frame& frame, Fields& fields, const GradeFigures& figures)
{
    heading(frame, "Hardening");
    law_choice(frame, fields);
    const auto sigma0 = [&](double& x) { fields.number("hardening/sigma0_MPa", "Initial stress", "MPa", x); };
    const auto swift = [&](Swift& law) {
        fields.number("hardening/K_MPa", "K", "MPa", law.K_MPa);
        fields.number("hardening/e0", "e0", "-", law.e0, "Plastic strain that the sheet has before the test");
        fields.number("hardening/n", "n", "-", law.n, "Hardening exponent");
    };
    const auto voce = [&](Voce& law) {
        sigma0(law.sigma0_MPa);
        fields.number("hardening/sigma_sat_MPa", "Saturation stress", "MPa", law.sigma_sat_MPa);
        fields.number(
            "hardening/c", "c", "-", law.c,
            "How fast the stress approaches its saturation: with c = 10 two thirds of the way at a strain of 0.1");
    };
    Hardening& hardening = fields.material.hardening;
    if (auto* only_swift = std::get_if<Swift>(&hardening)) {
        muted(frame, "stress = K (e0 + e)^n");
        swift(*only_swift);
    } else if (auto* hollomon = std::get_if<Hollomon>(&hardening)) {
        muted(frame, "stress = K e^n");
        fields.number("hardening/K_MPa", "K", "MPa", hollomon->K_MPa);
        fields.number("hardening/n", "n", "-", hollomon->n, "Hardening exponent");
    } else if (auto* only_voce = std::get_if<Voce>(&hardening)) {
        muted(frame, "stress = saturation - (saturation - initial) exp(-c e)");
        voce(*only_voce);
    } else if (auto* ludwik = std::get_if<Ludwik>(&hardening)) {
        muted(frame, "stress = initial + K e^n");
        sigma0(ludwik->sigma0_MPa);
        fields.number("hardening/K_MPa", "K", "MPa", ludwik->K_MPa);
        fields.number("hardening/n", "n", "-", ludwik->n, "Hardening exponent");
    } else if (auto* hockett = std::get_if<HockettSherby>(&hardening)) {
        muted(frame, "stress = saturation - (saturation - initial) exp(-c e^p)");
        sigma0(hockett->sigma0_MPa);
        fields.number("hardening/sigma_sat_MPa", "Saturation stress", "MPa", hockett->sigma_sat_MPa);
        fields.number("hardening/c", "c", "-", hockett->c);
        fields.number("hardening/p", "p", "-", hockett->p, "From 0.05 to 1; with 1 it is Voce's law");
    } else if (auto* mixed = std::get_if<SwiftVoce>(&hardening)) {
        muted(frame, "stress = alpha Swift + (1 - alpha) Voce");
        fields.number("hardening/alpha", "alpha", "-", mixed->alpha, "Share of Swift's law");
        swift(mixed->swift);
        voce(mixed->voce);
    } else if (auto* table = std::get_if<HardeningTable>(&hardening))
        fields.points("curve", "hardening/strain", "hardening/stress_MPa", "plastic strain, -     true stress, MPa",
                      table->strain, table->stress_MPa, 1, 1);
    fields.fault("hardening");
    figure(frame, "Rp0.2", fmt::format("{:.0f} MPa", figures.proof_MPa));
    figure(frame, "Rm", fmt::format("{:.0f} MPa", figures.strength_MPa));
    figure(frame, "Uniform strain", fmt::format("{:.3f}", figures.uniform_strain));
    figure(frame, "n value, 10 to 20 %", fmt::format("{:.3f}", figures.n));
    tooltip("Slope of ln stress over ln strain between the strains 0.10 and 0.20 (ISO 10275), or up to the uniform "
            "strain where that is less");
}

/// FLC0 in words, of what the grade says; empty: nothing to be said of it alone.
std::string limit_words(const GradeLimit& limit, double thickness, const std::string& name)
{
    try {
        if (!limit.minor.empty())
            return fmt::format(
                "{:.1f} %",
                100 * engineering_strain(curve_through(limit.minor, limit.major, true, name).at_plane_strain()));
        if (limit.n)
            return fmt::format("{:.1f} %",
                               100 * engineering_strain(keeler_brazier(thickness, *limit.n).at_plane_strain()));
    } catch (const Error&) { // the fields say it
    }
    return "";
}

void limit_fields(Frame& frame, Fields& fields)
{
    GradeLimit& limit = fields.material.limit;
    heading(frame, "Forming limit");
    const int now = !limit.minor.empty() ? 2 : limit.n ? 1 : 0;
    int chosen = now;
    ImGui::BeginDisabled(!fields.editable());
    ImGui::SetNextItemWidth(-1);
    ImGui::Combo("##limit", &chosen, "Of the metal\0Keeler-Brazier, n given\0Measured points\0");
    ImGui::EndDisabled();
    tooltip(
        "Of the metal: Keeler-Brazier for steel with the n of the hardening curve, no curve for other metals. Used where the "
        "forming limits are set to \"Curve: of the material\".");
    const double thickness = frame.state.document.session.options.flatten.thickness;
    if (chosen != now) {
        const double uniform = std::clamp(uniform_strain(fields.material.hardening, 0.99), 0.05, 0.21);
        limit = {};
        if (chosen == 1)
            limit.n = uniform;
        if (chosen == 2) { // Keeler-Brazier's to begin with
            const FormingLimitCurve curve = keeler_brazier(thickness, uniform);
            for (const double minor : {-0.2, -0.1, 0., 0.1, 0.2}) {
                limit.minor.push_back(minor);
                limit.major.push_back(std::round(1000 * engineering_strain(curve(logarithmic_strain(minor)))) / 1000);
            }
        }
        fields.changed = true;
    }
    if (limit.n && limit.minor.empty())
        fields.number("forming_limit/n", "n", "-", *limit.n, "For Keeler-Brazier; values above 0.21 count as 0.21");
    else if (!limit.minor.empty()) {
        fields.points("limit", "forming_limit/minor", "forming_limit/major",
                      "minor, %     major, %  (engineering strain)", limit.minor, limit.major, 100, 100);
        if (fields.editable() && small_button(frame, "From a table...")) {
            frame.ui.materials.curve_for_editor = true;
            ImGui::CloseCurrentPopup();
            frame.ui.files.open(FileDialog::Purpose::open_limit_curve, {});
        }
    } else
        muted(frame, "Keeler-Brazier for steel with the n of the law; no curve for other metals.");
    if (const std::string flc0 = limit_words(limit, thickness, fields.material.name); !flc0.empty())
        figure(frame,
               limit.minor.empty() ? ("Limit at plane strain, " + thickness_text(thickness, frame.lengths())).c_str()
                                   : "Limit at plane strain",
               flc0);
}

} // namespace

bool material_fields(Frame& frame, Material& material, bool editable, const std::vector<MaterialFault>& faults,
                     const GradeFigures& figures)
{
    Fields fields(frame, editable, material, faults);
    if (ImGui::BeginTable("fields", 3, ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        sheet_fields(frame, fields, figures);
        ImGui::TableNextColumn();
        hardening_fields(frame, fields, figures);
        ImGui::TableNextColumn();
        limit_fields(frame, fields);
        ImGui::EndTable();
    }
    return fields.changed;
}

} // namespace spia::viewer

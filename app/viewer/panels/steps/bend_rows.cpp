#include "app/viewer/panels/steps/bend_rows.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/model/document/k_choice.h"
#include "app/viewer/panels/widgets.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

constexpr int most_rows = 8; ///< in sight at once; more scroll
constexpr std::array<const char*, 6> titles = {"Bend", "R", "Angle", "K", "Allow.", "Deduct."};

/// The face in the middle of a bend.
int face_of(const TriMesh& part, const SheetBend& bend)
{
    const auto off = [&](int f) {
        return (part.position(Eigen::all, part.triangle.col(f)).rowwise().mean() - bend.place).squaredNorm();
    };
    return *std::min_element(bend.faces.begin(), bend.faces.end(), [&](int a, int b) { return off(a) < off(b); });
}

std::string bend_words(const Frame& frame, const SheetBend& bend)
{
    std::string words = engine_words(frame, describe(bend));
    words += ".\n" + fmt::format("It is {} long; ", length_text(bend.length, frame.lengths()));
    words += bend.sharp ? "two planes meet there without a radius."
                        : fmt::format("its radius is that of the {}.",
                                      bend.stated ? "CAD cylinder" : "circle through the vertices");
    if (!bend.laid)
        words += "\nThe blank has its mesh length: " + engine_words(frame, bend.why_not + "; " + bend.way_out) + ".";
    return words + "\nClick to look at it.";
}

void headings(Frame& frame)
{
    const std::string unit = std::string(length_word(frame.lengths()));
    const std::array<std::string, 6> help = {
        "Bend up or down, on the blank as it is drawn",
        "Inner radius, " + unit,
        "Bend angle, degrees; 0 is flat",
        "K factor: distance of the neutral fibre from the inside of the bend, as a share of the thickness",
        "Bend allowance, " + unit + ": the length of the bend in the flat blank, across the bend line",
        "Bend deduction, " + unit + ": the sum of both outer leg lengths minus the flat length"};
    ImGui::PushStyleColor(ImGuiCol_Text, palette_of(frame.state.view.dark).muted);
    for (size_t c = 0; c < titles.size(); ++c) {
        ImGui::TableNextColumn();
        if (c == 0)
            ImGui::TextUnformatted(titles[c]);
        else
            right_aligned(titles[c]);
        tooltip(help[c]);
    }
    ImGui::PopStyleColor();
}

/// A sheet that is given as triangles is laid flat as these, unless arcs are asked for.
bool lies_as_asked(const Session& session)
{
    return bend_doubts(*session.part, *session.bends, session.options.k_factor.has_value()).empty();
}

/// Radius, angle, K, allowance and deduction.
std::array<std::string, 5> figures(const SheetBend& bend, LengthUnit lengths)
{
    const int decimals = 3 + more_decimals(lengths);
    return {bend.sharp ? "sharp" : fmt::format("{:.4g}", shown_length(bend.inner_radius, lengths)),
            fmt::format("{:.4g}\u00b0", bend.angle * 180 / std::numbers::pi),
            bend.sharp ? "" : fmt::format("{:.4g}", bend.k),
            fmt::format("{:.{}f}", shown_length(bend.allowance, lengths), decimals),
            fmt::format("{:.{}f}", shown_length(bend.deduction, lengths), decimals)};
}

void row(Frame& frame, int number, const SheetBend& made)
{
    const Session& session = frame.state.document.session;
    const SheetBend bend = with_wanted_k(frame.state.document, made);
    const auto& spot = frame.state.spot;
    const bool here = spot && std::binary_search(bend.faces.begin(), bend.faces.end(), spot->face);
    const Palette& palette = palette_of(frame.state.view.dark);
    if (!bend.laid)
        ImGui::PushStyleColor(ImGuiCol_Text, lies_as_asked(session) ? palette.muted : palette.warning);
    ImGui::TableNextColumn();
    if (ImGui::Selectable(fmt::format("{} {}##bend", number, bend.up ? "up" : "down").c_str(), here,
                          ImGuiSelectableFlags_SpanAllColumns) &&
        !bend.faces.empty())
        frame.actions.push(FlyTo{face_of(session.part->mesh, bend)});
    tooltip(bend_words(frame, bend));
    for (const std::string& text : figures(bend, frame.lengths())) {
        ImGui::TableNextColumn();
        right_aligned(text);
    }
    if (!bend.laid)
        ImGui::PopStyleColor();
}

/// Of the columns, by the longest text in each: a table that is as broad as all of them together
/// cuts off no digit.
std::array<float, 6> widths(const Frame& frame, const std::vector<SheetBend>& bends)
{
    std::array<float, 6> width{};
    const auto widen = [&](size_t column, const std::string& text) {
        width[column] = std::max(width[column], ImGui::CalcTextSize(text.c_str()).x);
    };
    for (size_t c = 0; c < width.size(); ++c)
        widen(c, titles[c]);
    widen(0, fmt::format("{} down", bends.size()));
    for (const SheetBend& bend : bends) {
        const auto text = figures(with_wanted_k(frame.state.document, bend), frame.lengths());
        for (size_t c = 0; c < text.size(); ++c)
            widen(c + 1, text[c]);
    }
    return width;
}

void table(Frame& frame, const std::vector<SheetBend>& bends)
{
    const float line = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    const bool scrolls = int(bends.size()) > most_rows;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {3 * frame.ui.scale, ImGui::GetStyle().CellPadding.y});
    if (ImGui::BeginTable("bends", 6, ImGuiTableFlags_SizingStretchProp | (scrolls ? ImGuiTableFlags_ScrollY : 0),
                          {0, scrolls ? (most_rows + 1) * line : 0})) {
        for (const float width : widths(frame, bends))
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, width);
        ImGui::TableSetupScrollFreeze(0, 1);
        headings(frame);
        ImGuiListClipper clipper;
        clipper.Begin(int(bends.size()), line);
        while (clipper.Step())
            for (int b = clipper.DisplayStart; b < clipper.DisplayEnd; ++b) {
                ImGui::PushID(b);
                row(frame, b + 1, bends[size_t(b)]);
                ImGui::PopID();
            }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
}

} // namespace

void k_factor_control(Frame& frame)
{
    const Session& session = frame.state.document.session;
    if (!session.part)
        return;
    const auto& k = session.options.k_factor;
    const bool of_skin = session.part->solid && session.part->solid->skin != Skin::middle;
    const KSource now = k_source(k);
    ImGui::BeginDisabled(of_skin && !k);
    ImGui::SetNextItemWidth(170 * frame.ui.scale);
    const std::string shown = now == KSource::number ? "number" : of_skin && !k ? "none, skin lengths" : k_words(k);
    if (ImGui::BeginCombo("K factor", shown.c_str())) {
        if (ImGui::Selectable(of_skin ? "none, skin lengths" : "0.5, middle surface", now == KSource::automatic))
            frame.actions.push(SetKFactor{});
        if (ImGui::Selectable("number", now == KSource::number) && now != KSource::number)
            frame.actions.push(SetKFactor{"0.5"});
        if (ImGui::Selectable("DIN 6935", now == KSource::din6935))
            frame.actions.push(SetKFactor{"din6935"});
        if (ImGui::Selectable("Table from a file...", now == KSource::table))
            frame.ui.files.open(FileDialog::Purpose::open_k_table,
                                now == KSource::table ? std::filesystem::path(k->name) : session.file.parent_path());
        ImGui::EndCombo();
    } else
        tooltip(
            of_skin
                ? "The lengths are those of a skin of the solid. Choose \"middle\" as \"Skin\" in the step Part to "
                  "lay bends by their neutral fibre."
                : "Distance of the neutral fibre from the inside of a bend, as a share of the thickness. A table has "
                  "two columns, inner radius over thickness and K.");
    ImGui::EndDisabled();
    if (now != KSource::number)
        return;
    double value = k->table[0].second;
    ImGui::SetNextItemWidth(170 * frame.ui.scale);
    if (typed_number(frame, "K", value, nullptr, 0.01))
        frame.actions.push(SetKFactor{fmt::format("{}", value)});
    tooltip("Above 0 and below 1; 0.5 is the middle surface");
}

void bend_rows(Frame& frame)
{
    const Session& session = frame.state.document.session;
    if (!session.bends || (!session.part->solid && session.bends->bends.empty()))
        return;
    figure(frame, "Lengths of", session.bends->surface);
    tooltip("The surface of the sheet whose lengths the blank has");
    const auto& bends = session.bends->bends;
    if (bends.empty())
        return;
    const auto flags = int(bends.size()) > most_rows ? ImGuiTreeNodeFlags_None : ImGuiTreeNodeFlags_DefaultOpen;
    const bool open = ImGui::TreeNodeEx("bends", flags | ImGuiTreeNodeFlags_NoTreePushOnOpen, "%s",
                                        bends.size() == 1 ? "1 bend" : fmt::format("{} bends", bends.size()).c_str());
    tooltip("Cylindrical bends, laid with the length of their neutral fibre, and sharp folds");
    if (!open)
        return;
    table(frame, bends);
    for (const std::string& note : all_notes(*session.bends))
        muted(frame, engine_words(frame, note));
}

} // namespace spia::viewer

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {

/// A section cuts the sheet as it is formed or flat, however far its steps have unfolded it.
static const TriMesh* section_mesh(Frame& frame, bool on_blank)
{
    const Session& session = frame.state.document.session;
    return on_blank ? frame.pickers.mesh(session, View::blank) : session.part ? &session.part->mesh : nullptr;
}

const std::vector<SectionPiece>& section_of(Frame& frame)
{
    const Document& document = frame.state.document;
    const Session& session = document.session;
    const Field field = document.display.field;
    return frame.ui.charts.section.of({session.part, blank_of_field(frame.state), session.limits, session.surface,
                                       field, document.section, by_face(document.display)},
                                      [&]() -> std::vector<SectionPiece> {
                                          const auto& line = document.section;
                                          const TriMesh* mesh = line ? section_mesh(frame, line->on_blank) : nullptr;
                                          if (!mesh || field == Field::none || !available(session, field))
                                              return {};
                                          const Session shown = session_of_field(frame.state);
                                          std::vector<SectionPiece> pieces =
                                              section(*mesh, values(shown, field, false), *line);
                                          if (by_face(document.display)) { // a step in each face
                                              const FaceValues said = face_values(shown, field);
                                              for (SectionPiece& piece : pieces)
                                                  piece.from_value = piece.to_value = said.value[piece.face];
                                          }
                                          return pieces;
                                      });
}

const std::vector<SectionPiece>& section_in(Frame& frame, View view)
{
    const Document& document = frame.state.document;
    const Session& session = document.session;
    const std::vector<SectionPiece>& drawn = section_of(frame);
    if (drawn.empty() || document.section->on_blank == (view == View::blank))
        return drawn;
    return frame.ui.charts.section_elsewhere.of(
        {session.part, blank_of_field(frame.state), session.limits, session.surface, document.display.field,
         document.section, by_face(document.display)},
        [&]() -> std::vector<SectionPiece> {
            const TriMesh* from = section_mesh(frame, document.section->on_blank);
            const TriMesh* to = section_mesh(frame, !document.section->on_blank);
            return from && to ? carried(drawn, *from, *to) : std::vector<SectionPiece>{};
        });
}

void section_plot(Frame& frame)
{
    const auto& pieces = section_of(frame);
    const bool smoothed = is_smoothed(frame.state.document.display);
    if (!frame.state.document.section ||
        !ImGui::CollapsingHeader(smoothed ? "Section, smoothed###Section" : "Section###Section",
                                 ImGuiTreeNodeFlags_DefaultOpen))
        return;
    if (pieces.empty()) {
        muted(frame, "The line does not cut the sheet, or no field is shown.");
    } else {
        const Palette p = palette_of(frame.state.view.dark);
        const FieldInfo& field = info(frame.state.document.display.field);
        double low = 1e300, high = -1e300, length = 0;
        for (const SectionPiece& piece : pieces) {
            low = std::min({low, piece.from_value, piece.to_value});
            high = std::max({high, piece.from_value, piece.to_value});
            length = std::max(length, piece.to_arc);
        }
        const ShownUnit as = as_shown(field.unit, frame.lengths());
        const RoundRange y = round_range(as.factor * low, as.factor * high, 0, false);
        const float s = frame.ui.scale, left = 44 * s, bottom = 22 * s, head = ImGui::GetTextLineHeight();
        const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 150 * s};
        const ImVec2 from{at.x + left, at.y + head + 6 * s}, to{at.x + size.x - 4 * s, at.y + size.y - bottom};
        const auto place = [&](double arc, double value) {
            return ImVec2(from.x + float(length > 0 ? arc / length : 0) * (to.x - from.x),
                          to.y - float((value - y.least) / (y.greatest - y.least)) * (to.y - from.y));
        };
        ImDrawList* draw = ImGui::GetWindowDrawList();
        ImGui::PushFont(frame.ui.fonts.small);
        const std::string what(as.unit.empty() ? std::string(field.label)
                                               : fmt::format("{}, {}", field.label, as.unit));
        draw->AddText(at, ink(p.muted), what.c_str());
        for (int k = 0; k <= y.intervals; ++k) {
            const double value = y.least + (y.greatest - y.least) * k / y.intervals;
            const ImVec2 line = place(0, value);
            draw->AddLine(line, {to.x, line.y}, ink(p.line));
            const bool zero = std::abs(value) < 1e-9 * (y.greatest - y.least);
            if (zero)
                draw->AddLine(line, {to.x, line.y}, ink(p.muted));
        }
        for (const double value : axis_numbers(y, 5)) {
            const ImVec2 line = place(0, value);
            const std::string text = fmt::format("{:.4g}", value);
            draw->AddText(
                {line.x - 5 * s - ImGui::CalcTextSize(text.c_str()).x, line.y - ImGui::GetTextLineHeight() / 2},
                ink(p.muted), text.c_str());
        }
        const std::string far = length_text(length, frame.lengths());
        const char* words = frame.state.document.section->on_blank ? "along the cut of the blank" : "along the cut";
        draw->AddText({from.x, to.y + 3 * s}, ink(p.muted), "0");
        // of a line with the words in its middle
        const float taken = 2 * (ImGui::CalcTextSize(far.c_str()).x + 8 * s);
        if (ImGui::CalcTextSize(words).x + taken < to.x - from.x)
            draw->AddText({(from.x + to.x - ImGui::CalcTextSize(words).x) / 2, to.y + 3 * s}, ink(p.muted), words);
        draw->AddText({to.x - ImGui::CalcTextSize(far.c_str()).x, to.y + 3 * s}, ink(p.muted), far.c_str());
        ImGui::PopFont();
        for (const SectionPiece& piece : pieces)
            draw->AddLine(place(piece.from_arc, as.factor * piece.from_value),
                          place(piece.to_arc, as.factor * piece.to_value), ink(p.accent), 1.6f * s);
        ImGui::InvisibleButton("section", size);
        if (ImGui::IsItemHovered()) {
            const double arc = (ImGui::GetMousePos().x - from.x) / (to.x - from.x) * length;
            if (const auto here = place_at(pieces, arc)) {
                const SectionPiece& piece = pieces[here->piece];
                const double value = piece.from_value + here->share * (piece.to_value - piece.from_value);
                draw->AddLine({place(arc, 0).x, from.y}, {place(arc, 0).x, to.y}, ink(p.warning), s);
                draw->AddCircleFilled(place(arc, as.factor * value), 3.5f * s, ink(p.warning));
                const std::string text = fmt::format("{}: {}", length_text(arc, frame.lengths()),
                                                     value_text(value, field.unit, frame.lengths()));
                ImGui::SetTooltip("%s", text.c_str());
                frame.ui.section_mark = SectionMark{*here, ImGui::GetFrameCount()};
            }
        }
    }
    if (small_button(frame, "Remove section"))
        frame.actions.push(ClearSection{});
}

} // namespace spia::viewer

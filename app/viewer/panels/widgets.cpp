#include "app/viewer/panels/widgets.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <fmt/core.h>
#include <imgui_internal.h> // ClearActiveID, NavRectRel, TempInputId

#include "app/viewer/model/reports/typed_number.h"
#include "app/viewer/model/reports/wrapped_text.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "engine/options/option.h"
#include "engine/report/text/shown_lengths.h"

namespace spia::viewer {

bool small_button(const Frame& frame, const char* label)
{
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 2 * frame.ui.scale});
    const bool pressed = ImGui::Button(label);
    ImGui::PopStyleVar();
    return pressed;
}

void beside_if_room(const char* label)
{
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x)
        ImGui::NewLine();
}

bool coloured_button(const Frame& frame, const char* label, ImVec2 size, const ImVec4& colour)
{
    const ImVec4 ground = under_white(colour);
    const auto shade = [&](float f) { return ImVec4(ground.x * f, ground.y * f, ground.z * f, 1); };
    ImGui::PushStyleColor(ImGuiCol_Button, shade(0.9f));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, shade(1));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, shade(0.8f));
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 1, 1, 1));
    ImGui::PushFont(frame.ui.fonts.bold);
    const bool pressed = ImGui::Button(label, size);
    ImGui::PopFont();
    ImGui::PopStyleColor(4);
    return pressed;
}

bool primary_button(const Frame& frame, const char* label, bool enabled)
{
    ImGui::BeginDisabled(!enabled);
    const bool pressed =
        coloured_button(frame, label, {-1, ImGui::GetFrameHeight() * 1.15f}, palette_of(frame.state.view.dark).accent);
    ImGui::EndDisabled();
    return pressed;
}

/// Whether a key ends what is being typed. ImGui would miss one that is down for less than a frame.
static bool leaves_typing(const Frame& frame)
{
    if (!pressed(frame, GLFW_KEY_TAB) && !pressed(frame, GLFW_KEY_ESCAPE) && !enter_pressed(frame))
        return false;
    ImGui::ClearActiveID();
    return true;
}

/// What a field shows of a number. @param format  null: all its digits
static std::string shown_number(double value, const char* format)
{
    if (!format)
        return fmt::format("{}", value);
    std::array<char, 64> text{};
    ImFormatString(text.data(), text.size(), format, value);
    return text.data();
}

/// A number with buttons between it and its label. @param typed its text and whether that was typed
/// @param active whether it is being typed. @returns -1 or 1 where a button is pressed, else 0
static int with_step_buttons(const char* label, Typed& typed, bool& active)
{
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, side = ImGui::GetFrameHeight();
    const float width = ImGui::CalcItemWidth() - 2 * (gap + side);
    ImGui::BeginGroup();
    ImGui::PushID(label);
    ImGui::SetNextItemWidth(std::max(1.f, width));
    typed.edited[0] |= text_input("##number", typed.number[0]);
    active = ImGui::IsItemActive();
    int steps = 0;
    ImGui::PushButtonRepeat(true);
    for (const auto& [sign, by] : {std::pair{"-", -1}, {"+", 1}}) {
        ImGui::SameLine(0, gap);
        if (ImGui::Button(sign, {side, side}))
            steps = by;
    }
    ImGui::PopButtonRepeat();
    ImGui::SameLine(0, gap);
    ImGui::TextUnformatted(label);
    ImGui::PopID();
    ImGui::EndGroup();
    return steps;
}

/// Numbers in a row before their label. @returns whether one is being typed
static bool in_a_row(const char* label, Typed& typed, int count)
{
    bool active = false;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::BeginGroup();
    ImGui::PushID(label);
    ImGui::PushMultiItemsWidths(count, ImGui::CalcItemWidth());
    for (int k = 0; k < count; ++k) {
        if (k > 0)
            ImGui::SameLine(0, gap);
        ImGui::PushID(k);
        typed.edited[size_t(k)] |= text_input("", typed.number[size_t(k)]);
        active |= ImGui::IsItemActive();
        ImGui::PopID();
        ImGui::PopItemWidth();
    }
    ImGui::PopID();
    if (const char* end = ImGui::FindRenderedTextEnd(label); end != label) {
        ImGui::SameLine(0, gap);
        ImGui::TextUnformatted(label, end);
    }
    ImGui::EndGroup();
    return active;
}

/// A number that was typed, if it is one; an empty field is no change. @returns whether `value` has
/// changed
static bool take_typed(Frame& frame, std::string_view label, const std::string& text, const char* format, double& value)
{
    label = label.substr(0, label.find("##"));
    if (text.find_first_not_of(' ') == text.npos)
        return false;
    const bool percent = format && std::string_view(format).ends_with("%%");
    const auto number = typed_number_of(text, {field_name(label).unit, label, percent ? "%" : ""});
    if (!number) {
        frame.ui.number_refused = true;
        frame.events.say(Severity::error, refused_number(text, label, shown_number(value, format)),
                         about_refusal(frame.state));
        return false;
    }
    const bool other = *number != value;
    value = *number;
    return other;
}

bool typed_numbers(Frame& frame, const char* label, double* value, int count, const char* format, double step)
{
    auto& typing = frame.ui.typed;
    const ImGuiID id = ImGui::GetID(label);
    const bool was_typing = typing && typing->id == id;
    Typed typed{id};
    if (was_typing)
        typed = *typing;
    else
        for (int k = 0; k < count; ++k)
            typed.number[size_t(k)] = shown_number(value[k], format);
    bool active = false;
    int steps = 0;
    if (step > 0)
        steps = with_step_buttons(label, typed, active);
    else
        active = in_a_row(label, typed, count);
    if (active && !leaves_typing(frame)) {
        frame.ui.number_refused = false;
        typing = std::move(typed);
        return false;
    }
    if (was_typing)
        typing.reset();
    if (active && pressed(frame, GLFW_KEY_ESCAPE))
        return false;
    bool changed = false;
    for (int k = 0; k < count; ++k)
        changed |= typed.edited[size_t(k)] && take_typed(frame, label, typed.number[size_t(k)], format, value[k]);
    if (steps == 0)
        return changed;
    value[0] = std::stod(fmt::format("{:.12g}", value[0] + step * steps)); // 0.42 + 0.01 is 0.43
    return true;
}

void points_for_commas()
{
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.TempInputId == 0 || context.TempInputId != context.ActiveId)
        return;
    for (ImWchar& letter : ImGui::GetIO().InputQueueCharacters)
        if (letter == ',')
            letter = '.';
}

bool length_inputs(Frame& frame, const char* label, double* mm, int count, LengthUnit unit, const LengthFormat& format)
{
    const bool inch = unit == LengthUnit::inch;
    std::array<double, 3> before{}, typed{};
    for (int k = 0; k < count; ++k)
        before[size_t(k)] = typed[size_t(k)] = shown_length(mm[k], unit);
    if (!typed_numbers(frame, label, typed.data(), count, inch ? format.inch : format.mm,
                       inch ? format.step_inch : format.step_mm))
        return false;
    for (int k = 0; k < count; ++k)
        if (typed[size_t(k)] != before[size_t(k)])
            mm[k] = kept_length(typed[size_t(k)], unit);
    return true;
}

bool length_input(Frame& frame, const char* label, double& mm, const LengthFormat& format)
{
    return length_inputs(frame, in_unit(label, frame.lengths()).c_str(), &mm, 1, frame.lengths(), format);
}

bool typed_integer(Frame& frame, const char* label, int& value, int step)
{
    double number = value;
    if (!typed_number(frame, label, number, "%.0f", step))
        return false;
    constexpr double most = 1e9;
    value = int(std::lround(std::clamp(number, -most, most)));
    return true;
}

bool typed_text(Frame& frame, const char* label, std::string& text, const char* hint)
{
    auto& typed = frame.ui.typed;
    const ImGuiID id = ImGui::GetID(label);
    const bool typing = typed && typed->id == id;
    std::string shown = typing ? typed->text : text;
    text_input(label, shown, false, hint);
    const bool active = ImGui::IsItemActive();
    if (active && !leaves_typing(frame)) {
        typed = Typed{id, {}, {}, std::move(shown)};
        return false;
    }
    if (typing)
        typed.reset();
    if (active && pressed(frame, GLFW_KEY_ESCAPE))
        return false;
    if (shown == text || shown.empty())
        return false;
    text = std::move(shown);
    return true;
}

PickMode pick_mode()
{
    const ImGuiIO& io = ImGui::GetIO();
    return io.KeyShift ? PickMode::add : io.KeyCtrl ? PickMode::remove : PickMode::replace;
}

void step_heading(const Frame& frame, int number, const char* title, Status status)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float r = 10 * frame.ui.scale;
    ImGui::Dummy({0, 3 * frame.ui.scale});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec4 colour = status == Status::done                              ? p.good
                          : status == Status::stale || status == Status::poor ? p.warning
                          : status == Status::failed                          ? p.error
                                                                              : p.line;
    draw->AddCircleFilled({at.x + r, at.y + r}, r, ink(colour), 24);
    const std::string digit = std::to_string(number);
    const ImVec2 size = ImGui::CalcTextSize(digit.c_str());
    const bool dark_ink = status == Status::nothing ? !frame.state.view.dark : frame.state.view.dark;
    draw->AddText({at.x + r - size.x / 2, at.y + r - size.y / 2},
                  dark_ink ? IM_COL32(20, 24, 30, 255) : IM_COL32(255, 255, 255, 255), digit.c_str());
    ImGui::SetCursorScreenPos({at.x + 2 * r + 8 * frame.ui.scale, at.y + r - ImGui::GetTextLineHeight() / 2});
    ImGui::PushFont(frame.ui.fonts.bold);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    if (status == Status::stale) {
        ImGui::SameLine();
        ImGui::PushFont(frame.ui.fonts.small);
        ImGui::TextColored(p.warning, "out of date");
        ImGui::PopFont();
    }
    ImGui::SetCursorScreenPos({at.x, at.y + 2 * r + 4 * frame.ui.scale});
}

void begin_scrolled(const Frame& frame, const char* name, float height)
{
    const float gap = 4 * frame.ui.scale;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() - gap);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gap, 0});
    ImGui::BeginChild(name, {0, height}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NavFlattened);
    ImGui::PopStyleVar();
    const int documents = frame.model.documents(); // another part begins at the top
    if (std::exchange(*ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("documents"), documents), documents) !=
        documents)
        ImGui::SetScrollY(0);
}

std::string broken(const std::string& text, float room)
{
    const ImFont* font = ImGui::GetFont();
    const float size = ImGui::GetFontSize(), slack = 1; // pixels; else ImGui would break a full
                                                        // line once more
    return broken_at_spaces(text, room - slack, [&](std::string_view piece) {
        return font->CalcTextSizeA(size, FLT_MAX, 0, piece.data(), piece.data() + piece.size()).x;
    });
}

std::string without_middle(const std::string& text, float room)
{
    const auto begins_character = [&](size_t i) { return (text[i] & 0xC0) != 0x80; }; // of UTF-8
    std::string shown = text;
    size_t first = text.size() / 2, second = first; // what is between them is left out
    while (ImGui::CalcTextSize(shown.c_str()).x > room && first > 0 && second < text.size()) {
        do
            --first;
        while (first > 0 && !begins_character(first));
        do
            ++second;
        while (second < text.size() && !begins_character(second));
        shown = text.substr(0, first) + "..." + text.substr(second);
    }
    return shown;
}

void wrapped(const std::string& text)
{
    ImGui::PushTextWrapPos(0); // of words that are wider by themselves, such as paths
    ImGui::TextUnformatted(broken(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopTextWrapPos();
}

std::string engine_words(const Frame& frame, std::string text)
{
    return in_shown_lengths(window_text(text), frame.lengths());
}

void wide_item(const char* label)
{
    const float taken = ImGui::CalcTextSize(label, nullptr, true).x + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(std::max(1.f, ImGui::GetContentRegionAvail().x - taken));
}

void item_for(const char* longest)
{
    const float wide = ImGui::CalcTextSize(longest).x + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(std::min(wide, ImGui::GetContentRegionAvail().x));
}

void muted(const Frame& frame, const std::string& text) { coloured(palette_of(frame.state.view.dark).muted, text); }

void coloured(const ImVec4& colour, const std::string& text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    wrapped(text);
    ImGui::PopStyleColor();
}

void right_aligned(const std::string& text, bool heading)
{
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, free));
    if (heading)
        ImGui::TextDisabled("%s", text.c_str());
    else
        ImGui::TextUnformatted(text.c_str());
}

void figure(const Frame& frame, const char* name, const std::string& value)
{
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleColor(ImGuiCol_Text, palette_of(frame.state.view.dark).muted);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine();
    if (ImGui::GetCursorPosX() + width > right)
        ImGui::NewLine(); // a narrow panel has the value below its name
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), right - width));
    ImGui::TextUnformatted(value.c_str());
}

/// Where a tooltip of a size goes that belongs to the last item.
static ImVec2 beside_item(ImVec2 size, float lower)
{
    const ImVec2 screen = ImGui::GetIO().DisplaySize, least = ImGui::GetItemRectMin(),
                 greatest = ImGui::GetItemRectMax();
    const ImVec2 window = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
    constexpr float narrow = 0.45f; // of the screen: a panel, a dialog or a list, beside which
                                    // there is room
    const float gap = 0.5f * ImGui::GetFontSize();
    const float y = std::clamp(least.y, 0.f, std::max(0.f, screen.y - size.y));
    if (extent.x < narrow * screen.x) {
        if (window.x + extent.x + gap + size.x <= screen.x)
            return {window.x + extent.x + gap, y};
        if (window.x - gap - size.x >= 0)
            return {window.x - gap - size.x, y};
    }
    const float x = std::clamp(least.x, 0.f, std::max(0.f, screen.x - size.x));
    if (greatest.y + lower + gap + size.y <= screen.y)
        return {x, greatest.y + lower + gap};
    return {x, std::max(0.f, least.y - gap - size.y)};
}

void tooltip(const std::string& text, float lower)
{
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    const float room = ImGui::GetFontSize() * 24;
    const std::string lines = broken(text, room);
    const ImVec2 words = ImGui::CalcTextSize(lines.c_str(), nullptr, false, room),
                 pad = ImGui::GetStyle().WindowPadding;
    ImGui::SetNextWindowPos(beside_item({words.x + 2 * pad.x, words.y + 2 * pad.y}, lower));
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room); // of words that are wider by themselves,
                                                           // such as paths
    ImGui::TextUnformatted(lines.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void keep_in_place(Frame& frame)
{
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImGuiWindow* const window = ImGui::GetCurrentWindow();
    PanelAnchor& anchor = frame.ui.panel_anchor;
    const ImVec2 mouse = ImGui::GetMousePos();
    if (context.NavWindow != window || context.NavId == 0 || !window->InnerRect.Contains(mouse)) {
        if (context.NavWindow == window || context.NavId == 0)
            anchor.item = 0;
        return;
    }
    // From where the content begins, wherever it is scrolled to.
    const float y = window->NavRectRel[context.NavLayer].Min.y, scroll = ImGui::GetScrollY();
    // What moves under a mouse at rest is moved by what is above it: the panel scrolls by as much.
    const bool at_rest = mouse.x == anchor.mouse.x && mouse.y == anchor.mouse.y &&
                         std::abs(scroll - anchor.scroll) <= 1 && ImGui::GetIO().MouseWheel == 0;
    if (anchor.item == context.NavId && at_rest && y != anchor.y) {
        const float to = std::max(0.f, std::round(scroll + y - anchor.y));
        ImGui::SetScrollY(to);
        frame.ui.wake_at = ImGui::GetTime(); // the next frame shows it
        anchor = {context.NavId, y, to, mouse};
        return;
    }
    anchor = {context.NavId, y, scroll, mouse};
}

ImU32 ink(const Colour& colour, float opacity)
{
    return ImGui::ColorConvertFloat4ToU32({colour[0], colour[1], colour[2], colour[3] * opacity});
}

} // namespace spia::viewer

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/reports/first_steps.h"
#include "app/viewer/panels/widgets.h"
#include "engine/report/text/shown_lengths.h"

namespace spia::viewer {
namespace {

constexpr float dot = 18; ///< room before a message, at content scale 1

std::string more_label(size_t more) { return more > 0 ? fmt::format("{} more...", more) : "Full text..."; }

/// With the gap before them.
float buttons_width(const Frame& frame, bool more_button, size_t more)
{
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto width = [&](const std::string& label) {
        return ImGui::CalcTextSize(label.c_str()).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    };
    return width("Dismiss") + (more_button ? width(more_label(more)) : 0) + 4 * frame.ui.scale;
}

void message_row(Frame& frame, const Message& message)
{
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec4 colour = message.severity == Severity::error     ? p.error
                          : message.severity == Severity::warning ? p.warning
                          : message.severity == Severity::done    ? p.good
                                                                  : p.accent;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 5 * frame.ui.scale, at.y + ImGui::GetTextLineHeight() / 2},
                                                4 * frame.ui.scale, ink(colour));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + dot * frame.ui.scale);
    wrapped(in_shown_lengths(message.text, frame.lengths()));
}

/// How long a message stays, seconds; what is wrong stays until it is dismissed.
double lifetime(Severity severity)
{
    switch (severity) {
    case Severity::done: return 8;
    case Severity::hint: return 60;
    default: return 1e9;
    }
}

/// Those to be seen now, the newest first.
std::vector<Message> current(Frame& frame)
{
    std::vector<Message> shown;
    const double now = ImGui::GetTime();
    std::map<int, double> since;
    const auto& all = frame.state.messages;
    for (auto message = all.rbegin(); message != all.rend(); ++message) {
        if (!message->shown())
            continue;
        const auto known = frame.ui.message_since.find(message->number);
        const double begin = since[message->number] = known == frame.ui.message_since.end() ? now : known->second;
        const double end = begin + lifetime(message->severity);
        if (end <= now)
            continue;
        if (end < now + 100)
            frame.ui.wake_at = frame.ui.wake_at > 0 ? std::min(frame.ui.wake_at, end) : end;
        shown.push_back(*message);
    }
    frame.ui.message_since = std::move(since);
    return shown;
}

/// What to do with the sample part; until the first run it stays, then it goes as other hints do.
void add_first_steps(Frame& frame, std::vector<Message>& shown)
{
    Ui& ui = frame.ui;
    if (!ui.sample)
        return;
    std::string text = first_steps(frame.state, ui.sample_exported);
    if (text.empty())
        return;
    const double now = ImGui::GetTime();
    if (ui.first_steps_shown != text) {
        ui.first_steps_shown = text;
        ui.first_steps_since = now;
    }
    if (frame.state.document.session.surface) {
        const double end = ui.first_steps_since + lifetime(Severity::hint);
        if (end <= now)
            return;
        ui.wake_at = ui.wake_at > 0 ? std::min(ui.wake_at, end) : end;
    }
    shown.push_back({Severity::hint, std::move(text)});
}

} // namespace

MessageStrip message_strip(Frame& frame, float width)
{
    MessageStrip strip;
    const ImGuiStyle& style = ImGui::GetStyle();
    // Always there and of one height: the views keep their places while messages come and go.
    const float room = 3 * ImGui::GetTextLineHeight();
    strip.height = room + 2 * style.WindowPadding.y;
    std::vector<Message> all = current(frame);
    add_first_steps(frame, all);
    float left = room;
    for (Message& message : all) {
        const float wrap =
            width - buttons_width(frame, true, all.size()) - dot * frame.ui.scale - 2 * style.WindowPadding.x;
        const std::string lines = broken(in_shown_lengths(message.text, frame.lengths()), std::max(wrap, 60.f));
        left -= ImGui::CalcTextSize(lines.c_str()).y;
        if (!strip.shown.empty() && left < 0)
            break;
        strip.cut |= left < 0; // the only one
        left -= style.ItemSpacing.y;
        strip.shown.push_back(std::move(message));
    }
    strip.more = all.size() - strip.shown.size();
    return strip;
}

void draw_messages(Frame& frame, const MessageStrip& strip)
{
    if (strip.shown.empty())
        return;
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_PopupBg));
    draw->AddLine(at, {at.x + size.x, at.y}, ink(palette_of(frame.state.view.dark).line));
    const bool unfolds = strip.more > 0 || strip.cut;
    const float buttons = buttons_width(frame, unfolds, strip.more);
    ImGui::BeginChild("texts", {ImGui::GetContentRegionAvail().x - buttons, 0});
    for (const Message& message : strip.shown)
        message_row(frame, message);
    ImGui::EndChild();
    if (strip.cut)
        tooltip(in_shown_lengths(strip.shown.front().text, frame.lengths()));
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - buttons + ImGui::GetStyle().ItemSpacing.x);
    if (unfolds) {
        if (ImGui::SmallButton(more_label(strip.more).c_str()))
            frame.ui.show_messages = true;
        ImGui::SameLine();
    }
    if (ImGui::SmallButton("Dismiss")) {
        frame.actions.push(DismissMessages{});
        frame.ui.sample = false;
    }
}

void messages_window(Frame& frame)
{
    if (!frame.ui.show_messages)
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(620 * frame.ui.scale, screen.x - 40), std::min(420 * frame.ui.scale, screen.y - 40)},
        ImGuiCond_Appearing);
    if (ImGui::Begin("Messages", &frame.ui.show_messages, ImGuiWindowFlags_NoCollapse)) {
        if (frame.state.messages.empty())
            muted(frame, "No messages yet.");
        for (auto message = frame.state.messages.rbegin(); message != frame.state.messages.rend(); ++message)
            message_row(frame, *message);
    }
    ImGui::End();
}

} // namespace spia::viewer

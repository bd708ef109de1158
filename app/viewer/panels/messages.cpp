#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/first_steps.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

void message_row(const Frame& frame, const Message& message)
{
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec4 colour = message.severity == Severity::error     ? p.error
                          : message.severity == Severity::warning ? p.warning
                          : message.severity == Severity::done    ? p.good
                                                                  : p.accent;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 5 * frame.ui.scale, at.y + ImGui::GetTextLineHeight() / 2},
                                                4 * frame.ui.scale, ink(colour));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 18 * frame.ui.scale);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(message.text.c_str());
    ImGui::PopTextWrapPos();
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

/// Those to be seen now, the gravest first, of these the newest.
std::vector<Message> current(Frame& frame)
{
    std::vector<Message> shown;
    const double now = ImGui::GetTime();
    frame.ui.wake_at = 0;
    std::map<int, double> since;
    const auto& all = frame.state.messages;
    for (auto message = all.rbegin(); message != all.rend(); ++message) {
        if (message->dismissed)
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
    std::stable_sort(shown.begin(), shown.end(),
                     [](const Message& a, const Message& b) { return a.severity > b.severity; });
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
    if (ui.first_steps_said != text) {
        ui.first_steps_said = text;
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

void messages_overlay(Frame& frame, ImVec2 low_right, float width)
{
    std::vector<Message> shown = current(frame);
    add_first_steps(frame, shown);
    if (shown.empty())
        return;
    constexpr size_t most = 3;
    const size_t more = shown.size() > most ? shown.size() - most : 0;
    shown.resize(shown.size() - more);
    ImGui::SetNextWindowPos(low_right, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowSize({std::min(width, 460 * frame.ui.scale), 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * frame.ui.scale);
    ImGui::Begin("messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    for (const Message& message : shown)
        message_row(frame, message);
    if (ImGui::SmallButton("Dismiss")) {
        frame.actions.push(DismissMessages{});
        frame.ui.sample = false;
    }
    if (more > 0) {
        ImGui::SameLine();
        if (ImGui::SmallButton(fmt::format("{} more...", more).c_str()))
            frame.ui.show_messages = true;
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
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
            muted(frame, "Nothing has been said yet.");
        for (auto message = frame.state.messages.rbegin(); message != frame.state.messages.rend(); ++message)
            message_row(frame, *message);
    }
    ImGui::End();
}

} // namespace spia::viewer

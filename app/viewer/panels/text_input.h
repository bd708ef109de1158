#pragma once
#include <imgui.h>
#include <string>

namespace spia::viewer {

/// For std::string as the text that ImGui edits.
inline int grow(ImGuiInputTextCallbackData* data)
{
    if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
        auto& target = *static_cast<std::string*>(data->UserData);
        target.resize(size_t(data->BufTextLen));
        data->Buf = target.data();
    }
    return 0;
}

/// A line of text that grows with what is typed. What stands there is selected when it gets the
/// keyboard: typing takes its place, a second click sets the cursor. @param on_enter whether only
/// Return counts as a change
inline bool text_input(const char* label, std::string& text, bool on_enter = false, const char* hint = "")
{
    return ImGui::InputTextWithHint(label, hint, text.data(), text.capacity() + 1,
                                    ImGuiInputTextFlags_CallbackResize | ImGuiInputTextFlags_AutoSelectAll |
                                        (on_enter ? ImGuiInputTextFlags_EnterReturnsTrue : 0),
                                    grow, &text);
}

/// Several lines of text. @returns whether the cursor is in it
inline bool text_area(const char* label, std::string& text, ImVec2 size)
{
    ImGui::InputTextMultiline(label, text.data(), text.capacity() + 1, size, ImGuiInputTextFlags_CallbackResize, grow,
                              &text);
    return ImGui::IsItemActive();
}

} // namespace spia::viewer

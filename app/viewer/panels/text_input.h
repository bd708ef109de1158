#pragma once
#include <imgui.h>
#include <string>

namespace spia::viewer {

/// A line of text that grows with what is typed. @param on_enter whether only Return counts as a change
inline bool text_input(const char* label, std::string& text, bool on_enter = false, const char* hint = "")
{
    const auto resize = [](ImGuiInputTextCallbackData* data) {
        if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
            auto& target = *static_cast<std::string*>(data->UserData);
            target.resize(size_t(data->BufTextLen));
            data->Buf = target.data();
        }
        return 0;
    };
    return ImGui::InputTextWithHint(
        label, hint, text.data(), text.capacity() + 1,
        ImGuiInputTextFlags_CallbackResize | (on_enter ? ImGuiInputTextFlags_EnterReturnsTrue : 0), resize, &text);
}

} // namespace spia::viewer

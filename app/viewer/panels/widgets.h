#pragma once
#include <imgui.h>
#include <string>

#include "app/viewer/panels/ui.h"

namespace spia::viewer {

/// A button that is hardly higher than a line of text; letters keep room below it.
bool small_button(const Frame& frame, const char* label);

/// The one obvious next step: a wide button in the accent colour.
bool primary_button(const Frame& frame, const char* label, bool enabled = true);

enum class Status { nothing, done, poor, stale, failed };

/// Heading of a step with its number and a mark of how it stands.
void step_heading(const Frame& frame, int number, const char* title, Status status);

/// A small grey line; wraps.
void muted(const Frame& frame, const std::string& text);
void coloured(const ImVec4& colour, const std::string& text);

/// A row "name   value" in two columns.
void figure(const Frame& frame, const char* name, const std::string& value);

/// Shown while the last item is under the mouse.
void tooltip(const std::string& text);

ImU32 ink(const Colour& colour, float opacity = 1);
inline ImU32 ink(const ImVec4& c) { return ImGui::ColorConvertFloat4ToU32(c); }

} // namespace spia::viewer

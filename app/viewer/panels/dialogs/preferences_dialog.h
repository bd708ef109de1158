#pragma once
#include "app/viewer/model/document/preferences.h"

namespace spia::viewer {

struct Frame;

/// The preferences as they are edited; they count when they are saved.
struct PreferenceChoices {
    Preferences edited;
    double thickness_mm = 1, tolerance_mm = 0.1; ///< what is offered where none is chosen
};

void preferences_dialog(Frame& frame);

} // namespace spia::viewer

#pragma once
#include <optional>
#include <string>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

struct Frame;

/// What was chosen in the picture dialog; kept until the program ends.
struct PictureChoices {
    std::optional<View> view = View::part; ///< not given: the window
    enum class Size { screen, full_hd, ultra_hd, own } size = Size::full_hd;
    int width = 2400, height = 1600; ///< pixels, the user's own
    bool legend = true, labels = true, transparent = false;
    std::string file, suggested; ///< see follow()
};

void picture_dialog(Frame& frame);

} // namespace spia::viewer

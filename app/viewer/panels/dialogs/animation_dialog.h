#pragma once
#include <string>

namespace spia::viewer {

struct Frame;

/// What was chosen in the dialog of animations; kept until the program ends.
struct AnimationChoices {
    int frames = 48;
    double seconds = 4;
    int size = 1; ///< of the list in the dialog
    bool legend = true, back = true;
    bool gif = true;             ///< else numbered pictures
    std::string file, suggested; ///< see follow()
};

/// An animation that is being made.
struct AnimationRun {
    double fraction = 0;
    bool cancelling = false;
};

void animation_dialog(Frame& frame);

} // namespace spia::viewer

#pragma once
#include <memory>
#include <string>

#include "app/viewer/model/reports/manual.h"

namespace spia::viewer {

struct Frame;

/// The manual on the screen: its chapters beside the one that is read.
struct ManualWindow {
    bool shown = false, appears = false;
    std::shared_ptr<const Manual> manual; ///< null: not read yet
    std::string problem;                  ///< why it cannot be
    size_t chapter = 0;
    std::string searched;
    int block = -1;      ///< to be scrolled to in the next frame; -1: none
    int marked = -1;     ///< the one that the search has found
    int openings = 0;    ///< so far
    bool to_top = false; ///< the chapter has just been chosen
};

/// Shows it in the next frame, with nothing looked for.
void open_manual(ManualWindow& window);
void manual_window(Frame& frame);

} // namespace spia::viewer

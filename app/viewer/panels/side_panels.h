#pragma once

namespace spia::viewer {

/// The panels beside the views: the steps, and the field with its charts. A narrow window has room
/// for one of them.
struct SidePanels {
    enum Which { steps, inspect };
    bool wanted[2] = {true, true};
    Which narrow = steps; ///< goes first where there is room for one

    bool shown(Which which, bool is_narrow) const { return wanted[which] && (!is_narrow || narrow == which); }
    /// One that is seen goes, one that is not comes, in a narrow window instead of the other.
    void toggle(Which which, bool is_narrow)
    {
        wanted[which] = !shown(which, is_narrow);
        if (wanted[which])
            narrow = which;
    }
};

/// @param width of the window, pixels; @param scale of the screen
inline bool is_narrow(float width, float scale) { return width <= 900 * scale; }

} // namespace spia::viewer

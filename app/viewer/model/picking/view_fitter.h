#pragma once
#include <array>
#include <optional>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

/// What lies over the picture of a view, pixels.
struct Covered {
    double legend = 0; ///< from the left edge to its right end; 0: there is none
    double cube = 0;   ///< side of the square in the upper right corner that the view cube takes;
                       ///< 0: there is none

    friend bool operator==(const Covered&, const Covered&) = default;
};

/// Knows how large each view is on the screen, and sets cameras so that all of what a view shows is
/// seen, as large as it may be. The views that turn together get one camera, which fits in each of
/// them.
class ViewFitter {
public:
    ViewFitter() { size_.fill({800, 600}); }

    /// @param only  this view, and those that turn with it; not given: all
    void fit(ViewerState& state, std::optional<View> only = {});
    /// A view that has not been moved since it was fitted is so again.
    /// @param size  pixels; @param scale  how many of them one of the design is
    /// @param covered  beside this the picture has its place
    void resized(ViewerState& state, View view, glm::dvec2 size, double scale, const Covered& covered = {});
    /// Whether the camera is still the one that fit() made.
    bool glides = false; ///< the views are on their way from place to place
    bool is_fitted(const ViewerState& state, View view) const
    {
        return !glides && fitted_[size_t(view)] == state.view.camera[size_t(view)];
    }

private:
    Margins margins(const ViewerState& state, View view) const;
    /// As large as it may be beside legend and cube, at the side of the cube, below it or past it.
    Camera beside(const ViewerState& state, View view, const Camera& camera, const Eigen::Matrix3Xd& place) const;
    void fit_blank(ViewerState& state);
    void fit_space(ViewerState& state, const PartFile& part, std::optional<View> only);

    std::array<glm::dvec2, 4> size_;
    double scale_ = 1;                            ///< of the screen
    std::array<Margins, 4> margins_{};            ///< by View
    std::array<Covered, 4> covered_{};            ///< by View
    std::array<std::optional<Camera>, 4> fitted_; ///< by View
};

} // namespace spia::viewer

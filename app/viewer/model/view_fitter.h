#pragma once
#include <array>
#include <optional>

#include "app/viewer/model/state.h"

namespace spia::viewer {

/// Knows how large each view is on the screen, and sets cameras so that all of what a view shows is seen, as large as it
/// may be. The views that turn together get one camera, which fits in each of them.
class ViewFitter {
public:
    ViewFitter() { size_.fill({800, 600}); }

    /// @param only  this view, and those that turn with it; not given: all
    void fit(ViewerState& state, std::optional<View> only = {});
    /// A view that has not been moved since it was fitted is so again.
    /// @param size  pixels; @param scale  how many of them one of the design is
    void resized(ViewerState& state, View view, glm::dvec2 size, double scale);
    /// Whether the camera is still the one that fit() made.
    bool is_fitted(const ViewerState& state, View view) const
    {
        return fitted_[size_t(view)] == state.view.camera[size_t(view)];
    }

private:
    Margins margins(const ViewerState& state, View view) const;
    void fit_blank(ViewerState& state);
    void fit_space(ViewerState& state, const PartFile& part, std::optional<View> only);

    std::array<glm::dvec2, 4> size_;
    double scale_ = 1;                            ///< of the screen
    std::array<Margins, 4> margins_{};            ///< by View
    std::array<std::optional<Camera>, 4> fitted_; ///< by View
};

} // namespace spia::viewer

#pragma once
#include <array>
#include <optional>

#include "app/viewer/model/jobs/viewer_model.h"

namespace spia::viewer {

/// Views on their way to where an action has sent them: a quarter of a second, slowly away and
/// slowly there. The state has the cameras that are shown; what the user does meanwhile is done
/// where the way ends.
class ViewGlide {
public:
    explicit ViewGlide(ViewerModel& model) : model_(model) {}

    bool runs() const { return way_.has_value(); }
    /// Before an action is carried out: another way ends.
    void before(const Action& action);
    /// After the actions of a frame. @param may whether a glide would be seen as one, else the
    /// views are there at once
    /// @param now  seconds of the clock that follow() gets, too
    void begin(bool may, double now);
    /// Once a frame: a step of the way, unless the user has moved a view meanwhile.
    void follow(bool may, double now);

private:
    using Cameras = std::array<Camera, 4>;
    struct Way {
        Cameras from, to, shown; ///< shown: in the last frame
        double since;            ///< seconds
    };
    const Cameras& cameras() const { return model_.state().view.camera; }
    void set(const Cameras& cameras);
    void stop();
    void end();

    ViewerModel& model_;
    std::optional<Way> way_;
    std::optional<Cameras> left_; ///< where one begins
};

} // namespace spia::viewer

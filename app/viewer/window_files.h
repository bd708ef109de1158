#pragma once
#include <memory>
#include <vector>

#include "app/viewer/animation.h"
#include "app/viewer/model/jobs/file_writer.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/render/renderer.h"

namespace spia::viewer {

/// The files that only a window can make, because they hold what it draws: pictures, reports,
/// animations. They are written on threads; what becomes of them is said as messages.
class WindowFiles {
public:
    WindowFiles(Renderer& renderer, ViewerModel& model, SceneCache& cache, Ui& ui);

    /// @returns whether the action asks for such a file
    /// @throws InputError if there is nothing to write
    bool take(const Action& action);
    void later(const Screenshot& wanted) { pictures_.push_back(wanted); }
    /// At the end of a frame, when the window shows what the actions before have changed: pictures
    /// that wait, and a picture of an animation. @param width, height of the window, pixels
    /// @param all_drawn  no view still shows an older picture
    void draw(int width, int height, bool all_drawn);
    /// Says what has been written meanwhile. @returns whether anything has
    bool follow();

    bool pictures_wait() const { return !pictures_.empty(); }
    bool drawing() const { return pictures_wait() || animation_; }
    bool busy() const { return drawing() || writer_.busy(); }
    void wait() const { writer_.wait(); }

private:
    void draw_pictures(int width, int height);
    void begin_animation(const SaveAnimation& wanted);
    void draw_animation();
    Picture view_picture(const Screenshot& wanted);
    void write_report(const WriteReport& wanted);

    Renderer& renderer_;
    ViewerModel& model_;
    SceneCache& cache_;
    Ui& ui_;
    std::vector<Screenshot> pictures_;
    std::unique_ptr<Animation> animation_; ///< that is being made
    FileWriter writer_;
};

} // namespace spia::viewer

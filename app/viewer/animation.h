#pragma once
#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "app/viewer/pictures.h"
#include "engine/core/worker.h"

namespace spia::viewer {

/// The document with the blank of one step as if it were a state of unfolding step by step, laid
/// beside the part by the turn that brings it nearest: so the way from one to the other can be
/// shown. @throws InputError if there is no blank
Document blank_as_state(const Document& document);

/// An animation on its way into a file. The window draws one picture a frame and stays alive; a
/// thread makes files of them. What is shown is the state as it was when the animation was asked
/// for.
class Animation {
public:
    /// @param wake  called on the thread when it has done something
    /// @throws InputError if there is nothing to show, or it is too large
    Animation(const SaveAnimation& wanted, const ViewerState& state, std::function<void()> wake);
    ~Animation();

    /// Draws the next picture, unless the thread has enough to do; call once a frame. @throws as
    /// picture_of_view()
    void draw_next(Renderer& renderer, ViewerModel& model);
    void cancel() { *cancelled_ = true; }
    bool ended() const;
    double fraction() const;
    /// Once it has ended: the files. None: it was cancelled, nothing is left behind. @throws
    /// ExchangeError
    std::vector<std::filesystem::path> take();

private:
    class Files;
    class Gif;
    class Series;

    Picture picture(Renderer& renderer, ViewerModel& model, double share, int width, int height);

    SaveAnimation wanted_;
    ViewerState shown_;
    SceneCache cache_;
    double end_ = 1;     ///< of the slider
    bool steps_ = false; ///< there are steps, else it is the blank of one
    int drawn_ = 0;
    std::shared_ptr<std::atomic<bool>> cancelled_ = std::make_shared<std::atomic<bool>>(false);
    std::shared_ptr<Files> files_; ///< belongs to the thread once that has begun
    std::deque<Eventually<bool>> pending_;
    bool all_asked_ = false;
    std::exception_ptr error_;
    Worker worker_; ///< last: it ends first
};

} // namespace spia::viewer

#pragma once
#include <array>
#include <chrono>
#include <vector>

#include "app/viewer/render/renderer.h"

namespace spia::viewer {

/// Which of several views are drawn in a frame when all together would take too long: the others
/// keep their last picture until the next frame. The one that waits longest always has its turn, so
/// every view follows in the end.
class DrawTurns {
public:
    /// @param budget  ms; once that much is spent in a frame, only an urgent view and the one whose
    /// turn it is are drawn
    explicit DrawTurns(double budget) : budget_(budget) {}

    void begin_frame();
    /// Whether view `index` is drawn now; if not it waits. Ask once per frame and view that needs
    /// drawing.
    /// @param urgent  the user is busy in it
    bool may_draw(size_t index, bool urgent);
    void spent(double ms) { spent_ += ms; }
    bool any_waits() const; ///< of those that asked in this frame

private:
    static constexpr size_t views_ = 4;
    double budget_, spent_ = 0;
    std::array<int, views_> waited_{}; ///< frames
    std::array<bool, views_> asked_{}; ///< in this frame: a view that is not shown waits for
                                       ///< nothing
    size_t turn_ = views_;             ///< none
};

/// The pictures of the four views, drawn in turns.
class ViewImages {
public:
    explicit ViewImages(Renderer& renderer) : renderer_(renderer) {}

    void begin_frame()
    {
        turns_.begin_frame();
        small_drawn_ = small_waits_ = false;
    }
    struct Drawn {
        unsigned texture;
        bool old; ///< it shows another scene
    };
    /// As Renderer::draw(), but the texture may show the view as it was some frames ago; then
    /// any_late() is true.
    Drawn draw(size_t view, bool urgent, const Scene& scene, const Camera& camera, int width, int height,
               const Look& look);
    /// A small picture, by number; one in a frame is drawn. 0: it is not there yet.
    unsigned draw_small(size_t number, const Scene& scene, const Camera& camera, int width, int height,
                        const Look& look);
    /// Whether another frame is needed to show what is wanted.
    bool any_late() const { return turns_.any_waits() || small_waits_; }

private:
    static constexpr double budget_ms_ = 40;
    Renderer& renderer_;
    std::array<Renderer::Image, 4> images_;
    DrawTurns turns_{budget_ms_};
    std::vector<Renderer::Image> small_;
    bool small_drawn_ = false, small_waits_ = false; ///< in this frame
};

} // namespace spia::viewer

#include "app/viewer/render/view_images.h"

#include <algorithm>
#include <utility>

namespace spia::viewer {

void DrawTurns::begin_frame()
{
    spent_ = 0;
    for (size_t i = 0; i < views_; ++i)
        if (!std::exchange(asked_[i], false))
            waited_[i] = 0;
    const auto longest = std::max_element(waited_.begin(), waited_.end());
    turn_ = *longest > 0 ? size_t(longest - waited_.begin()) : views_;
}

bool DrawTurns::may_draw(size_t index, bool urgent)
{
    const bool now = urgent || index == turn_ || spent_ < budget_;
    asked_[index] = true;
    waited_[index] = now ? 0 : waited_[index] + 1;
    return now;
}

bool DrawTurns::any_waits() const
{
    for (size_t i = 0; i < views_; ++i)
        if (asked_[i] && waited_[i] > 0)
            return true;
    return false;
}

unsigned ViewImages::draw_small(size_t number, const Scene& scene, const Camera& camera, int width, int height,
                                const Look& look)
{
    while (small_.size() <= number)
        small_.emplace_back();
    Renderer::Image& image = small_[number];
    if (renderer_.shows(image, scene, camera, width, height, look))
        return Renderer::texture(image);
    if (small_drawn_) {
        small_waits_ = true;
        return Renderer::texture(image);
    }
    small_drawn_ = true;
    return renderer_.draw(image, scene, camera, width, height, look);
}

ViewImages::Drawn ViewImages::draw(size_t view, bool urgent, const Scene& scene, const Camera& camera, int width,
                                   int height, const Look& look)
{
    Renderer::Image& image = images_[view];
    const unsigned before = Renderer::texture(image);
    // What shows already costs nothing, and has no more to wait for.
    const bool needed = !renderer_.shows(image, scene, camera, width, height, look);
    if (!turns_.may_draw(view, urgent || !needed || before == 0))
        return {before, !Renderer::shows(image, scene)};
    const auto start = std::chrono::steady_clock::now();
    const unsigned texture = renderer_.draw(image, scene, camera, width, height, look);
    turns_.spent(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    return {texture, false};
}

} // namespace spia::viewer

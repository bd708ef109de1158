#include "app/viewer/view_glide.h"

#include <utility>

namespace spia::viewer {
namespace {

/// Whether an action shows the part from elsewhere.
bool looks_from_elsewhere(const Action& action)
{
    return action.is<LookFrom>() || action.is<LookFromSide>() || action.is<FitView>() || action.is<FlyTo>() ||
           action.is<FlyToVertex>() || action.is<HideSpot>() || action.is<HideFault>() || action.is<ShowFault>();
}

} // namespace

void ViewGlide::before(const Action& action)
{
    const bool elsewhere = looks_from_elsewhere(action);
    if (!action.is<SetViewSettings>()) {
        if (way_ && elsewhere && !left_)
            left_ = way_->shown;
        end();
    }
    if (elsewhere && !left_)
        left_ = cameras();
}

void ViewGlide::begin(bool may, double now)
{
    const auto left = std::exchange(left_, std::nullopt);
    if (!left || !may || *left == cameras())
        return;
    way_ = Way{*left, cameras(), *left, now};
    model_.views_glide(true);
    set(*left);
}

void ViewGlide::follow(bool may, double now)
{
    if (!way_)
        return;
    if (cameras() != way_->shown) {
        stop();
        return;
    }
    constexpr double seconds = 0.25;
    const double t = (now - way_->since) / seconds;
    if (!(t < 1) || !may) {
        end();
        return;
    }
    const double share = t * t * (3 - 2 * t); // begins and ends at rest
    for (size_t v = 0; v < way_->shown.size(); ++v)
        way_->shown[v] = between(way_->from[v], way_->to[v], share);
    set(way_->shown);
}

void ViewGlide::set(const Cameras& cameras)
{
    ViewSettings settings = model_.state().view;
    settings.camera = cameras;
    model_.apply(SetViewSettings{settings});
}

/// The views are where they glide to.
void ViewGlide::end()
{
    const auto way = way_;
    stop();
    if (way && cameras() == way->shown)
        set(way->to);
}

void ViewGlide::stop()
{
    way_.reset();
    model_.views_glide(false);
}

} // namespace spia::viewer

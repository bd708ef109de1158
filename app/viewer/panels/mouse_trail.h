#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace spia::viewer {

/// Where the mouse was when its buttons went down and up. A frame notices a press late: a fast hand
/// is farther along by then, and what begins there (a box, a section, a corner that is taken) has
/// lost its start. Nor does one place a frame tell the way it went (a lasso, a brush).
class MouseTrail {
public:
    void moved(glm::dvec2 to)
    {
        at_ = to;
        if (down_ && path_.size() < most)
            path_.push_back(to);
    }
    void button(bool down)
    {
        if (down && !down_)
            path_.clear();
        down_ = down;
        if (at_)
            events_.push_back({down, *at_});
    }

    /// Where the mouse belongs in this frame: at its last press, in the next frame at the release
    /// that followed; nothing: where it is. The frame after another is to come at once.
    std::optional<glm::dvec2> next()
    {
        held_ = false;
        size_t take = events_.size();
        for (size_t k = 0; k < events_.size(); ++k)
            if (events_[k].down)
                take = k;
        if (events_.empty())
            return std::nullopt;
        if (take == events_.size()) // releases alone
            take = events_.size() - 1;
        const glm::dvec2 place = events_[take].at;
        held_ = events_[take].down;
        events_.erase(events_.begin(), events_.begin() + long(take) + 1);
        return place;
    }

    /// Where it was with a button down since the last call, in order. In the frame of a press
    /// nothing: the way from there belongs to the next one.
    std::vector<glm::dvec2> take_path() { return held_ ? std::vector<glm::dvec2>{} : std::exchange(path_, {}); }

private:
    static constexpr size_t most = 10'000; ///< places of one frame
    struct Event {
        bool down;
        glm::dvec2 at;
    };
    std::optional<glm::dvec2> at_; ///< not before it has moved
    std::vector<Event> events_;
    std::vector<glm::dvec2> path_;
    bool down_ = false, held_ = false;
};

} // namespace spia::viewer

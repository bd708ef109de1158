#pragma once
#include <string>
#include <utility>

#include "app/viewer/model/jobs/viewer_model.h"

namespace spia::viewer {

/// What panels tell the model at once, without an action that could be undone or recorded: the
/// mouse over a view, the size of a view, a message.
class ViewEvents {
public:
    ViewEvents() = default; ///< of a picture: nobody is told
    explicit ViewEvents(ViewerModel& model) : model_(&model) {}

    void say(Severity severity, std::string text, Subject subject = {}) const
    {
        if (model_)
            model_->say(severity, std::move(text), std::move(subject));
    }
    void hover(View view, glm::dvec2 pixel, glm::dvec2 size, double reach) const
    {
        if (model_)
            model_->hover(view, pixel, size, reach);
    }
    void hover_nothing() const
    {
        if (model_)
            model_->hover_nothing();
    }
    void resized(View view, glm::dvec2 size, double scale, const Covered& covered) const
    {
        if (model_)
            model_->resized(view, size, scale, covered);
    }

private:
    ViewerModel* model_ = nullptr;
};

} // namespace spia::viewer

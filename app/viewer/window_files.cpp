#include "app/viewer/window_files.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include "app/viewer/gl_window.h"
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/pictures.h"
#include "app/viewer/render/picture_file.h"
#include "engine/core/error.h"
#include "engine/report/html/html_report.h"

namespace spia::viewer {

WindowFiles::WindowFiles(Renderer& renderer, ViewerModel& model, SceneCache& cache, Ui& ui)
    : renderer_(renderer), model_(model), cache_(cache), ui_(ui), writer_([] { glfwPostEmptyEvent(); })
{
}

bool WindowFiles::take(const Action& action)
{
    if (const auto* picture = action.as<Screenshot>())
        later(*picture);
    else if (const auto* report = action.as<WriteReport>())
        write_report(*report);
    else if (const auto* animation = action.as<SaveAnimation>())
        begin_animation(*animation);
    else
        return false;
    return true;
}

void WindowFiles::draw(int width, int height, bool all_drawn)
{
    if (all_drawn)
        draw_pictures(width, height);
    draw_animation();
}

bool WindowFiles::follow()
{
    const std::vector<FileWriter::Ended> ended = writer_.take_ended();
    for (const FileWriter::Ended& each : ended)
        if (each.error.empty())
            model_.say(Severity::done, fmt::format("Wrote {}", each.file.string()));
        else
            model_.say(Severity::error, each.error);
    return !ended.empty();
}

void WindowFiles::draw_pictures(int width, int height)
{
    for (const Screenshot& wanted : std::exchange(pictures_, {}))
        try {
            Picture picture =
                wanted.view ? view_picture(wanted)
                : wanted.width > 0 && wanted.height > 0
                    ? picture_of_window(renderer_, model_, cache_, ui_, {width, height}, wanted.width, wanted.height)
                    : GlWindow::picture(width, height);
            writer_.later(wanted.file,
                          [file = wanted.file, picture = std::move(picture)] { write_png(file, picture); });
        } catch (const std::exception& error) {
            model_.say(Severity::error, error.what());
        }
}

void WindowFiles::begin_animation(const SaveAnimation& wanted)
{
    if (animation_)
        throw InputError("Wait for the animation that is being made, or cancel it.");
    animation_ = std::make_unique<Animation>(wanted, model_.state(), [] { glfwPostEmptyEvent(); });
    ui_.animation = AnimationRun{};
}

/// A picture of it a frame, until it is written.
void WindowFiles::draw_animation()
{
    if (!animation_)
        return;
    GlWindow::news() = true;
    try {
        if (ui_.animation && ui_.animation->cancelling)
            animation_->cancel();
        animation_->draw_next(renderer_, model_);
        ui_.animation->fraction = animation_->fraction();
        if (!animation_->ended())
            return;
        const auto files = animation_->take();
        if (files.empty())
            model_.say(Severity::hint, "The animation was cancelled; nothing was written.");
        else if (files.size() == 1)
            model_.say(Severity::done, fmt::format("Wrote {}", files[0].string()));
        else
            model_.say(Severity::done, fmt::format("Wrote {} pictures, {} to {}", files.size(), files[0].string(),
                                                   files.back().filename().string()));
    } catch (const std::exception& error) {
        model_.say(Severity::error, error.what());
    }
    animation_.reset();
    ui_.animation.reset();
}

Picture WindowFiles::view_picture(const Screenshot& wanted)
{
    const ImVec2 size = ui_.view_size[size_t(*wanted.view)];
    return picture_of_view(
        renderer_, model_, model_.state(), cache_, *wanted.view, wanted.width > 0 ? wanted.width : int(size.x),
        wanted.height > 0 ? wanted.height : int(size.y), {wanted.legend, wanted.labels, !wanted.transparent});
}

void WindowFiles::write_report(const WriteReport& wanted)
{
    const Document& document = model_.state().document;
    if (!document.session.blank)
        throw InputError("There is nothing to report yet: unfold the part first.");
    if (shows_refused(model_.state()))
        throw InputError("Go back to the part first, in the step Part: the view shows the file that was refused.");
    ReportOptions options = report_options(wanted.options);
    if (const std::string stale = out_of_date(document); !stale.empty())
        options.remarks = stale + (options.remarks.empty() ? "" : "\n" + options.remarks);
    std::vector<std::string> doubts;
    for (const Doubt& doubt : find_doubts(document, wanted.options.lengths))
        doubts.push_back(doubt.text);
    writer_.later(wanted.file,
                  [file = wanted.file, session = as_made(document), options = std::move(options),
                   doubts = std::move(doubts), pictures = report_pictures(renderer_, model_, cache_, wanted.options)] {
                      write_html_report(file, session, png_files(pictures), options, doubts);
                  });
}

} // namespace spia::viewer

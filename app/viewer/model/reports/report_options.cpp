#include "app/viewer/model/reports/report_options.h"

#include "engine/options/option.h"

namespace spia::viewer {

ReportOptions report_options(const ViewerReportOptions& options)
{
    return {options.title, options.remarks, options.tables, {options.lengths, window_text}};
}

ViewerState standard_look(const ViewerState& state)
{
    ViewerState result;
    result.document = state.document;
    result.document.display = FieldDisplay{};
    result.document.selected.clear();
    result.document.section.reset();
    result.view.dark = false;
    for (const View view : all_views) {
        Camera& camera = result.view.camera[size_t(view)];
        camera = look(camera, view == View::blank ? StandardView::top : StandardView::isometric);
        camera.flat = view == View::blank;
    }
    return result;
}

} // namespace spia::viewer

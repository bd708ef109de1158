#pragma once
#include "app/viewer/model/actions/actions.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/render/renderer.h"
#include "engine/report/html/html_report.h"

namespace spia::viewer {

/// What a picture shows beside the scene.
struct PictureContent {
    bool legend = true, labels = true;
    bool ground = true; ///< else transparent
    float larger = 1;   ///< lines and letters, than picture_scale() has them
};

/// How much larger than at content scale 1 lines and letters are drawn, so that they look alike in
/// pictures of all sizes.
float picture_scale(int width, int height);

/// A picture of one view at any size, drawn aside from the window: the scene, over it legend and
/// labels as the panels draw them. Needs the context of OpenGL; leaves ImGui's as it is.
/// @param state what is shown, and its camera; it need not be the model's
/// @throws Error if OpenGL fails; InputError if the size is not positive or too large for the
/// memory
Picture picture_of_view(Renderer& renderer, ViewerModel& model, const ViewerState& state, SceneCache& cache, View view,
                        int width, int height, const PictureContent& content = {});

/// The whole window laid out for another size, without dialogs: with a longer side the same layout,
/// but finer.
/// @param screen size of the window, pixels
/// @throws as picture_of_view()
Picture picture_of_window(Renderer& renderer, ViewerModel& model, SceneCache& cache, const Ui& ui, glm::ivec2 screen,
                          int width, int height);

/// A picture of a report, not yet as a file.
struct TitledPicture {
    std::string title;
    Picture picture;
};

/// The pictures of a report, of those views that have something to show.
std::vector<TitledPicture> report_pictures(Renderer& renderer, ViewerModel& model, SceneCache& cache,
                                           const ViewerReportOptions& options);

/// As the report holds them; needs no OpenGL. @throws ExchangeError
std::vector<ReportPicture> png_files(const std::vector<TitledPicture>& pictures);

} // namespace spia::viewer

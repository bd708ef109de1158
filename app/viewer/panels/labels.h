#pragma once
#include <imgui.h>
#include <memory>
#include <optional>
#include <vector>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/picking/camera.h"
#include "app/viewer/views/isolines.h"
#include "app/viewer/views/label_layout.h"
#include "engine/mesh/pick.h"

namespace spia::viewer {

struct Frame;

/// Where the labels of a view stand, as long as nothing moves.
struct LabelPlaces {
    // what for
    Camera camera, last_camera; ///< the last one is that of the frame before
    glm::dvec2 size{0};
    std::vector<SceneLabel> labels;
    std::shared_ptr<const std::vector<Isoline>> isolines;
    std::vector<PixelBox> taken;
    std::optional<HalfSpace> kept;
    std::shared_ptr<const PartFile> part;
    bool picker = false; ///< else what hides a place was not known yet

    std::vector<PlacedLabel> placed;
    std::vector<char> hidden; ///< per label placed: its place lies behind the sheet
    std::vector<IsolineLabel> values;
};

/// Whether the clipping plane cuts away a place of a scene.
bool cut_away(const Scene& scene, const Eigen::Vector3d& place);

/// Text with an outline that is read on any ground.
void haloed(ImDrawList* draw, ImVec2 at, ImU32 colour, ImU32 halo, const char* text);

/// The colours of a scene and what they mean, if the view has room for it.
/// @return what of the view it covers, pixels
std::optional<PixelBox> draw_legend(const Frame& frame, const Scene& scene, ImVec2 from, ImVec2 size, ImDrawList* draw);

/// The labels of a scene and the values of its isolines, none over another. A label that had to go
/// aside has a line to its place; one whose place is hidden is pale, one whose place is cut away is
/// not there.
/// @param taken  what none may cover, pixels of the view
void draw_labels(Frame& frame, View view, const Scene& scene, ImVec2 from, ImVec2 size,
                 const std::vector<PixelBox>& taken, ImDrawList* draw);

} // namespace spia::viewer

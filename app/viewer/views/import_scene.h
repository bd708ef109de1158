#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "app/viewer/model/camera.h"
#include "app/viewer/model/file_listing.h"
#include "app/viewer/model/scene.h"

namespace spia::viewer {

/// The preview of a file that is looked into: what is chosen in the colour of a choice, the rest pale.
/// @param mesh     scene_mesh() of the listed one
/// @param chosen   per item; an item in a chosen one is chosen as well; none: all is
/// @param hovered  an item: lit up
Scene import_scene(const ListedFile& listed, const std::shared_ptr<const SceneMesh>& mesh,
                   const std::vector<char>& chosen, std::optional<int> hovered);

/// The whole preview from the front right above. @param size pixels
Camera import_camera(const ListedFile& listed, glm::dvec2 size);

} // namespace spia::viewer

#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "app/viewer/model/document/file_listing.h"
#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {

/// Some triangles of a preview as they are drawn.
struct PreviewPiece {
    std::vector<int> triangle; ///< of the listed mesh
    std::shared_ptr<const SceneMesh> mesh;
};

/// The preview of a file that is looked into, by what is chosen of it.
struct PreviewShape {
    bool everything = false; ///< nothing is chosen: the whole file is read
    PreviewPiece chosen, rest;
};

/// @param chosen  per item; an item in a chosen one is chosen as well; none: all is
PreviewShape preview_shape(const ListedFile& listed, const std::vector<char>& chosen);

/// What is chosen in the colour of a choice, the rest like glass, so that what lies inside is seen.
/// @param hovered  an item: lit up
Scene import_scene(const ListedFile& listed, const PreviewShape& shape, std::optional<int> hovered);

/// The whole preview from the front right above. @param size pixels
Camera import_camera(const ListedFile& listed, glm::dvec2 size);

} // namespace spia::viewer

#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/viewer/model/document/file_listing.h"
#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/picking/camera.h"
#include "app/viewer/model/picking/mouse_style.h"
#include "app/viewer/views/import_scene.h"
#include "app/viewer/views/scene_cache.h"
#include "engine/core/worker.h"
#include "engine/mesh/solid/skin.h"

namespace spia::viewer {

struct Frame;

/// What was chosen of a file that is looked into.
struct ImportChoices {
    std::shared_ptr<const ListedFile> about; ///< with it the choices begin anew
    std::vector<char> chosen;                ///< per item
    bool fresh = true;                       ///< the list has not been shown yet
    std::vector<std::string> others;         ///< chosen as well, faces by their numbers
    std::optional<bool> weld;                ///< as the part was read
    std::optional<double> weld_gap;          ///< mm, likewise
    std::string unit;                        ///< empty: as the file says, else mm
    std::optional<Skin> skin;
    bool keep_largest = false, leave_out_bad_faces = false, keep_triangles = false;
    std::string sewing, deflection; ///< mm, as typed; empty: found
    std::optional<int> hovered;     ///< an item
    Camera camera;
    Navigator navigator;
    bool left = false, moved = false;          ///< the left button is down; the mouse has moved
                                               ///< since it went down
    std::shared_ptr<const PreviewShape> shape; ///< the newest that is ready; null: none yet
    Memo<Eventually<std::shared_ptr<const PreviewShape>>, std::shared_ptr<const ListedFile>, std::vector<char>> making;
    Memo<Scene, std::shared_ptr<const PreviewShape>, std::optional<int>> scene;
    std::shared_ptr<Worker> worker; ///< makes the shapes of large files
};

/// Shows a file that is looked into (ViewerState::listing), lets choose what of it is read and how,
/// and opens it.
void import_dialog(Frame& frame);

} // namespace spia::viewer

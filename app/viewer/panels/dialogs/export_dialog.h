#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/viewer/model/reports/export_check.h"
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/views/scene_cache.h"
#include "engine/pipeline/outputs/outputs.h"

namespace spia::viewer {

struct Frame;

/// What was chosen in the export dialog; kept until the program ends.
struct ExportChoices {
    std::string folder, suggested; ///< see follow()
    std::vector<std::string> formats = {"iges", "step", "glb", "dxf"};
    OutputOptions options;
    bool sent = false;  ///< the files are being written, or what became of them is shown
    bool asked = false; ///< "Export" was pressed although the surface is far off; the next click
                        ///< exports it

    /// The files to come, and which of them are there already.
    struct Planned {
        std::vector<std::filesystem::path> files;
        std::vector<bool> exists;
        std::string problem; ///< why nothing can be written
    };
    Memo<Planned, std::string, std::vector<std::string>, OutputOptions, std::shared_ptr<const FlattenResult>,
         std::shared_ptr<const LiftResult>, std::shared_ptr<const SurfaceStage>>
        planned;
    Memo<FitVerdict, std::shared_ptr<const SurfaceStage>> verdict;
};

void export_dialog(Frame& frame);

} // namespace spia::viewer

#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "app/viewer/views/scene_cache.h"
#include "engine/forming/material/material_fit.h"

namespace spia::viewer {

struct Frame;

/// What was chosen in the dialog that makes a material of a tensile test; kept until the program
/// ends.
struct MaterialChoices {
    std::string table;           ///< file of the test
    std::string file, suggested; ///< of the material, see follow()
    MaterialFitOptions options;

    /// What the test gives, or why it gives nothing.
    struct Outcome {
        std::optional<MaterialFit> fit;
        std::string problem;
    };
    Memo<Outcome, std::string, std::filesystem::file_time_type, MaterialFitOptions> outcome;
};

/// Asks for the file of the test first.
void choose_tensile_test(Frame& frame);
void material_dialog(Frame& frame);

} // namespace spia::viewer

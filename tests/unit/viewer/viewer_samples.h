#pragma once
#include <filesystem>

#include "app/viewer/model/document/document.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"

namespace spia::viewer {

inline const std::filesystem::path materials_folder = SPIA_SOURCE_DIR "/assets/materials";

/// A document with this part, run up to a stage.
inline Document document_of(const std::filesystem::path& part, Stage last)
{
    Document document;
    document.session.file = part;
    document.session.options.flatten.material = find_material(document.material, materials_folder);
    document.session = completed(run_chain(document.session, Stage::read, last));
    return document;
}

inline const std::filesystem::path dome = SPIA_SOURCE_DIR "/assets/parts/dome.obj";

} // namespace spia::viewer

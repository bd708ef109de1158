#pragma once
#include <filesystem>

#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"

namespace spia {

inline const std::filesystem::path dome = SPIA_SOURCE_DIR "/assets/parts/dome.obj";

/// Of a part in mild steel, run up to a stage.
inline Session session_of(const std::filesystem::path& part, Stage last)
{
    Session session;
    session.file = part;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const Stage stage : chain)
        if (stage <= last)
            session = run_stage(stage, session);
    return session;
}

} // namespace spia

#pragma once
#include <filesystem>

#include "engine/forming/material_library.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/bent_solid.h"

namespace spia {

/// The solid written as a STEP file, read by default options and laid flat with its own thickness.
inline Session solved_bent_solid(const std::filesystem::path& file, const shapes::BentSolid& solid)
{
    shapes::write_bent_solid(file, solid);
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.flatten.thickness = solid.thickness;
    return run_stage(Stage::solve, run_stage(Stage::read, std::move(session)));
}

} // namespace spia

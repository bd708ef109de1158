#pragma once
#include <filesystem>
#include <optional>
#include <utility>

#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/bent_solid.h"

namespace spia {

/// A part read by default options and laid flat.
/// @param thickness  mm; not given: the part's own, or 1 where the file has none
inline Session solved_part(const std::filesystem::path& file, std::optional<double> thickness = {},
                           std::optional<KFactor> k = {})
{
    Session session;
    session.file = file;
    session.options.k_factor = std::move(k);
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return completed(run_chain(std::move(session), Stage::read, Stage::solve, {.thickness = thickness}));
}

/// The solid written as a STEP file, read by default options and laid flat with its own thickness.
inline Session solved_bent_solid(const std::filesystem::path& file, const shapes::BentSolid& solid)
{
    shapes::write_bent_solid(file, solid);
    return solved_part(file, solid.thickness);
}

} // namespace spia

#pragma once
#include <filesystem>

#include "engine/forming/process/process.h"
#include "engine/part/part_file.h"

namespace spia {

/// Reads process conditions (JSON; the form is documented in engine/pipeline/README.md). Faces are
/// given by their numbers in the part's file or by a box that holds their middles; lengths in mm.
/// @param material, thickness of the base sheet: for the force of a bead given by its shape where
/// no tailored piece lies, and
///                            where a tailored piece has no grade
/// @param materials folder of the built-in grades
/// @throws InputError naming file, place and fault: no JSON, an unknown member, a value out of its
/// bounds, a face that the
///                    part does not have, a choice that picks no face
ProcessConditions read_process(const std::filesystem::path& file, const PartFile& part, const Material& material,
                               double thickness, const std::filesystem::path& materials);

} // namespace spia

#pragma once
#include "engine/exchange/mesh/checked_file.h"
#include "engine/mesh/soup.h"

namespace spia {

/// Lets OpenMesh read a checked file, and takes the coordinates in full precision where the format
/// has it. One file at a time: OpenMesh's readers keep the state of the file in the reader.
/// @returns all faces in the order of the file; in file units. STL: vertices of equal coordinates
/// are one already
/// @throws InputError if OpenMesh saw other vertices or faces than the check
PolygonSoup read_openmesh(const CheckedFile& file);

} // namespace spia

#pragma once
#include <string>

#include "engine/mesh/cut/cut.h"

namespace spia {

/// @param choice "auto", "none", "corners", or a file {"seam": [[12, 40, 77], [5, 9]]}: paths of
///         vertices, numbers in the part's file from 0; from each vertex to the next the seam takes
///         the shortest way along the edges
/// @throws InputError if the file cannot be read or says something else
SeamOptions seam_options(const std::string& choice);

} // namespace spia

#pragma once
#include <TopoDS_Face.hxx>
#include <span>
#include <vector>

#include "engine/core/progress.h"

namespace spia {

/// Per face another one on which all of it lies within the tolerance (mm), by its border and places
/// inside; -1: none. Of two that are the same the later lies on the earlier. For .cpp files of
/// engine/exchange that hold an OcctSession.
std::vector<int> doubled_faces(std::span<const TopoDS_Face> faces, double tolerance, const Progress& progress);

} // namespace spia

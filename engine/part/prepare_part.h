#pragma once
#include "engine/core/progress.h"
#include "engine/mesh/soup.h"
#include "engine/part/corner_normals.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"

namespace spia {

/// Examines what the file holds, takes the skin of a solid and cuts open what is no sheet.
/// @param part  with its format, unit and notes
/// @param solid  whether the file says that it is one; @param normals of CAD faces; nullptr:
/// unknown
PartFile prepare_part(PartFile part, const PolygonSoup& soup, const ReadOptions& options, bool weld, bool solid,
                      const CornerNormals* normals, const Progress& progress);

/// A part of faces that are already in memory, in mm. A sick part is no error.
PartFile examine_soup(const PolygonSoup& soup, const ReadOptions& options = {}, const Progress& progress = {});

} // namespace spia

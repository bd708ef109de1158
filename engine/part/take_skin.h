#pragma once
#include "engine/part/corner_normals.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"

namespace spia {

/// Puts a skin in the place of a solid of sheet, with its thickness and with notes that say so. A
/// closed part that is no sheet of one thickness gets a fatal finding with the reason and the
/// place; an open one stays as it is. Sheets stay as they are.
/// @param part  examined, not cut open yet; @param solid  whether the file says that it is a solid
/// @param normals  of the faces of the file, where CAD faces say them; nullptr: unknown
/// @returns whether it was refused
bool take_skin(PartFile& part, const ReadOptions& options, bool solid, const CornerNormals* normals,
               const Progress& progress);

} // namespace spia

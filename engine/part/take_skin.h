#pragma once
#include "engine/part/corner_normals.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"

namespace spia {

struct TakenSkin {
    PartFile part;
    bool refused = false; ///< it is closed and no sheet of one thickness: a fatal finding says why,
                          ///< and where
};

/// A skin in the place of a solid of sheet, with its thickness and with notes that say so. Sheets
/// stay as they are, and open parts that are no solids.
/// @param part  examined, not cut open yet; @param solid  whether the file says that it is a solid
/// @param normals  of the faces of the file, where CAD faces say them; nullptr: unknown
TakenSkin take_skin(PartFile part, const ReadOptions& options, bool solid, const CornerNormals* normals,
                    const Progress& progress);

} // namespace spia

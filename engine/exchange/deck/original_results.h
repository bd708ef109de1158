#pragma once
#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// What was found on a remeshed part of a deck, said of the triangles that its elements were.
struct OriginalResults {
    PartFile part;    ///< as_read()
    Blank blank;      ///< of its vertices
    SheetFields face; ///< of its triangles
};

/// Carries results back to the part as it was read. A vertex lies in the blank where the nearest
/// place of the remeshed part lies. A triangle has the mean of the fields at places spread over it,
/// no farther apart than half an edge of the remeshed part; strains and stresses are averaged as
/// tensors in its plane.
/// At a boundary the place is looked for a little inside, so that both banks of a seam find their
/// own side, and the map of the triangle there is continued to the vertex.
/// @param blank, face  of the remeshed part
/// @throws InputError if the part is no remeshed one of a deck, or blank or fields do not match it
/// The result does not depend on the number of threads.
OriginalResults on_original(const PartFile& part, const Blank& blank, const SheetFields& face);

} // namespace spia

#pragma once
#include "engine/forming/solver/laid_lengths.h"
#include "engine/part/corner_normals.h"
#include "engine/part/part_file.h"

namespace spia {

/// Per triangle of a part the normals of its CAD face at the corners, to the side of the triangle;
/// zero where a corner is not one of the face's triangle, or beside it, as at what was made anew.
std::vector<Eigen::Matrix3f> corner_normals(const PartFile& part, const PolygonSoup& soup,
                                            const CornerNormals& normals);

/// Those of a remeshed part, from the triangles that it had; and its vertices, which the remesher
/// put on these, where the CAD faces are. A vertex of a sharp edge stays.
void onto_faces(PartFile& part);

/// The lengths that triangles have on the CAD faces over them.
LaidLengths lengths_on_faces(const PartFile& part);

/// mm2, of a part, with its CAD faces' lengths.
double sheet_area(const PartFile& part);

} // namespace spia

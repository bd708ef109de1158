#pragma once
#include <TopoDS_Face.hxx>
#include <array>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/solid/stated_curve.h"
#include "engine/mesh/soup.h"
#include "engine/part/cad_options.h"

namespace spia {

struct FaceTriangles {
    PolygonSoup soup;                                   ///< mm
    std::vector<int> face;                              ///< per triangle: index of its face
    std::vector<std::array<Eigen::Vector3f, 3>> normal; ///< per triangle at its corners: of its
                                                        ///< face, to the side from which the
                                                        ///< triangle is counter-clockwise; zero at
                                                        ///< poles
    StatedCurves curves;                                ///< of the edges of the faces; vertices of
                                                        ///< the soup
};

/// Triangulates faces and joins the triangles along the edges that faces share, by which point of
/// the edge they have: no distance is compared. A face with a point that is no number, or a corner
/// that is no point, has no triangles. For .cpp files of engine/exchange that hold an OcctSession.
/// @param deflection  mm
FaceTriangles mesh_faces(std::span<const TopoDS_Face> faces, double deflection, double angle, const Progress& progress);

} // namespace spia

#pragma once
#include <Eigen/Core>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/exchange/cad/read_cad.h"

namespace spia {

/// Faces that share an edge wherever they meet.
struct SewnFaces {
    std::vector<TopoDS_Face> face;
    std::vector<int> number;                      ///< per face: which of the faces given it came
                                                  ///< from
    std::vector<std::array<int, 2>> doubles = {}; ///< faces given that were left out, each with the
                                                  ///< one on which it lies
    double tolerance = 0;                         ///< mm, with which they were sewn; 0: they were
                                                  ///< taken as they are
    double shortest_edge = 0;                     ///< mm, among edges that are more than flaws
    double half_an_edge = 0;                      ///< mm: what nearly all edges are twice as long
                                                  ///< as
    double widest_closed = 0;                     ///< mm, the widest gap that would have been
                                                  ///< closed unasked: half an edge at most
    int free_before = 0;                          ///< edges of one face only
    int free_after = 0;
    std::vector<CadGap> gaps; ///< between the two faces of an edge, the widest first
};

/// Heals faces (ShapeFix) and joins those that meet within the tolerance. Not given, it is found
/// from how far free edges are from one another (tolerance_for()), and is not above half the length
/// of nearly all edges. For .cpp files of engine/exchange that hold an OcctSession.
/// @param diagonal  of the faces, mm
SewnFaces sew(std::span<const TopoDS_Face> faces, std::optional<double> tolerance, double diagonal,
              const Progress& progress);

TopoDS_Compound compound_of(std::span<const TopoDS_Face> faces);

} // namespace spia

#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// A piece of a cut within one face, in the direction of its curve.
struct SectionPiece {
    int face = -1;
    Eigen::Vector3d from, to;                  ///< mm, on the mesh
    double from_distance = 0, to_distance = 0; ///< mm along the drawn line; a curve may run back
    double from_value = 0, to_value = 0;       ///< linear in between
    double from_arc = 0, to_arc = 0;           ///< mm along the cut, from_arc <= to_arc
    int curve = 0;                             ///< pieces with the same number hang together
};

/// Where the plane through a drawn line cuts the faces, as far as the line goes: one curve after
/// another, each along itself. The first curve begins at arc length 0; over a hole the arc goes
/// straight on; a curve above or below another one begins where that one has come as far along the
/// line.
/// @param mesh  the part, or its flat blank if the line was drawn there
/// @param value one per vertex
std::vector<SectionPiece> section(const TriMesh& mesh, const Eigen::VectorXd& value, const SectionLine& line);

/// The same cut on another shape of the same sheet: from the part to its blank, or back. Arc
/// lengths stay those of the cut.
std::vector<SectionPiece> carried(std::vector<SectionPiece> pieces, const TriMesh& from, const TriMesh& to);

/// A place on a cut.
struct SectionPlace {
    size_t piece = 0;
    double share = 0; ///< of the piece, from its beginning
};

/// At an arc length; of several curves there the first. Nothing beside the cut and over holes.
std::optional<SectionPlace> place_at(const std::vector<SectionPiece>& pieces, double arc);

} // namespace spia::viewer

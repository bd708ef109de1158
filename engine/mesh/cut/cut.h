#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Where a part that no sheet can become as it is gets cut open.
struct SeamOptions {
    enum class Mode {
        automatic, ///< along a short seam, where there has to be one
        none,      ///< nowhere
        given,     ///< along `path`, and nowhere else
        corners    ///< where a few cuts let it unroll (corner_seam.h), else as automatic
    };
    Mode mode = Mode::automatic;
    std::vector<std::vector<int>> path = {}; ///< vertices; from each to the next along the shortest
                                             ///< way of edges

    friend bool operator==(const SeamOptions&, const SeamOptions&) = default;
};

/// What kind of surface a mesh is.
struct SurfaceType {
    int components = 0;
    int loops = 0; ///< of the boundary
    int genus = 0; ///< handles, all components together

    bool sheet() const { return components == 1 && loops > 0 && genus == 0; }
};
SurfaceType surface_type(const TriMesh& part);

/// A part cut open. The faces keep their numbers; copies of a vertex follow their original.
struct CutPart {
    TriMesh mesh;
    std::vector<int> source;            ///< per vertex of mesh its number in the part; never
                                        ///< decreases
    std::vector<std::vector<int>> seam; ///< vertices of the part, path by path; a closed path ends
                                        ///< where it begins
    double length = 0;                  ///< mm, of the seam
    std::string why;                    ///< in words
};

/// Doubles the vertices along edges, so that the faces beside them part. Where paths meet there are
/// as many copies as pieces of the surface around the vertex. @param edges pairs of vertices;
/// @throws InputError if one is no edge
CutPart cut_along(const TriMesh& part, const std::vector<std::array<int, 2>>& edges);

/// Cuts a part so that it is a sheet, a disk with or without holes, that can be laid flat:
/// - handles along a short cut graph (handle_cut.h);
/// - a closed part along the shortest way between two of its points that are farthest apart;
/// - a tube, whose ends would have to become the two edges of a flat ring, from one end to the
///   other along the shortest way: where the ring would need scales apart by more than a factor of
///   two, and the fan less than half of that in logarithms (ring_strain.h). Loops shorter than a
///   quarter of the one looked at do not count as ends; windows, whose edge turns by nearly a full
///   turn as in a flat sheet, are looked at last;
/// - a bottle, whose mouth is less than a quarter as long as the longest line around it, from the
///   mouth to its farthest point.
/// @param part one component, manifold, two-sided
/// A given seam may leave a tube or a bottle; the words of the result say so.
/// @returns without a seam (source counts 0, 1, 2, ...) if nothing had to be cut
/// @throws InputError if a given seam is no way over the part, or leaves what cannot be laid flat
CutPart cut_open(const TriMesh& part, const SeamOptions& options = {});

/// Whether a closed part looks like a sheet with both its skins: twice its volume over its area,
/// about its thickness, is below a fortieth of the side of a square of half the area.
bool has_both_skins(const TriMesh& part);

} // namespace spia

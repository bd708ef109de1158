#pragma once
#include "engine/exchange/deck/shell_mesh.h"
#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// A part as the shells of its deck: their ids, parts, corners and places are those of the deck, in
/// its unit, whatever was welded, turned, split or cut open for the solver. A part of another kind
/// is its triangles, numbered from 1.
struct PartShells {
    ShellMesh mesh;
    std::vector<int> first;                       ///< #E + 1; element e became triangles first[e]
                                                  ///< to first[e + 1] - 1 of the part
    std::vector<int> file_node;                   ///< per node of mesh its vertex of the file
    std::vector<std::array<int, 4>> place;        ///< per element its corners among the vertices of
                                                  ///< the part; all -1 if it has been torn by a
                                                  ///< seam, or has lost a corner to a repair
    std::int64_t last_node = 0, last_element = 0; ///< greatest ids of the whole deck
};

/// The vertex of the file that stands for one at its place, where such were joined.
int stands_for(const PartFile& part, int file_vertex);

/// Elements of which the doctor left no triangle (duplicates, other pieces, no area) are left out;
/// a note says so.
/// @param unit  of the mesh, if the part is not from a deck
/// @throws InputError if an id stands for several nodes or elements, or no element of the deck is
/// left
PartShells part_shells(const PartFile& part, LengthUnit unit = LengthUnit::mm);

/// What forming did to the elements of a deck.
struct ElementFields {
    Eigen::VectorXd thickness; ///< #E, in the unit of the mesh, mean over the area of the formed
                               ///< part
    Eigen::VectorXd thinning, strain_major, strain_minor, strain_equivalent; ///< #E, means as well
    Eigen::Matrix4Xd corner_thickness; ///< 4 by #E, at the corners; see element_fields()
    Eigen::Matrix<double, 6, Eigen::Dynamic>
        strain;           ///< 6 by #E: xx, yy, zz, xy, yz, zx in space, xy half the shear angle
    Eigen::VectorXd area; ///< #E, of the formed part, in the square of the unit
};

/// Thickness at a node is h0 (1 - thinning) with the mean of 1 - thinning over the elements around
/// it, weighted by the volume each has at the node. So the mean over the corners times area adds up
/// to the volume of the elements exactly, and the step between the sheets of a tailored blank stays
/// one.
/// @param face  of the triangles of the part
/// @throws InputError if fields do not match the part
ElementFields element_fields(const PartShells& shells, const TriMesh& part, const SheetFields& face);

/// A blank as a mesh, and which node of the part each of its nodes is.
struct BlankShells {
    ShellMesh mesh;
    std::vector<std::int64_t> part_node; ///< per node its id in the part: its own but of copies
                                         ///< along a seam
};

/// The blank in the plane z = 0 with the ids of the part. Where the part was cut open, nodes get
/// copies with ids above all of the deck; a quad that a seam goes through becomes triangles, the
/// first with its id.
/// @param face  gives the thickness of the flat sheet
/// @throws InputError if blank or fields do not match the part
BlankShells blank_shells(const PartFile& part, const PartShells& shells, const Blank& blank, const SheetFields& face);

} // namespace spia

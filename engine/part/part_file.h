#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/solid/marks/mark_line.h"
#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_curve.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/part/cad_tree.h"
#include "engine/part/deck_part.h"
#include "engine/part/remesh_part.h"

namespace spia {

/// What a part from a solver deck is called there. Its faces are the shells that were chosen, its
/// vertices their nodes, both counted from 0 in the order of the deck: `source_face` and
/// `source_vertex` lead to them.
struct DeckOrigin {
    std::vector<int> element;                     ///< per face of the file: its index among all
                                                  ///< shells of the deck
    std::vector<std::int64_t> element_id;         ///< per face of the file
    std::vector<std::int64_t> node_id;            ///< per vertex of the file
    std::vector<std::array<int, 4>> corner;       ///< per face of the file: vertices of the file;
                                                  ///< last -1 in a triangle
    std::vector<int> part_of;                     ///< per face of the file: index into parts
    std::vector<Eigen::Vector3d> position;        ///< per vertex of the file, in the unit of the
                                                  ///< deck
    std::int64_t last_node = 0, last_element = 0; ///< greatest ids of the whole deck
    std::vector<DeckPart> parts;                  ///< all of the deck; thicknesses in its unit
    std::vector<std::string> sets;                ///< names of element sets that can be chosen as
                                                  ///< well
    bool unit_stated = false;                     ///< the deck says its unit of length
    bool copies = false;                          ///< as of Deck
};

/// What a part from a CAD file comes from. Its "faces of the file" are triangles, made from the CAD
/// faces in their order.
struct CadOrigin {
    std::vector<int> face;                   ///< per face of the file: the CAD face it lies on,
                                             ///< from 0 in the order of the file
    int faces = 0;                           ///< CAD faces in the file
    double deflection = 0;                   ///< mm, largest distance between triangle and CAD face
                                             ///< that was asked for
    double sewing_tolerance = 0;             ///< mm; 0: nothing had to be sewn
    bool unit_stated = false;                ///< by the file; a unit given for it is refused
    CadTree tree = {};                       ///< what the file holds
    std::vector<StatedSurface> surface = {}; ///< per CAD face of the file: the plane or cylinder it
                                             ///< lies on
    /// lines and circles of the edges; vertices are those of the file, also once it is remeshed
    StatedCurves curves = {};
};

/// What a part that is one surface of a solid of sheet comes from.
struct SolidOrigin {
    Skin skin = Skin::middle;                        ///< the surface that was taken
    double thickness = 0, least = 0, most = 0;       ///< mm, as in ThinSolid
    double outer_area = 0, inner_area = 0, area = 0; ///< mm2, of both skins and of what was taken
    double rim_area = 0;                             ///< mm2, of the faces across the thickness
    double volume = 0;                               ///< mm3
    int faces = 0, outer_faces = 0, inner_faces = 0; ///< CAD faces, else faces of the file; all and
                                                     ///< of the skins
    bool open = false;                               ///< faces are missing
    /// outlines of marks that were passed over and circles of sunk holes, on the surface that was
    /// taken
    std::vector<MarkLine> marks = {};
    SheetSide side = SheetSide::outer; ///< the skin whose faces the mesh has
    /// per face of the file: the cylinder that was measured on it; empty: none was, or a CAD file
    /// states them
    std::vector<StatedSurface> surface = {};
    /// mm, by how much its corners may lie off their places (coordinate_rounding()), where
    /// cylinders were searched on them; none: a CAD file states them
    std::optional<double> rounding = {};
};

/// What a file holds, and what was done to it.
struct PartFile {
    TriMesh mesh;                   ///< mm, of a solid one surface of it; vertices and faces in the
                                    ///< order of the file
    DoctorReport doctor;            ///< faults and repairs; it names vertices and faces as in the
                                    ///< file, counted from 0
    std::vector<int> source_vertex; ///< per vertex of mesh its number in the file; never decreases,
                                    ///< and repeats where touching fans were separated and along
                                    ///< the seam
    std::vector<int> source_face;   ///< per triangle of mesh its face in the file; never decreases
    std::vector<int> same_as = {};  ///< per vertex of the file the one that stands for it: itself
                                    ///< unless it was joined
    int file_vertices = 0;          ///< STL: different points, in the order of their first corner
    int file_faces = 0;
    std::string format; ///< e.g. "STL (binary)"
    LengthUnit unit = LengthUnit::mm;
    std::vector<std::string> notes; ///< what was left out, or deserves a word
    std::vector<std::string> doubts =
        {}; ///< those of the notes after which some of the part may be missing, or its mesh is not
            ///< as was asked for
    std::vector<std::vector<int>> seam = {}; ///< rows of vertices of the file along which the part
                                             ///< was cut open
    double seam_length = 0;                  ///< mm
    std::optional<double> thickness_mm = {}; ///< of the sheet: decks say it, in solids it is found
    std::string material = {};               ///< what the file calls it; empty: nothing
    std::optional<DeckOrigin> deck = {};     ///< of solver decks
    std::optional<CadOrigin> cad = {};       ///< of CAD files
    std::optional<SolidOrigin> solid = {};   ///< of solids of sheet
    /// per triangle, of CAD files: corner_normals(); empty: none are known
    std::vector<Eigen::Matrix3f> corner_normal = {};
    std::optional<Remeshed> remeshed = {}; ///< if it was asked for: mesh, source_vertex and
                                           ///< source_face are new
};

/// Whether the file says its unit of length.
inline bool unit_is_stated(const PartFile& part)
{
    return (part.cad && part.cad->unit_stated) || (part.deck && part.deck->unit_stated);
}

/// What is told of a part, beside what the doctor finds.
struct Remarks {
    std::vector<std::string> notes, doubts; ///< as those of a PartFile

    /// A note of something that may not be as it was meant.
    void doubt(std::string text)
    {
        notes.push_back(text);
        doubts.push_back(std::move(text));
    }
    void add(const Remarks& more)
    {
        notes.insert(notes.end(), more.notes.begin(), more.notes.end());
        doubts.insert(doubts.end(), more.doubts.begin(), more.doubts.end());
    }
};

inline void add(PartFile& part, const Remarks& remarks)
{
    part.notes.insert(part.notes.end(), remarks.notes.begin(), remarks.notes.end());
    part.doubts.insert(part.doubts.end(), remarks.doubts.begin(), remarks.doubts.end());
}

} // namespace spia

#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/core/progress.h"
#include "engine/exchange/file_format.h"
#include "engine/mesh/solid/stated_curve.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/soup.h"
#include "engine/part/cad_options.h"
#include "engine/part/cad_tree.h"

namespace spia {

/// Two faces that do not quite meet.
struct CadGap {
    double width = 0;      ///< mm, the widest of nine places along the edge
    Eigen::Vector3d place; ///< of it, mm
    std::array<int, 2> face;
};

/// A face that is narrower than gaps that are closed, and has no triangles.
struct CadSliver {
    double width = 0;      ///< mm
    Eigen::Vector3d place; ///< where it is widest, mm
    int face = -1;
};

/// Faces of a CAD file as one triangle mesh. Faces are numbered as the file has them, from 0.
struct CadContent {
    PolygonSoup soup;      ///< triangles, mm; neighbours share the vertices of their common edge
    std::vector<int> face; ///< per triangle the face it lies on
    std::vector<std::array<Eigen::Vector3f, 3>> normal; ///< per triangle at its corners, as
                                                        ///< mesh_faces() has it
    int faces = 0;                                      ///< of the file
    int taken = 0;                                      ///< of them
    CadTree tree;                                       ///< what the file holds
    bool solid = false;                                 ///< some of the faces taken are of a solid
    std::string format;                                 ///< e.g. "STEP"
    std::string unit;                                   ///< of the file, e.g. "INCH"; lengths here
                                                        ///< are mm; empty: the format has none
                                                        ///< (BREP)
    /// mm, largest distance between triangle and face that was asked for
    double deflection = 0;
    double sewing_tolerance = 0; ///< mm; 0: the faces were taken as they are
    /// mm: what nearly all edges are twice as long as; gaps are closed unasked up to it
    double half_an_edge = 0;
    double shortest_edge = 0; ///< mm
    int free_before = 0;      ///< edges of one face only, before sewing
    int free_after = 0;       ///< and after it
    /// at edges that two faces share now, the widest first
    std::vector<CadGap> gaps;
    /// labels of faces and bodies of the file that could not be made, and may be missing; without
    /// numbers
    std::vector<std::string> lost;
    std::vector<std::string> lost_elsewhere; ///< those of other bodies than were chosen
    /// labels of damaged entities that no shape needs
    std::vector<std::string> aside;
    /// faces without triangles, but for slivers
    std::vector<int> unmeshed;
    std::vector<CadSliver> slivers; ///< that were closed
    bool unmeshed_left_out = false; ///< as was asked for
    /// faces that were left out, each with the one on which it lies
    std::vector<std::array<int, 2>> doubled;
    /// per face of the file: what it lies on; of faces not taken another kind
    std::vector<StatedSurface> surface;
    /// lines and circles of the edges of what was taken; vertices of the soup
    StatedCurves curves;
    /// faces at edges of three or more triangles, once points at one place are one
    std::vector<int> overlapping;
};

/// Those that read_cad() reads.
std::vector<FileFormat> cad_file_formats();

/// Reads, heals, sews and meshes the faces of a STEP, IGES or BREP file through OpenCASCADE, one
/// file at a time. That is done in a process of its own (in_child()), for OpenCASCADE crashes and
/// hangs on some damaged files.
/// @param wanted  faces to take, as chosen_faces() has it; empty: all
/// @param unit  of a BREP file (not given: mm); the others have their unit, and it is obeyed
/// @throws InputError the file is damaged or holds no face, a face wanted does not exist, an option
/// makes no sense, a
///         unit is given and the file has its own
CadContent read_cad(const std::filesystem::path& path, const CadOptions& options = {},
                    std::span<const std::string> wanted = {}, std::optional<LengthUnit> unit = {},
                    const Progress& progress = {});

/// As read_cad() does, with its defaults, but in this process: damage that makes OpenCASCADE crash
/// or hang does so here. For a search through many files, within a child process for all of them
/// (tests/fuzz).
/// @throws InputError  the file is damaged or holds no face
CadContent read_cad_unguarded(const std::filesystem::path& path);

/// The faces of such a file as they are, neither healed nor sewn, in triangles that are coarse:
/// enough to show what there is. It has soup, face, faces, tree, format and unit.
/// @throws InputError  the file is damaged or holds no face
CadContent preview_cad(const std::filesystem::path& path, const Progress& progress = {});

} // namespace spia

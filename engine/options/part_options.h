#pragma once
#include "engine/options/option.h"

/// How the file of a part is read and made a sheet.
namespace spia::option {

inline constexpr Option part{
    .name = "part",
    .key = "parts",
    .value = "ID|NAME",
    .help = "of a solver deck: the part, property or element set to take, by id or name; of a CAD file: a body or "
            "assembly by its number or name as `spia info` lists them, e.g. body:2, or faces by number from 0, e.g. 7 "
            "or 10-19 (default: all)",
    .label = "Import options...",
    .place = "the step Part"};

inline constexpr Choice units[] = {{"mm"}, {"cm"}, {"m"}, {"inch"}};
inline constexpr Option unit{.name = "unit",
                             .choices = units,
                             .help = "length unit of the file (default mm, glTF: m)",
                             .place = "the unit in the step Part"};

// mm
inline constexpr Range gap_width{0, 1e3}, chord_height{1e-6, 1e3};

inline constexpr Option sewing{.name = "sewing",
                               .key = "sewing_mm",
                               .value = "MM",
                               .range = gap_width,
                               .help = "of a CAD file: gaps between faces up to this are closed, 0: none (default: "
                                       "found from the gaps)",
                               .label = "Close gaps up to",
                               .place = "\"Import options...\""};
inline constexpr Option deflection{
    .name = "deflection",
    .key = "deflection_mm",
    .value = "MM",
    .range = chord_height,
    .help = "of a CAD file: largest distance between triangles and faces (default: 1/2000 of the diagonal of a box "
            "around the faces and their control points, 0.005 along long borders that are not arcs)",
    .label = "Chord height",
    .place = "\"Import options...\""};
inline constexpr Option chord_angle{.name = "angle",
                                    .value = "DEG",
                                    .help = "of a CAD file: largest angle between the tangents at both ends of a chord "
                                            "(default: 20; 2 on conical sheet and along long borders that are not "
                                            "arcs)"};
inline constexpr Option skip_bad_faces{
    .name = "skip-bad-faces",
    .key = "leave_out_bad_faces",
    .help = "of a CAD file: leave out faces that cannot be read or meshed, and take the rest",
    .label = "Leave out faces that cannot be meshed",
    .place = "\"Import options...\""};

inline constexpr Choice skins_of_solid[] = {{"outer"}, {"inner"}, {"middle"}};
inline constexpr Option skin{.name = "skin",
                             .key = "skin",
                             .choices = skins_of_solid,
                             .help =
                                 "of a sheet-metal solid: the surface that is laid flat, outer (outside of its bends), "
                                 "inner or middle (default: middle)",
                             .label = "Skin",
                             .place = "the step Part"};

inline constexpr Choice gap_to_weld[] = {{"[MM]", {}, {}, "\"Close the crack\" in the step Part"}};
inline constexpr Option weld{
    .name = "weld",
    .key = "weld",
    .value = "[MM]",
    .range = gap_width,
    .choices = gap_to_weld,
    .help = "join coincident vertices (always done for STL and glTF), with a number also across gaps up to it; `spia "
            "info` proposes one where it finds a crack",
    .label = "Weld vertices",
    .place = "the step Part"};
inline constexpr Option keep_largest{.name = "keep-largest",
                                     .key = "keep_largest",
                                     .help = "leave out all but the largest piece, and ribs on edges of three faces",
                                     .label = "Keep the largest piece",
                                     .place = "the step Part"};

inline constexpr Choice seams[] = {
    {"auto"}, {"none"}, {"corners", {}, {}, "\"Cut the corners\" in the step Part"}, {"FILE"}};
inline constexpr Option seam{
    .name = "seam",
    .value = "auto|none|corners|FILE",
    .choices = seams,
    .help = "where a closed part, a tube or a part with handles is cut open: auto (a short seam), none, corners (where "
            "a few cuts let it unroll), or a file {\"seam\": [[a, b, ...]]} of vertices, numbers as in the part's "
            "file, from 0",
    .place = "a seam drawn with the tool Line"};

inline constexpr Option remesh{
    .name = "remesh",
    .help = "replace the triangles by well-shaped ones that stay within a tolerance; deviations are those from the "
            "original",
    .label = "Remesh",
    .place = "the step Part"};
inline constexpr Option no_remesh{
    .name = "no-remesh",
    .key = "keep_triangles",
    .help = "keep the triangles of CAD faces also where they are needles on a surface that does not unroll; otherwise "
            "such parts are remeshed",
    .label = "Remesh",
    .place = "the step Part"};
inline constexpr Option remesh_size{
    .name = "remesh-size",
    .key = "size",
    .value = "MM",
    .range = Range{1e-9, 1e9},
    .help = "edge length of the triangles where nothing requires a shorter one (default: the part's median edge, from "
            "1/250 to 1/40 of its diagonal)",
    .label = "Edges",
    .place = "the step Part"};
inline constexpr Option remesh_tolerance{
    .name = "remesh-tolerance",
    .key = "tolerance",
    .value = "MM",
    .range = Range{1e-9, 1e9},
    .help = "largest distance of both meshes anywhere (default: 1/1000 of the part's diagonal)",
    .label = "Tolerance",
    .place = "the step Part"};
inline constexpr Option least_angle{
    .name = "min-angle",
    .value = "DEG",
    .help = "quality target: triangles with smaller angles are a shortcoming, the worst is named"};
inline constexpr Option edge_ratio{.name = "max-edge-ratio",
                                   .value = "RATIO",
                                   .help = "quality target for the longest edge of a triangle over its shortest"};

/// All of this file.
inline constexpr const Option* of_parts[] = {
    &part,         &unit, &sewing, &deflection, &chord_angle, &skip_bad_faces,   &skin,        &weld,
    &keep_largest, &seam, &remesh, &no_remesh,  &remesh_size, &remesh_tolerance, &least_angle, &edge_ratio};

} // namespace spia::option

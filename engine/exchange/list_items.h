#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/exchange/part_formats.h"
#include "engine/mesh/soup.h"

namespace spia {

/// What can be chosen of a file before it is read as a part: an assembly, a body or loose faces of
/// a CAD file; a part, property or element set of a deck. A mesh file is one item.
struct FileItem {
    std::string choice;                   ///< what ReadOptions::parts takes for it, e.g. "3",
                                          ///< "Hood", "body:2"; empty: the file is whole
    std::string name;                     ///< in the file; empty: none
    std::string kind;                     ///< for people: "assembly", "solid", "sheet body", "loose
                                          ///< faces", "part", "element set", "mesh"
    int parent = -1;                      ///< index of the item that holds it; -1: none
    int faces = 0;                        ///< CAD faces, shells with all their nodes, or polygons,
                                          ///< in it and in what it holds
    double area = 0;                      ///< of the preview, in its unit squared, in it and in
                                          ///< what it holds
    std::optional<double> thickness = {}; ///< in the unit of the file
    std::string material = {};
    bool solid = false; ///< of a CAD file: a filled body; one of its skins would be taken
};

/// What a file holds, at a glance.
struct FileItems {
    FileKind kind = FileKind::mesh;
    std::string format;         ///< e.g. "STEP"
    std::string unit;           ///< of length that the file names, as it writes it; empty: none
    std::vector<FileItem> item; ///< holders before what they hold; sets, which may overlap, last
    PolygonSoup preview;        ///< all faces, coarse for CAD; CAD files: mm, else in the unit of
                                ///< the file
    std::vector<int> item_of;   ///< per polygon of the preview: the innermost item it belongs to;
                                ///< -1: none
    std::vector<int> face_of;   ///< per polygon of the preview: its CAD face, shell or polygon of
                                ///< the file, from 0
    std::vector<std::string> notes;
};

/// Lists what can be chosen of a file that read_part() reads; nothing is healed, sewn or examined.
/// @throws InputError  the file is damaged or of no known kind
FileItems list_items(const std::filesystem::path& path, const Progress& progress = {});

} // namespace spia

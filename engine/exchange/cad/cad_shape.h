#pragma once
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/exchange/cad/cad_lost.h"
#include "engine/exchange/file_format.h"
#include "engine/part/cad_tree.h"

namespace spia {

/// A CAD file as OpenCASCADE gives it, in mm.
struct CadShape {
    TopoDS_Shape shape;
    std::vector<TopoDS_Face> face;  ///< by its number: the order of the file
    CadTree tree;                   ///< assemblies and bodies with these faces
    std::vector<LostShape> lost;    ///< what could not be made
    std::vector<std::string> aside; ///< labels of damaged entities that no shape needs
    std::string format;             ///< e.g. "STEP"
    std::string unit;               ///< of the file, e.g. "INCH"; empty: the format has none (BREP)
};

/// Those that read_cad_shape() reads.
std::vector<FileFormat> cad_shape_formats();

/// For .cpp files of engine/exchange that hold an OcctSession.
/// Its format is known by the ending, in upper or lower case.
/// @throws InputError  the file is damaged or holds no face
CadShape read_cad_shape(const std::filesystem::path& path, const Progress& progress);

} // namespace spia

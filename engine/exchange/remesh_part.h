#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/remesh/remesh.h"

namespace spia {

struct PartFile;

/// What a part was before it was remeshed, and what that did.
struct Remeshed {
    std::shared_ptr<const TriMesh> original; ///< the part as it was read, mm; deviations are measured from it
    std::vector<int> original_vertex;        ///< per vertex of it its number in the file; never decreases
    TriangleQuality before, after;
    double size = 0, tolerance = 0; ///< mm
    double distance = 0;            ///< mm; no place of either mesh is farther from the other one
    int lines = 0, corners = 0;     ///< that were kept
    double seconds = 0;
};

/// Puts a remeshed mesh in the place of the part's own, which stays in PartFile::remeshed. Its vertices and faces are numbered like those of
/// the file that they are nearest to; borders between parts of a deck are kept as lines.
/// @throws InputError  as remesh() does
void remesh_part(PartFile& part, const RemeshOptions& options, const Progress& progress = {});

/// The vertices of the mesh that are called by a number of the file; of a remeshed part those nearest to where it was. Empty if there is no
/// such number.
std::vector<int> vertices_called(const PartFile& part, int number);

/// "remeshed from 1270 to 31161 triangles: ..."
std::string in_words(const Remeshed& remeshed);

} // namespace spia

#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/remesh/remesh.h"

namespace spia {

struct PartFile;

/// What a part was before it was remeshed, and what that did.
struct Remeshed {
    std::shared_ptr<const TriMesh> original; ///< the part as it was read, mm; deviations are
                                             ///< measured from it
    std::vector<int> original_vertex;        ///< per vertex of it its number in the file; never
                                             ///< decreases
    std::vector<int> original_face;          ///< per triangle of it its face in the file; never
                                             ///< decreases
    TriangleQuality before, after;
    double size = 0, tolerance = 0; ///< mm
    double distance = 0;            ///< mm; no place of either mesh is farther from the other one
    int lines = 0, corners = 0;     ///< that were kept
    double seconds = 0;
};

/// The part with a remeshed mesh in the place of its own, which stays in PartFile::remeshed. Its
/// vertices and faces are called by the numbers of the file that they are nearest to, so several
/// can have the same one and others of the file are not there any more; borders between parts of a
/// deck are kept as lines. The triangles of a CAD part are nobody's but ours: the new ones take
/// their place, with numbers of their own, and CadOrigin::face says on which CAD face each lies.
/// @throws InputError  as remesh() does
PartFile remesh_part(PartFile part, const RemeshOptions& options, const Progress& progress = {});

/// The part of a deck as it was before it was remeshed.
PartFile as_read(const PartFile& part);

/// Whether the part had a face with this number of the file when it was read.
bool has_face(const PartFile& part, int number);

/// Of each triangle of the mesh 1 where it is on one of these faces of the file. Faces that have
/// become smaller than the triangles have them if they hold their middles; where none is held,
/// those nearest to the middles of the faces.
/// @pre has_face() of each
std::vector<char> faces_called(const PartFile& part, std::span<const int> numbers);

/// "remeshed from 1270 to 31161 triangles: ..."
std::string describe(const Remeshed& remeshed);

} // namespace spia

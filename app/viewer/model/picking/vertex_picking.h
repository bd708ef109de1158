#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/picking/camera.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/tri_mesh.h"

/// Which vertex a view shows at a pixel, and what can be done with picked ones. Mesh, picker and
/// camera as in picking.h.
namespace spia::viewer {

/// The boundary of a mesh, its outline and its holes.
struct BoundaryVertices {
    std::vector<int> vertex; ///< ascending
    std::vector<int> face;   ///< per vertex one of its faces
    std::vector<char> sharp; ///< per vertex 1 where the boundary turns sharply, to either side or
                             ///< out of its plane
};

/// Where edges with three faces leave no closed loops nothing counts as sharp; reading such a part
/// has told about it.
BoundaryVertices boundary_vertices(const TriMesh& mesh);

/// The vertex in sight that is nearest to the pixel, at most pick.reach from it. Where several
/// stand behind each other it is the one in front.
std::optional<int> vertex_at(const PickVertex& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                             const std::optional<HalfSpace>& kept = {});

/// Likewise of the boundary. A sharp turn within reach goes before all others.
/// @param boundary of the mesh
std::optional<int> boundary_vertex_at(const PickVertex& pick, const Camera& camera, const TriMesh& mesh,
                                      const BoundaryVertices& boundary, const RayPicker& picker,
                                      const std::optional<HalfSpace>& kept = {});

/// Four vertices as corners of a grid, in their order along the outline from the first of them on.
/// @param outline vertices of the outer boundary in their order
/// @throws InputError if they are not four, or one is not on the outline; names it as in the file
std::array<int, 4> corners_of(const std::vector<int>& vertices, const std::vector<int>& outline,
                              const std::vector<int>& file_number);

/// The straight distance of two vertices.
struct VertexDistance {
    double on_part = 0;             ///< mm
    std::optional<double> on_blank; ///< mm; not before there is a blank
};

/// Nothing unless exactly two vertices of the part are picked.
std::optional<VertexDistance> distance_of_picked(const Document& document);

/// The vertices of the mesh that corners are called by in the file; nothing if one is of another
/// part.
std::optional<std::array<int, 4>> corners_called(const PartFile& part, const std::array<int, 4>& number);

} // namespace spia::viewer

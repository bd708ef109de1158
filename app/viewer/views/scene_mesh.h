#pragma once
#include <memory>

#include "app/viewer/model/document/scene.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// Edges with a larger angle between the normals of their faces are sharp.
inline constexpr double sharp_angle = 30 * EIGEN_PI / 180;

/// Rows of sharp edges that are shorter than this share of the diagonal are not drawn: on a coarse
/// fillet they are no more than a few triangles that happen to meet at such an angle.
inline constexpr double shortest_feature = 0.06;

/// A mesh as it is drawn. Its first vertices and all its faces are those of the mesh; along sharp
/// edges vertices are repeated, one for each smooth side, so that the light shows the edge. Takes
/// time in proportion to the number of triangles.
SceneMesh scene_mesh(const TriMesh& mesh);

/// The same triangles laid out in the plane z = 0, edges as in the scene mesh of the part. No
/// vertex is repeated.
/// @param part_scene  scene_mesh(part); @param position 2 by #V of the part, mm
SceneMesh flat_scene_mesh(const TriMesh& part, const SceneMesh& part_scene, const Eigen::Matrix2Xd& position);

/// The edges of a mesh that belong to one face only. 2 by #edges, vertex indices; the face lies on
/// their left.
Eigen::Matrix<uint32_t, 2, Eigen::Dynamic> boundary_edges(const TriMesh& mesh);

/// A field for a scene mesh. @param values one per face, or per vertex of the mesh it was made from
std::shared_ptr<const SceneField> scene_field(const SceneMesh& mesh, const Eigen::VectorXd& values, bool per_face);

/// Lines between pairs of places, mm. @param end 2 by #lines, columns of position
template <class Ends> std::shared_ptr<SceneLines> scene_lines(const Eigen::Matrix3Xd& position, const Ends& end)
{
    auto lines = std::make_shared<SceneLines>();
    if (end.size() > 0)
        lines->origin = position.col(Eigen::Index(end(0, 0)));
    lines->point.resize(3, end.size());
    for (Eigen::Index i = 0; i < end.size(); ++i)
        lines->point.col(i) = (position.col(Eigen::Index(end(i % 2, i / 2))) - lines->origin).template cast<float>();
    return lines;
}

/// A point per column, mm.
std::shared_ptr<ScenePoints> scene_points(const Eigen::Matrix3Xd& position);

} // namespace spia::viewer

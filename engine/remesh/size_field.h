#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/mesh/edge_graph.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

struct BoxTree;

/// How long the edges of a remesh are to be where something of the given mesh asks for it.
struct EdgeSizes {
    struct Place {
        Eigen::Vector3d position;
        double size; ///< mm
    };
    Eigen::VectorXd at_vertex;    ///< #V, mm
    Eigen::VectorXd along_edge;   ///< #E of edge_graph(), mm, all along it, as at a ridge between two strips of
                                  ///< a bend; infinite: nothing asks there
    std::vector<Place> elsewhere; ///< within faces
    double most = 0;              ///< mm, where nothing asks for less
    double growth = 0;            ///< of the size per mm of way from where something asks
};

/// The size at every place of the given mesh. Within a face with short edges it is between those at
/// its corners. A long one, as a needle across a flat face with a small hole at either end, is not
/// known by its corners: away from all that asks for less edges become longer there.
class SizeField {
public:
    /// What a long face is known by.
    enum class LongFaces { grow, between_corners };

    /// @param mesh  it has to stay
    SizeField(const TriMesh& mesh, EdgeSizes sizes, LongFaces long_faces = LongFaces::grow);
    ~SizeField();
    SizeField(SizeField&&) noexcept;
    SizeField& operator=(SizeField&&) noexcept;

    const EdgeSizes& sizes() const { return sizes_; }
    bool grows_in_long_faces() const { return long_faces_ == LongFaces::grow; }
    double at_vertex(int v) const { return sizes_.at_vertex[v]; }
    /// mm, at a place of a face
    double in_face(int face, const Eigen::Vector3d& barycentric) const;
    /// mm, at a place of a segment between two vertices
    /// @param share  of the way from a to b
    double between(int a, int b, double share) const;
    /// Of equilateral triangles that the sizes ask for.
    double triangles() const;

private:
    double beyond(const Eigen::Vector3d& place, double known) const;

    const TriMesh* mesh_;
    EdgeSizes sizes_;
    LongFaces long_faces_;
    std::unique_ptr<const BoxTree> tree_; ///< over vertices, edges and places that ask for less than
                                          ///< the most, as triangles that are segments; null: none
    std::vector<double> asked_;           ///< mm, by each of them
    std::vector<double> least_;           ///< mm, of those below each node of the tree
};

} // namespace spia

#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/remesh/kept_lines.h"

namespace spia {

/// A mesh on its way from the given triangles to new ones. Vertices keep on the given mesh, kept lines stay where they are, and no change
/// turns a face over or puts an edge off the given mesh: what would do so is not done.
class EvolvingMesh {
public:
    using Vector = Eigen::Vector3d;
    using Vertex = OpenMesh::VertexHandle;
    using Edge = OpenMesh::EdgeHandle;
    using Halfedge = OpenMesh::HalfedgeHandle;
    using Face = OpenMesh::FaceHandle;
    using Corners = Eigen::Matrix3d;    ///< one per column
    using Quad = std::array<Vertex, 4>; ///< an edge from 0 to 1 between the triangles 0 1 2 and 1 0 3

    /// Divides the kept lines (divide_line()).
    /// @param size     of edges at each vertex, mm
    /// @param sagitta  mm, that the middle of a new edge may be off the given mesh
    /// @param gap      border_clearance(): chords along the boundary take a third of it at most, so that banks do not cross
    EvolvingMesh(const TriMesh& original, const KeptLines& lines, const Eigen::VectorXd& size,
                 const ClosestPointSearch& search, double sagitta, const Eigen::VectorXd& gap,
                 const Progress& progress);

    /// @name What it is. Numbers of what has been deleted stay until the end.
    ///@{
    const HalfedgeMesh& mesh() const { return mesh_; }
    Vector at(Vertex v) const;
    double size(Vertex v) const { return size_[size_t(v.idx())]; } ///< of edges there, mm
    double length(Vertex a, Vertex b) const { return (at(a) - at(b)).norm(); }
    bool on_line(Vertex v) const { return on_line_[size_t(v.idx())]; }
    bool on_line(Edge e) const { return line_edge_[size_t(e.idx())]; }
    std::pair<Vertex, Vertex> ends(Edge e) const;
    Corners triangle(Face f) const;
    Corners triangle(Vertex a, Vertex b, Vertex c) const;
    double worst_angle(const Quad& quad) const; ///< radians, of both triangles
    double worst_around(Vertex v) const;        ///< radians
    static Vector area_of(const Corners& t) { return (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)) / 2; }
    ///@}

    /// If the edge may be flipped at all.
    std::optional<Quad> quad(Edge edge) const;

    /// In its middle, on the given mesh.
    void split(Edge edge);
    /// Pulls either end into the other one, but none off a line, and makes no edge longer than 4/3 of its size.
    bool collapse_if_sound(Edge edge);
    /// If both new triangles have larger angles than that, radians.
    bool flip_if_sound(Edge edge, const Quad& quad, double worst);
    /// Puts the vertex on the given mesh near the place, unless a face turns over or the least angle falls below
    /// what it is and below good_enough, radians.
    bool move(Vertex v, const Vector& place, const Vector& normal, double good_enough);
    /// Those between the pieces of lines that are longer than they were.
    void drop_line_vertices();

    TriMesh finished();

    static constexpr double too_long = 4.0 / 3,
                            too_short = 4.0 / 5; ///< of the size: where a split or collapse does not go farther from it

private:
    struct Placed {
        Vector position;
        double size; ///< mm
        int face;    ///< of the given mesh
    };

    /// @param way  mm, to any place of the given mesh: nothing farther away is looked for
    Placed place(const Vector& point, double way) const;
    bool near(const Vector& a, const Vector& b) const;
    Edge edge_between(Vertex a, Vertex b) const { return mesh_.edge_handle(mesh_.find_halfedge(a, b)); }
    Vertex split(Edge edge, const Vector& position, double asked, bool line);
    void divide(const std::vector<int>& line, const Eigen::VectorXd& sagitta, const Progress& progress);
    void forget_crumb(const std::vector<int>& line);
    void drop(Vertex v);
    bool may_collapse(Halfedge h, bool inner);
    bool closes_line(Halfedge h) const;
    void collapse(Halfedge h);

    const TriMesh& original_;
    Eigen::Matrix3Xd original_normal_;
    const Eigen::VectorXd& original_size_;
    const ClosestPointSearch& search_;
    double sagitta_;
    HalfedgeMesh mesh_;
    std::vector<char> line_edge_;      ///< per edge
    std::vector<char> on_line_, drop_; ///< per vertex
    std::vector<double> size_;         ///< per vertex, mm
};

} // namespace spia

#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/halfedges.h"
#include "engine/remesh/kept_lines.h"
#include "engine/remesh/size_field.h"

namespace spia {

/// A mesh on its way from the given triangles to new ones. Vertices keep on the given mesh, kept
/// lines stay where they are, and no change turns a face over or puts an edge off the given mesh:
/// what would do so is not done.
class EvolvingMesh {
public:
    using Vector = Eigen::Vector3d;
    using Vertex = OpenMesh::VertexHandle;
    using Edge = OpenMesh::EdgeHandle;
    using Halfedge = OpenMesh::HalfedgeHandle;
    using Face = OpenMesh::FaceHandle;
    using Corners = Eigen::Matrix3d;    ///< one per column
    using Quad = std::array<Vertex, 4>; ///< an edge from 0 to 1 between the triangles 0 1 2 and 1 0
                                        ///< 3
    using Tick = long;                  ///< counts changes

    /// Divides the kept lines (divide_line()).
    /// @param sagitta  mm, that the middle of a new edge may be off the given mesh
    /// @param gap      border_clearance(): chords along the boundary take a third of it at most, so
    ///         that banks do not cross
    EvolvingMesh(const TriMesh& original, const KeptLines& lines, const SizeField& size,
                 const ClosestPointSearch& search, double sagitta, const Eigen::VectorXd& gap,
                 const Progress& progress);

    /// @name What it is. Numbers of what has been deleted stay until the end.
    ///@{
    const HalfedgeMesh& mesh() const { return mesh_; }
    Vector at(Vertex v) const;
    double size(Vertex v) const { return size_[size_t(v.idx())]; } ///< of edges there, mm
    double length(Vertex a, Vertex b) const { return (at(a) - at(b)).norm(); }
    bool on_line(Vertex v) const { return on_line_[size_t(v.idx())]; }
    bool on_chord(Vertex v) const { return on_chord_[size_t(v.idx())]; } ///< not on the given mesh yet
    bool on_line(Edge e) const { return line_edge_[size_t(e.idx())]; }
    std::pair<Vertex, Vertex> ends(Edge e) const;
    Corners triangle(Face f) const;
    Corners triangle(Vertex a, Vertex b, Vertex c) const;
    /// Squared cotangent of the least angle: what an angle is compared by, as it takes no root and
    /// no arc. From 1/3 up.
    static double thinness(const Corners& triangle);
    /// of that least angle, radians
    static double thinness(double angle) { return std::pow(std::tan(angle), -2); }
    /// the larger one of both
    double thinness(const Quad& quad) const;
    static Vector area_of(const Corners& t) { return (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)) / 2; }
    ///@}

    /// @name When it changed. What has been tried in vain need not be tried again before something
    /// around it is another.
    ///@{
    Tick now() const { return now_; }
    /// The last change of its place, its size, its faces or those of a neighbour.
    Tick changed(Vertex v) const { return changed_[size_t(v.idx())]; }
    Tick changed(Edge e) const;
    Tick changed(Face f) const;
    /// Whether it may be changed: all may until shorten(), then what is near to where that asked
    /// for shorter edges.
    bool open(Vertex v) const { return open_[size_t(v.idx())]; }
    bool open(Edge e) const;
    bool open(Face f) const;
    ///@}

    /// Around an edge that is neither on the boundary nor on a line.
    std::optional<Quad> quad(Edge edge) const;

    /// In its middle, on the given mesh, unless nothing would be left of a face.
    bool split(Edge edge);
    /// An edge of a kept line at the place of the line that is nearest to its middle, unless a face
    /// would turn over.
    bool split_line(Edge edge);
    /// Pulls either end into the other one, but none off a line, and makes no edge longer than 4/3
    /// of its size.
    bool collapse_if_sound(Edge edge);
    /// If both new triangles are less thin than that.
    bool flip_if_sound(Edge edge, const Quad& quad, double thin);
    /// Puts the vertex on the given mesh near the place, unless a face turns over or the thinnest
    /// one becomes thinner than it is and than good_enough.
    bool move(Vertex v, const Vector& place, const Vector& normal, double good_enough);
    /// Those between the pieces of lines that are longer than they were.
    void drop_line_vertices();
    /// Asks for shorter edges at vertices of the mesh that finished() gave last, and around them,
    /// growing with the way. Only these, and a few rings around for triangles to fit in, may be
    /// changed then.
    /// @param share   #V of that mesh, of the size that is asked for now: 1 where it stays
    /// @param least   mm, no size becomes smaller
    /// @param growth  of the size per mm of way
    void shorten(const Eigen::VectorXd& share, double least, double growth);

    struct Finished {
        TriMesh mesh;
        /// Per face its number in the mesh that was given before if neither it nor a neighbour has
        /// changed, else -1.
        std::vector<int> was;
    };
    Finished finished();

    static constexpr double too_long = 4.0 / 3,
                            too_short = 4.0 / 5; ///< of the size: where a split or collapse does
                                                 ///< not go farther from it

private:
    struct Placed {
        Vector position;
        double size; ///< mm
        int face;    ///< of the given mesh
    };

    /// @param way   mm, to any place of the given mesh: nothing farther away is looked for
    /// @param near  a vertex on whose given face the place may be: only saves time
    Placed place(const Vector& point, double way, Vertex near) const;
    double distance_to_face(const Vector& point, int face) const;
    bool near(Vertex a, Vertex b) const;
    Edge edge_between(Vertex a, Vertex b) const { return mesh_.edge_handle(mesh_.find_halfedge(a, b)); }
    template <class Each> bool all_halves(Edge edge, const Vector& place, const Each& each) const;
    Vertex split(Edge edge, const Vector& position, double asked, int face, int line);
    void divide(int line, const Eigen::VectorXd& sagitta, const Progress& progress);
    void forget_crumb(const std::vector<int>& line);
    void drop(Vertex v);
    bool may_collapse(Halfedge h, bool inner);
    bool closes_line(Halfedge h) const;
    void collapse(Halfedge h);
    void touch(Vertex v);

    const TriMesh& original_;
    const KeptLines& lines_;
    Eigen::Matrix3Xd original_normal_;
    const SizeField& original_size_;
    const ClosestPointSearch& search_;
    double sagitta_;
    HalfedgeMesh mesh_;
    std::vector<int> line_edge_;                  ///< per edge: 0, or 1 + the line that it is a part of
    std::vector<char> on_line_, on_chord_, drop_; ///< per vertex
    std::vector<double> size_;                    ///< per vertex, mm
    std::vector<double> share_;                   ///< per vertex, of what the size is there by original_size_
    std::vector<int> face_;                       ///< per vertex: a given face that it is or was on
    std::vector<Tick> changed_;                   ///< per vertex
    std::vector<char> open_;                      ///< per vertex
    Tick now_ = 0, snapshot_tick_ = -1;           ///< snapshot_tick_: when finished() was asked last
    std::vector<int> snapshot_vertex_;            ///< per vertex of the mesh given last
    std::vector<int> snapshot_face_;              ///< per face its number there, -1: none
};

inline EvolvingMesh::Vector EvolvingMesh::at(Vertex v) const
{
    const auto& p = mesh_.point(v);
    return {p[0], p[1], p[2]};
}

inline std::pair<EvolvingMesh::Vertex, EvolvingMesh::Vertex> EvolvingMesh::ends(Edge e) const
{
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h)};
}

inline EvolvingMesh::Corners EvolvingMesh::triangle(Face f) const
{
    const Halfedge a = mesh_.halfedge_handle(f), b = mesh_.next_halfedge_handle(a), c = mesh_.next_halfedge_handle(b);
    return triangle(mesh_.to_vertex_handle(a), mesh_.to_vertex_handle(b), mesh_.to_vertex_handle(c));
}

inline EvolvingMesh::Corners EvolvingMesh::triangle(Vertex a, Vertex b, Vertex c) const
{
    Corners result;
    result.col(0) = at(a);
    result.col(1) = at(b);
    result.col(2) = at(c);
    return result;
}

inline double EvolvingMesh::thinness(const Corners& t)
{
    // The angle opposite to the shortest side.
    const Vector side[3] = {t.col(2) - t.col(1), t.col(0) - t.col(2), t.col(1) - t.col(0)};
    const double length[3] = {side[0].squaredNorm(), side[1].squaredNorm(), side[2].squaredNorm()};
    const int k = length[0] <= length[1] ? (length[0] <= length[2] ? 0 : 2) : (length[1] <= length[2] ? 1 : 2);
    const Vector &a = side[(k + 1) % 3], &b = side[(k + 2) % 3];
    const double dot = a.dot(b), area = a.cross(b).squaredNorm();
    return area > 0 ? dot * dot / area : std::numeric_limits<double>::infinity();
}

inline EvolvingMesh::Tick EvolvingMesh::changed(Edge e) const
{
    const auto [a, b] = ends(e);
    return std::max(changed(a), changed(b));
}

inline bool EvolvingMesh::open(Edge e) const
{
    const auto [a, b] = ends(e);
    return open(a) && open(b);
}

inline bool EvolvingMesh::open(Face f) const
{
    const Halfedge h = mesh_.halfedge_handle(f);
    return open(mesh_.from_vertex_handle(h)) && open(mesh_.to_vertex_handle(h)) &&
           open(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
}

inline EvolvingMesh::Tick EvolvingMesh::changed(Face f) const
{
    const Halfedge h = mesh_.halfedge_handle(f);
    return std::max({changed(mesh_.from_vertex_handle(h)), changed(mesh_.to_vertex_handle(h)),
                     changed(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)))});
}

} // namespace spia

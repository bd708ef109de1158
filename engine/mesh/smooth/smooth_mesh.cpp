#include "engine/mesh/smooth/smooth_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/smooth/curved_triangle.h"
#include "engine/mesh/smooth/smooth_normals.h"

namespace spia {

namespace {

/// A third of the way from corner i of a face to corner j. An edge between triangles with different
/// normals, at a crease or at two CAD faces, has one curve for both.
Eigen::Vector3d along_edge(const TriMesh& mesh, const std::vector<Eigen::Matrix3d>& normal,
                           const Eigen::Matrix3Xi& neighbour, int f, int i, int j)
{
    const Eigen::Vector3d from = mesh.position.col(mesh.triangle(i, f)), to = mesh.position.col(mesh.triangle(j, f));
    Eigen::Vector3d n = normal[size_t(f)].col(i);
    const int k = (i + 1) % 3 == j ? i : j, g = neighbour(k, f);
    if (g >= 0) {
        const Eigen::Vector3d m = normal[size_t(g)].col(mesh.corner_of(g, mesh.triangle(i, f)));
        constexpr double same = 1e-3, runs_along = 0.7; // radians; the cosine of 45 degrees
        const Eigen::Vector3d d = n.cross(m), along = d.normalized(), way = to - from;
        if (d.norm() > same && std::abs(along.dot(way)) > runs_along * way.norm()) // a crease
            return from + way.dot(along) * along / 3;
        n = (n + m).normalized();
    }
    return third_of_way(from, to, n);
}

/// PN triangles [Vlachos et al. 2001] over those of a mesh.
std::vector<CubicTriangle> cubic_triangles(const TriMesh& mesh, const std::vector<Eigen::Matrix3d>& normal)
{
    const Eigen::Matrix3Xi neighbour = face_neighbours(mesh.triangles(), edge_uses(mesh.triangle));
    std::vector<CubicTriangle> result(size_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int i = 0; i < 3; ++i) {
            result[size_t(f)].corner.col(i) = mesh.position.col(mesh.triangle(i, f));
            for (int j = 0; j < 3; ++j)
                if (i != j)
                    result[size_t(f)].near[size_t(i)].col(j) = along_edge(mesh, normal, neighbour, f, i, j);
        }
    return result;
}

constexpr std::array shares = {0.25, 0.5, 0.75}; // of an edge; the middle alone may lie on a curve
                                                 // that waves

/// Triangles of the mesh, halved at their edges.
class Halving {
public:
    Halving(const TriMesh& mesh, const std::vector<CubicTriangle>& cubic, double chord) : cubic_(cubic), chord_(chord)
    {
        for (int v = 0; v < mesh.vertices(); ++v)
            position_.push_back(mesh.position.col(v));
        for (int f = 0; f < mesh.triangles(); ++f)
            piece_.push_back(
                {f, {mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f)}, Eigen::Matrix3d::Identity()});
    }

    int triangles() const { return int(piece_.size()); }

    /// mm, by how much the edges miss the curved triangles.
    double farthest() const
    {
        double result = 0;
        for (const Piece& piece : piece_)
            for (int k = 0; k < 3; ++k)
                result = std::max(result, missed(piece, k));
        return result;
    }

    /// Every edge that misses them by too much, once. @returns whether there was one
    bool halve()
    {
        middle_.clear();
        for (const Piece& piece : piece_)
            for (int k = 0; k < 3; ++k) {
                const auto key = edge(piece, k);
                if (middle_.contains(key) || missed(piece, k) <= chord_)
                    continue;
                middle_.emplace(key, int(position_.size()));
                position_.push_back(cubic_[size_t(piece.face)].at(between(piece, k, 0.5)));
            }
        if (middle_.empty())
            return false;
        std::vector<Piece> whole;
        whole.swap(piece_);
        for (const Piece& piece : whole)
            divide(piece);
        return true;
    }

    SmoothMesh result() const
    {
        SmoothMesh result;
        result.left = farthest();
        result.mesh.position.resize(3, Eigen::Index(position_.size()));
        for (size_t v = 0; v < position_.size(); ++v)
            result.mesh.position.col(Eigen::Index(v)) = position_[v];
        result.mesh.triangle.resize(3, Eigen::Index(piece_.size()));
        for (size_t t = 0; t < piece_.size(); ++t) {
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, Eigen::Index(t)) = piece_[t].vertex[size_t(k)];
            result.face.push_back(piece_[t].face);
            result.barycentric.push_back(piece_[t].barycentric);
        }
        return result;
    }

private:
    struct Piece {
        int face;
        std::array<int, 3> vertex;
        Eigen::Matrix3d barycentric; ///< of the corners, columns, in the face
    };

    static std::pair<int, int> edge(const Piece& piece, int k)
    {
        return std::minmax(int(piece.vertex[size_t(k)]), int(piece.vertex[size_t(k + 1) % 3]));
    }

    static Eigen::Vector3d between(const Piece& piece, int k, double share)
    {
        return (1 - share) * piece.barycentric.col(k) + share * piece.barycentric.col((k + 1) % 3);
    }

    double missed(const Piece& piece, int k) const
    {
        const Eigen::Vector3d &a = position_[size_t(piece.vertex[size_t(k)])],
                              &b = position_[size_t(piece.vertex[size_t(k + 1) % 3])];
        const Eigen::Vector3d along = (b - a).normalized();
        double result = 0;
        for (const double share : shares) {
            const Eigen::Vector3d way = cubic_[size_t(piece.face)].at(between(piece, k, share)) - a;
            result = std::max(result, (way - way.dot(along) * along).norm());
        }
        return result;
    }

    /// At the middles of its edges that have one: into two, three or four.
    void divide(const Piece& piece)
    {
        std::array<int, 3> middle;
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            const auto found = middle_.find(edge(piece, k));
            middle[size_t(k)] = found == middle_.end() ? -1 : found->second;
            count += found != middle_.end();
        }
        // Corners 0 to 2, then the middles of the edges 0-1, 1-2, 2-0.
        const auto add = [&](int a, int b, int c) {
            Piece part{piece.face, {}, {}};
            for (int i = 0; const int corner : {a, b, c}) {
                part.vertex[size_t(i)] = corner < 3 ? piece.vertex[size_t(corner)] : middle[size_t(corner) - 3];
                part.barycentric.col(i++) =
                    corner < 3 ? Eigen::Vector3d(piece.barycentric.col(corner)) : between(piece, corner - 3, 0.5);
            }
            piece_.push_back(part);
        };
        if (count == 0)
            add(0, 1, 2);
        else if (count == 3) {
            for (int k = 0; k < 3; ++k)
                add(k, 3 + k, 3 + (k + 2) % 3);
            add(3, 4, 5);
        } else
            for (int k = 0; k < 3; ++k) {
                const int i = k, j = (k + 1) % 3, top = (k + 2) % 3;
                const bool here = middle[size_t(i)] >= 0, next = middle[size_t(j)] >= 0,
                           last = middle[size_t(top)] >= 0;
                if (count == 1 && here) {
                    add(i, 3 + i, top);
                    add(3 + i, j, top);
                }
                if (count == 2 && here && next && !last) {
                    add(3 + i, j, 3 + j);
                    add(i, 3 + i, 3 + j);
                    add(i, 3 + j, top);
                }
            }
    }

    const std::vector<CubicTriangle>& cubic_;
    double chord_;
    std::vector<Eigen::Vector3d> position_;
    std::vector<Piece> piece_;
    std::map<std::pair<int, int>, int> middle_; ///< per edge of pieces that is halved
};

} // namespace

Eigen::Vector3d SmoothMesh::at(const MeshPoint& in_facets) const
{
    return over[size_t(in_facets.face)].at(in_facets.barycentric);
}

MeshPoint SmoothMesh::in_facets(const MeshPoint& place) const
{
    MeshPoint result = place;
    result.face = face[size_t(place.face)];
    result.barycentric = barycentric[size_t(place.face)] * place.barycentric;
    return result;
}

Eigen::MatrixXd SmoothMesh::at_vertices(const TriMesh& from, const Eigen::MatrixXd& value) const
{
    Eigen::MatrixXd result(value.rows(), mesh.vertices());
    for (int t = 0; t < mesh.triangles(); ++t)
        for (int k = 0; k < 3; ++k) {
            auto here = result.col(mesh.triangle(k, t));
            here.setZero();
            for (int c = 0; c < 3; ++c)
                if (const double share = barycentric[size_t(t)](c, k); share != 0)
                    here += share * value.col(from.triangle(c, face[size_t(t)]));
        }
    return result;
}

SmoothMesh smooth_mesh(const TriMesh& mesh, const SmoothMeshOptions& options, const std::vector<Eigen::Matrix3f>& given)
{
    std::vector<CubicTriangle> cubic = cubic_triangles(mesh, smooth_normals(mesh, options.crease, given));
    Halving halving(mesh, cubic, options.chord);
    const double chord = halving.farthest();
    for (int k = 0; k < options.most_halvings && 4 * halving.triangles() <= options.most_triangles; ++k)
        if (!halving.halve())
            break;
    SmoothMesh result = halving.result();
    result.chord = chord;
    result.asked = options.chord;
    result.over = std::move(cubic);
    return result;
}

} // namespace spia

#include "tests/support/parametric_mesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/mesh/halfedges.h"

namespace spia::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Surface = std::function<Vector3d(const Vector2d&)>;
using Vertex = OpenMesh::VertexHandle;
using Halfedge = OpenMesh::HalfedgeHandle;

double doubled_area(const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double angle_at(const Vector3d& x, const Vector3d& a, const Vector3d& b)
{
    return std::atan2((a - x).cross(b - x).norm(), (a - x).dot(b - x));
}

double least_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
    return std::min({angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)});
}

/// A mesh whose vertices slide on the surface.
class Remesher {
public:
    Remesher(const Region& region, const Surface& surface, const std::function<double(const Vector2d&)>& edge,
             const std::vector<Vector2d>& parameter, const Eigen::Matrix3Xi& triangle, const std::vector<int>& corners)
        : region_(region), surface_(surface), edge_(edge)
    {
        TriMesh start;
        start.position.resize(3, Eigen::Index(parameter.size()));
        for (size_t v = 0; v < parameter.size(); ++v)
            start.position.col(Eigen::Index(v)) = surface(parameter[v]);
        start.triangle = triangle;
        mesh_ = halfedges(start);
        mesh_.request_vertex_status();
        mesh_.request_edge_status();
        mesh_.request_halfedge_status();
        mesh_.request_face_status();
        mesh_.add_property(parameter_);
        mesh_.add_property(corner_);
        for (size_t v = 0; v < parameter.size(); ++v) {
            mesh_.property(parameter_, Vertex(int(v))) = {parameter[v].x(), parameter[v].y()};
            mesh_.property(corner_, Vertex(int(v))) = 0;
        }
        for (int v : corners)
            mesh_.property(corner_, Vertex(v)) = 1;
    }

    void split_long();
    void collapse_short();
    void even_valences();
    void enlarge_angles();
    void relax();

    int triangles() const { return int(mesh_.n_faces()); }
    std::vector<std::pair<double, double>> areas_and_edges() const;
    ParametricMesh result() const;
    std::vector<int> corners() const;

private:
    Vector2d uv(Vertex v) const { return Eigen::Map<const Vector2d>(mesh_.property(parameter_, v).data()); }
    Vector3d x(Vertex v) const { return Eigen::Map<const Vector3d>(mesh_.point(v).data()); }
    void place(Vertex v, const Vector2d& p)
    {
        mesh_.property(parameter_, v) = {p.x(), p.y()};
        const Vector3d y = surface_(p);
        mesh_.set_point(v, {y.x(), y.y(), y.z()});
    }
    double length(Halfedge h) const { return (x(mesh_.from_vertex_handle(h)) - x(mesh_.to_vertex_handle(h))).norm(); }
    double wanted(Halfedge h) const
    {
        return edge_((uv(mesh_.from_vertex_handle(h)) + uv(mesh_.to_vertex_handle(h))) / 2);
    }
    bool stays_upright(Vertex v, const Vector2d& p, Vertex ignored = Vertex()) const;
    bool may_collapse(Halfedge h); // not const only because OpenMesh marks the neighbours while it
                                   // looks
    bool may_flip(OpenMesh::EdgeHandle e) const;
    Vector2d step_towards_centre(Vertex v) const;

    const Region& region_;
    const Surface& surface_;
    const std::function<double(const Vector2d&)>& edge_; ///< wanted edge length, mm, at a parameter
                                                         ///< point
    HalfedgeMesh mesh_;
    OpenMesh::VPropHandleT<OpenMesh::Vec2d> parameter_;
    OpenMesh::VPropHandleT<int> corner_; ///< 1: stays where it is
};

/// No triangle around v turns over in the parameter plane if v moves to p; triangles with `ignored`
/// do not count.
bool Remesher::stays_upright(Vertex v, const Vector2d& p, Vertex ignored) const
{
    constexpr double thinnest = 1e-3; // of the square of the longest side
    for (auto h : mesh_.voh_range(v)) {
        if (mesh_.is_boundary(h))
            continue;
        const Vertex a = mesh_.to_vertex_handle(h), b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
        if (a == ignored || b == ignored)
            continue;
        const Vector2d pa = uv(a), pb = uv(b);
        const double side = std::max({(pa - p).squaredNorm(), (pb - p).squaredNorm(), (pa - pb).squaredNorm()});
        if (doubled_area(p, pa, pb) < thinnest * side)
            return false;
    }
    return true;
}

void Remesher::split_long()
{
    const int edges = int(mesh_.n_edges());
    for (int i = 0; i < edges; ++i) {
        const OpenMesh::EdgeHandle e(i);
        const Halfedge h = mesh_.halfedge_handle(e, 0);
        if (length(h) < 4.0 / 3 * wanted(h))
            continue;
        const Vector2d middle = (uv(mesh_.from_vertex_handle(h)) + uv(mesh_.to_vertex_handle(h))) / 2;
        const bool at_boundary = mesh_.is_boundary(e);
        const Vertex v = mesh_.add_vertex({0, 0, 0});
        mesh_.property(corner_, v) = 0;
        place(v, middle);
        mesh_.split(e, v);
        if (at_boundary) {
            const Vector2d p = on_boundary_of(region_, middle);
            if (stays_upright(v, p))
                place(v, p); // otherwise relax() brings it there later
        }
    }
}

bool Remesher::may_collapse(Halfedge h)
{
    const Vertex from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (mesh_.property(corner_, from) || !mesh_.is_collapse_ok(h))
        return false;
    if (mesh_.is_boundary(from) && !mesh_.is_boundary(mesh_.edge_handle(h)))
        return false;
    for (auto around : mesh_.voh_range(from)) { // no edge that would be split again
        const Vertex other = mesh_.to_vertex_handle(around);
        if (other != to && (x(other) - x(to)).norm() > 4.0 / 3 * edge_((uv(other) + uv(to)) / 2))
            return false;
    }
    return stays_upright(from, uv(to), to);
}

void Remesher::collapse_short()
{
    const int halfedges = int(mesh_.n_halfedges());
    for (int i = 0; i < halfedges; ++i) {
        const Halfedge h(i);
        if (!mesh_.status(mesh_.edge_handle(h)).deleted() && length(h) < 0.8 * wanted(h) && may_collapse(h))
            mesh_.collapse(h);
    }
    mesh_.garbage_collection();
}

bool Remesher::may_flip(OpenMesh::EdgeHandle e) const
{
    if (mesh_.is_boundary(e) || !mesh_.is_flip_ok(e))
        return false;
    const Halfedge h = mesh_.halfedge_handle(e, 0), g = mesh_.halfedge_handle(e, 1);
    const Vector2d a = uv(mesh_.from_vertex_handle(h)), b = uv(mesh_.to_vertex_handle(h));
    const Vector2d c = uv(mesh_.opposite_vh(h)), d = uv(mesh_.opposite_vh(g));
    const double thinnest = 1e-3 * (c - d).squaredNorm();
    return doubled_area(c, d, b) > thinnest && doubled_area(d, c, a) > thinnest;
}

/// Flips edges that bring inner vertices nearer to six neighbours and boundary vertices nearer to
/// four.
void Remesher::even_valences()
{
    const auto excess = [&](Vertex v) { return int(mesh_.valence(v)) - (mesh_.is_boundary(v) ? 4 : 6); };
    for (auto e : mesh_.edges()) {
        if (mesh_.is_boundary(e))
            continue;
        const Halfedge h = mesh_.halfedge_handle(e, 0), g = mesh_.halfedge_handle(e, 1);
        const Vertex a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
        const Vertex c = mesh_.opposite_vh(h), d = mesh_.opposite_vh(g);
        const int p = excess(a), q = excess(b), r = excess(c), s = excess(d);
        const int before = p * p + q * q + r * r + s * s;
        const int after = (p - 1) * (p - 1) + (q - 1) * (q - 1) + (r + 1) * (r + 1) + (s + 1) * (s + 1);
        if (after >= before || !may_flip(e))
            continue;
        const double angle = std::min(least_angle(x(c), x(d), x(b)), least_angle(x(d), x(c), x(a)));
        if (angle > 0.35) // 20 degrees
            mesh_.flip(e);
    }
}

/// Flips edges if that enlarges the least angle of their two triangles.
void Remesher::enlarge_angles()
{
    for (auto e : mesh_.edges()) {
        if (mesh_.is_boundary(e))
            continue;
        const Halfedge h = mesh_.halfedge_handle(e, 0), g = mesh_.halfedge_handle(e, 1);
        const Vector3d a = x(mesh_.from_vertex_handle(h)), b = x(mesh_.to_vertex_handle(h));
        const Vector3d c = x(mesh_.opposite_vh(h)), d = x(mesh_.opposite_vh(g));
        if (angle_at(c, a, b) + angle_at(d, a, b) < std::numbers::pi - 1e-6)
            continue; // the Delaunay condition holds
        const double before = std::min(least_angle(a, b, c), least_angle(a, d, b));
        const double after = std::min(least_angle(c, d, b), least_angle(d, c, a));
        if (after > before && may_flip(e))
            mesh_.flip(e);
    }
}

/// The way in the parameter plane to the centre of the triangles around an inner vertex, or of the
/// two neighbours along the boundary. Triangles weigh as many as they stand for: area per square of
/// the wanted edge.
Vector2d Remesher::step_towards_centre(Vertex v) const
{
    const Vector3d here = x(v);
    const Vector2d p = uv(v);
    Vector3d step = Vector3d::Zero();
    double weight = 0;
    // Moving a parameter by du moves the point by about J du; J is fitted to the neighbours.
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
    const bool at_boundary = mesh_.is_boundary(v);
    for (auto h : mesh_.voh_range(v)) {
        const Vertex a = mesh_.to_vertex_handle(h);
        const Vector3d to_a = x(a) - here;
        const Vector2d du = uv(a) - p;
        squares += du * du.transpose();
        products += to_a * du.transpose();
        if (at_boundary) {
            if (mesh_.is_boundary(mesh_.edge_handle(h))) {
                const double w = 1 / edge_((p + uv(a)) / 2);
                step += w * to_a;
                weight += w;
            }
        } else {
            const Vertex b = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
            const Vector3d to_b = x(b) - here;
            const double size = edge_((p + uv(a) + uv(b)) / 3);
            const double w = to_a.cross(to_b).norm() / (size * size);
            step += w * (to_a + to_b) / 3;
            weight += w;
        }
    }
    const Eigen::Matrix<double, 3, 2> J = products * squares.inverse();
    return (J.transpose() * J).inverse() * (J.transpose() * (step / weight));
}

void Remesher::relax()
{
    for (auto v : mesh_.vertices()) {
        if (mesh_.property(corner_, v))
            continue;
        Vector2d step = step_towards_centre(v);
        if (!step.allFinite())
            continue;
        const bool at_boundary = mesh_.is_boundary(v);
        for (int attempt = 0; attempt < 4; ++attempt, step /= 2) {
            Vector2d p = uv(v) + step;
            if (at_boundary)
                p = on_boundary_of(region_, p);
            if (p.allFinite() && stays_upright(v, p)) {
                place(v, p);
                break;
            }
        }
    }
}

/// Per triangle: its area in space and the wanted edge in its middle.
std::vector<std::pair<double, double>> Remesher::areas_and_edges() const
{
    std::vector<std::pair<double, double>> list;
    for (auto f : mesh_.faces()) {
        const Halfedge h = mesh_.halfedge_handle(f);
        const Vertex a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h), c = mesh_.opposite_vh(h);
        list.emplace_back((x(b) - x(a)).cross(x(c) - x(a)).norm() / 2, edge_((uv(a) + uv(b) + uv(c)) / 3));
    }
    return list;
}

ParametricMesh Remesher::result() const
{
    ParametricMesh out;
    out.mesh.position.resize(3, Eigen::Index(mesh_.n_vertices()));
    out.parameter.resize(2, Eigen::Index(mesh_.n_vertices()));
    out.mesh.triangle.resize(3, Eigen::Index(mesh_.n_faces()));
    for (auto v : mesh_.vertices()) {
        out.mesh.position.col(v.idx()) = x(v);
        out.parameter.col(v.idx()) = uv(v);
    }
    for (auto f : mesh_.faces()) {
        int k = 0;
        for (auto v : mesh_.fv_range(f))
            out.mesh.triangle(k++, f.idx()) = v.idx();
    }
    return out;
}

std::vector<int> Remesher::corners() const
{
    std::vector<int> list;
    for (auto v : mesh_.vertices())
        if (mesh_.property(corner_, v))
            list.push_back(v.idx());
    return list;
}

/// Every triangle in four, new vertices in the middle of the edges. Those between boundary vertices
/// come onto the boundary when the mesh is relaxed.
void quarter(ParametricMesh& coarse, std::vector<Vector2d>& parameter)
{
    std::map<std::pair<int, int>, int> middle; // edge -> new vertex
    parameter.clear();
    for (int v = 0; v < coarse.mesh.vertices(); ++v)
        parameter.push_back(coarse.parameter.col(v));
    Eigen::Matrix3Xi fine(3, 4 * coarse.mesh.triangles());
    for (int f = 0; f < coarse.mesh.triangles(); ++f) {
        const Eigen::Vector3i t = coarse.mesh.triangle.col(f);
        Eigen::Vector3i m;
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), int(parameter.size()));
            if (is_new)
                parameter.push_back((parameter[a] + parameter[b]) / 2);
            m[k] = entry->second;
        }
        fine.col(4 * f) << t[0], m[0], m[2];
        fine.col(4 * f + 1) << t[1], m[1], m[0];
        fine.col(4 * f + 2) << t[2], m[2], m[1];
        fine.col(4 * f + 3) = m;
    }
    coarse.mesh.triangle = std::move(fine);
}

/// The edge of an equilateral triangle.
double edge_of(double area) { return std::sqrt(4 / std::sqrt(3.0) * area); }

/// The wanted edge length that lets even triangles add up to this number.
/// @param parts  area and upper limit of the edge of every piece of the surface
double first_size(const std::vector<std::pair<double, double>>& parts, int triangles)
{
    double small = 1e-3, large = 1e6; // mm
    for (int i = 0; i < 50; ++i) {
        const double size = std::sqrt(small * large);
        double count = 0;
        for (const auto& [area, limit] : parts)
            count += area / (std::sqrt(3.0) / 4 * std::pow(std::min(size, limit), 2));
        (count > triangles ? small : large) = size;
    }
    return small;
}

Remesher start(const Region& region, const Surface& surface, const std::function<double(const Vector2d&)>& edge,
               double spacing)
{
    // Halves, not the largest that fits: a lattice just below the length that is collapsed would
    // stay or go as a whole.
    while (spacing > region.smallest_feature / 2)
        spacing /= 2;
    const PlaneMesh plane = cut_lattice(region, spacing);
    return Remesher(region, surface, edge, plane.position, plane.triangle, plane.corner);
}

/// The last touch, without changing numbers.
void polish(Remesher& remesher)
{
    for (int i = 0; i < 3; ++i) {
        remesher.enlarge_angles();
        remesher.relax();
    }
    remesher.enlarge_angles();
}

} // namespace

ParametricMesh mesh_surface(const Region& region, const Surface& surface, int triangles,
                            const std::function<double(const Vector2d&)>& longest)
{
    constexpr int direct = 60000; // larger meshes are made from smaller ones, four triangles out of
                                  // one
    int levels = 0, first_triangles = triangles;
    while (first_triangles > direct) {
        first_triangles /= 4;
        ++levels;
    }
    double size = 1e30; // mm, the wanted edge away from limits; at first there are only limits
    const std::function<double(const Vector2d&)> edge = [&](const Vector2d& p) {
        return longest ? std::min(size, longest(p)) : size;
    };
    const auto attempt = [&](double spacing) { return start(region, surface, edge, spacing); };

    const Vector2d box = region.high - region.low;
    const double box_edge = edge_of(box.prod() / first_triangles);
    const Remesher rough = attempt(box_edge);
    size = first_size(rough.areas_and_edges(), first_triangles);

    // Lengths between those that are split and those that are collapsed stay as they are, so the
    // number reached follows the wanted length only roughly, and an existing mesh not at all: start
    // again with the length corrected.
    ParametricMesh result;
    std::vector<int> corners;
    double least_miss = 1e30, best_size = size;
    for (int round = 0; round < 5 && least_miss > 0.03; ++round) {
        Remesher remesher = attempt(size);
        for (int i = 0; i < 8; ++i) {
            remesher.split_long();
            remesher.collapse_short();
            remesher.even_valences();
            remesher.enlarge_angles();
            remesher.relax();
        }
        const double ratio = double(remesher.triangles()) / first_triangles;
        if (std::abs(ratio - 1) < least_miss) {
            least_miss = std::abs(ratio - 1);
            best_size = size;
            polish(remesher);
            result = remesher.result();
            corners = remesher.corners();
        }
        size *= std::sqrt(ratio);
    }
    size = best_size;
    for (int level = 0; level < levels; ++level) {
        std::vector<Vector2d> parameter;
        quarter(result, parameter);
        size /= 2;
        Remesher finer(region, surface, edge, parameter, result.mesh.triangle, corners);
        polish(finer);
        result = finer.result();
    }
    return result;
}

} // namespace spia::shapes

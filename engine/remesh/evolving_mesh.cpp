#include "engine/remesh/evolving_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/remesh/divide_line.h"
#include "engine/remesh/triangle_quality.h"

namespace spia {
namespace {

/// Whether a face still looks to about the same side.
bool same_side(const Eigen::Vector3d& before, const Eigen::Vector3d& after)
{
    constexpr double most_turn = 0.5; // cosine
    return after.dot(before) > most_turn * after.norm() * before.norm();
}

} // namespace

EvolvingMesh::EvolvingMesh(const TriMesh& original, const KeptLines& lines, const Eigen::VectorXd& size,
                           const ClosestPointSearch& search, double sagitta, const Eigen::VectorXd& gap,
                           const Progress& progress)
    : original_(original), original_normal_(area_vectors(original)), original_size_(size), search_(search),
      sagitta_(sagitta), mesh_(halfedges(original)), on_line_(lines.on_line.begin(), lines.on_line.end()),
      drop_(size_t(original.vertices()), 0), size_(size.begin(), size.end())
{
    mesh_.request_vertex_status();
    mesh_.request_halfedge_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    line_edge_.assign(mesh_.n_edges(), 0);
    for (const std::vector<int>& line : lines.line)
        for (size_t i = 0; i + 1 < line.size(); ++i)
            line_edge_[size_t(edge_between(Vertex(line[i]), Vertex(line[i + 1])).idx())] = 1;
    const Eigen::VectorXd along_border = (gap / 3).cwiseMin(sagitta);
    for (const std::vector<int>& line : lines.line)
        divide(line, along_border, progress);
    for (const std::vector<int>& line : lines.line)
        if (line.front() != line.back())
            forget_crumb(line);
}

EvolvingMesh::Vector EvolvingMesh::at(Vertex v) const
{
    const auto& p = mesh_.point(v);
    return {p[0], p[1], p[2]};
}

std::pair<EvolvingMesh::Vertex, EvolvingMesh::Vertex> EvolvingMesh::ends(Edge e) const
{
    const Halfedge h = mesh_.halfedge_handle(e, 0);
    return {mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h)};
}

EvolvingMesh::Corners EvolvingMesh::triangle(Face f) const
{
    Eigen::Matrix3d result;
    int k = 0;
    for (const Vertex v : mesh_.fv_range(f))
        result.col(k++) = at(v);
    return result;
}

EvolvingMesh::Corners EvolvingMesh::triangle(Vertex a, Vertex b, Vertex c) const
{
    Eigen::Matrix3d result;
    result << at(a), at(b), at(c);
    return result;
}

double EvolvingMesh::worst_angle(const Quad& v) const
{
    return std::min(least_angle(triangle(v[0], v[1], v[2])), least_angle(triangle(v[1], v[0], v[3])));
}

double EvolvingMesh::worst_around(Vertex v) const
{
    double worst = std::numbers::pi;
    for (const Face f : mesh_.vf_range(v))
        worst = std::min(worst, least_angle(triangle(f)));
    return worst;
}

std::optional<EvolvingMesh::Quad> EvolvingMesh::quad(Edge edge) const
{
    if (mesh_.status(edge).deleted() || line_edge_[size_t(edge.idx())] || mesh_.is_boundary(edge) ||
        !mesh_.is_flip_ok(edge))
        return std::nullopt;
    const Halfedge h = mesh_.halfedge_handle(edge, 0), o = mesh_.halfedge_handle(edge, 1);
    return Quad{mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h),
                mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                mesh_.to_vertex_handle(mesh_.next_halfedge_handle(o))};
}

EvolvingMesh::Placed EvolvingMesh::place(const Vector& point, double way) const
{
    constexpr double rounding = 1e-6;
    ClosestPoint found = search_.nearest(point, (1 + rounding) * way);
    if (found.face < 0)
        found = search_.nearest(point);
    double asked = 0;
    for (int k = 0; k < 3; ++k)
        asked += found.barycentric[k] * original_size_[original_.triangle(k, found.face)];
    return {found.position, asked, found.face};
}

/// Whether the middle of a new edge is near the given mesh.
bool EvolvingMesh::near(const Vector& a, const Vector& b) const
{
    return search_.nearest((a + b) / 2, sagitta_).face >= 0;
}

/// One edge becomes two, and a vertex lies between them.
EvolvingMesh::Vertex EvolvingMesh::split(Edge edge, const Vector& position, double asked, bool line)
{
    const auto [a, b] = ends(edge);
    const Vertex v = mesh_.add_vertex({position.x(), position.y(), position.z()});
    mesh_.split(edge, v);
    size_.push_back(asked);
    on_line_.push_back(line);
    drop_.push_back(0);
    line_edge_.resize(mesh_.n_edges(), 0);
    line_edge_[size_t(edge.idx())] = 0;
    if (line)
        for (const Vertex end : {a, b})
            line_edge_[size_t(edge_between(v, end).idx())] = 1;
    return v;
}

void EvolvingMesh::split(Edge edge)
{
    const auto [a, b] = ends(edge);
    const Placed middle = place((at(a) + at(b)) / 2, length(a, b) / 2);
    split(edge, middle.position, middle.size, false);
}

/// Puts all new vertices on the line; those that are not kept go in drop_line_vertices().
void EvolvingMesh::divide(const std::vector<int>& line, const Eigen::VectorXd& sagitta, const Progress& progress)
{
    const LineDivision division = divide_line(original_, line, original_size_, sagitta, progress);
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        Vertex from(line[i]);
        const Vertex to(line[i + 1]);
        const Vector a = at(from), b = at(to);
        for (int k = 1; k < division.pieces[i]; ++k) {
            const double t = double(k) / division.pieces[i];
            from = split(edge_between(from, to), a + t * (b - a), (1 - t) * size(Vertex(line[i])) + t * size(to), true);
        }
    }
    for (size_t i = 0; i < line.size(); ++i)
        if (!division.keep[i])
            drop_[size_t(line[i])] = 1;
}

/// A line that is a crumb beside the tolerance, as where CAD faces do not quite meet: one of its ends is no corner.
void EvolvingMesh::forget_crumb(const std::vector<int>& line)
{
    constexpr double crumb = 0.25; // of the sagitta
    double length_of_it = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i)
        length_of_it += (original_.position.col(line[i]) - original_.position.col(line[i + 1])).norm();
    if (length_of_it >= crumb * sagitta_)
        return;
    for (const int end : {line.front(), line.back()}) {
        int edges = 0;
        for (const Edge e : mesh_.ve_range(Vertex(end)))
            edges += line_edge_[size_t(e.idx())];
        const int other = end == line.front() ? line.back() : line.front();
        if (edges == 2 && !drop_[size_t(other)]) {
            drop_[size_t(end)] = 1;
            return;
        }
    }
}

void EvolvingMesh::drop(Vertex v)
{
    std::vector<Halfedge> along;
    for (const Halfedge h : mesh_.voh_range(v))
        if (line_edge_[size_t(mesh_.edge_handle(h).idx())])
            along.push_back(h);
    std::sort(along.begin(), along.end(), [&](Halfedge a, Halfedge b) {
        const double la = length(v, mesh_.to_vertex_handle(a)), lb = length(v, mesh_.to_vertex_handle(b));
        return la < lb || (la == lb && a.idx() < b.idx());
    });
    for (const Halfedge h : along)
        if (may_collapse(h, false)) {
            collapse(h);
            drop_[size_t(v.idx())] = 0;
            return;
        }
}

void EvolvingMesh::drop_line_vertices()
{
    for (int v = 0; v < int(drop_.size()); ++v)
        if (drop_[size_t(v)])
            drop(Vertex(v));
}

/// Whether its first vertex can be pulled into its second one.
bool EvolvingMesh::may_collapse(Halfedge h, bool inner)
{
    const Vertex from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if ((inner && on_line_[size_t(from.idx())]) || !mesh_.is_collapse_ok(h))
        return false;
    if (!inner && closes_line(h))
        return false;
    const Vector target = at(to);
    if (inner)
        for (const Vertex w : mesh_.vv_range(from))
            if (w != to && (at(w) - target).norm() > too_long * std::min(size(w), size(to)))
                return false;
    double worst = std::numbers::pi, worst_of_new = std::numbers::pi;
    Vector around = Vector::Zero();
    for (const Face f : mesh_.vf_range(from))
        around += area_of(triangle(f));
    for (const Face f : mesh_.vf_range(from)) {
        bool vanishes = false;
        Eigen::Matrix3d before, after;
        int k = 0;
        for (const Vertex w : mesh_.fv_range(f)) {
            vanishes = vanishes || w == to;
            before.col(k) = at(w);
            after.col(k++) = w == from ? target : at(w);
        }
        worst = std::min(worst, least_angle(before));
        if (vanishes)
            continue;
        constexpr double sliver = 0.02; // radians; its normal is noise
        if (!same_side(least_angle(before) < sliver ? around : area_of(before), area_of(after)))
            return false;
        worst_of_new = std::min(worst_of_new, least_angle(after));
    }
    constexpr double poor = 10 * std::numbers::pi / 180;
    if (worst_of_new < std::min(worst, poor))
        return false;
    for (const Vertex w : mesh_.vv_range(from))
        if (w != to && !mesh_.find_halfedge(w, to).is_valid() && !near(at(w), target))
            return false;
    return true;
}

bool EvolvingMesh::collapse_if_sound(Edge edge)
{
    for (const int side : {0, 1})
        if (const Halfedge h = mesh_.halfedge_handle(edge, side); may_collapse(h, true)) {
            collapse(h);
            return true;
        }
    return false;
}

/// Whether a line of three edges would be left with two on the same vertices.
bool EvolvingMesh::closes_line(Halfedge h) const
{
    const Vertex from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    for (const Halfedge out : mesh_.voh_range(from)) {
        const Vertex w = mesh_.to_vertex_handle(out);
        if (w == to || !line_edge_[size_t(mesh_.edge_handle(out).idx())])
            continue;
        const Halfedge other = mesh_.find_halfedge(w, to);
        if (other.is_valid() && line_edge_[size_t(mesh_.edge_handle(other).idx())])
            return true;
    }
    return false;
}

void EvolvingMesh::collapse(Halfedge h)
{
    const Vertex to = mesh_.to_vertex_handle(h), from = mesh_.from_vertex_handle(h);
    std::vector<Vertex> joined; // ends of line edges that fall on other edges
    for (const Halfedge out : mesh_.voh_range(from))
        if (line_edge_[size_t(mesh_.edge_handle(out).idx())] && mesh_.to_vertex_handle(out) != to)
            joined.push_back(mesh_.to_vertex_handle(out));
    for (const Vertex w : mesh_.vv_range(from)) // of two edges that become one either may be the one that stays
        if (const Halfedge other = mesh_.find_halfedge(w, to);
            other.is_valid() && line_edge_[size_t(mesh_.edge_handle(other).idx())])
            joined.push_back(w);
    mesh_.collapse(h);
    for (const Vertex w : joined)
        line_edge_[size_t(edge_between(w, to).idx())] = 1;
}

/// If both new triangles have larger angles than that and look to the side of the old ones.
bool EvolvingMesh::flip_if_sound(Edge edge, const Quad& v, double worst)
{
    const Eigen::Matrix3d p = triangle(v[0], v[3], v[2]), q = triangle(v[1], v[2], v[3]);
    if (std::min(least_angle(p), least_angle(q)) <= worst * (1 + 1e-9))
        return false;
    const Vector side = area_of(triangle(v[0], v[1], v[2])) + area_of(triangle(v[1], v[0], v[3]));
    if (!same_side(side, area_of(p)) || !same_side(side, area_of(q)) || !near(at(v[2]), at(v[3])))
        return false;
    mesh_.flip(edge);
    return true;
}

/// Puts the vertex on the given mesh near the place, unless a face turns over or the least angle falls below
/// what it is and below good_enough.
bool EvolvingMesh::move(Vertex v, const Vector& place_of_it, const Vector& normal, double good_enough)
{
    const Vector before = at(v);
    const Placed placed = place(place_of_it, (place_of_it - before).norm());
    const Vector side = original_normal_.col(placed.face);
    constexpr double same_layer = 0.5; // cosine; the nearest place may be on a sheet that lies behind this one
    if (side.dot(normal) < same_layer * side.norm())
        return false;
    std::vector<Vector> areas;
    double worst = std::numbers::pi;
    for (const Face f : mesh_.vf_range(v)) {
        const Eigen::Matrix3d t = triangle(f);
        areas.push_back(area_of(t));
        worst = std::min(worst, least_angle(t));
    }
    const double needed = std::min(worst, good_enough);
    mesh_.set_point(v, {placed.position.x(), placed.position.y(), placed.position.z()});
    size_t i = 0;
    bool sound = true;
    for (const Face f : mesh_.vf_range(v)) {
        const Eigen::Matrix3d t = triangle(f);
        sound = sound && same_side(areas[i++], area_of(t)) && least_angle(t) >= needed;
    }
    if (!sound)
        mesh_.set_point(v, {before.x(), before.y(), before.z()});
    else
        size_[size_t(v.idx())] = placed.size;
    return sound;
}

TriMesh EvolvingMesh::finished()
{
    mesh_.delete_isolated_vertices(); // of thin faces
    mesh_.garbage_collection();
    TriMesh result;
    result.position.resize(3, Eigen::Index(mesh_.n_vertices()));
    for (const Vertex v : mesh_.vertices())
        result.position.col(v.idx()) = at(v);
    result.triangle.resize(3, Eigen::Index(mesh_.n_faces()));
    for (const Face f : mesh_.faces()) {
        int k = 0;
        for (const Vertex v : mesh_.fv_range(f))
            result.triangle(k++, f.idx()) = v.idx();
    }
    return result;
}

} // namespace spia

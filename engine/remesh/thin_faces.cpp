#include "engine/remesh/thin_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "engine/mesh/halfedges.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using VertexHandle = OpenMesh::VertexHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

class Flipper {
public:
    Flipper(const TriMesh& mesh, double height, std::vector<int>& label)
        : mesh_(halfedges(mesh)), position_(mesh.position), height_(height), label_(label)
    {
        mesh_.request_face_status();
        mesh_.request_edge_status();
        mesh_.request_halfedge_status();
        mesh_.request_vertex_status();
    }

    /// @returns whether anything changed
    bool sweep()
    {
        bool changed = false;
        for (int i = 0; i < int(mesh_.n_faces()); ++i) {
            const FaceHandle face(i);
            if (mesh_.status(face).deleted())
                continue;
            const HalfedgeHandle longest = longest_of(face);
            if (height(longest) > height_)
                continue;
            changed =
                (mesh_.is_boundary(mesh_.opposite_halfedge_handle(longest)) ? cut_off(face, longest) : flip(longest)) ||
                changed;
        }
        return changed;
    }

    TriMesh finished()
    {
        TriMesh result{position_, Eigen::Matrix3Xi(3, Eigen::Index(mesh_.n_faces()))};
        std::vector<int> label;
        int faces = 0;
        for (int i = 0; i < int(mesh_.n_faces()); ++i) {
            const FaceHandle face(i);
            if (mesh_.status(face).deleted())
                continue;
            int k = 0;
            for (const VertexHandle v : mesh_.fv_range(face))
                result.triangle(k++, faces) = v.idx();
            ++faces;
            if (!label_.empty())
                label.push_back(label_[size_t(i)]);
        }
        result.triangle.conservativeResize(3, faces);
        label_ = std::move(label);
        return result;
    }

private:
    Eigen::Vector3d at(VertexHandle v) const { return position_.col(v.idx()); }
    VertexHandle from(HalfedgeHandle h) const { return mesh_.from_vertex_handle(h); }
    VertexHandle to(HalfedgeHandle h) const { return mesh_.to_vertex_handle(h); }
    VertexHandle top(HalfedgeHandle h) const { return to(mesh_.next_halfedge_handle(h)); }
    double length(HalfedgeHandle h) const { return (at(to(h)) - at(from(h))).norm(); }

    Eigen::Vector3d area(VertexHandle a, VertexHandle b, VertexHandle c) const
    {
        return (at(b) - at(a)).cross(at(c) - at(a)) / 2;
    }

    /// Of a triangle over its longest edge.
    double least_height(VertexHandle a, VertexHandle b, VertexHandle c) const
    {
        const double longest = std::max({(at(b) - at(a)).norm(), (at(c) - at(b)).norm(), (at(a) - at(c)).norm()});
        return longest > 0 ? 2 * area(a, b, c).norm() / longest : 0;
    }

    HalfedgeHandle longest_of(FaceHandle face) const
    {
        HalfedgeHandle longest;
        for (const HalfedgeHandle h : mesh_.fh_range(face))
            if (!longest.is_valid() || length(h) > length(longest))
                longest = h;
        return longest;
    }

    double height(HalfedgeHandle h) const { return least_height(from(h), to(h), top(h)); }

    /// Into a neighbour that is not thin itself: the normal of a thin face says nothing.
    bool flip(HalfedgeHandle h)
    {
        const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
        const VertexHandle a = from(h), b = to(h), c = top(h), d = top(o);
        const Eigen::Vector3d side = area(b, a, d);
        if (height(o) <= height_ || agree(area(a, b, c), side))
            return false;
        if (different(mesh_.face_handle(h), mesh_.face_handle(o)) || !mesh_.is_flip_ok(mesh_.edge_handle(h)) ||
            std::min(least_height(a, d, c), least_height(b, c, d)) <= height(h) || side.dot(area(a, d, c)) <= 0 ||
            side.dot(area(b, c, d)) <= 0)
            return join_shortest(mesh_.face_handle(h));
        mesh_.flip(mesh_.edge_handle(h));
        return true;
    }

    /// If it is no longer than the height: a needle.
    bool join_shortest(FaceHandle face)
    {
        for (const HalfedgeHandle h : mesh_.fh_range(face))
            if (length(h) <= height_)
                for (const HalfedgeHandle way : {h, mesh_.opposite_halfedge_handle(h)})
                    if (mesh_.is_collapse_ok(way) && !turns_over(way)) {
                        mesh_.collapse(way);
                        return true;
                    }
        return false;
    }

    /// Whether a face that is not thin would look to the other side.
    bool turns_over(HalfedgeHandle h) const
    {
        for (const FaceHandle f : mesh_.vf_range(from(h))) {
            std::array<VertexHandle, 3> v;
            size_t k = 0;
            for (const VertexHandle w : mesh_.fv_range(f))
                v[k++] = w;
            const Eigen::Vector3d before = area(v[0], v[1], v[2]);
            if (least_height(v[0], v[1], v[2]) <= height_)
                continue;
            for (VertexHandle& w : v)
                w = w == from(h) ? to(h) : w;
            if (before.dot(area(v[0], v[1], v[2])) < 0)
                return true;
        }
        return false;
    }

    bool different(FaceHandle f, FaceHandle g) const
    {
        return !label_.empty() && label_[size_t(f.idx())] != label_[size_t(g.idx())];
    }

    static bool agree(const Eigen::Vector3d& thin, const Eigen::Vector3d& side)
    {
        constexpr double enough = 0.9; // cosine
        return thin.dot(side) > enough * thin.norm() * side.norm();
    }

    /// Unless it looks to where its neighbours look, or the boundary would touch itself at the
    /// vertex over its edge.
    bool cut_off(FaceHandle face, HalfedgeHandle h)
    {
        if (mesh_.is_boundary(top(h)))
            return false;
        const Eigen::Vector3d thin = area(from(h), to(h), top(h));
        const bool well = [&] {
            for (const HalfedgeHandle side : {mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)}) {
                const HalfedgeHandle o = mesh_.opposite_halfedge_handle(side);
                if (height(o) > height_ && !agree(thin, area(from(o), to(o), top(o))))
                    return false;
            }
            return true;
        }();
        if (well)
            return false;
        mesh_.delete_face(face, false);
        return true;
    }

    HalfedgeMesh mesh_;
    Eigen::Matrix3Xd position_;
    double height_;
    std::vector<int>& label_;
};

} // namespace

bool is_thin(const TriMesh& mesh, int face, double height)
{
    const Eigen::Matrix3d t = mesh.position(Eigen::all, mesh.triangle.col(face));
    const Eigen::Vector3d a = t.col(1) - t.col(0), b = t.col(2) - t.col(0);
    return a.cross(b).norm() <= height * std::max({a.norm(), b.norm(), (b - a).norm()});
}

TriMesh without_thin_faces(const TriMesh& mesh, double height, std::vector<int>& label)
{
    Flipper flipper(mesh, height, label);
    constexpr int most_sweeps = 30; // through strips that are several faces wide
    for (int sweep = 0; sweep < most_sweeps && flipper.sweep(); ++sweep) {
    }
    return flipper.finished();
}

} // namespace spia

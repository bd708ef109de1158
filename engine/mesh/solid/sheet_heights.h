#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

constexpr double chords_off_bends = 0.005; // of the thickness: what triangles of bends are off
                                           // their surface, about

/// How far vertices of a solid are off its other skin: asked for few of them, and for some twice.
class SheetHeights {
public:
    /// @param other_skin  tells of a triangle whether it is one of that; @param within mm, farther
    /// is not looked
    template <class Counts>
    SheetHeights(const TriMesh& mesh, const Counts& other_skin, double within)
        : position_(mesh.position), other_(part_of(mesh, other_skin)), search_(other_), within_(within),
          known_(size_t(mesh.vertices()), -1)
    {
    }
    ClosestPoint nearest(int v) const { return search_.nearest(position_.col(v), within_); }
    /// mm, of a vertex of plane skin with this normal, unit: where the other skin is plane below it and
    /// has a hole opposite, its nearest place is the rim of that, askew; then square to the skin.
    double square_to(int v, const Eigen::Vector3d& normal)
    {
        constexpr double parallel = 1 - 1e-6; // 0.1 degrees
        const ClosestPoint near = nearest(v);
        if (near.face < 0)
            return within_;
        const auto corner = [&](int k) { return other_.position.col(other_.triangle(k, near.face)); };
        const Eigen::Vector3d below = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        return std::abs(below.dot(normal)) > parallel ? std::abs((position_.col(v) - near.position).dot(normal))
                                                      : (*this)(v);
    }
    double operator()(int v)
    {
        if (known_[size_t(v)] < 0)
            known_[size_t(v)] = std::min(nearest(v).distance, within_);
        return known_[size_t(v)];
    }

private:
    template <class Counts> static TriMesh part_of(const TriMesh& mesh, const Counts& counts)
    {
        std::vector<int> faces;
        for (int f = 0; f < mesh.triangles(); ++f)
            if (counts(f))
                faces.push_back(f);
        return {mesh.position, mesh.triangle(Eigen::all, faces)};
    }

    const Eigen::Matrix3Xd& position_;
    TriMesh other_;
    ClosestPointSearch search_;
    double within_; ///< mm
    std::vector<double> known_;
};

} // namespace spia

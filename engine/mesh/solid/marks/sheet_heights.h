#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
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
    /// mm, of a vertex of a skin with this normal, unit: where the other skin has a hole or a step
    /// opposite, its nearest place is the rim of that, askew; then square to the skin, or where
    /// that is bent to the nearest triangle.
    double square_to(int v, const Eigen::Vector3d& normal)
    {
        constexpr double parallel = 1 - 1e-6; // 0.1 degrees
        constexpr double below = 0.97;        // 14 degrees: more than chords of bends are askew by
        const ClosestPoint near = nearest(v);
        if (near.face < 0)
            return within_;
        if (std::abs(this->normal(near.face).dot(normal)) > parallel)
            return std::abs((position_.col(v) - near.position).dot(normal));
        const double square = over_nearest(v), straight = (*this)(v);
        return square > below * straight ? straight : square;
    }
    double operator()(int v)
    {
        if (known_[size_t(v)] < 0)
            known_[size_t(v)] = std::min(nearest(v).distance, within_);
        return known_[size_t(v)];
    }
    /// mm, of any vertex square to the triangle of the other skin that is nearest: that is askew
    /// below where the other skin has a hole or a step opposite.
    double over_nearest(int v) const
    {
        const ClosestPoint near = nearest(v);
        return near.face < 0 ? within_ : std::abs((position_.col(v) - near.position).dot(normal(near.face)));
    }
    /// mm, of a vertex beside a skin itself: out of the plane of its nearest triangle, the way that
    /// the triangle looks; nothing where none is so near.
    std::optional<double> out_of_nearest(int v) const
    {
        const ClosestPoint near = nearest(v);
        return near.face < 0 ? std::nullopt : std::optional((position_.col(v) - near.position).dot(normal(near.face)));
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

    Eigen::Vector3d normal(int face) const
    {
        const auto corner = [&](int k) { return other_.position.col(other_.triangle(k, face)); };
        return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    }

    const Eigen::Matrix3Xd& position_;
    TriMesh other_;
    ClosestPointSearch search_;
    double within_; ///< mm
    std::vector<double> known_;
};

/// How far vertices of a solid are above a skin, outwards: by how far they are off the other skin;
/// where that has a broad step opposite, by the skin itself.
class HeightAboveSkin {
public:
    /// @param own_skin, other_skin  tell of a triangle whether it is one of that
    /// @param flipped  -1 if the triangles are seen from inside
    template <class Own, class Other>
    HeightAboveSkin(const TriMesh& mesh, const Own& own_skin, const Other& other_skin, double thickness, double flipped)
        : other_(mesh, other_skin, 2 * thickness), thickness_(thickness), flipped_(flipped)
    {
        for (int f = 0; f < mesh.triangles() && !own_; ++f)
            if (own_skin(f))
                own_.emplace(mesh, own_skin, broadest * thickness);
    }
    SheetHeights& over_other() { return other_; }

    /// mm
    double operator()(int v) const
    {
        return other_.nearest(v).face < 0 ? above_own(v) : other_.over_nearest(v) - thickness_;
    }
    /// mm, of a vertex of a floor that looks this way, unit
    double of_floor(int v, const Eigen::Vector3d& normal)
    {
        return other_.nearest(v).face < 0 ? above_own(v) : other_.square_to(v, normal) - thickness_;
    }

private:
    static constexpr double broadest = 10; // thicknesses: steps along a border are not broader
    SheetHeights other_;
    std::optional<SheetHeights> own_; ///< none: the skin has no triangle but those of marks
    double thickness_, flipped_;

    double above_own(int v) const
    {
        const std::optional<double> above = own_ ? own_->out_of_nearest(v) : std::nullopt;
        return flipped_ * above.value_or(thickness_);
    }
};

} // namespace spia

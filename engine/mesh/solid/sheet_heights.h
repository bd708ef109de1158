#pragma once
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
        : position_(mesh.position), search_(part_of(mesh, other_skin)), within_(within),
          known_(size_t(mesh.vertices()), -1)
    {
    }
    ClosestPoint nearest(int v) const { return search_.nearest(position_.col(v), within_); }
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
    ClosestPointSearch search_;
    double within_; ///< mm
    std::vector<double> known_;
};

} // namespace spia

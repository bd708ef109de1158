#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/mesh/soup.h"

namespace spia {

/// Normals of CAD faces at the corners of the triangles that were made of them. Triangles of a file
/// are its faces, numbered as in the soup.
class CornerNormals {
public:
    CornerNormals(const PolygonSoup& soup, const std::vector<std::array<Eigen::Vector3f, 3>>& normal)
        : soup_(soup), normal_(normal)
    {
    }

    /// Of the corner that is nearest to the place, on the side of `own`, the triangle's unit
    /// normal. `own` itself where the face has none, or is so much askew that the triangle has
    /// hardly a side.
    Eigen::Vector3d at(int triangle, const Eigen::Vector3d& place, const Eigen::Vector3d& own) const;

    /// Of a corner, likewise; nothing in these cases.
    std::optional<Eigen::Vector3d> at_corner(int triangle, int corner, const Eigen::Vector3d& own) const;

private:
    const PolygonSoup& soup_;
    const std::vector<std::array<Eigen::Vector3f, 3>>& normal_;
};

} // namespace spia

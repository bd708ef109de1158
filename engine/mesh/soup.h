#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace spia {

/// Polygons as a file gives them: nothing has been checked, joined, split or turned yet.
struct PolygonSoup {
    std::vector<Eigen::Vector3d> position; ///< #V, in the order of the file
    std::vector<int> corner;               ///< vertex indices of all polygons in a row; may be out
                                           ///< of range
    std::vector<int> first = {0};          ///< #P + 1; polygon p has the corners first[p] to
                                           ///< first[p + 1] - 1

    int vertices() const { return int(position.size()); }
    int polygons() const { return int(first.size()) - 1; }
    std::span<const int> polygon(int p) const
    {
        return std::span(corner).subspan(size_t(first[size_t(p)]), size_t(first[size_t(p) + 1] - first[size_t(p)]));
    }
    void add_polygon(std::span<const int> corners)
    {
        corner.insert(corner.end(), corners.begin(), corners.end());
        first.push_back(int(corner.size()));
    }
};

} // namespace spia

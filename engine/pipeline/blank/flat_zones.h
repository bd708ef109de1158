#pragma once
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// A plane CAD face of a part, or the part of a middle surface that stands for it, and where it
/// lies in the blank.
struct FlatZone {
    Eigen::Vector3d normal;           ///< unit
    double offset = 0;                ///< mm: places have normal.dot(place) = offset
    Eigen::Matrix<double, 2, 3> turn; ///< a rotation for places of the plane
    Eigen::Vector2d shift;

    bool has(const Eigen::Vector3d& place, double within) const
    {
        return std::abs(normal.dot(place) - offset) <= within;
    }
    /// Of a place, straight onto the plane.
    Eigen::Vector2d in_blank(const Eigen::Vector3d& place) const { return turn * place + shift; }
};

/// The zones of a part that its blank has as they are, moved but not strained.
class FlatZones {
public:
    FlatZones(const PartFile& part, const Blank& blank);

    /// mm, a millionth of the part: within it a zone is plane, and its blank the same.
    const double within;

    /// Of a triangle; null: none.
    const FlatZone* at(int face) const;
    /// The triangle that runs from one vertex to the other; -1: none.
    int face_beside(int a, int b) const;

private:
    std::vector<int> zone_; ///< per triangle the CAD face, -1: none
    std::map<int, FlatZone> of_face_;
    std::unordered_map<std::uint64_t, int> beside_; ///< a triangle by its directed edges at the
                                                    ///< border
};

} // namespace spia

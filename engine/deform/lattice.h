#pragma once
#include <Eigen/Core>
#include <array>

#include "engine/nurbs/multi_patch.h"

namespace spia {

/// A trivariate B-spline lattice around a surface, whose points are moved to bend the space within
/// [Sederberg & Parry 1986, there of Bernstein polynomials: what a degree of count - 1 gives]. Only
/// the displacements are blended: a lattice at rest moves nothing, to the last bit.
struct Lattice {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< mm, the corner of the box with
                                                        ///< parameters 0, 0, 0
    Eigen::Matrix3d edge = Eigen::Matrix3d::Identity(); ///< mm, columns: the three edges of the box
                                                        ///< from there
    std::array<int, 3> count = {2, 2, 2};               ///< lattice points along each edge, 2 to 64
    std::array<int, 3> degree = {1, 1, 1};              ///< 1 to min(count - 1, 5)
    Eigen::Matrix3Xd move;                              ///< mm, one per lattice point, first edge
                                                        ///< fastest

    int points() const { return count[0] * count[1] * count[2]; }
    int index(int i, int j, int k) const { return i + count[0] * (j + count[1] * k); }
    bool at_rest() const { return (move.array() == 0).all(); }

    friend bool operator==(const Lattice& a, const Lattice& b)
    {
        return a.origin == b.origin && a.edge == b.edge && a.count == b.count && a.degree == b.degree &&
               a.move.cols() == b.move.cols() && a.move == b.move;
    }
};

/// A lattice at rest in the box, along the axes, of all control points, a little larger. A flat
/// surface gets a box of a tenth of its size.
/// @param degree  along each edge; lowered to count - 1 where there are fewer points
/// @throws InputError if a count or degree is out of range, or there is no control point
Lattice lattice_around(const MultiPatch& surface, std::array<int, 3> count, std::array<int, 3> degree = {3, 3, 3});

/// @throws InputError if counts, degrees or the number of moves do not fit, the box has no volume
/// or something is not finite
void require_sound(const Lattice& lattice);

/// Where the lattice points stand at rest, at the Greville abscissae of their B-splines: moved
/// alike they move all the space alike. 3 by points(), mm
Eigen::Matrix3Xd rest_positions(const Lattice& lattice);

/// By how much a lattice moves places; a place outside its box moves as the nearest one inside
/// does.
class LatticeMap {
public:
    /// @throws InputError as require_sound()
    explicit LatticeMap(const Lattice& lattice);

    /// mm
    Eigen::Vector3d displacement(const Eigen::Vector3d& place) const;

private:
    const Lattice& lattice_;
    Eigen::Matrix3d to_box_;
    std::array<std::vector<double>, 3> knots_;
};

} // namespace spia

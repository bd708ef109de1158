#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/mesh/region.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// What is a bend and what a region. Lengths are counted in sides of the square that has the area
/// of the part.
struct BendLimits {
    double curvature = 8; ///< sheet that is curved more, over one side, bends: a radius below 1/8
                          ///< of the side
    double sharp = 0.35;  ///< radians: an edge between two regions that turns more is a sharp bend
    /// Of the part: a smaller region, or a bend that joins nothing, belongs to its neighbour; five
    /// times as much on a part that had to be smoothed.
    double least_area = 1e-3;
    /// Of the side: what is farther from the plane in which most of a region lies, and touches a
    /// bend, belongs to the bend; a region of another shape stays as it is.
    double off_plane = 8e-4;
};

/// A flat or gently curved piece of the part.
struct SheetRegion {
    int faces;
    double area;            ///< mm2
    double flatness;        ///< length of the mean normal, 0 to 1: 1 where it is plane
    Eigen::Vector3d normal; ///< unit, the mean one
    Eigen::Vector3d place;  ///< mm, of the region, near its middle: by it the region is found again
                            ///< on a changed part
};

/// A band of faces that turns quickly from one region to another, or the sharp edge between them.
struct Bend {
    int a, b;              ///< regions, a < b; b is -1 where it ends at the part's edge or lies
                           ///< within a
    int faces;             ///< 0: a sharp edge
    double area;           ///< mm2
    double angle;          ///< radians between the regions, above pi for more than a half turn;
                           ///< positive where the outer side bulges
    double radius;         ///< mm, mean, of the mesh as it is: of the middle of the sheet if that
                           ///< was meshed; 0: sharp
    double length;         ///< mm along the bend
    Eigen::Vector3d place; ///< mm, of the bend, near its middle
};

/// A part split at its bends.
struct BendMap {
    Eigen::VectorXi label;            ///< #F: below #regions a region, then bends (those with
                                      ///< faces)
    std::vector<SheetRegion> regions; ///< the largest first
    std::vector<Bend> bends;          ///< those with faces first, by area; then the sharp ones, by
                                      ///< length
    double side;                      ///< mm, square root of the area
    bool smoothed;                    ///< the part is a scan, say: its normals were smoothed before
    FaceSet faces_of(int label) const;
    double area_of(int label) const; ///< mm2

    int label_of_bend(size_t bend) const { return bends[bend].faces ? int(regions.size() + bend) : -1; }
    /// "region 3", "bend 1": counted from 1. @param label also of a sharp bend: #regions + its
    /// place in bends
    std::string name(int label) const;
};

/// Splits a part into regions and the bends between them. The result depends neither on the
/// numbering of vertices and faces (but for the order of equally large regions) nor on where the
/// part lies, how large it is or in what facets its flat pieces are cut.
/// @param part one component, no face without area, no edge of three faces
/// @throws InputError if it is not as described
BendMap find_bends(const TriMesh& part, const BendLimits& limits = {});

} // namespace spia

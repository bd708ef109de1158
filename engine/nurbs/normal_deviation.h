#pragma once
#include <functional>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/deviation.h"

namespace spia {

/// The normals of a mesh's faces, and which of them have a sharp edge.
struct MeshNormals {
    /// @param sharp_angle  radians between the normals of the two faces of an edge
    MeshNormals(const TriMesh& mesh, int part_faces, double sharp_angle);

    Eigen::Matrix3Xd normal; ///< 3 by #F, unit; zero for a face without area
    std::vector<char> sharp; ///< per face: one of its edges is
};

struct NormalSample {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< of the surface, unit; zero: there is none
    int face = -1;                                    ///< the nearest one; -1: does not count
    double weight = 0;                                ///< mm2
};

/// A surface that looks to the inner side on most of its area counts as turned round.
/// @param turned  gets the samples that look the other way than their face
NormalDeviation normal_deviation(const std::vector<NormalSample>& samples, const MeshNormals& mesh,
                                 const std::function<Eigen::Vector3d(int sample)>& position, std::vector<int>& turned,
                                 const Progress& progress = {});

} // namespace spia

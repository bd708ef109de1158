#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/surface.h"

namespace spia {

struct DeviationOptions {
    int samples_per_span = 4; ///< of the surface, in each direction; the borders of the spans are
                              ///< always sampled
    /// The part's faces are the mesh's first ones, faces after them fill its holes: what the
    /// surface does there is no deviation. -1: all faces are the part's.
    int part_faces = -1;
    /// Parameters at which the surface was interpolated (InterpolateResult::u and v). Between them,
    /// in the middle, an interpolant is farthest from having no error by construction. Empty:
    /// Deviation::between_data stays empty.
    std::vector<double> data_u = {}, data_v = {};
    /// mm; Deviation::beyond lists what is farther, DeviationStatistics::within says how much is
    /// not
    double tolerance = std::numeric_limits<double>::infinity();
    double listed_from = 1;      ///< share of the tolerance from which on samples are listed
    double sharp_angle = 0.35;   ///< radians between the faces of an edge from which on it is
                                 ///< sharp: about 20 degrees
    bool mesh_to_surface = true; ///< false leaves this way out, and at_vertex: quicker
};

/// Distances of many sampled places, each weighted with the area it stands for. All zero if there
/// is no sample.
struct DeviationStatistics {
    int samples = 0;                                 ///< that count
    int excluded = 0;                                ///< that do not, since they lie where a hole
                                                     ///< was filled
    double max = 0;                                  ///< mm
    double rms = 0;                                  ///< mm
    double mean = 0;                                 ///< mm
    double p95 = 0;                                  ///< mm; on 95 % of the area the distance is
                                                     ///< not larger
    double within = 0;                               ///< share of the area not farther than the
                                                     ///< tolerance, 0 to 1
    Eigen::Vector3d where = Eigen::Vector3d::Zero(); ///< mm, the sample with the largest distance
};

/// Where a surface and a part are farthest from each other.
struct GreatestDeviation {
    double max = 0;                                  ///< mm
    Eigen::Vector3d where = Eigen::Vector3d::Zero(); ///< mm, on either
};

/// Angles between the normals of a surface and of the faces that are nearest to it, radians,
/// weighted with the area. All zero if there is no sample.
struct NormalDeviation {
    int samples = 0;
    double mean = 0;
    double p95 = 0;        ///< on 95 % of the area the angle is not larger
    double max = 0;        ///< at sharp edges about half the angle between their faces, at the best
    double max_smooth = 0; ///< over the faces without a sharp edge
    double turned = 0;     ///< share of the area where the surface looks the other way than the
                           ///< part: it folds
    Eigen::Vector3d where = Eigen::Vector3d::Zero(); ///< mm, the sample of max_smooth
};

/// A sample that is farther away than the tolerance (or a share of it,
/// DeviationOptions::listed_from).
struct BeyondTolerance {
    double u, v;     ///< of the surface: the sample, or the foot of a place of the mesh
    double distance; ///< mm
};

/// How far a surface and the mesh it stands for are from each other.
struct Deviation {
    DeviationStatistics surface_to_mesh; ///< samples of the surface to the nearest place of the
                                         ///< mesh
    DeviationStatistics mesh_to_surface; ///< the part's vertices, edge and face midpoints to the
                                         ///< nearest of the surface
    DeviationStatistics between_data;    ///< the surface in the middle between the data, to the
                                         ///< mesh
    NormalDeviation normal;              ///< of the samples of the surface
    std::vector<BeyondTolerance> beyond; ///< both ways, those of the surface first
    std::vector<BeyondTolerance> turned; ///< samples of the surface that look the other way than
                                         ///< the part
    /// Per vertex of the mesh, those of filled holes too: distance to the surface, mm; positive
    /// where the surface runs on the outer side of the part.
    Eigen::VectorXd at_vertex;

    /// The way that has the greatest distance.
    const DeviationStatistics& worse() const
    {
        return surface_to_mesh.max >= mesh_to_surface.max ? surface_to_mesh : mesh_to_surface;
    }
    /// The smaller share of both ways.
    double within() const { return std::min(surface_to_mesh.within, mesh_to_surface.within); }

    /// The larger of both ways (Hausdorff distance, as far as the samples show it), mm.
    double max() const { return std::max(surface_to_mesh.max, mesh_to_surface.max); }
};

/// Measures both ways; only the distance counts, not the parameters.
/// @param mesh      the part, or the part with its holes filled (see DeviationOptions::part_faces)
/// @param progress  a checkpoint every few 10 000 samples
/// @throws InputError if the mesh has no face or coordinates that are not numbers, or an option is
/// out of range The result does not depend on the number of threads. [theory.md 5;
/// exchange-and-iga.md 4]
Deviation deviation(const NurbsSurface& surface, const TriMesh& mesh, const DeviationOptions& options = {},
                    const Progress& progress = {});

} // namespace spia

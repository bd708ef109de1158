#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/core/attempts.h"
#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/curve_ends.h"
#include "engine/nurbs/deviation.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// Where the points of a fit come from.
struct FitSource {
    /// The points at u x v, u fastest, mm; for parameters rising from 0 to 1.
    std::function<Eigen::Matrix3Xd(const std::vector<double>& u, const std::vector<double>& v)> at;
    std::vector<double> lines_u = {}, lines_v = {}; ///< the only parameters at which it is known;
                                                    ///< empty: any
};

/// The nodes of a grid at even parameters, and no others.
FitSource source_of(const QuadGrid& lifted);

enum class FitParameters {
    blank,    ///< a point keeps its place in the blank: (u, v) of the surface are those of the grid
    corrected ///< points slide over the part to where the surface is nearest: closer with fewer
              ///< knots, but (u, v) no longer are places of the blank [Hoschek 1988]
};

struct FitOptions {
    double tolerance = 0.1;         ///< mm, two-sided
    int degree_u = 3, degree_v = 3; ///< 2 to 5
    CurveEnds ends = CurveEnds::averaged_knots;
    FitParameters parameters = FitParameters::blank;
    int max_control_points = 100'000;
    int part_faces = -1;               ///< see DeviationOptions
    std::vector<int> file_number = {}; ///< per vertex of the part its number in messages; empty: as
                                       ///< in the mesh
};

/// Why a surface stayed farther away than the tolerance.
struct FitShortfall {
    enum class Reason {
        none,
        sharp_edge,     ///< of the mesh: a smooth surface rounds it
        outline_corner, ///< of the part's border: a smooth border curve rounds it
        data,           ///< the points ran out: a finer grid is needed
        control_points  ///< there were not enough for the tolerance
    };
    Reason reason = Reason::none;
    int a = -1, b = -1; ///< vertices of the mesh: the edge; at a corner only a
    double angle = 0;   ///< radians: between the normals of the two faces, or the outline's turn
    Eigen::Vector3d where = Eigen::Vector3d::Zero(); ///< mm, the place of the largest deviation
    std::string text;                                ///< what it is and what to do, for a person;
                                                     ///< empty for none
};

/// How a fit went.
struct FitReport {
    double tolerance = 0;         ///< mm
    bool reached = false;         ///< at all samples of both ways
    int rounds = 0;               ///< fits that were measured
    int knots_u = 0, knots_v = 0; ///< inserted: inner knots
    FitShortfall shortfall;
    std::vector<AttemptReport> attempts = {}; ///< how it was found
};

struct FitResult {
    NurbsSurface surface;     ///< weights 1; inner knots single
    std::vector<double> u, v; ///< parameters of the last data
    Deviation deviation;      ///< two-sided; `within` and `beyond` by the tolerance
    FitReport report;
};

/// A least squares surface within a tolerance of the part. It begins with a single span (two or
/// four if ends are asked for); spans in which a sample of either way is too far from the part are
/// halved, along u, v or both, by what least squares along one direction alone leaves there; so
/// until no sample is left. The four border curves are fitted first and held. Spans that turn out
/// finer than they need be are joined again, and of a surface of up to 4000 control points shared
/// out evenly by how it changes (equidistributed_spans()); with corrected parameters knots are left
/// out one by one as well (KnotRemoval). [exchange-and-iga.md 5; NURBS Book, A9.7]
/// @param mesh  the part, or the part with its holes filled: what the deviation is measured from
/// @throws InputError  if an option is out of range or the source gives something else than points
FitResult fit(const FitSource& source, const TriMesh& mesh, const FitOptions& options = {},
              const Progress& progress = {});

} // namespace spia

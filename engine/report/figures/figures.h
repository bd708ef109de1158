#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/mesh/flat/distortion.h"
#include "engine/pipeline/session.h"

/// The figures of a result as a whole, each computed here and nowhere else: JSON, terminal, reports
/// and panels render them. Looking at all vertices or faces takes time, so they are made once per
/// result.
namespace spia {

/// Of any part, also of one that is refused.
struct PartFigures {
    Eigen::Vector3d size{0, 0, 0}; ///< mm, along the axes
    double diagonal = 0;           ///< mm
};
PartFigures part_figures(const PartFile& part);

/// Of a part that can be unfolded.
struct SurfaceOfPart {
    int boundary_loops = 0; ///< the outline and the holes
    double area = 0;        ///< mm2
};
SurfaceOfPart surface_of_part(const PartFile& part);

struct BlankSize {
    Eigen::Vector2d low{0, 0}, high{0, 0}; ///< mm, the box around it
    double area = 0;                       ///< mm2; flipped faces count below 0
    double perimeter = 0;                  ///< mm, of the outer loop

    Eigen::Vector2d sides() const { return high - low; } ///< mm
};
BlankSize blank_size(const TriMesh& part, const Blank& blank);

/// Least and greatest values over the faces.
struct SheetFigures {
    std::array<double, 2> thinning{}, strain_major{}, strain_minor{};
    std::array<double, 2> thickness{}; ///< mm
    double strain_equivalent = 0;      ///< greatest
};
SheetFigures sheet_figures(const SheetFields& face);
/// Of some faces, say those that a step has moved; none: all is 0.
SheetFigures sheet_figures(const SheetFields& face, const std::vector<int>& faces);
/// For people: thinning and strains that are noise() are 0.
SheetFigures without_noise(SheetFigures figures);

/// mm, on the blank; of its cells GridResult::quality tells.
std::array<double, 4> side_lengths(const GridStage& grid, const Blank& blank);

/// Of one surface, or of all patches together.
struct SurfaceFigures {
    int patches = 1, joints = 0;
    int control_points = 0; ///< those that patches share count once
    int singular_nodes = 0; ///< see singular_nodes() of patches
    /// mm, of both ways the greater: from the surface to the part, from the part to the surface.
    double deviation_max = 0, deviation_rms = 0, deviation_p95 = 0;
};
SurfaceFigures surface_figures(const SurfaceStage& surface);

/// How fit the surface is for analysis.
struct CertificateFigures {
    double least_scaled = 1;   ///< scaled Jacobian over all patches
    size_t patch = 0;          ///< the one with it, from 0
    double greatest_angle = 0; ///< radians, between the normals of patches where they meet
};
CertificateFigures certificate_figures(const Certificate& certificate);

/// Of one of several patches.
struct PatchFigures {
    size_t patch = 0;     ///< from 0
    bool refused = false; ///< not proved to be without folds
    double least_scaled = 1, mean_scaled = 1;
    GreatestDeviation deviation;
    int control_points = 0; ///< with those that it shares
};
std::vector<PatchFigures> patch_figures(const PatchesFit& fit, const Certificate& certificate);

/// What patches are ordered by.
enum class PatchMeasure { number, least_scaled, mean_scaled, deviation, control_points };

/// The worst first: those that are refused, then by rising scaled Jacobian; by falling deviation or
/// count of control points; by rising number. Equal ones stay in their order.
std::vector<PatchFigures> worst_first(std::vector<PatchFigures> patches, PatchMeasure measure);

/// All that is told of a session that is solved at least; nothing of what it has not.
struct ResultFigures {
    SurfaceOfPart part;
    BlankSize blank;
    SheetFigures sheet;
    Distortion distortion;
    std::optional<SurfaceFigures> surface;
    std::optional<CertificateFigures> certificate; ///< of the deformed surface, where it is
                                                   ///< deformed
};
ResultFigures result_figures(const Session& session);

} // namespace spia

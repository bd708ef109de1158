#pragma once
#include <optional>

#include "engine/core/attempts.h"
#include "engine/layout/patch_grids.h"
#include "engine/nurbs/fit.h"
#include "engine/nurbs/multi_patch.h"

namespace spia {

struct PatchesFitOptions {
    double tolerance = 0.1;           ///< mm, two-sided
    int degree = 3;                   ///< 2 to 5, of all patches along u and v
    int max_control_points = 200'000; ///< of all patches
    int most_rounds = 16;
    bool smooth_joins = false; ///< of blank_patches(): take the angles out of the joins, see
                               ///< smooth_fit()
    PatchGridOptions grid = {};
};

/// What became of the angles at which patches join.
struct JoinsReport {
    double angle_before = 0, angle_after = 0; ///< radians, the greatest where there is no edge of
                                              ///< the part
    int places = 0, edges = 0;                ///< looked at, and how many of these are edges of the
                                              ///< part: they stay
    int kept = 0; ///< patches that stay as they were: smooth, they would be worse, see smooth_fit()
};

/// How far patches and part are from each other, and how the fit went.
struct PatchesFit {
    MultiPatch patches;                             ///< watertight: shared sides are the same to the last bit
    Layout layout;                                  ///< patch by patch
    DeviationStatistics surface_to_mesh;            ///< samples of all patches to the nearest place of the
                                                    ///< part
    DeviationStatistics mesh_to_surface;            ///< vertices, edge and face middles of the part to the
                                                    ///< nearest place of the patches
    Eigen::VectorXd at_vertex;                      ///< mm, per vertex of the part; positive where the patches
                                                    ///< run on its outer side
    std::vector<GreatestDeviation> patch_deviation; ///< per patch, of both ways
    bool reached = false;                           ///< the tolerance, at all samples
    int rounds = 0;
    /// Of fit_patches() the grids of patches that were not found at once, of blank_patches() the
    /// layouts, which have these within.
    std::vector<AttemptReport> attempts = {};
    std::optional<JoinsReport> joins = {};     ///< where they were to be smooth
    std::vector<std::vector<double>> u, v;     ///< per patch the parameters of the data
    std::vector<std::vector<MeshPoint>> place; ///< per patch where on the part the data lie, u
                                               ///< fastest

    double deviation_max() const { return std::max(surface_to_mesh.max, mesh_to_surface.max); }
};

/// Lifts the patches of a layout to the part and fits them within a tolerance: first every curve,
/// once, then the patches that hold their four curves. Knots are added to whole strips (Chords), so
/// that refinement stays conforming.
/// @throws InputError if the options are out of range or a patch has no grid without folds
PatchesFit fit_patches(const TriMesh& part, const Blank& blank, const Layout& layout,
                       const PatchesFitOptions& options = {}, const Progress& progress = {});

/// Layout and fit: simplified layouts first (see simplify_layout(); not where the user gave
/// corners). Where a patch has no grid without folds, is not proved to be free of them or stays
/// beyond the tolerance, the blank is divided in other ways, and the best fit is taken: as few
/// patches as lines alone make, layers along the border, vertices closer together, each along the
/// edges of the part and without them, and along flatter ones; then every face divided. Of two that
/// have it all the one with fewer control points.
/// @throws InputError as make_layout() and fit_patches()
PatchesFit blank_patches(const TriMesh& part, const Blank& blank, const LayoutOptions& layout = {},
                         const PatchesFitOptions& options = {}, const Progress& progress = {});

} // namespace spia

#pragma once
#include <string>
#include <vector>

#include "engine/forming/flatten.h"
#include "engine/mesh/flat/distortion.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// What a blank is judged by.
struct BlankFigures {
    bool converged;        ///< every step, or the solver of the whole part
    double strain;         ///< greatest equivalent one over the faces
    double least_thinning; ///< over the faces; negative where the sheet got thicker
    double most_thinning;
    int flipped;  ///< triangles
    int overlaps; ///< places where the blank lies on itself, see Overlap
    Distortion distortion;
};

/// The multi-step blank and what the solver of the whole part makes of it.
struct PolishedBlank {
    FlattenResult whole; ///< its blank lies on the multi-step one as nearly as it can, area by area
    BlankFigures steps, polished;
    double outline_distance_mm;      ///< greatest of a vertex of either outline from the other
                                     ///< outline
    double outline_distance_mean_mm; ///< mean over the vertices of both outlines
    std::vector<std::string> worse;  ///< in what the polished blank is worse than that of the
                                     ///< steps; empty: in nothing
};

/// Solves the whole part at once, started from the blank that its steps gave. The steps held each
/// region in its turn; now all material may move. Both blanks are kept: neither is the true one
/// where the part was made in several hits.
/// @param run     of this part
/// @param options those of the run
/// @throws InputError if the run gave no blank, or one with flipped triangles; SolveError as
/// flatten()
PolishedBlank polish(const TriMesh& part, const UnfoldRun& run, const FlattenOptions& options,
                     const Progress& progress = {}, const StepWatch& watch = {});

} // namespace spia

#pragma once
#include <string>

#include "engine/forming/flatten.h"
#include "engine/part/read_options.h"

namespace spia {

/// What came of a shape between the doctor and the blank.
struct ShapeRun {
    enum class End {
        blank,   ///< a valid one: see `invalid`
        refusal, ///< an InputError: what the user has to do is known
        failure  ///< anything else: no start, an error of the program, a blank that is none
    };
    End end = End::failure;
    std::string why;    ///< of a refusal or a failure, in words
    int triangles = 0;  ///< after the repairs
    double seam_mm = 0; ///< 0: not cut
    double seconds = 0; ///< of flatten()
    SolvedSystem system = SolvedSystem::energy;
    double process_share = 1;            ///< of the forces that are in the blank
    std::vector<AttemptReport> attempts; ///< at the blank
    double most_strain = 0;              ///< equivalent, over the faces
    int crossings = 0, wound = 0;        ///< of the blank with itself
};

/// Examines, cuts and unfolds a part in memory or from a file, and looks at the blank with other
/// eyes than the solver's: exact orientation, finite and positive numbers, the volume of every
/// face. Never throws.
ShapeRun run_shape(const PolygonSoup& soup, const ReadOptions& options, const FlattenOptions& flattening);
ShapeRun run_shape(const std::filesystem::path& file, const ReadOptions& options, const FlattenOptions& flattening);

} // namespace spia

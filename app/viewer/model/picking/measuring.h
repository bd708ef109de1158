#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/state.h"
#include "engine/core/length_unit.h"
#include "engine/mesh/region.h"

namespace spia::viewer {

/// What is measured on: the part, its blank, the quad mesh or the surface, as triangles. Null where
/// there is none. Faces of part and blank are those of the part.
std::shared_ptr<const TriMesh> measured_mesh(const ViewerState& state, View on);
/// Whether its faces stay the same when it is computed again.
inline bool keeps_faces(View on) { return on == View::part || on == View::blank; }

/// What a measurement has found.
struct Measured {
    double value = 0;               ///< mm, or degrees
    std::optional<double> residual; ///< mm, greatest distance of the sheet from the cylinder or the
                                    ///< curved face through it
    struct Figure {
        std::string name;
        std::vector<double> mm; ///< lengths; empty: the words are all
        std::string words = {};
    };
    std::vector<Figure> more;                        ///< further figures
    std::vector<Eigen::Matrix3Xd> line;              ///< polylines that show it, mm
    Eigen::Vector3d label = Eigen::Vector3d::Zero(); ///< where its text stands, mm
};

/// Measures on the part.
/// @param regions  of the part; only a rounding needs it
/// @throws InputError  why there is nothing to measure there, and what to do instead
Measured measured(const TriMesh& part, const Measurement& measurement, const RegionSearch* regions = nullptr);

/// "R 5.02 mm", "90.00 deg": of a measurement of a document.
std::string text_of(const Measurement& measurement, LengthUnit unit);
std::string text_of(const Measured::Figure& figure, LengthUnit unit);

/// Measures all of a document anew on its part and blank, which have other coordinates now; what is
/// not possible any more goes, and what was measured on a quad mesh or a surface, whose faces are
/// others then.
void measure_again(Document& document);
/// Likewise after a run, only what is of results that are others than before.
void measure_again(Document& document, const Session& before);

/// The straight distance on the blank of what a distance on the part was measured between.
std::optional<double> on_blank(const Session& session, const Measurement& measurement);

const char* title(MeasureKind kind);  ///< "Distance", ...
const char* advice(MeasureKind kind); ///< what is to be clicked

} // namespace spia::viewer

#pragma once
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/document/state.h"
#include "engine/mesh/closest_point.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/figures/figures.h"

namespace spia::viewer {

/// Remembers the last thing that was made and what of. Session results in the key are shared
/// pointers: as long as the memo holds one, its address cannot become that of another result.
template <class Value, class... From> class Memo {
public:
    /// @param make  from what the key says, if it is not the key of the last time
    template <class Make> const Value& of(std::tuple<From...> from, const Make& make)
    {
        if (!value_ || *from_ != from) {
            value_ = make();
            from_ = std::move(from);
        }
        return *value_;
    }

private:
    std::optional<std::tuple<From...>> from_;
    std::optional<Value> value_;
};

/// The part as it is drawn.
struct PartShape {
    std::shared_ptr<const SceneMesh> mesh;
    Eigen::AlignedBox3d box;                             ///< mm
    Eigen::Matrix<uint32_t, 2, Eigen::Dynamic> boundary; ///< 2 by #edges
};

/// The part laid out in the plane.
struct FlatShape {
    std::shared_ptr<const SceneMesh> mesh;
    Eigen::AlignedBox3d box;   ///< mm, z = 0
    Eigen::Matrix3Xd position; ///< 3 by #V, mm, z = 0
};

/// A field of the sheet.
struct FieldValues {
    Eigen::VectorXd drawn; ///< per vertex or face of the part: what is coloured
    FaceValues said;       ///< what the labels and the ends of the legend say
};

/// Picked vertices.
struct VertexShape {
    std::shared_ptr<ScenePoints> dots;                   ///< null: none
    std::vector<std::shared_ptr<const SceneLines>> line; ///< between two
};

using LineList = std::vector<std::shared_ptr<const SceneLines>>;

/// What a later stage of the chain looks like.
struct StageShape {
    std::vector<SceneLayer> layers;
    LineList lines;
    std::vector<std::shared_ptr<const ScenePoints>> points;
    Eigen::AlignedBox3d box; ///< mm
};

/// Drawbeads and pilots.
struct LineShapes {
    LineList lines;
    std::vector<std::shared_ptr<const ScenePoints>> points; ///< of single pins
};

/// Where the blank lies on itself.
struct OverlapShape {
    LineList lines;
    std::shared_ptr<ScenePoints> dots;  ///< null: none
    std::vector<Eigen::Vector3d> place; ///< mm, of what has a name
};

/// What is shown on the sheet, once for the part and once for the blank.
struct SheetCache {
    using Mesh = std::shared_ptr<const SceneMesh>;
    using Part = std::shared_ptr<const PartFile>;
    using Blank = std::shared_ptr<const FlattenResult>;
    using Limits = std::shared_ptr<const LimitsResult>;
    using Surface = std::shared_ptr<const SurfaceStage>;

    Memo<std::shared_ptr<const SceneField>, Mesh, Part, Blank, Limits, Surface, Field, bool> field;
    Memo<std::shared_ptr<const std::vector<Isoline>>, std::shared_ptr<const SceneField>, float, float, int> isolines;
    Memo<LineList, Mesh, std::vector<FaceRegion>> regions;
    Memo<LineShapes, Mesh, Part, std::vector<ProcessLine>> process_lines;
    Memo<std::vector<SceneLabel>, Mesh, std::vector<FaceRegion>, bool, LengthUnit> region_labels;
    Memo<LineList, Part, Blank, double> glyphs;
    Memo<LineList, Mesh, std::vector<int>> selection;
};

/// The part as its steps have unfolded it.
struct UnfoldedShape {
    std::shared_ptr<const SceneMesh> mesh;
    Eigen::Matrix3Xd position; ///< 3 by #V, mm
};

/// What is shown of unfolding step by step.
struct StepsCache {
    using Mesh = std::shared_ptr<const SceneMesh>;
    using Run = std::shared_ptr<const StepsRun>;
    using Step = std::shared_ptr<const PlannedStep>;

    Memo<UnfoldedShape, Mesh, Run, double> shape;
    Memo<Eigen::AlignedBox3d, Mesh, Run, size_t> box; ///< mm, around all states
    Memo<std::vector<FaceRegion>, Step> picks;        ///< its fixed and its freed faces
    Memo<std::shared_ptr<const FaceMarks>, Mesh, Step, std::vector<int>> marks;
    Memo<LineList, Mesh, Step> borders;
    Memo<std::vector<SceneLabel>, Mesh, Step, bool> labels;
    Memo<Mesh, Run, size_t> target;
    Memo<Mesh, Mesh, Run, Step, size_t> target_to_be;
    Memo<FieldValues, Run, size_t, Field, bool> values;
    Memo<std::shared_ptr<const SceneField>, Mesh, Run, size_t, Field, bool> field;
    Memo<LineList, Mesh, std::vector<int>> selection;
    Memo<VertexShape, Mesh, std::vector<int>, bool> vertices;
};

/// What the scenes of a window have in common and what they are made of, so that nothing is made
/// again in each frame. One per window.
struct SceneCache {
    using Part = std::shared_ptr<const PartFile>;
    using Blank = std::shared_ptr<const FlattenResult>;
    using Grid = std::shared_ptr<const GridStage>;
    using Lifted = std::shared_ptr<const LiftResult>;
    using Limits = std::shared_ptr<const LimitsResult>;
    using Surface = std::shared_ptr<const SurfaceStage>;
    using Deformed = std::shared_ptr<const DeformedSurface>;
    using LiveBlank = std::shared_ptr<const Eigen::Matrix2Xd>;

    using Vertices = Memo<VertexShape, std::shared_ptr<const SceneMesh>, std::vector<int>, bool>;

    Memo<PartShape, Part> part;
    Memo<FlatShape, Part, Blank, LiveBlank> flat;
    Memo<FieldValues, Part, Blank, Limits, Surface, Field, bool> values;
    SheetCache on_part, on_blank;
    StepsCache steps;
    Memo<std::shared_ptr<const FaceMarks>, Part, std::vector<int>, std::vector<FaceRegion>> marks;
    Memo<LineList, std::shared_ptr<const SceneMesh>, std::vector<int>> selection_elsewhere;
    Memo<std::vector<std::vector<ClosestPoint>>, Part, std::vector<ProcessLine>> line_places;
    Vertices vertices_on_part, vertices_on_blank;
    /// by View
    std::array<Memo<StageShape, std::vector<std::shared_ptr<const Measured>>, bool>, 4> measurements;
    Memo<std::optional<std::array<int, 4>>, Part, std::array<int, 4>> chosen_corners;
    Memo<std::optional<std::array<int, 4>>, Part, Blank> proposed_corners;
    Memo<LineList, std::shared_ptr<const SceneMesh>, bool> outline;
    Memo<LineList, std::shared_ptr<const Differences>> reference_outline;
    Memo<LineList, std::shared_ptr<const SceneMesh>, Grid> sides;
    Memo<OverlapShape, Blank> overlap;
    Memo<LineList, std::shared_ptr<const BendTable>> bends;
    Memo<StageShape, Grid, bool> planar_grid;
    Memo<StageShape, Grid, Lifted, bool> quads;
    Memo<LineList, Part> boundary_on_quads;
    using Net = std::shared_ptr<const MultiPatch>;
    Memo<Net, Surface, Deformed> net;
    Memo<StageShape, Part, Grid, Net, SurfaceLook, double, LengthUnit> surface;
    Memo<StageShape, Surface> patch_mesh;
    Memo<LineList, Surface, bool> patch_lines;
    Memo<double, Net> net_spacing; ///< mm
    Memo<StageShape, Net, bool, double> control_net;
    Memo<StageShape, Part> refused;
};

} // namespace spia::viewer

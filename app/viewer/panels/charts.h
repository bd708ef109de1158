#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "app/viewer/model/picking/section.h"
#include "app/viewer/model/reports/point_cloud.h"
#include "app/viewer/views/scene_cache.h"
#include "engine/report/figures/crack_verdict.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/figures/figures.h"
#include "engine/report/figures/statistics.h"

namespace spia::viewer {

struct Frame;

/// What the lists and the histogram of a field are made of; without a field all is empty.
struct Figures {
    FaceValues face;
    Eigen::VectorXd at_vertex; ///< the smooth field
    Histogram histogram;       ///< of the faces
    std::vector<int> worst;    ///< faces
};

/// What the charts show, made anew only when that changes.
struct Charts {
    using Blank = std::shared_ptr<const FlattenResult>;
    using Limits = std::shared_ptr<const LimitsResult>;
    using Surface = std::shared_ptr<const SurfaceStage>;
    Memo<Figures, Blank, Limits, Surface, Field> figures;
    Memo<std::vector<SectionPiece>, std::shared_ptr<const PartFile>, Blank, Limits, Surface, Field,
         std::optional<SectionLine>, bool>
        section, section_elsewhere;
    Memo<PointCloud, Blank, Limits, int, int> strains;
    Memo<PartFigures, std::shared_ptr<const PartFile>> part, refused;
    Memo<BlankSize, std::shared_ptr<const PartFile>, Blank> blank;
    Memo<SheetFigures, Blank> sheet;
    Memo<SurfaceFigures, Surface> surface;
    Memo<std::array<double, 4>, std::shared_ptr<const GridStage>, Blank> sides;
    Memo<CrackVerdict, Blank, Limits, LengthUnit> cracks;
};

/// Of the results there are; the part, the blank, the grid, the surface must be there.
const PartFigures& part_figures(Frame& frame);
/// Of the one that the mesh doctor's panel is about.
const PartFigures& examined_figures(Frame& frame);
const BlankSize& blank_size(Frame& frame);
const SheetFigures& sheet_figures(Frame& frame); ///< without_noise()
const SurfaceFigures& surface_figures(Frame& frame);
const std::array<double, 4>& side_lengths(Frame& frame);
/// Whether the sheet will crack.
const CrackVerdict& crack_verdict(Frame& frame);

/// A place of the section plot under the mouse, to be marked in the views.
struct SectionMark {
    SectionPlace place;
    int frame = 0; ///< of ImGui, in which the mouse was there: the views of the next one show it
};

/// Of the field that is shown.
const Figures& figures(Frame& frame);

/// The cut along the section line that was drawn, with the field shown; empty: there is none.
const std::vector<SectionPiece>& section_of(Frame& frame);
/// The same pieces as a view shows them: on the part, or on the blank.
const std::vector<SectionPiece>& section_in(Frame& frame, View view);

/// The field along the section line.
void section_plot(Frame& frame);

/// The forming limit curve, its margins, the zones of the sheet and their worst spots.
void limits_section(Frame& frame);

/// Major over minor strain, a point per face; a click selects the face of a point, a dragged box
/// those in it.
void strain_diagram(Frame& frame);

} // namespace spia::viewer

#pragma once
#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/coons/cell_quality.h"
#include "engine/coons/quad_grid.h"
#include "engine/core/attempts.h"
#include "engine/core/progress.h"
#include "engine/forming/blank.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/options/described.h"
#include "engine/options/surface_options.h"

namespace spia {

enum class GridMethod {
    automatic, ///< the first of the others that folds no cell
    coons,     ///< the Coons patch, smoothed if it folds: as the paper has it, folded or not
    harmonic,  ///< the harmonic map, untangled if it folds
};

struct GridOptions {
    int columns = 0;    ///< cells along u; 0: `cells` on the longer pair of sides, square cells on
                        ///< the other
    int rows = 0;       ///< cells along v; 0 likewise
    int cells = 40;     ///< on the longer sides, where columns or rows is 0
    int smoothing = 50; ///< the most Laplacian sweeps over a Coons patch that folds
    GridMethod method = GridMethod::automatic;
    double line_grading = 0; ///< share of the lines that go where the part bends, 0 to
                             ///< 0.9: see grade_lines()
    bool even_cells = false; ///< right angles and even sizes inside, where the grid stays
                             ///< sound: see even_cells()

    friend bool operator==(const GridOptions&, const GridOptions&) = default;
};

template <>
inline constexpr auto described<GridOptions> = std::tuple{
    describe(option::columns, &GridOptions::columns),      describe(option::rows, &GridOptions::rows),
    describe(option::cells, &GridOptions::cells),          describe(option::smoothing, &GridOptions::smoothing),
    describe(option::grid_method, &GridOptions::method),   describe(option::line_grading, &GridOptions::line_grading),
    describe(option::even_cells, &GridOptions::even_cells)};

/// Which way the grid came about.
enum class GridRoute { coons, smoothed_coons, harmonic, area_balanced, untangled, spiral };
std::string_view name(GridRoute route);

/// A planar quad grid that fills the blank, and where each of its nodes lies on the part.
struct GridResult {
    QuadGrid planar; ///< in the plane of the blank, z = 0; the border nodes lie on the outline
    GridRoute route = GridRoute::coons;
    CellQuality quality;     ///< no folded cell but with GridMethod::coons
    int nodes_outside = 0;   ///< not on the blank or on two layers of it; 0 but with
                             ///< GridMethod::coons
    int refinements = 0;     ///< how often an automatic cell count was doubled to get there
    double line_grading = 0; ///< share of the lines that went there; less than asked for where
                             ///< cells would have folded
    bool no_bends = false;   ///< lines were to go there, but it sees none between its nodes
    bool evened = false;     ///< inside; not, though asked for, where nodes would have left the
                             ///< blank
    /// Per side, counter-clockwise, the chord-length parameters of its border nodes: from 0 to 1,
    /// rising.
    std::array<Eigen::VectorXd, 4> border;
    std::vector<MeshPoint> place;             ///< per node, on filled->mesh; face -1 if it is
                                              ///< outside
    std::shared_ptr<const FilledMesh> filled; ///< part and blank with their holes closed
    std::vector<AttemptReport> attempts = {}; ///< how it was found
};

/// Fills the blank with columns x rows quads between its four sides. The border nodes divide the
/// sides evenly by length. Inside: bilinearly blended Coons patch (eq. 25); if a cell folds or a
/// node misses the blank, Laplacian smoothing; then the harmonic map of the blank onto the unit
/// square, inverted at the grid nodes; then untangling, from the harmonic map or from one that
/// gives lobes their area (area_balanced_map()), on a finer grid if the cell counts are automatic;
/// last spiral_grid(), on up to 640 x 640 cells if they are. Holes of the part are filled for this.
/// A sound grid is then adapted as the options ask.
/// @param boundary of the same blank, see split_boundary()
/// @param file_number  per vertex of the part its number in messages; empty: as in the mesh
/// @throws InputError if every way folds a cell; the message says at which corner, and what to
/// choose instead;
///         also if the part is not one piece without handles
GridResult coons_grid(const TriMesh& part, const Blank& blank, const BlankBoundary& boundary,
                      const GridOptions& options = {}, const Progress& progress = {},
                      std::span<const int> file_number = {});

} // namespace spia

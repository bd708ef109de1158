#include "engine/layout/patch_grids.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/mesh_polygon.h"
#include "engine/options/surface_options.h"

namespace spia {

namespace {

/// Per strip, by its longest curve.
std::vector<int> cells_of_strips(const Layout& layout, const Chords& chords, int cells)
{
    double sheet = 0;
    for (const LayoutPatch& patch : layout.patch)
        sheet += area(layout, patch);
    const double width = std::sqrt(sheet / double(layout.patch.size()));
    std::vector<double> longest(size_t(chords.strips), 0);
    for (size_t c = 0; c < layout.curve.size(); ++c) {
        double& here = longest[size_t(chords.strip[c])];
        here = std::max(here, length(layout.curve[c]));
    }
    std::vector<int> result;
    for (const double l : longest)
        result.push_back(std::clamp(int(std::lround(cells * l / width)), 8, 64));
    return result;
}

/// The polygon with straight sides bent outwards by next to nothing: rows of points on a line have
/// no triangles.
PatchPolygon bulged(PatchPolygon polygon)
{
    constexpr double height = 1e-7; // over the length of the side
    const int n = int(polygon.point.cols());
    const Eigen::Matrix2Xd flat = polygon.point;
    for (size_t k = 0; k < 4; ++k) {
        const int first = polygon.corner[k], count = (polygon.corner[(k + 1) % 4] - first + n) % n;
        const Eigen::Vector2d chord = flat.col((first + count) % n) - flat.col(first);
        for (int i = 1; i < count; ++i) {
            const double s = double(i) / count;
            polygon.point.col((first + i) % n) += height * 4 * s * (1 - s) * Eigen::Vector2d(chord.y(), -chord.x());
        }
    }
    return polygon;
}

} // namespace

std::vector<std::unique_ptr<const PatchGrid>> patch_grids(const Layout& layout, const Chords& chords,
                                                          const PatchGridOptions& options, const Progress& progress)
{
    const std::vector<int> cells = cells_of_strips(layout, chords, options.cells);
    std::vector<std::unique_ptr<const PatchGrid>> result;
    for (size_t p = 0; p < layout.patch.size(); ++p) {
        progress.checkpoint(double(p) / double(layout.patch.size()), fmt::format("grid of patch {}", p + 1));
        const LayoutPatch& patch = layout.patch[p];
        const PatchPolygon polygon = bulged(polygon_of(layout, patch, 16));
        const PlanarMesh mesh = mesh_polygon(polygon.point);
        const Eigen::Vector2d where = polygon.point.rowwise().mean();
        const auto fail = [&](const std::string& why) {
            throw InputError(fmt::format("patch {} of the layout, around {:.6g}, {:.6g} mm of the blank: {}", p + 1,
                                         where.x(), where.y(), why));
        };
        if (mesh.triangle.cols() == 0)
            fail("its sides cross each other; give cuts (" + mention(option::patches, "FILE") + ")");
        auto made = std::make_unique<PatchGrid>();
        made->region.position = Eigen::Matrix3Xd::Zero(3, mesh.position.cols());
        made->region.position.topRows(2) = mesh.position;
        made->region.triangle = mesh.triangle;
        const int n = int(polygon.point.cols());
        made->boundary.corner = polygon.corner;
        for (size_t k = 0; k < 4; ++k) {
            std::vector<int>& side = made->boundary.side[k];
            for (int i = polygon.corner[k];; i = (i + 1) % n) {
                side.push_back(i);
                if (side.size() > 1 && i == polygon.corner[(k + 1) % 4])
                    break;
            }
        }
        GridOptions grid;
        grid.columns = cells[size_t(chords.strip[size_t(patch[0].curve)])];
        grid.rows = cells[size_t(chords.strip[size_t(patch[1].curve)])];
        try {
            made->grid = coons_grid(made->region, Blank{mesh.position}, made->boundary, grid);
        } catch (const InputError& error) {
            fail(error.what());
        }
        made->chart = std::make_shared<BlankChart>(made->grid, made->boundary);
        result.push_back(std::move(made));
    }
    return result;
}

} // namespace spia

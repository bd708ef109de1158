#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/picking/vertex_picking.h"
#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/views/grid_shapes.h"
#include "app/viewer/views/measurements.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/patch_shapes.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/views.h"
#include "engine/coons/boundary.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// The shape so far of a running job, if it is one of this part.
SceneCache::LiveBlank live_blank(const ViewerState& state)
{
    const auto& live = state.job.blank;
    const bool fits = state.job.running && live && live->cols() == state.document.session.part->mesh.vertices();
    return fits ? live : nullptr;
}

const FlatShape& flat_shape(const ViewerState& state, const SceneCache::LiveBlank& live, SceneCache& cache)
{
    const Session& session = state.document.session;
    return cache.flat.of({session.part, live ? nullptr : session.blank, live}, [&] {
        const Eigen::Matrix2Xd& plane = live ? *live : session.blank->blank.position;
        FlatShape shape;
        shape.mesh =
            std::make_shared<SceneMesh>(flat_scene_mesh(session.part->mesh, *part_shape(state, cache).mesh, plane));
        shape.position = Eigen::Matrix3Xd::Zero(3, plane.cols());
        shape.position.topRows<2>() = plane;
        shape.box = {shape.position.rowwise().minCoeff(), shape.position.rowwise().maxCoeff()};
        return shape;
    });
}

/// Corners as vertices of the part: those the user has set, else those of the grid; while corners
/// are being chosen, those the grid would get. Nothing if there are none.
std::optional<std::array<int, 4>> corners(const ViewerState& state, SceneCache& cache)
{
    const Session& session = state.document.session;
    if (session.options.corners)
        return cache.chosen_corners.of({session.part, *session.options.corners},
                                       // of another file there are none; making the grid says so
                                       [&] { return corners_called(*session.part, *session.options.corners); });
    if (session.grid)
        return session.grid->boundary.corner;
    if (state.view.tool != Tool::corners)
        return std::nullopt;
    return cache.proposed_corners.of({session.part, session.blank}, [&]() -> std::optional<std::array<int, 4>> {
        try {
            return propose_corners(session.blank->blank, session.part->mesh);
        } catch (const Error&) {
            return std::nullopt; // making the grid gives the reason
        }
    });
}

/// Each side of the boundary in its colour.
LineList side_lines(const BlankBoundary& boundary, const Eigen::Matrix3Xd& position)
{
    LineList result;
    const std::array<Colour, 4> colour = palette::sides();
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int>& side = boundary.side[k];
        Eigen::Matrix2Xi ends(2, Eigen::Index(side.size()) - 1);
        for (size_t i = 0; i + 1 < side.size(); ++i)
            ends.col(Eigen::Index(i)) << side[i], side[i + 1];
        const auto lines = scene_lines(position, ends);
        lines->colour = colour[k];
        lines->width = 5;
        result.push_back(lines);
    }
    return result;
}

LineList outline_lines(const Eigen::Matrix3Xd& position, const Eigen::Matrix<uint32_t, 2, Eigen::Dynamic>& boundary,
                       bool dark)
{
    const auto lines = scene_lines(position, boundary);
    lines->colour = palette::outline(dark);
    lines->width = 2.4f;
    return {lines};
}

/// The edges of the outline that cross, and the vertices that the sheet winds around more than
/// once.
OverlapShape overlap_shape(const Overlap& overlap, const Eigen::Matrix3Xd& position)
{
    OverlapShape made;
    Eigen::Matrix2Xi ends(2, 2 * Eigen::Index(overlap.crossings.size()));
    for (size_t i = 0; i < overlap.crossings.size(); ++i) {
        const auto& [edge, other] = overlap.crossings[i];
        ends.col(2 * Eigen::Index(i)) << edge[0], edge[1];
        ends.col(2 * Eigen::Index(i) + 1) << other[0], other[1];
    }
    for (const auto& [colour, width] : {std::pair(palette::casing, 7.f), {palette::folded, 4.5f}})
        if (ends.cols() > 0) {
            const auto line = scene_lines(position, ends);
            line->colour = colour;
            line->width = width;
            made.lines.push_back(line);
        }
    if (!overlap.wound.empty()) {
        made.dots = scene_points(position(Eigen::all, overlap.wound));
        made.dots->colour = palette::folded;
        made.dots->size = 10;
    }
    if (!overlap.crossings.empty())
        made.place.push_back(position.col(overlap.crossings.front().edge[0]));
    if (!overlap.wound.empty())
        made.place.push_back(position.col(overlap.wound.front()));
    return made;
}

/// Where a press brake bends, as the drawing of the blank has it.
LineList bend_lines(const BendTable& table)
{
    std::vector<Eigen::Vector2d> point;
    for (const SheetBend& bend : table.bends)
        for (const BlankSegment& piece : bend.line)
            point.insert(point.end(), {piece.from, piece.to});
    LineList result;
    if (point.empty())
        return result;
    Eigen::Matrix3Xd place = Eigen::Matrix3Xd::Zero(3, Eigen::Index(point.size()));
    Eigen::Matrix2Xi ends(2, place.cols() / 2);
    for (Eigen::Index i = 0; i < place.cols(); ++i) {
        place.col(i).head<2>() = point[size_t(i)];
        ends(i % 2, i / 2) = int(i);
    }
    for (const auto& [colour, width] : {std::pair(palette::bend_ground, 4.f), {palette::bend, 1.6f}}) {
        const auto lines = scene_lines(place, ends);
        lines->colour = colour;
        lines->width = width;
        lines->on_top = true;
        result.push_back(lines);
    }
    return result;
}

/// The numbers of the table's rows, each in the middle of its line.
void add_bends(Scene& scene, const ViewerState& state, SceneCache& cache)
{
    const std::shared_ptr<const BendTable>& table = state.document.session.bends;
    if (!table || table->bends.empty())
        return;
    const LineList& lines = cache.bends.of({table}, [&] { return bend_lines(*table); });
    scene.lines.insert(scene.lines.end(), lines.begin(), lines.end());
    constexpr size_t most = 6; // more of them have no room for which way they go
    const bool few = table->bends.size() <= most;
    for (size_t b = 0; b < table->bends.size(); ++b)
        if (const SheetBend& bend = table->bends[b]; !bend.line.empty()) {
            const BlankSegment& middle = bend.line[bend.line.size() / 2];
            Eigen::Vector3d place = Eigen::Vector3d::Zero();
            place.head<2>() = (middle.from + middle.to) / 2;
            const std::string number = fmt::format("{}", b + 1);
            scene.labels.push_back({place, few ? number + (bend.up ? ", up" : ", down") : "b" + number,
                                    palette::text(state.view.dark), LabelKind::region});
        }
}

} // namespace

Scene blank_scene(const ViewerState& state, SceneCache& cache, double pixels)
{
    Scene result;
    const Session& session = state.document.session;
    if (!session.part) {
        result.empty = "The flat blank appears here once a part is open and unfolded.";
        return result;
    }
    const SceneCache::LiveBlank live = live_blank(state);
    if (!session.blank && !live) {
        result.empty = state.job.running ? "The blank appears as soon as there is a first guess."
                                         : "Unfold the part to see its flat blank.";
        return result;
    }
    const PartShape& part = part_shape(state, cache);
    const FlatShape& flat = flat_shape(state, live, cache);
    result.box = flat.box;
    const auto add = [&](const LineList& lines) {
        result.lines.insert(result.lines.end(), lines.begin(), lines.end());
    };
    add(cache.outline.of({flat.mesh, state.view.dark},
                         [&] { return outline_lines(flat.position, part.boundary, state.view.dark); }));
    if (const auto& differences = state.differences;
        !live && differences && differences->outline.size() > 0 && differences->blank != differences->reference->blank)
        add(cache.reference_outline.of({differences}, [&] {
            Eigen::Matrix3Xd place = Eigen::Matrix3Xd::Zero(3, differences->outline.cols());
            place.topRows<2>() = differences->outline;
            const auto lines = scene_lines(place, part.boundary);
            lines->colour = palette::reference;
            lines->width = 2.4f;
            return LineList{lines};
        }));
    const bool patches = session.surface && session.surface->patches;
    if (!live && patches)
        add(cache.patch_lines.of({session.surface, state.view.dark},
                                 [&] { return layout_lines(session.surface->patches->layout, state.view.dark); }));
    else if (!live && session.grid) {
        const bool choosing = state.view.tool == Tool::corners;
        const StageShape& grid = cache.planar_grid.of(
            {session.grid, choosing}, [&] { return planar_grid_shape(session.grid->result.planar, choosing); });
        result.layers.insert(result.layers.end(), grid.layers.begin(), grid.layers.end());
        add(grid.lines);
        add(cache.sides.of({flat.mesh, session.grid},
                           [&] { return side_lines(session.grid->boundary, flat.position); }));
    }
    add_sheet(result, state,
              {.mesh = flat.mesh,
               .position = flat.position,
               .flat = true,
               .converging = live != nullptr,
               .mm_per_pixel = state.view.camera[size_t(View::blank)].height / pixels},
              cache.on_blank, cache);
    if (live)
        return result;
    add_bends(result, state, cache);
    const Overlap& overlap = session.blank->overlap;
    if (const OverlapShape& shown =
            cache.overlap.of({session.blank}, [&] { return overlap_shape(overlap, flat.position); });
        !overlap.none()) {
        add(shown.lines);
        if (shown.dots)
            result.points.push_back(shown.dots);
        for (const Eigen::Vector3d& place : shown.place)
            result.labels.push_back({place, "overlap", palette::text(state.view.dark)});
    }
    if (const auto corner = patches || session.options.patches ? std::nullopt : corners(state, cache))
        add_corners(result, flat.position(Eigen::all, *corner), state.view.dark);
    add_picked_vertices(result, state, cache.vertices_on_blank, flat.mesh, flat.position);
    add_measurements(result, state, View::blank, cache);
    return result;
}

} // namespace spia::viewer

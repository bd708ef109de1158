#include "app/viewer/model/picking/view_fitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace spia::viewer {
namespace {

/// What the views in space have to show: the part and, where it is shown unfolded, the boxes around
/// all of its states.
Eigen::Matrix3Xd places_in_space(const ViewerState& state, const PartFile& part)
{
    Eigen::Matrix3Xd place = part.mesh.position;
    if (step_position(state) == 0)
        return place;
    for (size_t k = 0; k < steps_done(state.document); ++k) {
        const Eigen::Matrix3Xd& after = state.document.unfolding->run.states[k].position;
        constexpr double wider = 0.11; // either way: faces in space reach beyond what lies on them
        Eigen::AlignedBox3d box(after.rowwise().minCoeff(), after.rowwise().maxCoeff());
        const Eigen::Vector3d size = box.sizes();
        box.extend(box.min() - wider * size);
        box.extend(box.max() + wider * size);
        place.conservativeResize(3, place.cols() + 8);
        for (int c = 0; c < 8; ++c)
            place.col(place.cols() - 8 + c) = box.corner(Eigen::AlignedBox3d::CornerType(c));
    }
    return place;
}

} // namespace

namespace {

/// Whether a straight line parts the points from a square in the upper right corner of the view.
bool clear_of_corner(const Camera& camera, const Eigen::Matrix3Xd& place, glm::dvec2 size, double side)
{
    if (!(side > 0))
        return true;
    constexpr int ways = 16;
    std::array<double, ways + 1> reach; // how far the points go towards the corner, seen from where
                                        // the square begins
    reach.fill(-std::numeric_limits<double>::infinity());
    const glm::dvec2 inner(size.x - side, side);
    for (Eigen::Index i = 0; i < place.cols(); ++i) {
        const glm::dvec2 from = glm::dvec2(pixel_of(camera, place.col(i), size)) - inner;
        for (size_t k = 0; k <= ways; ++k) {
            const double angle = double(k) / ways * std::numbers::pi / 2;
            reach[k] = std::max(reach[k], std::cos(angle) * from.x - std::sin(angle) * from.y);
        }
    }
    return std::any_of(reach.begin(), reach.end(), [](double r) { return r < 0; });
}

/// Of very many points those at the outline of the picture, to a small part of a pixel of what they
/// fill.
Eigen::Matrix3Xd outermost(const Camera& camera, const Eigen::Matrix3Xd& place)
{
    constexpr Eigen::Index many = 50000;
    constexpr int columns = 1024; // of the picture
    if (place.cols() < many || camera.perspective)
        return place;
    const auto row = [&](glm::dvec3 way) -> Eigen::RowVectorXd {
        return Eigen::RowVector3d(way.x, way.y, way.z) * place;
    };
    const Eigen::RowVectorXd x = row(camera.turn * glm::dvec3(1, 0, 0)), y = row(camera.turn * glm::dvec3(0, 1, 0));
    Eigen::Index left = 0, right = 0;
    const double from = x.minCoeff(&left), width = x.maxCoeff(&right) - from;
    std::vector<Eigen::Index> low(columns, -1), high(columns, -1), kept{left, right};
    for (Eigen::Index i = 0; i < place.cols(); ++i) {
        const auto k = size_t(width > 0 ? std::min(columns - 1., columns * (x[i] - from) / width) : 0);
        if (low[k] < 0 || y[i] < y[low[k]])
            low[k] = i;
        if (high[k] < 0 || y[i] > y[high[k]])
            high[k] = i;
    }
    for (const auto& column : {low, high})
        std::copy_if(column.begin(), column.end(), std::back_inserter(kept), [](Eigen::Index i) { return i >= 0; });
    return place(Eigen::all, kept);
}

} // namespace

Camera ViewFitter::beside(const ViewerState& state, View view, const Camera& camera,
                          const Eigen::Matrix3Xd& all_places) const
{
    if (all_places.cols() == 0)
        return camera;
    const Eigen::Matrix3Xd place = outermost(camera, all_places);
    const glm::dvec2 size = size_[size_t(view)];
    const Margins free = margins(state, view);
    const double cube = camera.flat ? 0 : covered_[size_t(view)].cube;
    const Camera past = viewer::fit(camera, place, size, free);
    if (clear_of_corner(past, place, size, cube))
        return past;
    Margins left_of = free, below = free;
    left_of.right = std::max(free.right, cube);
    below.top = std::max(free.top, cube);
    const Camera a = viewer::fit(camera, place, size, left_of), b = viewer::fit(camera, place, size, below);
    Camera best = a.height <= b.height ? a : b;
    // Past the corner, where the part may be larger than beside the whole square: halfway to either
    // margin and so on.
    for (const auto& [across, down] : {std::pair(0.5, 0.5), {0.3, 0.6}, {0.6, 0.3}, {0.3, 0.3}, {0., 0.5}, {0.5, 0.}}) {
        Margins some = free;
        some.right = std::max(free.right, across * cube);
        some.top = std::max(free.top, down * cube);
        const Camera tried = viewer::fit(camera, place, size, some);
        if (tried.height < best.height && clear_of_corner(tried, place, size, cube))
            best = tried;
    }
    return best;
}

void ViewFitter::fit(ViewerState& state, std::optional<View> only)
{
    const Session& session = state.document.session;
    // the others show the part that is open
    if (shows_refused(state) && only.value_or(View::part) == View::part) {
        Camera& camera = state.view.camera[size_t(View::part)];
        camera = beside(state, View::part, camera, state.refused->mesh.position);
        fitted_[size_t(View::part)] = camera;
        if (!only)
            fit_blank(state);
        return;
    }
    const PartFile* part = session.part ? session.part.get() : state.refused.get();
    if (!part)
        return;
    if (!only || *only == View::blank)
        fit_blank(state);
    if (only != View::blank)
        fit_space(state, *part, only);
}

void ViewFitter::fit_blank(ViewerState& state)
{
    const auto& blank = state.document.session.blank;
    if (!blank && !state.job.blank)
        return;
    const Eigen::Matrix2Xd& plane = state.job.blank ? *state.job.blank : blank->blank.position;
    Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, plane.cols());
    flat.topRows<2>() = plane;
    Camera& camera = state.view.camera[size_t(View::blank)];
    camera = viewer::fit(camera, flat, size_[size_t(View::blank)], margins(state, View::blank));
    fitted_[size_t(View::blank)] = camera;
}

void ViewFitter::fit_space(ViewerState& state, const PartFile& part, std::optional<View> only)
{
    const Eigen::Matrix3Xd places = places_in_space(state, part);
    const auto fitted = [&](View view, const Camera& camera) { return beside(state, view, camera, places); };
    const auto set = [&](View view, const Camera& camera) {
        fitted_[size_t(view)] = state.view.camera[size_t(view)] = camera;
    };
    constexpr View in_space[] = {View::part, View::quads, View::surface};
    if (!state.view.linked) {
        for (const View view : in_space)
            if (!only || *only == view)
                set(view, fitted(view, state.view.camera[size_t(view)]));
        return;
    }
    // What fits in the view that has the least room fits in the others. Views behind a maximised
    // one do not count.
    const Camera& leader = state.view.camera[size_t(only.value_or(View::part))];
    const std::optional<View> alone = state.view.maximised;
    const auto shows_it = [&](View view) { return view != View::part || !shows_refused(state); };
    std::optional<Camera> widest;
    for (const View view : in_space)
        if (shows_it(view) && (!alone || *alone == view || *alone == View::blank))
            if (const Camera camera = fitted(view, leader); !widest || camera.height > widest->height)
                widest = camera;
    for (const View view : in_space)
        if (widest && shows_it(view))
            set(view, *widest);
}

void ViewFitter::resized(ViewerState& state, View view, glm::dvec2 size, double scale, const Covered& covered)
{
    scale_ = scale;
    const Covered before = std::exchange(covered_[size_t(view)], covered);
    const Margins now = margins(state, view); // the legend may have come or gone
    if (size_[size_t(view)] == size && margins_[size_t(view)] == now && before.cube == covered.cube)
        return;
    size_[size_t(view)] = size;
    margins_[size_t(view)] = now;
    if (is_fitted(state, view))
        fit(state, view);
}

/// Pixels at content scale 1 that stay free on the left of a view, where its legend is if there is
/// one.
static double room_for_legend(const ViewerState& state, View view, double around, double drawn_legend)
{
    const Document& document = state.document;
    const bool of_sheet = view == View::part || view == View::blank;
    // names instead of numbers
    const double legend = of_sheet && document.display.field == Field::zone ? 122
                          : view == View::quads                             ? 92 // a long title
                                                                            : 72;
    const bool stepwise = view == View::part && (step_shown(state) || step_position(state) > 0);
    const bool coloured = view == View::part && shows_refused(state) ? false
                          : view == View::quads                      ? state.view.quad_quality
                          : view == View::surface                    ? has_scale(state.view.surface_look)
                          : stepwise ? state.view.field_on_steps && available_in_steps(document.display.field)
                                     : document.display.field != Field::none;
    if (!coloured)
        return around;
    // As it was drawn last; it is estimated before that. Its numbers change with the field: in
    // steps, or the part would tremble.
    constexpr double gap = 10, step = 8; // pixels
    return std::max(around + legend, drawn_legend > 0 ? step * std::ceil((drawn_legend + gap) / step) : 0);
}

/// Beside what is shown there is room for the legend if there is one; views with one camera have
/// the same room.
Margins ViewFitter::margins(const ViewerState& state, View view) const
{
    constexpr double around = 24; // pixels
    const auto room = [&](View of) { return room_for_legend(state, of, around, covered_[size_t(of)].legend / scale_); };
    double left = room(view);
    const std::optional<View> alone = state.view.maximised;
    if (view != View::blank && state.view.linked && !shows_refused(state))
        for (const View other : {View::part, View::quads, View::surface})
            if (!alone || *alone == other)
                left = std::max(left, room(other));
    return {left * scale_, around * scale_, around * scale_, around * scale_};
}

} // namespace spia::viewer

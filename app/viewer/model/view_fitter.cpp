#include "app/viewer/model/view_fitter.h"

#include <Eigen/Geometry>

namespace spia::viewer {
namespace {

/// What the views in space have to show: the part and, where it is shown unfolded, the boxes around all of its states.
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

void ViewFitter::fit(ViewerState& state, std::optional<View> only)
{
    const Session& session = state.document.session;
    if (shows_refused(state) && only.value_or(View::part) == View::part) { // the others show the part that is open
        Camera& camera = state.view.camera[size_t(View::part)];
        camera =
            viewer::fit(camera, state.refused->mesh.position, size_[size_t(View::part)], margins(state, View::part));
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
    const auto fitted = [&](View view, const Camera& camera) {
        return viewer::fit(camera, places, size_[size_t(view)], margins(state, view));
    };
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
    // What fits in the view that has the least room fits in the others. Views behind a maximised one do not count.
    const Camera& leader = state.view.camera[size_t(only.value_or(View::part))];
    const std::optional<View> alone = state.view.maximised;
    std::optional<Camera> widest;
    for (const View view : in_space)
        if (!alone || *alone == view || *alone == View::blank)
            if (const Camera camera = fitted(view, leader); !widest || camera.height > widest->height)
                widest = camera;
    for (const View view : in_space)
        set(view, *widest);
}

void ViewFitter::resized(ViewerState& state, View view, glm::dvec2 size, double scale)
{
    scale_ = scale;
    const Margins now = margins(state, view); // the legend may have come or gone
    if (size_[size_t(view)] == size && margins_[size_t(view)] == now)
        return;
    size_[size_t(view)] = size;
    margins_[size_t(view)] = now;
    if (is_fitted(state, view))
        fit(state, view);
}

/// Beside what is shown there is room for the legend if there is one.
Margins ViewFitter::margins(const ViewerState& state, View view) const
{
    constexpr double around = 24; // pixels
    const Document& document = state.document;
    const bool of_sheet = view == View::part || view == View::blank;
    const double legend = of_sheet && document.display.field == Field::zone ? 122 // names instead of numbers
                          : view == View::quads                             ? 92  // its title is long
                                                                            : 72;
    const bool stepwise = view == View::part && (step_shown(state) || step_position(state) > 0);
    const bool coloured = view == View::part && shows_refused(state) ? false
                          : view == View::quads                      ? state.view.quad_quality
                          : view == View::surface                    ? has_scale(state.view.surface_look)
                          : stepwise ? state.view.field_on_steps && available_in_steps(document.display.field)
                                     : document.display.field != Field::none;
    return {(around + (coloured ? legend : 0)) * scale_, around * scale_, around * scale_, around * scale_};
}

} // namespace spia::viewer

#include "app/viewer/model/picking/handles.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// Of a shared control point the first of its copies: patch and index in its net.
struct FirstCopy {
    int patch = -1, control = -1;
};

std::vector<FirstCopy> first_copies(const MultiPatch& surface, const SharedControls& shared)
{
    std::vector<FirstCopy> first(static_cast<size_t>(shared.count));
    for (int p = int(surface.patch.size()) - 1; p >= 0; --p)
        for (int c = int(surface.patch[size_t(p)].control.cols()) - 1; c >= 0; --c)
            first[size_t(shared.of(p, c))] = {p, c};
    return first;
}

void move_controls(Deformation& deformation, const MultiPatch& surface, const std::vector<int>& handles,
                   const Eigen::Vector3d& by)
{
    const SharedControls shared = shared_controls(surface);
    const std::vector<FirstCopy> first = first_copies(surface, shared);
    for (const int handle : handles) {
        if (handle < 0 || handle >= shared.count)
            throw InputError(
                fmt::format("There is no control point {}; the surface has {}, counted from 0.", handle, shared.count));
        const auto known = std::find_if(deformation.moves.begin(), deformation.moves.end(), [&](const ControlMove& m) {
            const size_t patch = size_t(m.patch);
            return patch < surface.patch.size() && shared.of(m.patch, surface.patch[patch].index(m.i, m.j)) == handle;
        });
        if (known != deformation.moves.end()) {
            known->move += by;
            continue;
        }
        const auto [patch, control] = first[size_t(handle)];
        const int count = surface.patch[size_t(patch)].count_u;
        deformation.moves.push_back({patch, control % count, control / count, by});
    }
}

} // namespace

Eigen::Matrix3Xd handle_positions(const Session& session, HandleKind kind)
{
    if (kind == HandleKind::lattice) {
        const auto& deformation = session.options.deformation;
        if (!deformation || !deformation->lattice)
            return Eigen::Matrix3Xd(3, 0);
        return rest_positions(*deformation->lattice) + deformation->lattice->move;
    }
    if (!session.surface)
        return Eigen::Matrix3Xd(3, 0);
    const MultiPatch surface = surface_patches(session);
    const SharedControls shared = shared_controls(surface);
    Eigen::Matrix3Xd position(3, shared.count);
    for (size_t p = 0; p < surface.patch.size(); ++p)
        for (int c = 0; c < int(surface.patch[p].control.cols()); ++c)
            position.col(shared.of(int(p), c)) = surface.patch[p].control.col(c);
    return position;
}

std::optional<int> handle_at(const PickHandle& pick, const Camera& camera, const Eigen::Matrix3Xd& position)
{
    constexpr double same = 1; // pixel
    std::optional<int> found;
    double least = pick.reach, depth = 0;
    for (Eigen::Index h = 0; h < position.cols(); ++h) {
        const glm::dvec3 pixel = pixel_of(camera, position.col(h), pick.size);
        const double distance = glm::length(glm::dvec2(pixel) - pick.pixel);
        if (!(distance <= pick.reach)) // also a place without a pixel
            continue;
        if (!found || distance < least - same || (distance < least + same && pixel.z > depth)) {
            found = int(h);
            least = distance;
            depth = pixel.z;
        }
    }
    return found;
}

Deformation moved(const Session& session, HandleKind kind, const std::vector<int>& handles, const Eigen::Vector3d& by)
{
    Deformation deformation = session.options.deformation.value_or(Deformation{});
    if (kind == HandleKind::control) {
        if (!session.surface)
            throw InputError("Make the surface first; then its control points can be moved.");
        move_controls(deformation, fitted_patches(*session.surface), handles, by);
        return deformation;
    }
    if (!deformation.lattice)
        throw InputError("Add a lattice to the surface first, in the step NURBS surface.");
    for (const int handle : handles) {
        if (handle < 0 || handle >= deformation.lattice->points())
            throw InputError(fmt::format("There is no lattice point {}; it has {}, counted from 0.", handle,
                                         deformation.lattice->points()));
        deformation.lattice->move.col(handle) += by;
    }
    return deformation;
}

std::optional<Deformation> reset(const std::optional<Deformation>& deformation, HandleKind kind)
{
    if (!deformation)
        return std::nullopt;
    Deformation left = *deformation;
    if (kind == HandleKind::control)
        left.moves.clear();
    else if (left.lattice)
        left.lattice->move.setZero();
    return left.moves.empty() && !left.lattice ? std::nullopt : std::optional(std::move(left));
}

} // namespace spia::viewer

#include "engine/unfold/step/stepped_blank.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/forming/process/process.h"
#include "engine/forming/solver/seen_along.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/forming/solver/skin_strain.h"
#include "engine/forming/solver/volume_error.h"

namespace spia {
namespace {

/// Where the axes of the blank's coordinates point in the plane in which the last state lies.
Eigen::Matrix<double, 3, 2> axes_of(const Eigen::Matrix3Xd& state, const Eigen::Matrix2Xd& blank)
{
    const Eigen::Matrix3Xd X = state.colwise() - state.rowwise().mean();
    const Eigen::Matrix2Xd B = blank.colwise() - blank.rowwise().mean();
    Eigen::Matrix<double, 3, 2> axes = X * B.transpose() * (B * B.transpose()).inverse();
    axes.col(0).normalize();
    axes.col(1) = (axes.col(1) - axes.col(0).dot(axes.col(1)) * axes.col(0)).normalized();
    return axes;
}

/// How the steps ended.
SolveReport report_of(const UnfoldRun& run, const FlattenOptions& options)
{
    SolveReport report;
    std::string others;
    report.converged = true;
    report.system = SolvedSystem::strict;
    report.trusted_strain = options.curve.trusted_strain;
    for (size_t k = 0; k < run.states.size(); ++k) {
        const UnfoldState& state = run.states[k];
        report.seconds += state.seconds;
        report.converged &= state.converged;
        report.system = std::max(report.system, state.converged ? state.system : SolvedSystem::energy);
        if (state.trusted_strain > 0)
            report.trusted_strain = std::min(report.trusted_strain, state.trusted_strain);
        report.process_share = std::min(report.process_share, state.friction_share);
        if (!state.reason.empty())
            others += fmt::format("; step {} \"{}\": {}", k + 1, state.name, state.reason);
    }
    report.reason = fmt::format("made in {} step{}{}", run.states.size(), run.states.size() == 1 ? "" : "s",
                                report.converged ? ", each of which converged" : "") +
                    others;
    return report;
}

} // namespace

FlattenResult stepped_blank(const TriMesh& part, const UnfoldRun& run, const FlattenOptions& options)
{
    if (!run.blank)
        throw InputError("the steps gave no blank; mend them until the part lies in a plane");
    if (run.flipped > 0)
        throw InputError(fmt::format("the blank of the steps has {} flipped triangle{}; unfold there in smaller steps",
                                     run.flipped, run.flipped == 1 ? "" : "s"));
    if (run.blank->position.cols() != part.vertices() || run.states.back().face.thickness.size() != part.triangles())
        throw InputError(fmt::format("the steps were made on a part of {} vertices, this one has {}; run them on it",
                                     run.blank->position.cols(), part.vertices()));
    const std::vector<Element> element = elements(part);
    const Eigen::Matrix<double, 3, 2> axes = axes_of(run.states.back().position, run.blank->position);
    const Sheet sheet = sheet_of(options.material, options.thickness, options.curve, options.process, part, axes);
    FlattenResult result{};
    result.blank = *run.blank;
    result.face = run.states.back().face;
    result.node = node_fields(part, element, result.face);
    if (options.skins)
        result.skins = skin_strains(part, element, result.blank, sheet);
    result.stamping = seen_along(part, axes.col(0).cross(axes.col(1)));
    result.report = report_of(run, options);
    result.necking_triangles = result.face.necking.sum();
    result.overlap = overlap(part, result.blank.position);
    result.volume_error = volume_error(part, result.blank, result.face, sheet.thickness);
    return result;
}

} // namespace spia

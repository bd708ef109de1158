#include "engine/unfold/step/polish.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/forming/flatten_from.h"
#include "engine/forming/solver/flips.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/segment_distance.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

BlankFigures figures(const TriMesh& part, const Eigen::Matrix2Xd& flat, const SheetFields& face, bool converged)
{
    const Overlap over = overlap(part, flat);
    return {converged,
            face.strain_equivalent.maxCoeff(),
            face.thinning.minCoeff(),
            face.thinning.maxCoeff(),
            flipped_triangles(part.triangle, flat),
            int(over.crossings.size() + over.wound.size()),
            distortion(part, flat)};
}

/// Turns and moves a blank onto another, area by area. [Kabsch 1976 in the plane]
void lay_onto(const TriMesh& part, const Eigen::Matrix2Xd& other, Eigen::Matrix2Xd& X)
{
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
    const Eigen::Matrix3Xd normal = area_vectors(part);
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            mass[v] += normal.col(f).norm() / 3;
    mass /= mass.sum();
    const Eigen::Vector2d to = other * mass, from = X * mass;
    const Eigen::Matrix2d moment = (other.colwise() - to) * mass.asDiagonal() * (X.colwise() - from).transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    X = (Eigen::Rotation2Dd(angle).toRotationMatrix() * (X.colwise() - from)).colwise() + to;
}

void measure_outlines(const TriMesh& part, const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b, PolishedBlank& result)
{
    const auto loops = boundary_loops(part);
    std::vector<std::array<int, 2>> edges;
    for (const auto& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i)
            edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
    const SegmentDistance to_a(a, edges), to_b(b, edges);
    double most = 0, sum = 0, count = 0;
    for (const auto& loop : loops)
        for (const int v : loop)
            for (const double off : {to_b(a.col(v)), to_a(b.col(v))}) {
                most = std::max(most, off);
                sum += off;
                ++count;
            }
    result.outline_distance_mm = most;
    result.outline_distance_mean_mm = sum / count;
}

std::vector<std::string> worse_in(const BlankFigures& steps, const BlankFigures& polished)
{
    constexpr double strain = 1e-3;              // logarithmic: what no one would notice
    constexpr double share = 1.01, least = 1e-6; // of a distortion: likewise, and what is rounding
    std::vector<std::string> worse;
    if (steps.converged && !polished.converged)
        worse.emplace_back("it did not converge");
    if (polished.flipped > steps.flipped)
        worse.push_back(fmt::format("{}, not {}", counted(polished.flipped, "flipped triangle", "flipped triangles"),
                                    steps.flipped));
    if (polished.overlaps > 0 && steps.overlaps == 0)
        worse.push_back(fmt::format("it overlaps itself at {}", counted(polished.overlaps, "place", "places")));
    if (polished.strain > steps.strain + strain)
        worse.push_back(fmt::format("greatest strain {:.4f}, not {:.4f}", polished.strain, steps.strain));
    const auto distorted = [&](const char* what, double now, double before) {
        if (now > share * before + least)
            worse.push_back(fmt::format("{} distortion {:.3g}, not {:.3g}", what, now, before));
    };
    distorted("angular", polished.distortion.angular_rms, steps.distortion.angular_rms);
    distorted("area", polished.distortion.area_rms, steps.distortion.area_rms);
    return worse;
}

} // namespace

PolishedBlank polish(const TriMesh& part, const UnfoldRun& run, const FlattenOptions& options, const Progress& progress,
                     const StepWatch& watch)
{
    if (!run.blank)
        throw InputError(
            "the steps gave no blank that could be polished; mend the script until the part lies in a plane");
    if (run.flipped > 0)
        throw InputError(fmt::format("the blank of the steps has {}; it cannot be polished",
                                     counted(run.flipped, "flipped triangle", "flipped triangles")));
    const Eigen::Matrix2Xd& before = run.blank->position;
    const bool converged = std::all_of(run.states.begin(), run.states.end(), [](const auto& s) { return s.converged; });
    PolishedBlank result{flatten_from(part, before, options, progress, watch), {}, {}, 0, 0, {}};
    Eigen::Matrix2Xd& after = result.whole.blank.position;
    lay_onto(part, before, after);
    result.steps = figures(part, before, run.states.back().face, converged);
    result.polished = figures(part, after, result.whole.face, result.whole.report.converged);
    measure_outlines(part, before, after, result);
    result.worse = worse_in(result.steps, result.polished);
    return result;
}

} // namespace spia

#include "app/viewer/model/export_check.h"

#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/lengths.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {

FitVerdict fit_verdict(const Session& session, double tolerance)
{
    FitVerdict verdict;
    if (!session.surface || !session.part)
        return verdict;
    constexpr double far = 10; // tolerances
    const Deviation& deviation = session.surface->deviation;
    verdict.greatest = deviation.max();
    verdict.p95 = deviation.mesh_to_surface.p95;
    verdict.fit = verdict.greatest > far * tolerance ? Fit::far_off
                  : verdict.greatest > tolerance     ? Fit::beyond
                                                     : Fit::within;
    const TriMesh& part = session.part->mesh;
    const Eigen::VectorXd size = area_vectors(part).colwise().norm();
    double farther = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            if (std::abs(deviation.at_vertex[part.triangle(a, f)]) > tolerance)
                farther += size[f] / 3;
    const double whole = size.sum();
    verdict.share = whole > 0 ? farther / whole : 0;
    return verdict;
}

std::string text(const FitVerdict& verdict, double tolerance, LengthUnit lengths)
{
    if (verdict.fit == Fit::none)
        return "There is no surface yet: IGES, STEP and isogeometric files are left out.";
    const auto length = [&](double mm) { return length_text(mm, lengths, 3); };
    if (verdict.fit == Fit::within)
        return fmt::format("The surface is within {} of the part (95 % of it within {}).", length(verdict.greatest),
                           length(verdict.p95));
    const std::string share = verdict.share < 0.001 ? "less than 0.1 %" : fmt::format("{:.1f} %", 100 * verdict.share);
    if (verdict.fit == Fit::beyond)
        return fmt::format("The surface deviates from the part by up to {}; {} of the part deviates by more than {}. "
                           "Use a finer grid or fit within a tolerance.",
                           length(verdict.greatest), share, length(tolerance));
    return fmt::format("The surface deviates from the part by up to {}, {:.0f} times the tolerance; {} of the part "
                       "deviates by more than {}. Check corners, grid and deviation before exporting.",
                       length(verdict.greatest), verdict.greatest / tolerance, share, length(tolerance));
}

} // namespace spia::viewer

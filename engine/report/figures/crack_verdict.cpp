#include "engine/report/figures/crack_verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/text.h"
#include "engine/report/text/lengths.h"

namespace spia {
namespace {

/// The share of the limit that is used up where it is greatest. Zones::distance is what is left of
/// it in engineering major strain.
void find_greatest_share(const LimitsResult& limits, const SheetFields& face, CrackVerdict& verdict)
{
    const Eigen::VectorXd& left = limits.zones.distance;
    for (Eigen::Index f = 0; f < left.size(); ++f) {
        const double strain = engineering_strain(face.strain_major[f]), limit = strain + left[f];
        if (!std::isfinite(left[f]) || !(limit > 0))
            continue;
        if (verdict.face < 0 || strain / limit > verdict.share) {
            verdict.share = std::max(0., strain / limit);
            verdict.face = int(f);
        }
    }
}

std::string place(const TriMesh& part, int face, LengthUnit lengths)
{
    const Eigen::Vector3d at = (part.position.col(part.triangle(0, face)) + part.position.col(part.triangle(1, face)) +
                                part.position.col(part.triangle(2, face))) /
                               (3 * millimetres(lengths));
    return fmt::format("{:.4g}, {:.4g}, {:.4g} {}", at[0] + 0., at[1] + 0., at[2] + 0., length_word(lengths));
}

/// Why the result is not that of all that was asked for; empty: it is.
std::string weakness_of(const SolveReport& report)
{
    if (report.whole())
        return "";
    if (!report.converged)
        return "The result has not converged";
    if (report.process_share < 1)
        return fmt::format("The sheet bears {:.3g} % of the tools' forces, of which the result is",
                           100 * report.process_share);
    if (report.system == SolvedSystem::continued)
        return fmt::format("The hardening curve was continued from the strain {:.2f} on", report.trusted_strain);
    return fmt::format("Equilibrium was relaxed at {}", counted(report.relaxed_vertices, "vertex", "vertices"));
}

} // namespace

CrackVerdict crack_verdict(const Session& session, LengthUnit lengths)
{
    CrackVerdict verdict;
    if (!session.part || !session.blank || !session.limits)
        return verdict;
    const LimitsResult& limits = *session.limits;
    const SheetFields& face = session.blank->face;
    find_greatest_share(limits, face, verdict);
    if (verdict.face < 0) {
        verdict.kind = CrackVerdict::Kind::unknown;
        verdict.text = fmt::format(
            "Cracking cannot be judged: there is no forming limit curve for {}. The maximum thinning is {:.1f} %.",
            session.options.flatten.material.name, std::max(0., 100 * face.thinning.maxCoeff()));
        return verdict;
    }
    const auto faces = [&](Zone zone) { return limits.zones.share[size_t(zone)].faces; };
    const int above = faces(Zone::crack), near = faces(Zone::risk) + faces(Zone::marginal);
    const std::string used = fmt::format("the greatest strain is {:.0f} % of the forming limit", 100 * verdict.share);
    if (above > 0) {
        verdict.kind = CrackVerdict::Kind::cracks;
        verdict.text = fmt::format("Cracks expected in {}, first at {}: {}.", counted(above, "face", "faces"),
                                   place(session.part->mesh, verdict.face, lengths), used);
    } else if (near > 0) {
        verdict.kind = CrackVerdict::Kind::at_limit;
        verdict.text = fmt::format("At the limit in {}: {}, which leaves less than the required margin.",
                                   counted(near, "face", "faces"), used);
    } else {
        verdict.kind = CrackVerdict::Kind::safe;
        verdict.text = fmt::format("No cracks expected: {}.", used);
    }
    if (const int thick = faces(Zone::strong_thickening); thick > 0)
        verdict.text +=
            fmt::format(" Wrinkles are likely: {} by more than the allowed {:.0f} %.",
                        counted(thick, "face thickens", "faces thicken"), 100 * limits.settings.max_thickening);
    const Eigen::VectorXd& left = limits.zones.distance;
    const auto untold = std::count_if(left.begin(), left.end(), [](double each) { return !std::isfinite(each); });
    if (untold > 0)
        verdict.text += fmt::format(" It cannot be judged for {}, whose sheet has no forming limit curve.",
                                    counted(untold, "face", "faces"));
    if (above == 0 && near == 0)
        verdict.text += " Bending strains at radii are not included.";
    const std::string weakness = weakness_of(session.blank->report);
    if (!weakness.empty())
        verdict.text += fmt::format(" {}, so this is a guess.", weakness);
    verdict.sure = faces(Zone::strong_thickening) == 0 && untold == 0 && weakness.empty();
    return verdict;
}

} // namespace spia

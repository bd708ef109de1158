#include "engine/mesh/doctor/doctor.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "engine/core/error.h"

namespace spia {

std::string_view name(Fault fault)
{
    switch (fault) {
    case Fault::nothing_there: return "no faces";
    case Fault::bad_index: return "missing vertex";
    case Fault::bad_coordinate: return "bad coordinate";
    case Fault::coincident_vertex: return "coincident vertices";
    case Fault::crack: return "crack";
    case Fault::repeated_corner: return "repeated corner";
    case Fault::duplicate_face: return "duplicate face";
    case Fault::polygon: return "polygon";
    case Fault::crossing_polygon: return "crossing polygon";
    case Fault::flat_face: return "face without area";
    case Fault::crowded_edge: return "non-manifold edge";
    case Fault::flipped_face: return "flipped orientation";
    case Fault::one_sided: return "one-sided surface";
    case Fault::stray_vertex: return "stray vertex";
    case Fault::touching_fans: return "non-manifold vertex";
    case Fault::several_components: return "several components";
    case Fault::closed_surface: return "closed surface";
    case Fault::opening: return "opening";
    case Fault::handle: return "handle";
    case Fault::seam: return "seam";
    case Fault::closed_corner: return "closed corner";
    case Fault::sliver: return "sliver";
    case Fault::gap: return "gap";
    case Fault::unmeshed_face: return "face not meshed";
    case Fault::damaged_entity: return "damaged entity";
    case Fault::overlap: return "overlapping faces";
    case Fault::mark: return "mark";
    }
    return "";
}

bool DoctorReport::healthy() const
{
    return std::none_of(findings.begin(), findings.end(),
                        [](const Finding& f) { return f.severity == Severity::fatal; });
}

const Finding* DoctorReport::find(Fault fault) const
{
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.fault == fault; });
    return found == findings.end() ? nullptr : &*found;
}

void DoctorReport::add(Fault fault, Severity severity, const Tally& tally, std::string text, std::string advice)
{
    findings.push_back(
        {fault, severity, tally.count, tally.first, std::move(text), std::move(advice), tally.where, {}});
}

bool counts_vertices(Fault fault)
{
    return fault == Fault::bad_coordinate || fault == Fault::coincident_vertex || fault == Fault::crack ||
           fault == Fault::stray_vertex || fault == Fault::touching_fans || fault == Fault::seam ||
           fault == Fault::closed_corner || fault == Fault::gap || fault == Fault::opening;
}

std::optional<std::string> refusal(const DoctorReport& report)
{
    std::string message;
    int shown = 0;
    for (const Finding& f : report.findings)
        if (f.severity == Severity::fatal && shown++ < 3)
            message += fmt::format("{}{}; {}", shown > 1 ? "\n" : "", f.text, f.advice);
    if (shown > 3)
        message += fmt::format("\nand {} more", shown - 3);
    if (shown == 0)
        return std::nullopt;
    return message + "\n(faces and vertices are counted from 0)";
}

void require_healthy(const DoctorReport& report)
{
    if (const auto why = refusal(report))
        throw InputError(*why);
}

} // namespace spia

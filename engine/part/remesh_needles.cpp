#include "engine/part/remesh_needles.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "engine/part/remesh_part.h"
#include "engine/part/stated_curvature.h"
#include "engine/remesh/triangle_quality.h"

namespace spia {
namespace {

bool unrolls(const PartFile& part)
{
    constexpr double bent = 0.02; // bent parts measured have 0 to rounding, the flattest of the drawn ones 0.9
    return curvature_off_bends(part) < bent;
}

PartFile excused(PartFile part)
{
    if (std::erase_if(part.doctor.findings, [](const Finding& f) { return f.fault == Fault::sliver; }))
        part.notes.push_back(
            "the long narrow triangles lie along the rulings of a developable surface and do not affect the strains");
    return part;
}

} // namespace

PartFile excuse_needles(PartFile part)
{
    return part.doctor.find(Fault::sliver) && unrolls(part) ? excused(std::move(part)) : std::move(part);
}

PartFile remesh_needles(PartFile part, std::optional<double> deflection, const Progress& progress)
{
    constexpr double needle = 15 * std::numbers::pi / 180; // of one triangle in a hundred
    if (triangle_quality(part.mesh).least_angle_of_99 > needle)
        return part;
    if (unrolls(part))
        return excused(std::move(part));
    try {
        RemeshOptions remesh;
        if (deflection) // the mesh is to be as close again; not coarser than by default, nor finer
                        // than can be
            remesh.tolerance =
                std::clamp(*deflection, 1e-6 * bounding_diagonal(part.mesh), 1e-3 * bounding_diagonal(part.mesh));
        PartFile remeshed = remesh_part(part, remesh, progress);
        remeshed.notes.push_back(
            fmt::format("needle triangles were remeshed, because the part does not unroll and they "
                        "would falsify its strains; they can be kept ({})",
                        mention(option::no_remesh)));
        return remeshed;
    } catch (const InputError& error) {
        for (Finding& finding : part.doctor.findings)
            if (finding.fault == Fault::sliver)
                finding.advice = fmt::format("strains there are unreliable; remeshing failed (see the notes), but may "
                                             "work with another size or tolerance ({} or {})",
                                             mention(option::remesh_size), mention(option::remesh_tolerance));
        part.notes.push_back(fmt::format(
            "needle triangles make the strains of this part unreliable, which does not unroll; they were not remeshed: {}",
            error.what()));
        return part;
    }
}

} // namespace spia

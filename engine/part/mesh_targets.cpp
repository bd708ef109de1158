#include "engine/part/mesh_targets.h"

#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/options/part_options.h"
#include "engine/part/part_file.h"
#include "engine/remesh/triangle_quality.h"

namespace spia {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Triangles whose value is beyond the target.
struct Missed {
    int count = 0, worst = -1;
    double value = 0;

    void add(int face, double of_face, bool is_worse)
    {
        if (count++ == 0 || is_worse) {
            worst = face;
            value = of_face;
        }
    }
};

void require_sense(const MeshTargets& targets)
{
    if (targets.least_angle && !(*targets.least_angle > 0 && *targets.least_angle < 60 / degrees))
        throw InputError("the least angle of the triangles must be between 0 and 60 degrees");
    if (targets.edge_ratio && !(*targets.edge_ratio > 1 && std::isfinite(*targets.edge_ratio)))
        throw InputError("the ratio of the longest to the shortest edge of a triangle must be above 1");
}

} // namespace

Remarks on_targets(const MeshTargets& targets, const PartFile& part)
{
    Remarks remarks;
    require_sense(targets);
    Missed angle, ratio;
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const Eigen::Matrix3d triangle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f));
        if (const double a = least_angle(triangle); targets.least_angle && a < *targets.least_angle)
            angle.add(f, a, a < angle.value);
        if (const double r = edge_ratio(triangle); targets.edge_ratio && !(r <= *targets.edge_ratio))
            ratio.add(f, r, r > ratio.value);
    }
    const std::string advice = part.remeshed ? "; remesh with another size of edges or a larger tolerance"
                                             : "; mesh the part again (" + mention(option::remesh) + ")";
    const auto tell = [&](const Missed& missed, std::string what) {
        if (missed.count == 0)
            return;
        remarks.doubt(fmt::format("{} {} (worst: face {}){}", counted(missed.count, "triangle has", "triangles have"),
                                  what, part.source_face[size_t(missed.worst)], advice));
    };
    tell(angle, fmt::format("an angle below {:.3g} degrees, the least {:.3g}",
                            targets.least_angle.value_or(0) * degrees, angle.value * degrees));
    tell(ratio, fmt::format("edges whose lengths differ by more than {:.3g} times, the most {:.3g}",
                            targets.edge_ratio.value_or(0), ratio.value));
    return remarks;
}

} // namespace spia

#include "tests/robustness/layout_run.h"

#include <algorithm>
#include <fmt/core.h>
#include <vector>

#include "engine/core/error.h"
#include "engine/nurbs/certificate.h"
#include "tests/support/check_layout.h"

namespace spia {

namespace {

/// Shared sides again, from the control points alone.
std::string fault_of_sides(const MultiPatch& patches, int inner_curves)
{
    if (int(patches.interfaces.size()) != inner_curves)
        return fmt::format("{} sides are shared, not {}", patches.interfaces.size(), inner_curves);
    const auto control = [&](PatchSide side, int k) -> Eigen::Vector3d {
        const NurbsSurface& s = patches.patch[size_t(side.patch)];
        switch (side.side) {
        case Side::v0: return s.control.col(k);
        case Side::v1: return s.control.col(k + s.count_u * (s.count_v - 1));
        case Side::u0: return s.control.col(k * s.count_u);
        default: return s.control.col(k * s.count_u + s.count_u - 1);
        }
    };
    const auto count = [&](PatchSide side) {
        const NurbsSurface& s = patches.patch[size_t(side.patch)];
        return side.side == Side::v0 || side.side == Side::v1 ? s.count_u : s.count_v;
    };
    for (const PatchInterface& joint : patches.interfaces) {
        const int n = count(joint.first);
        if (n != count(joint.second))
            return fmt::format("patches {} and {} share a side of other counts", joint.first.patch, joint.second.patch);
        for (int k = 0; k < n; ++k)
            if (control(joint.first, k) != control(joint.second, joint.reversed ? n - 1 - k : k))
                return fmt::format("patches {} and {} differ in a control point of their side", joint.first.patch,
                                   joint.second.patch);
    }
    return "";
}

int inner_curves(const Layout& layout)
{
    return int(
        std::count_if(layout.curve.begin(), layout.curve.end(), [](const LayoutCurve& c) { return !c.on_border(); }));
}

} // namespace

LayoutRun run_layout(const shapes::RandomOutline& drawn)
{
    LayoutRun result;
    const Eigen::Matrix2Xd plane = drawn.part.position.topRows(2);
    PatchesFitOptions options;
    options.tolerance = 1e-3 * (plane.rowwise().maxCoeff() - plane.rowwise().minCoeff()).norm();
    try {
        const PatchesFit fit = blank_patches(drawn.part, Blank{plane}, {}, options);
        result.patches = int(fit.patches.patch.size());
        result.split = fit.layout.split;
        result.reached = fit.reached;
        result.attempts = fit.attempts;
        result.fault = shapes::fault_of_layout(fit.layout, drawn.part, Blank{plane});
        if (result.fault.empty())
            result.fault = fault_of_sides(fit.patches, inner_curves(fit.layout));
        const Certificate certificate = certify(fit.patches);
        for (size_t p = 0; p < certificate.patch.size() && result.fault.empty(); ++p)
            if (const auto& refusal = certificate.patch[p].refusal)
                result.fault = fmt::format("patch {} {}", p, describe(*refusal));
    } catch (const InputError& error) {
        result.fault = error.what();
    }
    return result;
}

} // namespace spia

#include "engine/mesh/solid/border/beside_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/solid/border/sheet_section.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Of the vertices of a boundary loop, and in between of the middles of its edges: a corner may be
/// beside its place along one of the walls that meet there.
std::vector<BorderPlace> places_of(const std::vector<int>& loop, const TriMesh& middle, const Eigen::Matrix3Xd& normal)
{
    std::vector<BorderPlace> result;
    const auto place = [&](size_t k) { return Eigen::Vector3d(middle.position.col(loop[k % loop.size()])); };
    for (size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector3d here = place(i), next = place(i + 1), n = normal.col(loop[i]),
                              before = (here - place(i + loop.size() - 1)).cross(n).normalized(),
                              after = (next - here).cross(n).normalized();
        constexpr double cusp = 0.26; // cosine of 75 degrees
        const bool judged = (before + after).norm() > 2 * cusp;
        const Eigen::Vector3d outward = judged ? (before + after).normalized() : Eigen::Vector3d::Zero();
        result.push_back({here, n, outward});
        const Eigen::Vector3d between = (n + normal.col(loop[(i + 1) % loop.size()])).normalized();
        result.push_back({(here + next) / 2, between, (next - here).cross(between).normalized()});
    }
    return result;
}

/// How far a place is beside the border of the solid, mm; 0: it is not.
/// @param deflection  mm, of the solid's facets
double beside(const BorderPlace& at, const SheetSection& section, double tolerance, double deflection, double most)
{
    if (at.outward.isZero())
        return 0;
    const std::optional<double> askew = section.to_askew_wall(at);
    if (!askew && (section.ends(at, tolerance) || section.steps_to_another_leg(at, tolerance)))
        return 0;
    constexpr double nearby = 8;                                                 // tolerances
    constexpr int digits = 10;                                                   // a thousandth of what is told
    const double arcs = section.facets(at, nearby * tolerance + 2 * deflection), // or of a blunt corner
        within = tolerance + (deflection > 0 ? std::min(arcs, deflection) : arcs);
    if (askew)
        return std::abs(*askew) <= within ? 0 : *askew;
    const double end = section.to_the_end(at, tolerance, most, digits);
    return section.ends(at, within) || section.halfway_along_a_wall(at, end, within) ? 0 : end;
}

/// Near the ends of long edges at square walls, where their middles say the least: one end may be
/// right, and the other beside its place by twice as much. By more something else is over it.
/// @param at  of the loop, as places_of() has them
/// @param beside  of each; those of edges that are right in the middle get what an end is off
void look_at_ends(const std::vector<BorderPlace>& at, const SheetSection& section, double tolerance, double longer,
                  const auto& beside_at, std::vector<double>& beside)
{
    constexpr double near = 0.9, most = 4; // of the way from the middle; tolerances
    const size_t n = at.size();
    for (size_t i = 1; i < n; i += 2)
        for (const size_t corner : {i - 1, (i + 1) % n}) {
            const Eigen::Vector3d half = at[corner].place - at[i].place;
            if (beside[i] != 0 || half.norm() < longer / 2 || !section.square_wall(at[i], tolerance))
                continue;
            const double off = beside_at({at[i].place + near * half, at[i].normal, at[i].outward});
            beside[i] = std::abs(off) <= most * tolerance ? off : 0;
        }
}

} // namespace

std::vector<BesideLoop> beside_loops(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance,
                                     double deflection)
{
    std::vector<BesideLoop> result;
    const SheetSection section(solid, thickness);
    const Eigen::Matrix3Xd normal = vertex_normals(middle);
    constexpr double most = 8; // thicknesses that are looked at
    const auto beside_at = [&](const BorderPlace& at) {
        return beside(at, section, tolerance, deflection, most * thickness);
    };
    for (std::vector<int>& loop : boundary_loops(middle)) {
        BesideLoop here{std::move(loop), {}};
        const std::vector<BorderPlace> places = places_of(here.vertex, middle, normal);
        for (const BorderPlace& at : places)
            here.beside.push_back(beside_at(at));
        look_at_ends(places, section, tolerance, thickness, beside_at, here.beside);
        result.push_back(std::move(here));
    }
    return result;
}

std::vector<BesideSolid> beside_solid(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance,
                                      double deflection)
{
    std::vector<BesideSolid> result;
    for (const BesideLoop& loop : beside_loops(middle, solid, thickness, tolerance, deflection)) {
        const std::vector<double>& off = loop.beside;
        // no row runs over the end of the loop
        const auto first = std::ranges::find(off, 0.0) - off.begin();
        const size_t start = first == std::ssize(off) ? 0 : size_t(first);
        bool in_row = false;
        for (size_t k = 0; k < off.size(); ++k) {
            const size_t i = (start + k) % off.size();
            const auto at = [&](size_t v) { return middle.position.col(loop.vertex[v % loop.vertex.size()]); };
            const BesideSolid here{i % 2 == 0 ? Eigen::Vector3d(at(i / 2)) : (at(i / 2) + at(i / 2 + 1)) / 2, off[i]};
            if (off[i] != 0 && !in_row)
                result.push_back(here);
            else if (off[i] != 0 && std::abs(off[i]) > std::abs(result.back().beside))
                result.back() = here;
            in_row = off[i] != 0;
        }
    }
    return result;
}

} // namespace spia

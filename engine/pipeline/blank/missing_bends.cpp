#include "engine/pipeline/blank/missing_bends.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "engine/core/place_text.h"
#include "engine/core/small_dense.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

/// An edge over which the sheet turns as from chord to chord.
struct TurningEdge {
    int face, other;
    Eigen::Vector3d middle; ///< mm
};

constexpr double degree = std::numbers::pi / 180;

/// Those beside which no face is of a bend over a cylinder.
/// @param normal  area_vectors()
std::vector<TurningEdge> turning_edges(const TriMesh& part, const Eigen::Matrix3Xd& normal, const BendTable& table)
{
    constexpr double curved = 0.5 * degree, sharp = 40 * degree; // as between chords
    std::vector<char> bent(size_t(part.triangles()), 0);
    for (const SheetBend& bend : table.bends)
        for (const int f : bend.sharp ? std::vector<int>{} : bend.faces)
            bent[size_t(f)] = 1;
    std::vector<TurningEdge> result;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const int f = uses[begin].face, g = uses[begin + 1].face;
        const double turn = angle_between(normal.col(f), normal.col(g));
        if (!bent[size_t(f)] && !bent[size_t(g)] && turn > curved && turn < sharp)
            result.push_back({f, g, (part.position.col(uses[begin].low) + part.position.col(uses[begin].high)) / 2});
    });
    return result;
}

/// Whether the sheet of a patch turns, around one direction only, and over edges beside each other.
/// What the digits tilt is of little area beside flats, and these are not turned by it.
bool is_bent(const Eigen::Matrix3Xd& normal, const std::vector<TurningEdge>& edges, double apart)
{
    std::set<int> faces;
    for (const TurningEdge& edge : edges)
        faces.insert({edge.face, edge.other});
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const int f : faces)
        scatter += normal.col(f) * normal.col(f).transpose() / normal.col(f).norm();
    const EigenPairs<3> axes = eigen_pairs(scatter);
    constexpr double askew = 0.05, turned = 5 * degree; // the sine of 3 degrees
    const double turn = std::sin(turned / 2) * std::sin(turned / 2);
    if (axes.value[0] > askew * askew * scatter.trace() || axes.value[1] < turn * scatter.trace())
        return false;
    const Eigen::Vector3d axis = axes.vector.col(0);
    return std::ranges::any_of(edges, [&](const TurningEdge& edge) {
        return (edge.middle - edges.front().middle).cross(axis).norm() > apart;
    });
}

} // namespace

void doubt_missing_bends(const PartFile& part, BendTable& table)
{
    // Finer digits move corners by less than cylinders may be off, a thousandth of the thickness.
    constexpr double coarse = 2.5e-4, apart = 0.1; // of the thickness
    if (!part.solid || part.solid->rounding.value_or(0) < coarse * table.thickness)
        return;
    const double rounding = *part.solid->rounding;
    const Eigen::Matrix3Xd normal = area_vectors(part.mesh);
    const std::vector<TurningEdge> edges = turning_edges(part.mesh, normal, table);
    DisjointSets together(size_t(part.mesh.triangles()));
    for (const TurningEdge& edge : edges)
        together.join(edge.face, edge.other);
    std::vector<std::vector<TurningEdge>> patch(size_t(part.mesh.triangles()));
    for (const TurningEdge& edge : edges)
        patch[size_t(together.root(edge.face))].push_back(edge);
    for (const std::vector<TurningEdge>& each : patch)
        if (!each.empty() && is_bent(normal, each, apart * table.thickness)) {
            table.doubts.push_back(fmt::format(
                "the table of bends may lack some: the sheet turns near ({}), but the digits of the file move its "
                "corners by up to {:.2g} mm, too much to tell a radius there; export the mesh with more decimals, or "
                "the part as STEP",
                place_text(each.front().middle), rounding));
            return;
        }
}

} // namespace spia

#include "engine/deform/deform.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/tessellate.h"

namespace spia {
namespace {

void move_controls(MultiPatch& surface, const std::vector<ControlMove>& moves)
{
    const SharedControls shared = shared_controls(surface);
    std::vector<int> by(size_t(shared.count), -1); // the move of each
    for (size_t m = 0; m < moves.size(); ++m) {
        const ControlMove& move = moves[m];
        if (move.patch < 0 || size_t(move.patch) >= surface.patch.size())
            throw InputError(fmt::format("move {} is of patch {}, but the surface has {}", m + 1, move.patch + 1,
                                         surface.patch.size()));
        const NurbsSurface& patch = surface.patch[size_t(move.patch)];
        if (move.i < 0 || move.i >= patch.count_u || move.j < 0 || move.j >= patch.count_v)
            throw InputError(fmt::format("move {} is of control point ({}, {}), but patch {} has {} x {} of them",
                                         m + 1, move.i, move.j, move.patch + 1, patch.count_u, patch.count_v));
        if (!move.move.allFinite())
            throw InputError(fmt::format("move {} is not a finite number", m + 1));
        int& already = by[size_t(shared.of(move.patch, patch.index(move.i, move.j)))];
        if (already >= 0)
            throw InputError(fmt::format("moves {} and {} are of the same control point", already + 1, m + 1));
        already = int(m);
    }
    for (size_t p = 0; p < surface.patch.size(); ++p)
        for (int c = 0; c < int(surface.patch[p].control.cols()); ++c)
            if (const int m = by[size_t(shared.of(int(p), c))]; m >= 0)
                surface.patch[p].control.col(c) += moves[size_t(m)].move;
}

/// See DeformResult::off_lattice.
double distance_off(const NurbsSurface& before, const NurbsSurface& after, const LatticeMap& map)
{
    const std::vector<double> u = sample_parameters(before.knots_u, before.degree_u, 4),
                              v = sample_parameters(before.knots_v, before.degree_v, 4);
    Eigen::VectorXd off(Eigen::Index(u.size() * v.size()));
    parallel_for(int(off.size()), [&](int n) {
        const double at_u = u[size_t(n) % u.size()], at_v = v[size_t(n) / u.size()];
        const Eigen::Vector3d place = evaluate(before, at_u, at_v).position;
        off[n] = (place + map.displacement(place) - evaluate(after, at_u, at_v).position).norm();
    });
    return off.maxCoeff();
}

} // namespace

bool Deformation::at_rest() const
{
    return (!lattice || lattice->at_rest()) &&
           std::all_of(moves.begin(), moves.end(), [](const ControlMove& m) { return m.move.isZero(0); });
}

DeformResult deform(const MultiPatch& surface, const Deformation& deformation, bool measure)
{
    DeformResult result;
    result.patches = surface;
    move_controls(result.patches, deformation.moves);
    if (deformation.lattice) {
        const LatticeMap map(*deformation.lattice);
        for (NurbsSurface& patch : result.patches.patch) {
            const NurbsSurface before = patch;
            parallel_for(int(patch.control.cols()),
                         [&](int c) { patch.control.col(c) += map.displacement(patch.control.col(c)); });
            if (measure)
                result.off_lattice = std::max(result.off_lattice, distance_off(before, patch, map));
        }
    }
    for (size_t p = 0; p < surface.patch.size(); ++p)
        result.largest = std::max(
            result.largest,
            std::sqrt((result.patches.patch[p].control - surface.patch[p].control).colwise().squaredNorm().maxCoeff()));
    return result;
}

} // namespace spia

#include "engine/exchange/iga/mfem_topology.h"

#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <utility>

#include "engine/core/error.h"

namespace spia {
namespace {

/// A direction of parameters of a patch: 2 p for u, 2 p + 1 for v.
int along(PatchSide side) { return 2 * side.patch + (side.side == Side::u0 || side.side == Side::u1 ? 1 : 0); }

/// Directions that share their knots, and whether they run the same way.
class Strips {
public:
    explicit Strips(size_t directions) : first_(directions), with_(directions, 1)
    {
        for (size_t d = 0; d < directions; ++d)
            first_[d] = int(d);
    }

    struct Place {
        int first; ///< direction of the strip
        int sense; ///< 1 if it runs with the first, -1 against it
    };
    Place of(int direction) const
    {
        int sense = 1;
        for (; first_[size_t(direction)] != direction; direction = first_[size_t(direction)])
            sense *= with_[size_t(direction)];
        return {direction, sense};
    }

    /// @returns false if they are in one strip already and that says otherwise
    bool join(int a, int b, int sense)
    {
        Place x = of(a), y = of(b);
        const int between = x.sense * y.sense * sense;
        if (x.first == y.first)
            return between == 1;
        if (x.first > y.first)
            std::swap(x, y);
        first_[size_t(y.first)] = x.first;
        with_[size_t(y.first)] = between;
        return true;
    }

private:
    std::vector<int> first_, with_;
};

Strips strips(const MultiPatch& patches)
{
    Strips result(2 * patches.patch.size());
    for (const PatchInterface& joint : patches.interfaces)
        if (!result.join(along(joint.first), along(joint.second), joint.reversed ? -1 : 1))
            throw InputError(
                fmt::format("at {} a strip of patches comes back upon itself the other way round, which an MFEM "
                            "mesh cannot say; leave the patches open there",
                            name(joint.first)));
    return result;
}

void number_corners(const MultiPatch& patches, MfemTopology& topology)
{
    const SharedControls shared = shared_controls(patches);
    std::map<int, int> number;
    for (int p = 0; p < int(patches.patch.size()); ++p) {
        const NurbsSurface& s = patches.patch[size_t(p)];
        const int m = s.count_u - 1, n = s.count_v - 1;
        std::array<int, 4> corner{s.index(0, 0), s.index(m, 0), s.index(m, n), s.index(0, n)};
        for (int& c : corner)
            c = number.emplace(shared.of(p, c), int(number.size())).first->second;
        for (size_t a = 0; a < 4; ++a)
            if (std::count(corner.begin(), corner.end(), corner[a]) > 1)
                throw InputError(
                    fmt::format("two corners of patch {} are one, for it is closed in itself, which an MFEM mesh "
                                "cannot say; split the patch",
                                p + 1));
        topology.corner.push_back(corner);
    }
    topology.corners = int(number.size());
}

} // namespace

MfemTopology mfem_topology(const MultiPatch& patches)
{
    MfemTopology topology;
    number_corners(patches, topology);
    const Strips strip = strips(patches);
    std::map<std::pair<int, Side>, PatchSide> before; // the side of an earlier patch that is the
                                                      // same edge
    for (const PatchInterface& joint : patches.interfaces) {
        const bool ordered =
            std::pair(joint.first.patch, joint.first.side) < std::pair(joint.second.patch, joint.second.side);
        const PatchSide &early = ordered ? joint.first : joint.second, &late = ordered ? joint.second : joint.first;
        before.emplace(std::pair(late.patch, late.side), early);
    }
    std::map<int, int> knots;                         // by the first direction of the strip
    std::map<std::pair<int, int>, PatchSide> between; // two corners
    for (int p = 0; p < int(patches.patch.size()); ++p) {
        std::array<int, 4> edge;
        for (const Side side : sides) {
            const auto same = before.find({p, side});
            if (same != before.end()) {
                edge[size_t(side)] = topology.edge[size_t(same->second.patch)][size_t(same->second.side)];
                continue;
            }
            const std::array<int, 4>& c = topology.corner[size_t(p)];
            const std::array<std::pair<int, int>, 4> ends{{{c[0], c[1]}, {c[1], c[2]}, {c[3], c[2]}, {c[0], c[3]}}};
            auto [from, to] = ends[size_t(side)];
            const auto [other, unique] = between.emplace(std::minmax(from, to), PatchSide{p, side});
            if (!unique)
                throw InputError(
                    fmt::format("{} and {} join the same two corners, which an MFEM mesh cannot say; split the "
                                "patches there",
                                name(other->second), name(PatchSide{p, side})));
            const auto [first, sense] = strip.of(along({p, side}));
            if (sense < 0)
                std::swap(from, to);
            edge[size_t(side)] = int(topology.edges.size());
            topology.edges.push_back({knots.emplace(first, int(knots.size())).first->second, from, to});
        }
        topology.edge.push_back(edge);
    }
    return topology;
}

} // namespace spia

#include "engine/nurbs/multi_patch.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/core/error.h"

namespace spia {

namespace {

bool along_u(Side side) { return side == Side::v0 || side == Side::v1; }

/// What keeps two sides from being one curve; nothing if they are one.
std::optional<std::string> difference(const MultiPatch& patches, const PatchInterface& joint)
{
    const NurbsSurface &a = patches.patch[size_t(joint.first.patch)], &b = patches.patch[size_t(joint.second.patch)];
    const int p = side_degree(a, joint.first.side), q = side_degree(b, joint.second.side);
    if (p != q)
        return fmt::format("the degrees are {} and {}", p, q);
    const std::vector<double>&k = side_knots(a, joint.first.side), &l = side_knots(b, joint.second.side);
    const std::vector<int> i = side_controls(patches, joint.first),
                           j = side_controls(patches, joint.second, joint.reversed);
    if (i.size() != j.size() || k.size() != l.size())
        return fmt::format("there are {} and {} control points", i.size(), j.size());
    for (size_t n = 0; n < k.size(); ++n) {
        const double mine = k[n], other = joint.reversed ? l[l.size() - 1 - n] : l[n];
        // 1 - k is rounded where k < 1/2, so that each of the two may be the other's mirror image
        if (joint.reversed ? mine != 1 - other && other != 1 - mine : mine != other)
            return fmt::format("knot {} of the first is {}, that of the second {}", n, mine,
                               joint.reversed ? 1 - other : other);
    }
    for (size_t n = 0; n < i.size(); ++n) {
        const Eigen::Vector3d x = a.control.col(i[n]), y = b.control.col(j[n]);
        if (x != y)
            return fmt::format("control point {} along the first is {:.3g} mm from that of the second", n,
                               (x - y).norm());
        if (a.weight[i[n]] != b.weight[j[n]])
            return fmt::format("the weights of control point {} are {} and {}", n, a.weight[i[n]], b.weight[j[n]]);
    }
    return std::nullopt;
}

bool collapsed(const MultiPatch& patches, PatchSide side)
{
    const Eigen::Matrix3Xd& control = patches.patch[size_t(side.patch)].control;
    const std::vector<int> row = side_controls(patches, side);
    return std::all_of(row.begin(), row.end(), [&](int c) { return control.col(c) == control.col(row.front()); });
}

} // namespace

std::vector<int> side_controls(const NurbsSurface& surface, Side side)
{
    std::vector<int> result;
    if (along_u(side))
        for (int i = 0; i < surface.count_u; ++i)
            result.push_back(surface.index(i, side == Side::v0 ? 0 : surface.count_v - 1));
    else
        for (int j = 0; j < surface.count_v; ++j)
            result.push_back(surface.index(side == Side::u0 ? 0 : surface.count_u - 1, j));
    return result;
}

std::vector<int> side_controls(const MultiPatch& patches, PatchSide side, bool reversed)
{
    std::vector<int> result = side_controls(patches.patch[size_t(side.patch)], side.side);
    if (reversed)
        std::reverse(result.begin(), result.end());
    return result;
}

int side_degree(const NurbsSurface& surface, Side side) { return along_u(side) ? surface.degree_u : surface.degree_v; }

const std::vector<double>& side_knots(const NurbsSurface& surface, Side side)
{
    return along_u(side) ? surface.knots_u : surface.knots_v;
}

std::string name(PatchSide side)
{
    const char* of = side.side == Side::v0   ? "v = 0"
                     : side.side == Side::u1 ? "u = 1"
                     : side.side == Side::v1 ? "v = 1"
                                             : "u = 0";
    return fmt::format("side {} of patch {}", of, side.patch + 1);
}

std::vector<PatchSide> outer_sides(const MultiPatch& patches)
{
    std::vector<PatchSide> result;
    for (int p = 0; p < int(patches.patch.size()); ++p)
        for (const Side side : sides) {
            const PatchSide one{p, side};
            if (std::none_of(patches.interfaces.begin(), patches.interfaces.end(),
                             [&](const PatchInterface& i) { return i.first == one || i.second == one; }))
                result.push_back(one);
        }
    return result;
}

void require_watertight(const MultiPatch& patches)
{
    std::vector<PatchSide> taken;
    for (const PatchInterface& joint : patches.interfaces) {
        for (const PatchSide side : {joint.first, joint.second}) {
            if (side.patch < 0 || side.patch >= int(patches.patch.size()))
                throw InputError(fmt::format("an interface names patch {}, but there are {}; join the patches again",
                                             side.patch + 1, patches.patch.size()));
            if (std::find(taken.begin(), taken.end(), side) != taken.end())
                throw InputError(fmt::format("{} is in two interfaces; split the patches so that each side has one "
                                             "neighbour",
                                             name(side)));
            taken.push_back(side);
        }
        if (const auto what = difference(patches, joint))
            throw InputError(fmt::format("{} and {} are not the same curve: {}; fit the patches with shared borders",
                                         name(joint.first), name(joint.second), *what));
    }
}

SharedControls shared_controls(const MultiPatch& patches)
{
    SharedControls result;
    for (const NurbsSurface& patch : patches.patch) {
        result.offset.push_back(int(result.number.size()));
        result.number.resize(result.number.size() + size_t(patch.count_u) * size_t(patch.count_v));
    }
    std::vector<int> parent(result.number.size()); // the first of those that are one
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int c) {
        while (parent[size_t(c)] != c)
            c = parent[size_t(c)] = parent[size_t(parent[size_t(c)])];
        return c;
    };
    for (const PatchInterface& joint : patches.interfaces) {
        const std::vector<int> i = side_controls(patches, joint.first),
                               j = side_controls(patches, joint.second, joint.reversed);
        for (size_t k = 0; k < i.size(); ++k) {
            const int a = root(result.offset[size_t(joint.first.patch)] + i[k]),
                      b = root(result.offset[size_t(joint.second.patch)] + j[k]);
            parent[size_t(std::max(a, b))] = std::min(a, b);
        }
    }
    for (size_t c = 0; c < parent.size(); ++c) {
        const int first = root(int(c));
        result.number[c] = first == int(c) ? result.count++ : result.number[size_t(first)];
    }
    return result;
}

int singular_nodes(const MultiPatch& patches)
{
    const SharedControls shared = shared_controls(patches);
    std::vector<int> meeting(size_t(shared.count), 0); // per control point the patches with that corner
    for (int p = 0; p < int(patches.patch.size()); ++p)
        for (const Side side : {Side::v0, Side::v1}) {
            const std::vector<int> along = side_controls(patches.patch[size_t(p)], side);
            ++meeting[size_t(shared.of(p, along.front()))];
            ++meeting[size_t(shared.of(p, along.back()))];
        }
    for (const PatchSide& border : outer_sides(patches)) {
        const std::vector<int> along = side_controls(patches.patch[size_t(border.patch)], border.side);
        meeting[size_t(shared.of(border.patch, along.front()))] = 0;
        meeting[size_t(shared.of(border.patch, along.back()))] = 0;
    }
    return int(std::ranges::count_if(meeting, [](int count) { return count != 0 && count != 4; }));
}

namespace {

/// The first and the last control point of a side, the smaller one first.
std::array<double, 6> ends_of(const NurbsSurface& surface, Side side)
{
    const std::vector<int> along = side_controls(surface, side);
    std::array<double, 3> a, b;
    for (int k = 0; k < 3; ++k) {
        a[size_t(k)] = surface.control(k, along.front());
        b[size_t(k)] = surface.control(k, along.back());
    }
    if (b < a)
        std::swap(a, b);
    return {a[0], a[1], a[2], b[0], b[1], b[2]};
}

} // namespace

MultiPatch joined(std::vector<NurbsSurface> patches)
{
    MultiPatch result{std::move(patches), {}};
    std::vector<PatchSide> open;
    // the same curve has the same ends
    std::map<std::array<double, 6>, std::vector<size_t>> by_ends;
    std::vector<const std::vector<size_t>*> candidates;
    for (int p = 0; p < int(result.patch.size()); ++p)
        for (const Side side : sides)
            if (!collapsed(result, {p, side})) {
                auto& beside = by_ends[ends_of(result.patch[size_t(p)], side)];
                beside.push_back(open.size());
                candidates.push_back(&beside);
                open.push_back({p, side});
            }
    for (size_t a = 0; a < open.size(); ++a)
        for (const size_t b : *candidates[a]) {
            if (b <= a)
                continue;
            const bool same = !difference(result, {open[a], open[b], false});
            const bool mirrored = !difference(result, {open[a], open[b], true});
            if (same && mirrored)
                throw InputError(fmt::format("{} and {} are the same curve both ways; split the patches there",
                                             name(open[a]), name(open[b])));
            if (same || mirrored)
                result.interfaces.push_back({open[a], open[b], mirrored});
        }
    require_watertight(result);
    return result;
}

} // namespace spia

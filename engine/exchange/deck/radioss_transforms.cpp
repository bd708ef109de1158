#include "engine/exchange/deck/radioss_transforms.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/core/read_number.h"

namespace spia {

bool RadiossTransforms::begin_group(std::string_view kind, std::int64_t id)
{
    if (kind != "NODE" && kind != "PART")
        return false;
    group_ = submodels_.shifted(id, &RadiossOffsets::other);
    groups_[group_] = {kind == "PART", {}};
    return true;
}

bool RadiossTransforms::begin_transform(std::string_view kind, bool other_unit)
{
    constexpr std::array<std::string_view, 4> names = {"TRA", "ROT", "SYM", "SCA"};
    const auto found = std::find(names.begin(), names.end(), kind);
    if (found == names.end() || other_unit)
        return false;
    transforms_.push_back({.kind = Kind(found - names.begin())});
    return true;
}

void RadiossTransforms::group(std::string_view line, int card)
{
    if (card == 0)
        return;
    fields_.cut_columns(line, std::array{10, 10, 10, 10, 10, 10, 10, 10, 10, 10});
    Group& group = groups_[group_];
    for (size_t k = 0; k < 10; ++k)
        if (const std::int64_t id = lines_.whole_or_zero(fields_[k]); id != 0)
            group.ids.push_back(submodels_.shifted(id, group.of_parts ? &RadiossOffsets::part : &RadiossOffsets::node));
}

void RadiossTransforms::transform(std::string_view line, int card)
{
    Transform& made = transforms_.back();
    fields_.cut_columns(line, std::array{10, 20, 20, 20, 10, 10, 10});
    if (card == 1) {
        made.group = submodels_.shifted(lines_.whole_or_zero(fields_[0]), &RadiossOffsets::other);
        made.inside = submodels_.current();
        made.first = (made.kind == Kind::sca ? 1 : submodels_.length()) * vector(1);
        const size_t nodes = made.kind == Kind::sca ? 1 : 2;
        for (size_t k = 0; k < nodes; ++k)
            made.node[k] = submodels_.shifted(lines_.whole_or_zero(fields_[4 + k]), &RadiossOffsets::node);
        made.submodel = submodels_.shifted(lines_.whole_or_zero(fields_[4 + nodes]), &RadiossOffsets::submodel);
    } else if (card == 2) {
        made.second = submodels_.length() * vector(1);
        fields_.cut_columns(line, std::array{10, 20, 20, 20, 20});
        if (made.kind == Kind::rot && !fields_[4].empty())
            made.angle = lines_.number(fields_[4]);
    }
}

Eigen::Vector3d RadiossTransforms::vector(size_t first) const
{
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < 3; ++k)
        if (const std::string_view field = fields_[first + k]; !field.empty())
            x[Eigen::Index(k)] = lines_.coordinate(field);
    return x;
}

std::optional<Eigen::Affine3d> RadiossTransforms::move_of(const Transform& transform, int submodel)
{
    Eigen::Vector3d first = transform.first, second = transform.second;
    Eigen::Affine3d move = Eigen::Affine3d::Identity();
    for (const size_t k : {0, 1})
        if (transform.node[k] != 0) {
            const auto number = deck_.number_of_node(transform.node[k]);
            if (!number)
                return std::nullopt;
            const Eigen::Vector3d place = *deck_.node(transform.node[k]);
            const bool moved = submodel >= 0 && submodels_.owner(*number) == submodel;
            (k == 0 ? first : second) = moved ? Eigen::Vector3d(moves_[size_t(submodel)] * place) : place;
        }
    const Eigen::Vector3d way = second - first;
    switch (transform.kind) {
    case Kind::tra:
        move.translation() = transform.node[0] != 0 && transform.node[1] != 0 ? way : transform.first;
        return move;
    case Kind::sca: { // about a node or the origin; what is not given is 1
        const Eigen::Vector3d about = transform.node[0] != 0 ? first : Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            move.linear()(k, k) = transform.first[k] != 0 ? transform.first[k] : 1;
        move.translation() = about - move.linear() * about;
        return move;
    }
    case Kind::rot:
    case Kind::sym: break;
    }
    if (!(way.norm() > 0))
        return std::nullopt;
    const Eigen::Vector3d n = way.normalized();
    if (transform.kind == Kind::rot)
        return Eigen::Translation3d(first) * Eigen::AngleAxisd(transform.angle * std::numbers::pi / 180, n) *
               Eigen::Translation3d(-first);
    move.linear() -= 2 * n * n.transpose();
    move.translation() = 2 * n.dot(first) * n;
    return move;
}

/// By the moves of its own, then by those of the submodels around it.
void RadiossTransforms::move_submodels()
{
    moves_.assign(size_t(submodels_.count()), Eigen::Affine3d::Identity());
    for (const Transform& transform : transforms_) {
        if (transform.submodel == 0)
            continue;
        const auto submodel = submodels_.find(transform.submodel);
        const bool is_rigid = transform.kind == Kind::tra || transform.kind == Kind::rot;
        const auto move = submodel && is_rigid && transform.group == 0 ? move_of(transform, *submodel) : std::nullopt;
        if (move)
            moves_[size_t(*submodel)] = *move * moves_[size_t(*submodel)];
        else
            deck_.count_unread_geometry("/TRANSFORM of a submodel");
    }
    for (int s = 0; s < submodels_.count(); ++s)
        if (const int father = submodels_.father(s); father >= 0)
            moves_[size_t(s)] = moves_[size_t(father)] * moves_[size_t(s)];
    for (const auto& [submodel, range] : submodels_.nodes())
        deck_.move_range(range, moves_[size_t(submodel)]);
}

/// Where it stands in a submodel that is moved, its points and its way are moved with it.
void RadiossTransforms::take_inside(Transform& transform) const
{
    if (transform.inside < 0)
        return;
    const Eigen::Affine3d& move = moves_[size_t(transform.inside)];
    if (transform.kind == Kind::tra)
        transform.first = move.linear() * transform.first;
    else if (transform.kind != Kind::sca) {
        transform.first = move * transform.first;
        transform.second = move * transform.second;
    }
}

void RadiossTransforms::spend(std::uint64_t nodes)
{
    constexpr std::uint64_t most = 1'000'000'000; // about ten seconds
    work_ += nodes;
    if (work_ > most)
        lines_.fail("the /TRANSFORM of this deck move too many nodes too often");
}

void RadiossTransforms::move_group(const Transform& transform)
{
    Transform meant = transform;
    take_inside(meant);
    const auto group = groups_.find(meant.group);
    const bool turned_factors =
        meant.kind == Kind::sca && meant.inside >= 0 && !moves_[size_t(meant.inside)].linear().isIdentity(0);
    const bool all_of_submodel = meant.group == 0 && meant.inside >= 0;
    const auto move = move_of(meant, -1);
    if (!move || turned_factors || all_of_submodel || (meant.group != 0 && group == groups_.end())) {
        deck_.count_unread_geometry("/TRANSFORM");
        return;
    }
    spend(deck_.nodes());
    if (meant.group == 0)
        return deck_.move_all_nodes(*move);
    std::vector<std::int64_t> ids = group->second.ids;
    spend(ids.size());
    if (group->second.of_parts) {
        ids.clear();
        for (const std::int64_t part : group->second.ids) {
            spend(deck_.shells());
            const auto nodes = deck_.nodes_of(deck_.part(part));
            ids.insert(ids.end(), nodes.begin(), nodes.end());
        }
    }
    std::sort(ids.begin(), ids.end());
    deck_.move_nodes(ids, *move);
}

void RadiossTransforms::apply()
{
    move_submodels();
    for (const Transform& transform : transforms_)
        if (transform.submodel == 0)
            move_group(transform);
}

} // namespace spia

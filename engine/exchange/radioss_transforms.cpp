#include "engine/exchange/radioss_transforms.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/exchange/deck_number.h"

namespace spia {

bool RadiossTransforms::begin_group(std::string_view kind, std::int64_t id)
{
    if (kind != "NODE" && kind != "PART")
        return false;
    group_ = id;
    groups_[id] = {kind == "PART", {}};
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
    for (size_t k = 0; k < 10; ++k)
        if (const std::int64_t id = lines_.whole_or_zero(fields_[k]); id != 0)
            groups_[group_].ids.push_back(id);
}

void RadiossTransforms::transform(std::string_view line, int card)
{
    Transform& made = transforms_.back();
    fields_.cut_columns(line, std::array{10, 20, 20, 20, 10, 10, 10});
    if (card == 1) {
        made.group = lines_.whole_or_zero(fields_[0]);
        made.first = vector(1);
        const size_t nodes = made.kind == Kind::sca ? 1 : 2;
        for (size_t k = 0; k < nodes; ++k)
            made.node[k] = lines_.whole_or_zero(fields_[4 + k]);
        made.submodel = lines_.whole_or_zero(fields_[4 + nodes]);
    } else if (card == 2) {
        made.second = vector(1);
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

std::optional<Eigen::Affine3d> RadiossTransforms::move_of(const Transform& transform) const
{
    Eigen::Vector3d first = transform.first, second = transform.second;
    Eigen::Affine3d move = Eigen::Affine3d::Identity();
    for (const size_t k : {0, 1})
        if (transform.node[k] != 0) {
            const auto place = deck_.node(transform.node[k]);
            if (!place)
                return std::nullopt;
            (k == 0 ? first : second) = *place;
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

void RadiossTransforms::apply()
{
    for (const Transform& transform : transforms_) {
        const auto move = move_of(transform);
        const auto group = groups_.find(transform.group);
        if (!move || transform.submodel != 0 || (transform.group != 0 && group == groups_.end())) {
            deck_.count_unread_geometry("/TRANSFORM");
            continue;
        }
        if (transform.group == 0) {
            deck_.move_all_nodes(*move);
            continue;
        }
        std::vector<std::int64_t> ids = group->second.ids;
        if (group->second.of_parts) {
            ids.clear();
            for (const std::int64_t part : group->second.ids) {
                const auto nodes = deck_.nodes_of(deck_.part(part));
                ids.insert(ids.end(), nodes.begin(), nodes.end());
            }
        }
        std::sort(ids.begin(), ids.end());
        deck_.move_nodes(ids, *move);
    }
}

} // namespace spia

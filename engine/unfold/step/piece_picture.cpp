#include "engine/unfold/step/piece_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/edge_uses.h"
#include "engine/unfold/target/turn_target.h"

namespace spia {
namespace {

/// Sheet that goes around once and is cut somewhere: one side of the cut is where the other is, a
/// turn away.
/// @param edges between the held vertices
PiecePicture around_once(const TargetSurface& target, Eigen::Matrix2Xd held,
                         const std::vector<std::array<int, 2>>& edges)
{
    PiecePicture out{target, std::nullopt, std::move(held)};
    auto* cone = std::get_if<ConeFace>(&out.target);
    if (!cone) // of a cylinder the development goes on and on
        return out;
    Eigen::VectorXd angle(out.held.cols());
    for (Eigen::Index k = 0; k < angle.size(); ++k)
        angle[k] = std::atan2(-out.held(0, k), out.held(1, k));
    // A cone's development is less than a turn wide: its middle comes to the middle, by the way
    // from the first vertex.
    const double around = middle_around(angle, edges).value_or(angle[0]),
                 middle = angle[0] - std::remainder(angle[0] - around, 2 * std::numbers::pi),
                 turn = (cone->bulges ? -1 : 1) * middle / std::sin(cone->half_angle);
    cone->towards = Eigen::AngleAxisd(turn, cone->axis) * cone->towards;
    out.held = (Eigen::Rotation2Dd(-middle).toRotationMatrix() * out.held).eval();
    return out;
}

} // namespace

std::optional<Eigen::Matrix2Xd> unwound_piece(const FreedPiece& piece, const Eigen::Matrix3Xd& now,
                                              const TargetSurface& target)
{
    const int first = piece.held.front();
    const auto number = [&](int v) { return v == first ? 0 : v == 0 ? first : v; };
    std::vector<std::array<int, 2>> edges;
    const std::vector<EdgeUse> uses = edge_uses(piece.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t) {
        edges.push_back({number(uses[begin].low), number(uses[begin].high)});
    });
    Eigen::Matrix3Xd point = now;
    point.col(0).swap(point.col(first));
    std::optional<Eigen::Matrix2Xd> place = unwound(target, point, edges);
    if (place)
        place->col(0).swap(place->col(first));
    return place;
}

PiecePicture picture_of(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target)
{
    std::vector<int> number(size_t(piece.mesh.vertices()), -1);
    for (size_t k = 0; k < piece.held.size(); ++k)
        number[size_t(piece.held[k])] = int(k);
    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : piece.hinge)
        edges.push_back({number[size_t(a)], number[size_t(b)]});
    const Eigen::Matrix3Xd point = now(Eigen::all, piece.held);
    PiecePicture out{target, std::nullopt, Eigen::Matrix2Xd(2, point.cols())};
    if (const std::optional<TargetSurface> turned = turned_towards(target, point, edges)) {
        out.target = *turned;
        for (Eigen::Index k = 0; k < point.cols(); ++k)
            out.held.col(k) = developed(out.target, point.col(k));
        return out;
    }
    if (const std::optional<Eigen::Matrix2Xd> open = unwound_piece(piece, now, target))
        return around_once(target, (*open)(Eigen::all, piece.held), edges);
    if (surface_type(piece.mesh).loops < 2)
        throw InputError(fmt::format("the freed faces around face {} close the {} that they are joined to all the way "
                                     "around; free the other side in their place, or flatten the part",
                                     piece.face[0], name(target)));
    out.ring = RingChart::around(target, piece, now);
    for (Eigen::Index k = 0; k < point.cols(); ++k)
        out.held.col(k) = out.ring->place(point.col(k));
    return out;
}

} // namespace spia

#include "app/viewer/model/picking/section.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/core/small_dense.h"

namespace spia::viewer {
namespace {

using Edge = std::pair<int, int>;
constexpr Edge no_edge{-1, -1}; ///< where the drawn line begins or ends, within a face

/// A piece before it has its place in a curve.
struct LoosePiece {
    SectionPiece piece;
    std::array<Edge, 2> end; ///< the edges of the mesh on which it begins and ends
};

std::vector<LoosePiece> loose_pieces(const TriMesh& mesh, const Eigen::VectorXd& value, const SectionLine& line)
{
    const Eigen::Vector3d whole = line.to - line.from, along = whole.normalized();
    const Eigen::Vector3d normal = along.cross(line.depth).normalized();
    const double length = whole.norm();
    struct Cut {
        Eigen::Vector3d place;
        double distance, value;
        Edge edge;
    };
    std::vector<LoosePiece> pieces;
    for (int f = 0; f < mesh.triangles(); ++f) {
        Eigen::Vector3d height;
        for (int a = 0; a < 3; ++a)
            height[a] = normal.dot(mesh.position.col(mesh.triangle(a, f)) - line.from);
        Cut cut[2];
        int cuts = 0;
        for (int a = 0; a < 3 && cuts < 2; ++a) {
            const int b = (a + 1) % 3, v = mesh.triangle(a, f), w = mesh.triangle(b, f);
            if ((height[a] < 0) == (height[b] < 0))
                continue;
            const double t = height[a] / (height[a] - height[b]);
            const Eigen::Vector3d place = (1 - t) * mesh.position.col(v) + t * mesh.position.col(w);
            cut[cuts++] = {place, along.dot(place - line.from), (1 - t) * value[v] + t * value[w], std::minmax({v, w})};
        }
        if (cuts < 2)
            continue;
        if (cut[0].distance > cut[1].distance)
            std::swap(cut[0], cut[1]);
        if (cut[1].distance < 0 || cut[0].distance > length)
            continue;
        const Cut first = cut[0], last = cut[1];
        const auto at = [&](double distance) -> Cut { // on the piece, where the line begins or ends
            const double span = last.distance - first.distance, t = span > 0 ? (distance - first.distance) / span : 0;
            return {first.place + t * (last.place - first.place), distance,
                    first.value + t * (last.value - first.value), no_edge};
        };
        if (first.distance < 0)
            cut[0] = at(0);
        if (last.distance > length)
            cut[1] = at(length);
        pieces.push_back({{f, cut[0].place, cut[1].place, cut[0].distance, cut[1].distance, cut[0].value, cut[1].value},
                          {cut[0].edge, cut[1].edge}});
    }
    return pieces;
}

void turn_around(SectionPiece& piece)
{
    std::swap(piece.from, piece.to);
    std::swap(piece.from_distance, piece.to_distance);
    std::swap(piece.from_value, piece.to_value);
}

/// Pieces joined over the edges they share, each curve from its end with the smaller distance.
std::vector<std::vector<SectionPiece>> joined(const std::vector<LoosePiece>& loose)
{
    std::map<Edge, std::vector<std::pair<int, int>>> on_edge; // pieces and which of their ends
    for (int k = 0; k < int(loose.size()); ++k)
        for (int e = 0; e < 2; ++e)
            if (loose[size_t(k)].end[size_t(e)] != no_edge)
                on_edge[loose[size_t(k)].end[size_t(e)]].push_back({k, e});
    std::vector<char> used(loose.size());
    // the other piece at this end
    const auto beyond = [&](int k, int e) -> std::optional<std::pair<int, int>> {
        const Edge edge = loose[size_t(k)].end[size_t(e)];
        if (edge == no_edge)
            return std::nullopt;
        for (const auto& other : on_edge[edge])
            if (other.first != k && !used[size_t(other.first)])
                return other;
        return std::nullopt;
    };
    std::vector<std::vector<SectionPiece>> curves;
    const auto trace = [&](int start, int entered) {
        std::vector<SectionPiece> curve;
        for (std::optional<std::pair<int, int>> at = std::pair(start, entered); at;) {
            const auto [k, e] = *at;
            used[size_t(k)] = 1;
            curve.push_back(loose[size_t(k)].piece);
            if (e == 1)
                turn_around(curve.back());
            at = beyond(k, 1 - e);
        }
        if (curve.back().to_distance < curve.front().from_distance) {
            std::reverse(curve.begin(), curve.end());
            for (SectionPiece& piece : curve)
                turn_around(piece);
        }
        curves.push_back(std::move(curve));
    };
    for (int k = 0; k < int(loose.size()); ++k) // from their ends
        for (int e = 0; e < 2; ++e) {
            const Edge edge = loose[size_t(k)].end[size_t(e)];
            if (!used[size_t(k)] && (edge == no_edge || on_edge[edge].size() == 1))
                trace(k, e);
        }
    for (int k = 0; k < int(loose.size()); ++k) // closed ones have none
        if (!used[size_t(k)])
            trace(k, 0);
    std::stable_sort(curves.begin(), curves.end(),
                     [](const auto& a, const auto& b) { return a.front().from_distance < b.front().from_distance; });
    return curves;
}

/// The arc length at which some pieces have come that far along the line.
double arc_at(const std::vector<SectionPiece>& pieces, size_t from, double distance)
{
    for (size_t k = from; k < pieces.size(); ++k) {
        const SectionPiece& piece = pieces[k];
        const double span = piece.to_distance - piece.from_distance;
        if (distance >= piece.from_distance && distance <= piece.to_distance && span > 0)
            return piece.from_arc + (distance - piece.from_distance) / span * (piece.to_arc - piece.from_arc);
    }
    return pieces[from].from_arc;
}

} // namespace

std::vector<SectionPiece> section(const TriMesh& mesh, const Eigen::VectorXd& value, const SectionLine& line)
{
    std::vector<SectionPiece> result;
    size_t main = 0; // the first piece of the curve that others lie above or below
    double far = 0, far_arc = 0;
    int number = 0;
    for (std::vector<SectionPiece>& curve : joined(loose_pieces(mesh, value, line))) {
        const double start = curve.front().from_distance;
        const bool goes_on = result.empty() || start >= far;
        double arc = result.empty() ? 0 : goes_on ? far_arc + start - far : arc_at(result, main, start);
        if (goes_on)
            main = result.size();
        for (SectionPiece& piece : curve) {
            piece.curve = number;
            piece.from_arc = arc;
            arc = piece.to_arc = arc + (piece.to - piece.from).norm();
            if (goes_on && (result.size() == main || piece.to_distance > far)) {
                far = piece.to_distance;
                far_arc = arc;
            }
            result.push_back(piece);
        }
        ++number;
    }
    return result;
}

std::vector<SectionPiece> carried(std::vector<SectionPiece> pieces, const TriMesh& from, const TriMesh& to)
{
    for (SectionPiece& piece : pieces) {
        const Eigen::Matrix3d before = from.position(Eigen::all, from.triangle.col(piece.face)),
                              after = to.position(Eigen::all, to.triangle.col(piece.face));
        Eigen::MatrixXd sides(3, 2);
        sides << before.col(1) - before.col(0), before.col(2) - before.col(0);
        for (Eigen::Vector3d* place : {&piece.from, &piece.to}) {
            const Eigen::Vector2d share = least_squares(sides, *place - before.col(0));
            *place = (1 - share.sum()) * after.col(0) + share[0] * after.col(1) + share[1] * after.col(2);
        }
    }
    return pieces;
}

std::optional<SectionPlace> place_at(const std::vector<SectionPiece>& pieces, double arc)
{
    for (size_t k = 0; k < pieces.size(); ++k) {
        const double span = pieces[k].to_arc - pieces[k].from_arc;
        if (arc >= pieces[k].from_arc && arc <= pieces[k].to_arc)
            return SectionPlace{k, span > 0 ? (arc - pieces[k].from_arc) / span : 0};
    }
    return std::nullopt;
}

} // namespace spia::viewer

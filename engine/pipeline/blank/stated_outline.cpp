#include "engine/pipeline/blank/stated_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/nearest_share.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/flat_zones.h"

namespace spia {
namespace {

using std::numbers::pi;
using Kind = OutlinePiece::Kind;

/// A loop of the outline. Edge k runs from point k to the next.
struct Border {
    std::vector<Eigen::Vector2d> at;
    std::vector<const FlatZone*> zone; ///< per edge; null: none
    std::vector<int> curve;            ///< per edge, -1: none, and where there is no zone

    int size() const { return int(at.size()); }
    const Eigen::Vector2d& point(int k) const { return at[size_t(k % size())]; }
    bool stated(int k) const { return curve[size_t(k)] >= 0; }
};

/// Where CAD curves lie along the loops of a part.
class Borders {
public:
    Borders(const PartFile& part, const Blank& blank)
        : part_(part), blank_(blank), zones_(part, blank),
          before_(part.remeshed ? *part.remeshed->original : part.mesh),
          number_(part.remeshed ? part.remeshed->original_vertex : part.source_vertex)
    {
        if (!part.remeshed)
            return;
        loops_before_ = boundary_loops(before_);
        search_.emplace(part.mesh);
    }

    Border of(const std::vector<int>& loop) const
    {
        if (!part_.remeshed)
            return of_mesh(loop);
        return as_before(loop).value_or(bare(loop));
    }
    double within() const { return zones_.within; }

private:
    /// What is known of the edge from one vertex of a loop of the first mesh to the next. Vertices
    /// on a divided chord are called by the number of the end that they come after. @param face of
    /// the mesh there
    std::pair<const FlatZone*, int> stated(const std::vector<int>& loop, size_t k, int face) const
    {
        const size_t next = (k + 1) % loop.size();
        const int a = loop[k], b = loop[next], from = number_[size_t(a)];
        size_t end = next;
        while (end != k && number_[size_t(loop[end])] == from)
            end = (end + 1) % loop.size();
        const FlatZone* zone = zones_.at(face);
        const int curve = part_.cad->curves.of(from, number_[size_t(loop[end])]);
        if (!zone || curve < 0 || !zone->has(before_.position.col(a), zones_.within) ||
            !zone->has(before_.position.col(b), zones_.within))
            return {nullptr, -1};
        return {zone, curve};
    }

    Border bare(const std::vector<int>& loop) const
    {
        Border border;
        for (const int v : loop)
            border.at.push_back(blank_.position.col(v));
        border.zone.assign(loop.size(), nullptr);
        border.curve.assign(loop.size(), -1);
        return border;
    }

    Border of_mesh(const std::vector<int>& loop) const
    {
        Border border = bare(loop);
        for (int k = 0; k < border.size(); ++k) {
            const int a = loop[size_t(k)], b = loop[size_t((k + 1) % border.size())];
            std::tie(border.zone[size_t(k)], border.curve[size_t(k)]) =
                stated(loop, size_t(k), zones_.face_beside(a, b));
        }
        for (int k = 0; k < border.size(); ++k)
            if (const FlatZone* zone = zone_at(border, k))
                border.at[size_t(k)] = zone->in_blank(part_.mesh.position.col(loop[size_t(k)]));
        return border;
    }

    /// Of either edge at a point.
    static const FlatZone* zone_at(const Border& border, int k)
    {
        const FlatZone* after = border.zone[size_t(k)];
        return after ? after : border.zone[size_t((k + border.size() - 1) % border.size())];
    }

    /// Where along a loop of the first mesh a place is: the number of an edge and the share of it.
    struct Along {
        double s = 0, distance = std::numeric_limits<double>::infinity();
    };
    Along along(const std::vector<int>& loop, const Eigen::Vector3d& place) const
    {
        Along best;
        for (size_t k = 0; k < loop.size(); ++k) {
            const Eigen::Vector3d a = before_.position.col(loop[k]),
                                  way = before_.position.col(loop[(k + 1) % loop.size()]) - a;
            const double share = nearest_share(place, a, way);
            if (const double off = (a + share * way - place).norm(); off < best.distance)
                best = {double(k) + share, off};
        }
        return best;
    }

    /// The loop of the first mesh that one follows.
    const std::vector<int>* loop_before(const std::vector<int>& loop) const
    {
        const std::vector<int>* before = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<int>& other : loops_before_)
            if (const double off = along(other, part_.mesh.position.col(loop[0])).distance; off < least) {
                least = off;
                before = &other;
            }
        return before;
    }

    /// Per edge of a loop of the first mesh what is stated of it.
    std::vector<std::pair<const FlatZone*, int>> stated_along(const std::vector<int>& before) const
    {
        std::vector<std::pair<const FlatZone*, int>> known;
        for (size_t k = 0; k < before.size(); ++k) {
            const int a = before[k], b = before[(k + 1) % before.size()];
            const Eigen::Vector3d middle = (before_.position.col(a) + before_.position.col(b)) / 2;
            known.push_back(stated(before, k, search_->nearest(middle).face));
        }
        return known;
    }

    /// The loop with its stated stretches as they were before remeshing, between them as it is now.
    /// None: nothing is stated of it, or it does not follow one of the first mesh.
    std::optional<Border> as_before(const std::vector<int>& loop) const
    {
        const std::vector<int>* before = loop_before(loop);
        if (!before)
            return std::nullopt;
        const size_t edges = before->size();
        const auto known = stated_along(*before);
        if (std::none_of(known.begin(), known.end(), [](const auto& k) { return k.first; }))
            return std::nullopt;

        struct Point {
            double s;
            Eigen::Vector2d at;
        };
        std::vector<Point> points;
        for (size_t k = 0; k < edges; ++k)
            if (const FlatZone* zone = known[k].first ? known[k].first : known[(k + edges - 1) % edges].first)
                points.push_back({double(k), zone->in_blank(before_.position.col((*before)[k]))});
        std::vector<double> s;
        for (const int v : loop) {
            s.push_back(along(*before, part_.mesh.position.col(v)).s);
            const Eigen::Vector2d at = blank_.position.col(v);
            if (!known[size_t(s.back()) % edges].first && !near(points, at))
                points.push_back({s.back() < double(edges) ? s.back() : s.back() - double(edges), at});
        }
        if (!runs_once_around(s))
            return std::nullopt;
        std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.s < b.s; });
        Border border;
        for (const Point& point : points) {
            border.at.push_back(point.at);
            const auto& [zone, curve] = known[size_t(point.s)];
            border.zone.push_back(zone);
            border.curve.push_back(curve);
        }
        return border;
    }

    template <class Points> bool near(const Points& points, const Eigen::Vector2d& place) const
    {
        return std::any_of(points.begin(), points.end(),
                           [&](const auto& point) { return (point.at - place).norm() <= zones_.within; });
    }

    static bool runs_once_around(const std::vector<double>& s)
    {
        int back = 0;
        for (size_t k = 0; k < s.size(); ++k)
            back += s[(k + 1) % s.size()] < s[k];
        return back == 1;
    }

    const PartFile& part_;
    const Blank& blank_;
    FlatZones zones_;
    const TriMesh& before_;          ///< remeshing
    const std::vector<int>& number_; ///< of its vertices in the file
    std::vector<std::vector<int>> loops_before_;
    std::optional<ClosestPointSearch> search_;
};

/// Whether the points of a run lie on its curve as it is in the blank, one after the other.
bool follows(const Border& border, const StatedPiece& piece, double within)
{
    const Eigen::Vector2d a = border.point(piece.first), way = border.point(piece.first + piece.edges) - a;
    double sign = 0, along = 0;
    for (int k = 0; k < piece.edges; ++k) {
        const Eigen::Vector2d p = border.point(piece.first + k), q = border.point(piece.first + k + 1);
        if (piece.kind == Kind::line) {
            const double now = (q - a).dot(way);
            if (std::abs(way[0] * (q - a)[1] - way[1] * (q - a)[0]) > within * way.norm() || now <= along)
                return false;
            along = now;
            continue;
        }
        const Eigen::Vector2d u = p - piece.centre, v = q - piece.centre;
        const double turn = std::atan2(u[0] * v[1] - u[1] * v[0], u.dot(v));
        constexpr double clearly_one_way = 0.9 * pi;
        if (std::abs(u.norm() - piece.radius) > within || std::abs(v.norm() - piece.radius) > within || turn == 0 ||
            turn * sign < 0 || std::abs(turn) > clearly_one_way)
            return false;
        sign = turn;
    }
    return true;
}

/// A run of edges on one curve in one zone, as the file has it.
std::optional<StatedPiece> piece_of(const Border& border, const std::vector<StatedCurve>& curves, int first, int edges,
                                    double within)
{
    constexpr double square = 1 - 1e-12; // cosine, to 1e-6
    const FlatZone& zone = *border.zone[size_t(first)];
    const StatedCurve& curve = curves[size_t(border.curve[size_t(first)])];
    StatedPiece piece{Kind::line, first, edges};
    if (curve.kind == StatedCurve::Kind::circle) {
        if (std::abs(curve.direction.dot(zone.normal)) < square)
            return std::nullopt;
        piece.kind = Kind::arc;
        piece.centre = zone.in_blank(curve.point);
        piece.radius = curve.radius;
    }
    return follows(border, piece, within) ? std::optional(piece) : std::nullopt;
}

bool one_circle(const StatedPiece& a, const StatedPiece& b, double within)
{
    return a.kind == Kind::arc && b.kind == Kind::arc && std::abs(a.radius - b.radius) <= within &&
           (a.centre - b.centre).norm() <= within;
}

/// Circles come in halves from many programs, and their edges may begin anywhere. The arcs of one
/// that follow each other become one.
std::vector<StatedPiece> joined(const std::vector<StatedPiece>& pieces, int edges, double within)
{
    std::vector<StatedPiece> result;
    for (const StatedPiece& piece : pieces)
        if (!result.empty() && result.back().first + result.back().edges == piece.first &&
            one_circle(result.back(), piece, within))
            result.back().edges += piece.edges;
        else
            result.push_back(piece);
    if (result.size() > 1 && (result.back().first + result.back().edges) % edges == result.front().first &&
        one_circle(result.back(), result.front(), within)) {
        result.back().edges += result.front().edges;
        result.erase(result.begin());
    }
    return result;
}

/// Runs of edges on one curve in one zone, from where one begins.
std::vector<StatedPiece> pieces_of(const Border& border, const std::vector<StatedCurve>& curves, double within)
{
    const int edges = border.size();
    const auto alike = [&](int a, int b) {
        return border.curve[size_t(a)] == border.curve[size_t(b)] && border.zone[size_t(a)] == border.zone[size_t(b)];
    };
    int start = 0;
    while (start < edges && alike(start, (start + edges - 1) % edges))
        ++start;
    start %= edges;
    std::vector<StatedPiece> pieces;
    for (int k = 0; k < edges;) {
        const int first = (start + k) % edges;
        int run = 1;
        while (k + run < edges && alike(first, (first + run) % edges))
            ++run;
        if (border.stated(first))
            if (const auto piece = piece_of(border, curves, first, run, within))
                pieces.push_back(*piece);
        k += run;
    }
    return joined(pieces, edges, within);
}

/// The ends of arcs exactly onto them: the file's corners are as good as its decimals.
void onto_arcs(OutlineLoop& loop, const std::vector<StatedPiece>& pieces)
{
    constexpr int passes = 20; // where two arcs meet
    for (int pass = 0; pass < passes; ++pass)
        for (const StatedPiece& piece : pieces)
            for (const int k : {piece.first, piece.first + piece.edges})
                if (piece.kind == Kind::arc) {
                    auto at = loop.col(k % loop.cols());
                    at = (piece.centre + piece.radius * (at - piece.centre).normalized()).eval();
                }
}

} // namespace

BlankDrawing stated_outline(const PartFile& part, const Blank& blank)
{
    if (!part.cad || part.cad->curves.curve.empty())
        return {blank_outline(part.mesh, blank)};
    const Borders borders(part, blank);
    BlankDrawing drawing;
    for (const std::vector<int>& loop : outline_vertices(part.mesh, blank)) {
        const Border border = borders.of(loop);
        OutlineLoop& points = drawing.loops.emplace_back(2, border.size());
        for (int k = 0; k < border.size(); ++k)
            points.col(k) = border.point(k);
        drawing.stated.push_back(pieces_of(border, part.cad->curves.curve, borders.within()));
        onto_arcs(points, drawing.stated.back());
    }
    return drawing;
}

} // namespace spia

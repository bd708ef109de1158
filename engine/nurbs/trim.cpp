#include "engine/nurbs/trim.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "engine/core/error.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit_curve.h"
#include "engine/nurbs/project.h"

namespace spia {
namespace {

/// The border of a hole and its feet on the surface, in one order.
struct Border {
    std::vector<int> vertex;
    Eigen::Matrix3Xd place; ///< mm, on the part
    Eigen::Matrix2Xd uv;
    std::vector<char> corner;

    int size() const { return int(vertex.size()); }
    int next(int i) const { return (i + 1) % size(); }
};

double turning(const Border& border, int i)
{
    const Eigen::Vector3d before = border.place.col(i) - border.place.col((i + border.size() - 1) % border.size()),
                          after = border.place.col(border.next(i)) - border.place.col(i);
    return std::atan2(before.cross(after).norm(), before.dot(after));
}

double signed_area(const Eigen::Matrix2Xd& uv)
{
    double area = 0;
    for (Eigen::Index i = 0; i < uv.cols(); ++i) {
        const auto a = uv.col(i), b = uv.col((i + 1) % uv.cols());
        area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return area;
}

struct Before {
    bool operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
    {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    }
};
/// Places where borders of holes touch.
using Pinches = std::set<Eigen::Vector3d, Before>;

/// A border that comes back to a place, where a hole is pinched to a point, as the borders of the
/// holes on both sides of it.
std::vector<std::vector<int>> simple_loops(const std::vector<int>& loop, const TriMesh& part, Pinches& pinches)
{
    std::map<Eigen::Vector3d, size_t, Before> open; // places of `rest` by their row
    std::vector<int> rest;
    std::vector<std::vector<int>> result;
    for (const int v : loop) {
        const auto [found, is_new] = open.try_emplace(part.position.col(v), rest.size());
        if (!is_new) {
            pinches.insert(part.position.col(v));
            const size_t from = found->second;
            result.emplace_back(rest.begin() + long(from), rest.end());
            for (size_t i = from + 1; i < rest.size(); ++i)
                open.erase(part.position.col(rest[i]));
            rest.resize(from);
        }
        rest.push_back(v);
    }
    result.push_back(std::move(rest));
    std::erase_if(result, [](const std::vector<int>& each) { return each.size() < 3; });
    return result;
}

Border border_of(const std::vector<int>& loop, const TriMesh& part, const SurfaceProjection& projection, double corner)
{
    Border border;
    border.vertex = loop;
    const auto fill = [&] {
        border.place = part.position(Eigen::all, border.vertex);
        border.uv.resize(2, border.size());
        for (int i = 0; i < border.size(); ++i) {
            const SurfaceFoot foot = projection.nearest(border.place.col(i));
            border.uv.col(i) << foot.u, foot.v;
        }
    };
    fill();
    if (signed_area(border.uv) > 0) { // the part is seen from its other side
        std::reverse(border.vertex.begin(), border.vertex.end());
        fill();
    }
    for (int i = 0; i < border.size(); ++i)
        border.corner.push_back(turning(border, i) > corner);
    return border;
}

/// Where a hole is pinched to a point the loops on both sides of it end this much before it, mm:
/// CAD kernels take no face whose inner borders touch.
constexpr double parted = 1e-3;

void part_at_pinches(Border& border, const Pinches& pinches)
{
    for (int i = 0; i < border.size(); ++i) {
        if (!pinches.contains(border.place.col(i)))
            continue;
        const int before = (i + border.size() - 1) % border.size(), after = border.next(i);
        const Eigen::Vector3d inwards = (border.place.col(before) + border.place.col(after)) / 2 - border.place.col(i);
        const Eigen::Vector2d way = (border.uv.col(before) + border.uv.col(after)) / 2 - border.uv.col(i);
        border.uv.col(i) += std::min(parted / inwards.norm(), 0.5) * way;
    }
}

/// Where curves begin: at the corners, or at two opposite vertices, for no curve is closed by
/// itself.
std::vector<int> starts(const Border& border)
{
    std::vector<int> result;
    for (int i = 0; i < border.size(); ++i)
        if (border.corner[size_t(i)])
            result.push_back(i);
    if (result.empty())
        result.push_back(0);
    if (result.size() == 1)
        result.push_back((result[0] + border.size() / 2) % border.size());
    std::sort(result.begin(), result.end());
    return result;
}

/// Vertices of the border from one start to the next.
std::vector<int> piece(const Border& border, int from, int to)
{
    std::vector<int> rows = {from};
    do
        rows.push_back(border.next(rows.back()));
    while (rows.back() != to);
    return rows;
}

std::vector<double> chord_parameters(const Eigen::Matrix3Xd& place)
{
    std::vector<double> t = {0};
    for (Eigen::Index i = 1; i < place.cols(); ++i)
        t.push_back(t.back() + (place.col(i) - place.col(i - 1)).norm());
    for (double& each : t)
        each /= t.back();
    return t;
}

PlaneCurve polyline(const std::vector<double>& t, const Eigen::Matrix2Xd& uv)
{
    PlaneCurve curve{1, {0}, uv};
    curve.knots.insert(curve.knots.end(), t.begin(), t.end());
    curve.knots.push_back(1);
    return curve;
}

/// mm per unit of u and v, for tolerances to be lengths.
Eigen::Vector2d scale_of(const NurbsSurface& surface, const Eigen::Matrix2Xd& uv)
{
    Eigen::Vector2d largest = Eigen::Vector2d::Constant(1e-300);
    for (Eigen::Index i = 0; i < uv.cols(); ++i) {
        const SurfacePoint at = evaluate(surface, uv(0, i), uv(1, i));
        largest = largest.cwiseMax(Eigen::Vector2d(at.S_u.norm(), at.S_v.norm()));
    }
    return largest;
}

PlaneCurve curve_through(const Border& border, const std::vector<int>& rows, const NurbsSurface& surface,
                         double tolerance)
{
    const Eigen::Matrix3Xd place = border.place(Eigen::all, rows);
    const Eigen::Matrix2Xd uv = border.uv(Eigen::all, rows);
    const std::vector<double> t = chord_parameters(place);
    constexpr int fewest = 6; // vertices, for a curve to be more than their interpolation
    const bool distinct = std::adjacent_find(t.begin(), t.end(), std::greater_equal()) == t.end();
    if (int(rows.size()) < fewest || !distinct)
        return polyline(t, uv);
    const Eigen::Vector2d scale = scale_of(surface, uv);
    CurveFitOptions options;
    options.tolerance = tolerance;
    options.lines = t;
    const auto source = [&](const std::vector<double>& parameters) {
        Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, Eigen::Index(parameters.size()));
        for (size_t i = 0; i < parameters.size(); ++i) {
            const auto row = std::lower_bound(t.begin(), t.end(), parameters[i]) - t.begin();
            points.col(Eigen::Index(i)).head<2>() = uv.col(row).cwiseProduct(scale);
        }
        return points;
    };
    const CurveFitResult fitted = fit_curve(source, options);
    if (!fitted.reached)
        return polyline(t, uv);
    PlaneCurve curve{options.degree, fitted.knots, fitted.control.topRows<2>()};
    curve.control.array().colwise() /= scale.array();
    curve.control.col(0) = uv.col(0); // to the bit: the next curve begins there
    curve.control.rightCols<1>() = uv.rightCols<1>();
    return curve;
}

/// Chords of the loops, and of the border of the surface as the last one.
struct Chords {
    std::vector<std::vector<int>> loop;
    std::vector<int> loop_of; ///< per point
    Eigen::Matrix2Xd point;
};

Chords chords_of(const std::vector<TrimLoop>& loops)
{
    Chords chords;
    std::vector<Eigen::Vector2d> points;
    const auto add = [&](const Eigen::Vector2d& p, size_t loop) {
        chords.loop.resize(loop + 1);
        chords.loop[loop].push_back(int(points.size()));
        chords.loop_of.push_back(int(loop));
        points.push_back(p);
    };
    for (size_t k = 0; k < loops.size(); ++k)
        for (const PlaneCurve& curve : loops[k]) {
            const std::vector<double> borders = span_borders(curve.knots, curve.degree);
            const int steps = curve.degree == 1 ? 1 : 8;
            for (size_t s = 0; s + 1 < borders.size(); ++s)
                for (int i = 0; i < steps; ++i)
                    add(evaluate(curve, borders[s] + (borders[s + 1] - borders[s]) * i / steps), k);
        }
    for (const auto& [u, v] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}})
        add({u, v}, loops.size());
    chords.point.resize(2, Eigen::Index(points.size()));
    for (size_t i = 0; i < points.size(); ++i)
        chords.point.col(Eigen::Index(i)) = points[i];
    return chords;
}

/// Takes out the loops that meet another one, themselves or the border of the surface.
void leave_crossing_ones(TrimResult& result, const std::vector<int>& first_vertex)
{
    const Chords chords = chords_of(result.loop);
    const int border = int(result.loop.size());
    std::vector<std::string> why(result.loop.size());
    for (const OutlineCrossing& crossing : outline_crossings(chords.loop, chords.point)) {
        const int a = chords.loop_of[size_t(crossing.edge[0])], b = chords.loop_of[size_t(crossing.other[0])];
        for (const auto& [loop, other] : {std::pair(a, b), {b, a}})
            if (loop != border)
                why[size_t(loop)] = other == border ? "its border touches that of the surface"
                                    : other == loop ? "its border crosses itself on the surface"
                                                    : "it touches another hole on the surface";
    }
    // Holes may touch each other in a point, but one that touches the border of the surface is no
    // hole.
    for (Eigen::Index i = 0; i < chords.point.cols(); ++i)
        if (const int loop = chords.loop_of[size_t(i)];
            loop != border && (chords.point.col(i).minCoeff() <= 0 || chords.point.col(i).maxCoeff() >= 1))
            why[size_t(loop)] = "its border touches that of the surface";
    std::vector<TrimLoop> kept;
    for (size_t k = 0; k < why.size(); ++k)
        if (why[k].empty())
            kept.push_back(std::move(result.loop[k]));
        else
            result.left_filled.push_back({first_vertex[k], why[k]});
    result.loop = std::move(kept);
}

} // namespace

Eigen::Vector2d evaluate(const PlaneCurve& curve, double t)
{
    const BasisValues N = basis(curve.knots, curve.degree, t);
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    for (int k = 0; k <= curve.degree; ++k)
        point += N.value[size_t(k)] * curve.control.col(N.first + k);
    return point;
}

TrimResult trim_holes(const TriMesh& part, int outer, const NurbsSurface& surface, const TrimOptions& options,
                      const Progress& progress)
{
    if (!(options.tolerance > 0) || !(options.corner > 0))
        throw InputError("the tolerance of trimming curves and the angle of their corners must be above 0");
    TrimResult result;
    Pinches pinches;
    std::vector<std::vector<int>> loops;
    for (const std::vector<int>& loop : boundary_loops(part))
        if (std::find(loop.begin(), loop.end(), outer) == loop.end())
            for (std::vector<int>& simple : simple_loops(loop, part, pinches))
                loops.push_back(std::move(simple));
    if (loops.empty())
        return result;
    const SurfaceProjection projection(surface, 4, progress.part(0, 0));
    std::vector<int> first_vertex;
    for (size_t k = 0; k < loops.size(); ++k) {
        progress.checkpoint(double(k) / double(loops.size()), "trimming the surface at the holes");
        Border border = border_of(loops[k], part, projection, options.corner);
        part_at_pinches(border, pinches);
        const std::vector<int> start = starts(border);
        TrimLoop loop;
        for (size_t s = 0; s < start.size(); ++s) {
            const std::vector<int> rows = piece(border, start[s], start[(s + 1) % start.size()]);
            loop.push_back(curve_through(border, rows, surface, options.tolerance));
            const std::vector<double> t = chord_parameters(border.place(Eigen::all, rows));
            for (size_t i = 0; i < rows.size(); ++i) {
                const Eigen::Vector2d uv = evaluate(loop.back(), t[i]);
                result.distance = std::max(
                    result.distance, (evaluate(surface, uv.x(), uv.y()).position - border.place.col(rows[i])).norm());
            }
        }
        result.loop.push_back(std::move(loop));
        first_vertex.push_back(border.vertex[0]);
    }
    leave_crossing_ones(result, first_vertex);
    return result;
}

} // namespace spia

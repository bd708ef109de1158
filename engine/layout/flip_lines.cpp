#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/orient2d.h"

namespace spia {

namespace {

constexpr int most_sweeps = 50;
constexpr double worth_it = 1e-6; // radians

/// Radians, the least angle of a triangle of straight lines.
double least_angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
    const auto angle = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
        return std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
    };
    return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

/// The corner of a triangular face that is not an end of one of its curves.
int apex(const PlaneGraph& graph, const Face& face, int curve)
{
    for (size_t k = 0; k < 3; ++k)
        if (face[k].curve == curve)
            return start_of(graph, face[(k + 2) % 3]);
    return -1;
}

/// The points of a curve as it is used.
Eigen::Matrix2Xd points_of(const PlaneGraph& graph, CurveUse use)
{
    const Eigen::Matrix2Xd& p = graph.curve[size_t(use.curve)].plane;
    return use.reversed ? p.rowwise().reverse().eval() : p;
}

/// Whether a straight line from the apex of a face on a curve runs within it at first, and meets
/// neither of its other sides.
bool clear_of_sides(const PlaneGraph& graph, const Face& face, int curve, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to)
{
    const size_t k =
        size_t(std::find_if(face.begin(), face.end(), [&](CurveUse u) { return u.curve == curve; }) - face.begin());
    const Eigen::Matrix2Xd in = points_of(graph, face[(k + 1) % 3]), out = points_of(graph, face[(k + 2) % 3]);
    if (!leads_inside(in.col(in.cols() - 2), from, out.col(1), to))
        return false;
    for (const Eigen::Matrix2Xd* side : {&in, &out})
        for (Eigen::Index i = 0; i + 1 < side->cols(); ++i) {
            const Eigen::Vector2d a = side->col(i), b = side->col(i + 1);
            if (a != from && b != from && segments_meet(from, to, a, b))
                return false;
        }
    return true;
}

bool joined_already(const PlaneGraph& graph, int a, int b)
{
    return std::any_of(graph.curve.begin(), graph.curve.end(), [&](const LayoutCurve& curve) {
        return curve.vertex == std::array{a, b} || curve.vertex == std::array{b, a};
    });
}

} // namespace

void flip_lines(PlaneGraph& graph, int first_line, const Progress& progress)
{
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        progress.checkpoint(double(sweep) / most_sweeps, "turning lines of the layout");
        const std::vector<Face> faces = faces_of(graph);
        std::map<int, std::vector<int>> sides_of;
        for (int f = 0; f < int(faces.size()); ++f)
            for (const CurveUse use : faces[size_t(f)])
                sides_of[use.curve].push_back(f);
        std::vector<char> changed(faces.size(), 0);
        bool any = false;
        for (int c = first_line; c < int(graph.curve.size()); ++c) {
            const auto& two = sides_of[c];
            if (two.size() != 2 || two[0] == two[1] || changed[size_t(two[0])] || changed[size_t(two[1])] ||
                faces[size_t(two[0])].size() != 3 || faces[size_t(two[1])].size() != 3)
                continue;
            LayoutCurve& line = graph.curve[size_t(c)];
            // The first face in the list has the line forwards or backwards: a and b so that it
            // lies to the left of a to b.
            const bool reversed = std::find(faces[size_t(two[0])].begin(), faces[size_t(two[0])].end(),
                                            CurveUse{c, true}) != faces[size_t(two[0])].end();
            const int a = line.vertex[reversed ? 1 : 0], b = line.vertex[reversed ? 0 : 1],
                      left = apex(graph, faces[size_t(two[0])], c), right = apex(graph, faces[size_t(two[1])], c);
            const auto at = [&](int v) -> const Eigen::Vector2d& { return graph.vertex[size_t(v)]; };
            if (left == right || orient2d(at(right), at(b), at(left)) <= 0 || orient2d(at(left), at(a), at(right)) <= 0)
                continue; // the other diagonal leaves the two
            const double before = std::min(least_angle(at(a), at(b), at(left)), least_angle(at(b), at(a), at(right))),
                         after =
                             std::min(least_angle(at(right), at(b), at(left)), least_angle(at(left), at(a), at(right)));
            if (after <= before + worth_it)
                continue;
            if (joined_already(graph, left, right) ||
                !clear_of_sides(graph, faces[size_t(two[0])], c, at(left), at(right)) ||
                !clear_of_sides(graph, faces[size_t(two[1])], c, at(right), at(left)))
                continue; // their sides are bent
            line.vertex = {right, left};
            line.plane << at(right), at(left);
            changed[size_t(two[0])] = changed[size_t(two[1])] = 1;
            any = true;
        }
        if (!any)
            return;
    }
}

} // namespace spia

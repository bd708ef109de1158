#include "engine/part/round_rims.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/holes/round_border.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// A turn about the axis of a circle.
struct Turn {
    Eigen::Vector3d point, axis; ///< mm; unit length
    double angle;                ///< radians

    Eigen::Vector3d off_axis(const Eigen::Vector3d& p) const
    {
        const Eigen::Vector3d from = p - point;
        return from - from.dot(axis) * axis;
    }
    Eigen::Matrix3d rotation(double share) const { return Eigen::AngleAxisd(share * angle, axis).toRotationMatrix(); }
    Eigen::Vector3d turned(const Eigen::Vector3d& p, double share) const
    {
        return point + rotation(share) * (p - point);
    }
};

class Rims {
public:
    explicit Rims(const PartFile& part)
        : part_(part), neighbour_(face_neighbours(part.mesh.triangles(), edge_uses(part.mesh.triangle))),
          area_(area(part.mesh))
    {
    }

    /// The turn from the first end of a triangle's edge to the other; its angle is 0 where it is no
    /// chord of an arc about which the sheet turns there.
    Turn turn(int f, int k) const
    {
        Turn none{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 0};
        if (neighbour_(k, f) >= 0 || part_.corner_normal[size_t(f)].isZero())
            return none;
        const int a = part_.mesh.triangle(k, f), b = part_.mesh.triangle((k + 1) % 3, f);
        const auto stands_for = [&](int v) { return part_.same_as[size_t(part_.source_vertex[size_t(v)])]; };
        const int number = part_.cad->curves.of(stands_for(a), stands_for(b));
        if (number < 0 || part_.cad->curves.curve[size_t(number)].kind != StatedCurve::Kind::circle)
            return none;
        const StatedCurve& circle = part_.cad->curves.curve[size_t(number)];
        Turn turn{circle.point, circle.direction, 0};
        const Eigen::Vector3d from = part_.mesh.position.col(a), to = part_.mesh.position.col(b);
        const Eigen::Vector3d u = turn.off_axis(from), v = turn.off_axis(to);
        turn.angle = std::atan2(turn.axis.dot(u.cross(v)), u.dot(v));
        constexpr double same = 1e-6, smooth = 1e-4, most = std::numbers::pi / 2; // of the radius; radians
        const auto normal = [&](int c) {
            return Eigen::Vector3d(part_.corner_normal[size_t(f)].col(c).cast<double>());
        };
        const bool turns = (turn.turned(from, 1) - to).norm() <= same * circle.radius &&
                           (turn.rotation(1) * normal(k) - normal((k + 1) % 3)).norm() <= smooth;
        return turns && std::abs(turn.angle) < most ? turn : none;
    }

    /// 1: the chord stays, also where triangles would turn over.
    int pieces(const Turn& turn, int f, int k) const
    {
        const auto corner = [&](int i) {
            return Eigen::Vector3d(part_.mesh.position.col(part_.mesh.triangle((k + i) % 3, f)));
        };
        const double radius = turn.off_axis(corner(0)).norm();
        const int count = turn.angle == 0 ? 1 : int(std::ceil(std::abs(turn.angle) / fine_turn(radius, area_) - 1e-6));
        const Eigen::Vector3d own = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        for (int i = 0; i < count; ++i) {
            const Eigen::Vector3d a = turn.turned(corner(0), double(i) / count) - corner(2),
                                  b = turn.turned(corner(0), (i + 1.) / count) - corner(2);
            constexpr double least = 0.2; // of the area that is its share
            if (!(a.cross(b).dot(own) * count > least * own.squaredNorm()))
                return 1;
        }
        return count;
    }

private:
    const PartFile& part_;
    Eigen::Matrix3Xi neighbour_;
    double area_; ///< mm2
};

/// Numbers vertices by those of the file: what was added comes after those that it is called by.
void sort_vertices(PartFile& part)
{
    std::vector<int> order(part.source_vertex.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int v) { return part.source_vertex[size_t(v)]; });
    for (size_t i = 0; i < order.size(); ++i)
        place[size_t(order[i])] = int(i);
    part.mesh.position = part.mesh.position(Eigen::all, order).eval();
    std::ranges::sort(part.source_vertex);
    for (int f = 0; f < part.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            part.mesh.triangle(k, f) = place[size_t(part.mesh.triangle(k, f))];
}

} // namespace

void round_rims(PartFile& part)
{
    if (part.corner_normal.empty() || part.cad->curves.curve.empty())
        return;
    const Rims rims(part);
    std::vector<Eigen::Vector3d> added;
    std::vector<Eigen::Vector3i> triangle;
    std::vector<int> source_vertex = part.source_vertex, source_face;
    std::vector<Eigen::Matrix3f> corner_normal;
    const int before = part.mesh.vertices();
    const auto take = [&](int f, const Eigen::Vector3i& corners, const Eigen::Matrix3f& normal) {
        triangle.push_back(corners);
        source_face.push_back(part.source_face[size_t(f)]);
        corner_normal.push_back(normal);
    };
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const Eigen::Matrix3f normal = part.corner_normal[size_t(f)];
        int k = 0, pieces = 1; // of a triangle with two such edges one is divided
        Turn turn{};
        for (int i = 0; i < 3 && pieces < 2; ++i) {
            k = i;
            turn = rims.turn(f, k);
            pieces = rims.pieces(turn, f, k);
        }
        if (pieces < 2) {
            take(f, part.mesh.triangle.col(f), normal);
            continue;
        }
        const int a = part.mesh.triangle(k, f), b = part.mesh.triangle((k + 1) % 3, f),
                  top = part.mesh.triangle((k + 2) % 3, f);
        int from = a;
        for (int i = 1; i <= pieces; ++i) {
            int to = b;
            if (i < pieces) {
                to = before + int(added.size());
                added.push_back(turn.turned(part.mesh.position.col(a), double(i) / pieces));
                source_vertex.push_back(part.source_vertex[size_t(a)]);
            }
            Eigen::Matrix3f corners;
            corners << turn.rotation((i - 1.) / pieces).cast<float>() * normal.col(k),
                turn.rotation(double(i) / pieces).cast<float>() * normal.col(k), normal.col((k + 2) % 3);
            take(f, {from, to, top}, corners);
            from = to;
        }
    }
    if (added.empty())
        return;
    part.mesh.position.conservativeResize(3, before + int(added.size()));
    for (size_t i = 0; i < added.size(); ++i)
        part.mesh.position.col(before + int(i)) = added[i];
    part.mesh.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t f = 0; f < triangle.size(); ++f)
        part.mesh.triangle.col(Eigen::Index(f)) = triangle[f];
    part.source_vertex = std::move(source_vertex);
    part.source_face = std::move(source_face);
    part.corner_normal = std::move(corner_normal);
    sort_vertices(part);
}

} // namespace spia

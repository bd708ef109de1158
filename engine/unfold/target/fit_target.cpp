#include "engine/unfold/target/fit_target.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <unsupported/Eigen/NumericalDiff>

#include "engine/core/error.h"
#include "engine/core/small_dense.h"

namespace spia {
namespace {

struct Region {
    Eigen::Matrix3Xd vertex;        ///< each once
    Eigen::Matrix3Xi corner;        ///< per face, into vertex
    Eigen::Matrix3Xd normal;        ///< per face
    Eigen::Matrix3Xd middle;        ///< per face
    Eigen::VectorXd area;           ///< per face
    Eigen::Vector3d centre, facing; ///< mean place and mean normal
    double size;                    ///< mm, diagonal
};

Region region_of(const TriMesh& part, const std::vector<int>& faces)
{
    if (faces.empty())
        throw InputError("a binder face needs the faces of a region; pick some");
    Region region;
    const auto count = Eigen::Index(faces.size());
    region.normal.resize(3, count);
    region.middle.resize(3, count);
    region.area.resize(count);
    std::vector<int> vertices;
    for (Eigen::Index k = 0; k < count; ++k) {
        const int f = faces[size_t(k)];
        if (f < 0 || f >= part.triangles())
            throw InputError(
                fmt::format("the region names face {}; the part has faces 0 to {}", f, part.triangles() - 1));
        const Eigen::Matrix3d corner = part.position(Eigen::all, part.triangle.col(f));
        const Eigen::Vector3d area = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)) / 2;
        region.area[k] = area.norm();
        region.normal.col(k) = area.normalized();
        region.middle.col(k) = corner.rowwise().mean();
        vertices.insert(vertices.end(), part.triangle.col(f).begin(), part.triangle.col(f).end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    region.vertex = part.position(Eigen::all, vertices);
    region.corner.resize(3, count);
    for (Eigen::Index k = 0; k < count; ++k)
        for (int a = 0; a < 3; ++a)
            region.corner(a, k) =
                int(std::lower_bound(vertices.begin(), vertices.end(), part.triangle(a, faces[size_t(k)])) -
                    vertices.begin());
    region.centre = region.middle * region.area / region.area.sum();
    region.facing = region.normal * region.area;
    region.size = (region.vertex.rowwise().maxCoeff() - region.vertex.rowwise().minCoeff()).norm();
    return region;
}

/// Eigenvectors of the area-weighted normals' moments, least first.
Eigen::Matrix3d normal_axes(const Region& region, const Eigen::Vector3d& about)
{
    const Eigen::Matrix3Xd n = region.normal.colwise() - about;
    return eigen_pairs(n * region.area.asDiagonal() * n.transpose()).vector;
}

/// A direction near `axis`: turned by two small numbers.
Eigen::Vector3d leaned(const Eigen::Vector3d& axis, double a, double b)
{
    const Eigen::Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
    return (axis + a * x + b * y).normalized();
}

/// Least squares of the vertices' distances over a few numbers that begin at zero, in units of the
/// region's size.
struct Distances : Eigen::DenseFunctor<double> {
    using Make = std::function<TargetSurface(const Eigen::VectorXd&)>;

    Distances(const Region& r, int numbers, const Make& m)
        : Eigen::DenseFunctor<double>(numbers, int(r.vertex.cols())), region(r), make(m)
    {
    }
    int operator()(const Eigen::VectorXd& number, Eigen::VectorXd& off) const
    {
        const TargetSurface face = make(number);
        for (Eigen::Index v = 0; v < region.vertex.cols(); ++v) {
            const Eigen::Vector3d x = region.vertex.col(v);
            off[v] = outer_normal(face, x).dot(x - placed(face, developed(face, x))) / region.size;
        }
        return 0;
    }
    const Region& region;
    const Make& make;
};

TargetSurface refined(const Region& region, int numbers, const Distances::Make& make)
{
    using Functor = Eigen::NumericalDiff<Distances, Eigen::Central>;
    Functor distances(Distances(region, numbers, make));
    Eigen::LevenbergMarquardt<Functor> solver(distances);
    Eigen::VectorXd number = Eigen::VectorXd::Zero(numbers);
    solver.minimize(number);
    return make(number);
}

PlaneFace plane(const Region& region)
{
    const Eigen::Matrix3Xd arm = region.vertex.colwise() - region.vertex.rowwise().mean();
    const Eigen::Matrix3d axes = eigen_pairs(arm * arm.transpose()).vector;
    Eigen::Matrix<double, 3, 2> in_plane;
    in_plane << axes.col(2), axes.col(1);
    if (in_plane.col(0).cross(in_plane.col(1)).dot(region.facing) < 0)
        in_plane.col(1) *= -1;
    return {region.vertex.rowwise().mean(), in_plane};
}

Eigen::Vector3d square_to(const Eigen::Vector3d& axis, const Eigen::Vector3d& v)
{
    const Eigen::Vector3d across = v - axis.dot(v) * axis;
    return across.norm() > 0 ? Eigen::Vector3d(across.normalized()) : axis.unitOrthogonal();
}

/// Whether the outer side looks away from an axis; also of a region that goes all around it.
bool looks_away(const Region& region, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < region.area.size(); ++f) {
        const Eigen::Vector3d arm = region.middle.col(f) - origin;
        sum += region.area[f] * region.normal.col(f).dot((arm - axis.dot(arm) * axis).normalized());
    }
    return sum > 0;
}

/// The normals are square to the axis; seen along it the vertices lie on a circle. [Kasa 1976 for a
/// first one]
TargetSurface cylinder(const Region& region)
{
    const Eigen::Vector3d axis = normal_axes(region, Eigen::Vector3d::Zero()).col(0), x = axis.unitOrthogonal(),
                          y = axis.cross(x);
    Eigen::MatrixX3d rows(region.vertex.cols(), 3);
    Eigen::VectorXd right(region.vertex.cols());
    for (Eigen::Index v = 0; v < region.vertex.cols(); ++v) {
        const Eigen::Vector3d arm = (region.vertex.col(v) - region.centre) / region.size;
        const Eigen::Vector2d at(x.dot(arm), y.dot(arm));
        rows.row(v) << at.transpose(), 1;
        right[v] = at.squaredNorm();
    }
    const Eigen::Vector3d circle = least_squares(rows, right);
    const double radius = region.size * std::sqrt(std::max(circle[2] + circle.head<2>().squaredNorm() / 4, 1e-12));
    const Eigen::Vector3d middle = region.centre + region.size / 2 * (circle[0] * x + circle[1] * y),
                          towards = square_to(axis, region.centre - middle);
    const bool bulges = looks_away(region, middle, axis);
    return refined(region, 5, [=, size = region.size](const Eigen::VectorXd& d) -> TargetSurface {
        const Eigen::Vector3d now = leaned(axis, d[0], d[1]);
        return CylinderFace{middle + size * (d[2] * x + d[3] * y), now, square_to(now, towards), radius + size * d[4],
                            bulges};
    });
}

/// The normals make one angle with the axis, and all tangent planes meet in the apex.
TargetSurface cone(const Region& region)
{
    const Eigen::Vector3d mean = region.facing / region.area.sum();
    Eigen::Vector3d axis = normal_axes(region, mean).col(0);
    const Eigen::MatrixX3d normals = region.normal.transpose();
    const Eigen::VectorXd level =
        (region.normal.cwiseProduct(region.middle.colwise() - region.centre)).colwise().sum().transpose();
    const Eigen::Vector3d apex = region.centre + least_squares(normals, level);
    if (axis.dot(region.centre - apex) < 0)
        axis *= -1;
    const Eigen::Vector3d towards = square_to(axis, region.centre - apex);
    const Eigen::Matrix3Xd arm = region.vertex.colwise() - apex;
    const double along = (axis.transpose() * arm).mean(),
                 off = (arm - axis * (axis.transpose() * arm)).colwise().norm().mean();
    const double half_angle = std::atan2(off, along);
    const bool bulges = looks_away(region, apex, axis);
    return refined(region, 6, [=, size = region.size](const Eigen::VectorXd& d) -> TargetSurface {
        const Eigen::Vector3d now = leaned(axis, d[0], d[1]);
        return ConeFace{apex + size * d.segment<3>(2), now, square_to(now, towards), half_angle + d[5], bulges};
    });
}

TargetFit judged(const Region& region, const TargetSurface& face)
{
    TargetFit fit{face, 0, 0};
    for (Eigen::Index v = 0; v < region.vertex.cols(); ++v) {
        const Eigen::Vector3d x = region.vertex.col(v);
        fit.distance_mm = std::max(fit.distance_mm, (x - placed(face, developed(face, x))).norm());
    }
    for (Eigen::Index f = 0; f < region.normal.cols(); ++f)
        for (const int v : region.corner.col(f)) { // at its middle a chord has the normal of its
                                                   // arc, however long it is
            const Eigen::Vector3d n = outer_normal(face, region.vertex.col(v)), m = region.normal.col(f);
            fit.angle = std::max(fit.angle, std::atan2(n.cross(m).norm(), n.dot(m)));
        }
    return fit;
}

} // namespace

std::optional<TargetFit> fit_target(const TriMesh& part, const std::vector<int>& faces, double tolerance)
{
    const Region region = region_of(part, faces);
    constexpr double most_angle = 0.4; // a chord over 45 degrees; coarser is a bend of flats
    for (TargetSurface (*make)(const Region&) :
         {+[](const Region& r) -> TargetSurface { return plane(r); }, &cylinder, &cone}) {
        const TargetFit fit = judged(region, make(region));
        if (fit.distance_mm <= tolerance * region.size && fit.angle <= most_angle)
            return fit;
    }
    return std::nullopt;
}

} // namespace spia

#include "engine/unfold/target/fit_height.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/small_dense.h"
#include "engine/core/small_sparse.h"
#include "engine/unfold/target/height_spline.h"

namespace spia {
namespace {

using Matrix16d = Eigen::Matrix<double, 16, 16>;
using Vector16d = Eigen::Matrix<double, 16, 1>;

/// The products of the splines of both ways, those of x fastest.
Vector16d product(const Eigen::Vector4d& x, const Eigen::Vector4d& y) { return (x * y.transpose()).reshaped(); }

/// Of one cell with sides of length 1: integral of z_xx^2 + 2 z_xy^2 + z_yy^2, by Gauss's four
/// points either way.
Matrix16d bending()
{
    constexpr std::array<double, 2> at = {0.3399810435848563, 0.8611363115940526},
                                    weight = {0.6521451548625461, 0.3478548451374538};
    Matrix16d out = Matrix16d::Zero();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const auto point = [&](int k) { return (1 + (k % 2 ? 1 : -1) * at[size_t(k / 2)]) / 2; };
            const CellSplines x = cell_splines(point(i)), y = cell_splines(point(j));
            const Vector16d xx = product(x.second, y.value), xy = product(x.first, y.first),
                            yy = product(x.value, y.second);
            out += weight[size_t(i / 2)] * weight[size_t(j / 2)] / 4 *
                   (xx * xx.transpose() + 2 * xy * xy.transpose() + yy * yy.transpose());
        }
    return out;
}

struct HeightRegion {
    std::vector<int> vertex;
    Eigen::VectorXd weight; ///< of each vertex: its share of the area
    HeightFace plane;       ///< no spline yet
    bool seen_whole;
};

HeightRegion height_region_of(const TriMesh& part, const std::vector<int>& faces)
{
    constexpr double steepest = 75 * std::numbers::pi / 180;
    HeightRegion region;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(part.vertices());
    Eigen::Matrix3Xd area(3, Eigen::Index(faces.size()));
    for (size_t k = 0; k < faces.size(); ++k) {
        const Eigen::Matrix3d x = part.position(Eigen::all, part.triangle.col(faces[k]));
        area.col(Eigen::Index(k)) = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)) / 2;
        for (const int v : part.triangle.col(faces[k]))
            share[v] += area.col(Eigen::Index(k)).norm() / 3;
    }
    const double sum = share.sum();
    for (int v = 0; v < part.vertices(); ++v)
        if (share[v] > 0)
            region.vertex.push_back(v);
    region.weight = share(region.vertex) / sum;
    const Eigen::Matrix3Xd at = part.position(Eigen::all, region.vertex);
    region.plane.origin = at * region.weight;
    const Eigen::Vector3d mean = area.rowwise().sum(),
                          normal = mean.norm() > 0 ? Eigen::Vector3d(mean.normalized()) : Eigen::Vector3d::UnitZ();
    region.seen_whole = mean.norm() > 0;
    for (Eigen::Index k = 0; k < area.cols(); ++k)
        region.seen_whole &= area.col(k).dot(normal) > std::cos(steepest) * area.col(k).norm();
    // x along the longer side of the region
    Eigen::Matrix3Xd flat = at.colwise() - region.plane.origin;
    flat -= normal * (normal.transpose() * flat);
    const Eigen::Vector3d longest = eigen_pairs(flat * region.weight.asDiagonal() * flat.transpose()).vector.col(2);
    const Eigen::Vector3d x = (longest - normal * normal.dot(longest)).normalized();
    region.plane.axes << x, normal.cross(x);
    return region;
}

} // namespace

std::optional<TargetFit> fit_height(const TriMesh& part, const std::vector<int>& faces)
{
    // A stiff plate is flat at its edges, by about 1e-5 of the region here; a soft one swings
    // beside what the knots do not resolve, and goes on from there the wrong way: with 1e-12 and 32
    // cells by 13 degrees beside a fender's feature line.
    constexpr double cells_along = 64, bending_share = 1e-10;
    const HeightRegion region = height_region_of(part, faces);
    if (!region.seen_whole)
        return std::nullopt;
    HeightFace face = region.plane;
    const Eigen::Matrix3Xd arm = part.position(Eigen::all, region.vertex).colwise() - face.origin;
    const Eigen::Matrix2Xd at = face.axes.transpose() * arm;
    const Eigen::VectorXd height = (face.axes.col(0).cross(face.axes.col(1)).transpose() * arm).transpose();
    const Eigen::Vector2d low = at.rowwise().minCoeff(), side = at.rowwise().maxCoeff() - low;
    face.corner = low;
    face.spacing = side.maxCoeff() / cells_along;
    const auto cells = [&](double length) { return std::max(1, int(std::ceil(length / face.spacing - 1e-9))); };
    const int columns = cells(side[0]), rows = cells(side[1]), nx = columns + 3, ny = rows + 3;

    std::vector<Matrix16d> local(size_t(columns * rows), Matrix16d::Zero());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(nx * ny);
    const auto unknown = [&](int cell, int k) { return cell % columns + k % 4 + nx * (cell / columns + k / 4); };
    for (Eigen::Index v = 0; v < at.cols(); ++v) {
        const Eigen::Vector2d knots = (at.col(v) - low) / face.spacing;
        const int i = std::clamp(int(knots[0]), 0, columns - 1), j = std::clamp(int(knots[1]), 0, rows - 1),
                  cell = i + columns * j;
        const Vector16d b = product(cell_splines(knots[0] - i).value, cell_splines(knots[1] - j).value);
        local[size_t(cell)] += region.weight[v] * b * b.transpose();
        for (int k = 0; k < 16; ++k)
            right[unknown(cell, k)] += region.weight[v] * height[v] * b[k];
    }
    // Both terms without dimension: distances in units of the region, so that its size does not
    // matter.
    const double size = side.norm(), stiff = bending_share * size * size / (face.spacing * face.spacing);
    const Matrix16d plate = stiff * bending();
    std::vector<Eigen::Triplet<double>> entry;
    for (int cell = 0; cell < columns * rows; ++cell)
        for (int k = 0; k < 16; ++k)
            for (int l = 0; l < 16; ++l)
                entry.emplace_back(unknown(cell, k), unknown(cell, l), local[size_t(cell)](k, l) + plate(k, l));
    Eigen::SparseMatrix<double> A(nx * ny, nx * ny);
    A.setFromTriplets(entry.begin(), entry.end());
    const SparseLdlt solver(A);
    if (!solver.ok())
        throw SolveError("the smooth face through the fixed region could not be factored");
    face.coefficient = solver.solve(right).reshaped(nx, ny);

    TargetFit fit{face, 0, 0};
    for (const int v : region.vertex) {
        const Eigen::Vector3d x = part.position.col(v);
        fit.distance_mm = std::max(fit.distance_mm, (x - placed(fit.face, developed(fit.face, x))).norm());
    }
    for (const int f : faces) {
        const Eigen::Matrix3d x = part.position(Eigen::all, part.triangle.col(f));
        const Eigen::Vector3d m = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
        for (const auto& corner : x.colwise()) { // at its middle a chord has the normal of its arc,
                                                 // however long it is
            const Eigen::Vector3d n = outer_normal(fit.face, corner);
            fit.angle = std::max(fit.angle, std::atan2(n.cross(m).norm(), n.dot(m)));
        }
    }
    constexpr double most_angle = 0.4; // as of a cylinder: coarser is a bend of flats
    return fit.angle <= most_angle ? std::optional(fit) : std::nullopt;
}

} // namespace spia

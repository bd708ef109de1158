#include "engine/nurbs/smooth_joins.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/nurbs/basis.h"

namespace spia {
namespace {

using Eigen::Vector3d;

constexpr double wanted_angle = 1e-4;   // radians: as bad as a move by the tolerance
constexpr double already_smooth = 1e-9; // radians
constexpr double nothing = 1e-3;        // of the tolerance, of a move
constexpr double least_share = 0.01;    // of a step
constexpr double small_progress = 0.98; // of what is minimised, in one step

/// A derivative as a sum over control points, by their shared numbers.
using Derivative = std::vector<std::pair<int, double>>;

Vector3d value(const Derivative& derivative, const Eigen::Matrix3Xd& control)
{
    Vector3d sum = Vector3d::Zero();
    for (const auto& [number, factor] : derivative)
        sum += factor * control.col(number);
    return sum;
}

/// One place of a join: the derivatives into the first and the second patch, and along the join.
struct Place {
    std::array<Derivative, 3> derivative;

    /// Between the normals of the patches; a cosine below 0 is that of more than a right angle.
    struct Angle {
        double sine = 0, cosine = 1;
    };
    /// Whether both patches and the join have a direction there, which moves that are no more than
    /// a distance do not turn about.
    bool defined(const Eigen::Matrix3Xd& control, double distance) const
    {
        const Vector3d a = value(derivative[0], control), b = value(derivative[1], control),
                       t = value(derivative[2], control);
        constexpr double least_sine = 1e-6;
        return std::min(a.norm(), b.norm()) > distance && a.cross(t).norm() > least_sine * a.norm() * t.norm() &&
               t.cross(b).norm() > least_sine * t.norm() * b.norm();
    }
    Angle angle(const Eigen::Matrix3Xd& control) const
    {
        const Vector3d a = value(derivative[0], control), b = value(derivative[1], control),
                       t = value(derivative[2], control);
        // normals of one side of the sheet
        const Vector3d x = a.cross(t).normalized(), y = t.cross(b).normalized();
        return {x.cross(y).dot(t.normalized()), x.dot(y)};
    }
};

/// The second row of control points of a side, in the order of the first.
std::vector<int> next_row(const NurbsSurface& s, Side side)
{
    std::vector<int> row = side_controls(s, side);
    const int step = side == Side::v0 ? s.count_u : side == Side::v1 ? -s.count_u : side == Side::u0 ? 1 : -1;
    for (int& control : row)
        control += step;
    return row;
}

/// The derivative into a patch at parameter t of one of its sides; its length is of no matter.
Derivative across(const NurbsSurface& s, int patch, Side side, double t, const SharedControls& shared)
{
    const BasisValues at = basis(side_knots(s, side), side_degree(s, side), t);
    const std::vector<int> rim = side_controls(s, side), inner = next_row(s, side);
    Derivative result;
    for (size_t k = 0; k <= size_t(side_degree(s, side)); ++k) {
        const size_t i = size_t(at.first) + k;
        result.emplace_back(shared.of(patch, inner[i]), at.value[k]);
        result.emplace_back(shared.of(patch, rim[i]), -at.value[k]);
    }
    return result;
}

Derivative along(const NurbsSurface& s, int patch, Side side, double t, const SharedControls& shared)
{
    const BasisValues at = basis(side_knots(s, side), side_degree(s, side), t);
    const std::vector<int> rim = side_controls(s, side);
    Derivative result;
    for (size_t k = 0; k <= size_t(side_degree(s, side)); ++k)
        result.emplace_back(shared.of(patch, rim[size_t(at.first) + k]), at.first_derivative[k]);
    return result;
}

/// Of each interface.
std::vector<std::vector<Place>> places_of(const MultiPatch& patches, const SharedControls& shared)
{
    std::vector<std::vector<Place>> result;
    for (const PatchInterface& joint : patches.interfaces) {
        std::vector<Place>& places = result.emplace_back();
        const auto [p, side] = joint.first;
        const auto [q, other] = joint.second;
        const NurbsSurface &a = patches.patch[size_t(p)], &b = patches.patch[size_t(q)];
        const int degree = side_degree(a, side), pieces = 2 * (degree + 1);
        const std::vector<double> borders = span_borders(side_knots(a, side), degree);
        for (size_t s = 0; s + 1 < borders.size(); ++s)
            for (int n = 0; n < pieces + (s + 2 == borders.size()); ++n) {
                const double t = borders[s] + n * (borders[s + 1] - borders[s]) / pieces;
                places.push_back(
                    {{across(a, p, side, t, shared), across(b, q, other, joint.reversed ? 1 - t : t, shared),
                      along(a, p, side, t, shared)}});
            }
    }
    return result;
}

/// Where each control point that may move has its unknowns; -1 for the others.
std::vector<int> unknowns_of(const MultiPatch& patches, const SharedControls& shared, const std::vector<char>& kept,
                             int& count)
{
    std::vector<char> free(size_t(shared.count), 0);
    for (const PatchInterface& joint : patches.interfaces)
        for (const PatchSide& one : {joint.first, joint.second}) {
            const NurbsSurface& s = patches.patch[size_t(one.patch)];
            for (const auto& row : {side_controls(s, one.side), next_row(s, one.side)})
                for (const int control : row)
                    free[size_t(shared.of(one.patch, control))] = 1;
        }
    // Where a join ends on the border of the whole; the border's next control points have to turn
    // into one tangent plane.
    std::vector<char> border(free.size(), 0);
    for (const PatchSide& one : outer_sides(patches))
        for (const int control : side_controls(patches.patch[size_t(one.patch)], one.side))
            border[size_t(shared.of(one.patch, control))] = 1;
    for (const PatchInterface& joint : patches.interfaces) {
        const std::vector<int> row = side_controls(patches.patch[size_t(joint.first.patch)], joint.first.side);
        for (const int end : {row.front(), row.back()})
            if (const int number = shared.of(joint.first.patch, end); border[size_t(number)])
                free[size_t(number)] = 0;
    }
    for (size_t p = 0; p < kept.size(); ++p)
        if (kept[p])
            for (int c = 0; c < int(patches.patch[p].control.cols()); ++c)
                free[size_t(shared.of(int(p), c))] = 0;
    std::vector<int> result(free.size(), -1);
    count = 0;
    for (size_t n = 0; n < free.size(); ++n)
        if (free[n])
            result[n] = 3 * count++;
    return result;
}

class Smoother {
public:
    Smoother(const MultiPatch& patches, const SmoothJoinsOptions& options)
        : options_(options), shared_(shared_controls(patches)),
          unknown_(unknowns_of(patches, shared_, options.kept, free_)), start_(3, shared_.count)
    {
        for (size_t p = 0; p < patches.patch.size(); ++p)
            for (int c = 0; c < int(patches.patch[p].control.cols()); ++c)
                start_.col(shared_.of(int(p), c)) = patches.patch[p].control.col(c);
        for (std::vector<Place>& places : places_of(patches, shared_)) {
            std::erase_if(places,
                          [&](const Place& place) { return !place.defined(start_, nothing * options.tolerance); });
            const bool smooth = std::all_of(places.begin(), places.end(), [&](const Place& place) {
                const Place::Angle angle = place.angle(start_);
                return std::atan2(std::abs(angle.sine), angle.cosine) <= options.sharp;
            });
            if (smooth)
                std::move(places.begin(), places.end(), std::back_inserter(place_));
            else
                edges_ += int(places.size());
        }
    }

    SmoothJoins run(const MultiPatch& patches, const Progress& progress)
    {
        SmoothJoins result{patches, greatest_angle(start_), 0, int(place_.size()) + edges_, edges_, 0};
        Eigen::Matrix3Xd control = start_;
        double least = objective(start_);
        const bool smooth = result.angle_before < already_smooth || place_.empty();
        for (int step = 0; step < options_.most_steps && free_ > 0 && !smooth; ++step) {
            progress.checkpoint(double(step) / options_.most_steps, "smoothing the joins of patches");
            const Eigen::Matrix3Xd way = gauss_newton_step(control);
            double share = 1, now = objective(control + way);
            while (!(now < least) && share > least_share) {
                share /= 2; // beside edges that stay the angles are far from linear
                now = objective(control + share * way);
            }
            if (!(now < least))
                break;
            const bool slow = now > small_progress * least;
            control += share * way;
            least = now;
            if (slow)
                break;
        }
        result.angle_after = greatest_angle(control);
        result.greatest_move = free_ > 0 ? (control - start_).colwise().norm().maxCoeff() : 0;
        for (size_t p = 0; p < patches.patch.size(); ++p)
            for (int c = 0; c < int(patches.patch[p].control.cols()); ++c)
                result.patches.patch[p].control.col(c) = control.col(shared_.of(int(p), c));
        return result;
    }

private:
    double greatest_angle(const Eigen::Matrix3Xd& control) const
    {
        double greatest = 0;
        for (const Place& place : place_) {
            const Place::Angle angle = place.angle(control);
            greatest = std::max(greatest, std::atan2(std::abs(angle.sine), angle.cosine));
        }
        return greatest;
    }

    /// Sum of (sine / wanted_angle)^2 and (move / tolerance)^2, the moves counted from the start;
    /// infinite where a place would lose its directions.
    double objective(const Eigen::Matrix3Xd& control) const
    {
        double sum = (control - start_).squaredNorm() / (options_.tolerance * options_.tolerance);
        for (const Place& place : place_) {
            if (!place.defined(control, nothing * options_.tolerance))
                return std::numeric_limits<double>::infinity();
            const Place::Angle angle = place.angle(control);
            sum += std::pow(angle.cosine > 0 ? angle.sine / wanted_angle : 1 / wanted_angle, 2);
        }
        return sum;
    }

    Eigen::Matrix3Xd gauss_newton_step(const Eigen::Matrix3Xd& control) const
    {
        // One row per place, then J^T J as a whole: its entries one by one would take gigabytes.
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd residual(Eigen::Index(place_.size()));
        for (size_t r = 0; r < place_.size(); ++r) {
            const Place& place = place_[r];
            const Vector3d a = value(place.derivative[0], control), b = value(place.derivative[1], control),
                           t = value(place.derivative[2], control);
            // sine = det(a, t, b) |t| / (|a x t| |t x b|), of which the lengths hardly change
            const double scale = t.norm() / (a.cross(t).norm() * t.cross(b).norm()) / wanted_angle;
            residual[Eigen::Index(r)] = scale * a.dot(t.cross(b));
            const std::array<Vector3d, 3> by = {scale * t.cross(b), scale * a.cross(t), scale * b.cross(a)};
            for (size_t d = 0; d < 3; ++d)
                for (const auto& [number, factor] : place.derivative[d])
                    if (const int at = unknown_[size_t(number)]; at >= 0)
                        for (int k = 0; k < 3; ++k)
                            entries.emplace_back(int(r), at + k, factor * by[d][k]);
        }
        Eigen::SparseMatrix<double> rows(Eigen::Index(place_.size()), 3 * free_);
        rows.setFromTriplets(entries.begin(), entries.end());
        Eigen::VectorXd right = -(rows.transpose() * residual);
        const double of_move = 1 / (options_.tolerance * options_.tolerance);
        for (size_t n = 0; n < unknown_.size(); ++n)
            if (const int at = unknown_[n]; at >= 0)
                right.segment<3>(at) -= of_move * (control - start_).col(Eigen::Index(n));
        Eigen::SparseMatrix<double> matrix = rows.transpose() * rows;
        for (int i = 0; i < 3 * free_; ++i)
            matrix.coeffRef(i, i) += of_move;
        const SparseLdlt factor(matrix);
        Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, control.cols());
        if (!factor.ok())
            throw SolveError("the joins of the patches could not be smoothed: their equations have no solution");
        const Eigen::VectorXd step = factor.solve(right);
        for (size_t n = 0; n < unknown_.size(); ++n)
            if (unknown_[n] >= 0)
                result.col(Eigen::Index(n)) = step.segment<3>(unknown_[n]);
        return result;
    }

    const SmoothJoinsOptions& options_;
    SharedControls shared_;
    int free_ = 0; ///< control points that may move
    std::vector<int> unknown_;
    Eigen::Matrix3Xd start_;
    std::vector<Place> place_; ///< those that are no edges
    int edges_ = 0;
};

} // namespace

SmoothJoins smooth_joins(const MultiPatch& patches, const SmoothJoinsOptions& options, const Progress& progress)
{
    require_watertight(patches);
    for (const NurbsSurface& patch : patches.patch)
        if ((patch.weight.array() != 1).any())
            throw InputError("the joins of rational patches cannot be smoothed; fit them without weights");
    if (!options.kept.empty() && options.kept.size() != patches.patch.size())
        throw InputError(fmt::format("{} patches were said to be kept or not where there are {}", options.kept.size(),
                                     patches.patch.size()));
    return Smoother(patches, options).run(patches, progress);
}

} // namespace spia

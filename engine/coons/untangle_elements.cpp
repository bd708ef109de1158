#include "engine/coons/untangle_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/coons/element_energy.h"
#include "engine/core/line_search.h"
#include "engine/core/parallel.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

constexpr double least_eps = 1e-9;      // of an ideal element's area
constexpr double small_decrease = 1e-3; // of the energy in one step: shape is good enough
constexpr double first_eps = 0.01;      // at least
constexpr double enough_decrease = 0.1; // of the energy in one step: worth another one with the
                                        // same eps
constexpr int most_steps_per_eps = 5;
constexpr double slower = 0.5; // chi of the worst element falls to this part of itself when eps is
                               // lowered
constexpr double armijo = 1e-4;
constexpr int most_halvings = 40;

class ElementUntangler {
public:
    ElementUntangler(Eigen::Matrix2Xd& position, const PlanarElements& elements, const std::vector<Pull>& pulls,
                     const UntangleElementsOptions& options)
        : position_(position), elements_(elements), pulls_(pulls), options_(options),
          matrix_(elements.triangle, int(position.cols())), factor_(matrix_)
    {
        const size_t n = elements.to_shape.size();
        slope_.resize(n);
        stiffness_.resize(n);
        value_.resize(n);
        energy_.area_weight = options.area_weight;
    }

    double run(const Progress& progress)
    {
        double smallest = smallest_determinant();
        if (elements_.fixed.minCoeff() == 1)
            return smallest;
        energy_.eps = smallest > options_.thin ? least_eps : std::max(first_eps, -smallest);
        int at_this_eps = 0;
        for (int step = 0; step < options_.most_steps; ++step) {
            progress.checkpoint(double(step) / options_.most_steps, "untangling");
            if (smallest > options_.thin)
                energy_.eps = std::min(least_eps, 0.01 * smallest);
            const double before = energy(position_);
            const bool moved = newton_step(before);
            const double left = energy(position_) / before;
            smallest = smallest_determinant();
            if (smallest > options_.thin) {
                if (!moved || left > 1 - small_decrease)
                    return smallest;
            } else if (++at_this_eps == most_steps_per_eps || left > 1 - enough_decrease) {
                // Not to zero at once: the energy has to follow, or its steep wall stands in the
                // way of the worst element.
                if (energy_.eps <= least_eps)
                    return smallest; // folded and standing still
                const double target = energy_.chi(smallest) * slower;
                energy_.eps =
                    std::max(least_eps, smallest < target ? 2 * std::sqrt(target * (target - smallest)) : least_eps);
                at_this_eps = 0;
            }
        }
        return smallest;
    }

private:
    Jacobian jacobian(size_t k, const Eigen::Matrix2Xd& position) const
    {
        const auto corner = elements_.triangle.col(Eigen::Index(k));
        Eigen::Matrix2d edges;
        edges << position.col(corner[1]) - position.col(corner[0]), position.col(corner[2]) - position.col(corner[0]);
        const Eigen::Matrix2d J = edges * elements_.to_shape[k];
        return {J(0, 0), J(1, 0), J(0, 1), J(1, 1)};
    }

    double smallest_determinant() const
    {
        double smallest = std::numeric_limits<double>::infinity();
        for (size_t k = 0; k < value_.size(); ++k) {
            const double here = determinant(jacobian(k, position_));
            if (std::isnan(here))
                return here;
            smallest = std::min(smallest, here);
        }
        return smallest;
    }

    double energy(const Eigen::Matrix2Xd& position)
    {
        parallel_for(int(value_.size()), [&](int k) {
            value_[size_t(k)] = elements_.weight[k] * energy_.value(jacobian(size_t(k), position));
        });
        double sum = 0;
        for (const double value : value_)
            sum += value;
        for (const Pull& pull : pulls_)
            sum += pull.weight / 2 * (position.col(pull.node) - pull.target).squaredNorm() / options_.element_area;
        return sum;
    }

    /// @return false if no step lowers the energy
    bool newton_step(double before)
    {
        assemble();
        if (!factor_.factor(matrix_))
            return false;
        const Eigen::VectorXd step = factor_.solve(-gradient_);
        const double slope = step.dot(gradient_);
        if (!(slope < 0))
            return false;
        const Eigen::Map<const Eigen::Matrix2Xd> way(step.data(), 2, position_.cols());
        const auto take = [&](double length) {
            const Eigen::Matrix2Xd trial = position_ + length * way;
            if (!(energy(trial) <= before + armijo * length * slope))
                return false;
            position_ = trial;
            return true;
        };
        return backtrack(1, most_halvings, take) > 0;
    }

    void assemble()
    {
        parallel_for(int(value_.size()), [&](int k) { differentiate(size_t(k)); });
        gradient_ = Eigen::VectorXd::Zero(matrix_.size());
        matrix_.clear();
        for (size_t k = 0; k < value_.size(); ++k) {
            matrix_.add(int(k), stiffness_[k]);
            for (int a = 0; a < 3; ++a)
                gradient_.segment<2>(2 * elements_.triangle(a, Eigen::Index(k))) += slope_[k].segment<2>(2 * a);
        }
        for (const Pull& pull : pulls_) {
            const double stiffness = pull.weight / options_.element_area;
            for (int i = 0; i < 2; ++i)
                if (!elements_.fixed(i, pull.node)) {
                    gradient_[2 * pull.node + i] += stiffness * (position_(i, pull.node) - pull.target[i]);
                    matrix_.add_to_diagonal(2 * pull.node + i, stiffness);
                }
        }
        // Clamping may leave a direction without stiffness; a little of the identity bounds the
        // step there.
        const double little = 1e-6 * elements_.weight.mean() / options_.element_area;
        for (Eigen::Index v = 0; v < position_.cols(); ++v)
            for (int i = 0; i < 2; ++i)
                matrix_.add_to_diagonal(int(2 * v + i), elements_.fixed(i, v) ? 1 : little);
    }

    /// Derivatives of one element by the coordinates of its corners; zero for those that stay.
    void differentiate(size_t k)
    {
        Vector4d g;
        Matrix4d H;
        energy_.derivatives(jacobian(k, position_), g, H);
        const Eigen::Matrix2d& S = elements_.to_shape[k];
        Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero(); // dJ / d corners
        for (int s = 0; s < 2; ++s)
            for (int i = 0; i < 2; ++i) {
                B(2 * s + i, i) = -S(0, s) - S(1, s);
                B(2 * s + i, 2 + i) = S(0, s);
                B(2 * s + i, 4 + i) = S(1, s);
            }
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 2; ++i)
                if (elements_.fixed(i, elements_.triangle(a, Eigen::Index(k))))
                    B.col(2 * a + i).setZero();
        slope_[k] = elements_.weight[Eigen::Index(k)] * B.transpose() * g;
        stiffness_[k] = elements_.weight[Eigen::Index(k)] * B.transpose() * H * B;
    }

    Eigen::Matrix2Xd& position_;
    const PlanarElements& elements_;
    const std::vector<Pull>& pulls_;
    const UntangleElementsOptions& options_;
    ElementEnergy energy_;
    std::vector<Eigen::Matrix<double, 6, 1>> slope_;
    std::vector<Matrix6d> stiffness_;
    std::vector<double> value_;
    Eigen::VectorXd gradient_;
    BlockMatrix matrix_;
    Cholesky factor_;
};

} // namespace

double untangle_elements(Eigen::Matrix2Xd& position, const PlanarElements& elements, const std::vector<Pull>& pulls,
                         const UntangleElementsOptions& options, const Progress& progress)
{
    return ElementUntangler(position, elements, pulls, options).run(progress);
}

} // namespace spia

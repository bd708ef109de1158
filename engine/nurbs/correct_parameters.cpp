#include "engine/nurbs/correct_parameters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/nurbs/anderson_mixing.h"
#include "engine/nurbs/foot_point_projection.h"

namespace spia {

namespace {

constexpr int fewest_times = 3, most_times = 60;
constexpr Eigen::Index points_in_all = 120'000; // to slide: what a correction may cost
constexpr int mixed = 8;
constexpr int times_without_weights = 30, times_per_weights = 10;
// Of a point that the surface passes through, to that of the farthest one, each time.
constexpr double least_weight = 0.5;
// Of the least one between the lines u and v: leaning over ever more, a surface is of no use to an
// analysis.
constexpr double kept_sine = 0.5;
constexpr double settled = 1e-9; // change of the control points, of their size

using Flat = Eigen::Map<Eigen::VectorXd>;

Flat flat(Eigen::Matrix3Xd& control) { return {control.data(), control.size()}; }

class Correction {
public:
    Correction(Attempt& fit, const FootPointProjection& projection)
        : fit_(fit), projection_(projection), weight_(Eigen::VectorXd::Ones(fit.points.cols()))
    {
    }

    void run(const Progress& progress)
    {
        const int times =
            int(std::clamp(points_in_all / fit_.points.cols(), Eigen::Index(fewest_times), Eigen::Index(most_times)));
        for (int time = 0; time <= times; ++time) {
            progress.checkpoint(double(time) / times, "letting points slide");
            project_points();
            if (time == times)
                break;
            if (time >= times_without_weights && (time - times_without_weights) % times_per_weights == 0)
                weigh_anew();
            if (step() < settled && time >= times_without_weights)
                break;
        }
        fit_.surface.control = best_control_;
        fit_.points = best_points_;
    }

private:
    /// To the feet of the surface, which is kept if it is the best one.
    void project_points()
    {
        const std::vector<SurfacePoint> at =
            projection_.project_points(fit_.surface, fit_.along_u.parameters(), fit_.along_v.parameters(), fit_.points);
        on_surface_.resize(3, fit_.points.cols());
        double sine = 1;
        for (size_t n = 0; n < at.size(); ++n) {
            on_surface_.col(Eigen::Index(n)) = at[n].position;
            sine = std::min(sine, at[n].S_u.cross(at[n].S_v).norm() / (at[n].S_u.norm() * at[n].S_v.norm()));
        }
        distance_ = (on_surface_ - fit_.points).colwise().norm();
        if (best_control_.size() == 0)
            sine_before_ = sine;
        if (const double largest = distance_.maxCoeff();
            best_control_.size() == 0 || (largest < least_distance_ && sine >= kept_sine * sine_before_)) {
            least_distance_ = largest;
            best_control_ = fit_.surface.control;
            best_points_ = fit_.points;
        }
    }

    void weigh_anew()
    {
        const double largest = std::max(distance_.maxCoeff(), std::numeric_limits<double>::min());
        weight_.array() *= least_weight + (1 - least_weight) * (distance_.array() / largest).square();
        weight_ /= weight_.maxCoeff();
        start_anew();
    }

    void start_anew()
    {
        mixing_.forget();
        sum_before_ = std::numeric_limits<double>::infinity();
    }

    /// The surface fitted to the points, or mixed with those before. @returns how much that fit
    /// changes, of its size
    double step()
    {
        const double sum = weight_.dot(distance_.cwiseAbs2());
        Eigen::Matrix3Xd& control = fit_.surface.control;
        const Eigen::VectorXd before = flat(control);
        // A target drawn on beyond its foot counts like a point with a larger weight: where the
        // surface rests, the weighted distances are orthogonal to what it can do. Drawn on too far
        // the steps would swing.
        const double factor = std::min(2 / (1 + weight_.minCoeff()), 1 / weight_.mean());
        Eigen::Matrix3Xd target = on_surface_ + (fit_.points - on_surface_) * (factor * weight_).asDiagonal();
        fit_to(fit_, target);
        const Eigen::VectorXd image = flat(control);
        const double change = (image - before).norm() / image.norm();
        if (sum > sum_before_) { // mixed too boldly
            start_anew();
            return change;
        }
        sum_before_ = sum;
        flat(control) = mixing_.next(before, image);
        return change;
    }

    Attempt& fit_;
    const FootPointProjection& projection_;
    Eigen::VectorXd weight_, distance_;
    Eigen::Matrix3Xd on_surface_;
    AndersonMixing mixing_{mixed};
    double sum_before_ = std::numeric_limits<double>::infinity();
    double sine_before_ = 0;
    double least_distance_ = std::numeric_limits<double>::infinity();
    Eigen::Matrix3Xd best_control_, best_points_;
};

} // namespace

void correct_parameters(Attempt& fit, const FootPointProjection& projection, const Progress& progress)
{
    Correction(fit, projection).run(progress);
}

} // namespace spia

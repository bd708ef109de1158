#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/nurbs/curve_ends.h"

namespace spia {

/// Least squares curves over given knots, through their first and last point exactly, for points at
/// fixed parameters: a linear map from points to control points, factored once. Each point counts
/// with the length of parameter that it stands for. [NURBS Book, A9.6 with the end derivatives
/// held; banded Cholesky]
///
/// Applied along u and then along v it is the tensor product least squares surface whose four
/// border rows are the least squares curves of the border points: neighbours that share these have
/// the same border.
class CurveFit {
public:
    /// @param knots  clamped, from 0 to 1, inner ones single
    /// @param parameters  strictly rising from 0 to 1
    /// @throws InputError if there are too few parameters for the knots (Schoenberg and Whitney),
    /// or the ends ask for more
    ///                     control points or a higher degree than there is
    CurveFit(std::vector<double> knots, int degree, CurveEnds ends, const std::vector<double>& parameters);

    /// Points (i, j), i fastest, of `width` curves that run along j, to their control points in the
    /// same order.
    Eigen::Matrix3Xd control(const Eigen::Matrix3Xd& points, int width) const;

    /// The curves' points at the parameters, from their control points; the transpose layout of
    /// control().
    Eigen::Matrix3Xd at_parameters(const Eigen::Matrix3Xd& control, int width) const;

    int degree() const { return degree_; }
    int count() const { return int(knots_.size()) - degree_ - 1; }
    const std::vector<double>& knots() const { return knots_; }
    const std::vector<double>& parameters() const { return parameters_; }

private:
    struct Row {               ///< of the basis at a parameter
        int first;             ///< control point of the first entry of `plain`
        Eigen::VectorXd plain; ///< the basis functions that do not vanish
        int first_free;        ///< control point of the first entry of `free`
        Eigen::VectorXd free;  ///< the same once control points that follow from others are
                               ///< expressed by them
    };

    static void express_third(Row& row, int first, int second, int third, double rate);
    void factorize();
    void set_held(Eigen::MatrixXd& control, const Eigen::Ref<const Eigen::MatrixXd>& points) const;

    int degree_;
    CurveEnds ends_;
    std::vector<double> knots_, parameters_, weight_;
    std::vector<Row> row_;
    std::vector<char> held_;                      ///< per control point: not found by least squares
    double rate_start_ = 0, rate_end_ = 0;        ///< natural: P2 = P1 + rate (P1 - P0), and from
                                                  ///< the other end
    Eigen::VectorXd tangent_start_, tangent_end_; ///< clamped: weights of the points in P1 - P0 (in
                                                  ///< Pn - P(n-1))
    int band_ = 0;
    Eigen::MatrixXd factor_; ///< Cholesky: entry (i, j) in row i, column j - i + band_
};

/// Clamped knots whose spans are bordered by the given values.
std::vector<double> clamped_knots(const std::vector<double>& borders, int degree);

} // namespace spia

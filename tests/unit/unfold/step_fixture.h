#pragma once
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "engine/unfold/step/unfold_step.h"

namespace spia::steps {

using std::numbers::pi;

inline FlattenOptions steel(double r = 1.77)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.8;
    return options;
}

/// Faces whose middles fulfil a condition.
template <class Is> std::vector<int> faces_where(const Eigen::MatrixXd& position, const TriMesh& part, const Is& is)
{
    std::vector<int> out;
    for (int f = 0; f < part.triangles(); ++f)
        if (is(Eigen::VectorXd(position(Eigen::all, part.triangle.col(f)).rowwise().mean())))
            out.push_back(f);
    return out;
}

inline double largest_strain(const SheetFields& face)
{
    return std::max(face.strain_major.cwiseAbs().maxCoeff(), face.strain_minor.cwiseAbs().maxCoeff());
}

inline Eigen::Matrix3Xd in_space(const Eigen::Matrix2Xd& flat)
{
    Eigen::Matrix3Xd out = Eigen::Matrix3Xd::Zero(3, flat.cols());
    out.topRows<2>() = flat;
    return out;
}

inline double furthest(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b)
{
    return (a - b).colwise().norm().maxCoeff();
}

} // namespace spia::steps

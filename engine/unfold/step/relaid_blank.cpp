#include "engine/unfold/step/relaid_blank.h"

#include <cmath>

namespace spia {

FlattenResult relaid_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const LaidLengths& laid,
                           const FlattenOptions& options, const Progress& progress, const StepWatch& watch)
{
    FlattenResult result = flatten_laid(part, laid, &flat, options, progress, watch);
    // Turned and moved onto the other, vertex by vertex. [Kabsch 1976 in the plane]
    Eigen::Matrix2Xd& X = result.blank.position;
    const Eigen::Vector2d to = flat.rowwise().mean(), from = X.rowwise().mean();
    const Eigen::Matrix2d moment = (flat.colwise() - to) * (X.colwise() - from).transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    X = ((turn * (X.colwise() - from)).colwise() + to).eval();
    return result;
}

} // namespace spia

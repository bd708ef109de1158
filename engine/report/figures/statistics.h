#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "engine/report/figures/field.h"

namespace spia {

/// How much of the sheet has which value.
struct Histogram {
    double least = 0, greatest = 1;
    std::vector<double> share; ///< of the part's area per bin, sum 1
};

/// @param value one per face; @param bins at least 1
Histogram histogram(const TriMesh& part, const Eigen::VectorXd& value, int bins);

/// How bad a value of a field is: the greater the worse. The thinner and the more squeezed the
/// worse; a deviation by its size.
double badness(Field field, double value);

/// Faces where a field is worst, the worst first, no two nearer to each other than a tenth of the
/// part: one spot is listed once.
/// @param value one per face; @param smallest look for the least values instead of the greatest
std::vector<int> worst_spots(const TriMesh& part, const Eigen::VectorXd& value, int most, bool smallest);

} // namespace spia

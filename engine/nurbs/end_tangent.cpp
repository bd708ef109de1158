#include "engine/nurbs/end_tangent.h"

#include <cassert>

namespace spia {

Eigen::VectorXd end_derivative_weights(const std::vector<double>& parameters, int count, bool at_start)
{
    assert(count >= 2 && count <= int(parameters.size()));
    const auto at = [&](int k) { return parameters[at_start ? size_t(k) : parameters.size() - 1 - size_t(k)]; };
    // The derivative of Lagrange's functions at the first node: 1 / (x_k - x_0) times a product
    // over the others.
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(count);
    for (int k = 1; k < count; ++k) {
        double product = 1 / (at(k) - at(0));
        for (int m = 1; m < count; ++m)
            if (m != k)
                product *= (at(0) - at(m)) / (at(k) - at(m));
        weight[k] = product;
        weight[0] -= product; // a constant has no derivative
    }
    return weight;
}

} // namespace spia

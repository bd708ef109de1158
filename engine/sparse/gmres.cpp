#include "engine/sparse/gmres.h"

#include <cmath>
#include <vector>

namespace spia {

GmresResult gmres(const LinearMap& A, const LinearMap& preconditioner, const Eigen::VectorXd& b, double tolerance,
                  int most_iterations)
{
    GmresResult result;
    const double norm_b = b.norm();
    result.x = Eigen::VectorXd::Zero(b.size());
    if (norm_b == 0) {
        result.relative_residual = 0;
        return result;
    }
    std::vector<Eigen::VectorXd> basis{b / norm_b}, search;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most_iterations + 1, most_iterations);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(most_iterations + 1), cosine(most_iterations), sine(most_iterations);
    g[0] = norm_b;
    int k = 0;
    while (k < most_iterations && std::abs(g[k]) > tolerance * norm_b) {
        search.push_back(preconditioner(basis[size_t(k)]));
        Eigen::VectorXd w = A(search.back());
        for (int i = 0; i <= k; ++i) { // modified Gram-Schmidt
            H(i, k) = w.dot(basis[size_t(i)]);
            w -= H(i, k) * basis[size_t(i)];
        }
        H(k + 1, k) = w.norm();
        const bool exhausted = !(H(k + 1, k) > 1e-14 * norm_b * 1e-14);
        basis.push_back(exhausted ? w : Eigen::VectorXd(w / H(k + 1, k)));
        for (int i = 0; i < k; ++i) {
            const double h = cosine[i] * H(i, k) + sine[i] * H(i + 1, k);
            H(i + 1, k) = -sine[i] * H(i, k) + cosine[i] * H(i + 1, k);
            H(i, k) = h;
        }
        const double length = std::hypot(H(k, k), H(k + 1, k));
        if (!(length > 0) || !std::isfinite(length))
            break;
        cosine[k] = H(k, k) / length;
        sine[k] = H(k + 1, k) / length;
        H(k, k) = length;
        H(k + 1, k) = 0;
        g[k + 1] = -sine[k] * g[k];
        g[k] *= cosine[k];
        ++k;
        if (exhausted)
            break;
    }
    const Eigen::VectorXd y = H.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g.head(k));
    for (int i = 0; i < k; ++i)
        result.x += y[i] * search[size_t(i)];
    result.iterations = k;
    result.relative_residual = std::abs(g[k]) / norm_b;
    return result;
}

} // namespace spia

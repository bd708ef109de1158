#include "engine/forming/solver/skin_strain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/small_dense.h"

namespace spia {
namespace {

/// Per vertex its neighbours and itself.
std::vector<std::vector<int>> stars(const TriMesh& part)
{
    std::vector<std::vector<int>> star(size_t(part.vertices()));
    for (const auto face : part.triangle.colwise())
        for (const int v : face)
            for (const int w : face)
                if (auto& list = star[size_t(v)]; std::find(list.begin(), list.end(), w) == list.end())
                    list.push_back(w);
    return star;
}

/// I + z W with the bending limited to a radius of one thickness.
Eigen::Matrix2d bent(const Eigen::Matrix2d& W, double z, bool& sharp)
{
    constexpr double most = 0.5; // |z| is half the thickness
    const EigenPairs<2> modes = eigen_pairs(W);
    const Eigen::Vector2d stretch = z * modes.value;
    sharp |= stretch.cwiseAbs().maxCoeff() > most;
    return modes.vector * (1 + stretch.array().max(-most).min(most)).matrix().asDiagonal() * modes.vector.transpose();
}

} // namespace

std::vector<Eigen::Matrix2d> curvatures(const TriMesh& part, const std::vector<Element>& element)
{
    const std::vector<std::vector<int>> star = stars(part);
    std::vector<Eigen::Matrix2d> W(element.size());
    parallel_for(part.triangles(), [&](int f) {
        const auto& J = element[size_t(f)].frame;
        const Eigen::Vector3d normal = J.col(0).cross(J.col(1)),
                              middle = part.position(Eigen::all, part.triangle.col(f)).rowwise().mean();
        std::vector<int> around;
        for (const int v : part.triangle.col(f))
            around.insert(around.end(), star[size_t(v)].begin(), star[size_t(v)].end());
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        const double size = std::sqrt(element[size_t(f)].area);
        Eigen::Matrix<double, Eigen::Dynamic, 6> A(Eigen::Index(around.size()), 6);
        Eigen::VectorXd height(A.rows());
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            const Eigen::Vector3d off = (part.position.col(around[size_t(i)]) - middle) / size;
            const Eigen::Vector2d x = J.transpose() * off;
            const double weight = 1 / (1 + off.squaredNorm());
            A.row(i) << 0.5 * x[0] * x[0], x[0] * x[1], 0.5 * x[1] * x[1], x[0], x[1], 1;
            A.row(i) *= weight;
            height[i] = weight * normal.dot(off);
        }
        const Eigen::Matrix<double, 6, 1> fit = shortest_least_squares(A, height);
        W[size_t(f)] << -fit[0], -fit[1], -fit[1], -fit[2];
        W[size_t(f)] /= size;
    });
    return W;
}

SkinStrains skin_strains(const TriMesh& part, const std::vector<Element>& element, const Blank& blank,
                         const Sheet& sheet)
{
    const int faces = part.triangles();
    const std::vector<Eigen::Matrix2d> W = curvatures(part, element);
    SkinStrains out;
    out.curvature.resize(faces);
    for (SkinFields* skin : {&out.outer, &out.inner})
        for (Eigen::VectorXd* field : {&skin->strain_major, &skin->strain_minor, &skin->strain_equivalent})
            field->resize(faces);
    Eigen::VectorXi is_sharp = Eigen::VectorXi::Zero(faces);
    parallel_for(faces, [&](int f) {
        const Eigen::Matrix2d G = inverse_gradient(element[size_t(f)], corners(blank.position, part.triangle.col(f)));
        const double thickness = sheet.thickness[f] * G.determinant();
        const Eigen::Vector2d principal = eigen_pairs(W[size_t(f)]).value;
        out.curvature[f] = -principal[0] > principal[1] ? principal[0] : principal[1];
        bool sharp = false;
        for (const auto& [skin, z] : {std::pair(&out.outer, 0.5 * thickness), {&out.inner, -0.5 * thickness}}) {
            const Svd2 d = svd(G * bent(W[size_t(f)], z, sharp).inverse());
            const Eigen::Vector2d strain = -d.s.array().log();
            skin->strain_major[f] = strain[1];
            skin->strain_minor[f] = strain[0];
            skin->strain_equivalent[f] = sheet.law_of(f)(d.U, strain).equivalent_strain;
        }
        is_sharp[f] = sharp;
    });
    out.sharp_faces = is_sharp.sum();
    return out;
}

} // namespace spia

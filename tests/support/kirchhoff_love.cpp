#include "tests/support/kirchhoff_love.h"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"

namespace spia::analysis {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct GaussRule {
    std::vector<double> at, weight; ///< on [0, 1]
};

/// By Newton's method on the Legendre polynomial.
GaussRule gauss(int points)
{
    GaussRule rule;
    for (int k = 0; k < points; ++k) {
        double x = std::cos(EIGEN_PI * (k + 0.75) / (points + 0.5)), slope = 1;
        for (int step = 0; step < 20; ++step) {
            double last = 1, now = x;
            for (int n = 2; n <= points; ++n)
                last = std::exchange(now, ((2 * n - 1) * x * now - (n - 1) * last) / n);
            slope = points * (x * now - last) / (x * x - 1);
            x -= now / slope;
        }
        rule.at.push_back((1 - x) / 2);
        rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

/// The functions of a patch at one place with their derivatives, and the surface there.
struct Place {
    std::vector<int> control; ///< in the patch
    std::vector<double> R, R_u, R_v, R_uu, R_uv, R_vv;
    Vector3d g1, g2, g11, g12, g22, g3;
    double area = 0; ///< |g1 x g2|
};

Place place_on(const NurbsSurface& s, double u, double v)
{
    const BasisValues N = basis(s.knots_u, s.degree_u, u), M = basis(s.knots_v, s.degree_v, v);
    Place p;
    double W = 0, Wu = 0, Wv = 0, Wuu = 0, Wuv = 0, Wvv = 0;
    for (int j = 0; j <= s.degree_v; ++j)
        for (int i = 0; i <= s.degree_u; ++i) {
            const int c = s.index(N.first + i, M.first + j);
            const double w = s.weight[c];
            const auto a = size_t(i), b = size_t(j);
            p.control.push_back(c);
            p.R.push_back(w * N.value[a] * M.value[b]);
            p.R_u.push_back(w * N.first_derivative[a] * M.value[b]);
            p.R_v.push_back(w * N.value[a] * M.first_derivative[b]);
            p.R_uu.push_back(w * N.second_derivative[a] * M.value[b]);
            p.R_uv.push_back(w * N.first_derivative[a] * M.first_derivative[b]);
            p.R_vv.push_back(w * N.value[a] * M.second_derivative[b]);
            W += p.R.back(), Wu += p.R_u.back(), Wv += p.R_v.back();
            Wuu += p.R_uu.back(), Wuv += p.R_uv.back(), Wvv += p.R_vv.back();
        }
    p.g1 = p.g2 = p.g11 = p.g12 = p.g22 = Vector3d::Zero();
    for (size_t k = 0; k < p.control.size(); ++k) { // quotient rule, twice
        const double A = p.R[k], Au = p.R_u[k], Av = p.R_v[k], Auu = p.R_uu[k], Auv = p.R_uv[k], Avv = p.R_vv[k];
        const double R = A / W, Ru = (Au - R * Wu) / W, Rv = (Av - R * Wv) / W;
        p.R[k] = R, p.R_u[k] = Ru, p.R_v[k] = Rv;
        p.R_uu[k] = (Auu - 2 * Ru * Wu - R * Wuu) / W;
        p.R_uv[k] = (Auv - Ru * Wv - Rv * Wu - R * Wuv) / W;
        p.R_vv[k] = (Avv - 2 * Rv * Wv - R * Wvv) / W;
        const Vector3d x = s.control.col(p.control[k]);
        p.g1 += Ru * x, p.g2 += Rv * x;
        p.g11 += p.R_uu[k] * x, p.g12 += p.R_uv[k] * x, p.g22 += p.R_vv[k] * x;
    }
    p.g3 = p.g1.cross(p.g2);
    p.area = p.g3.norm();
    p.g3 /= p.area;
    return p;
}

/// How the unit normal turns with displacement component e of function k.
Vector3d turn_of_normal(const Place& p, size_t k, int e)
{
    const Vector3d axis = Vector3d::Unit(e);
    const Vector3d raw = p.R_u[k] * axis.cross(p.g2) + p.R_v[k] * p.g1.cross(axis);
    return (raw - p.g3 * p.g3.dot(raw)) / p.area;
}

/// Stress of strains (11, 22, 2 * 12) in the directions of the parameters.
Matrix3d plane_stress(const Place& p, double young, double poisson)
{
    Eigen::Matrix2d metric;
    metric << p.g1.squaredNorm(), p.g1.dot(p.g2), p.g1.dot(p.g2), p.g2.squaredNorm();
    const Eigen::Matrix2d g = metric.inverse();
    const double a = g(0, 0), b = g(1, 1), c = g(0, 1), nu = poisson;
    Matrix3d C;
    C << a * a, nu * a * b + (1 - nu) * c * c, a * c, //
        nu * a * b + (1 - nu) * c * c, b * b, b * c,  //
        a * c, b * c, ((1 - nu) * a * b + (1 + nu) * c * c) / 2;
    return young / (1 - nu * nu) * C;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_patch(const Shell& shell, size_t number, const SharedControls& shared, Triplets& stiffness,
               Eigen::VectorXd& load)
{
    const NurbsSurface& s = shell.patches.patch[number];
    const std::vector<double> us = span_borders(s.knots_u, s.degree_u), vs = span_borders(s.knots_v, s.degree_v);
    const GaussRule along_u = gauss(s.degree_u + 1), along_v = gauss(s.degree_v + 1);
    const double t = shell.thickness;
    for (size_t j = 0; j + 1 < vs.size(); ++j)
        for (size_t i = 0; i + 1 < us.size(); ++i) {
            Eigen::MatrixXd K;
            std::vector<int> dof;
            for (size_t b = 0; b < along_v.at.size(); ++b)
                for (size_t a = 0; a < along_u.at.size(); ++a) {
                    const double du = us[i + 1] - us[i], dv = vs[j + 1] - vs[j];
                    const Place p = place_on(s, us[i] + du * along_u.at[a], vs[j] + dv * along_v.at[b]);
                    const auto functions = Eigen::Index(p.control.size());
                    const double dA = p.area * du * dv * along_u.weight[a] * along_v.weight[b];
                    Eigen::MatrixXd membrane(3, 3 * functions), bending(3, 3 * functions);
                    for (size_t k = 0; k < p.control.size(); ++k)
                        for (int e = 0; e < 3; ++e) {
                            const Eigen::Index c = 3 * Eigen::Index(k) + e;
                            const Vector3d n = turn_of_normal(p, k, e);
                            membrane.col(c) << p.g1[e] * p.R_u[k], p.g2[e] * p.R_v[k],
                                p.g1[e] * p.R_v[k] + p.g2[e] * p.R_u[k];
                            bending.col(c) << p.R_uu[k] * p.g3[e] + p.g11.dot(n), p.R_vv[k] * p.g3[e] + p.g22.dot(n),
                                2 * (p.R_uv[k] * p.g3[e] + p.g12.dot(n));
                        }
                    const Matrix3d C = plane_stress(p, shell.young, shell.poisson);
                    if (K.size() == 0) {
                        K = Eigen::MatrixXd::Zero(3 * functions, 3 * functions);
                        for (const int c : p.control)
                            for (int e = 0; e < 3; ++e)
                                dof.push_back(3 * shared.of(int(number), c) + e);
                    }
                    K += dA *
                         (t * membrane.transpose() * C * membrane + t * t * t / 12 * bending.transpose() * C * bending);
                    for (size_t k = 0; k < p.control.size(); ++k)
                        load.segment<3>(dof[3 * k]) += dA * p.R[k] * shell.load;
                }
            for (size_t r = 0; r < dof.size(); ++r)
                for (size_t c = 0; c < dof.size(); ++c)
                    stiffness.emplace_back(dof[r], dof[c], K(Eigen::Index(r), Eigen::Index(c)));
        }
}

/// (u, v) of a place on a side.
Eigen::Vector2d on(Side side, double t)
{
    switch (side) {
    case Side::v0: return {t, 0};
    case Side::u1: return {1, t};
    case Side::v1: return {t, 1};
    case Side::u0: return {0, t};
    }
    return {};
}

/// The change of the angle between two patches, (g3A x g3B) . tangent, costs energy.
void add_interface(const Shell& shell, const PatchInterface& joint, const SharedControls& shared, Triplets& stiffness)
{
    const NurbsSurface &A = shell.patches.patch[size_t(joint.first.patch)],
                       &B = shell.patches.patch[size_t(joint.second.patch)];
    const std::vector<double> spans = span_borders(side_knots(A, joint.first.side), side_degree(A, joint.first.side));
    const GaussRule rule = gauss(side_degree(A, joint.first.side) + 1);
    const bool along_u = joint.first.side == Side::v0 || joint.first.side == Side::v1;
    const double D = shell.young * std::pow(shell.thickness, 3) / (12 * (1 - shell.poisson * shell.poisson));
    for (size_t i = 0; i + 1 < spans.size(); ++i)
        for (size_t q = 0; q < rule.at.size(); ++q) {
            const double d = spans[i + 1] - spans[i], t = spans[i] + d * rule.at[q];
            const Eigen::Vector2d a = on(joint.first.side, t), b = on(joint.second.side, joint.reversed ? 1 - t : t);
            const Place pa = place_on(A, a[0], a[1]), pb = place_on(B, b[0], b[1]);
            const Vector3d along = along_u ? pa.g1 : pa.g2, tangent = along.normalized();
            const Vector3d nb = pb.g3 * (pa.g3.dot(pb.g3) < 0 ? -1 : 1); // B may be turned over
            std::vector<int> dof;
            std::vector<double> change;
            for (size_t k = 0; k < pa.control.size(); ++k)
                for (int e = 0; e < 3; ++e) {
                    dof.push_back(3 * shared.of(joint.first.patch, pa.control[k]) + e);
                    change.push_back(turn_of_normal(pa, k, e).cross(nb).dot(tangent));
                }
            for (size_t k = 0; k < pb.control.size(); ++k)
                for (int e = 0; e < 3; ++e) {
                    dof.push_back(3 * shared.of(joint.second.patch, pb.control[k]) + e);
                    change.push_back((pa.g3.dot(pb.g3) < 0 ? -1 : 1) *
                                     pa.g3.cross(turn_of_normal(pb, k, e)).dot(tangent));
                }
            const double length = along.norm() * d;
            const double cost = shell.hinge_stiffness * D / length * length * rule.weight[q];
            for (size_t r = 0; r < dof.size(); ++r)
                for (size_t c = 0; c < dof.size(); ++c)
                    stiffness.emplace_back(dof[r], dof[c], cost * change[r] * change[c]);
        }
}

struct System {
    SharedControls shared;
    Eigen::SparseMatrix<double> stiffness;
    Eigen::VectorXd load;
    Eigen::Matrix3Xd place; ///< of the shared control points
};

System assemble(const Shell& shell)
{
    System system;
    system.shared = shared_controls(shell.patches);
    const int size = 3 * system.shared.count;
    system.load = Eigen::VectorXd::Zero(size);
    system.place.resize(3, system.shared.count);
    Triplets triplets;
    for (size_t p = 0; p < shell.patches.patch.size(); ++p) {
        add_patch(shell, p, system.shared, triplets, system.load);
        for (int c = 0; c < int(shell.patches.patch[p].control.cols()); ++c)
            system.place.col(system.shared.of(int(p), c)) = shell.patches.patch[p].control.col(c);
    }
    if (shell.hinge_stiffness > 0)
        for (const PatchInterface& joint : shell.patches.interfaces)
            add_interface(shell, joint, system.shared, triplets);
    system.stiffness.resize(size, size);
    system.stiffness.setFromTriplets(triplets.begin(), triplets.end());
    return system;
}

/// One knot in the middle of each span along u.
NurbsSurface halved_along_u(const NurbsSurface& s)
{
    const std::vector<double> border = span_borders(s.knots_u, s.degree_u);
    Eigen::Matrix4Xd row_major(4, s.control.cols()); // homogeneous
    for (Eigen::Index c = 0; c < s.control.cols(); ++c)
        row_major.col(c) << s.weight[c] * s.control.col(c), s.weight[c];
    std::vector<double> knots = s.knots_u;
    int count = s.count_u;
    Eigen::Matrix4Xd net = row_major;
    const int p = s.degree_u;
    for (size_t b = 0; b + 1 < border.size(); ++b) {
        const double x = (border[b] + border[b + 1]) / 2;
        const int span = find_span(knots, p, x);
        Eigen::Matrix4Xd finer(4, Eigen::Index(count + 1) * s.count_v);
        for (int j = 0; j < s.count_v; ++j)
            for (int i = 0; i <= count; ++i) {
                const auto old = [&](int k) { return net.col(k + j * count); };
                if (i <= span - p)
                    finer.col(i + j * (count + 1)) = old(i);
                else if (i > span)
                    finer.col(i + j * (count + 1)) = old(i - 1);
                else {
                    const double share = (x - knots[size_t(i)]) / (knots[size_t(i + p)] - knots[size_t(i)]);
                    finer.col(i + j * (count + 1)) = share * old(i) + (1 - share) * old(i - 1);
                }
            }
        net = std::move(finer);
        knots.insert(knots.begin() + span + 1, x);
        ++count;
    }
    NurbsSurface result = s;
    result.knots_u = std::move(knots);
    result.count_u = count;
    result.weight = net.row(3).transpose();
    result.control = net.topRows<3>().array().rowwise() / net.row(3).array();
    return result;
}

NurbsSurface exchanged(const NurbsSurface& s)
{
    NurbsSurface r;
    r.degree_u = s.degree_v, r.degree_v = s.degree_u;
    r.count_u = s.count_v, r.count_v = s.count_u;
    r.knots_u = s.knots_v, r.knots_v = s.knots_u;
    r.control.resize(3, s.control.cols());
    r.weight.resize(s.weight.size());
    for (int j = 0; j < s.count_v; ++j)
        for (int i = 0; i < s.count_u; ++i) {
            r.control.col(r.index(j, i)) = s.control.col(s.index(i, j));
            r.weight[r.index(j, i)] = s.weight[s.index(i, j)];
        }
    return r;
}

} // namespace

Solution solve(const Shell& shell)
{
    const System system = assemble(shell);
    const auto size = system.stiffness.rows();
    std::vector<Eigen::Index> free_of(size_t(size), -1);
    Eigen::Index free = 0;
    for (int n = 0; n < system.shared.count; ++n) {
        const auto held = shell.held(n, system.place.col(n));
        for (size_t e = 0; e < 3; ++e)
            if (!held[e])
                free_of[3 * size_t(n) + e] = free++;
    }
    Triplets kept;
    Eigen::VectorXd load(free);
    for (Eigen::Index c = 0; c < size; ++c) {
        if (free_of[size_t(c)] < 0)
            continue;
        load[free_of[size_t(c)]] = system.load[c];
        for (Eigen::SparseMatrix<double>::InnerIterator it(system.stiffness, c); it; ++it)
            if (free_of[size_t(it.row())] >= 0)
                kept.emplace_back(free_of[size_t(it.row())], free_of[size_t(c)], it.value());
    }
    Eigen::SparseMatrix<double> K(free, free);
    K.setFromTriplets(kept.begin(), kept.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(K);
    if (factor.info() != Eigen::Success || factor.vectorD().minCoeff() <= 0)
        throw std::runtime_error("the shell can move freely");
    const Eigen::VectorXd x = factor.solve(load);
    Solution solution;
    solution.shared = system.shared;
    solution.displacement = Eigen::Matrix3Xd::Zero(3, system.shared.count);
    for (Eigen::Index d = 0; d < size; ++d)
        if (free_of[size_t(d)] >= 0)
            solution.displacement(d % 3, d / 3) = x[free_of[size_t(d)]];
    solution.energy = load.dot(x) / 2;
    return solution;
}

Vector3d displacement_at(const Shell& shell, const Solution& solution, int patch, double u, double v)
{
    const Place p = place_on(shell.patches.patch[size_t(patch)], u, v);
    Vector3d sum = Vector3d::Zero();
    for (size_t k = 0; k < p.control.size(); ++k)
        sum += p.R[k] * solution.displacement.col(solution.shared.of(patch, p.control[k]));
    return sum;
}

double energy(const Shell& shell, const Eigen::Matrix3Xd& displacement)
{
    const System system = assemble(shell);
    const Eigen::VectorXd x = displacement.reshaped();
    return x.dot(system.stiffness * x) / 2;
}

MultiPatch refined(const MultiPatch& patches, int times)
{
    MultiPatch result = patches;
    for (int k = 0; k < times; ++k)
        for (NurbsSurface& s : result.patch)
            s = exchanged(halved_along_u(exchanged(halved_along_u(s))));
    return result;
}

} // namespace spia::analysis

#include "engine/forming/solver/equilibrium.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/small_dense.h"
#include "tests/support/shapes.h"

namespace spia::equilibrium_test {
namespace {

Material mild_steel() { return {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""}; }

/// A wavy patch and a blank that strains it by some ten percent everywhere.
TriMesh wavy()
{
    TriMesh part = shapes::rectangle(30, 20, 6, 5);
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) = 3 * std::sin(0.2 * part.position(0, v)) * std::cos(0.25 * part.position(1, v));
    return part;
}
Eigen::Matrix2Xd strained(const TriMesh& part)
{
    Eigen::Matrix2Xd X = part.position.topRows<2>();
    for (int v = 0; v < part.vertices(); ++v) {
        X(0, v) *= 1.08 + 0.002 * X(1, v);
        X(1, v) += 0.01 * X(0, v) + 0.3 * std::sin(0.3 * X(0, v));
    }
    return X;
}

} // namespace

TEST(Equilibrium, TangentAgreesWithCentralDifferencesWithFriction)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const Eigen::Matrix2Xd X = strained(part);
    ExternalForces friction;
    friction.traction = Eigen::VectorXd::Constant(part.triangles(), 0.8);
    friction.plane << 0.8, 0, 0, 1, -0.6, 0; // looked at askew, so that the slip is turned, too
    friction.travelling = Eigen::VectorXd::LinSpaced(part.triangles(), 0, 0.5);
    friction.stuck = 1.03 * X;
    std::vector<Element> element = elements(part);
    for (size_t f = 0; f < element.size(); f += 2) // of a curved face
        element[f].metric = Eigen::Matrix2d{{1.02 + 1e-3 * double(f), 0.03}, {0.03, 0.97}};
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    VirtualWork work(part, element, sheet, friction);
    std::vector<char> relaxed(size_t(part.vertices()), 0);
    for (size_t v = 0; v < relaxed.size(); v += 3)
        relaxed[v] = 1;
    for (const auto& some : {std::vector<char>(relaxed.size(), 0), relaxed}) {
        work.relax(some);
        work.set_axes(X);
        Eigen::MatrixXd difference(X.size(), X.size());
        const double step = 1e-6;
        for (Eigen::Index i = 0; i < X.size(); ++i) {
            Eigen::Matrix2Xd up = X, down = X;
            up(i) += step;
            down(i) -= step;
            difference.col(i) = (work.residual(up) - work.residual(down)) / (2 * step);
        }
        BlockMatrix tangent(part.triangle, part.vertices());
        work.tangent(X, tangent);
        for (Eigen::Index i = 0; i < X.size(); ++i) {
            Eigen::VectorXd column;
            tangent.multiply(Eigen::VectorXd::Unit(X.size(), i), column);
            EXPECT_LT((column - difference.col(i)).norm(), 1e-6 * difference.norm());
        }
    }
}

TEST(Equilibrium, TheDefiniteNeighbourIsTheSymmetricTangentWithItsElementsEigenvaluesByTheirSize)
{
    const TriMesh part = shapes::rectangle(8, 6, 4, 3); // flat and strained evenly: all axes agree
    const MembraneLaw law(mild_steel());
    const std::vector<Element> element = elements(part);
    const ExternalForces none;
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    Eigen::Matrix2d stretched, squeezed;
    stretched << 0.93, 0.02, -0.01, 0.95; // blank to part: tension both ways
    squeezed << 1.3, 0.1, 0.05, 0.8;
    for (const Eigen::Matrix2d& G : {stretched, squeezed}) {
        const Eigen::Matrix2Xd X = G * part.position.topRows<2>();
        VirtualWork work(part, element, sheet, none);
        work.set_axes(X);
        BlockMatrix tangent(part.triangle, part.vertices()), definite(tangent);
        work.tangents(X, tangent, definite);
        Eigen::MatrixXd K(X.size(), X.size()), N(K), expected = Eigen::MatrixXd::Zero(X.size(), X.size());
        for (Eigen::Index i = 0; i < X.size(); ++i) {
            Eigen::VectorXd column;
            tangent.multiply(Eigen::VectorXd::Unit(X.size(), i), column);
            K.col(i) = column;
            definite.multiply(Eigen::VectorXd::Unit(X.size(), i), column);
            N.col(i) = column;
        }
        for (const Eigen::Index pinned : {Eigen::Index(0), Eigen::Index(1), X.size() - 1})
            N.row(pinned).setZero(), N.col(pinned).setZero(), K.row(pinned).setZero(), K.col(pinned).setZero();
        // The second route: element by element from the tangent of that triangle alone.
        for (int f = 0; f < part.triangles(); ++f) {
            TriMesh alone;
            alone.position = part.position(Eigen::all, part.triangle.col(f));
            alone.triangle.resize(3, 1);
            alone.triangle << 0, 1, 2;
            const std::vector<Element> one = elements(alone);
            const Eigen::Matrix2Xd x = X(Eigen::all, part.triangle.col(f));
            VirtualWork single(alone, one, sheet, none);
            single.set_axes(x);
            BlockMatrix matrix(alone.triangle, 3);
            single.tangent(x, matrix);
            Matrix6d k;
            for (int i = 0; i < 6; ++i) {
                Eigen::VectorXd column;
                matrix.multiply(Eigen::VectorXd::Unit(6, i), column);
                k.col(i) = column;
            }
            // Over the entries of G: B^+ takes them to displacements.
            const Eigen::Matrix<double, 4, 6> B = gradient_operator(one[0]);
            const Eigen::Matrix<double, 6, 4> back = B.transpose() * (B * B.transpose()).inverse();
            const EigenPairs<4> modes = eigen_pairs(back.transpose() * (k + k.transpose()) * back / 2);
            const Matrix6d magnitude =
                B.transpose() * modes.vector * modes.value.cwiseAbs().asDiagonal() * modes.vector.transpose() * B;
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j < 6; ++j)
                    expected(2 * part.triangle(i / 2, f) + i % 2, 2 * part.triangle(j / 2, f) + j % 2) +=
                        magnitude(i, j);
        }
        for (const Eigen::Index pinned : {Eigen::Index(0), Eigen::Index(1), X.size() - 1})
            expected.row(pinned).setZero(), expected.col(pinned).setZero();
        EXPECT_LT((N - expected).norm(), 1e-6 * N.norm());
        if (G == squeezed) { // else there is nothing to see
            EXPECT_GT((0.5 * (K + K.transpose()) - expected).norm(), 0.01 * N.norm());
        }
    }
}

TEST(Equilibrium, MovingTheBlankChangesNothing)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const Eigen::Matrix2Xd X = strained(part);
    const Eigen::Matrix2Xd moved = (Eigen::Rotation2Dd(0.7).toRotationMatrix() * X).colwise() + Eigen::Vector2d(11, -4);
    const std::vector<Element> element = elements(part);
    const ExternalForces none;
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    VirtualWork work(part, element, sheet, none);
    work.set_axes(X);
    const Eigen::VectorXd a = work.residual(X), b = work.residual(moved);
    EXPECT_LT((a - b).norm(), 1e-10 * a.norm());
}

TEST(Equilibrium, TheAxesDoNotChangeTheForces)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const Eigen::Matrix2Xd X = strained(part), flat = part.position.topRows<2>();
    const std::vector<Element> element = elements(part);
    const ExternalForces none;
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    VirtualWork work(part, element, sheet, none);
    work.set_axes(X);
    const Eigen::VectorXd a = work.residual(X);
    work.set_axes(1.7 * flat);
    const Eigen::VectorXd b = work.residual(X);
    // Two forces in the same tangent plane, written in axes T and T': both zero or none, and near
    // each other here.
    for (int v = 0; v < part.vertices(); ++v) {
        const double cosine = a.segment<2>(2 * v).normalized().dot(b.segment<2>(2 * v).normalized());
        EXPECT_GT(cosine, 0.9) << v;
    }
}

TEST(Equilibrium, AFoldedSheetFeelsWhatAFlatOneFeels)
{
    const TriMesh flat = shapes::rectangle(30, 20, 6, 5);
    TriMesh folded = flat; // by 70 degrees along the line x = 15
    for (int v = 0; v < flat.vertices(); ++v)
        if (const double beyond = flat.position(0, v) - 15; beyond > 1e-9)
            folded.position.col(v) << 15 + beyond * std::cos(1.2), flat.position(1, v), beyond * std::sin(1.2);
    const MembraneLaw law(mild_steel());
    const ExternalForces none;
    const Eigen::Matrix2Xd X = strained(flat);
    Eigen::VectorXd R[2];
    int k = 0;
    for (const TriMesh* part : {&flat, &std::as_const(folded)}) {
        const std::vector<Element> element = elements(*part);
        const Sheet sheet = uniform_sheet(law, 0.8, part->triangles());
        VirtualWork work(*part, element, sheet, none);
        work.set_axes(X);
        R[k++] = work.residual(X);
    }
    EXPECT_LT((R[0] - R[1]).norm(), 1e-10 * R[0].norm());
}

TEST(Equilibrium, TheResultantIsTheSumOfTheForcesThatAreLeft)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const std::vector<Element> element = elements(part);
    ExternalForces friction; // on one half only: it has to be held
    friction.traction = Eigen::VectorXd::Zero(part.triangles());
    friction.traction.head(part.triangles() / 2).setConstant(0.3);
    friction.plane << 1, 0, 0, 1, 0, 0;
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    VirtualWork work(part, element, sheet, friction);
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    const Eigen::Matrix2Xd start = part.position.topRows<2>();
    const EquilibriumResult result = solve_equilibrium(part, element, work, start, matrix, cholesky, {}, {});
    ASSERT_EQ(result.ended, Ended::converged);
    const Eigen::VectorXd R = work.residual(result.position);
    double mass = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (int f = 0; f < part.triangles(); ++f) {
        mass += element[size_t(f)].area;
        for (int a = 0; a < 3; ++a)
            centre += element[size_t(f)].area / 3 * start.col(part.triangle(a, f));
    }
    centre /= mass;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = 0; v < part.vertices(); ++v) {
        const Eigen::Vector2d f = R.segment<2>(2 * v), arm = start.col(v) - centre;
        sum -= Eigen::Vector3d(f[0], f[1], arm[0] * f[1] - arm[1] * f[0]);
    }
    EXPECT_GT(sum.norm(), 1);
    EXPECT_LT((result.resultant - sum).norm(), 1e-6 * sum.norm());
}

TEST(Equilibrium, VerticesAgreeWhereTheStrainIsUniform)
{
    const TriMesh flat = shapes::rectangle(30, 20, 6, 5);
    const MembraneLaw law(mild_steel());
    const std::vector<Element> element = elements(flat);
    const ExternalForces none;
    const Sheet sheet = uniform_sheet(law, 0.8, flat.triangles());
    VirtualWork work(flat, element, sheet, none);
    Eigen::Matrix2d stretch;
    stretch << 1.2, 0.1, 0, 0.9;
    const Eigen::Matrix2Xd uniform = stretch * flat.position.topRows<2>();
    work.set_axes(uniform);
    EXPECT_LT((work.mismatch().array() - 1).abs().maxCoeff(), 1e-12);
    const Eigen::VectorXd strict = work.residual(uniform);
    work.relax(std::vector<char>(size_t(flat.vertices()), 1));
    EXPECT_LT((work.residual(uniform) - strict).norm(), 1e-12 * strict.norm());

    Eigen::Matrix2Xd kinked = flat.position.topRows<2>(); // twice as long beyond x = 15: F jumps by
                                                          // 2 there
    for (int v = 0; v < flat.vertices(); ++v)
        if (kinked(0, v) > 15)
            kinked(0, v) += kinked(0, v) - 15;
    work.set_axes(kinked);
    const Eigen::VectorXd mismatch = work.mismatch();
    for (int v = 0; v < flat.vertices(); ++v)
        if (std::abs(flat.position(0, v) - 15) < 1e-9)
            EXPECT_GT(mismatch[v], 1.2) << v;
        else
            EXPECT_NEAR(mismatch[v], 1, 1e-12) << v;
}

} // namespace spia::equilibrium_test

#include "engine/forming/solver/sheet_fields.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace spia {

TEST(SheetFields, OfAUniformStretchAreThoseOfAPaperCalculation)
{
    const TriMesh part = shapes::rectangle(30, 20, 4, 3);
    // Formed from a blank that was shorter along x and wider along y, lying turned in its plane.
    const double along_x = 1.2, along_y = 0.95, h0 = 0.8, r = 1.77;
    Blank blank;
    blank.position = Eigen::Rotation2Dd(0.8).toRotationMatrix() *
                     Eigen::DiagonalMatrix<double, 2>(1 / along_x, 1 / along_y) * part.position.topRows<2>();
    const Material steel{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    const std::vector<Element> element = elements(part);
    const SheetFields face = face_fields(part, element, blank, uniform_sheet(MembraneLaw(steel), h0, part.triangles()));

    const double e1 = std::log(along_x), e2 = std::log(along_y), q = r / (1 + r);
    const double equivalent = (1 + r) / std::sqrt(1 + 2 * r) * std::sqrt(e1 * e1 + e2 * e2 + 2 * q * e1 * e2);
    const double flow = 565.32 * std::pow(0.007117 + equivalent, 0.2589);
    const double factor = flow / equivalent * (1 + r) * (1 + r) / (1 + 2 * r);
    for (const SheetFields& fields : {face, node_fields(part, element, face)}) {
        const auto expect_all = [](const Eigen::VectorXd& values, double expected) {
            EXPECT_LT((values.array() - expected).abs().maxCoeff(), 1e-12 * (1 + std::abs(expected))) << expected;
        };
        expect_all(fields.strain_major, e1);
        expect_all(fields.strain_minor, e2);
        expect_all(fields.strain_equivalent, equivalent);
        expect_all(fields.thickness, h0 / (along_x * along_y));
        expect_all(fields.thinning, 1 - 1 / (along_x * along_y));
        expect_all(fields.stress_equivalent, flow);
        expect_all(fields.stress_major, factor * (e1 + q * e2));
        expect_all(fields.stress_minor, factor * (e2 + q * e1));
        expect_all(fields.direction_major.row(0).cwiseAbs().transpose(), 1);
        EXPECT_EQ(fields.necking.sum(), 0);
    }
}

TEST(SheetFields, AFaceIsMarkedFromTheTrustedStrainOn)
{
    const TriMesh part = shapes::rectangle(4, 1, 1, 1);
    const std::vector<Element> element = elements(part);
    StressCurve::Options curve;
    curve.trusted_strain = 0.2;
    const MembraneLaw law({"m", 206000, 0.3, 7850, Swift{565, 0.007, 0.26}, 1, 1, 1, ""}, curve);
    for (const double strain : {0.19, 0.21}) { // uniaxial: the minor strain is -r / (1 + r) times
                                               // the major one
        Eigen::Matrix2Xd X = part.position.topRows<2>();
        X.row(0) *= std::exp(-strain);
        X.row(1) *= std::exp(strain / 2);
        const SheetFields face = face_fields(part, element, {X}, uniform_sheet(law, 1, part.triangles()));
        EXPECT_NEAR(face.strain_equivalent[0], strain, 1e-12);
        EXPECT_EQ(face.necking.sum(), strain > 0.2 ? 2 : 0);
    }
}

TEST(SheetFields, NodesTakeTheMeanByArea)
{
    const TriMesh part = shapes::rectangle(4, 1, 1, 1); // two triangles
    const std::vector<Element> element = elements(part);
    SheetFields face =
        face_fields(part, element, {part.position.topRows<2>()},
                    uniform_sheet(MembraneLaw({"m", 206000, 0.3, 7850, Swift{565, 0.007, 0.26}, 1, 1, 1, ""}), 1,
                                  part.triangles()));
    face.thickness << 1, 3;
    face.necking << 0, 1;
    std::vector<Element> uneven = element;
    uneven[1].area = 3 * uneven[0].area;
    const SheetFields node = node_fields(part, uneven, face);
    for (int v = 0; v < part.vertices(); ++v) {
        const bool first = (part.triangle.col(0).array() == v).any(),
                   second = (part.triangle.col(1).array() == v).any();
        EXPECT_NEAR(node.thickness[v], first && second ? 2.5 : first ? 1 : 3, 1e-14);
        EXPECT_EQ(node.necking[v], second);
    }
}

} // namespace spia

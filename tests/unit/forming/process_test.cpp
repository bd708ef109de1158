#include "engine/forming/process/process.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/forming/solver/equilibrium.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia::process_test {
namespace {

const Material steel{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
const Eigen::Matrix<double, 3, 2> flat_plane = Eigen::Matrix<double, 3, 2>::Identity();

ExternalForces forces(const ProcessConditions& process, const TriMesh& part)
{
    return external_forces(process, part, steel, 0.8, flat_plane, Eigen::Vector3d::Zero());
}

std::string refusal(const ProcessConditions& process, const TriMesh& part)
{
    try {
        forces(process, part);
        sheet_of(steel, 0.8, {}, process, part, flat_plane);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::vector<int> all_faces(const TriMesh& part)
{
    std::vector<int> faces(size_t(part.triangles()));
    for (size_t f = 0; f < faces.size(); ++f)
        faces[f] = int(f);
    return faces;
}

Eigen::Vector3d sum_across(const ExternalForces& forces)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Restraint& r : forces.restraint)
        sum += r.force * r.across.cwiseAbs();
    return sum;
}

} // namespace

TEST(Process, ABinderForceIsCoulombFrictionOnBothSidesOverTheAreaSeen)
{
    TriMesh part = shapes::rectangle(50, 40, 5, 4);
    ProcessConditions process;
    process.contact = {{"binder", all_faces(part), {}, 10000, 0.12, 2}};
    EXPECT_NEAR(forces(process, part).traction[3], 2 * 0.12 * 10000 / 2000, 1e-12);
    EXPECT_EQ(forces(process, part).travelling.size(), 0);
    process.contact[0].sides = 1; // a tool that travels
    EXPECT_NEAR(forces(process, part).travelling[3], 0.12 * 5, 1e-12);
    EXPECT_EQ(forces(process, part).traction.size(), 0);
    part.position.row(2) = part.position.row(0); // at 45 degrees: the same area seen from above
    EXPECT_NEAR(forces(process, part).travelling[3], 0.12 * 5, 1e-12);
    process.contact.push_back({"pad", {3}, 2.0, {}, 0.1, 1}); // adds up where two overlap
    EXPECT_NEAR(forces(process, part).travelling[3], 0.12 * 5 + 0.2, 1e-12);
    EXPECT_NEAR(forces(process, part).travelling[4], 0.12 * 5, 1e-12);
}

TEST(Process, ADrawbeadRestrainsAcrossItsLineWithItsForceTimesItsLength)
{
    const TriMesh part = shapes::rectangle(50, 40, 7, 9);
    ProcessConditions process;
    process.drawbeads = {{"bead", {{20, 5, 0}, {20, 35, 0}}, 80}};
    const ExternalForces out = forces(process, part);
    EXPECT_LT((sum_across(out) - Eigen::Vector3d(80 * 30, 0, 0)).norm(), 1e-9);
    process.drawbeads[0].line.push_back({20, 5, 0}); // there and back: two beads, and not none
    EXPECT_LT((sum_across(forces(process, part)) - Eigen::Vector3d(80 * 60, 0, 0)).norm(), 1e-9);
    for (const Restraint& r : out.restraint) {
        EXPECT_NEAR(std::abs(r.across[0]), 1, 1e-12);
        EXPECT_NEAR(part.position(0, r.vertex), 20, 50.0 / 7); // within the faces that it crosses
    }
}

TEST(Process, AnEdgeRestraintIsAShareOfTheLockForceSquareToTheEdge)
{
    const TriMesh part = shapes::rectangle(50, 40, 10, 8);
    ProcessConditions process;
    process.edge_restraint = 0.3;
    double across_x = 0;
    for (const Restraint& r : forces(process, part).restraint)
        if (std::abs(r.across[0]) > 0.99)
            across_x += r.force;
    // Two sides of 40 mm, less half an edge (5 mm) at each corner, where the force goes at an
    // angle.
    EXPECT_NEAR(across_x, 0.3 * lock_force(steel, 0.8) * 2 * (40 - 5), 1e-6);
}

TEST(Process, TheLockForceIsTheLimitOfAPlaneStrainStrip)
{
    // K (e0 + eps_eq)^n exp(-eps) times the plane strain factor is greatest where factor * n / (e0
    // + eps_eq) = 1.
    const double r = 1.77, factor = (1 + r) / std::sqrt(1 + 2 * r), n = 0.2589, e0 = 0.007117;
    const double equivalent = factor * n - e0;
    const double expected = 0.8 * factor * 565.32 * std::pow(factor * n, n) * std::exp(-equivalent / factor);
    EXPECT_NEAR(lock_force(steel, 0.8), expected, 1e-5 * expected);
}

TEST(Process, APilotHoldsTheNearestVertexWhereItIsSeen)
{
    TriMesh part = shapes::rectangle(50, 40, 5, 4);
    part.position.row(2).setConstant(12);
    ProcessConditions process;
    process.pilots = {{"pin", {{10.4, 19.8, 12}}}, {"row", {{0, 40, 12}, {50, 40, 12}}}};
    const ExternalForces out = forces(process, part);
    ASSERT_EQ(out.held.size(), 1u + 6u);
    EXPECT_LT((out.held[0].place - Eigen::Vector2d(10, 20)).norm(), 1e-12);
    for (size_t k = 1; k < out.held.size(); ++k)
        EXPECT_EQ(out.held[k].place[1], 40);
}

TEST(Process, ALineMayBridgeABulgeButNotTheEdge)
{
    const auto bead = [](const TriMesh& part) {
        ProcessConditions process;
        // along the lower side
        process.drawbeads = {{"b", {part.position.col(0), part.position.col(10)}, 80}};
        return refusal(process, part);
    };
    const auto bent = [](double height, int axis) { // of 100 x 40 mm: a diagonal of 108 mm
        TriMesh part = shapes::rectangle(100, 40, 10, 4);
        for (int v = 0; v < part.vertices(); ++v)
            part.position(axis, v) += height * std::sin(std::numbers::pi * part.position(0, v) / 100);
        return part;
    };
    EXPECT_EQ(bead(bent(1.5, 2)), "");
    EXPECT_NE(bead(bent(4, 2)).find("off the part"), std::string::npos) << "too high for a bulge";
    EXPECT_EQ(bead(bent(0.4, 1)), "");
    EXPECT_NE(bead(bent(1.5, 1)).find("off the part"), std::string::npos) << "there is no sheet under the line";
}

TEST(Process, FrictionOnACylinderActsOutwardsAlongTheSheetAndKnowsNoHeight)
{
    const shapes::DevelopablePart bent = shapes::quarter_cylinder({.radius = 50, .length = 40, .triangles = 400});
    const TriMesh& part = bent.mesh;
    const Eigen::Vector3d up = area_vectors(part).rowwise().sum().normalized(), axis(0, 1, 0), side = axis.cross(up);
    ProcessConditions process;
    process.contact = {{"binder", all_faces(part), 1.0, {}, 0.1, 2}};
    ExternalForces external = external_forces(process, part, steel, 0.8, flat_plane, Eigen::Vector3d::Zero());
    external.plane << side, axis;
    external.plane.col(1) *= up.dot(side.cross(axis)) > 0 ? 1 : -1;
    const Eigen::Matrix3Xd normal = vertex_normals(part);
    Eigen::Matrix2Xd X = external.plane.transpose() * part.position;
    const double middle = X.row(0).mean();
    for (int v = 0; v < part.vertices();
         ++v) // unrolled: outwards of where the part is seen, on both sides of its middle
        X(0, v) = middle + 1.3 * (X(0, v) - middle);
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    for (const double height : {0., 1000.}) {
        const Eigen::Matrix3Xd position = part.position.colwise() + Eigen::Vector3d(height * up);
        const NodalForces nodal(external, position, normal, part.triangle, area);
        for (int v = 0; v < part.vertices(); ++v) {
            const double off = side.dot(part.position.col(v)) - middle;
            if (std::abs(off) < 5)
                continue;
            const Eigen::Vector3d force = nodal(v, X.col(v)).force;
            Eigen::Vector3d outwards = axis.cross(normal.col(v));
            outwards *= outwards.dot(side) * off > 0 ? 1 : -1;
            EXPECT_GT(force.dot(outwards), 0.99 * force.norm());
            EXPECT_GT(force.norm(), 0);
        }
    }
}

TEST(Process, TheTwoSidesOfASeamAreNoEdgeOfThePart)
{
    const CutPart cut = cut_open(shapes::pipe(20, 20, 60, 24, 10));
    ASSERT_FALSE(cut.seam.empty());
    ProcessConditions process;
    process.edge_restraint = 0.2;
    double sum = 0;
    for (const Restraint& r : forces(process, cut.mesh).restraint) {
        EXPECT_NEAR(std::abs(r.across[2]), 1, 1e-9) << "along the pipe";
        sum += r.force;
    }
    const double around = 2 * 24 * 20 * std::sin(std::numbers::pi / 24); // of one end
    EXPECT_NEAR(sum, 0.2 * lock_force(steel, 0.8) * 2 * around, 1e-6 * sum);
}

TEST(Process, APieceIsHeldAtItsEdgeByItsOwnLockForce)
{
    const TriMesh part = shapes::rectangle(50, 40, 5, 4);
    ProcessConditions process;
    process.edge_restraint = 0.3;
    const double plain = sum_across(forces(process, part)).sum();
    process.tailored = {{"all", all_faces(part), steel, 1.6}};
    EXPECT_NEAR(sum_across(forces(process, part)).sum(), 2 * plain, 1e-9 * plain);
}

TEST(Process, ATailoredPieceHasItsOwnGradeAndGauge)
{
    const TriMesh part = shapes::rectangle(50, 40, 5, 4);
    ProcessConditions process;
    Material strong = steel;
    strong.hardening = Swift{1000, 0.002, 0.15};
    process.tailored = {{"side", {0, 1, 2}, strong, 1.4}, {"patch", {2}, steel, 1.1}};
    const Sheet sheet = sheet_of(steel, 0.8, {}, process, part, flat_plane);
    EXPECT_EQ(sheet.thickness[0], 1.4);
    EXPECT_EQ(sheet.thickness[2], 1.1);
    EXPECT_EQ(sheet.thickness[5], 0.8);
    EXPECT_GT(sheet.law_of(1).curve()(0.1).stress, 1.3 * sheet.law_of(2).curve()(0.1).stress);
    EXPECT_EQ(sheet.law_of(2).curve()(0.1).stress, sheet.law_of(5).curve()(0.1).stress);
}

TEST(Process, WithoutFrictionOrForceNothingActs)
{
    const TriMesh part = shapes::rectangle(50, 40, 5, 4);
    ProcessConditions process;
    process.contact = {{"smooth", {0, 1}, 5.0, {}, 0, 2}};
    process.drawbeads = {{"shallow", {{20, 5, 0}, {20, 35, 0}}, 0}};
    EXPECT_FALSE(forces(process, part).any());
    process.drawbeads[0].line = {{20, 5, 70}, {20, 35, 70}};
    EXPECT_NE(refusal(process, part).find("70 mm off the part"), std::string::npos);
}

TEST(Process, WhatIsWrongIsNamed)
{
    const TriMesh part = shapes::rectangle(50, 40, 5, 4);
    const auto contact = [&](ContactRegion region) {
        ProcessConditions process;
        process.contact = {std::move(region)};
        return refusal(process, part);
    };
    EXPECT_NE(contact({"rim", {}, 1.0, {}, 0.1, 2}).find("\"rim\" has no faces"), std::string::npos);
    EXPECT_NE(contact({"rim", {40}, 1.0, {}, 0.1, 2}).find("names face 40"), std::string::npos);
    EXPECT_NE(contact({"rim", {4}, 1.0, 5.0, 0.1, 2}).find("either a force or a pressure"), std::string::npos);
    TriMesh wall = part; // upright, but for rounding
    wall.position.row(2) = wall.position.row(0);
    wall.position.row(0) *= 1e-16;
    ProcessConditions on_wall;
    on_wall.contact = {{"rim", {4}, {}, 5.0, 0.1, 2}};
    EXPECT_NE(refusal(on_wall, wall).find("a force cannot press there"), std::string::npos);
    wall.position.row(0) = 0.08 * wall.position.row(2); // within five degrees
    EXPECT_NE(refusal(on_wall, wall).find("with 8 % of its area"), std::string::npos) << refusal(on_wall, wall);
    wall.position.row(0) = 0.12 * wall.position.row(2);
    EXPECT_EQ(refusal(on_wall, wall), "");
    EXPECT_NE(contact({"rim", {4}, -1.0, {}, 0.1, 2}).find("must be positive"), std::string::npos);
    EXPECT_NE(contact({"rim", {4}, 1.0, {}, -0.1, 2}).find("friction -0.1"), std::string::npos);
    ProcessConditions process;
    process.drawbeads = {{"b1", {{20, 5, 30}, {20, 35, 30}}, 80}};
    EXPECT_NE(refusal(process, part).find("\"b1\": the place (20, "), std::string::npos);
    // beside it, though nearer than an edge is long
    process.drawbeads = {{"b1", {{50.9, 5, 0}, {50.9, 35, 0}}, 80}};
    EXPECT_NE(refusal(process, part).find("0.9 mm off the part"), std::string::npos) << refusal(process, part);
    process.drawbeads = {{"b1", {{45, 2, 0}, {50, 20, 0}, {55, 40, 0}}, 80}};
    EXPECT_NE(refusal(process, part).find("off the part"), std::string::npos);
    // the worst of its places is named
    process.drawbeads = {{"b1", {{20, 5, 3}, {20, 20, 40}, {20, 35, 4}}, 80}};
    EXPECT_NE(refusal(process, part).find("(20, 20, 40) is 40 mm off"), std::string::npos) << refusal(process, part);
    process.drawbeads = {{"b1", {{20, 5, 0}}, 80}};
    EXPECT_NE(refusal(process, part).find("at least two different points"), std::string::npos);
    process.drawbeads = {{"b1", {{20, 5, 0}, {20, 35, 0}}, -1}};
    EXPECT_NE(refusal(process, part).find("must be positive"), std::string::npos);
    process.drawbeads[0].force_N_mm = 0; // of a shape that does not bend the sheet
    EXPECT_EQ(refusal(process, part), "");
    EXPECT_TRUE(forces(process, part).restraint.empty());
    process = {};
    process.edge_restraint = 1.5;
    EXPECT_NE(refusal(process, part).find("between 0 and 1"), std::string::npos);
    process = {};
    process.rolling = Eigen::Vector3d(0, 0, 1);
    EXPECT_NE(refusal(process, part).find("rolling direction"), std::string::npos);
}

TEST(Process, TheTangentHoldsWithBeadsFrictionAndPins)
{
    TriMesh part = shapes::rectangle(50, 40, 8, 6);
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) = 6 * std::sin(0.08 * part.position(0, v)) * std::cos(0.05 * part.position(1, v));
    ProcessConditions process;
    process.contact = {{"binder", all_faces(part), 2.0, {}, 0.1, 2}};
    process.drawbeads = {{"bead", {{5, 8, 2.2}, {17.5, 20.5, 3.07}, {30, 33, 0}}, 40}};
    process.edge_restraint = 0.2;
    process.pilots = {{"pin", {{10, 20, 2.4}}}};
    const ExternalForces external = forces(process, part);
    ASSERT_FALSE(external.restraint.empty());
    const std::vector<Element> element = elements(part);
    const Sheet sheet = uniform_sheet(MembraneLaw(steel), 0.8, part.triangles());
    VirtualWork work(part, element, sheet, external);
    Eigen::Matrix2Xd X = 1.03 * part.position.topRows<2>();
    X.row(0) += 0.05 * X.row(1);
    work.set_axes(X);
    BlockMatrix matrix(part.triangle, part.vertices());
    work.tangent(X, matrix);
    for (const int unknown : {0, 7, 30, 2 * external.held[0].vertex, 2 * external.held[0].vertex + 1, 101}) {
        Eigen::VectorXd unit = Eigen::VectorXd::Zero(matrix.size()), column;
        unit[unknown] = 1;
        matrix.multiply(unit, column);
        const double step = 1e-6;
        Eigen::Matrix2Xd up = X, down = X;
        up(unknown % 2, unknown / 2) += step;
        down(unknown % 2, unknown / 2) -= step;
        const Eigen::VectorXd difference = (work.residual(up) - work.residual(down)) / (2 * step);
        EXPECT_LT((difference - column).norm(), 1e-5 * column.norm()) << unknown;
    }
}

} // namespace spia::process_test

// The blank lies straight on the sheet, in one step and in several, however the part lay.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_stage.h"
#include "engine/report/json/report_json.h"
#include "engine/unfold/automatic_unfolding.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_file.h"
#include "tests/support/profile.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::straight_blank_test {
namespace {

using std::numbers::pi;

Session solved(const ScratchFolder& folder, const TriMesh& mesh, std::optional<Eigen::Vector3d> rolling = {})
{
    shapes::write_mesh(folder / "part.obj", mesh);
    Session session;
    session.file = folder / "part.obj";
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.flatten.process.rolling = rolling;
    return run_stage(Stage::solve, run_stage(Stage::read, session));
}

Eigen::Vector2d size_of(const Eigen::Matrix2Xd& flat) { return flat.rowwise().maxCoeff() - flat.rowwise().minCoeff(); }

TriMesh channel()
{
    return shapes::extruded(
               shapes::Profile({0, 0}, 0).straight(40).bend(5, pi / 2).straight(25).bend(3, -1.2).straight(12), 30,
               1500)
        .mesh;
}

/// The turn, radians, that lies between two places of the same vertices. [Kabsch 1976 in the plane]
double turn_between(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    const Eigen::Matrix2Xd from = a.colwise() - a.rowwise().mean(), to = b.colwise() - b.rowwise().mean();
    const Eigen::Matrix2d moment = to * from.transpose();
    return std::abs(std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1)));
}

/// What is seen of a solve: each shape in its turn, the result last.
std::vector<Eigen::Matrix2Xd> pictures_of(Session session)
{
    std::vector<Eigen::Matrix2Xd> seen;
    session = run_stage(Stage::solve, run_stage(Stage::read, session), {},
                        [&](const Eigen::Matrix2Xd& X, const NewtonStep&) { seen.push_back(X); });
    seen.push_back(session.blank->blank.position);
    return seen;
}

} // namespace

TEST(StraightBlank, IsSeenStraightFromTheFirstShapeOn)
{
    constexpr double jump = 5 * pi / 180; // what an eye takes for one; shapes themselves turn by
                                          // less from one to the next
    for (const char* part : {"dome", "fender", "inner-panel", "lipped-channel", "perforated-channel", "square-cup"}) {
        Session session;
        session.file = std::string(SPIA_SOURCE_DIR "/assets/parts/") + part + ".obj";
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        const auto seen = pictures_of(session);
        ASSERT_GT(seen.size(), 3u) << part;
        // A nearly symmetric result may lie another way round.
        const std::string name = part;
        const bool symmetric = name == "dome" || name == "lipped-channel" || name == "square-cup";
        for (size_t k = 1; k + (symmetric ? 1 : 0) < seen.size(); ++k)
            EXPECT_LT(turn_between(seen[k - 1], seen[k]), jump) << part << ", shape " << k << " of " << seen.size();
        for (const Eigen::Matrix2Xd& each : seen)
            EXPECT_NEAR(each.minCoeff(), 0, 1e-9) << part << ": it begins at the corner of the sheet";
    }
}

TEST(StraightBlank, IsSeenStraightHoweverThePartLies)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const ScratchFolder folder;
    for (int trial = 0; trial < 5; ++trial) {
        TriMesh part = channel();
        const Eigen::Quaterniond any(normal(random), normal(random), normal(random), normal(random));
        part.position = any.normalized().toRotationMatrix() * part.position;
        shapes::write_mesh(folder / "part.obj", part);
        Session session;
        session.file = folder / "part.obj";
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        const auto seen = pictures_of(session);
        for (const Eigen::Matrix2Xd& each : seen)
            EXPECT_LT(std::min(turn_between(each, seen.back()), pi - turn_between(each, seen.back())), 0.01)
                << trial << ": a half turn of this rectangle is none that is seen";
    }
}

TEST(StraightBlank, InOneStepAsInSeveralHoweverThePartLies)
{
    const double wanted = 40 + 5 * pi / 2 + 25 + 3 * 1.2 + 12; // the developed length
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const ScratchFolder folder;
    for (int trial = 0; trial < 6; ++trial) {
        TriMesh part = channel();
        if (trial > 0) {
            const Eigen::Quaterniond any(normal(random), normal(random), normal(random), normal(random));
            part.position =
                (any.normalized().toRotationMatrix() * part.position).colwise() + Eigen::Vector3d(10, 20, 5);
        }
        const Session session = solved(folder, part);
        const Eigen::Vector2d size = size_of(session.blank->blank.position);
        EXPECT_NEAR(size[0], wanted, 2e-3 * wanted) << "chords for arcs";
        EXPECT_NEAR(size[1], 30, 1e-3);
        EXPECT_NEAR(session.blank->blank.position.minCoeff(), 0, 1e-12);
        const auto box = nlohmann::json::parse(report_json(session, {}, 0))["blank"]["bounding_box_mm"];
        EXPECT_NEAR(box[2].get<double>(), size[0], 1e-9);
        const TriMesh& read = session.part->mesh;
        const UnfoldRun run = automatic_unfolding(read, find_bends(read), {}, session.options.flatten).run;
        ASSERT_TRUE(run.blank) << run.failure;
        EXPECT_NEAR(size_of(run.blank->position)[0], size[0], 1e-4 * size[0]);
        EXPECT_NEAR(size_of(run.blank->position)[1], size[1], 1e-4 * size[0]);
    }
}

TEST(StraightBlank, TheRollingDirectionLiesAlongXAndTheStrainsStay)
{
    const ScratchFolder folder;
    const Eigen::Vector3d rolling(std::cos(0.4), std::sin(0.4), 0);
    TriMesh part =
        // in the plane of x and y, or x and z
        shapes::extruded(shapes::Profile({0, 0}, 0).straight(60), 40, 300).mesh;
    const Eigen::Matrix3Xd arm = part.position.colwise() - part.position.rowwise().mean();
    Eigen::Index thin;
    arm.cwiseAbs().rowwise().maxCoeff().minCoeff(&thin);
    if (thin != 2) // into the plane of x and y
        part.position =
            Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::Unit(thin == 1 ? 0 : 1)).toRotationMatrix() * part.position;
    const Session session = solved(folder, part, rolling);
    const Eigen::Matrix2Xd& flat = session.blank->blank.position;
    // Of every edge the angle to the rolling direction on the part is that to x in the blank, up to
    // a half turn of all.
    const TriMesh& read = session.part->mesh;
    const double side = session.blank->stamping.direction[2];
    for (int f = 0; f < read.triangles(); ++f) {
        const Eigen::Vector3d edge = read.position.col(read.triangle(1, f)) - read.position.col(read.triangle(0, f));
        const Eigen::Vector2d laid = flat.col(read.triangle(1, f)) - flat.col(read.triangle(0, f));
        EXPECT_NEAR(std::abs(laid[0]), std::abs(edge.dot(rolling)), 1e-6);
        EXPECT_NEAR(laid[0] * laid[1], side * edge.dot(rolling) * rolling.cross(edge)[2], 1e-4);
    }
    EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), 1e-6);
}

} // namespace spia::straight_blank_test

#include "engine/unfold/step/polish.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "engine/core/error.h"
#include "engine/forming/flatten_from.h"
#include "engine/forming/material/material_library.h"
#include "tests/support/bent_parts.h"
#include "tests/support/revolved.h"

namespace spia::polish_test {
namespace {

FlattenOptions steel()
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return options;
}

UnfoldRun automatic(const TriMesh& part)
{
    return run_unfolding(part, propose_sequence(part, find_bends(part)).steps, steel());
}

/// Greatest difference of an edge's length in two flat places.
double apart(const TriMesh& part, const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    double most = 0;
    for (const auto& t : part.triangle.colwise())
        for (int k = 0; k < 3; ++k) {
            const int i = t[k], j = t[(k + 1) % 3];
            most = std::max(most, std::abs((a.col(i) - a.col(j)).norm() - (b.col(i) - b.col(j)).norm()));
        }
    return most;
}

} // namespace

TEST(FlattenFrom, FindsTheBlankFromAStartThatIsShearedTurnedAndFarAway)
{
    const shapes::DevelopablePart part = shapes::lipped_channel({.triangles = 1000});
    Eigen::Matrix2d shear;
    shear << 1.1, 0.3, 0, 0.8;
    const Eigen::Matrix2Xd start =
        (Eigen::Rotation2Dd(2).toRotationMatrix() * shear * part.flat).colwise() + Eigen::Vector2d(1e4, -3e3);
    const FlattenResult result = flatten_from(part.mesh, start, steel());
    EXPECT_TRUE(result.report.whole()) << result.report.reason;
    EXPECT_LT(apart(part.mesh, result.blank.position, part.flat), 1e-7);
    EXPECT_LT(result.face.strain_equivalent.maxCoeff(), 1e-8);
}

TEST(FlattenFrom, EndsWhereFlattenDoesOnADrawnPart)
{
    const TriMesh part = shapes::round_cup({.triangles = 1500});
    const FlattenResult whole = flatten(part, steel());
    const FlattenResult again = flatten_from(part, 1.2 * whole.blank.position, steel());
    EXPECT_TRUE(again.report.whole()) << again.report.reason;
    EXPECT_LT(apart(part, again.blank.position, whole.blank.position), 1e-6);
}

TEST(FlattenFrom, RefusesAStartThatNoSolverCanMend)
{
    const shapes::DevelopablePart part = shapes::bent_flange({.triangles = 300});
    Eigen::Matrix2Xd mirrored = part.flat;
    mirrored.row(0) *= -1;
    try {
        flatten_from(part.mesh, mirrored, steel());
        FAIL() << "a mirrored start was taken";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("face 0 is flipped"), std::string::npos) << error.what();
    }
    EXPECT_THROW(flatten_from(part.mesh, part.flat.leftCols(part.flat.cols() - 1), steel()), InputError);
}

TEST(Polish, ADevelopablePartKeepsItsBlank)
{
    const shapes::DevelopablePart part = shapes::hemmed_flange({.triangles = 1500});
    const PolishedBlank polished = polish(part.mesh, automatic(part.mesh), steel());
    EXPECT_LT(polished.outline_distance_mm, 1e-7);
    EXPECT_TRUE(polished.worse.empty()) << polished.worse.front();
    EXPECT_TRUE(polished.steps.converged);
    EXPECT_TRUE(polished.polished.converged);
    EXPECT_LT(polished.polished.distortion.angular_rms, 1e-9);
}

TEST(Polish, TellsHowFarTheOutlinesAreApart)
{
    const shapes::DevelopablePart part = shapes::bent_flange({.length = 40, .triangles = 600});
    UnfoldRun run = automatic(part.mesh);
    const double length = part.flat.row(0).maxCoeff() - part.flat.row(0).minCoeff();
    run.blank->position = part.flat;
    run.blank->position.row(0) *= 1.02; // both ends stand out by one percent of the length
    const PolishedBlank polished = polish(part.mesh, run, steel());
    EXPECT_NEAR(polished.outline_distance_mm, 0.01 * length, 1e-3 * length * 0.01);
    EXPECT_LT(polished.outline_distance_mean_mm, polished.outline_distance_mm);
    EXPECT_GT(polished.outline_distance_mean_mm, 0);
    EXPECT_EQ(run.blank->position.row(0), 1.02 * part.flat.row(0)); // that of the steps is kept
    EXPECT_GT(polished.steps.distortion.angular_rms, 1e-3);
    EXPECT_LT(polished.polished.distortion.angular_rms, 1e-9);
}

TEST(Polish, TheOutlineDistancesAreThoseOfEveryVertexFromEveryEdge)
{
    const TriMesh part = shapes::round_cup({.triangles = 1500});
    UnfoldRun run = automatic(part);
    const Eigen::Matrix2Xd middle = run.blank->position.rowwise().mean().replicate(1, part.vertices());
    Eigen::Matrix2Xd& before = run.blank->position;
    for (int v = 0; v < part.vertices(); ++v) // one side stands out
        before(0, v) += 0.1 * std::max(0.0, before(0, v) - middle(0, v));
    const PolishedBlank polished = polish(part, run, steel());
    const Eigen::Matrix2Xd& after = polished.whole.blank.position;
    std::vector<std::pair<int, int>> rim; // edges of one face
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = part.triangle(k, f), b = part.triangle((k + 1) % 3, f);
            int faces = 0;
            for (const auto& t : part.triangle.colwise())
                faces += (t.array() == a).any() && (t.array() == b).any();
            if (faces == 1)
                rim.emplace_back(a, b);
        }
    const auto off = [&](const Eigen::Vector2d& p, const Eigen::Matrix2Xd& X) {
        double least = 1e9;
        for (const auto& [a, b] : rim) {
            const double length = (X.col(b) - X.col(a)).norm(),
                         along = (p - X.col(a)).dot(X.col(b) - X.col(a)) / length;
            const Eigen::Vector2d foot =
                X.col(a) + std::min(length, std::max(0.0, along)) / length * (X.col(b) - X.col(a));
            least = std::min(least, (p - foot).norm());
        }
        return least;
    };
    double most_before = 0, most_after = 0, sum = 0;
    for (const auto& [v, next] : rim) {
        most_before = std::max(most_before, off(before.col(v), after));
        most_after = std::max(most_after, off(after.col(v), before));
        sum += off(before.col(v), after) + off(after.col(v), before);
    }
    EXPECT_GT(std::abs(most_before - most_after), 1e-6) << "else either way would do";
    EXPECT_NEAR(polished.outline_distance_mm, std::max(most_before, most_after), 1e-9);
    EXPECT_NEAR(polished.outline_distance_mean_mm, sum / (2 * double(rim.size())), 1e-9);
}

TEST(Polish, SaysInWhatItIsWorse)
{
    const TriMesh part = shapes::round_cup({.triangles = 1500});
    const UnfoldRun run = automatic(part);
    ASSERT_TRUE(run.states.back().converged);
    FlattenOptions hasty = steel();
    hasty.most_newton_steps = 1;
    hasty.most_energy_steps = 1;
    UnfoldRun distorted = run;
    distorted.blank->position.row(0) *= 1.3;
    const PolishedBlank polished = polish(part, distorted, hasty);
    ASSERT_FALSE(polished.worse.empty());
    EXPECT_EQ(polished.worse.front(), "it did not converge");
    EXPECT_TRUE(polish(part, run, steel()).polished.converged);
}

TEST(Polish, NeedsABlankWithoutFlips)
{
    const shapes::DevelopablePart part = shapes::bent_flange({.triangles = 300});
    UnfoldRun run = automatic(part.mesh);
    run.flipped = 2;
    EXPECT_THROW(polish(part.mesh, run, steel()), InputError);
    run.blank.reset();
    EXPECT_THROW(polish(part.mesh, run, steel()), InputError);
}

} // namespace spia::polish_test

// Rings of sheet that go all the way around a cylinder or a cone.
#include "engine/unfold/step/ring_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/cut/cut.h"
#include "engine/unfold/step/unfold_script.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"

namespace spia::ring_chart_test {
namespace {

using std::numbers::pi;

FlattenOptions steel(double r = 1.77)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.8;
    return options;
}

double furthest(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).colwise().norm().maxCoeff(); }

/// A tube, or with `taper` a cone, whose upper end leans outwards, all around in even cells.
struct FlaredTube {
    static constexpr int around = 48, half = 8; // cells; rows of the tube and of its end
    double radius = 40, taper = 0, lean = 60 * pi / 180, end = 15, turned = 0;
    bool inside = false; ///< the inner side is the outer one

    Eigen::Vector2d profile(double row) const
    {
        const double below = (std::min(row, double(half)) - half) * 3, above = std::max(row - half, 0.) * end / half;
        return Eigen::Vector2d(radius, 0) + below * Eigen::Vector2d(std::sin(taper), std::cos(taper)) +
               above * Eigen::Vector2d(std::sin(lean), std::cos(lean));
    }
    TriMesh mesh() const
    {
        TriMesh part = shapes::grid_surface({around, 2 * half, true, false}, [&](double u, double v) {
            const Eigen::Vector2d at = profile(2 * half * v);
            const double a = 2 * pi * u + turned;
            return Eigen::Vector3d(at[0] * std::cos(a), at[0] * std::sin(a), at[1]);
        });
        if (inside)
            part.triangle.row(1).swap(part.triangle.row(2));
        return part;
    }
    static UnfoldPick pick(int faces)
    {
        UnfoldPick out;
        for (int f = 0; f < faces; ++f)
            (f < faces / 2 ? out.fixed : out.freed).push_back(f);
        return out;
    }
};

UnfoldStepResult laid(const TriMesh& part, const FlattenOptions& options = steel())
{
    return unfold_step(part, part.position, FlaredTube::pick(part.triangles()), options);
}

/// The freed ring of such a tube.
struct Hinge {
    TriMesh part;
    FreedPiece piece;
    explicit Hinge(const FlaredTube& tube) : part(tube.mesh())
    {
        const UnfoldPick pick = FlaredTube::pick(part.triangles());
        piece = freed_pieces(part, pick.fixed, pick.freed).at(0);
    }
};

} // namespace

TEST(RingChart, IsAPictureOfTheFaceWithoutACutAndConformal)
{
    for (const bool inside : {false, true})
        for (const bool below : {false, true}) // of the hinge
            for (const double half_angle : {0., 0.5}) {
                Hinge ring({.inside = inside});
                if (below) {
                    const UnfoldPick pick = FlaredTube::pick(ring.part.triangles());
                    ring.piece = freed_pieces(ring.part, pick.freed, pick.fixed).at(0);
                }
                TargetSurface face = CylinderFace{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 40, !inside};
                if (half_angle > 0)
                    face = ConeFace{{0, 0, -40 / std::tan(half_angle)}, {0, 0, 1}, {1, 0, 0}, half_angle, !inside};
                const auto chart =
                    RingChart::around(face, ring.piece, ring.part.position(Eigen::all, ring.piece.vertex));
                ASSERT_TRUE(chart);
                for (const double angle : {0.3, 2.9, 3.3, 6.0}) {
                    const double up = below ? -7 : 7;
                    const auto on_face = [&](double turn, double z) {
                        const double r = 40 + z * std::tan(half_angle);
                        return Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z);
                    };
                    const Eigen::Vector3d x = on_face(angle, up);
                    const Eigen::Vector2d at = chart->place(x);
                    EXPECT_GT(at.norm(), 41) << "outside of the hinge";
                    EXPECT_NEAR(chart->place(on_face(angle, 0)).norm(), 40, 1e-9);
                    EXPECT_LT((chart->point(at) - x).norm(), 1e-9);
                    // A small triangle, counter-clockwise seen from the outer side.
                    Eigen::Matrix3d corner;
                    corner << x, on_face(angle + 1e-4, up), on_face(angle, up + 4e-3);
                    if (inside)
                        corner.col(1).swap(corner.col(2));
                    Eigen::Matrix<double, 2, 3> seen;
                    for (int k = 0; k < 3; ++k)
                        seen.col(k) = chart->place(corner.col(k));
                    const Eigen::Vector2d p = seen.col(1) - seen.col(0), q = seen.col(2) - seen.col(0);
                    EXPECT_GT(p[0] * q[1] - p[1] * q[0], 0);
                    const Eigen::Matrix2d M = chart->lengths(seen);
                    EXPECT_LT((M - M(0, 0) * Eigen::Matrix2d::Identity()).norm(), 1e-3 * M(0, 0)) << "conformal";
                    EXPECT_NEAR((M * p).norm(), (corner.col(1) - corner.col(0)).norm(), 1e-7);
                    EXPECT_NEAR((M * q).norm(), (corner.col(2) - corner.col(0)).norm(), 1e-7);
                    // A large one across the cut of angles keeps the lengths of its development.
                    Eigen::Matrix<double, 2, 3> large;
                    large << at, chart->place(on_face(angle + 0.5, up)), chart->place(on_face(angle + 0.2, up + 9));
                    if (inside)
                        large.col(1).swap(large.col(2));
                    const Eigen::Matrix<double, 2, 3> flat = chart->developed(large);
                    const Eigen::Matrix2d L = chart->lengths(large);
                    for (int k = 0; k < 3; ++k) {
                        const Eigen::Vector2d way = large.col((k + 1) % 3) - large.col(k),
                                              true_way = flat.col((k + 1) % 3) - flat.col(k);
                        EXPECT_NEAR((L * way).norm(), true_way.norm(), 1e-9);
                    }
                    const double chord = half_angle > 0 ? 2 * (40 + up * std::tan(half_angle)) / std::sin(half_angle) *
                                                              std::sin(0.25 * std::sin(half_angle))
                                                        : 40 * 0.5;
                    EXPECT_NEAR((flat.col(inside ? 2 : 1) - flat.col(0)).norm(), chord, 1e-9);
                }
            }
}

TEST(RingChart, AFlaredEndIsLaidOnItsTubeWhereverAnglesAreCutAndTheMeshBegins)
{
    for (const double taper : {0., 0.3, -0.3}) {
        FlaredTube tube{.taper = taper};
        const TriMesh part = tube.mesh();
        const UnfoldStepResult result = laid(part);
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        EXPECT_EQ(name(result.target.face), taper == 0 ? "cylinder" : "cone");
        // On the face, with the hinge where it was.
        for (int v = 0; v < part.vertices(); ++v) {
            const Eigen::Vector3d x = result.position.col(v);
            EXPECT_NEAR(x.head<2>().norm(), 40 + x[2] * std::tan(taper), 1e-6);
        }
        PlannedStep step;
        step.pick = FlaredTube::pick(part.triangles());
        const UnfoldRun run = run_unfolding(part, {step}, steel());
        ASSERT_EQ(run.states.size(), 1u) << run.failure;
        EXPECT_EQ(run.states[0].overlap.places, 0);
        // The same ring after a turn about its axis by some cells and a part of one.
        for (const double cells : {5., 17.4, 31.}) {
            FlaredTube other = tube;
            other.turned = cells * 2 * pi / FlaredTube::around;
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(other.turned, Eigen::Vector3d::UnitZ()).toRotationMatrix();
            EXPECT_LT(furthest(laid(other.mesh()).position, turn * result.position), 1e-6) << cells;
        }
        // And with the inner side as the outer one, and with other numbers.
        FlaredTube other = tube;
        other.inside = true;
        EXPECT_LT(furthest(laid(other.mesh()).position, result.position), 1e-6);
        const shapes::Permuted mixed = shapes::permuted(part, 3);
        UnfoldPick pick = FlaredTube::pick(part.triangles());
        for (std::vector<int>* faces : {&pick.fixed, &pick.freed})
            for (int& f : *faces)
                f = mixed.face[size_t(f)];
        const UnfoldStepResult same = unfold_step(mixed.mesh, mixed.mesh.position, pick, steel());
        for (int v = 0; v < part.vertices(); ++v)
            EXPECT_LT((same.position.col(mixed.vertex[size_t(v)]) - result.position.col(v)).norm(), 1e-6);
    }
}

TEST(RingChart, WhatIsOnTheTubeAlreadyStaysThere)
{
    // Long and short; the chords of the mesh become arcs, whose strain is of second order in them.
    for (const double end : {10., 120.}) {
        FlaredTube tube{.lean = 0, .end = end};
        const TriMesh part = tube.mesh();
        const UnfoldStepResult result = laid(part);
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        const double chord = std::pow(2 * pi / FlaredTube::around, 2) / 24;
        EXPECT_LT(result.face.strain_equivalent.maxCoeff(), 1.2 * chord) << end;
        EXPECT_LT(furthest(result.position, part.position), chord * end) << end;
    }
}

TEST(RingChart, ARingThatIsHeldOnBothSidesLiesBetweenThem)
{
    // A bead around a tube is laid back on it.
    const int n = 48, rows = 24;
    const TriMesh part = shapes::grid_surface({n, rows, true, false}, [&](double u, double v) {
        const double z = 60 * v, a = 2 * pi * u, r = 40 + (z > 20 && z < 40 ? 2 * std::sin((z - 20) / 20 * pi) : 0.);
        return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), z);
    });
    UnfoldPick pick;
    for (int f = 0; f < part.triangles(); ++f) {
        const double z = part.position.row(2)(part.triangle.col(f)).mean();
        (z > 20 && z < 40 ? pick.freed : pick.fixed).push_back(f);
    }
    const UnfoldStepResult result = unfold_step(part, part.position, pick, steel());
    ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
    for (int v = 0; v < part.vertices(); ++v)
        EXPECT_NEAR(result.position.col(v).head<2>().norm(), 40, 1e-6);
    for (int k = 0; k < n; ++k)
        EXPECT_NEAR(result.position(2, 12 * n + k), 30, 0.02) << "the middle row stays";
}

TEST(RingChart, ATubeThatIsCutOpenIsLaidOnItsDevelopmentAndUnrolled)
{
    // Cut along a seam it ends in an open strip; of small strain its blank is about that of the
    // closed ring, laid open.
    FlaredTube tube{.lean = 0.35, .end = 12};
    const TriMesh closed = tube.mesh();
    std::vector<std::array<int, 2>> seam;
    for (int row = 0; row < 2 * FlaredTube::half; ++row)
        seam.push_back({row * FlaredTube::around, (row + 1) * FlaredTube::around});
    const CutPart cut = cut_along(closed, seam);
    ASSERT_TRUE(surface_type(cut.mesh).sheet());
    ASSERT_EQ(surface_type(cut.mesh).loops, 1);
    for (const double taper : {0., 0.3, 0.8}) { // of the last the development is most of a turn
                                                // wide
        tube.taper = taper;
        TriMesh open = cut.mesh;
        open.position = tube.mesh().position(Eigen::all, cut.source);
        const UnfoldStepResult ring = laid(tube.mesh()), strip = laid(open);
        ASSERT_TRUE(strip.converged());
        double height = 0, width = 0;
        for (int v = 0; v < open.vertices(); ++v) {
            const Eigen::Vector3d x = strip.position.col(v), y = ring.position.col(cut.source[size_t(v)]);
            EXPECT_NEAR(x.head<2>().norm(), 40 + x[2] * std::tan(taper), 1e-6);
            height = std::max(height, std::abs(x[2] - y[2]));
            width = std::max(width, (x - y).norm());
        }
        EXPECT_LT(height, 1.5) << taper; // mm: a free edge bends away
        EXPECT_GT(width, 0.05) << "the cut opens or overlaps";
        EXPECT_LT(width, 8) << taper;
    }
    // Steep and unrolled.
    tube = {.lean = 1};
    TriMesh open = cut.mesh;
    open.position = tube.mesh().position(Eigen::all, cut.source);
    PlannedStep lay, unroll;
    lay.pick = FlaredTube::pick(open.triangles());
    unroll.kind = UnfoldKind::unroll;
    unroll.pick.carrying = lay.pick.fixed;
    const UnfoldRun run = run_unfolding(open, {lay, unroll}, steel());
    ASSERT_EQ(run.failure, "");
    for (const UnfoldState& state : run.states)
        EXPECT_TRUE(state.converged) << state.reason;
    ASSERT_TRUE(run.blank);
    EXPECT_EQ(run.flipped, 0);
    const Eigen::Matrix2Xd& blank = run.blank->position; // the tube's own end is straight, as long
                                                         // as it is around
    const auto opposite = std::find(cut.source.begin(), cut.source.end(), FlaredTube::around / 2);
    const auto way = [&](int v) { return (blank.col(0) - blank.col(v)).norm(); };
    ASSERT_EQ(cut.source[1], 0) << "the copy across the seam";
    EXPECT_NEAR(way(1), 2 * pi * 40, 1e-6);
    EXPECT_NEAR(way(int(opposite - cut.source.begin())), pi * 40, 1e-6);
    EXPECT_NEAR(blank.row(1).maxCoeff() - blank.row(1).minCoeff(), 24 + 15, 3);
}

TEST(RingChart, FrictionAndTheRollingDirectionAreRefusedOnARing)
{
    const TriMesh part = FlaredTube{}.mesh();
    UnfoldPick pick = FlaredTube::pick(part.triangles());
    FlattenOptions options = steel();
    options.process.rolling = Eigen::Vector3d(1, 0, 0);
    const auto refusal = [&] {
        try {
            unfold_step(part, part.position, pick, options);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_NE(refusal().find("rolling direction"), std::string::npos) << refusal();
    options.process.rolling.reset();
    EXPECT_EQ(refusal(), "none");
    pick.friction = ContactRegion{"die", {}, 1, {}, 0.1, 2};
    EXPECT_NE(refusal().find("its friction cannot be determined"), std::string::npos) << refusal();
}

} // namespace spia::ring_chart_test

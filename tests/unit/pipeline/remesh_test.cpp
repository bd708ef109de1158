#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/part/vertex_numbers.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_file.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::remesh_test {
namespace {

constexpr double degrees = std::numbers::pi / 180;

std::filesystem::path cad_file(const char* name)
{
    return std::filesystem::path(SPIA_SOURCE_DIR) / "../shared/data/cad" / name;
}

Session solved(const std::filesystem::path& file, bool remeshed, Stage last = Stage::solve)
{
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    if (remeshed)
        session.options.read.remesh.emplace();
    else
        session.options.read.cad.keep_triangles = true;
    for (const Stage stage : chain) {
        session = run_stage(stage, session);
        if (stage == last)
            break;
    }
    return session;
}

double blank_area(const Session& session)
{
    TriMesh flat{Eigen::Matrix3Xd::Zero(3, session.part->mesh.vertices()), session.part->mesh.triangle};
    flat.position.topRows(2) = session.blank->blank.position;
    return area(flat);
}

/// Length and width of the blank, turned to where its width is least: 90 directions and then a
/// finer search.
Eigen::Vector2d extents(const Session& session)
{
    const Eigen::Matrix2Xd& p = session.blank->blank.position;
    const auto extent = [&](double turn) {
        const Eigen::RowVectorXd along = Eigen::RowVector2d(std::cos(turn), std::sin(turn)) * p;
        return along.maxCoeff() - along.minCoeff();
    };
    double best = 0, step = 2 * degrees;
    for (double turn = 0; turn < std::numbers::pi; turn += step)
        if (extent(turn) < extent(best))
            best = turn;
    for (; step > 1e-7; step /= 2)
        for (const double turn : {best - step, best + step})
            if (extent(turn) < extent(best))
                best = turn;
    return {extent(best), extent(best + std::numbers::pi / 2)};
}

class RemeshedCad : public testing::TestWithParam<const char*> {};

TEST_P(RemeshedCad, FlattensToTheSameBlankWithGoodTriangles)
{
    const auto file = cad_file(GetParam());
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is not there";
    const Session given = solved(file, false), remeshed = solved(file, true);
    const Remeshed& how = *remeshed.part->remeshed;
    EXPECT_LT(how.before.least_angle, 1 * degrees);
    EXPECT_GT(how.after.least_angle_of_99, 30 * degrees);
    EXPECT_LE(how.distance, how.tolerance);
    EXPECT_TRUE(remeshed.blank->report.converged);
    EXPECT_NEAR(blank_area(remeshed), blank_area(given), 0.005 * blank_area(given));
    fmt::print("{}: {} -> {} triangles, blank {:.6g} -> {:.6g} mm2\n", GetParam(), how.before.triangles,
               how.after.triangles, blank_area(given), blank_area(remeshed));
    for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(extents(remeshed)[k], extents(given)[k], 4 * how.tolerance) << k;
}
INSTANTIATE_TEST_SUITE_P(Files, RemeshedCad, testing::Values("fan_bracket_skin.step", "drawn_cone_skin.step"),
                         [](const auto& file) { return std::string(file.param).substr(0, 3); });

/// Bends in strips along their generators are developable exactly, and so they are with other
/// triangles.
TEST(RemeshedPart, ADevelopableInStripsCostsNoStrain)
{
    const auto file = std::filesystem::temp_directory_path() / "spia_remesh_strips.obj";
    const shapes::DevelopablePart part = shapes::lipped_channel({.triangles = 4000});
    shapes::write_mesh(file, part.mesh);
    const Session session = solved(file, true);
    std::filesystem::remove(file);
    TriMesh flat{Eigen::Matrix3Xd::Zero(3, part.mesh.vertices()), part.mesh.triangle};
    flat.position.topRows(2) = part.flat;
    EXPECT_NE(session.part->mesh.position, part.mesh.position);
    EXPECT_NEAR(blank_area(session), area(flat), 1e-5 * area(flat)); // the file has six decimals
    EXPECT_LT(session.blank->face.thinning.cwiseAbs().maxCoeff(), 1e-4);
    const Eigen::Vector2d size = extents(session);
    EXPECT_NEAR(size.minCoeff(), 200, 1e-3);
}

/// Bends whose edges cross the generators are folded a little by any other triangles: by what their
/// own chords cost.
TEST(RemeshedPart, ADevelopableAcrossItsGeneratorsIsShortByTheChords)
{
    const auto file = std::filesystem::temp_directory_path() / "spia_remesh_channel.obj";
    for (const int triangles : {4000, 16000}) {
        const shapes::DevelopablePart part = shapes::perforated_channel({.channel = {.triangles = triangles}});
        shapes::write_mesh(file, part.mesh);
        const Session session = solved(file, true);
        TriMesh flat{Eigen::Matrix3Xd::Zero(3, part.mesh.vertices()), part.mesh.triangle};
        flat.position.topRows(2) = part.flat;
        const auto& thinning = session.blank->face.thinning;
        fmt::print(
            "{} -> {} triangles, tolerance {:.3g}: blank {:.8g} of {:.8g} mm2, thinning {:.2e} to {:.2e}, {:.2f} s + {:.2f} s\n",
            triangles, session.part->mesh.triangles(), session.part->remeshed->tolerance, blank_area(session),
            area(flat), thinning.minCoeff(), thinning.maxCoeff(), session.part->remeshed->seconds,
            session.seconds.at(Stage::solve));
        // what the given triangles are short of
        const double chords = std::abs(area(part.mesh) - area(flat));
        fmt::print("the given triangles {:.8g} mm2: short by {:.3g} mm2, the remeshed blank by {:.3g}\n",
                   area(part.mesh), chords, area(flat) - blank_area(session));
        EXPECT_NEAR(blank_area(session), area(flat), 2.5 * chords);
    }
    std::filesystem::remove(file);
}

TEST(RemeshedPart, IsJudgedAgainstTheTrianglesThatWereGiven)
{
    const auto file = std::filesystem::path(SPIA_SOURCE_DIR) / "assets/parts/dome.obj";
    const Session session = solved(file, true, Stage::fit);
    const PartFile& part = *session.part;
    ASSERT_TRUE(part.remeshed);
    const PartFile given = read_part(file);
    EXPECT_EQ(part.remeshed->original->position, given.mesh.position);
    EXPECT_EQ(part.remeshed->original->triangle, given.mesh.triangle);
    // one sample per vertex, edge and face of the part that was given
    const int edges = given.mesh.vertices() + given.mesh.triangles() - 1;
    EXPECT_EQ(session.surface->deviation.mesh_to_surface.samples,
              given.mesh.vertices() + edges + given.mesh.triangles());
    EXPECT_EQ(session.surface->deviation.at_vertex.size(), session.grid->result.filled->mesh.vertices());
}

TEST(RemeshedPart, SliversThatAreGoneAreNotSpokenOf)
{
    const ScratchFolder scratch;
    put(scratch / "a.obj", "v 0 0 0\nv 50 0 0\nv 100 0 0\nv 100 60 20\nv 0 60 0\nv 50 0.1 0\n"
                           "f 1 2 6\nf 2 3 6\nf 3 4 6\nf 4 5 6\nf 5 1 6\n");
    const auto slivers = [&](const ReadOptions& options) {
        const PartFile part = read_part(scratch / "a.obj", options);
        return std::count_if(part.doctor.findings.begin(), part.doctor.findings.end(),
                             [](const Finding& finding) { return finding.fault == Fault::sliver; });
    };
    ReadOptions remeshed;
    remeshed.remesh.emplace();
    EXPECT_EQ(slivers({}), 1);
    EXPECT_EQ(slivers(remeshed), 0);
    put(scratch / "a.obj", "v 0 0 0\nv 50 0 0\nv 100 0 0\nv 100 60 0\nv 0 60 0\nv 50 0.1 0\n"
                           "f 1 2 6\nf 2 3 6\nf 3 4 6\nf 4 5 6\nf 5 1 6\n");
    EXPECT_EQ(slivers({}), 0) << "it unrolls: they do not affect the strains";
}

TEST(RemeshedPart, NumbersAreThoseOfTheFile)
{
    const auto file = std::filesystem::path(SPIA_SOURCE_DIR) / "assets/parts/dome.obj";
    ReadOptions options;
    options.remesh.emplace().size = 9;
    const PartFile part = read_part(file, options), given = read_part(file);
    const ClosestPointSearch search(given.mesh);
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const Eigen::Vector3d middle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f)).rowwise().mean();
        const auto nearest = search.nearest(middle);
        const auto called = part.source_face[size_t(f)];
        const Eigen::Matrix3d t = given.mesh.position(Eigen::all, given.mesh.triangle.col(called));
        EXPECT_NEAR((t * closest_on_triangle(t, middle) - middle).norm(), nearest.distance, 1e-9);
    }
    for (const int number : {0, 7, given.file_vertices - 1}) {
        const std::vector<int> vertices = vertices_called(part, number);
        ASSERT_EQ(vertices.size(), 1U) << number;
        EXPECT_LT((part.mesh.position.col(vertices[0]) - given.mesh.position.col(number)).norm(), 9);
    }
    EXPECT_TRUE(vertices_called(part, -1).empty());
    for (int v = 0; v < part.mesh.vertices(); v += 17)
        EXPECT_EQ(vertices_called(part, number_of(part, v)), std::vector<int>{v});
    EXPECT_TRUE(vertices_called(part, given.file_vertices + part.mesh.vertices()).empty());
    EXPECT_EQ(number_of(given, 7), 7);
}

/// A tube that is cut open has both banks of the cut for corners, as it has without remeshing.
TEST(RemeshedPart, ANumberOnASeamIsAVertexOnEachBank)
{
    const ScratchFolder scratch;
    const auto file = scratch / "tube.obj";
    constexpr int around = 32, along = 10;
    std::ofstream text(file);
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            text << "v " << 30 * std::cos(angle) << ' ' << 30 * std::sin(angle) << ' ' << 8 * j << '\n';
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i)
            text << "f " << j * around + i + 1 << ' ' << j * around + (i + 1) % around + 1 << ' '
                 << (j + 1) * around + (i + 1) % around + 1 << ' ' << (j + 1) * around + i + 1 << '\n';
    text.close();
    for (const double size : {2.5, 5., 11.}) {
        Session session;
        session.file = file;
        session.options.read.seam.mode = SeamOptions::Mode::given;
        session.options.read.seam.path = {{0, around * along}};
        session.options.read.remesh.emplace().size = size;
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session.options.corners = {0, 0, around * along, around * along};
        session = run_stage(Stage::read, session);
        const PartFile& part = *session.part;
        EXPECT_EQ(boundary_loops(part.mesh).size(), 1U);
        for (const int number : {0, 5 * around, around * along}) {
            const std::vector<int> banks = vertices_called(part, number);
            ASSERT_EQ(banks.size(), 2U) << number << " at size " << size;
            const Eigen::Vector3d between = part.mesh.position.col(banks[1]) - part.mesh.position.col(banks[0]);
            EXPECT_LT(between.norm(), 12) << "both lie at the place of the vertex";
        }
        for (const Stage stage : {Stage::solve, Stage::grid})
            session = run_stage(stage, session);
        const std::array<int, 4> corner = session.grid->boundary.corner;
        for (size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(part.mesh.position(2, corner[k]), k < 2 ? 0 : 80, 1e-9) << k;
    }
}

} // namespace
} // namespace spia::remesh_test

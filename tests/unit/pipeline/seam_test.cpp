// Parts that have to be cut open, through the whole chain.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/files/seam_file.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/json/report_json.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::seam_test {
namespace {

constexpr double radius = 25, height = 120;
constexpr int around = 40, rows = 20;
const double chord = 2 * radius * std::sin(std::numbers::pi / around);

class Seam : public testing::Test {
protected:
    Session read(const TriMesh& part, const SeamOptions& seam = {})
    {
        Session session;
        session.file = folder / "part.obj";
        shapes::write_mesh(session.file, part);
        session.options.read.seam = seam;
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        return run_stage(Stage::read, std::move(session));
    }
    Session finished(Session session) { return completed(run_chain(std::move(session), Stage::solve)); }
    ScratchFolder folder;
};

std::string complaint(const std::filesystem::path& file)
{
    try {
        seam_options(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_F(Seam, OfATubeGivesTheRectangleItWasRolledFrom)
{
    const Session session = finished(read(shapes::pipe(radius, radius, height, around, rows)));
    const FlattenResult& flat = *session.blank;
    EXPECT_TRUE(flat.report.converged);
    EXPECT_LT(flat.face.strain_equivalent.maxCoeff(), 1e-6);
    Eigen::Matrix2Xd X = flat.blank.position;
    X.colwise() -= X.rowwise().mean().eval();
    // The corners of the rectangle are the farthest points from its middle.
    EXPECT_NEAR(X.colwise().norm().maxCoeff(), std::hypot(around * chord, height) / 2, 1e-3);
    EXPECT_EQ(session.grid->result.quality.folded_cells, 0);
    EXPECT_LT(session.surface->deviation.max(), 0.02 * radius);
    EXPECT_TRUE(shortcomings(session).empty());
}

TEST_F(Seam, IsInTheReportWithItsLengthAndWay)
{
    const Session session = finished(read(shapes::pipe(radius, radius, height, around, rows)));
    const auto json = nlohmann::json::parse(report_json(session, {}, 0));
    EXPECT_NEAR(json["part"]["seam"]["length_mm"].get<double>(), height, 1e-6);
    ASSERT_EQ(json["part"]["seam"]["paths"].size(), 1u);
    EXPECT_EQ(json["part"]["seam"]["paths"][0].size(), size_t(rows + 1));
    EXPECT_EQ(json["part"]["findings"][0]["fault"], "seam");
    const auto sheet = nlohmann::json::parse(report_json(read(shapes::plate({.triangles = 300})), {}, 0));
    EXPECT_TRUE(sheet["part"]["seam"].is_null());
}

TEST_F(Seam, CornersOnItAreGivenTwiceAndFoundAgain)
{
    Session session = finished(read(shapes::pipe(radius, radius, height, around, rows)));
    std::array<int, 4> in_file;
    for (size_t k = 0; k < 4; ++k)
        in_file[k] = session.part->source_vertex[size_t(session.grid->boundary.corner[k])];
    ASSERT_EQ(std::set<int>(in_file.begin(), in_file.end()).size(), 2u); // the two ends of the seam
    const std::array<int, 4> found = session.grid->boundary.corner;
    for (int turn = 0; turn < 4; ++turn) {
        std::rotate(in_file.begin(), in_file.begin() + 1, in_file.end());
        session.options.corners = in_file;
        require_possible(session);
        const auto same = run_stage(Stage::grid, session).grid->boundary.corner;
        EXPECT_EQ(std::set<int>(same.begin(), same.end()), std::set<int>(found.begin(), found.end()));
    }
    session.options.corners = {in_file[0], in_file[0], in_file[0], in_file[2]};
    EXPECT_THROW(require_possible(session), InputError);
}

TEST_F(Seam, OfATorusAndABoxGivesABlank)
{
    for (const TriMesh& part : {shapes::torus(60, 20, 800), shapes::body_surface({{0, 0, 0}, {1, 0, 0}}, 30, 5)}) {
        const Session session = finished(read(part));
        EXPECT_EQ(session.blank->flipped_triangles, 0);
        EXPECT_TRUE(session.blank->report.converged) << session.blank->report.reason;
        EXPECT_EQ(session.grid->result.quality.folded_cells, 0);
        EXPECT_FALSE(write_outputs(session, folder / "out", {"csv", "vtu", "dxf", "iges"}).empty());
    }
}

TEST_F(Seam, IsReadFromAFile)
{
    EXPECT_EQ(seam_options("auto"), SeamOptions{});
    EXPECT_EQ(seam_options("none").mode, SeamOptions::Mode::none);
    put(folder / "seam.json", R"({"seam": [[3, 5, 9], [1, 2]]})");
    EXPECT_EQ(seam_options(folder / "seam.json"), (SeamOptions{SeamOptions::Mode::given, {{3, 5, 9}, {1, 2}}}));
    const int upper = around * rows + around / 4;
    const Session session =
        read(shapes::pipe(radius, radius, height, around, rows), {SeamOptions::Mode::given, {{0, upper}}});
    EXPECT_EQ(session.part->seam.front().front() + session.part->seam.front().back(), upper);

    EXPECT_NE(complaint(folder / "gone.json").find("gone.json"), std::string::npos);
    for (const auto& [text, words] : {std::pair("[[1, 2]]", "member \"seam\""),
                                      {R"({"seam": 3})", "/seam must be a list of paths"},
                                      {R"({"seam": []})", "/seam must be a list of paths"},
                                      {R"({"seam": [[1, 2], [4]]})", "/seam/1 must be a list of two or more"},
                                      {R"({"seam": [[1, 2.5]]})", "/seam/0/1 must be the number of a vertex"},
                                      {R"({"seam": [[-1, 2]]})", "/seam/0/0 must be the number of a vertex"},
                                      {R"({"seam": [[1, 2]], "x": 0})", "no other"}}) {
        put(folder / "bad.json", text);
        EXPECT_NE(complaint(folder / "bad.json").find(words), std::string::npos) << complaint(folder / "bad.json");
    }
}

} // namespace spia::seam_test

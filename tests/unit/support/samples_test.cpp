#include "tests/support/samples.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/core/error.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

namespace fs = std::filesystem;

TriMesh read_obj(const fs::path& file)
{
    std::vector<double> x;
    std::vector<int> t;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        double a, b, c;
        words >> kind >> a >> b >> c;
        if (kind == "v")
            x.insert(x.end(), {a, b, c});
        if (kind == "f")
            t.insert(t.end(), {int(a) - 1, int(b) - 1, int(c) - 1});
    }
    return {Eigen::Matrix3Xd::Map(x.data(), 3, Eigen::Index(x.size() / 3)),
            Eigen::Matrix3Xi::Map(t.data(), 3, Eigen::Index(t.size() / 3))};
}

TEST(Samples, EverySheetIsOneOrientedComponentOfAboutTheWantedSize)
{
    for (const Sample& one : samples()) {
        if (!one.is_sheet)
            continue;
        SCOPED_TRACE(one.name);
        const TriMesh mesh = one.make(3000);
        expect_count(mesh, 3000);
        const auto loops = boundary_loops(mesh);
        EXPECT_EQ(euler_characteristic(mesh), 2 - int(loops.size())); // one component, genus 0
        expect_well_shaped(mesh, 0, 20);
    }
}

TEST(Samples, SameCallGivesTheSameBits)
{
    for (const char* name : {"square-cup", "perforated-channel", "fender"}) {
        const TriMesh a = sample(name).make(3000), b = sample(name).make(3000);
        EXPECT_EQ(a.position, b.position) << name;
        EXPECT_EQ(a.triangle, b.triangle) << name;
    }
}

TEST(Samples, UnknownNameIsAnsweredWithTheList)
{
    try {
        sample("teapot");
        FAIL() << "a teapot is no sample";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("inner-panel"), std::string::npos);
    }
}

TEST(Samples, KeptFilesAreWhatTheGeneratorMakes)
{
    int files = 0;
    for (const auto& entry : fs::directory_iterator(SPIA_SOURCE_DIR "/assets/parts")) {
        if (entry.path().extension() != ".obj")
            continue;
        SCOPED_TRACE(entry.path().filename());
        ++files;
        EXPECT_LT(entry.file_size(), 400'000u);
        const Sample& origin = sample(entry.path().stem().string());
        const TriMesh kept = read_obj(entry.path()), made = origin.make(origin.small);
        // Another processor's rounding may decide single flips otherwise, so not bit by bit.
        EXPECT_NEAR(kept.triangles(), made.triangles(), 0.03 * made.triangles());
        EXPECT_NEAR(area(kept), area(made), 1e-3 * area(made));
        EXPECT_EQ(boundary_loops(kept).size(), boundary_loops(made).size());
    }
    EXPECT_GE(files, 5);
}

TEST(MeshFile, ObjKeepsVerticesAndFaces)
{
    const TriMesh mesh = saddle({.triangles = 200});
    const fs::path file = fs::temp_directory_path() / "spia_mesh_file_test.obj";
    write_mesh(file, mesh);
    const TriMesh back = read_obj(file);
    fs::remove(file);
    EXPECT_EQ(back.triangle, mesh.triangle);
    EXPECT_LT((back.position - mesh.position).cwiseAbs().maxCoeff(), 0.51e-6);
}

TEST(MeshFile, StlHasEightyFourBytesAndFiftyPerTriangle)
{
    const TriMesh mesh = saddle({.triangles = 200});
    const fs::path file = fs::temp_directory_path() / "spia_mesh_file_test.stl";
    write_mesh(file, mesh);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    fs::remove(file);
    ASSERT_EQ(bytes.size(), 84u + 50u * size_t(mesh.triangles()));
    std::uint32_t count = 0;
    float last[12]; // normal and corners of the last triangle
    std::memcpy(&count, bytes.data() + 80, 4);
    std::memcpy(last, bytes.data() + bytes.size() - 50, sizeof last);
    EXPECT_EQ(int(count), mesh.triangles());
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(last[3 + 3 * k + i], float(mesh.position(i, mesh.triangle(k, mesh.triangles() - 1))));
    EXPECT_GT(last[2], 0);
}

TEST(MeshFile, OtherEndingsAndMissingFoldersAreRefused)
{
    EXPECT_THROW(write_mesh("part.ply", rectangle(1, 1, 1, 1)), InputError);
    EXPECT_THROW(write_mesh("/nowhere/part.stl", rectangle(1, 1, 1, 1)), ExchangeError);
}

} // namespace
} // namespace spia::shapes

// Variants of mesh files and decks that other programs read: strips, sparse and compressed arrays,
// plane elements.
#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_compressed.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/sample_meshes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::mesh_variants_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct MeshVariants : testing::Test {
    ScratchFolder folder;

    PartFile read(const std::string& name, const std::string& content)
    {
        std::ofstream(folder / name, std::ios::binary) << content;
        return examine_part(folder / name, {.unit = LengthUnit::mm});
    }
    std::string refusal(const std::string& name, const std::string& content)
    {
        try {
            read(name, content);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    static Eigen::Vector3d moment(const TriMesh& mesh) // of the area: tells a sheet and its sides
                                                       // from another
    {
        const Eigen::Matrix3Xd vectors = area_vectors(mesh);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int f = 0; f < mesh.triangles(); ++f)
            sum += mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean().cross(vectors.col(f));
        return sum;
    }
    static void expect_same_sheet(const TriMesh& mesh, const TriMesh& expected, double tolerance,
                                  const std::string& which)
    {
        EXPECT_EQ(mesh.triangles(), expected.triangles()) << which;
        EXPECT_NEAR(area(mesh), area(expected), tolerance) << which;
        EXPECT_LT((area_vectors(mesh).rowwise().sum() - area_vectors(expected).rowwise().sum()).norm(), tolerance)
            << which;
        EXPECT_LT((moment(mesh) - moment(expected)).norm(), 100 * tolerance) << which;
    }
};

/// Rows of a grid of (columns + 1) x (rows + 1) vertices as one strip each.
std::string strips_ply(int columns, int rows, bool one_list)
{
    std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                                   "property float z\nelement tristrips {}\nproperty list int int vertex_indices\n"
                                   "end_header\n",
                                   (columns + 1) * (rows + 1), one_list ? 1 : rows);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            text += fmt::format("{} {} {}\n", i, j, 0.1 * i * i);
    std::string all;
    for (int j = 0; j < rows; ++j) {
        std::string strip;
        for (int i = 0; i <= columns; ++i)
            strip += fmt::format(" {} {}", (j + 1) * (columns + 1) + i, j * (columns + 1) + i);
        if (one_list)
            all += strip + " -1";
        else
            text += fmt::format("{}{}\n", 2 * (columns + 1), strip);
    }
    return one_list ? text + fmt::format("{}{}\n", rows * (2 * columns + 3), all) : text;
}

TriMesh grid(int columns, int rows)
{
    TriMesh mesh;
    mesh.position.resize(3, (columns + 1) * (rows + 1));
    mesh.triangle.resize(3, 2 * columns * rows);
    for (int j = 0, v = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.position.col(v++) << i, j, 0.1 * i * i;
    for (int j = 0, f = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = j * (columns + 1) + i, up = columns + 1;
            mesh.triangle.col(f++) << a + up, a, a + up + 1;
            mesh.triangle.col(f++) << a, a + 1, a + up + 1;
        }
    return mesh;
}

} // namespace

TEST_F(MeshVariants, StripsOfPlyAreTheirTriangles)
{
    const TriMesh expected = grid(4, 3);
    for (const bool one_list : {false, true}) {
        const PartFile part = read("a.ply", strips_ply(4, 3, one_list));
        expect_same_sheet(part.mesh, expected, 1e-5, one_list ? "ended by -1" : "a list each");
        EXPECT_FALSE(part.doctor.find(Fault::flipped_face)) << "every second triangle runs the other way about";
    }
    std::string wrong = strips_ply(2, 1, false);
    wrong.replace(wrong.rfind(" 2"), 2, " 9");
    EXPECT_THAT(refusal("a.ply", wrong), HasSubstr("9"));
}

TEST_F(MeshVariants, SparseArraysOfGltfReplaceWhatTheyName)
{
    // Two triangles whose vertex 2 is replaced; in the second file all but two vertices are zeros
    // that no view holds.
    const auto file = [&](bool base, const std::vector<std::uint16_t>& places,
                          const std::vector<Eigen::Vector3f>& values) {
        std::string binary;
        for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 5.f, 5.f, 5.f, 0.f, 1.f, 0.f})
            sample::append(binary, x);
        for (const std::uint16_t i : {0, 1, 2, 0, 2, 3})
            sample::append(binary, i);
        const size_t at = binary.size();
        for (const std::uint16_t place : places)
            sample::append(binary, place);
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const size_t values_at = binary.size();
        for (const Eigen::Vector3f& value : values)
            for (const float x : value)
                sample::append(binary, x);
        return sample::glb(
            fmt::format(R"({{"asset":{{"version":"2.0"}},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},)"
                        R"("indices":1}}]}}],"accessors":[{{{}"componentType":5126,"count":4,"type":"VEC3","sparse":)"
                        R"({{"count":{},"indices":{{"bufferView":2,"componentType":5123}},"values":)"
                        R"({{"bufferView":3}}}}}},{{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}}],)"
                        R"("bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,)"
                        R"("byteLength":12}},{{"buffer":0,"byteOffset":{},"byteLength":{}}},{{"buffer":0,)"
                        R"("byteOffset":{},"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}})",
                        base ? R"("bufferView":0,)" : "", places.size(), at, 2 * places.size(), values_at,
                        12 * values.size(), binary.size()),
            binary);
    };
    const PartFile square = read("a.glb", file(true, {2}, {{1, 1, 0}}));
    EXPECT_NEAR(area(square.mesh), 1, 1e-12);
    EXPECT_NEAR(square.mesh.position.maxCoeff(), 1, 1e-12);
    const PartFile zeros = read("b.glb", file(false, {1, 2, 3}, {{2, 0, 0}, {2, 1, 0}, {0, 1, 0}}));
    EXPECT_NEAR(area(zeros.mesh), 2, 1e-12);
    EXPECT_THAT(refusal("c.glb", file(true, {4}, {{1, 1, 0}})), HasSubstr("must rise and be below 4"));
    EXPECT_THAT(refusal("d.glb", file(true, {2, 1}, {{1, 1, 0}, {0, 0, 0}})), HasSubstr("must rise"));
}

TEST_F(MeshVariants, CompressedMeshesOfGltfAreThePlainOnes)
{
    const TriMesh mesh = sample::bent_sheet();
    const double diagonal = bounding_diagonal(mesh);
    expect_same_sheet(read("a.glb", sample::glb_by_meshopt(mesh)).mesh, mesh, 1e-3, "meshopt");
    expect_same_sheet(read("b.glb", sample::glb_by_meshopt(mesh, true)).mesh, mesh, 1e-3, "meshopt, with a fallback");
    expect_same_sheet(read("c.glb", sample::glb_by_draco(mesh)).mesh, mesh, 1e-3, "Draco");
    const TriMesh rounded = read("d.glb", sample::glb_by_draco(mesh, 14)).mesh;
    EXPECT_NEAR(area(rounded), area(mesh), area(mesh) * 8 / (1 << 14)) << "rounded to 2^-14 of its size " << diagonal;
    TriMesh over = mesh; // seen from the same side once it is mirrored
    over.position.row(0) *= -1;
    over.triangle.row(1).swap(over.triangle.row(2));
    expect_same_sheet(read("e.glb", sample::glb_by_draco(mesh, 0, true)).mesh, over, 1e-3, "Draco, mirrored");
}

TEST_F(MeshVariants, DamagedCompressedMeshesAreRefused)
{
    const TriMesh mesh = sample::bent_sheet();
    for (const std::string& whole : {sample::glb_by_meshopt(mesh), sample::glb_by_draco(mesh, 14)}) {
        const size_t binary = whole.rfind(std::string("BIN\0", 4)) + 4;
        int refused = 0;
        for (size_t at = binary; at < whole.size(); at += 5) {
            std::string damaged = whole;
            damaged[at] = char(damaged[at] ^ 0x55);
            refused += !refusal("a.glb", damaged).empty(); // others are another mesh, or none that
                                                           // is seen
        }
        EXPECT_GT(refused, 0);
    }
    std::string claims = sample::glb_by_meshopt(mesh);
    const size_t count = claims.find("\"byteStride\":12,\"count\":30");
    ASSERT_NE(count, claims.npos);
    claims.replace(claims.find("\"count\":30", count), 10, "\"count\":99");
    EXPECT_NE(refusal("a.glb", claims), "");
}

TEST_F(MeshVariants, PlaneAndMembraneElementsOfAbaqusAreShells)
{
    for (const auto& [type, nodes] : {std::pair("CPS3", 3),
                                      {"CPE3", 3},
                                      {"CPS4R", 4},
                                      {"CPE4RH", 4},
                                      {"CPEG4", 4},
                                      {"CPS6", 6},
                                      {"CPE8R", 8},
                                      {"M3D4R", 4},
                                      {"M3D3", 3},
                                      {"M3D8", 8}}) {
        std::string text = "*NODE\n";
        for (const auto& [id, x] : {std::pair(1, "0,0"),
                                    {2, "2,0"},
                                    {3, "2,1"},
                                    {4, "0,1"},
                                    {5, "1,0"},
                                    {6, "2,.5"},
                                    {7, "1,1"},
                                    {8, "0,.5"}})
            text += fmt::format("{},{},0\n", id, x);
        text += fmt::format("*ELEMENT, TYPE={}, ELSET=A\n1", type);
        for (int k = 1; k <= nodes; ++k)
            text += fmt::format(",{}", k);
        const Deck deck = sample::read("a.inp", text + "\n");
        EXPECT_EQ(deck.elements(), 1) << type;
    }
}

} // namespace spia::mesh_variants_test

#include "engine/exchange/read_part.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/grid_surface.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/sample_meshes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::read_part_test {
namespace {

namespace fs = std::filesystem;

using namespace sample;

const fs::path data_folder = fs::path(SPIA_SOURCE_DIR) / "../shared/data";

class ReadPart : public testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& content)
    {
        const fs::path path = scratch / name;
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    PartFile read(const std::string& name, const std::string& content, const ReadOptions& options = {})
    {
        return read_part(write(name, content), options);
    }
    void expect_refused(const std::string& name, const std::string& content, const std::string& words)
    {
        try {
            read(name, content);
            ADD_FAILURE() << name << " was accepted; expected: " << words;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
    ScratchFolder scratch;
};

const std::string tetrahedron = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

} // namespace

TEST_F(ReadPart, EveryTextFormatKeepsAllDigitsAndTheOrderOfTheFile)
{
    const TriMesh mesh = bent_sheet();
    for (const auto& [name, content] : {std::pair{"part.obj", obj_text(mesh)},
                                        {"PART.OFF", off_text(mesh)},
                                        {"part.ply", ply_text(mesh)},
                                        {"little.ply", ply_binary(mesh, false)},
                                        {"big.ply", ply_binary(mesh, true)}}) {
        const PartFile part = read(name, content);
        EXPECT_EQ(part.mesh.position, mesh.position) << name;
        EXPECT_EQ(part.mesh.triangle, mesh.triangle) << name;
        EXPECT_TRUE(part.doctor.findings.empty()) << name;
        EXPECT_EQ(part.file_faces, mesh.triangles()) << name;
    }
}

TEST_F(ReadPart, BothKindsOfStlAreWeldedInTheOrderOfTheirCorners)
{
    const TriMesh mesh = bent_sheet();
    for (const auto& [name, content] : {std::pair{"text.stl", stl_text(mesh)}, {"binary.stl", stl_binary(mesh)}}) {
        const PartFile part = read(name, content);
        ASSERT_EQ(part.mesh.vertices(), mesh.vertices()) << name;
        for (int f = 0; f < mesh.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                EXPECT_LT(
                    (part.mesh.position.col(part.mesh.triangle(k, f)) - mesh.position.col(mesh.triangle(k, f))).norm(),
                    3e-6)
                    << name; // half a unit in the last place of 33 in single precision, per
                             // coordinate
        int seen = 0;
        // a vertex is numbered when a corner first comes to it
        for (int i = 0; i < part.mesh.triangle.size(); ++i) {
            EXPECT_LE(part.mesh.triangle(i % 3, i / 3), seen) << name;
            seen = std::max(seen, part.mesh.triangle(i % 3, i / 3) + 1);
        }
    }
}

TEST_F(ReadPart, UnitsScaleLengthsAndAreasTheirSquare)
{
    const std::string text = obj_text(bent_sheet());
    const double in_mm = area(read("part.obj", text).mesh);
    for (const auto& [unit, length] : {std::pair{"cm", 10.0}, {"m", 1000.0}, {"inch", 25.4}}) {
        const PartFile part = read("part.obj", text, {.unit = length_unit(unit)});
        EXPECT_NEAR(area(part.mesh) / (in_mm * length * length), 1, 1e-14) << unit;
        EXPECT_EQ(name(part.unit), unit);
    }
    EXPECT_THROW(length_unit("furlong"), InputError);
}

TEST_F(ReadPart, ObjCornersMayCountBackwardsAndLinesMayGoOn)
{
    const PartFile part =
        read("part.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0 1.0\nf -3 -2 -1\nv +0 1e0 0.\nf 1 3 \\\n 4\nl 1 2\n");
    EXPECT_EQ(part.mesh.triangles(), 2);
    EXPECT_NEAR(area(part.mesh), 1, 1e-15);
    ASSERT_FALSE(part.notes.empty());
    EXPECT_NE(part.notes[0].find("1 point, line or free-form piece was"), std::string::npos);
}

TEST_F(ReadPart, FacesThatOpenMeshDropsAreSeenByTheDoctorUnderTheirNumber)
{
    const std::string square = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3\n";
    const PartFile obj = read("part.obj", square + "f 1 3 1\nf 1 3 3 4\n");
    ASSERT_NE(obj.doctor.find(Fault::repeated_corner), nullptr);
    EXPECT_EQ(obj.doctor.find(Fault::repeated_corner)->count, 2);
    EXPECT_EQ(obj.doctor.find(Fault::repeated_corner)->first, 1);
    EXPECT_EQ(obj.source_face, (std::vector<int>{0, 2}));
    EXPECT_NEAR(area(obj.mesh), 81, 1e-12);

    TriMesh mesh = bent_sheet();
    mesh.triangle.conservativeResize(3, mesh.triangles() + 1);
    mesh.triangle.col(mesh.triangles() - 1) << 3, 4, 3;
    mesh.triangle.col(7).swap(mesh.triangle.col(mesh.triangles() - 1));
    const PartFile stl = read("part.stl", stl_binary(mesh));
    ASSERT_NE(stl.doctor.find(Fault::repeated_corner), nullptr);
    EXPECT_EQ(stl.doctor.find(Fault::repeated_corner)->first, 7);
    EXPECT_EQ(stl.file_faces, mesh.triangles());
    EXPECT_EQ(stl.mesh.triangles(), mesh.triangles() - 1);
}

TEST_F(ReadPart, GltfNodesStripsAndMirrorsMakeOneSheetInMillimetres)
{
    const GltfStrip strip;
    const std::string data = "data:application/octet-stream;base64," + base64(strip.binary);
    const fs::path beside = write("strip.bin", strip.binary);
    for (const auto& [name, content] : {std::pair{"part.glb", glb(strip.json, strip.binary)},
                                        {"part.gltf", GltfStrip(data).json},
                                        {"other.gltf", GltfStrip("strip.bin").json}}) {
        const PartFile part = read(name, content);
        EXPECT_EQ(part.mesh.vertices(), 6) << name; // 8 in the file, two of them shared along the
                                                    // joint
        EXPECT_EQ(part.mesh.triangles(), 4) << name;
        // 2 m x 1 m, all faces up
        EXPECT_NEAR(area_vectors(part.mesh).row(2).sum(), 2e6, 1) << name;
        EXPECT_NEAR(bounding_diagonal(part.mesh), std::sqrt(5) * 1000, 1e-9) << name;
        EXPECT_EQ(part.doctor.find(Fault::flipped_face), nullptr) << name;
        EXPECT_EQ(part.doctor.boundary_loops, 1) << name;
        EXPECT_EQ(part.notes.size(), 2u) << name; // the lines that were skipped, and the unit
    }
    EXPECT_NEAR(area(read("part.glb", glb(strip.json, strip.binary), {.unit = LengthUnit::mm}).mesh), 2, 1e-9);
}

TEST_F(ReadPart, GltfRefusesUnknownExtensionsAndFilesElsewhere)
{
    write("outside.bin", GltfStrip().binary);
    fs::create_directory(scratch / "inner");
    expect_refused("inner/part.gltf", GltfStrip("../outside.bin").json, "outside.bin");
    expect_refused("inner/part.gltf", GltfStrip((scratch / "outside.bin").string()).json, "outside.bin");
    expect_refused("part.gltf", GltfStrip("none.bin").json, "damaged");
    const GltfStrip unknown("", R"("extensionsRequired":["ACME_bent_space"],)");
    expect_refused("part.glb", glb(unknown.json, unknown.binary), "ACME_bent_space");
    expect_refused("deep.gltf", std::string(100000, '['), "nested");
}

TEST_F(ReadPart, WhatIsNoMeshFileIsSaidSo)
{
    expect_refused("part.dwg", "x", "extension '.dwg'");
    expect_refused("part", "x", "extension ''");
    expect_refused("empty.obj", "", "empty");
    fs::create_directory(scratch / "folder.stl");
    EXPECT_THROW(read_part(scratch / "folder.stl"), InputError);
    EXPECT_THROW(read_part(scratch / "missing.stl"), InputError);
    expect_refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces");
}

TEST_F(ReadPart, DamageIsRefusedWithItsPlace)
{
    expect_refused("a.obj", "v 0 0 0\nv 1 x 0\n", "line 2");
    expect_refused("b.obj", "v 0 0 0\nv 1 nan 0\n", "line 2");
    expect_refused("c.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", "vertex 4");
    expect_refused("d.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 /3\n", "'/3'");
    expect_refused("e.obj", "v 0 0 0\nf 1 0 1\n", "line 2");
    expect_refused("f.obj", "v 0 0 1e200\n", "line 1");
    expect_refused("a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n", "do not fit");
    expect_refused("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "vertex 2 of 3");
    expect_refused("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n# the face is missing\n", "face 0 of 1 is missing");
    expect_refused("d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "vertex 3");
    expect_refused("e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n4000000000 0 1 2\n", "line 6");
    expect_refused("f.off", "OFF BINARY\n", "binary OFF");
    expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "header does not end");
    expect_refused("b.ply", "ply\nformat ascii 1.0\nproperty int x\nend_header\n", "before the first element");
    expect_refused("c.ply", "ply\nformat ascii 1.0\nelement vertex 9000000\nproperty float x\nend_header\n0 0 0\n",
                   "announces");
    const TriMesh mesh = bent_sheet();
    const std::string ply = ply_binary(mesh, false), stl = stl_binary(mesh), text = stl_text(mesh);
    expect_refused("cut.ply", ply.substr(0, ply.size() - 3), "cut off");
    expect_refused("cut.stl", stl.substr(0, stl.size() - 3), "cut off");
    expect_refused("cut_text.stl", text.substr(0, text.find("endsolid")), "cut off");
    std::string bad = stl;
    std::memset(bad.data() + 80, 0xff, 4);
    expect_refused("many.stl", bad, "claims 4294967295 facets");
    bad = stl;
    std::memset(bad.data() + 84 + 50 * 3 + 12, 0xff, 4); // not a number
    expect_refused("nan.stl", bad, "facet 3");
}

TEST_F(ReadPart, SickPartIsReportedByExamineAndRefusedByRead)
{
    const fs::path path = write("part.off", tetrahedron);
    ReadOptions options;
    options.seam.mode = SeamOptions::Mode::none;
    const PartFile part = examine_part(path, options);
    EXPECT_FALSE(part.doctor.healthy());
    EXPECT_EQ(part.mesh.triangles(), 4);
    EXPECT_EQ(part.doctor.euler_characteristic, 2);
    EXPECT_THROW(read_part(path, options), InputError);
}

TEST_F(ReadPart, AClosedPartIsCutOpenAndTheReportSaysWhere)
{
    const PartFile part = read_part(write("part.off", tetrahedron));
    EXPECT_EQ(part.mesh.triangles(), 4);
    EXPECT_EQ(part.mesh.vertices(), 5);
    EXPECT_EQ(part.doctor.boundary_loops, 1);
    EXPECT_EQ(part.doctor.euler_characteristic, 1);
    EXPECT_EQ(part.doctor.find(Fault::closed_surface)->severity, Severity::repaired);
    ASSERT_EQ(part.seam.size(), 1u);
    ASSERT_EQ(part.seam[0].size(), 3u);
    EXPECT_EQ(std::count(part.source_vertex.begin(), part.source_vertex.end(), part.seam[0][1]), 2);
    const Finding& seam = *part.doctor.find(Fault::seam);
    EXPECT_TRUE(counts_vertices(seam.fault));
    EXPECT_EQ(seam.where, part.seam[0]);
    EXPECT_EQ(seam.first, part.seam[0][0]);
    ASSERT_EQ(seam.place.size(), 3u);
    double length = 0;
    for (size_t i = 1; i < 3; ++i)
        length += (seam.place[i] - seam.place[i - 1]).norm();
    EXPECT_DOUBLE_EQ(part.seam_length, length);
    EXPECT_NE(seam.text.find(fmt::format("{:.4g} mm", length)), std::string::npos) << seam.text;
}

TEST_F(ReadPart, TheSeamIsNamedByTheNumbersOfTheFileInItsUnit)
{
    // A strip of four squares with a stray vertex before it; in inches.
    std::string strip = "v 9 9 9\n";
    for (int i = 0; i < 5; ++i)
        strip += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 2 0\n", i);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j)
            strip += fmt::format("f {} {} {} {}\n", 3 * i + j + 2, 3 * i + j + 5, 3 * i + j + 6, 3 * i + j + 3);
    ReadOptions options;
    options.unit = LengthUnit::inch;
    options.seam = {SeamOptions::Mode::given, {{7, 8}}}; // from the middle of one long side inwards
    const PartFile part = read_part(write("strip.obj", strip), options);
    EXPECT_EQ(part.seam, options.seam.path);
    EXPECT_NEAR(part.seam_length, 25.4, 1e-9);
    EXPECT_EQ(std::count(part.source_vertex.begin(), part.source_vertex.end(), 7), 2);
    EXPECT_EQ(std::count(part.source_vertex.begin(), part.source_vertex.end(), 8), 1);
    EXPECT_TRUE(std::is_sorted(part.source_vertex.begin(), part.source_vertex.end()));
    options.seam.path = {{0, 8}};
    EXPECT_THROW(read_part(write("strip.obj", strip), options), InputError); // the stray
}

TEST_F(ReadPart, ASolidOfSheetIsGivenByASkinUnlessASeamIsGiven)
{
    std::set<shapes::Cell> tiles;
    for (int i = 0; i < 70; ++i)
        for (int j = 0; j < 70; ++j)
            tiles.insert({i, j, 0});
    TriMesh solid = shapes::body_surface(tiles, 2, 1);
    const auto off = [&](const TriMesh& mesh) {
        std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices(), mesh.triangles());
        for (const auto& x : mesh.position.colwise())
            text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
        for (const auto& t : mesh.triangle.colwise())
            text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
        return text;
    };
    const PartFile skin = read("skins.off", off(solid));
    EXPECT_TRUE(skin.seam.empty());
    ASSERT_TRUE(skin.solid);
    EXPECT_NEAR(area(skin.mesh), 70 * 70 * std::pow(skin.solid->thickness, 2), 1e-6) << "cubes side by side";
    ReadOptions options;
    options.seam = {SeamOptions::Mode::given, {{0, solid.vertices() - 1}}};
    EXPECT_EQ(read("skins.off", off(solid), options).doctor.boundary_loops, 1);
    solid.position.row(2) *= 10; // a box
    EXPECT_EQ(read("box.off", off(solid)).doctor.boundary_loops, 1);
}

namespace {

struct KnownPart {
    const char* file;
    int vertices, faces, loops, components, flipped; ///< flipped: 0 none, 1 some
};

void PrintTo(const KnownPart& part, std::ostream* out) { *out << part.file; }

} // namespace

class RealPart : public testing::TestWithParam<KnownPart> {};

TEST_P(RealPart, HasTheTopologyItsOriginStates)
{
    const KnownPart known = GetParam();
    if (!fs::exists(data_folder / known.file))
        GTEST_SKIP() << "no " << data_folder / known.file;
    ReadOptions as_it_is;
    as_it_is.seam.mode = SeamOptions::Mode::none;
    const PartFile part = examine_part(data_folder / known.file, as_it_is);
    EXPECT_EQ(part.file_vertices, known.vertices);
    EXPECT_EQ(part.file_faces, known.faces);
    EXPECT_EQ(part.mesh.vertices(), known.vertices);
    EXPECT_EQ(part.doctor.boundary_loops, known.loops);
    EXPECT_EQ(part.doctor.components, known.components);
    EXPECT_EQ(part.doctor.genus, 0);
    EXPECT_EQ(part.doctor.find(Fault::flipped_face) != nullptr, known.flipped != 0);
    EXPECT_EQ(part.doctor.healthy(), known.components == 1);
    if (known.components == 1) {
        EXPECT_EQ(int(boundary_loops(part.mesh).size()),
                  known.loops); // by the half-edge mesh: a second count
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealPart,
    testing::Values(
        KnownPart{"fe/fairing_front.obj", 22896, 44647, 8, 1, 1},
        KnownPart{"fe/mudguard_front.obj", 3050, 5802, 1, 1, 0},
        KnownPart{"fe/mudguard_front.ply", 3050, 5802, 1, 1, 0},
        KnownPart{"fe/mudguard_front.stl", 3050, 5802, 1, 1, 0}, KnownPart{"mesh/face.obj", 25905, 51712, 1, 1, 0},
        KnownPart{"mesh/camelhead.off", 11381, 22704, 1, 1, 0}, KnownPart{"mesh/lilium.obj", 3389, 6590, 1, 1, 0},
        KnownPart{"mesh/camel_b.obj", 2032, 3576, 1, 1, 0}, KnownPart{"mesh/beetle.off", 19887, 38656, 11, 1, 0},
        KnownPart{"mesh/halftunnel.off", 831, 784, 3, 1, 0}, KnownPart{"mesh/nefertiti.off", 299, 562, 1, 1, 0},
        KnownPart{"mesh/three_peaks.off", 1907, 3671, 1, 1, 0}, KnownPart{"mesh/mask_cone.off", 1230, 2332, 2, 2, 0},
        KnownPart{"mesh/cowhead.obj", 15049, 29999, 1, 1, 0}, KnownPart{"mesh/maze.obj", 6120, 9174, 1, 1, 0},
        KnownPart{"mesh/inverted_triangles.obj", 12577, 24685, 6, 1, 1},
        KnownPart{"mesh/terrain.stl", 1813, 3498, 1, 1, 0}),
    [](const auto& parameter) {
        std::string name = parameter.param.file;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
        return name;
    });

} // namespace spia::read_part_test

#include "engine/exchange/deck/original_results.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>
#include <set>

#include "engine/core/error.h"
#include "engine/exchange/deck/part_shells.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/part/vertex_numbers.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::original_results_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// Quads between rows of nodes; closed: the last column is the first one.
std::string deck(int columns, int rows, const std::function<Vector3d(double, double)>& at, bool closed = false)
{
    std::string text = "*KEYWORD\n*NODE\n";
    const int nodes = columns + !closed;
    const auto id = [&](int i, int j) { return 1000 + j * nodes + i % nodes; };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < nodes; ++i) {
            const Vector3d p = at(double(i) / columns, double(j) / rows);
            text += fmt::format("{},{:.12g},{:.12g},{:.12g}\n", id(i, j), p.x(), p.y(), p.z());
        }
    text += "*ELEMENT_SHELL\n";
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            text += fmt::format("{},1,{},{},{},{}\n", 50 + j * columns + i, id(i, j), id(i + 1, j), id(i + 1, j + 1),
                                id(i, j + 1));
    return text;
}

/// Fields that are linear in the place, and one state of strain all over it: 0.2 along a direction,
/// -0.05 across.
SheetFields fields_on(const TriMesh& mesh, const Vector3d& direction)
{
    SheetFields fields;
    const int count = mesh.triangles();
    for (Eigen::VectorXd* field :
         {&fields.thickness, &fields.thinning, &fields.strain_major, &fields.strain_minor, &fields.strain_equivalent,
          &fields.stress_major, &fields.stress_minor, &fields.stress_equivalent})
        field->resize(count);
    for (int f = 0; f < count; ++f) {
        const Vector3d middle = mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        fields.thinning[f] = 0.001 * middle.x() + 0.002 * middle.y();
        fields.thickness[f] = 2 * (1 - fields.thinning[f]);
    }
    fields.strain_major.setConstant(0.2);
    fields.strain_minor.setConstant(-0.05);
    fields.strain_equivalent.setConstant(0.25);
    fields.stress_major.setConstant(400);
    fields.stress_minor.setConstant(150);
    fields.stress_equivalent.setConstant(300);
    fields.direction_major = direction.normalized().replicate(1, count);
    fields.necking.setZero(count);
    return fields;
}

class OriginalResultsTest : public testing::Test {
protected:
    PartFile read(const std::string& text, double size)
    {
        put(scratch / "part.k", text);
        ReadOptions options;
        options.remesh.emplace().size = size;
        return read_part(scratch / "part.k", options);
    }
    ScratchFolder scratch;
};

TEST_F(OriginalResultsTest, OfAPlaneAreThoseOfThePlane)
{
    const auto plate = [](double u, double v) { return Vector3d(100 * u + 8 * v * v, 60 * v + 5 * u * u, 0); };
    for (const double size : {3.0, 17.0}) { // finer and coarser than the elements
        const PartFile part = read(deck(14, 9, plate), size);
        ASSERT_NE(part.mesh.triangles(), 2 * 14 * 9);
        Eigen::Matrix2d stretch;
        stretch << 1.1, 0.3, -0.2, 0.9;
        const Blank blank{(stretch * part.mesh.position.topRows(2)).colwise() + Vector2d(5, -7)};
        const Vector3d direction = Vector3d(2, 1, 0).normalized();
        const OriginalResults found = on_original(part, blank, fields_on(part.mesh, direction));
        const TriMesh& mesh = found.part.mesh;
        ASSERT_EQ(mesh.triangles(), 2 * 14 * 9);
        EXPECT_FALSE(found.part.remeshed);
        const Eigen::Matrix2Xd truth = (stretch * mesh.position.topRows(2)).colwise() + Vector2d(5, -7);
        // boundary vertices, too
        EXPECT_LT((found.blank.position - truth).cwiseAbs().maxCoeff(), 1e-9) << size;
        const SheetFields expected = fields_on(mesh, direction);
        EXPECT_LT((found.face.strain_major - expected.strain_major).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((found.face.strain_minor - expected.strain_minor).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((found.face.stress_major - expected.stress_major).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((found.face.stress_minor - expected.stress_minor).cwiseAbs().maxCoeff(), 1e-9);
        for (int f = 0; f < mesh.triangles(); ++f)
            EXPECT_NEAR(std::abs(found.face.direction_major.col(f).dot(direction)), 1, 1e-12);
        // a constant on each new triangle stands for what changes by 0.0022 per mm
        EXPECT_LT((found.face.thinning - expected.thinning).cwiseAbs().maxCoeff(), 0.0022 * 0.7 * size);
        EXPECT_LT((found.face.thickness - expected.thickness).cwiseAbs().maxCoeff(), 0.0044 * 0.7 * size);
    }
}

TEST_F(OriginalResultsTest, KeepTheVolumeOfTheSheet)
{
    const auto plate = [](double u, double v) { return Vector3d(100 * u, 60 * v, 0); };
    const PartFile part = read(deck(5, 3, plate), 4);
    const SheetFields fields = fields_on(part.mesh, Vector3d::UnitX());
    const OriginalResults found = on_original(part, {part.mesh.position.topRows(2)}, fields);
    const auto volume = [](const TriMesh& mesh, const SheetFields& face) {
        return area_vectors(mesh).colwise().norm().dot(face.thickness.transpose());
    };
    EXPECT_NEAR(volume(found.part.mesh, found.face), volume(part.mesh, fields), 2e-4 * volume(part.mesh, fields));
}

TEST_F(OriginalResultsTest, BothBanksOfASeamLieOnTheirOwnSide)
{
    const double radius = 30;
    const auto tube = [&](double u, double v) {
        return Vector3d(radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), 90 * v);
    };
    const PartFile part = read(deck(40, 12, tube, true), 5);
    ASSERT_FALSE(part.seam.empty());
    // Where the seam is, and how far round from it each new vertex lies; on a bank as far as the
    // faces beside it say.
    const Vector3d start = part.remeshed->original->position.col(
        std::lower_bound(part.remeshed->original_vertex.begin(), part.remeshed->original_vertex.end(),
                         part.seam[0].front()) -
        part.remeshed->original_vertex.begin());
    const double seam = std::atan2(start.y(), start.x());
    const auto turn = [&](const Vector3d& p) {
        const double t = std::atan2(p.y(), p.x()) - seam;
        return t - 2 * pi * std::floor(t / (2 * pi));
    };
    const auto unrolled = [&](const TriMesh& mesh) {
        Eigen::Matrix2Xd flat(2, mesh.vertices());
        for (int f = 0; f < mesh.triangles(); ++f) {
            const double around = turn(mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean());
            for (const int v : mesh.triangle.col(f)) {
                double t = turn(mesh.position.col(v));
                t += t - around > pi ? -2 * pi : around - t > pi ? 2 * pi : 0;
                flat.col(v) = Vector2d(radius * t, mesh.position(2, v));
            }
        }
        return flat;
    };
    const OriginalResults found = on_original(part, {unrolled(part.mesh)}, fields_on(part.mesh, Vector3d::UnitZ()));
    const Eigen::Matrix2Xd truth = unrolled(found.part.mesh);
    EXPECT_GT(truth.row(0).maxCoeff() - truth.row(0).minCoeff(), 2 * pi * radius - 1e-6);
    // chords of 5 mm; a wrong side is 188 mm off
    EXPECT_LT((found.blank.position - truth).cwiseAbs().maxCoeff(), 0.3);
    // and what is written has every element of the deck once
    const PartShells shells = part_shells(found.part);
    EXPECT_EQ(shells.mesh.elements(), 40 * 12);
    const BlankShells flat = blank_shells(found.part, shells, found.blank, found.face);
    EXPECT_EQ(flat.mesh.elements(), 40 * 12);
    EXPECT_EQ(std::set<std::int64_t>(flat.mesh.element.begin(), flat.mesh.element.end()).size(), 480u);
}

TEST_F(OriginalResultsTest, AreTheSameOnOneThreadAndTwoAndRefusedWithoutADeck)
{
    const auto dish = [](double u, double v) { return Vector3d(100 * u, 60 * v, 20 * u * v); };
    const PartFile part = read(deck(9, 7, dish), 4);
    const Blank blank{part.mesh.position.topRows(2)};
    const SheetFields fields = fields_on(part.mesh, {1, 2, 0.3});
    const auto with = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return on_original(part, blank, fields);
    };
    const OriginalResults one = with(1), two = with(2);
    EXPECT_EQ(one.blank.position, two.blank.position);
    EXPECT_EQ(one.face.thickness, two.face.thickness);
    EXPECT_EQ(one.face.direction_major, two.face.direction_major);
    EXPECT_THROW(on_original(one.part, one.blank, one.face), InputError); // as it was read
    // the blank of other vertices
    EXPECT_THROW(on_original(part, one.blank, fields), InputError);
    ReadOptions options;
    options.remesh.emplace();
    const PartFile other = read_part(fs::path(SPIA_SOURCE_DIR) / "assets/parts/dome.obj", options);
    EXPECT_THROW(on_original(other, {other.mesh.position.topRows(2)}, fields_on(other.mesh, {1, 0, 0})), InputError);
}

const fs::path dome = fs::path(SPIA_SOURCE_DIR) / "assets/parts/dome.obj";

TEST(RemeshedNumbers, FacesOfTheFileAreTheTrianglesOnThem)
{
    const PartFile given = read_part(dome);
    for (const double size : {2.0, 14.0}) {
        ReadOptions options;
        options.remesh.emplace().size = size;
        const PartFile part = read_part(dome, options);
        std::vector<int> left;
        const double middle = given.mesh.position.row(0).mean();
        for (int f = 0; f < given.mesh.triangles(); ++f)
            if (given.mesh.position(0, Eigen::all)(given.mesh.triangle.col(f)).mean() < middle)
                left.push_back(given.source_face[size_t(f)]);
        const std::vector<char> chosen = faces_called(part, left);
        const Eigen::VectorXd each = area_vectors(part.mesh).colwise().norm();
        for (int f = 0; f < part.mesh.triangles(); ++f) {
            const double x = part.mesh.position(0, Eigen::all)(part.mesh.triangle.col(f)).mean();
            const double edge = std::sqrt(4 / std::sqrt(3.0) * area(given.mesh) / given.mesh.triangles());
            if (std::abs(x - middle) > edge) { // both sides of the border are the file's triangles
                EXPECT_EQ(bool(chosen[size_t(f)]), x < middle) << f;
            }
        }
        EXPECT_GT(
            each.dot(Eigen::Map<const Eigen::Array<char, Eigen::Dynamic, 1>>(chosen.data(), Eigen::Index(chosen.size()))
                         .cast<double>()
                         .matrix()),
            0.4 * area(part.mesh));
    }
}

TEST(RemeshedNumbers, AFaceSmallerThanTheTrianglesIsTheOneAroundItsMiddle)
{
    ReadOptions options;
    options.remesh.emplace().size = 14;
    const PartFile part = read_part(dome, options), given = read_part(dome);
    const ClosestPointSearch search(part.mesh);
    int alone = 0;
    for (const int number : {0, 11, 222, 1000}) {
        ASSERT_TRUE(has_face(part, number));
        const bool has_none = !std::binary_search(part.source_face.begin(), part.source_face.end(), number);
        alone += has_none;
        const std::vector<char> chosen = faces_called(part, std::array{number});
        if (has_none) {
            EXPECT_EQ(std::count(chosen.begin(), chosen.end(), 1), 1);
            const Vector3d middle = given.mesh.position(Eigen::all, given.mesh.triangle.col(number)).rowwise().mean();
            EXPECT_EQ(chosen[size_t(search.nearest(middle).face)], 1);
        }
    }
    EXPECT_GT(alone, 0);
    EXPECT_FALSE(has_face(part, given.file_faces));
    EXPECT_FALSE(has_face(part, -1));
}

TEST(RemeshedNumbers, TrianglesOfCadPartsAreCountedAnewAndKnowTheirFace)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/cad/battery_clip_3034.step";
    if (!fs::exists(file))
        GTEST_SKIP() << file << " is not there";
    ReadOptions options;
    options.remesh.emplace();
    const PartFile part = read_part(file, options), given = read_part(file);
    ASSERT_TRUE(part.solid); // the skin of a solid is remeshed, and its thickness taken over
    EXPECT_EQ(part.thickness_mm, given.thickness_mm);
    EXPECT_EQ(boundary_loops(part.mesh).size(), boundary_loops(given.mesh).size());
    EXPECT_EQ(part.file_faces, part.mesh.triangles());
    EXPECT_EQ(part.file_vertices, part.mesh.vertices());
    ASSERT_EQ(part.cad->face.size(), size_t(part.mesh.triangles()));
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        EXPECT_EQ(part.source_face[size_t(f)], f);
        const Vector3d middle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f)).rowwise().mean();
        double least = 1e300; // to the given triangles of the CAD face that it says
        for (int g = 0; g < given.mesh.triangles(); ++g)
            if (given.cad->face[size_t(given.source_face[size_t(g)])] == part.cad->face[size_t(f)]) {
                const Eigen::Matrix3d t = given.mesh.position(Eigen::all, given.mesh.triangle.col(g));
                least = std::min(least, (t * closest_on_triangle(t, middle) - middle).norm());
            }
        EXPECT_LE(least, part.remeshed->distance) << f;
    }
    for (const int v : {0, 5, part.mesh.vertices() - 1})
        EXPECT_EQ(vertices_called(part, v), std::vector<int>{v});
}

} // namespace
} // namespace spia::original_results_test

// What is closed: solids of sheet and hollow bodies, told apart by measuring.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/plane_faces.h"
#include "tests/support/seeded_random.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/examined_mesh.h"
#include "tests/unit/exchange/sample_compressed.h"
#include "tests/unit/exchange/sample_meshes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::closed_input_test {
namespace {

using shapes::PlaneLoop;
using shapes::ProfilePiece;
using shapes::SeededRandom;
using std::numbers::pi;

/// A solid of sheet and what is known of it.
struct KnownSheet {
    std::string name;
    TriMesh mesh;
    double thickness;
    double middle;      ///< mm2, volume / thickness
    double exact;       ///< what the thickness may be off, of it: chords of curved skins without
                        ///< flats
    bool plain = false; ///< a plate without holes: the same surface as a closed box
};

ProfilePiece flat(double length) { return {length, 0, 0}; }
ProfilePiece bend(double radius, double angle) { return {0, radius, angle}; }

/// @param share  of the thickness in the least width of the flats
std::vector<KnownSheet> sheets(double share, int chords, int divisions, std::uint64_t seed)
{
    SeededRandom random(seed);
    const double t = random.between(0.5, 8), w = t / share; // the narrowest flat on an inner side
    const auto more = [&](double least, double most) { return w * random.between(least, most); };
    std::vector<KnownSheet> result;
    const auto add = [&](std::string name, TriMesh mesh, double exact, bool plain = false) {
        mesh = shapes::divided(mesh, divisions);
        double volume = 0;
        for (int f = 0; f < mesh.triangles(); ++f)
            volume += mesh.position.col(mesh.triangle(0, f))
                          .dot(mesh.position.col(mesh.triangle(1, f)).cross(mesh.position.col(mesh.triangle(2, f)))) /
                      6;
        mesh = shapes::permuted(shapes::transformed(mesh, shapes::random_rotation(seed + result.size()),
                                                    {random.between(-50, 50), random.between(-50, 50), 7}),
                                seed)
                   .mesh;
        result.push_back({fmt::format("{} (t {:.3g} of {:.3g}, {} chords, {} divisions, seed {})", name, t, w, chords,
                                      divisions, seed),
                          mesh, t, volume / t, exact, plain});
    };
    const auto rectangle = [](double a, double b) { return PlaneLoop{{0, 0}, {a, 0}, {a, b}, {0, b}}; };
    const double a = more(1, 2), b = more(1, 1.5);
    add("plate", shapes::extruded(rectangle(a, b), {}, t), 1e-6, true);
    add("plate with holes",
        shapes::extruded(rectangle(3 * w, 2.2 * w),
                         {shapes::circle({0.8 * w, 0.8 * w}, 0.3 * w, 4 * chords, true),
                          shapes::circle({2.1 * w, 1.1 * w}, 0.5 * w, 4 * chords, true)},
                         t),
        1e-6);
    const double length = more(1, 2), r = t * random.between(0.1, 2);
    const auto bent = [&](const std::string& name, const std::vector<ProfilePiece>& pieces) {
        add(name, shapes::extruded(shapes::sheet_section(pieces, t, chords), {}, length), 1e-6);
    };
    bent("bracket", {flat(more(1, 2)), bend(r, pi / 2), flat(more(1, 2))});
    bent("open bracket", {flat(more(1, 2)), bend(r, random.between(0.3, 1.3)), flat(more(1, 2))});
    bent("channel", {flat(more(1, 2)), bend(r, pi / 2), flat(more(1, 2)), bend(r, pi / 2), flat(more(1, 2))});
    bent("step", {flat(more(1, 2)), bend(r, pi / 2), flat(more(1, 2)), bend(r, -pi / 2), flat(more(1, 2))});
    bent("hat", {flat(more(1, 2)), bend(r, pi / 2), flat(more(1, 1.5)), bend(r, -pi / 2), flat(more(1, 2)),
                 bend(r, -pi / 2), flat(more(1, 1.5)), bend(r, pi / 2), flat(more(1, 2))});
    bent("hem", {flat(more(2, 3)), bend(random.between(0.1, 0.5) * t, pi), flat(more(1, 2))});
    bent("knuckle", {flat(more(1, 2)), bend(random.between(0.6, 1.5) * t, random.between(1.1, 1.45) * pi)});
    // Sharp edges inside and outside.
    const double leg = more(1, 2) + t, foot = more(1, 2) + t;
    add("mitred bracket", shapes::extruded({{0, 0}, {foot, 0}, {foot, t}, {t, t}, {t, leg}, {0, leg}}, {}, length),
        1e-6);
    const double inside = t * random.between(0.3, 3);
    add("tube",
        shapes::extruded(shapes::circle({0, 0}, inside + t, 8 * chords, false),
                         {shapes::circle({0, 0}, inside, 8 * chords, true)}, std::max(length, 2 * t)),
        1e-6);
    // An open box of walls with sharp edges.
    const double x = more(1, 2), y = more(1, 2), h = more(1, 1.5);
    shapes::PlaneFaces box;
    const auto p = [](double px, double py, double pz) { return Eigen::Vector3d(px, py, pz); };
    const double X = x + 2 * t, Y = y + 2 * t, H = h + t;
    box.add({p(0, 0, 0), p(0, Y, 0), p(X, Y, 0), p(X, 0, 0)});
    box.add({p(0, 0, 0), p(X, 0, 0), p(X, 0, H), p(0, 0, H)});
    box.add({p(X, 0, 0), p(X, Y, 0), p(X, Y, H), p(X, 0, H)});
    box.add({p(X, Y, 0), p(0, Y, 0), p(0, Y, H), p(X, Y, H)});
    box.add({p(0, Y, 0), p(0, 0, 0), p(0, 0, H), p(0, Y, H)});
    box.add({p(0, 0, H), p(X, 0, H), p(X, Y, H), p(0, Y, H)},
            {{p(t, t, H), p(t, Y - t, H), p(X - t, Y - t, H), p(X - t, t, H)}});
    box.add({p(t, t, t), p(X - t, t, t), p(X - t, Y - t, t), p(t, Y - t, t)});
    box.add({p(t, t, H), p(X - t, t, H), p(X - t, t, t), p(t, t, t)});
    box.add({p(X - t, t, H), p(X - t, Y - t, H), p(X - t, Y - t, t), p(X - t, t, t)});
    box.add({p(X - t, Y - t, H), p(t, Y - t, H), p(t, Y - t, t), p(X - t, Y - t, t)});
    box.add({p(t, Y - t, H), p(t, t, H), p(t, t, t), p(t, Y - t, t)});
    add("open box", box.mesh(), 1e-6);
    return result;
}

std::vector<std::pair<std::string, TriMesh>> hollow_bodies(int around, int divisions, std::uint64_t seed)
{
    SeededRandom random(seed);
    std::vector<std::pair<std::string, TriMesh>> result;
    const auto add = [&](const std::string& name, const TriMesh& mesh) {
        result.emplace_back(fmt::format("{} ({} around, {} divisions, seed {})", name, around, divisions, seed),
                            shapes::transformed(shapes::divided(mesh, divisions),
                                                shapes::random_rotation(seed + result.size()), {5, -20, 3}));
    };
    const double a = random.between(30, 60);
    const auto rectangle = [](double x, double y) { return PlaneLoop{{0, 0}, {x, 0}, {x, y}, {0, y}}; };
    add("cube", shapes::extruded(rectangle(a, a), {}, a));
    add("box", shapes::extruded(rectangle(a, a * random.between(1, 1.5)), {}, a * random.between(0.7, 2)));
    add("long box", shapes::extruded(rectangle(a, a * random.between(1, 1.15)), {}, 8 * a));
    for (const double height : {1.0, 2.0, 10.0}) // the diameter of the shortest is its height, too
        add(fmt::format("closed tube {} diameters long", height),
            shapes::extruded(shapes::circle({0, 0}, a / 2, around, false), {}, height * a));
    add("prism of six sides", shapes::extruded(shapes::circle({0, 0}, a, 6, false), {}, 3 * a));
    add("bottle",
        shapes::turned({{0, 0}, {a, 0}, {a, 2 * a}, {0.3 * a, 2.6 * a}, {0.3 * a, 3.2 * a}, {0, 3.2 * a}}, around));
    add("cone", shapes::turned({{0, 0}, {a, 0}, {0.2 * a, 2 * a}, {0, 2 * a}}, around));
    PlaneLoop capsule;
    for (int i = 0; i <= 8; ++i)
        capsule.emplace_back(i == 0 ? 0 : a * std::sin(pi / 16 * i), -a * std::cos(pi / 16 * i));
    for (int i = 8; i >= 0; --i)
        capsule.emplace_back(i == 0 ? 0 : a * std::sin(pi / 16 * i), 2 * a + a * std::cos(pi / 16 * i));
    add("capsule", shapes::turned(capsule, around));
    PlaneLoop lens;
    for (int i = 0; i <= 10; ++i)
        lens.emplace_back(i == 0 || i == 10 ? 0 : a * std::sin(pi / 10 * i), -0.3 * a * std::cos(pi / 10 * i));
    add("lens", shapes::turned(lens, around));
    return result;
}

} // namespace

TEST(ClosedInput, SheetIsTakenHoweverThickForItsSize)
{
    std::uint64_t seed = 1;
    int count = 0, doubted = 0;
    for (const double share : {0.02, 0.05, 0.1, 0.2, 0.3, 0.4})
        for (const auto& [chords, divisions] : {std::pair(3, 0), {4, 0}, {6, 1}, {4, 2}})
            for (const KnownSheet& known : sheets(share, chords, divisions, seed++)) {
                SCOPED_TRACE(known.name);
                const PartFile part = examined(known.mesh, {});
                ++count;
                if (!part.solid) {
                    ADD_FAILURE() << "not taken: " << texts_of(part);
                    continue;
                }
                EXPECT_NEAR(part.solid->thickness, known.thickness, known.exact * known.thickness);
                const bool doubt = std::any_of(part.doubts.begin(), part.doubts.end(), [](const std::string& text) {
                    return text.find("hollow body") != std::string::npos &&
                           text.find(mention(option::seam, "FILE")) != std::string::npos;
                });
                doubted += doubt;
                EXPECT_FALSE(share <= 0.1 && doubt) << texts_of(part);
                EXPECT_TRUE(share < 0.29 || !known.plain || doubt) << "a closed box, too";
                // Chords of the middle lie nearer to each other than those of the skins, by 1 - cos
                // of half their angle.
                EXPECT_NEAR((part.solid->outer_area + part.solid->inner_area) / 2, known.middle, 0.04 * known.middle);
            }
    RecordProperty("sheets", count);
    RecordProperty("doubted", doubted);
    EXPECT_GE(count, 250);
    EXPECT_LT(doubted, count / 5);
}

TEST(ClosedInput, HollowBodiesStayWhatTheyAre)
{
    std::uint64_t seed = 1;
    for (const int around : {7, 8, 12, 16, 40})
        for (const int divisions : {0, 2})
            for (const auto& [name, mesh] : hollow_bodies(around, divisions, seed++)) {
                SCOPED_TRACE(name);
                const PartFile part = examined(mesh);
                EXPECT_FALSE(part.solid) << texts_of(part);
                EXPECT_FALSE(part.seam.empty()) << "it is cut open";
            }
    for (const TriMesh& mesh :
         {shapes::closed_sphere(30, 2000), shapes::torus(50, 12, 3000), shapes::torus(50, 3, 6000)})
        EXPECT_FALSE(examined(mesh).solid);
}

TEST(ClosedInput, SaysWhatItIsNotSureOf)
{
    const auto tin = [](double height) { return shapes::extruded(shapes::circle({0, 0}, 40, 48, false), {}, height); };
    const PartFile disk = examined(tin(5)), tall = examined(tin(24)), taller = examined(tin(34));
    ASSERT_TRUE(disk.solid);
    EXPECT_TRUE(disk.doubts.empty());
    ASSERT_TRUE(tall.solid);
    ASSERT_EQ(tall.doubts.size(), 1u);
    EXPECT_NE(tall.doubts[0].find(mention(option::seam, "FILE")), std::string::npos);
    EXPECT_FALSE(taller.solid);
    ASSERT_EQ(taller.doubts.size(), 1u);
    EXPECT_NE(taller.doubts[0].find(mention(option::skin, "middle")), std::string::npos);
    const PartFile asked = examined(tin(34), Skin::outer);
    ASSERT_TRUE(asked.solid) << texts_of(asked);
    EXPECT_NEAR(asked.solid->thickness, 34, 1e-9);
    EXPECT_TRUE(asked.doubts.empty());
}

TEST(ClosedInput, PlatesWhoseHolesTouchAreSheet)
{
    // Both holes have the edge across the thickness: it belongs to four faces. A plate of squares,
    // two of them left out.
    for (const double t : {1., 4.})
        for (const std::uint64_t seed : {0, 1, 2}) {
            constexpr int columns = 6, rows = 4;
            const auto there = [](int i, int j) {
                const bool inside = i >= 0 && j >= 0 && i < columns && j < rows;
                return inside && !(i == 2 && j == 1) && !(i == 3 && j == 2);
            };
            shapes::PlaneFaces faces;
            const auto at = [](int i, int j, double z) { return Eigen::Vector3d(10 * i, 10 * j, z); };
            for (int i = 0; i < columns; ++i)
                for (int j = 0; j < rows; ++j) {
                    if (!there(i, j))
                        continue;
                    faces.add({at(i, j, t), at(i + 1, j, t), at(i + 1, j + 1, t), at(i, j + 1, t)});
                    faces.add({at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0)});
                    const int corner[5][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}, {i, j}};
                    const bool rim[] = {!there(i, j - 1), !there(i + 1, j), !there(i, j + 1), !there(i - 1, j)};
                    for (int k = 0; k < 4; ++k) {
                        const auto &a = corner[k], &b = corner[k + 1];
                        if (rim[k])
                            faces.add({at(a[0], a[1], 0), at(b[0], b[1], 0), at(b[0], b[1], t), at(a[0], a[1], t)});
                    }
                }
            const TriMesh mesh =
                shapes::permuted(shapes::transformed(faces.mesh(), shapes::random_rotation(seed), {1, 2, 3}), seed)
                    .mesh;
            const PartFile part = examined(mesh);
            ASSERT_TRUE(part.solid) << texts_of(part);
            EXPECT_TRUE(part.doctor.healthy()) << texts_of(part);
            EXPECT_NEAR(part.solid->thickness, t, 1e-9);
            EXPECT_NEAR(area(part.mesh), 100 * (columns * rows - 2), 1e-9);
        }
}

TEST(ClosedInput, CountersinksAreEdgesOfHolesAndNoSkin)
{
    constexpr int around = 48;
    const double z = 3;
    for (const double angle : {60., 82., 90., 100., 120., 126.}) // degrees between its sides
        for (const double depth : {1., 2., 2.7}) {
            // mm, its radius above; that of the hole is 3
            const double wide = 3 + depth * std::tan(angle / 2 * pi / 180);
            SCOPED_TRACE(fmt::format("{} degrees, {} mm deep", angle, depth));
            const auto ring = [&](double radius, double height) {
                shapes::Loop loop;
                for (const Eigen::Vector2d& p : shapes::circle({50, 30}, radius, around, false))
                    loop.emplace_back(p.x(), p.y(), height);
                return loop;
            };
            const auto reversed = [](shapes::Loop loop) {
                std::reverse(loop.begin(), loop.end());
                return loop;
            };
            const shapes::Loop upper = {{0, 0, z}, {100, 0, z}, {100, 60, z}, {0, 60, z}};
            shapes::PlaneFaces faces;
            const shapes::Loop top = ring(wide, z), waist = ring(3, z - depth), foot = ring(3, 0);
            faces.add(upper, {reversed(top)});
            faces.add({{0, 0, 0}, {0, 60, 0}, {100, 60, 0}, {100, 0, 0}}, {foot});
            for (size_t i = 0; i < 4; ++i) {
                const Eigen::Vector3d &a = upper[i], &b = upper[(i + 1) % 4];
                faces.add({{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, b, a});
            }
            for (const auto& [above, below] : {std::pair(top, waist), {waist, foot}})
                for (size_t i = 0; i < around; ++i) {
                    const size_t next = (i + 1) % around;
                    faces.add({above[i], above[next], below[next], below[i]});
                }
            const PartFile part = examined(faces.mesh());
            ASSERT_TRUE(part.solid) << texts_of(part);
            EXPECT_NEAR(part.solid->thickness, z, 1e-9);
            EXPECT_NEAR(part.solid->least, z, 1e-9) << "nothing thinner is taken for sheet";
            EXPECT_EQ(part.doctor.boundary_loops, 2);
            const Eigen::Vector3d size =
                part.mesh.position.rowwise().maxCoeff() - part.mesh.position.rowwise().minCoeff();
            EXPECT_LT((size - Eigen::Vector3d(100, 60, 0)).norm(), 1e-9) << "the middle is plane";
        }
}

TEST(ClosedInput, PlatesWithChamfersOnBothSidesHaveTheSizeOfTheirWalls)
{
    const double z = 3;
    for (const double c : {0.1, 0.3, 0.5, 1.}) { // mm, of all edges
        SCOPED_TRACE(c);
        const auto ring = [&](double inset, double height) {
            return shapes::Loop{{inset, inset, height},
                                {80 - inset, inset, height},
                                {80 - inset, 50 - inset, height},
                                {inset, 50 - inset, height}};
        };
        const auto hole = [&](double more, double height) {
            shapes::Loop loop;
            for (const Eigen::Vector2d& p : shapes::circle({40, 25}, 6 + more, 64, true))
                loop.emplace_back(p.x(), p.y(), height);
            return loop;
        };
        const auto reversed = [](shapes::Loop loop) {
            std::reverse(loop.begin(), loop.end());
            return loop;
        };
        shapes::PlaneFaces faces;
        faces.add(ring(c, z), {hole(c, z)});
        faces.add(reversed(ring(c, 0)), {reversed(hole(c, 0))});
        for (const auto& rings : {std::array<shapes::Loop, 4>{ring(c, 0), ring(0, c), ring(0, z - c), ring(c, z)},
                                  {hole(c, 0), hole(0, c), hole(0, z - c), hole(c, z)}})
            for (size_t k = 0; k < 3; ++k)
                for (size_t i = 0; i < rings[k].size(); ++i) {
                    const size_t next = (i + 1) % rings[k].size();
                    faces.add({rings[k][i], rings[k][next], rings[k + 1][next], rings[k + 1][i]});
                }
        const PartFile part = examined(faces.mesh());
        ASSERT_TRUE(part.solid) << texts_of(part);
        EXPECT_EQ(part.doctor.boundary_loops, 2);
        const Eigen::Vector3d size = part.mesh.position.rowwise().maxCoeff() - part.mesh.position.rowwise().minCoeff();
        EXPECT_LT((size - Eigen::Vector3d(80, 50, 0)).norm(), 1e-9) << size.transpose();
        EXPECT_NEAR(area(part.mesh), 80 * 50 - 32 * 36 * std::sin(2 * pi / 64), 1e-2);
    }
}

/// A format and who writes it.
struct Written {
    const char* name; ///< of the test and, up to "_", after it the ending of the file
    std::string (*content)(const TriMesh&);
};

std::ostream& operator<<(std::ostream& out, const Written& written) { return out << written.name; }

std::string glb_of(const TriMesh& mesh)
{
    std::string bytes;
    for (int v = 0; v < mesh.vertices(); ++v)
        for (int k = 0; k < 3; ++k)
            sample::append(bytes, float(mesh.position(k, v)));
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            sample::append(bytes, uint32_t(mesh.triangle(k, f)));
    const int places = 12 * mesh.vertices(), corners = 12 * mesh.triangles();
    return sample::glb(fmt::format(
                           R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},
                         {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],
            "buffers":[{{"byteLength":{}}}]}})",
                           mesh.vertices(), 3 * mesh.triangles(), places, places, corners, places + corners),
                       bytes);
}

std::string gmsh_of(const TriMesh& mesh)
{
    std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.vertices());
    for (int v = 0; v < mesh.vertices(); ++v)
        text += fmt::format("{} {} {} {}\n", v + 1, mesh.position(0, v), mesh.position(1, v), mesh.position(2, v));
    text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.triangles());
    for (int f = 0; f < mesh.triangles(); ++f)
        text += fmt::format("{} 2 2 1 1 {} {} {}\n", f + 1, mesh.triangle(0, f) + 1, mesh.triangle(1, f) + 1,
                            mesh.triangle(2, f) + 1);
    return text + "$EndElements\n";
}

std::string abaqus_of(const TriMesh& mesh)
{
    std::string text = "*NODE\n";
    for (int v = 0; v < mesh.vertices(); ++v)
        text += fmt::format("{}, {}, {}, {}\n", v + 1, mesh.position(0, v), mesh.position(1, v), mesh.position(2, v));
    text += "*ELEMENT, TYPE=S3, ELSET=SKIN\n";
    for (int f = 0; f < mesh.triangles(); ++f)
        text += fmt::format("{}, {}, {}, {}\n", f + 1, mesh.triangle(0, f) + 1, mesh.triangle(1, f) + 1,
                            mesh.triangle(2, f) + 1);
    return text;
}

class ClosedFile : public testing::TestWithParam<Written> {
protected:
    PartFile read(const TriMesh& mesh)
    {
        const std::string name = GetParam().name;
        const std::filesystem::path file = folder_ / ("part." + name.substr(0, name.find('_')));
        put(file, GetParam().content(mesh));
        ReadOptions options;
        options.unit = LengthUnit::mm;
        return read_part(file, options);
    }

private:
    ScratchFolder folder_;
};

TEST_P(ClosedFile, OfSheetHasItsThicknessAndAHollowBodyHasNone)
{
    for (const double t : {0.8, 2., 7.}) {
        SCOPED_TRACE(t);
        const PartFile part =
            read(shapes::extruded(shapes::sheet_section({flat(22), bend(3, pi / 2), flat(37)}, t, 6), {}, 30));
        ASSERT_TRUE(part.solid) << texts_of(part);
        EXPECT_NEAR(part.solid->thickness, t, 2e-5) << "single precision";
        EXPECT_EQ(part.doctor.boundary_loops, 1) << "one surface of it, not both";
    }
    const PartFile body = read(shapes::extruded({{0, 0}, {30, 0}, {30, 40}, {0, 40}}, {}, 50));
    EXPECT_FALSE(body.solid) << texts_of(body);
    EXPECT_FALSE(body.seam.empty()) << "it is cut open";
}

INSTANTIATE_TEST_SUITE_P(
    Formats, ClosedFile,
    testing::Values(Written{"stl_text", sample::stl_text}, Written{"stl_binary", sample::stl_binary},
                    Written{"obj", sample::obj_text}, Written{"off", sample::off_text},
                    Written{"ply_text", sample::ply_text},
                    Written{"ply_little", [](const TriMesh& m) { return sample::ply_binary(m, false); }},
                    Written{"ply_big", [](const TriMesh& m) { return sample::ply_binary(m, true); }},
                    Written{"glb_plain", glb_of},
                    Written{"glb_meshopt", [](const TriMesh& m) { return sample::glb_by_meshopt(m); }},
                    Written{"glb_draco", [](const TriMesh& m) { return sample::glb_by_draco(m); }},
                    Written{"msh", gmsh_of}, Written{"inp", abaqus_of}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(ClosedDeck, OfShellsWithAThicknessIsAHollowBody)
{
    const ScratchFolder folder;
    const TriMesh mesh = shapes::extruded({{0, 0}, {60, 0}, {60, 40}, {0, 40}}, {}, 2);
    const std::string deck = abaqus_of(mesh);
    put(folder / "plate.inp", deck);
    put(folder / "box.inp", deck + "*MATERIAL, NAME=STEEL\n*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n0.7\n");
    const PartFile plate = read_part(folder / "plate.inp"), box = read_part(folder / "box.inp");
    ASSERT_TRUE(plate.solid);
    EXPECT_NEAR(plate.solid->thickness, 2, 1e-12);
    EXPECT_FALSE(box.solid) << texts_of(box);
    EXPECT_EQ(box.thickness_mm, 0.7);
    EXPECT_FALSE(box.seam.empty());
}

// ../shared/cases, K2.
TEST(SharedCases, SheetsWithoutACadSolidHaveTheirThickness)
{
    const std::filesystem::path cases = std::filesystem::path(SPIA_SOURCE_DIR) / "../shared/cases";
    if (!std::filesystem::exists(cases / "08-plate.stl"))
        GTEST_SKIP() << "no " << cases;
    ReadOptions options;
    options.skin = Skin::middle;
    const PartFile plate = read_part(cases / "08-plate.stl"), bracket = read_part(cases / "08-lbracket.igs"),
                   middle = read_part(cases / "08-lbracket.igs", options);
    ASSERT_TRUE(plate.solid);
    EXPECT_NEAR(plate.solid->thickness, 3, 3e-6);
    EXPECT_EQ(plate.doctor.boundary_loops, 4);
    EXPECT_TRUE(plate.doubts.empty());
    ASSERT_TRUE(bracket.solid);
    EXPECT_NEAR(bracket.solid->thickness, 2, 2e-6);
    EXPECT_NEAR(area(middle.mesh), 71.283 * 30, 3e-4 * 71.283 * 30) << "of chords";
}

} // namespace spia::closed_input_test

#include "app/viewer/model/picking/vertex_picking.h"

#include <chrono>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

const glm::dvec2 window(800, 600);

/// Hides parts of itself from most sides.
const TriMesh& channel()
{
    static const TriMesh mesh = shapes::lipped_channel({.length = 80, .triangles = 1500}).mesh;
    return mesh;
}

Eigen::Vector3d backwards(const Camera& camera)
{
    const glm::dvec3 z = camera.turn * glm::dvec3(0, 0, 1);
    return {z.x, z.y, z.z};
}

/// Whether the line from a vertex to the eye meets a face that does not touch the vertex, by trying
/// all. Parallel sight.
bool covered(const TriMesh& mesh, int v, const Eigen::Vector3d& to_eye)
{
    const Eigen::Vector3d from = mesh.position.col(v);
    for (int g = 0; g < mesh.triangles(); ++g) {
        const auto t = mesh.triangle.col(g);
        const Eigen::Vector3d a = mesh.position.col(t[0]);
        Eigen::Matrix3d system;
        system << mesh.position.col(t[1]) - a, mesh.position.col(t[2]) - a, -to_eye;
        if ((t.array() == v).any() || std::abs(system.determinant()) < 1e-9)
            continue;
        const Eigen::Vector3d uvt = system.inverse() * (from - a);
        if (uvt[0] >= 0 && uvt[1] >= 0 && uvt[0] + uvt[1] <= 1 && uvt[2] > 1e-9)
            return true;
    }
    return false;
}

/// Of some vertices the one in sight that is nearest to a pixel, by trying all.
std::optional<int> nearest(const TriMesh& mesh, const std::vector<int>& vertices, const Camera& camera,
                           glm::dvec2 pixel, double reach)
{
    std::optional<int> best;
    for (const int v : vertices) {
        const double away = glm::length(glm::dvec2(pixel_of(camera, mesh.position.col(v), window)) - pixel);
        if (away < reach && !covered(mesh, v, backwards(camera))) {
            reach = away;
            best = v;
        }
    }
    return best;
}

std::vector<int> all_of(const TriMesh& mesh)
{
    std::vector<int> all;
    for (int v = 0; v < mesh.vertices(); ++v)
        all.push_back(v);
    return all;
}

} // namespace

TEST(VertexPicking, TakesTheVertexInSightThatIsNearestToThePixel)
{
    const TriMesh& mesh = channel();
    const RayPicker picker(mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(100, 700), y(50, 550);
    int found = 0, nothing = 0, behind = 0;
    for (const glm::dvec2 drag : {glm::dvec2(0, 0), glm::dvec2(130, -40), glm::dvec2(-20, 260)}) {
        const Camera camera =
            fit(orbit(look({}, StandardView::isometric), drag, window), picker.box(), window.x / window.y);
        for (int i = 0; i < 60; ++i) {
            const PickVertex pick{.pixel = {x(random), y(random)}, .size = window, .reach = 15};
            const auto expected = nearest(mesh, all_of(mesh), camera, pick.pixel, pick.reach);
            EXPECT_EQ(vertex_at(pick, camera, mesh, picker), expected);
            ++(expected ? found : nothing);
        }
        for (int v = 0; v < mesh.vertices(); v += 5) // on a hidden one there is another one, or
                                                     // none
            if (covered(mesh, v, backwards(camera))) {
                const glm::dvec2 pixel(pixel_of(camera, mesh.position.col(v), window));
                EXPECT_NE(vertex_at({.pixel = pixel, .size = window}, camera, mesh, picker), v);
                ++behind;
            }
    }
    EXPECT_GT(found, 40);
    EXPECT_GT(nothing, 20);
    EXPECT_GT(behind, 40);
}

TEST(VertexPicking, OfVerticesOnOneLineOfSightTheOneInFrontIsTaken)
{
    // A wall seen from its edge hides nothing, and its two ends are at one pixel.
    const TriMesh wall{(Eigen::Matrix3Xd(3, 4) << 0, 10, 0, 10, 0, 0, 0, 0, -5, -5, 5, 5).finished(),
                       (Eigen::Matrix3Xi(3, 2) << 0, 1, 1, 3, 2, 2).finished()};
    const RayPicker picker(wall);
    const Camera camera = fit(look({}, StandardView::top), picker.box(), window.x / window.y);
    const glm::dvec2 pixel(pixel_of(camera, {10, 0, 0}, window));
    EXPECT_EQ(vertex_at({.pixel = pixel, .size = window}, camera, wall, picker), 3);
    EXPECT_EQ(boundary_vertex_at({.pixel = pixel, .size = window}, camera, wall, boundary_vertices(wall), picker), 3);
    const Camera below = fit(look({}, StandardView::bottom), picker.box(), window.x / window.y);
    const glm::dvec2 there(pixel_of(below, {10, 0, 0}, window));
    EXPECT_EQ(vertex_at({.pixel = there, .size = window}, below, wall, picker), 1);
}

TEST(VertexPicking, TheBoundaryIsFoundFromBesideTheSheetAndItsSharpTurnsFirst)
{
    const TriMesh plate = shapes::plate({}); // 120 x 80, holes of radius 12
    const RayPicker picker(plate);
    const BoundaryVertices boundary = boundary_vertices(plate);
    size_t on_loops = 0;
    for (const auto& loop : boundary_loops(plate)) {
        on_loops += loop.size();
        for (const int v : loop)
            EXPECT_TRUE(std::binary_search(boundary.vertex.begin(), boundary.vertex.end(), v));
    }
    EXPECT_EQ(boundary.vertex.size(), on_loops);

    const Camera camera{.target = {60, 40, 0}, .height = 120}; // 5 pixels per mm
    const auto at = [&](double x, double y, bool only_boundary) -> std::optional<Eigen::Vector3d> {
        const PickVertex pick{.pixel = pixel_of(camera, {x, y, 0}, window), .size = window, .boundary = only_boundary};
        const auto v = only_boundary ? boundary_vertex_at(pick, camera, plate, boundary, picker)
                                     : vertex_at(pick, camera, plate, picker);
        return v ? std::optional<Eigen::Vector3d>(plate.position.col(*v)) : std::nullopt;
    };
    ASSERT_TRUE(at(121.8, 81, true)); // 10 pixels beside the corner
    EXPECT_LT((*at(121.8, 81, true) - Eigen::Vector3d(120, 80, 0)).norm(), 1e-9);
    ASSERT_TRUE(at(1.5, -0.5, true)); // 8 pixels from the corner, nearer to another one
    EXPECT_LT(at(1.5, -0.5, true)->norm(), 1e-9);
    const auto beside = at(60, -1.8, true);
    ASSERT_TRUE(beside);
    EXPECT_LT(std::abs(beside->y()), 1e-9);
    EXPECT_FALSE(at(60, -3, true)); // 15 pixels
    EXPECT_TRUE(at(60, -1.8, false));
    for (int i = 0; i < 50; ++i) {
        const double x = 10 + 2 * i, y = 6 + i;
        const auto v = at(x, y, true);
        double least = 12. / 5;
        for (const int b : boundary.vertex)
            least = std::min(least, (plate.position.col(b) - Eigen::Vector3d(x, y, 0)).norm());
        EXPECT_EQ(v.has_value(), least < 12. / 5);
        EXPECT_NEAR(v ? (*v - Eigen::Vector3d(x, y, 0)).norm() : 12. / 5, least, 1e-9);
    }
}

TEST(VertexPicking, TheBoundaryBehindTheSheetIsNotTaken)
{
    const TriMesh& mesh = channel();
    const RayPicker picker(mesh);
    const BoundaryVertices boundary = boundary_vertices(mesh);
    const Camera camera = fit(look({}, StandardView::isometric), picker.box(), window.x / window.y);
    int hidden = 0;
    for (const int v : boundary.vertex) {
        const PickVertex pick{.pixel = pixel_of(camera, mesh.position.col(v), window), .size = window, .reach = 0.5};
        const bool behind = covered(mesh, v, backwards(camera));
        EXPECT_EQ(boundary_vertex_at(pick, camera, mesh, boundary, picker) == v, !behind);
        hidden += behind;
    }
    EXPECT_GT(hidden, 5);
}

TEST(VertexPicking, ARectanglesTurnsAreItsCornersInAnyPositionAndACircleHasNone)
{
    const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    const TriMesh sheet = shapes::transformed(shapes::rectangle(60, 40, 60, 40), turn.matrix(), {7, 8, 9});
    const BoundaryVertices boundary = boundary_vertices(sheet);
    std::vector<int> sharp;
    for (size_t i = 0; i < boundary.vertex.size(); ++i)
        if (boundary.sharp[i])
            sharp.push_back(boundary.vertex[i]);
    EXPECT_EQ(sharp, (std::vector<int>{0, 60, 40 * 61, 40 * 61 + 60}));

    constexpr int n = 200;
    TriMesh disc{Eigen::Matrix3Xd::Zero(3, n + 1), Eigen::Matrix3Xi(3, n)};
    for (int i = 0; i < n; ++i) {
        disc.position.col(i) << 50 * std::cos(2 * M_PI * i / n), 50 * std::sin(2 * M_PI * i / n), 0;
        disc.triangle.col(i) << i, (i + 1) % n, n;
    }
    for (const char each : boundary_vertices(disc).sharp)
        EXPECT_FALSE(each);
}

TEST(VertexPicking, CornersComeInTheOrderOfTheOutline)
{
    const std::vector<int> outline = {0, 7, 3, 9, 4, 1}, in_file = {0, 2, 4, 6, 8, 10, 12, 14, 16, 18};
    EXPECT_EQ(corners_of({1, 3, 4, 7}, outline, in_file), (std::array{7, 3, 4, 1}));
    const auto refusal = [&](const std::vector<int>& vertices) -> std::string {
        try {
            corners_of(vertices, outline, in_file);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal({1}).find("1 vertex is picked"), std::string::npos);
    EXPECT_NE(refusal({0, 1, 3, 5}).find("Vertex 10 is not on the outer outline"), std::string::npos);
}

TEST(VertexPicking, AMillionTrianglesAreSearchedWhileTheMouseMoves)
{
    const TriMesh sheet = shapes::rectangle(1000, 500, 1000, 500);
    const RayPicker picker(sheet);
    const Camera camera = fit(look({}, StandardView::isometric), picker.box(), window.x / window.y);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> x(200, 600), y(200, 400);
    const auto start = std::chrono::steady_clock::now();
    constexpr int moves = 200;
    for (int i = 0; i < moves; ++i)
        vertex_at({.pixel = {x(random), y(random)}, .size = window}, camera, sheet, picker);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    // The yardstick, on the same machine under the same load: where all vertices are in the view,
    // once.
    const auto again = std::chrono::steady_clock::now();
    glm::dvec3 sum(0);
    for (int v = 0; v < sheet.vertices(); ++v)
        sum += pixel_of(camera, sheet.position.col(v), window);
    const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - again;
    EXPECT_TRUE(std::isfinite(sum.x));
    EXPECT_LT(taken.count() / moves, all.count() / 5);
}

} // namespace spia::viewer

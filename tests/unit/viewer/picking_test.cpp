#include "app/viewer/model/picking.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "app/viewer/model/flat_mesh.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

const glm::dvec2 size(800, 600);

Eigen::Vector3d middle(const TriMesh& mesh, int f)
{
    return mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
}

/// Whether the segment from the middle of face f to the eye meets another face, by trying all.
bool covered(const TriMesh& mesh, int f, const Eigen::Vector3d& direction_to_eye)
{
    const Eigen::Vector3d from = middle(mesh, f);
    for (int g = 0; g < mesh.triangles(); ++g) {
        const auto t = mesh.triangle.col(g);
        const Eigen::Vector3d a = mesh.position.col(t[0]);
        Eigen::Matrix3d system;
        system << mesh.position.col(t[1]) - a, mesh.position.col(t[2]) - a, -direction_to_eye;
        if (g == f || std::abs(system.determinant()) < 1e-9)
            continue;
        const Eigen::Vector3d uvt = system.inverse() * (from - a);
        if (uvt[0] >= 0 && uvt[1] >= 0 && uvt[0] + uvt[1] <= 1 && uvt[2] > 1e-9)
            return true;
    }
    return false;
}

/// Hides parts of itself from most sides.
const TriMesh& channel()
{
    static const TriMesh mesh = shapes::lipped_channel({.length = 80, .triangles = 1500}).mesh;
    return mesh;
}

std::vector<Camera> cameras(const Eigen::AlignedBox3d& box)
{
    std::vector<Camera> result;
    for (const bool perspective : {false, true})
        for (const glm::dvec2 drag : {glm::dvec2(0, 0), glm::dvec2(130, -40), glm::dvec2(-20, 260)}) {
            Camera camera;
            camera.perspective = perspective;
            result.push_back(fit(orbit(look(camera, StandardView::isometric), drag, size), box, size.x / size.y));
        }
    return result;
}

Eigen::Vector3d to_eye(const Camera& camera, const Eigen::Vector3d& from)
{
    glm::dvec3 z = camera.turn * glm::dvec3(0, 0, 1);
    const Eigen::Vector3d backwards(z.x, z.y, z.z);
    if (!camera.perspective)
        return backwards;
    const double distance = camera.height / 2 / std::tan(15 * M_PI / 180);
    return Eigen::Vector3d(camera.target.x, camera.target.y, camera.target.z) + distance * backwards - from;
}

/// Inside a polygon, by the angle that its corners turn around the place.
bool inside(const std::vector<glm::dvec2>& polygon, glm::dvec2 p)
{
    double turned = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - p, b = polygon[(i + 1) % polygon.size()] - p;
        turned += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return std::abs(turned) > 3;
}

/// A star with many corners around the middle of the view.
std::vector<glm::dvec2> lasso()
{
    std::vector<glm::dvec2> result;
    for (int i = 0; i < 90; ++i) {
        const double angle = i * 2 * M_PI / 90, radius = i % 2 ? 220 : 120;
        result.push_back(size / 2. + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return result;
}

} // namespace

TEST(Picking, AClickOnTheMiddleOfAFaceThatIsSeenTakesThisFace)
{
    const TriMesh& mesh = channel();
    const RayPicker picker(mesh);
    const RegionSearch regions(mesh);
    for (const Camera& camera : cameras(picker.box()))
        for (int f = 0; f < mesh.triangles(); f += 7) {
            const glm::dvec3 p = pixel_of(camera, middle(mesh, f), size);
            const FaceSet found = faces_at({.pixel = p, .size = size}, camera, picker, regions);
            ASSERT_EQ(found.size(), 1);
            EXPECT_EQ(found[0] == f, !covered(mesh, f, to_eye(camera, middle(mesh, f))));
        }
}

TEST(Picking, AClickBesideTheSheetTakesNothing)
{
    const RayPicker picker(channel());
    const RegionSearch regions(channel());
    EXPECT_TRUE(faces_at({.pixel = {2, 2}, .size = size}, cameras(picker.box())[0], picker, regions).empty());
}

TEST(Picking, FloodAndSmoothRegionFollowThePartEvenOnItsBlank)
{
    const shapes::DevelopablePart part = shapes::hat_channel({.triangles = 2000});
    const TriMesh flat = flat_mesh(part.mesh, {part.flat});
    const RayPicker picker(flat);
    const RegionSearch regions(part.mesh);
    const Camera camera = fit({.flat = true}, picker.box(), size.x / size.y);
    const int face = part.mesh.triangles() / 2;
    PickAt pick{.view = View::blank, .pixel = pixel_of(camera, middle(flat, face), size), .size = size};
    EXPECT_EQ(faces_at(pick, camera, picker, regions), FaceSet{face});
    pick.flood = 3;
    EXPECT_EQ(faces_at(pick, camera, picker, regions), regions.flood(face, 3 * M_PI / 180));
    EXPECT_LT(int(regions.flood(face, 3 * M_PI / 180).size()), part.mesh.triangles());
    pick.smooth = true;
    EXPECT_EQ(faces_at(pick, camera, picker, regions), regions.smooth_region(face));
}

TEST(Picking, ALassoTakesTheFacesWhoseMiddleItHoldsAndOnlyThoseInSightUnlessThrough)
{
    const TriMesh& mesh = channel();
    const RayPicker picker(mesh);
    int hidden = 0;
    for (const Camera& camera : cameras(picker.box())) {
        FaceSet through, seen;
        for (int f = 0; f < mesh.triangles(); ++f)
            if (inside(lasso(), pixel_of(camera, middle(mesh, f), size))) {
                through.push_back(f);
                if (!covered(mesh, f, to_eye(camera, middle(mesh, f))))
                    seen.push_back(f);
            }
        PickArea pick{.polygon = lasso(), .size = size};
        EXPECT_EQ(faces_in(pick, camera, mesh, picker), seen);
        pick.through = true;
        EXPECT_EQ(faces_in(pick, camera, mesh, picker), through);
        EXPECT_GT(seen.size(), 20);
        hidden += int(through.size() - seen.size());
    }
    EXPECT_GT(hidden, 100);
}

TEST(Picking, AnAreaBeyondTheViewTakesOnlyWhatTheViewShows)
{
    const TriMesh plate = shapes::rectangle(80, 60, 16, 12);
    const RayPicker picker(plate);
    Camera camera; // the view shows 80 mm x 60 mm
    camera.height = 60;
    camera.target = {80, 30, 0}; // the right half of the plate
    const PickArea all{.polygon = {{-900, -900}, {900, -900}, {900, 900}, {-900, 900}}, .size = size};
    const FaceSet found = faces_in(all, camera, plate, picker);
    EXPECT_EQ(int(found.size()), plate.triangles() / 2);
    for (const int f : found)
        EXPECT_GT(middle(plate, f).x(), 40);
    EXPECT_TRUE(faces_in({.polygon = {}, .size = size}, camera, plate, picker).empty());
}

TEST(Picking, AWallSeenFromItsEdgeIsNotInSight)
{
    TriMesh wall = shapes::rectangle(80, 60, 16, 12);
    wall.position.row(1).swap(wall.position.row(2)); // upright
    const RayPicker picker(wall);
    PickArea pick{.polygon = {{0, 0}, {800, 0}, {800, 600}, {0, 600}}, .size = size};
    Camera camera = fit({}, picker.box(), size.x / size.y);
    EXPECT_TRUE(faces_in(pick, camera, wall, picker).empty());
    camera = orbit(camera, {0, 1}, size); // by 0.3 degrees
    EXPECT_FALSE(faces_in(pick, camera, wall, picker).empty());
    pick.through = true;
    EXPECT_EQ(int(faces_in(pick, camera, wall, picker).size()), wall.triangles());
}

TEST(Picking, ABrushTakesWhatItsCircleHoldsAndTheFaceUnderIt)
{
    const TriMesh& mesh = channel();
    const RayPicker picker(mesh);
    for (const Camera& camera : cameras(picker.box())) {
        const glm::dvec2 at(420, 280);
        const int under = hit_at(camera, picker, at, size).face;
        FaceSet truth;
        for (int f = 0; f < mesh.triangles(); ++f)
            if (f == under || (glm::length(glm::dvec2(pixel_of(camera, middle(mesh, f), size)) - at) <= 60 &&
                               !covered(mesh, f, to_eye(camera, middle(mesh, f)))))
                truth.push_back(f);
        EXPECT_EQ(faces_under({.pixel = at, .radius = 60, .size = size}, camera, mesh, picker), truth);
        const FaceSet alone = under < 0 ? FaceSet{} : FaceSet{under};
        EXPECT_EQ(faces_under({.pixel = at, .radius = 0.01, .size = size}, camera, mesh, picker), alone);
    }
}

TEST(Picking, TheModeSaysWhatBecomesOfTheSelection)
{
    EXPECT_EQ(picked({1, 4, 7}, {4, 9}, PickMode::replace), (FaceSet{4, 9}));
    EXPECT_EQ(picked({1, 4, 7}, {4, 9}, PickMode::add), (FaceSet{1, 4, 7, 9}));
    EXPECT_EQ(picked({1, 4, 7}, {4, 9}, PickMode::remove), (FaceSet{1, 7}));
}

TEST(Picking, AProbeStandsWhereTheMousePointsOrOnAVertexNearIt)
{
    const TriMesh plate = shapes::rectangle(80, 60, 4, 3); // edges of 200 pixels
    const RayPicker picker(plate);
    Camera camera;
    camera.height = 60;
    camera.target = {40, 30, 0};
    const auto place = [&](const Probe& probe) -> Eigen::Vector3d {
        return plate.position(Eigen::all, plate.triangle.col(probe.face)) * probe.barycentric;
    };
    const auto free = probe_at(camera, plate, picker, {290, 270}, size);
    ASSERT_TRUE(free);
    EXPECT_LT((place(*free) - Eigen::Vector3d(29, 33, 0)).norm(), 1e-9);
    const auto snapped = probe_at(camera, plate, picker, {205, 205}, size); // the vertex is at (200, 200)
    ASSERT_TRUE(snapped);
    EXPECT_LT((place(*snapped) - Eigen::Vector3d(20, 40, 0)).norm(), 1e-12);
    EXPECT_EQ(snapped->barycentric.maxCoeff(), 1);
    camera.target = {400, 30, 0};
    EXPECT_FALSE(probe_at(camera, plate, picker, {290, 270}, size));
}

TEST(Picking, ACornerFollowsTheOutlineAndSnapsToSharpTurns)
{
    const shapes::Plate shape; // 120 x 80, holes of radius 12
    const TriMesh plate = shapes::plate(shape);
    const Blank blank{plate.position.topRows<2>()};
    const CornerTrack track = corner_track(plate, blank);
    std::vector<Eigen::Vector2d> sharp;
    for (const int v : track.sharp)
        sharp.push_back(blank.position.col(v));
    ASSERT_EQ(sharp.size(), 4); // the four corners of the plate
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {120, 0}, {120, 80}, {0, 80}})
        EXPECT_TRUE(std::any_of(sharp.begin(), sharp.end(), [&](const auto& s) { return (s - corner).norm() < 1e-9; }));
    for (const int v : track.vertex) { // the holes are no place for a corner
        const Eigen::Vector2d p = blank.position.col(v);
        EXPECT_LT(std::min({p.x(), p.y(), 120 - p.x(), 80 - p.y()}), 1e-9);
    }

    Camera camera{.target = {60, 40, 0}, .height = 120, .flat = true}; // 5 pixels per mm
    const auto vertex_at = [&](double x, double y, double snap) -> Eigen::Vector2d {
        const glm::dvec2 pixel = pixel_of(camera, {x, y, 0}, size);
        return blank.position.col(nearest_boundary_vertex(track, camera, pixel, size, snap));
    };
    EXPECT_LT((vertex_at(2, 1, 12) - Eigen::Vector2d(0, 0)).norm(), 1e-9); // 11 pixels from the corner
    EXPECT_EQ(vertex_at(3.2, 0, 12), vertex_at(3.2, 0, 0));                // 16 pixels
    EXPECT_GT(vertex_at(3.2, 0, 12).norm(), 1);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-20, 140), y(-20, 100);
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d at(x(random), y(random));
        double least = 1e300;
        for (const int v : track.vertex)
            least = std::min(least, (blank.position.col(v) - at).norm());
        EXPECT_NEAR((vertex_at(at.x(), at.y(), 0) - at).norm(), least, 1e-9);
    }
}

TEST(Picking, ASmoothOutlineHasNoSharpTurnsAndARoundedCornerOneInItsMiddle)
{
    // A rectangle of 100 x 60 with corners of radius 8, and a circle, as fans around their middle.
    const auto fan = [](const std::vector<Eigen::Vector2d>& outline) {
        const int n = int(outline.size());
        TriMesh mesh{Eigen::Matrix3Xd::Zero(3, n + 1), Eigen::Matrix3Xi(3, n)};
        for (int i = 0; i < n; ++i) {
            mesh.position.col(i).head<2>() = outline[size_t(i)];
            mesh.triangle.col(i) << i, (i + 1) % n, n;
        }
        return mesh;
    };
    std::vector<Eigen::Vector2d> circle, rounded;
    for (int i = 0; i < 400; ++i)
        circle.push_back(50 * Eigen::Vector2d(std::cos(i * M_PI / 200), std::sin(i * M_PI / 200)));
    for (int corner = 0; corner < 4; ++corner) {
        const double sign_x = corner == 0 || corner == 3 ? 1 : -1, sign_y = corner < 2 ? 1 : -1;
        for (int i = 0; i <= 20; ++i) {
            const double angle = (corner + i / 20.) * M_PI / 2;
            rounded.emplace_back(sign_x * 42 + 8 * std::cos(angle), sign_y * 22 + 8 * std::sin(angle));
        }
    }
    const auto sharp = [&](const std::vector<Eigen::Vector2d>& outline) {
        const TriMesh mesh = fan(outline);
        return corner_track(mesh, {mesh.position.topRows<2>()}).sharp;
    };
    EXPECT_TRUE(sharp(circle).empty());
    EXPECT_EQ(sharp(rounded), (std::vector<int>{10, 31, 52, 73}));
}

} // namespace spia::viewer

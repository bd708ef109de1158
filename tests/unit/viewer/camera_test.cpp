#include "app/viewer/model/picking/camera.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace spia::viewer {
namespace {

const glm::dvec2 screen(1280, 720);
const Eigen::AlignedBox3d box(Eigen::Vector3d(-30, 10, -5), Eigen::Vector3d(90, 60, 55));

std::vector<Camera> cameras()
{
    std::vector<Camera> result;
    for (const bool perspective : {false, true})
        for (const StandardView view :
             {StandardView::top, StandardView::bottom, StandardView::front, StandardView::back, StandardView::left,
              StandardView::right, StandardView::isometric}) {
            Camera camera;
            camera.perspective = perspective;
            camera.target = {20, 30, 10};
            camera.height = 140;
            result.push_back(look(camera, view));
            result.push_back(orbit(result.back(), {70, -130}, screen));
        }
    return result;
}

Eigen::Vector3d random_place(std::mt19937& random)
{
    std::uniform_real_distribution<double> share(0, 1);
    const Eigen::Vector3d at(share(random), share(random), share(random));
    return box.min() + at.cwiseProduct(box.sizes());
}

Eigen::Vector3d towards_viewer(const Camera& camera)
{
    const glm::dvec3 z = camera.turn * glm::dvec3(0, 0, 1);
    return {z.x, z.y, z.z};
}

/// Where the matrices that the renderer gets put a place.
glm::dvec3 pixel_by_matrices(const Camera& camera, const Eigen::Vector3d& place)
{
    const Eigen::Vector3d origin(400, -700, 90), from_origin = place - origin;
    const glm::dvec4 clip = projection_matrix(camera, screen.x / screen.y, box) * view_matrix(camera, origin) *
                            glm::dvec4(from_origin.x(), from_origin.y(), from_origin.z(), 1);
    const glm::dvec3 p = glm::dvec3(clip) / clip.w;
    return {(p.x + 1) / 2 * screen.x, (1 - p.y) / 2 * screen.y, p.z};
}

double apart(glm::dvec2 a, glm::dvec2 b) { return glm::length(a - b); }

} // namespace

TEST(Camera, TheRayThroughThePixelOfAPlaceMeetsThePlace)
{
    std::mt19937 random(3);
    for (const Camera& camera : cameras())
        for (int i = 0; i < 50; ++i) {
            const Eigen::Vector3d place = random_place(random);
            const Ray ray = ray_through(camera, box, pixel_of(camera, place, screen), screen);
            EXPECT_NEAR(ray.direction.norm(), 1, 1e-14);
            EXPECT_LT(ray.direction.cross(place - ray.origin).norm(), 1e-9);
            EXPECT_GT(ray.direction.dot(place - ray.origin), 0); // it starts in front
        }
}

TEST(Camera, TheRendererSeesEveryPlaceWherePickingSeesIt)
{
    std::mt19937 random(4);
    for (const Camera& camera : cameras())
        for (int i = 0; i < 50; ++i) {
            const Eigen::Vector3d place = random_place(random);
            const glm::dvec3 drawn = pixel_by_matrices(camera, place), picked = pixel_of(camera, place, screen);
            EXPECT_LT(apart(drawn, picked), 1e-8);
            EXPECT_LT(std::abs(drawn.z), 1); // between near and far
            const Eigen::Vector3d nearer = place + 0.5 * towards_viewer(camera);
            EXPECT_LT(pixel_by_matrices(camera, nearer).z, drawn.z);
            EXPECT_NEAR(pixel_of(camera, nearer, screen).z - picked.z, 0.5, 1e-12);
        }
}

TEST(Camera, OneMillimetreAtTheTargetHasTheSameSizeWithAndWithoutPerspective)
{
    for (Camera camera : cameras()) {
        const Eigen::Vector3d target(camera.target.x, camera.target.y, camera.target.z);
        const glm::dvec3 up = camera.turn * glm::dvec3(0, 1, 0);
        const Eigen::Vector3d above = target + Eigen::Vector3d(up.x, up.y, up.z);
        for (int i = 0; i < 2; ++i, camera.perspective = !camera.perspective) {
            EXPECT_LT(apart(pixel_of(camera, target, screen), screen / 2.), 1e-9);
            EXPECT_LT(apart(pixel_of(camera, above, screen), {640, 360 - 720. / 140}), 1e-9);
        }
    }
}

TEST(Camera, PerspectiveSpansThirtyDegreesFromBottomToTop)
{
    Camera camera;
    camera.perspective = true;
    const Ray top = ray_through(camera, box, {640, 0}, screen), bottom = ray_through(camera, box, {640, 720}, screen);
    EXPECT_NEAR(std::acos(top.direction.dot(bottom.direction)) * 180 / M_PI, 30, 1e-10);
}

TEST(Camera, APlaceBehindTheEyeHasNoPixel)
{
    Camera camera;
    camera.perspective = true; // the eye is 187 mm above the target
    EXPECT_TRUE(std::isnan(pixel_of(camera, {1, 2, 190}, screen).x));
    camera.perspective = false;
    EXPECT_NEAR(pixel_of(camera, {0, 0, 190}, screen).x, 640, 1e-9);
}

TEST(Camera, FitShowsAllCornersAndLeavesLittleRoom)
{
    for (const Camera& camera : cameras())
        for (const double aspect : {0.4, 1., 16. / 9}) {
            const glm::dvec2 pixels(aspect * 900, 900);
            const Camera fitted = fit(camera, box, aspect);
            EXPECT_EQ(fitted.turn, camera.turn);
            glm::dvec2 least(1e300), greatest(-1e300);
            for (int i = 0; i < 8; ++i) {
                const glm::dvec2 p = pixel_of(fitted, box.corner(Eigen::AlignedBox3d::CornerType(i)), pixels);
                least = glm::min(least, p);
                greatest = glm::max(greatest, p);
            }
            const glm::dvec2 filled = (greatest - least) / pixels;
            EXPECT_GT(std::min(least.x, least.y), 0);
            EXPECT_LT(std::max(greatest.x / pixels.x, greatest.y / pixels.y), 1);
            EXPECT_GT(std::max(filled.x, filled.y), 0.9);
        }
}

TEST(Camera, FitToPointsKeepsTheMarginsAndTouchesTwoOfThemOppositeEachOther)
{
    const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, 60) * 70;
    const Margins margins{96, 24, 30, 20};
    for (const Camera& camera : cameras())
        for (const glm::dvec2 pixels : {glm::dvec2(900, 400), {300, 700}}) {
            const Camera fitted = fit(camera, points, pixels, margins);
            EXPECT_EQ(fitted.turn, camera.turn);
            glm::dvec2 least(1e300), greatest(-1e300);
            for (const auto point : points.colwise()) {
                const glm::dvec2 p = pixel_of(fitted, point, pixels);
                least = glm::min(least, p);
                greatest = glm::max(greatest, p);
            }
            const double left = least.x - margins.left, right = pixels.x - margins.right - greatest.x,
                         top = least.y - margins.top, bottom = pixels.y - margins.bottom - greatest.y;
            EXPECT_GT(std::min({left, right, top, bottom}), -1e-6);
            EXPECT_LT(std::min(std::max(left, right), std::max(top, bottom)), 1e-6);
            if (!camera.perspective) {
                EXPECT_NEAR(left, right, 1e-6) << "in the middle";
                EXPECT_NEAR(top, bottom, 1e-6);
            }
        }
    const Camera narrow = fit({}, points, {60, 400}, {96, 24, 24, 24}); // more margin than view
    EXPECT_TRUE(std::isfinite(narrow.height));
}

TEST(Camera, FitOfAPointALineOrNothingStaysFinite)
{
    const Eigen::Vector3d point(3, 4, 5);
    for (const Camera& camera : cameras()) {
        EXPECT_EQ(fit(camera, {}, 1.5), camera);
        const Camera at_point = fit(camera, Eigen::AlignedBox3d(point, point), 1.5);
        EXPECT_GT(at_point.height, 0);
        EXPECT_LT(apart(pixel_of(at_point, point, screen), screen / 2.), 1e-6);
        for (int axis = 0; axis < 3; ++axis) {
            const Camera at_line =
                fit(camera, Eigen::AlignedBox3d(point, point + 50 * Eigen::Vector3d::Unit(axis)), 1.5);
            EXPECT_GE(at_line.height, 0.05 - 1e-12);
        }
    }
}

TEST(Camera, ZoomKeepsThePlaceUnderThePixelThereAndScalesTheRest)
{
    const glm::dvec2 pixel(300, 500);
    for (const Camera& camera : cameras())
        for (const double factor : {0.5, 1.1, 20.}) {
            const Camera nearer = zoom(camera, factor, pixel, screen);
            const Ray ray = ray_through(camera, box, pixel, screen);
            EXPECT_NEAR(nearer.height, camera.height / factor, 1e-12);
            for (const double along : {20., 60.}) { // wherever on the ray the part is
                if (const glm::dvec3 p = pixel_of(nearer, ray.origin + along * ray.direction, screen);
                    !std::isnan(p.x)) {
                    EXPECT_LT(apart(p, pixel), 1e-7);
                }
            }
        }
}

TEST(Camera, ZoomingWithoutEndStaysFinite)
{
    Camera camera;
    for (int i = 0; i < 2000; ++i)
        camera = zoom(camera, 2, {0, 0}, screen);
    EXPECT_GT(camera.height, 0);
    for (int i = 0; i < 4000; ++i)
        camera = zoom(camera, 0.5, {0, 0}, screen);
    EXPECT_TRUE(std::isfinite(camera.height) && std::isfinite(glm::length(camera.target)));
}

TEST(Camera, PanTakesThePlaceUnderTheMouseAlong)
{
    const glm::dvec2 pixel(300, 500), drag(-120, 45);
    for (const Camera& camera : cameras()) {
        const Ray ray = ray_through(camera, box, pixel, screen);
        const Eigen::Vector3d target(camera.target.x, camera.target.y, camera.target.z);
        const Eigen::Vector3d z = towards_viewer(camera);
        const Eigen::Vector3d place = ray.origin + (target - ray.origin).dot(z) / ray.direction.dot(z) * ray.direction;
        EXPECT_LT(apart(pixel_of(pan(camera, drag, screen), place, screen), pixel + drag), 1e-8);
    }
}

TEST(Camera, OrbitTurnsWhatIsInFrontWithTheMouseAboutTheTarget)
{
    for (const Camera& camera : cameras()) {
        const Eigen::Vector3d target(camera.target.x, camera.target.y, camera.target.z);
        const Eigen::Vector3d front = target + 10 * towards_viewer(camera);
        const glm::dvec2 before = pixel_of(camera, front, screen);
        EXPECT_GT(pixel_of(orbit(camera, {30, 0}, screen), front, screen).x, before.x + 1);
        EXPECT_NEAR(pixel_of(orbit(camera, {30, 0}, screen), front, screen).y, before.y, 1e-9);
        EXPECT_GT(pixel_of(orbit(camera, {0, 30}, screen), front, screen).y, before.y + 1);
        EXPECT_NEAR(pixel_of(orbit(camera, {0, 30}, screen), front, screen).x, before.x, 1e-9);
        // across the shorter side, half a turn: what was in front is behind
        EXPECT_NEAR(pixel_of(orbit(camera, {0, 720}, screen), front, screen).z, -10, 1e-9);
    }
}

TEST(Camera, AFlatCameraNeverLeavesItsPlane)
{
    Camera camera;
    camera.flat = true;
    EXPECT_EQ(orbit(camera, {40, 25}, screen), pan(camera, {40, 25}, screen));
    for (const StandardView view : {StandardView::front, StandardView::isometric, StandardView::bottom})
        EXPECT_EQ(towards_viewer(look(camera, view)), Eigen::Vector3d(0, 0, 1));
}

TEST(Camera, StandardViewsStandWhereTheirNamesSayWithUpwardsUp)
{
    const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const auto check = [&](StandardView view, const Eigen::Vector3d& viewer, const Eigen::Vector3d& up) {
        const Camera camera = look(Camera{}, view);
        EXPECT_LT((towards_viewer(camera) - viewer).norm(), 1e-15);
        const glm::dvec3 place = pixel_of(camera, up, screen);
        EXPECT_NEAR(place.x, screen.x / 2, 1e-9);
        EXPECT_LT(place.y, screen.y / 2);
    };
    check(StandardView::top, z, y);
    check(StandardView::bottom, -z, -y);
    check(StandardView::front, -y, z);
    check(StandardView::back, y, z);
    check(StandardView::right, x, z);
    check(StandardView::left, -x, z);
    check(StandardView::isometric, Eigen::Vector3d(1, -1, 1).normalized(), z);
}

TEST(Camera, OnTheWayItTurnsEvenlyAndByTheShorterSide)
{
    Camera from, to;
    from.height = 50;
    to.height = 200;
    to.target = {10, 20, 30};
    // the same turn, its other sign
    to.turn = -glm::angleAxis(glm::radians(80.), glm::normalize(glm::dvec3(1, 2, 3)));
    EXPECT_EQ(between(from, to, 0).height, 50);
    EXPECT_EQ(between(from, to, 0).target, from.target);
    EXPECT_NEAR(between(from, to, 1).height, 200, 1e-9);
    for (const double share : {0.25, 0.5, 0.75}) {
        const Camera now = between(from, to, share);
        EXPECT_NEAR(2 * std::acos(std::abs(now.turn.w)), glm::radians(80 * share), 1e-9);
        EXPECT_NEAR(now.height, 50 * std::pow(4., share), 1e-9);
        EXPECT_NEAR(glm::length(now.target - share * to.target), 0, 1e-9);
    }
}

} // namespace spia::viewer

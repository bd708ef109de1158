#include "tests/support/shape_family.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/rings.h"
#include "tests/support/seeded_random.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Cells of a grid_surface() of about so many triangles, as even as the lengths of its sides allow.
GridPlan cells(int triangles, double across, double up, bool around = false)
{
    const double n = triangles / 2.0;
    const int columns = std::max(around ? 6 : 2, int(std::lround(std::sqrt(n * across / up))));
    return {columns, std::max(2, int(std::lround(n / columns))), around, false};
}

Vector3d polar(double angle, double r, double z) { return {r * std::cos(angle), r * std::sin(angle), z}; }

// Each maker draws its measures at random and makes one shape of about n triangles.

TriMesh undercut(SeededRandom& random, int n)
{
    return lipped_channel({.top = random.between(30, 90),
                           .wall = random.between(15, 60),
                           .flange = random.between(6, 25),
                           .lip = random.between(3, 12),
                           .radius = random.between(1, 8),
                           .length = random.between(40, 200),
                           .triangles = n})
        .mesh;
}

/// A can with a floor and upright or leaning walls, open above.
TriMesh box_with_walls(SeededRandom& random, int n)
{
    const double width = random.between(40, 120), depth = random.between(40, 120), height = random.between(10, 90);
    const double lean = random.between(-0.35, 0.25); // of the height: below zero the mouth is
                                                     // narrower than the floor
    const int side = std::max(2, int(std::lround(std::sqrt(n / 2.0 / (1 + 4 * height / width)))));
    const int up = std::max(1, int(std::lround(side * height / width)));
    std::set<Cell> block;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < up; ++k)
                block.insert({i, j, k});
    TriMesh mesh =
        body_surface(block, 1, 1, [](const Cell&, const Eigen::Vector3i& outwards) { return outwards[2] > 0; });
    for (auto x : mesh.position.colwise()) {
        const double z = x[2] / up, grow = 1 + 2 * lean * z * height / width;
        x << (x[0] / side - 0.5) * width * grow, (x[1] / side - 0.5) * depth * grow, z * height;
    }
    return mesh;
}

TriMesh cup_with_flange(SeededRandom& random, int n)
{
    const double corner = random.between(6, 16);
    return square_cup({.punch = random.between(50, 90),
                       .corner_radius = corner,
                       .punch_radius = random.between(2, 0.9 * corner),
                       .die_radius = random.between(2, 8),
                       .depth = random.between(20, 60),
                       .flange_width = random.between(5, 30),
                       .triangles = n});
}

/// A sheet rolled up, neighbouring turns a gap apart.
TriMesh spiral(SeededRandom& random, int n)
{
    const double turns = random.between(1.2, 4.5), gap = random.between(2, 10), inner = random.between(5, 25);
    const double width = random.between(30, 120), cone = random.coin() ? 0 : random.between(0, 0.5);
    const double length = 2 * pi * turns * (inner + gap * turns / 2);
    return grid_surface(cells(n, length, width), [=](double u, double v) {
        const double angle = 2 * pi * turns * u;
        return polar(angle, inner + gap * turns * u + cone * width * v, width * v);
    });
}

TriMesh slit_tube(SeededRandom& random, int n)
{
    const double radius = random.between(10, 50), length = random.between(20, 300),
                 slit = std::pow(10, random.between(-4, 0));
    const double top = radius * random.between(0.5, 1.5);
    return grid_surface(cells(n, 2 * pi * radius, length), [=](double u, double v) {
        return polar((2 * pi - slit) * u, radius + (top - radius) * v, length * v);
    });
}

TriMesh tube(SeededRandom& random, int n)
{
    const double radius = random.between(10, 50), length = random.between(0.3, 8) * radius,
                 wave = random.between(0, 0.2);
    const double top = radius * random.between(0.4, 1.6), bend = random.coin() ? 0 : random.between(0, 1.2);
    const int lobes = random.whole(2, 5);
    return grid_surface(cells(n, 2 * pi * radius, length, true), [=](double u, double v) {
        const double angle = 2 * pi * u, r = (radius + (top - radius) * v) * (1 + wave * std::cos(lobes * angle));
        const Vector3d x = polar(angle, r, length * v); // then the axis is bent within the xz plane
        if (bend * v == 0)
            return x;
        const double along = bend * v, big = length / bend;
        return Vector3d(big - (big - x[0]) * std::cos(along), x[1], (big - x[0]) * std::sin(along));
    });
}

TriMesh branched_tube(SeededRandom& random, int n)
{
    std::set<Cell> cubes;
    const int left = random.whole(2, 5), right = random.whole(2, 5), up = random.whole(2, 5);
    const bool cross = random.coin();
    for (int i = -left; i <= right; ++i)
        cubes.insert({i, 0, 0});
    for (int j = cross ? -up : 1; j <= up; ++j)
        cubes.insert({0, j, 0});
    const int fine = std::max(1, int(std::lround(std::sqrt(n / 8.0 / double(cubes.size())))));
    return body_surface(cubes, 20, fine, [=](const Cell& c, const Eigen::Vector3i& out) {
        return (out[0] > 0 && c[0] == right) || (out[0] < 0 && c[0] == -left) || (out[1] > 0 && c[1] == up) ||
               (out[1] < 0 && cross && c[1] == -up);
    });
}

TriMesh handle_body(SeededRandom& random, int n)
{
    if (random.whole(0, 2) == 0) {
        const double big = random.between(30, 80);
        return torus(big, big * random.between(0.15, 0.7), n);
    }
    const int a = random.whole(3, 7), b = random.whole(3, 5), bars = random.whole(0, 1);
    std::set<Cell> cubes;
    for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j)
            if (i == 0 || i == a - 1 || j == 0 || j == b - 1 || (bars && i == a / 2 && a > 4))
                cubes.insert({i, j, 0});
    return body_surface(cubes, 20, std::max(1, int(std::lround(std::sqrt(n / 8.0 / double(cubes.size()))))));
}

/// A plate with an arch standing on it, like the handle of a lid.
TriMesh sheet_with_handle(SeededRandom& random, int n)
{
    const int a = random.whole(7, 11), b = random.whole(3, 7), rise = random.whole(1, 3), at = random.whole(2, a - 5);
    std::set<Cell> cubes;
    for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j)
            cubes.insert({i, j, 0});
    for (int k = 1; k <= rise + 1; ++k)
        for (int i = at; i <= at + 2; ++i)
            if (i != at + 1 || k == rise + 1)
                cubes.insert({i, b / 2, k});
    return body_surface(cubes, 15, std::max(1, int(std::lround(std::sqrt(n / 2.0 / double(a * b + 12 * rise))))),
                        [](const Cell& c, const Eigen::Vector3i& out) { return c[2] == 0 && out[2] <= 0; });
}

TriMesh closed_body(SeededRandom& random, int n)
{
    if (random.coin()) {
        TriMesh ellipsoid = closed_sphere(1, n);
        for (int k = 0; k < 3; ++k)
            ellipsoid.position.row(k) *= random.between(20, 80);
        return ellipsoid;
    }
    std::set<Cell> cubes;
    const int a = random.whole(1, 4), b = random.whole(1, 3), c = random.whole(1, 3);
    for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j)
            for (int k = 0; k < c; ++k)
                if (i == 0 || j == 0 || k == 0 || random.coin()) // its edges stay in one piece
                    cubes.insert({i, j, k});
    if (a * b * c > 3)
        for (int i = 0; i < a; ++i) // no two cubes may touch in an edge only
            for (int j = 0; j < b; ++j)
                for (int k = 0; k < c; ++k)
                    cubes.insert({i, j, k});
    const double area = 2.0 * (a * b + b * c + c * a);
    return body_surface(cubes, 30, std::max(1, int(std::lround(std::sqrt(n / 2.0 / area)))));
}

/// A bowl with a hundred windows.
TriMesh hundred_holes(SeededRandom& random, int n)
{
    const double size = 300, bulge = random.between(0, 0.004);
    const int cells_per_hole = n > 20000 ? 6 : 4, side = 10 * cells_per_hole, bar = random.whole(1, cells_per_hole - 2);
    const TriMesh whole = grid_surface({side, side}, [=](double u, double v) {
        const double x = size * (u - 0.5), y = size * (v - 0.5);
        return Vector3d(x, y, bulge * (x * x + 0.4 * y * y));
    });
    const double pitch = size / 10;
    return without_faces(whole, [=](const Vector3d& x) {
        const auto inside = [&](double t) {
            const double place = (t + size / 2) / pitch, part = (place - std::floor(place)) * cells_per_hole;
            return part > (cells_per_hole - bar) / 2 && part < (cells_per_hole - bar) / 2 + bar;
        };
        return inside(x[0]) && inside(x[1]);
    });
}

/// Long thin triangles: one direction is meshed up to fifty times finer than the other.
TriMesh anisotropic(SeededRandom& random, int n)
{
    const double aspect = random.between(15, 50), length = random.between(80, 200), width = random.between(60, 150);
    const double bow = random.between(0.2, 1.4), ripple = random.between(0, 4);
    const double cell_area = length * width / (n / 2.0);
    const bool lengthwise = random.coin();
    const double fine = std::sqrt(cell_area / aspect), coarse = fine * aspect;
    const GridPlan plan{std::max(2, int(length / (lengthwise ? coarse : fine))),
                        std::max(2, int(width / (lengthwise ? fine : coarse)))};
    return grid_surface(plan, [=](double u, double v) {
        const double angle = bow * (u - 0.5), r = length / bow;
        return Vector3d(r * std::sin(angle), width * v, r * std::cos(angle) + ripple * std::sin(4 * pi * v));
    });
}

/// A sheet whose outline is waved in every direction.
TriMesh waved_outline(SeededRandom& random, int n)
{
    std::array<double, 6> a, phase;
    for (size_t i = 0; i < a.size(); ++i) {
        a[i] = random.between(0, 0.12);
        phase[i] = random.between(0, 2 * pi);
    }
    const double lift = random.between(5, 40), saddle = random.between(0, 0.01);
    const int rows = std::max(3, int(std::lround(std::sqrt(n / 12.0))));
    std::vector<Eigen::Matrix3Xd> rings{Eigen::Matrix3Xd::Zero(3, 1)};
    for (int j = 1; j <= rows; ++j) {
        Eigen::Matrix3Xd ring(3, 6 * j);
        for (int i = 0; i < ring.cols(); ++i) {
            const double angle = 2 * pi * i / double(ring.cols()), t = double(j) / rows;
            double r = 60 * t, z = 0;
            for (size_t k = 0; k < a.size(); ++k) {
                r *= 1 + a[k] * t * std::cos(double(k + 2) * angle + phase[k]);
                z += lift * a[k] * t * t * std::sin(double(k + 1) * angle + phase[k]) * 3;
            }
            ring.col(i) = polar(angle, r, z);
            ring(2, i) += saddle * (ring(0, i) * ring(0, i) - ring(1, i) * ring(1, i));
        }
        rings.push_back(ring);
    }
    return stitch_rings(rings);
}

/// Every twentieth edge is split very near to one of its ends: needles, at one of them caps.
TriMesh needles(SeededRandom& random, int n)
{
    const double share = std::pow(10, random.between(-9, -3));
    TriMesh mesh = random.coin() ? dome({.triangles = n}).mesh : hat_channel({.length = 100, .triangles = n}).mesh;
    std::vector<Vector3d> position;
    for (const auto& x : mesh.position.colwise())
        position.emplace_back(x);
    std::vector<Eigen::Vector3i> faces;
    for (const auto& t : mesh.triangle.colwise())
        faces.emplace_back(t);
    const size_t count = faces.size();
    for (size_t f = 0; f < count; f += 20) { // a vertex inside, a share off one corner or off one
                                             // side
        const Eigen::Vector3i t = faces[f];
        const Vector3d a = position[size_t(t[0])], b = position[size_t(t[1])], c = position[size_t(t[2])];
        const bool corner = random.coin();
        const Vector3d x = corner ? Vector3d((1 - 2 * share) * a + share * b + share * c)
                                  : Vector3d(share * a + (1 - share) * (0.5 * b + 0.5 * c));
        const int v = int(position.size());
        position.push_back(x);
        faces[f] << t[0], t[1], v;
        faces.emplace_back(t[1], t[2], v);
        faces.emplace_back(t[2], t[0], v);
    }
    mesh.position = Eigen::Matrix3Xd::Map(position.data()->data(), 3, Eigen::Index(position.size()));
    mesh.triangle = Eigen::Matrix3Xi::Map(faces.data()->data(), 3, Eigen::Index(faces.size()));
    return mesh;
}

/// Every vertex is moved by up to a share of the mean edge.
TriMesh noisy(SeededRandom& random, int n)
{
    TriMesh mesh;
    switch (random.whole(0, 2)) {
    case 0: mesh = dome({.triangles = n}).mesh; break;
    case 1: mesh = saddle({.triangles = n}); break;
    default: mesh = quarter_cylinder({.triangles = n}).mesh;
    }
    const double size = mean_edge(mesh) * random.between(0.05, 0.4);
    for (double& x : mesh.position.reshaped())
        x += size * random.between(-1, 1);
    return mesh;
}

TriMesh twisted_strip(SeededRandom& random, int n)
{
    const double turns = random.between(0.5, 3), length = random.between(100, 300), width = random.between(15, 60);
    const double offset = random.coin() ? 0 : random.between(0, width);
    return grid_surface(cells(n, length, width), [=](double u, double v) {
        const double angle = 2 * pi * turns * u, r = offset + width * (v - 0.5);
        return Vector3d(length * u, r * std::cos(angle), r * std::sin(angle));
    });
}

/// A band closed to a ring after so many half twists.
TriMesh twisted_band(SeededRandom& random, int n, bool odd)
{
    const int half_twists = 2 * random.whole(odd ? 0 : 1, 2) + (odd ? 1 : 0);
    const double radius = random.between(40, 80), width = random.between(10, 0.6 * radius);
    GridPlan plan = cells(n, 2 * pi * radius, width);
    plan.columns = std::max(12, plan.columns);
    const auto place = [=](double u, double v) -> Vector3d {
        const double angle = 2 * pi * u, twist = pi * half_twists * u, t = width * (v - 0.5);
        return polar(angle, radius + t * std::cos(twist), t * std::sin(twist));
    };
    if (!odd) {
        plan.around = true;
        return grid_surface(plan, place);
    }
    TriMesh mesh = grid_surface(plan, place); // open; its last column is its first one upside down
    const int across = plan.columns + 1;
    for (int& v : mesh.triangle.reshaped())
        if (v % across == plan.columns)
            v = (plan.rows - v / across) * across;
    return without_strays(mesh);
}

/// Three sheets on one line, two sheets in one point, or a pinched one.
TriMesh crowded(SeededRandom& random, int n)
{
    const TriMesh page = rectangle(60, 40, cells(n / 3, 60, 40).columns, cells(n / 3, 60, 40).rows);
    TriMesh book = page;
    for (const double turn : {random.between(0.5, 1.5), random.between(2, 4)})
        book = joined(
            book, transformed(page, Eigen::AngleAxisd(turn, Vector3d::UnitY()).toRotationMatrix(), Vector3d::Zero()));
    // The pages share the vertices of their first edge.
    for (int& v : book.triangle.reshaped())
        if (book.position(0, v) == 0 && book.position(2, v) == 0)
            for (int w = 0; w < page.vertices(); ++w)
                if ((book.position.col(w) - book.position.col(v)).norm() < 1e-9) {
                    v = w;
                    break;
                }
    return without_strays(book);
}

TriMesh touching(SeededRandom& random, int n)
{
    TriMesh sheet =
        rectangle(80, 80, 2 * std::max(2, int(std::sqrt(n / 8.0))), 2 * std::max(2, int(std::sqrt(n / 8.0))));
    for (auto x : sheet.position.colwise())
        x[2] = 0.002 * random.between(0.5, 1.5) * x[0] * x[1];
    // Two holes that share a corner.
    return without_faces(sheet, [](const Vector3d& x) {
        return (x[0] > 20 && x[0] < 40 && x[1] > 20 && x[1] < 40) || (x[0] > 40 && x[0] < 60 && x[1] > 40 && x[1] < 60);
    });
}

TriMesh rough_ground(SeededRandom& random, int n)
{
    const double steep = random.between(0.5, 6);
    std::array<Eigen::Vector4d, 8> wave;
    for (Eigen::Vector4d& w : wave)
        w << random.between(-9, 9), random.between(-9, 9), random.between(0, 2 * pi), random.between(0.3, 1);
    return grid_surface(cells(n, 1, 1), [=](double u, double v) {
        double z = 0;
        for (const Eigen::Vector4d& w : wave)
            z += w[3] * std::sin(w[0] * u + w[1] * v + w[2]) / (1 + std::hypot(w[0], w[1]));
        return Vector3d(100 * u, 100 * v, 25 * steep * z);
    });
}

/// A sphere with a mouth, down to a small one.
TriMesh bottle(SeededRandom& random, int n)
{
    const double half_angle = random.between(95, 165);
    TriMesh mesh = sphere_cap({.radius = 40, .half_angle_deg = half_angle, .triangles = n}).mesh;
    mesh.position.row(2) *= random.between(0.6, 2.5);
    return mesh;
}

TriMesh deep_cup(SeededRandom& random, int n)
{
    const double radius = random.between(15, 40);
    return sharp_cup({.radius = radius, .height = radius * random.between(0.5, 5), .triangles = n}).mesh;
}

/// Fingers on both sides of a strip, bent.
TriMesh comb(SeededRandom& random, int n)
{
    const int fingers = random.whole(3, 8), side = std::max(4 * fingers, int(std::sqrt(n)));
    const double depth = random.between(0.2, 0.45), bend = random.between(0, 2.5);
    const TriMesh whole =
        grid_surface({2 * fingers * std::max(1, side / (2 * fingers)), std::max(8, side / 2)}, [=](double u, double v) {
            const double angle = bend * (v - 0.5);
            if (bend < 0.01)
                return Vector3d(200 * u, 100 * v, 0);
            const double r = 100 / bend;
            return Vector3d(200 * u, r * std::sin(angle), r * std::cos(angle));
        });
    return without_faces(whole, [=](const Vector3d& x) {
        const double u = x[0] / 200, v = bend < 0.01 ? x[1] / 100 : 0.5 + std::asin(x[1] * bend / 100) / bend;
        return int(u * 2 * fingers) % 2 == 1 && (v < depth || v > 1 - depth);
    });
}

/// Sharp creases, to and fro.
TriMesh accordion(SeededRandom& random, int n)
{
    const int folds = random.whole(2, 7);
    const double slope = random.between(0.5, 30), skew = random.between(0, 0.6), length = 120, width = 80;
    GridPlan plan = cells(n, length * std::min(slope, 4.0), width);
    plan.columns = folds * std::max(1, plan.columns / folds);
    return grid_surface(plan, [=](double u, double v) {
        const double place = u * folds, part = place - std::floor(place);
        const double up = int(std::floor(place)) % 2 == 0 ? part : 1 - part;
        return Vector3d(length * u + skew * width * v, width * v, slope * length / folds * up);
    });
}

TriMesh far_or_small(SeededRandom& random, int n)
{
    TriMesh mesh = random.coin() ? dome({.triangles = n}).mesh : lipped_channel({.triangles = n}).mesh;
    const double size = std::pow(10, random.between(-4, 3));
    mesh = scaled(mesh, size);
    const Vector3d away = Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) * size * 3e5;
    return transformed(mesh, random_rotation(std::uint64_t(random.whole(1, 1000))),
                       random.coin() ? away : Vector3d::Zero());
}

TriMesh flanged_ring(SeededRandom& random, int n)
{
    const double inner = random.between(20, 40), collar = random.between(2, 0.5 * inner),
                 flange = random.between(5, 40);
    const double slant = random.between(0, 0.5) * collar;
    Eigen::Matrix2Xd meridian(2, 3);
    meridian << inner, inner + slant, inner + slant + flange, collar, 0, 0;
    return axisymmetric(meridian, n).mesh;
}

TriMesh confused_orientation(SeededRandom& random, int n)
{
    TriMesh mesh = dome({.triangles = n}).mesh;
    for (auto t : mesh.triangle.colwise())
        if (random.coin())
            std::swap(t[0], t[1]);
    return mesh;
}

TriMesh several_pieces(SeededRandom& random, int n)
{
    const TriMesh one = plate({.width = 80, .height = 60, .holes = {{{40, 30}, 10}}, .triangles = n / 2});
    return joined(one, transformed(scaled(one, random.between(0.3, 0.9)), Eigen::Matrix3d::Identity(), {100, 0, 0}));
}

/// A spiral staircase: as steep as it likes around its axis, overlapping itself seen from above.
TriMesh helicoid(SeededRandom& random, int n)
{
    const double turns = random.between(1.1, 3), inner = random.between(2, 20), outer = inner + random.between(10, 50);
    const double pitch = random.between(20, 100);
    return grid_surface(cells(n, pi * turns * (inner + outer), outer - inner), [=](double u, double v) {
        return polar(2 * pi * turns * u, inner + (outer - inner) * v, pitch * turns * u);
    });
}

/// A sheet with both its skins and its edges.
TriMesh both_skins(SeededRandom& random, int n)
{
    const int side = std::max(6, int(std::sqrt(n / 4.0)));
    std::set<Cell> tiles;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            tiles.insert({i, j, 0});
    TriMesh mesh = body_surface(tiles, 200.0 / side, 1);
    const double thickness = random.between(0.5, 3), bulge = random.between(0, 0.005);
    for (auto x : mesh.position.colwise())
        x[2] = x[2] * thickness * side / 200 + bulge * (x[0] * x[0] + x[1] * x[1]);
    return mesh;
}

/// Noise beyond the size of the edges: faces over and under each other.
TriMesh crumpled(SeededRandom& random, int n)
{
    TriMesh mesh = random.coin() ? saddle({.triangles = n}) : dome({.triangles = n}).mesh;
    const double size = mean_edge(mesh) * random.between(0.6, 2);
    for (double& x : mesh.position.reshaped())
        x += size * random.between(-1, 1);
    return mesh;
}

/// A sheet drawn out into one or more long thin fingers.
TriMesh whiskers(SeededRandom& random, int n)
{
    const int count = random.whole(1, 3);
    std::array<Vector3d, 3> finger; // place, height
    for (Vector3d& f : finger)
        f << random.between(0.25, 0.75), random.between(0.25, 0.75), random.between(100, 600);
    const double width = random.between(0.04, 0.12);
    return grid_surface(cells(n, 1, 1), [=](double u, double v) {
        double z = 0;
        for (int i = 0; i < count; ++i) {
            const Vector3d& f = finger[size_t(i)];
            z += f[2] * std::exp(-(std::pow(u - f[0], 2) + std::pow(v - f[1], 2)) / (width * width));
        }
        return Vector3d(100 * u, 100 * v, z);
    });
}

/// A closed body with one single face left out.
TriMesh pinhole(SeededRandom& random, int n)
{
    TriMesh mesh =
        random.coin() ? closed_sphere(40, n) : body_surface({{0, 0, 0}}, 60, std::max(1, int(std::sqrt(n / 12.0))));
    mesh.position.row(2) *= random.between(0.5, 2);
    mesh.triangle.conservativeResize(3, mesh.triangles() - 1);
    return mesh;
}

/// As few faces as a part can have.
TriMesh tiny(SeededRandom& random, int)
{
    const int spokes = random.whole(2, 5); // a fan without its last face
    TriMesh mesh;
    mesh.position.resize(3, spokes + 1);
    mesh.position.col(0) << 0, 0, random.between(0, 20);
    for (int i = 0; i < spokes; ++i)
        mesh.position.col(i + 1) = polar(5.5 * i / spokes, random.between(5, 30), random.between(-5, 5));
    mesh.triangle.resize(3, spokes - 1);
    for (int i = 0; i + 1 < spokes; ++i)
        mesh.triangle.col(i) << 0, i + 1, i + 2;
    return mesh;
}

/// A ribbon one cell wide on a winding way, or with a bridge of one single edge.
TriMesh ribbon(SeededRandom& random, int n)
{
    const double a = random.between(1, 4), b = random.between(1, 4), c = random.between(0.5, 3),
                 width = random.between(1, 8);
    return grid_surface({n / 2, 1}, [=](double u, double v) {
        const double t = 2 * pi * u;
        return Vector3d(60 * std::sin(a * t), 60 * std::sin(b * t + 1) + width * (v - 0.5) * std::cos(t),
                        60 * std::cos(c * t) + width * (v - 0.5) * std::sin(t));
    });
}

/// Two sheets that hang together by one cell.
TriMesh bridge(SeededRandom& random, int n)
{
    const int side = 2 * std::max(3, int(std::sqrt(n / 4.0)) / 2) + 1;
    const double twist = random.between(0, 3) / side;
    TriMesh mesh = without_faces(rectangle(2 * side + 1, side, 2 * side + 1, side), [=](const Vector3d& x) {
        return std::abs(x[0] - side - 0.5) < 0.5 && std::abs(x[1] - 0.5 * side) > 0.5;
    });
    for (auto x : mesh.position.colwise()) { // about the axis through the bridge
        const double angle = twist * (x[0] - side - 0.5), y = x[1] - 0.5 * side;
        x << x[0], y * std::cos(angle), y * std::sin(angle);
    }
    return mesh;
}

/// Many handles: a block with windows right through it.
TriMesh sponge(SeededRandom& random, int n)
{
    const int a = 2 * random.whole(1, 2) + 1, b = 2 * random.whole(1, 2) + 1, c = 2 * random.whole(0, 1) + 1;
    std::set<Cell> cubes;
    for (int i = 0; i < a; ++i)
        for (int j = 0; j < b; ++j)
            for (int k = 0; k < c; ++k)
                if (i % 2 + j % 2 + k % 2 < 2)
                    cubes.insert({i, j, k});
    return body_surface(cubes, 20, std::max(1, int(std::lround(std::sqrt(n / 6.0 / double(cubes.size()))))));
}

/// A pipe along a torus knot; closed to a ring, or with two open ends.
TriMesh knotted(SeededRandom& random, int n, bool ring)
{
    // 2,3 2,5 3,2 3,4
    const int p = random.whole(2, 3), q = 2 * random.whole(1, 2) + 1 - (p == 3);
    const double thin = random.between(3, 8), part = ring ? 1 : 0.97;
    const auto axis = [=](double t) {
        const double r = 60 + 25 * std::cos(q * t);
        return Vector3d(r * std::cos(p * t), r * std::sin(p * t), 25 * std::sin(q * t));
    };
    GridPlan plan = cells(n, 2 * pi * thin, 2 * pi * 60 * p * 1.3, true);
    plan.along = ring;
    return grid_surface(plan, [=](double u, double v) {
        const double t = 2 * pi * part * v;
        const Vector3d along = (axis(t + 1e-4) - axis(t - 1e-4)).normalized();
        // turns with the knot
        const Vector3d from_core = axis(t) - 60 * Vector3d(std::cos(p * t), std::sin(p * t), 0);
        const Vector3d e = (from_core - from_core.dot(along) * along).normalized(), f = along.cross(e);
        return Vector3d(axis(t) + thin * (std::cos(2 * pi * u) * e + std::sin(2 * pi * u) * f));
    });
}

/// A pipe with windows in its wall.
TriMesh windowed_tube(SeededRandom& random, int n)
{
    const int windows = random.whole(2, 5);
    const double length = random.between(120, 300), low = random.between(0.15, 0.35), high = random.between(0.5, 0.85);
    GridPlan plan = cells(n, 2 * pi * 30, length, true);
    plan.columns = windows * std::max(4, plan.columns / windows);
    const TriMesh whole = grid_surface(plan, [=](double u, double v) { return polar(2 * pi * u, 30, length * v); });
    return without_faces(whole, [=](const Vector3d& x) {
        const double turn = std::atan2(x[1], x[0]) / (2 * pi) * windows, place = turn - std::floor(turn);
        return place > 0.3 && place < 0.8 && x[2] > low * length && x[2] < high * length;
    });
}

/// More than a full turn around one vertex: a ruffle.
TriMesh ruffle(SeededRandom& random, int n)
{
    const int waves = random.whole(2, 6), rings_count = std::max(2, int(std::lround(std::sqrt(n / 40.0))));
    const double height = random.between(0.5, 2.5);
    return stitch_rings([&] {
        std::vector<Eigen::Matrix3Xd> rings{Eigen::Matrix3Xd::Zero(3, 1)};
        for (int j = 1; j <= rings_count; ++j) {
            Eigen::Matrix3Xd ring(3, std::max(8 * waves, 40));
            for (int i = 0; i < ring.cols(); ++i) {
                const double angle = 2 * pi * i / double(ring.cols()), r = 60.0 * j / rings_count;
                ring.col(i) = polar(angle, r, height * r * std::sin(waves * angle));
            }
            rings.push_back(ring);
        }
        return rings;
    }());
}

/// Faces from tens of millimetres down to thousandths of one.
TriMesh graded(SeededRandom& random, int n)
{
    const double power = random.between(2, 5), bow = random.between(0, 0.002);
    return grid_surface(cells(n, 1, 1), [=](double u, double v) {
        const double x = 300 * std::pow(u, power), y = 300 * std::pow(v, power);
        return Vector3d(x, y, bow * (x * x + y * y));
    });
}

/// A height field with walls that stand almost upright.
TriMesh cliffs(SeededRandom& random, int n)
{
    const double height = random.between(50, 300), sharp = random.between(5, 60);
    const double a = random.between(3, 9), b = random.between(3, 9), phase = random.between(0, 2 * pi);
    return grid_surface(cells(n, 1, 1), [=](double u, double v) {
        return Vector3d(100 * u, 100 * v, height * std::tanh(sharp * std::sin(a * u + phase) * std::cos(b * v)));
    });
}

TriMesh very_anisotropic(SeededRandom& random, int n)
{
    const double bow = random.between(0.2, 1.5);
    return grid_surface({std::max(40, n / 4), 2}, [=](double u, double v) {
        const double angle = bow * (u - 0.5);
        return Vector3d(20 / bow * std::sin(angle), 1000 * v, 20 / bow * std::cos(angle) + 30 * v * v);
    });
}

} // namespace

std::vector<FamilyShape> shape_family(int triangles, std::uint64_t seed)
{
    std::vector<FamilyShape> shapes;
    std::uint64_t family = 0;
    const auto add = [&](const char* name, int count, const std::function<TriMesh(SeededRandom&, int)>& maker,
                         Expected expected = Expected::blank, bool keep_largest = false) {
        ++family;
        for (int i = 0; i < count; ++i) {
            const std::uint64_t shape_seed = seed * 1'000'003 + family * 1009 + std::uint64_t(i);
            shapes.push_back({name, i, expected,
                              [maker, shape_seed, triangles] {
                                  SeededRandom random(shape_seed);
                                  return maker(random, triangles);
                              },
                              keep_largest});
        }
    };
    add("undercut", 10, undercut);
    add("closed walls", 12, box_with_walls);
    add("square cup", 8, cup_with_flange);
    add("spiral", 10, spiral);
    add("helicoid", 8, helicoid);
    add("slit tube", 10, slit_tube);
    add("tube", 12, tube);
    add("branched tube", 6, branched_tube);
    add("handle", 10, handle_body);
    add("sheet with handle", 6, sheet_with_handle);
    add("closed", 10, closed_body);
    add("100 holes", 6, hundred_holes);
    add("aspect 1:50", 12, anisotropic);
    add("waved outline", 12, waved_outline);
    add("needles", 14, needles, Expected::either); // some are thinner than the doctor can tell from
                                                   // flat
    add("noise", 14, noisy);
    add("twisted strip", 10, twisted_strip);
    add("twisted band", 6, [](SeededRandom& random, int n) { return twisted_band(random, n, false); });
    add(
        "Moebius band", 6, [](SeededRandom& random, int n) { return twisted_band(random, n, true); },
        Expected::refusal);
    add("crowded edge", 4, crowded, Expected::refusal);
    add("crowded edge, largest", 4, crowded, Expected::blank, true);
    add("touching holes", 4, touching);
    add("rough ground", 12, rough_ground);
    add("bottle", 8, bottle);
    add("deep cup", 8, deep_cup);
    add("comb", 8, comb);
    add("accordion", 10, accordion);
    add("far or small", 10, far_or_small);
    add("flanged ring", 6, flanged_ring);
    add("confused orientation", 4, confused_orientation);
    add("several pieces", 3, several_pieces, Expected::refusal);
    add("several pieces, largest", 3, several_pieces, Expected::blank, true);
    add("both skins", 3, both_skins,
        Expected::either); // a sheet of one thickness gives its middle surface, any other is refused
    add("crumpled", 8, crumpled);
    add("whiskers", 6, whiskers);
    add("pinhole", 5, pinhole);
    add("tiny", 6, tiny);
    add("ribbon", 5, ribbon);
    add("bridge", 4, bridge);
    add("sponge", 5, sponge);
    add("knotted tube", 5, [](SeededRandom& random, int n) { return knotted(random, n, false); });
    add(
        "knotted ring", 4, [](SeededRandom& random, int n) { return knotted(random, n, true); },
        Expected::either); // the most slender ones could be sheets with both their skins
    add("windowed tube", 6, windowed_tube);
    add("ruffle", 5, ruffle);
    add("graded", 6, graded, Expected::either);
    add("cliffs", 6, cliffs);
    add("aspect 1:1000", 4, very_anisotropic);
    return shapes;
}

} // namespace spia::shapes

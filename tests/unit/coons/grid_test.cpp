#include "engine/coons/grid.h"

#include <Eigen/Geometry>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "engine/coons/lift.h"
#include "engine/core/error.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia::grid_test {

namespace {

GridResult grid_of(const TriMesh& part, const Blank& blank, const GridOptions& options = {})
{
    return coons_grid(part, blank, split_boundary(blank, part, propose_corners(blank, part)), options);
}

GridResult grid_of(const TriMesh& flat, const std::vector<Eigen::Vector2d>& corners, const GridOptions& options = {},
                   const Progress& progress = {})
{
    std::array<int, 4> vertices;
    for (size_t k = 0; k < 4; ++k)
        vertices[k] = outlines::nearest_vertex(flat, corners[k]);
    const Blank blank = outlines::as_blank(flat);
    return coons_grid(flat, blank, split_boundary(blank, flat, vertices), options, progress);
}

double cell_area(const QuadGrid& grid)
{
    double sum = 0;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const Eigen::Vector3d p = grid.position.col(grid.node(i + 1, j + 1)) - grid.position.col(grid.node(i, j));
            const Eigen::Vector3d q = grid.position.col(grid.node(i, j + 1)) - grid.position.col(grid.node(i + 1, j));
            sum += std::abs(p.x() * q.y() - p.y() * q.x()) / 2;
        }
    return sum;
}

/// The distance from a point to the nearest boundary edge of a flat part.
double distance_to_outline(const Eigen::Vector2d& p, const GridResult& grid)
{
    const auto& loop = grid.filled->outline;
    double distance = 1e300;
    for (size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d a = grid.filled->plane.col(loop[i]);
        const Eigen::Vector2d edge = grid.filled->plane.col(loop[(i + 1) % loop.size()]) - a;
        const double t = std::min(1.0, std::max(0.0, (p - a).dot(edge) / edge.squaredNorm()));
        distance = std::min(distance, (a + t * edge - p).norm());
    }
    return distance;
}

void expect_sound(const GridResult& grid, const char* what)
{
    EXPECT_EQ(grid.quality.folded_cells, 0) << what;
    EXPECT_GT(grid.quality.min_scaled_jacobian, 0) << what;
    EXPECT_EQ(grid.nodes_outside, 0) << what;
    const QuadGrid& q = grid.planar;
    for (int n = 0; n < q.nodes(); ++n) { // each node is where its triangle says
        const MeshPoint& place = grid.place[size_t(n)];
        ASSERT_GE(place.face, 0) << what;
        Eigen::Vector2d p = Eigen::Vector2d::Zero();
        for (int k = 0; k < 3; ++k)
            p += place.barycentric[k] * grid.filled->plane.col(grid.filled->mesh.triangle(k, place.face));
        EXPECT_LT((p - q.position.col(n).head<2>()).norm(), 1e-8) << what;
        EXPECT_EQ(q.position(2, n), 0);
    }
    for (int j = 0; j <= q.rows; ++j)
        for (int i = 0; i <= q.columns; ++i)
            if (i == 0 || j == 0 || i == q.columns || j == q.rows) {
                EXPECT_LT(distance_to_outline(q.position.col(q.node(i, j)).head<2>(), grid), 1e-12) << what;
                EXPECT_EQ(grid.place[size_t(q.node(i, j))].barycentric.minCoeff(), 0) << what;
            }
}

} // namespace

TEST(CoonsGrid, OfARectangleIsUniformByEveryMethod)
{
    const TriMesh part = shapes::rectangle(30, 20, 7, 5);
    for (const GridMethod method : {GridMethod::automatic, GridMethod::coons, GridMethod::harmonic}) {
        const GridResult grid = grid_of(part, outlines::as_blank(part), {.columns = 12, .rows = 9, .method = method});
        EXPECT_EQ(grid.route, method == GridMethod::harmonic ? GridRoute::harmonic : GridRoute::coons);
        for (int j = 0; j <= 9; ++j)
            for (int i = 0; i <= 12; ++i)
                EXPECT_LT((grid.planar.position.col(grid.planar.node(i, j)) - Eigen::Vector3d(2.5 * i, 20.0 / 9 * j, 0))
                              .norm(),
                          1e-12);
        EXPECT_NEAR(grid.quality.min_scaled_jacobian, 1, 1e-12);
        expect_sound(grid, "rectangle");
    }
}

TEST(CoonsGrid, OfAFourSidedPlateIsTheBilinearMap)
{
    // Straight sides divided evenly: eq. 25 is then ((1-u)(1-v), u(1-v), uv, (1-u)v) of the
    // corners.
    const outlines::Points corner = {{0, 0}, {10, -1}, {12, 9}, {1, 6}};
    const TriMesh part = outlines::part(outlines::divided(corner, 0.7));
    const GridResult grid = grid_of(part, {corner[0], corner[1], corner[2], corner[3]}, {.columns = 8, .rows = 6});
    EXPECT_EQ(grid.route, GridRoute::coons);
    for (int j = 0; j <= 6; ++j)
        for (int i = 0; i <= 8; ++i) {
            const double u = i / 8.0, v = j / 6.0;
            const Eigen::Vector2d p =
                (1 - u) * (1 - v) * corner[0] + u * (1 - v) * corner[1] + u * v * corner[2] + (1 - u) * v * corner[3];
            EXPECT_LT((grid.planar.position.col(grid.planar.node(i, j)).head<2>() - p).norm(), 1e-12);
        }
}

TEST(CoonsGrid, AutomaticCellsAreSquareAndFortyAlongTheLongerSide)
{
    const TriMesh part = shapes::rectangle(50, 20, 10, 4);
    const GridResult wide = grid_of(part, outlines::as_blank(part));
    EXPECT_EQ(wide.planar.columns, 40);
    EXPECT_EQ(wide.planar.rows, 16);
    const GridResult given = grid_of(part, outlines::as_blank(part), {.rows = 7, .cells = 20});
    EXPECT_EQ(given.planar.columns, 20);
    EXPECT_EQ(given.planar.rows, 7);
}

TEST(CoonsGrid, AnLWithACornerBehindTheBendFoldsAsAPatchAndIsMended)
{
    const TriMesh part = outlines::part(outlines::l_shape(10, 3, 0.25));
    const std::vector<Eigen::Vector2d> corners = {{0, 0}, {10, 0}, {10, 3}, {0, 10}};
    const GridResult patch = grid_of(part, corners, {.smoothing = 0, .method = GridMethod::coons});
    EXPECT_GT(patch.quality.folded_cells, 0);
    EXPECT_GE(patch.quality.first_folded, 0);
    EXPECT_THROW(patch.nodes_outside > 0 ? lift(patch) : throw InputError("folded only"), InputError);
    const GridResult grid = grid_of(part, corners);
    EXPECT_NE(grid.route, GridRoute::coons);
    expect_sound(grid, "L");
}

TEST(CoonsGrid, TellsWhichAttemptsItTook)
{
    const TriMesh rectangle = shapes::rectangle(30, 20, 7, 5);
    const GridResult plain = grid_of(rectangle, outlines::as_blank(rectangle));
    ASSERT_EQ(plain.attempts.size(), 1u);
    EXPECT_TRUE(plain.attempts[0].won);
    EXPECT_EQ(plain.attempts[0].reason, "sound");
    ASSERT_EQ(plain.attempts[0].within.size(), 1u) << "nothing was to be smoothed";

    // The Coons patch of an L whose corner is behind the bend folds, smoothed or not.
    const TriMesh l = outlines::part(outlines::l_shape(10, 3, 0.25));
    const std::vector<Eigen::Vector2d> corners = {{0, 0}, {10, 0}, {10, 3}, {0, 10}};
    const GridResult bent = grid_of(l, corners);
    ASSERT_GT(bent.attempts.size(), 1u);
    EXPECT_EQ(bent.attempts[0].name, "Coons patch");
    EXPECT_EQ(bent.attempts[0].within.size(), 2u);
    EXPECT_NE(bent.attempts[0].reason, "sound");
    for (const AttemptReport& each : bent.attempts)
        EXPECT_EQ(each.won, &each == &bent.attempts.back()) << each.name;
    EXPECT_EQ(bent.attempts.back().reason, "sound");
    const GridResult patch = grid_of(l, corners, {.method = GridMethod::coons});
    ASSERT_EQ(patch.attempts.size(), 1u);
    EXPECT_EQ(patch.attempts[0].reason, bent.attempts[0].reason);
    const GridResult harmonic = grid_of(l, corners, {.method = GridMethod::harmonic});
    EXPECT_EQ(harmonic.attempts[0].name, "harmonic map");
    EXPECT_EQ(harmonic.attempts.size() + 1, bent.attempts.size());
}

TEST(CoonsGrid, FoldsNoCellOnDifficultOutlines)
{
    using namespace outlines;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> radius(0.5, 1);
    Points spiky;
    for (int i = 0; i < 120; ++i)
        spiky.push_back(polar(10 * radius(random), 2 * pi * i / 120));
    const std::vector<std::pair<const char*, Points>> cases = {{"circle", circle(10, 200)},
                                                               {"L", l_shape(10, 3, 0.25)},
                                                               {"thin L", l_shape(10, 0.5, 0.1)},
                                                               {"U", u_shape(10, 2, 0.25)},
                                                               {"5-star", star(4, 10, 5, 0.3)},
                                                               {"8-star", star(3, 10, 8, 0.3)},
                                                               {"C", arc(10, 2, 1.6 * pi, 200, 8)},
                                                               {"annulus cut open", arc(10, 8, 1.97 * pi, 200, 20)},
                                                               {"thin annulus cut open", arc(10, 1, 1.99 * pi, 400, 8)},
                                                               {"spiral", spiral(3, 5, 2, 800, 8)},
                                                               {"saw", saw(10, 0.3, 50)},
                                                               {"deep saw", saw(10, 2, 30)},
                                                               {"slots and tabs", slotted(20, 10, 5, 0.2, 4, 0.2)},
                                                               {"many slots", slotted(20, 10, 20, 0.1, 3, 0.2)},
                                                               {"spikes", spiky}};
    for (const auto& [name, outline] : cases) {
        const TriMesh flat = part(outline);
        ASSERT_GT(flat.triangles(), 0) << name;
        expect_sound(grid_of(flat, as_blank(flat)), name);
    }
}

TEST(CoonsGrid, CellsCoverTheOutlineOnce)
{
    // The cells fill the polygon of the border nodes; here it is the outline itself.
    using namespace outlines;
    for (const Points& corner :
         {Points{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, Points{{0, 0}, {12, 2}, {9, 9}, {-2, 6}}}) {
        const TriMesh flat = part(divided(corner, 0.8));
        double expected = 0;
        for (size_t k = 0; k < 4; ++k)
            expected += (corner[k].x() * corner[(k + 1) % 4].y() - corner[k].y() * corner[(k + 1) % 4].x()) / 2;
        EXPECT_NEAR(cell_area(grid_of(flat, {corner[0], corner[1], corner[2], corner[3]}).planar), expected, 1e-9);
    }
    const TriMesh u = part(u_shape(8, 2, 0.25)); // untangled; 32 divides each of its sides so that
                                                 // the nodes hit the corners
    const GridResult grid = grid_of(u, {{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {.columns = 40, .rows = 32});
    expect_sound(grid, "U");
    double border = 0; // the polygon of the border nodes by the shoelace formula
    std::vector<Eigen::Vector2d> polygon;
    for (int i = 0; i < 40; ++i)
        polygon.push_back(grid.planar.position.col(grid.planar.node(i, 0)).head<2>());
    for (int j = 0; j < 32; ++j)
        polygon.push_back(grid.planar.position.col(grid.planar.node(40, j)).head<2>());
    for (int i = 40; i > 0; --i)
        polygon.push_back(grid.planar.position.col(grid.planar.node(i, 32)).head<2>());
    for (int j = 32; j > 0; --j)
        polygon.push_back(grid.planar.position.col(grid.planar.node(0, j)).head<2>());
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        border += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    EXPECT_NEAR(cell_area(grid.planar), border, 1e-9);
}

TEST(CoonsGrid, ABlankThatOverlapsItselfIsFilledLayerByLayer)
{
    const auto [strip, blank] = outlines::WoundBand();
    for (const GridMethod method : {GridMethod::automatic, GridMethod::harmonic}) {
        const GridResult grid = grid_of(strip, blank, {.method = method});
        expect_sound(grid, "winding band");
        // On the part each cell stays small: no node went to the wrong layer.
        const QuadGrid lifted = lift(grid).lifted;
        for (int j = 0; j <= lifted.rows; ++j)
            for (int i = 0; i < lifted.columns; ++i)
                EXPECT_LT((lifted.position.col(lifted.node(i + 1, j)) - lifted.position.col(lifted.node(i, j))).norm(),
                          0.5);
    }
}

TEST(CoonsGrid, ACornerInAReentrantPlaceIsNamed)
{
    const TriMesh part = outlines::part(outlines::l_shape(10, 3, 0.25));
    try {
        grid_of(part, {{0, 0}, {10, 0}, {3, 3}, {0, 10}});
        ADD_FAILURE() << "a corner of 270 degrees cannot be the corner of a cell";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(std::to_string(outlines::nearest_vertex(part, {3, 3}))), std::string::npos) << message;
        EXPECT_NE(message.find("270"), std::string::npos) << message;
    }
}

TEST(CoonsGrid, ACornerOnAStraightEdgeIsNamedBeforeAnyMapIsMade)
{
    const TriMesh part = outlines::part(outlines::l_shape(10, 3, 0.25));
    std::string steps;
    const Progress watched([&](double, std::string_view step) { steps += step; });
    try {
        grid_of(part, {{0, 0}, {5, 0}, {10, 3}, {0, 10}}, {}, watched);
        ADD_FAILURE() << "a corner of 180 degrees cannot be the corner of a cell";
    } catch (const InputError& error) {
        const std::string message = error.what(),
                          corner = fmt::format("corner 2 (vertex {})", outlines::nearest_vertex(part, {5, 0}));
        EXPECT_NE(message.find(corner), std::string::npos) << message;
    }
    EXPECT_EQ(steps.find("map"), std::string::npos) << steps;
}

TEST(CoonsGrid, WhereACornerIsStraightToFinerCellsTheseAreNotTried)
{
    const TriMesh part = outlines::part(outlines::l_shape(10, 3, 0.2));
    std::string steps;
    const Progress watched([&](double, std::string_view step) { steps += step; });
    try {
        grid_of(part, {{0, 0}, {3, 0}, {10, 3}, {0, 10}}, {.cells = 8}, watched);
        ADD_FAILURE() << "the outline runs straight on there";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find("no cell fits into corner 2"), 0u) << message;
    }
    EXPECT_NE(steps.find("map"), std::string::npos) << "to those of this size it may turn: " << steps;
}

TEST(CoonsGrid, IsTheSameWhenAskedTwice)
{
    const TriMesh part = outlines::part(outlines::star(3, 10, 8, 0.3));
    const GridResult a = grid_of(part, outlines::as_blank(part)), b = grid_of(part, outlines::as_blank(part));
    EXPECT_EQ(a.planar.position, b.planar.position);
}

TEST(CoonsGrid, StopsWhenAsked)
{
    const auto cancel = std::make_shared<std::atomic<bool>>(true);
    const TriMesh part = shapes::rectangle(3, 2, 3, 2);
    const Blank blank = outlines::as_blank(part);
    EXPECT_THROW(coons_grid(part, blank, split_boundary(blank, part, {0, 3, 11, 8}), {}, Progress(nullptr, cancel)),
                 Cancelled);
}

} // namespace spia::grid_test

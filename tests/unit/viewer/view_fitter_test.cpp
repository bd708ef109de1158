// The part has its place beside what lies over the picture.
#include "app/viewer/model/picking/view_fitter.h"

#include <gtest/gtest.h>

#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

struct FittedViews : ModelFixture, testing::WithParamInterface<std::tuple<const char*, StandardView>> {};

/// How much of a rectangle of the view the triangles of a mesh cover, by places a pixel apart.
int covered_places(const Camera& camera, const TriMesh& mesh, glm::dvec2 size, glm::dvec2 least, glm::dvec2 greatest)
{
    int covered = 0;
    const auto turns = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    for (int f = 0; f < mesh.triangles(); ++f) {
        glm::dvec2 corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = glm::dvec2(pixel_of(camera, mesh.position.col(mesh.triangle(k, f)), size));
        const glm::dvec2 low = glm::max(least, glm::min(corner[0], glm::min(corner[1], corner[2]))),
                         high = glm::min(greatest, glm::max(corner[0], glm::max(corner[1], corner[2])));
        for (double y = std::ceil(low.y); y <= high.y; ++y)
            for (double x = std::ceil(low.x); x <= high.x; ++x) {
                const glm::dvec2 at(x, y);
                const double a = turns(corner[0], corner[1], at), b = turns(corner[1], corner[2], at),
                             c = turns(corner[2], corner[0], at);
                covered += (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
            }
    }
    return covered;
}

TEST_P(FittedViews, ThePartLiesBesideLegendAndCubeAndIsNotSmallForIt)
{
    const auto& [file, from] = GetParam();
    open(file);
    // A view of four in a window of 1280 x 720 pixels, and its cube and legend.
    const glm::dvec2 size(328, 296);
    const Covered covered{118, 94};
    FieldDisplay display;
    display.field = Field::thinning;
    model.apply(SetDisplay{display});
    for (const View view : all_views)
        model.resized(view, size, 1, covered);
    model.apply(LookFrom{View::part, from});
    model.apply(FitView{});
    const Camera& camera = state.view.camera[size_t(View::part)];
    const TriMesh& part = document.session.part->mesh;
    EXPECT_EQ(covered_places(camera, part, size, {size.x - covered.cube, 0}, {size.x, covered.cube}), 0);
    EXPECT_EQ(covered_places(camera, part, size, {0, 0}, {covered.legend, size.y}), 0);
    glm::dvec2 least(1e9), greatest(-1e9);
    for (int v = 0; v < part.vertices(); ++v) {
        const glm::dvec2 at(pixel_of(camera, part.position.col(v), size));
        least = glm::min(least, at);
        greatest = glm::max(greatest, at);
    }
    EXPECT_GE(least.y, 0);
    EXPECT_LE(greatest.y, size.y);
    EXPECT_LE(greatest.x, size.x);
    const glm::dvec2 extent = greatest - least;
    // No smaller than beside the whole column of the cube or below its whole row.
    const double beside = std::min((size.x - covered.legend - covered.cube) / extent.x, size.y / extent.y),
                 below = std::min((size.x - covered.legend) / extent.x, (size.y - covered.cube) / extent.y);
    EXPECT_LT(std::max(beside, below), 1.35) << "it could be much larger";
}

INSTANTIATE_TEST_SUITE_P(Parts, FittedViews,
                         testing::Combine(testing::Values("dome.obj", "inner-panel.obj", "square-cup.obj"),
                                          testing::Values(StandardView::isometric, StandardView::top,
                                                          StandardView::front)));

TEST_F(ModelFixture, AViewThatWasMovedStaysWhenALegendComes)
{
    open();
    for (const View view : all_views)
        model.resized(view, {400, 300}, 1, {0, 94});
    model.apply(LookFrom{View::part, StandardView::front});
    const Camera moved = state.view.camera[size_t(View::part)];
    model.resized(View::part, {400, 300}, 1, {130, 94});
    EXPECT_EQ(state.view.camera[size_t(View::part)], moved);
}

} // namespace
} // namespace spia::viewer

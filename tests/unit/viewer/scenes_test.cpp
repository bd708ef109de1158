#include "app/viewer/views/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "app/viewer/views/grid_shapes.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/strain_glyphs.h"
#include "app/viewer/views/surface_shape.h"
#include "engine/coons/cell_quality.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/run_chain.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

/// A small plate with two holes, bent over a saddle, through the whole chain. Numbers in its file
/// are twice those of the mesh.
Session finished_session()
{
    Session session;
    PartFile part;
    part.mesh = shapes::plate({.triangles = 600});
    for (int v = 0; v < part.mesh.vertices(); ++v) {
        const double x = part.mesh.position(0, v) - 60, y = part.mesh.position(1, v) - 40;
        part.mesh.position(2, v) = (x * x - y * y) / 300;
        part.source_vertex.push_back(2 * v);
    }
    session.part = std::make_shared<PartFile>(std::move(part));
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.grid.cells = 12;
    return completed(run_chain(std::move(session), Stage::solve));
}

class Scenes : public testing::Test {
protected:
    static void SetUpTestSuite() { session = new Session(finished_session()); }
    static void TearDownTestSuite() { delete session; }
    Scenes() { state.document.session = *session; }
    const TriMesh& part() const { return session->part->mesh; }

    static inline Session* session = nullptr;
    ViewerState state;
    SceneCache cache;
};

TEST_F(Scenes, WithoutWhatTheyShowTheySayWhatToDo)
{
    for (const Stage stage : chain) {
        ViewerState early;
        early.document.session = *session;
        Session& now = early.document.session;
        if (stage <= Stage::fit)
            now.surface = nullptr;
        if (stage <= Stage::lift)
            now.lifted = nullptr;
        if (stage <= Stage::grid)
            now.grid = nullptr;
        if (stage <= Stage::solve)
            now.blank = nullptr;
        if (stage <= Stage::read)
            now.part = nullptr;
        SceneCache fresh;
        const auto is_there = [&](View view) {
            const Scene shown = scene(view, early, fresh);
            EXPECT_NE(shown.layers.empty(), shown.empty.empty()) << "either something to see or words";
            return !shown.layers.empty();
        };
        EXPECT_EQ(is_there(View::part), stage > Stage::read);
        EXPECT_EQ(is_there(View::blank), stage > Stage::solve);
        EXPECT_EQ(is_there(View::quads), stage > Stage::lift);
        EXPECT_FALSE(is_there(View::surface));
        early.job.running = true;
        early.job.title = "Unfolding step by step";
        for (const View view : {View::quads, View::surface})
            if (const std::string words = scene(view, early, fresh).empty; now.blank && !words.empty()) {
                EXPECT_TRUE(words.ends_with("Running now: Unfolding step by step.")) << words;
            }
    }
}

TEST_F(Scenes, TheBlankShowsWhereItLiesOnItself)
{
    const auto red = [&] {
        std::pair<Eigen::Index, int> found{0, 0}; // pieces of line, dots
        const Scene shown = scene(View::blank, state, cache);
        for (const auto& lines : shown.lines)
            if (lines->colour == palette::folded)
                found.first += lines->point.cols() / 2;
        for (const auto& points : shown.points)
            if (points->colour == palette::folded)
                found.second += int(points->point.cols());
        const auto names = std::count_if(shown.labels.begin(), shown.labels.end(),
                                         [](const SceneLabel& label) { return label.text == "overlap"; });
        EXPECT_EQ(names, (found.first > 0) + (found.second > 0));
        return found;
    };
    ASSERT_TRUE(session->blank->overlap.none());
    EXPECT_EQ(red(), std::pair(Eigen::Index(0), 0));
    FlattenResult crossed = *session->blank;
    crossed.overlap = {{{{0, 1}, {2, 3}}, {{4, 5}, {6, 7}}}, {8}};
    state.document.session.blank = std::make_shared<FlattenResult>(crossed);
    EXPECT_EQ(red(), std::pair(Eigen::Index(4), 1));
}

TEST_F(Scenes, AreNotMadeAgainWhenNothingHasChanged)
{
    state.document.selected = {1, 2, 3};
    state.document.display.directions = true;
    state.hovered = 5;
    for (const View view : all_views) {
        const Scene first = scene(view, state, cache), second = scene(view, state, cache);
        ASSERT_EQ(first.layers.size(), second.layers.size());
        for (size_t i = 0; i < first.layers.size(); ++i) {
            EXPECT_EQ(first.layers[i].mesh, second.layers[i].mesh);
            EXPECT_EQ(first.layers[i].field, second.layers[i].field);
            EXPECT_EQ(first.layers[i].marks, second.layers[i].marks);
        }
        EXPECT_EQ(first.lines, second.lines) << int(view);
    }
}

TEST_F(Scenes, AnotherFieldKeepsTheMeshAndAnotherPartReplacesIt)
{
    const Scene before = part_scene(state, cache);
    state.document.display.field = Field::strain_major;
    const Scene other_field = part_scene(state, cache);
    EXPECT_EQ(other_field.layers[0].mesh, before.layers[0].mesh);
    EXPECT_NE(other_field.layers[0].field, before.layers[0].field);
    auto other = std::make_shared<PartFile>(*state.document.session.part);
    state.document.session = Session{};
    state.document.session.part = other;
    const Scene other_part = part_scene(state, cache);
    EXPECT_NE(other_part.layers[0].mesh, before.layers[0].mesh);
    EXPECT_FALSE(other_part.layers[0].field) << "it is not solved yet";
}

TEST_F(Scenes, TheFieldOnThePartAndTheBlankIsThatOfTheSolution)
{
    for (const bool per_face : {false, true}) {
        state.document.display.field = Field::thickness;
        state.document.display.per_face = per_face;
        const Eigen::VectorXd& wanted = per_face ? session->blank->face.thickness : session->blank->node.thickness;
        for (const Scene& shown : {part_scene(state, cache), blank_scene(state, cache)}) {
            const SceneField& field = *shown.layers[0].field;
            EXPECT_EQ(field.per_face, per_face);
            EXPECT_LT((field.value.head(wanted.size()) - wanted.cast<float>()).cwiseAbs().maxCoeff(), 1e-6);
            ASSERT_TRUE(shown.legend);
            EXPECT_EQ(shown.legend->unit, "mm");
        }
    }
}

TEST_F(Scenes, TheLeastAndTheGreatestValueAreMarkedWhereTheyAre)
{
    state.document.display.field = Field::strain_major;
    Eigen::Index least, greatest;
    session->blank->face.strain_major.minCoeff(&least);
    session->blank->face.strain_major.maxCoeff(&greatest);
    const auto middle = [](const auto& position, const auto& corner) {
        return Eigen::VectorXd(position(Eigen::all, corner).rowwise().mean());
    };
    const auto on_face = [&](const auto& position, Eigen::Index face) {
        return middle(position, part().triangle.col(face));
    };
    const Scene on_part = part_scene(state, cache), on_blank = blank_scene(state, cache);
    ASSERT_GE(on_part.labels.size(), 2u);
    EXPECT_EQ(on_part.labels[0].text.substr(0, 4), "min ");
    EXPECT_LT((on_part.labels[0].place - on_face(part().position, least)).norm(), 1e-9);
    EXPECT_EQ(on_part.labels[1].text.substr(0, 4), "max ");
    EXPECT_LT((on_part.labels[1].place - on_face(part().position, greatest)).norm(), 1e-9);
    EXPECT_LT((on_blank.labels[1].place.head<2>() - on_face(session->blank->blank.position, greatest)).norm(), 1e-9);
    state.document.display.extremes = false;
    EXPECT_TRUE(part_scene(state, cache).labels.empty());
}

TEST_F(Scenes, TheLegendSaysWhetherValuesLieBeyondItsEnds)
{
    state.document.display.field = Field::strain_major;
    const auto legend = [&] { return *part_scene(state, cache).legend; };
    EXPECT_FALSE(legend().below || legend().above) << "the automatic range holds all";
    const double least = session->blank->node.strain_major.minCoeff(),
                 greatest = session->blank->node.strain_major.maxCoeff();
    state.document.display.range = {{least - 0.1, (least + greatest) / 2}};
    EXPECT_TRUE(!legend().below && legend().above);
    state.document.display.range = {{(least + greatest) / 2, greatest + 0.1}};
    EXPECT_TRUE(legend().below && !legend().above);
}

TEST_F(Scenes, IsolinesLieOnTheSheetOfTheirViewAndAFieldPerFaceHasNone)
{
    EXPECT_FALSE(part_scene(state, cache).isolines);
    state.document.display.isolines = true;
    const auto on_part = part_scene(state, cache).isolines, on_blank = blank_scene(state, cache).isolines;
    ASSERT_TRUE(on_part && on_blank);
    ASSERT_FALSE(on_part->empty());
    EXPECT_EQ(part_scene(state, cache).isolines, on_part) << "kept";
    ASSERT_EQ(on_blank->size(), on_part->size());
    for (const Isoline& line : *on_blank)
        EXPECT_EQ(line.point.row(2).cwiseAbs().maxCoeff(), 0);
    for (const Isoline& line : *on_part) { // z = (x^2 - y^2) / 300, but for the flat triangles in
                                           // between
        const Eigen::ArrayXd x = line.point.row(0).array() - 60, y = line.point.row(1).array() - 40;
        EXPECT_LT(((x * x - y * y) / 300 - line.point.row(2).transpose().array()).abs().maxCoeff(), 0.2);
    }
    state.document.display.per_face = true;
    EXPECT_FALSE(part_scene(state, cache).isolines);
}

TEST_F(Scenes, ARegionHasItsBorderInItsColourAndItsNameOnOneOfItsFaces)
{
    state.document.display.extremes = false;
    state.document.regions = {{"clamped", RegionKind::fixed, {0.1f, 0.8f, 0.3f, 1}, {3, 4, 5, 6, 200}}};
    for (const Scene& shown : {part_scene(state, cache), blank_scene(state, cache)}) {
        EXPECT_EQ(std::count_if(shown.lines.begin(), shown.lines.end(),
                                [&](const auto& l) { return l->colour == state.document.regions[0].colour; }),
                  1);
        const auto label = std::find_if(shown.labels.begin(), shown.labels.end(),
                                        [](const SceneLabel& l) { return l.kind == LabelKind::region; });
        ASSERT_NE(label, shown.labels.end());
        EXPECT_EQ(label->text, "clamped");
    }
    const Scene shown = part_scene(state, cache);
    double nearest = 1e300;
    for (const int face : state.document.regions[0].faces)
        nearest = std::min(
            nearest,
            (part().position(Eigen::all, part().triangle.col(face)).rowwise().mean() - shown.labels[0].place).norm());
    EXPECT_LT(nearest, 1e-9);
}

TEST_F(Scenes, PrincipalStrainsAreAsDenseOnTheScreenHoweverNearTheCameraIs)
{
    state.document.display.directions = true;
    Camera& camera = state.view.camera[size_t(View::part)];
    const auto glyphs = [&](double height) {
        camera.height = height;
        const Scene shown = part_scene(state, cache, 500);
        Eigen::Index count = 0;
        for (const auto& lines : shown.lines)
            count += lines->colour == palette::stretched ? lines->point.cols() / 2 : 0;
        return count;
    };
    const auto far = glyphs(300), nearer = glyphs(150);
    EXPECT_GT(nearer, 2 * far);
    camera.height = 160;
    const auto before = part_scene(state, cache, 500).lines;
    camera.height = 155;
    EXPECT_EQ(part_scene(state, cache, 500).lines, before) << "no flicker within a step";
}

TEST_F(Scenes, AProbeShowsTheValueAtItsPlace)
{
    state.document.display.field = Field::thickness;
    state.document.display.extremes = false;
    const Eigen::Vector3d barycentric(0.2, 0.3, 0.5);
    // the second one is of another part
    state.document.probes = {{7, barycentric}, {1000000, barycentric}};
    const Scene shown = part_scene(state, cache);
    ASSERT_EQ(shown.labels.size(), 1u);
    const Eigen::Vector3i corner = part().triangle.col(7);
    EXPECT_NEAR(std::stod(shown.labels[0].text.substr(2)), session->blank->node.thickness(corner).dot(barycentric),
                0.005);
    EXPECT_LT((shown.labels[0].place - part().position(Eigen::all, corner) * barycentric).norm(), 1e-9);
}

TEST_F(Scenes, WhileAJobLaysTheBlankOutItsShapeSoFarIsShownWithoutAField)
{
    auto live = std::make_shared<Eigen::Matrix2Xd>(session->blank->blank.position * 2);
    state.job.running = true;
    state.job.blank = live;
    const Scene shown = blank_scene(state, cache);
    EXPECT_FALSE(shown.layers[0].field);
    EXPECT_NEAR(shown.box.sizes().x(), live->row(0).maxCoeff() - live->row(0).minCoeff(), 1e-9);
    // of another part
    state.job.blank = std::make_shared<Eigen::Matrix2Xd>(Eigen::Matrix2Xd::Zero(2, 3));
    EXPECT_TRUE(blank_scene(state, cache).layers[0].field);
}

TEST_F(Scenes, TheBlankHasTheLineOfEachBendAndItsNumber)
{
    state.document.display.extremes = false;
    const size_t lines = blank_scene(state, cache).lines.size(), labels = blank_scene(state, cache).labels.size();
    BendTable table;
    for (const double x : {10., 20., 30.}) {
        SheetBend bend;
        bend.up = x < 25;
        bend.line = {{{x, 0}, {x, 40}}};
        table.bends.push_back(bend);
    }
    state.document.session.bends = std::make_shared<BendTable>(table);
    const Scene shown = blank_scene(state, cache);
    ASSERT_EQ(shown.lines.size(), lines + 2) << "dark on a light ground";
    ASSERT_EQ(shown.labels.size(), labels + 3);
    for (const auto& [text, x] : {std::pair("1, up", 10.), {"2, up", 20.}, {"3, down", 30.}}) {
        const auto label = std::ranges::find(shown.labels, text, &SceneLabel::text);
        ASSERT_NE(label, shown.labels.end()) << text;
        EXPECT_LT((label->place - Eigen::Vector3d(x, 20, 0)).norm(), 1e-9);
    }
}

/// Places of the labels 1 to 4.
std::vector<Eigen::Vector3d> corners_of(const Scene& shown)
{
    std::vector<Eigen::Vector3d> places;
    for (const SceneLabel& label : shown.labels)
        if (label.text == std::to_string(places.size() + 1))
            places.push_back(label.place);
    return places;
}

TEST_F(Scenes, TheCornersAreThoseOfTheGridUntilTheUserSetsOthers)
{
    state.document.display.extremes = false;
    const Eigen::Matrix2Xd& plane = session->blank->blank.position;
    auto places = corners_of(blank_scene(state, cache));
    ASSERT_EQ(places.size(), 4u);
    for (size_t k = 0; k < 4; ++k)
        EXPECT_LT((places[k].head<2>() - plane.col(session->grid->boundary.corner[k])).norm(), 1e-9);
    state.document.session.options.corners = {{2 * 3, 2 * 1, 2 * 4, 2 * 0}}; // as in the file
    places = corners_of(blank_scene(state, cache));
    ASSERT_EQ(places.size(), 4u);
    EXPECT_LT((places[0].head<2>() - plane.col(3)).norm(), 1e-9);
    EXPECT_LT((places[3].head<2>() - plane.col(0)).norm(), 1e-9);
    state.document.session.options.corners = {{3, 1, 5, 7}}; // no numbers of the file
    EXPECT_TRUE(corners_of(blank_scene(state, cache)).empty());
}

TEST_F(Scenes, WhileCornersAreChosenThoseTheGridWouldGetAreShown)
{
    state.document.session = Session{};
    state.document.session.part = session->part;
    state.document.session.blank = session->blank;
    EXPECT_TRUE(corners_of(blank_scene(state, cache)).empty());
    state.view.tool = Tool::corners;
    EXPECT_EQ(corners_of(blank_scene(state, cache)).size(), 4u);
}

TEST_F(Scenes, TheFaceUnderTheMouseIsKnownInEveryViewWithoutAnotherPicture)
{
    for (const View view : all_views) {
        state.hovered = std::nullopt;
        const Scene without = scene(view, state, cache);
        EXPECT_FALSE(without.hovered);
        state.hovered = 11;
        const Scene shown = scene(view, state, cache);
        ASSERT_TRUE(shown.hovered) << int(view);
        const Eigen::Vector3i corner = session->part->mesh.triangle.col(11);
        for (int k = 0; k < 3; ++k) {
            Eigen::Vector3d place = session->part->mesh.position.col(corner[k]);
            if (view == View::blank)
                place << session->blank->blank.position.col(corner[k]), 0;
            EXPECT_EQ((*shown.hovered)[size_t(k)], place) << int(view);
        }
        EXPECT_EQ(shown.lines, without.lines);
        for (size_t i = 0; i < shown.layers.size(); ++i)
            EXPECT_EQ(shown.layers[i].marks, without.layers[i].marks) << "else all of it is drawn again";
        state.hovered = 1000000; // of another part
        EXPECT_FALSE(scene(view, state, cache).hovered);
    }
}

TEST_F(Scenes, PickedVerticesAreDotsInEveryViewAndTwoShowTheirDistance)
{
    state.document.display.extremes = false;
    const Eigen::Matrix2Xd& plane = session->blank->blank.position;
    for (const View view : all_views) {
        const auto place = [&](int v) {
            return view == View::blank ? Eigen::Vector3d(plane(0, v), plane(1, v), 0)
                                       : Eigen::Vector3d(part().position.col(v));
        };
        state.document.vertices.clear();
        state.hovered_vertex.reset();
        const Scene without = scene(view, state, cache);
        EXPECT_TRUE(without.rings.empty());
        state.document.vertices = {4, 17};
        state.hovered_vertex = 9;
        const Scene shown = scene(view, state, cache);
        ASSERT_EQ(shown.points.size(), without.points.size() + 1);
        const ScenePoints& dots = *shown.points.back(); // over the corners
        EXPECT_LT((dots.point.col(1).cast<double>() + dots.origin - place(17)).norm(), 1e-4);
        EXPECT_EQ(shown.lines.size(), without.lines.size() + 2);
        ASSERT_EQ(shown.labels.size(), without.labels.size() + 3);
        const SceneLabel* label = &shown.labels.back() - 2;
        EXPECT_EQ(label[0].text, "8"); // as in the file
        EXPECT_EQ(label[1].text, "34");
        EXPECT_NEAR(std::stod(label[2].text), (place(4) - place(17)).norm(), 0.006) << int(view);
        ASSERT_EQ(shown.rings.size(), 1u);
        EXPECT_LT((shown.rings[0].place - place(9)).norm(), 1e-9);
        EXPECT_EQ(scene(view, state, cache).points.back(), shown.points.back()); // not made again
        state.document.vertices = {1000000};
        state.hovered_vertex = 1000000; // both of another part
        EXPECT_EQ(scene(view, state, cache).points.size(), without.points.size());
    }
}

TEST_F(Scenes, ThePictureOfTheSurfaceHasItsControlNetInTheBox)
{
    const Scene shown = surface_scene(state, cache);
    for (const auto point : session->surface->result.surface.control.colwise())
        EXPECT_LT(shown.box.exteriorDistance(Eigen::Vector3d(point)), 1e-9);
    state.view.control_net = false;
    EXPECT_TRUE(surface_scene(state, cache).lines.empty());
}

TEST_F(Scenes, TheDeviationOfTheSurfaceIsAboutThatOfTheReport)
{
    const Scene shown = surface_scene(state, cache);
    double largest = 0;
    for (const float d : shown.layers[0].field->value)
        if (std::isfinite(d))
            largest = std::max(largest, double(std::abs(d)));
    EXPECT_LE(largest, 1.3 * session->surface->deviation.surface_to_mesh.max);
    EXPECT_GE(largest, 0.7 * session->surface->deviation.surface_to_mesh.max);
}

/// 4 x 3 unit cells; the node (1, 1) is moved to (x, y).
QuadGrid grid_with_node_at(double x, double y)
{
    QuadGrid grid{4, 3, Eigen::Matrix3Xd::Zero(3, 20)};
    for (int j = 0; j <= 3; ++j)
        for (int i = 0; i <= 4; ++i)
            grid.position.col(grid.node(i, j)) << i, j, 0;
    grid.position.col(grid.node(1, 1)) << x, y, 0;
    return grid;
}

TEST(CellJacobian, IsTheSineOfTheWorstCornerAndItsLeastIsThatOfTheReport)
{
    EXPECT_LT((scaled_jacobians(grid_with_node_at(1, 1)).array() - 1).abs().maxCoeff(), 1e-12);
    const QuadGrid skewed = grid_with_node_at(1.4, 1.3);
    EXPECT_NEAR(scaled_jacobians(skewed).minCoeff(), cell_quality(skewed).min_scaled_jacobian, 1e-12);
    // Cell (0, 0) has the corners (0,0), (1,0), (1.4,1.3), (0,1) and at the third one the sides
    // (-1.4,-0.3), (-0.4,-1.3).
    EXPECT_NEAR(scaled_jacobians(skewed)[0], 1.70 / std::hypot(0.4, 1.3) / std::hypot(1.4, 0.3), 1e-9);
}

TEST(GridShapes, FoldedCellsAreRedAndAllOthersAreNot)
{
    const QuadGrid folded = grid_with_node_at(2.5, 1.2);
    const int count = cell_quality(folded).folded_cells;
    ASSERT_GT(count, 0);
    const StageShape shape = lifted_grid_shape(folded, folded, true);
    ASSERT_EQ(shape.layers.size(), 2u);
    EXPECT_EQ(shape.layers[0].mesh->triangle.cols(), 2 * (12 - count));
    EXPECT_GT(shape.layers[0].field->value.minCoeff(), 0);
    EXPECT_EQ(shape.layers[1].mesh->triangle.cols(), 2 * count);
    EXPECT_EQ(shape.layers[1].colour, palette::folded);
    EXPECT_EQ(planar_grid_shape(folded, false).layers.size(), 1u);
    EXPECT_TRUE(planar_grid_shape(grid_with_node_at(1, 1), false).layers.empty());
}

TEST(SurfaceDeviation, OfAPlaneBesideTheOtherIsTheirDistanceWithItsSignAndNothingOverAHole)
{
    const TriMesh part = shapes::plate();
    FilledMesh filled = fill_holes(part, part.position.topRows<2>());
    for (const double height : {0.25, -0.75}) {
        Tessellation surface;
        surface.mesh = shapes::rectangle(120, 80, 24, 16);
        surface.mesh.position.row(2).setConstant(height);
        const Eigen::VectorXd deviation = surface_deviation(surface, {filled.mesh, filled.part_triangles});
        int on_part = 0, on_holes = 0;
        for (int v = 0; v < deviation.size(); ++v) {
            const Eigen::Vector2d place = surface.mesh.position.col(v).head<2>();
            const double from_hole =
                std::min((place - Eigen::Vector2d(35, 40)).norm(), (place - Eigen::Vector2d(85, 40)).norm());
            if (from_hole < 11.5) {
                EXPECT_TRUE(std::isnan(deviation[v])) << place.transpose();
                ++on_holes;
            } else if (from_hole > 12.5) {
                EXPECT_NEAR(deviation[v], height, 1e-9) << place.transpose();
                ++on_part;
            }
        }
        EXPECT_GT(on_part, 300);
        EXPECT_GT(on_holes, 20);
    }
}

/// A plate that is stretched along x by 1.2 and squeezed along y by 0.8, from a blank that lies
/// askew.
struct Stretched {
    TriMesh part = shapes::rectangle(60, 40, 30, 20);
    FlattenResult flat;
    Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.6).toRotationMatrix();

    Stretched()
    {
        flat.blank.position = turn * Eigen::DiagonalMatrix<double, 2>(1 / 1.2, 1 / 0.8) * part.position.topRows<2>();
        flat.face.strain_major = Eigen::VectorXd::Constant(part.triangles(), std::log(1.2));
        flat.face.strain_minor = Eigen::VectorXd::Constant(part.triangles(), std::log(0.8));
        flat.face.direction_major = Eigen::Vector3d::UnitX().replicate(1, part.triangles());
    }
};

/// Each line as a vector.
Eigen::Matrix3Xd vectors(const SceneLines& lines)
{
    Eigen::Matrix3Xd result(3, lines.point.cols() / 2);
    for (Eigen::Index i = 0; i < result.cols(); ++i)
        result.col(i) = (lines.point.col(2 * i + 1) - lines.point.col(2 * i)).cast<double>();
    return result;
}

TEST(StrainGlyphs, PointAlongThePrincipalStrainsAreAsLongAndColouredBySign)
{
    const Stretched plate;
    const LineList lines = strain_glyphs(plate.part, plate.flat, plate.part.position, 6.3);
    ASSERT_EQ(lines.size(), 4u) << "casing and core of the stretched and the squeezed ones";
    EXPECT_EQ(lines[1]->colour, palette::stretched);
    EXPECT_EQ(lines[3]->colour, palette::squeezed);
    const Eigen::Matrix3Xd along = vectors(*lines[1]), across = vectors(*lines[3]);
    EXPECT_NEAR(double(along.cols()), 60, 35);
    EXPECT_LT(along.bottomRows<2>().cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT(across.row(0).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_NEAR(along.col(0).norm() / across.col(0).norm(), std::log(1.2) / -std::log(0.8), 1e-3);
}

TEST(StrainGlyphs, SpacingIsAPowerOfTwoNearThirtyPixelsAndEndsSomewhere)
{
    for (double mm_per_pixel = 0.05; mm_per_pixel < 5; mm_per_pixel *= 1.1) {
        const double spacing = glyph_spacing(mm_per_pixel, 100);
        EXPECT_EQ(spacing, std::exp2(std::round(std::log2(spacing))));
        EXPECT_GT(spacing / mm_per_pixel, 30 / 1.4143);
        EXPECT_LT(spacing / mm_per_pixel, 30 * 1.4143);
    }
    EXPECT_GE(glyph_spacing(1e-5, 100), 0.4);
}

TEST(StrainGlyphs, ThoseOfAWiderSpacingAreAmongThoseOfHalfOfIt)
{
    const Stretched plate;
    const auto middles = [&](double spacing) {
        const LineList lines = strain_glyphs(plate.part, plate.flat, plate.part.position, spacing);
        std::set<std::pair<int, int>> result; // in hundredths of a mm
        const auto& point = lines.at(1)->point;
        for (Eigen::Index i = 0; i < point.cols(); i += 2) {
            const Eigen::Vector3d middle = (point.col(i) + point.col(i + 1)).cast<double>() / 2 + lines[1]->origin;
            result.emplace(std::lround(100 * middle.x()), std::lround(100 * middle.y()));
        }
        return result;
    };
    const auto wide = middles(8), narrow = middles(4);
    EXPECT_GT(narrow.size(), 2 * wide.size());
    EXPECT_TRUE(std::includes(narrow.begin(), narrow.end(), wide.begin(), wide.end()));
}

TEST(StrainGlyphs, OnTheBlankTheyLieInTheDirectionsThatBecomeThoseOfThePart)
{
    const Stretched plate;
    Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, plate.part.vertices());
    flat.topRows<2>() = plate.flat.blank.position;
    const LineList lines = strain_glyphs(plate.part, plate.flat, flat, 6.3);
    ASSERT_EQ(lines.size(), 4u);
    const Eigen::Vector2d x = plate.turn.col(0), y = plate.turn.col(1);
    const Eigen::Matrix3Xd along = vectors(*lines[1]), across = vectors(*lines[3]);
    for (const auto glyph : along.colwise())
        EXPECT_NEAR(std::abs(glyph.head<2>().normalized().dot(x)), 1, 1e-4);
    for (const auto glyph : across.colwise())
        EXPECT_NEAR(std::abs(glyph.head<2>().normalized().dot(y)), 1, 1e-4);
}

} // namespace
} // namespace spia::viewer

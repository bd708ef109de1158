#include "app/viewer/model/document/project_file.h"

#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <random>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/run_stage.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

Eigen::Vector3d centre_of(const TriMesh& mesh, int face)
{
    return mesh.position(Eigen::all, mesh.triangle.col(face)).rowwise().mean();
}

/// Faces whose middle is within x from..to.
std::vector<int> faces_between(const TriMesh& mesh, double from, double to)
{
    std::vector<int> faces;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (const double x = centre_of(mesh, f)[0]; x >= from && x <= to)
            faces.push_back(f);
    return faces;
}

double area_of(const TriMesh& mesh, const std::vector<int>& faces)
{
    const Eigen::Matrix3Xd vectors = area_vectors(mesh);
    double sum = 0;
    for (const int f : faces)
        sum += vectors.col(f).norm();
    return sum;
}

Document document_of_mesh(const TriMesh& mesh, const fs::path& file)
{
    shapes::write_mesh(file, mesh);
    return viewer::document_of(file, Stage::read);
}

/// Within the range of the option.
template <class T> T another(const Option& option, T value)
{
    if constexpr (std::is_same_v<T, bool>)
        return !value;
    else if constexpr (std::is_enum_v<T>)
        return T((size_t(value) + 1) % option.choices.size());
    else
        return T(option.range->nearest(double(value) + 17));
}

/// With picks of every kind.
Document picked(const fs::path& part, Stage last)
{
    Document document = viewer::document_of(part, last);
    const TriMesh& mesh = document.session.part->mesh;
    const double low = mesh.position.row(0).minCoeff(), high = mesh.position.row(0).maxCoeff();
    document.section = SectionLine{{1, 2, 3}, {4, 5, 7}, {0, 0.6, -0.8}, true};
    document.selected = faces_between(mesh, low, 0.7 * low + 0.3 * high);
    document.regions.push_back(
        {"clamp \"1\" äöü", RegionKind::binder, {0.5f, 0.25f, 0, 1}, faces_between(mesh, 0.5 * (low + high), high)});
    document.regions[0].contact = ToolContact{.force_N = 1500, .friction = 0.07};
    document.lines = {
        {LineKind::drawbead, "bead", {centre_of(mesh, 3), centre_of(mesh, 9)}, 75, BeadShape{4, 2, 3, 0.1}},
        {LineKind::pilot, "pin", {centre_of(mesh, 5)}, 1, {}}};
    document.edge_restraint = 0.25;
    document.rolling = Eigen::Vector3d(1, 2, 0);
    document.limits.curve = LimitsOptions::Source::keeler_brazier;
    document.limits.n = 0.19;
    document.limits.max_thinning = 0.3;
    document.regions.push_back({"empty", RegionKind::pad, {0, 0, 1, 0.5f}, {}});
    document.probes.push_back({7, {0.5, 0.25, 0.25}});
    document.probes.push_back({mesh.triangles() - 1, {0, 0, 1}});
    document.vertices = {2, 30, boundary_loops(mesh)[0][5]};
    std::sort(document.vertices.begin(), document.vertices.end());
    const auto outline = boundary_loops(mesh)[0];
    auto& corners = document.session.options.corners.emplace();
    for (size_t k = 0; k < 4; ++k)
        corners[k] = document.session.part->source_vertex[size_t(outline[k * outline.size() / 4])];
    document.display = {Field::thickness, true, std::array{0.7, 1.1}, ColourMap::grey, 8, true, false, true};
    SessionOptions& options = document.session.options;
    options.read.unit = LengthUnit::mm;
    options.flatten.thickness = 0.8;
    options.flatten.direction = Eigen::Vector3d(0.1, 0.2, 0.97);
    for_each_described(options.grid, [](const Option& option, auto& value) { value = another(option, value); });
    options.interpolate.ends = CurveEnds::clamped;
    options.interpolate.degree_u = 5;
    options.tolerance = 0.035;
    options.fit_parameters = FitParameters::corrected;
    options.max_control_points = 4321;
    return document;
}

Document reopened(const fs::path& file, std::vector<std::string>& lost)
{
    Project project = open_project(file, materials_folder);
    project.document.session = run_stage(Stage::read, project.document.session);
    lost = restore_picks(project.document, project.picks);
    return project.document;
}

void expect_same_picks(const Document& a, const Document& b)
{
    EXPECT_EQ(a.selected, b.selected);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.regions, b.regions);
    EXPECT_EQ(a.lines, b.lines);
    ASSERT_EQ(a.probes.size(), b.probes.size());
    for (size_t i = 0; i < a.probes.size(); ++i) {
        EXPECT_EQ(a.probes[i].face, b.probes[i].face);
        EXPECT_EQ(a.probes[i].barycentric, b.probes[i].barycentric);
    }
    EXPECT_EQ(a.session.options.corners, b.session.options.corners);
}

std::string refusal(const fs::path& file)
{
    try {
        open_project(file, materials_folder);
    } catch (const InputError& error) {
        return error.what();
    }
    return "opened";
}

} // namespace

TEST(ProjectFile, ReopensToTheSameState)
{
    const ScratchFolder folder;
    const Document before = picked(dome, Stage::solve);
    ViewSettings view;
    view.camera[2].turn = glm::dquat(0.5, -0.5, 0.5, 0.5);
    view.camera[0].target = {0.1, 1e-17, 12345.6789};
    view.maximised = View::blank;
    view.dark = false;
    save_project(folder / "a.spia", before, view);

    std::vector<std::string> lost;
    const Document after = reopened(folder / "a.spia", lost);
    EXPECT_TRUE(lost.empty()) << lost.front();
    expect_same_picks(after, before);
    EXPECT_EQ(after.section, before.section);
    const Project project = open_project(folder / "a.spia", materials_folder);
    EXPECT_EQ(project.ran, Stage::solve);
    EXPECT_EQ(to_json(SetViewSettings{project.view}), to_json(SetViewSettings{view}));
    EXPECT_EQ(to_json(SetDisplay{after.display}), to_json(SetDisplay{before.display}));
    EXPECT_EQ(after.session.options.grid, before.session.options.grid);
    EXPECT_EQ(after.session.options.flatten.thickness, 0.8);
    EXPECT_EQ(after.session.options.flatten.direction, before.session.options.flatten.direction);
    EXPECT_EQ(after.session.options.flatten.material.name, before.session.options.flatten.material.name);
    EXPECT_EQ(fit_choice(after.session.options),
              (FitChoice{0.035, 5, 3, CurveEnds::clamped, FitParameters::corrected, 4321}));
    EXPECT_EQ(after.session.options.read.unit, LengthUnit::mm);

    save_project(
        folder / "b.spia",
        [&] { // nothing is worn down by going round
            Document again = after;
            again.session = run_stage(Stage::solve, again.session);
            return again;
        }(),
        project.view);
    EXPECT_EQ(content_of(folder / "a.spia"), content_of(folder / "b.spia"));
}

TEST(ProjectFile, FindsThePartWhenFolderOrProjectMoves)
{
    const ScratchFolder folder;
    fs::create_directories(folder / "one/parts");
    fs::copy_file(dome, folder / "one/parts/dome.obj");
    save_project(folder / "one/a.spia", viewer::document_of(folder / "one/parts/dome.obj", Stage::read), {});
    const auto part_of = [](const fs::path& file) {
        return open_project(file, materials_folder).document.session.file;
    };
    fs::copy_file(folder / "one/a.spia", folder / "alone.spia");
    EXPECT_TRUE(fs::equivalent(part_of(folder / "alone.spia"), folder / "one/parts/dome.obj"));
    fs::rename(folder / "one", folder / "two");
    EXPECT_TRUE(fs::equivalent(part_of(folder / "two/a.spia"), folder / "two/parts/dome.obj"));
    EXPECT_FALSE(fs::exists(part_of(folder / "alone.spia"))); // reading it will say so
}

TEST(ProjectFile, AMaterialFileMovesWithTheProjectAndAMissingOneIsNamed)
{
    const ScratchFolder folder;
    fs::create_directories(folder / "one");
    fs::copy_file(materials_folder / "dp600.json", folder / "one/mine.json");
    Document document = viewer::document_of(dome, Stage::read);
    document.material = (folder / "one/mine.json").string();
    save_project(folder / "one/a.spia", document, {});
    fs::rename(folder / "one", folder / "two");
    EXPECT_EQ(open_project(folder / "two/a.spia", materials_folder).document.session.options.flatten.material.name,
              find_material("dp600", materials_folder).name);
    fs::remove(folder / "two/mine.json");
    EXPECT_NE(refusal(folder / "two/a.spia").find("mine.json"), std::string::npos);
}

TEST(ProjectFile, PicksFollowTheFacesOfARenumberedPart)
{
    const ScratchFolder folder;
    fs::copy_file(dome, folder / "part.obj");
    const Document before = picked(folder / "part.obj", Stage::read);
    save_project(folder / "a.spia", before, {});
    const TriMesh& mesh = before.session.part->mesh;
    const auto permuted = shapes::permuted(mesh, 5);
    shapes::write_mesh(folder / "part.obj", permuted.mesh);

    std::vector<std::string> lost;
    const Document after = reopened(folder / "a.spia", lost);
    EXPECT_TRUE(lost.empty()) << lost.front();
    const auto renumbered = [&](std::vector<int> faces) {
        for (int& f : faces)
            f = permuted.face[size_t(f)];
        std::sort(faces.begin(), faces.end());
        return faces;
    };
    EXPECT_NE(after.selected, before.selected); // the test would be worth nothing
    EXPECT_EQ(after.selected, renumbered(before.selected));
    EXPECT_EQ(after.regions[0].faces, renumbered(before.regions[0].faces));
    std::vector<int> vertices = before.vertices;
    for (int& v : vertices)
        v = permuted.vertex[size_t(v)];
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(after.vertices, vertices);
    EXPECT_EQ(after.regions[0].name, before.regions[0].name);
    EXPECT_TRUE(after.regions[1].faces.empty());
    const auto place = [](const Document& document, const Probe& probe) {
        const TriMesh& part = document.session.part->mesh;
        return Eigen::Vector3d(part.position(Eigen::all, part.triangle.col(probe.face)) * probe.barycentric);
    };
    for (size_t i = 0; i < 2; ++i)
        EXPECT_LT((place(after, after.probes[i]) - place(before, before.probes[i])).norm(), 2e-6);
    for (size_t k = 0; k < 4; ++k)
        EXPECT_EQ((*after.session.options.corners)[k], permuted.vertex[size_t((*before.session.options.corners)[k])]);
}

TEST(ProjectFile, PicksFindTheirPlaceOnAPartThatWasMeshedAnew)
{
    const ScratchFolder folder;
    const auto& sample = shapes::sample("inner-panel");
    const TriMesh coarse = sample.make(6000);
    for (const int triangles : {2500, 16000}) {
        Document before = document_of_mesh(coarse, folder / "part.obj");
        const double low = coarse.position.row(0).minCoeff(), high = coarse.position.row(0).maxCoeff();
        const double from = low + 0.2 * (high - low), to = low + 0.6 * (high - low);
        before.selected = faces_between(coarse, from, to);
        before.probes.push_back({1234, {0.2, 0.3, 0.5}});
        const auto loops = boundary_loops(coarse);
        before.vertices = {1500, loops[0][10], loops[1][3]};
        std::sort(before.vertices.begin(), before.vertices.end());
        const Eigen::Vector3d probed =
            coarse.position(Eigen::all, coarse.triangle.col(1234)) * before.probes[0].barycentric;
        save_project(folder / "a.spia", before, {});
        const TriMesh fine = sample.make(triangles);
        shapes::write_mesh(folder / "part.obj", fine);

        std::vector<std::string> lost;
        const Document after = reopened(folder / "a.spia", lost);
        EXPECT_TRUE(lost.empty()) << lost.front();
        // A face is in by its middle: along the two borders the area is uncertain by half an edge
        // on either side.
        const double border = 2 * (coarse.position.row(1).maxCoeff() - coarse.position.row(1).minCoeff());
        const double edge = std::max(shapes::mean_edge(coarse), shapes::mean_edge(fine));
        EXPECT_NEAR(area_of(fine, after.selected), area_of(coarse, before.selected), 0.5 * border * edge) << triangles;
        for (const int f : after.selected) {
            EXPECT_GT(centre_of(fine, f)[0], from - 1.5 * edge);
            EXPECT_LT(centre_of(fine, f)[0], to + 1.5 * edge);
        }
        ASSERT_EQ(after.probes.size(), 1u);
        // Each one has become one near it, those of the outline and of the hole again of a
        // boundary.
        ASSERT_EQ(after.vertices.size(), 3u);
        const auto on_boundary = [](const TriMesh& mesh, int v) {
            const auto all = boundary_vertices(mesh).vertex;
            return std::binary_search(all.begin(), all.end(), v);
        };
        for (const int old : before.vertices) {
            const auto away = [&](int v) { return (fine.position.col(v) - coarse.position.col(old)).norm(); };
            const int now = *std::min_element(after.vertices.begin(), after.vertices.end(),
                                              [&](int a, int b) { return away(a) < away(b); });
            EXPECT_LT(away(now), 1.5 * edge);
            EXPECT_TRUE(old == 1500 || on_boundary(fine, now));
        }
        const Probe& probe = after.probes[0];
        const Eigen::Vector3d at = fine.position(Eigen::all, fine.triangle.col(probe.face)) * probe.barycentric;
        EXPECT_LT((at - probed).norm(), 0.1 * edge);
    }
}

TEST(ProjectFile, WhatIsGoneFromAChangedPartIsReported)
{
    const ScratchFolder folder;
    Document before = document_of_mesh(shapes::rectangle(100, 60, 50, 30), folder / "part.obj");
    const TriMesh mesh = before.session.part->mesh;
    before.regions.push_back({"left", RegionKind::fixed, {}, faces_between(mesh, 0, 20)});
    before.regions.push_back({"right", RegionKind::fixed, {}, faces_between(mesh, 80, 100)});
    before.probes.push_back({faces_between(mesh, 95, 100)[0], {1. / 3, 1. / 3, 1. / 3}});
    before.session.options.corners = {0, 50, 50 + 30 * 51, 30 * 51};
    // a corner, the middle, two at the right edge
    before.vertices = {0, 25 + 15 * 51, 49 + 15 * 51, 50 + 15 * 51};
    std::sort(before.vertices.begin(), before.vertices.end());
    save_project(folder / "a.spia", before, {});
    std::vector<std::string> lost;

    // Cut off at x = 90: half of the right region goes, 10 x 60 mm on each side.
    shapes::write_mesh(folder / "part.obj", shapes::rectangle(90, 60, 45, 30));
    const Document cut = reopened(folder / "a.spia", lost);
    EXPECT_EQ(cut.regions[0].faces.size(), before.regions[0].faces.size());
    EXPECT_EQ(cut.regions[1].faces.size(), before.regions[1].faces.size() / 2);
    EXPECT_TRUE(cut.probes.empty());
    EXPECT_FALSE(cut.session.options.corners);
    ASSERT_EQ(lost.size(), 4u);
    EXPECT_EQ(cut.vertices, (std::vector<int>{0, 25 + 15 * 46}));
    EXPECT_NE(lost[0].find("2 of the 4 picked vertices"), std::string::npos) << lost[0];
    EXPECT_NE(lost[1].find("of the 600 faces of the region \"right\""), std::string::npos) << lost[1];
    EXPECT_NE(lost[2].find("probe 1"), std::string::npos);
    EXPECT_NE(lost[3].find("corner 2"), std::string::npos);

    // Raised by half the reach: all is found. By three times the reach: nothing is.
    const double reach = 0.01 * bounding_diagonal(mesh);
    shapes::write_mesh(folder / "part.obj",
                       shapes::transformed(mesh, Eigen::Matrix3d::Identity(), {0, 0, 0.5 * reach}));
    const Document raised = reopened(folder / "a.spia", lost);
    EXPECT_TRUE(lost.empty()) << lost.front();
    EXPECT_EQ(raised.regions, before.regions);
    EXPECT_EQ(raised.vertices, before.vertices);
    EXPECT_EQ(raised.session.options.corners, before.session.options.corners);
    shapes::write_mesh(folder / "part.obj", shapes::transformed(mesh, Eigen::Matrix3d::Identity(), {0, 0, 3 * reach}));
    const Document away = reopened(folder / "a.spia", lost);
    EXPECT_EQ(lost.size(), 5u);
    EXPECT_TRUE(away.regions[0].faces.empty());

    // A trim further out by less than the reach: what was at the edge is again, though another
    // vertex is nearer.
    shapes::write_mesh(folder / "part.obj", shapes::rectangle(100.8, 60, 504, 30));
    const Document wider = reopened(folder / "a.spia", lost);
    ASSERT_EQ(wider.vertices.size(), 4u);
    EXPECT_EQ(wider.vertices[3], 504 + 15 * 505);

    // Turned over in place: the same places, but the other side.
    TriMesh turned = mesh;
    turned.triangle.row(0).swap(turned.triangle.row(1));
    shapes::write_mesh(folder / "part.obj", turned);
    EXPECT_TRUE(reopened(folder / "a.spia", lost).regions[0].faces.empty());
}

TEST(ProjectFile, ASplitPolygonKeepsItsPickedHalf)
{
    const ScratchFolder folder;
    put(folder / "quads.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n");
    Document before = viewer::document_of(folder / "quads.obj", Stage::read);
    ASSERT_EQ(before.session.part->mesh.triangles(), 4);
    before.selected = {1, 2};
    save_project(folder / "a.spia", before, {});
    std::vector<std::string> lost;
    EXPECT_EQ(reopened(folder / "a.spia", lost).selected, before.selected);
}

TEST(ProjectFile, VerticesThatShareANumberComeBackWhereTheyWere)
{
    Document document = viewer::document_of(SPIA_SOURCE_DIR "/assets/parts/dome.obj", Stage::read);
    PartFile part = *document.session.part; // as where chords of a rim were divided
    for (int v = 0; v < part.mesh.vertices(); ++v)
        part.source_vertex[size_t(v)] = v / 3;
    document.session.part = std::make_shared<PartFile>(part);
    document.vertices = {4, 30, 38};
    const StoredPicks picks = store_picks(document);
    Document after = document;
    after.vertices.clear();
    EXPECT_TRUE(restore_picks(after, picks).empty());
    EXPECT_EQ(after.vertices, document.vertices);
}

TEST(ProjectFile, WhatIsNoProjectIsRefusedInPlainWords)
{
    const ScratchFolder folder;
    save_project(folder / "a.spia", viewer::document_of(dome, Stage::read), {});
    const std::string good = content_of(folder / "a.spia");
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        EXPECT_NE(text.find(from), std::string::npos) << from;
        put(folder / "b.spia", text.replace(text.find(from), from.size(), to));
        return refusal(folder / "b.spia");
    };
    EXPECT_NE(refused("spia-project/1", "spia-project/2").find("newer version of the program"), std::string::npos);
    EXPECT_NE(refused("spia-project/1", "spia-project/1x").find("is not a SPIA project"), std::string::npos);
    EXPECT_NE(refused("spia-project/1", "spia-project/").find("is not a SPIA project"), std::string::npos);
    EXPECT_NE(refused("spia-project/1", "spia-script/1").find("is not a SPIA project"), std::string::npos);
    EXPECT_NE(refused("\"thickness\"", "\"thicknes\"").find("thicknes"), std::string::npos);
    EXPECT_NE(refused("\"dark\":true", "\"dark\":1").find("/view/dark must be true or false"), std::string::npos);
    EXPECT_NE(refused("\"mild_steel\"", "\"gold\"").find("gold"), std::string::npos);
    const auto lines_before = std::count(good.begin(), good.begin() + long(good.find("\"display\"")), '\n');
    EXPECT_NE(refused("\"display\"", "display").find(fmt::format("line {}", lines_before + 1)), std::string::npos);
    EXPECT_NE(refusal(folder / "none.spia").find("none.spia"), std::string::npos);
    EXPECT_NE(refusal(folder / ".").find("no file"), std::string::npos);
    put(folder / "b.spia", "");
    EXPECT_NE(refusal(folder / "b.spia"), "opened");
    put(folder / "b.spia",
        // deep nesting must not end the stack
        std::string(1000000, '[') + std::string(1000000, ']'));
    EXPECT_NE(refusal(folder / "b.spia"), "opened");
    Document nothing;
    EXPECT_THROW(save_project(folder / "c.spia", nothing, {}), InputError);
    EXPECT_THROW(save_project(folder / "nowhere/c.spia", viewer::document_of(dome, Stage::read), {}), ExchangeError);
}

/// Before it could be asked for, no triangles of CAD faces were remeshed unasked: cuts and corners
/// name their vertices.
TEST(ProjectFile, OneFromBeforeKeepsTheTrianglesOfCadFaces)
{
    const ScratchFolder folder;
    save_project(folder / "a.spia", viewer::document_of(dome, Stage::read), {});
    EXPECT_FALSE(open_project(folder / "a.spia", materials_folder).document.session.options.read.cad.keep_triangles);
    std::string text = content_of(folder / "a.spia");
    const std::string member = "\"keep_triangles\":false,";
    ASSERT_NE(text.find(member), std::string::npos);
    put(folder / "b.spia", text.erase(text.find(member), member.size()));
    EXPECT_TRUE(open_project(folder / "b.spia", materials_folder).document.session.options.read.cad.keep_triangles);
}

TEST(ProjectFile, ASectionWithoutAPlaneIsRefused)
{
    const ScratchFolder folder;
    Document document = viewer::document_of(dome, Stage::read);
    const auto said = [&](const SectionLine& line) {
        document.section = line;
        save_project(folder / "a.spia", document, {});
        return refusal(folder / "a.spia");
    };
    EXPECT_EQ(said({{1, 2, 3}, {4, 2, 3}, {0, 0, -1}}), "opened");
    EXPECT_NE(said({{1, 2, 3}, {1, 2, 3}, {0, 0, -1}}).find("/section must have two places"), std::string::npos);
    EXPECT_NE(said({{1, 2, 3}, {1, 2, 5}, {0, 0, -1}}).find("/section must have two places"), std::string::npos);
    EXPECT_NE(said({{1, 2, 3}, {4, 2, 3}, {0, 0, 0}}).find("/section must have two places"), std::string::npos);
}

TEST(ProjectFile, DamageOfAnyKindEndsInAnInputError)
{
    const ScratchFolder folder;
    fs::copy_file(dome, folder / "dome.obj");
    Document document = picked(folder / "dome.obj", Stage::read);
    document.selected.resize(20); // a small file, so that damage meets every part of it
    document.regions[0].faces.resize(10);
    save_project(folder / "a.spia", document, {});
    std::string good = content_of(folder / "a.spia");
    // the same damage on every machine
    for (const std::string_view varies : {"\"was_at\":\"", "\"program\": \""}) {
        const size_t value = good.find(varies) + varies.size();
        ASSERT_LT(value, good.size());
        ASSERT_GE(value, varies.size());
        good.replace(value, good.find('"', value) - value, "same");
    }
    std::mt19937 random(20);
    const auto below = [&](size_t n) { return size_t(random() % n); };
    const char* hostile[] = {"-1",    "1e300", "1e999",      "99999999999999999999", "null", "[]",    "{}",     "\"\"",
                             "\"x\"", "0",     "2147483647", "-2147483648",          "true", "[[1]]", "\\u0000"};
    Document changed = document; // its picks are looked for by their geometry
    auto renumbered = std::make_shared<PartFile>(*document.session.part);
    renumbered->mesh = shapes::permuted(renumbered->mesh, 1).mesh;
    changed.session.part = renumbered;
    int refused = 0, opened = 0, damaged_faces = 0;
    for (int round = 0; round < 1500; ++round) {
        std::string text = good;
        for (size_t k = 1 + below(3); k-- > 0;) {
            const size_t at = std::min(below(2) * good.find("\"picks\"") + below(text.size()), text.size() - 1);
            switch (below(5)) {
            case 0: text[at] = char(random()); break;
            case 1: text.erase(at, 1 + below(8)); break;
            case 2: text.insert(at, text, below(text.size()), 1 + below(30)); break;
            case 3: text.resize(below(20) ? text.size() : at + 1); break;
            default: { // a number becomes something else
                const size_t digit = text.find_first_of("0123456789", at);
                if (digit == std::string::npos)
                    break;
                const size_t end = text.find_first_not_of("0123456789.e-", digit);
                text.replace(digit, std::min(end, text.size()) - digit, hostile[below(std::size(hostile))]);
            }
            }
        }
        put(folder / "b.spia", text);
        Document restored = round % 2 ? document : changed;
        try {
            const Project project = open_project(folder / "b.spia", materials_folder);
            restore_picks(restored, project.picks);
            ++opened;
            for (const int f : restored.selected)
                ASSERT_TRUE(f >= 0 && f < document.session.part->mesh.triangles());
            ASSERT_TRUE(std::is_sorted(restored.vertices.begin(), restored.vertices.end()));
            for (const int v : restored.vertices)
                ASSERT_TRUE(v >= 0 && v < document.session.part->mesh.vertices());
        } catch (const InputError& error) {
            ++refused;
            damaged_faces += std::string(error.what()).find("damaged") != std::string::npos;
        }
    }
    EXPECT_GT(refused, 500);
    EXPECT_GT(damaged_faces, 0); // the checks of the faces were reached
    EXPECT_GT(opened, 25);       // so the picks of damaged files were looked at, too
}

} // namespace spia::viewer

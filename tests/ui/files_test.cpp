#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sstream>

#include "tests/support/mesh_file.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"
#include "tests/ui/viewer_process.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

/// 120 x 80 mm in cells of 10 mm, folded down at x = 60.
TriMesh folded()
{
    TriMesh mesh = shapes::rectangle(120, 80, 12, 8);
    for (int v = 0; v < mesh.vertices(); ++v)
        if (const double beyond = mesh.position(0, v) - 60; beyond > 0)
            mesh.position.col(v) = Eigen::Vector3d(60, mesh.position(1, v), -beyond);
    return mesh;
}

/// The folded sheet and, 200 mm beside it, a small one.
TriMesh two_pieces()
{
    const TriMesh large = folded(), small = shapes::rectangle(10, 10, 2, 2);
    TriMesh both;
    both.position.resize(3, large.vertices() + small.vertices());
    both.position << large.position, small.position.colwise() + Eigen::Vector3d(200, 0, 0);
    both.triangle.resize(3, large.triangles() + small.triangles());
    both.triangle << large.triangle, small.triangle.array() + large.vertices();
    return both;
}

/// Width and height of a PNG file; 0 by 0 if it is none.
std::pair<int, int> png_size(const fs::path& file)
{
    const std::string bytes = content(file);
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG")
        return {0, 0};
    const auto number = [&](size_t at) {
        int value = 0;
        for (size_t k = at; k < at + 4; ++k)
            value = value * 256 + static_cast<unsigned char>(bytes[k]);
        return value;
    };
    return {number(16), number(20)};
}

struct Scripts : testing::Test {
    fs::path folder =
        scratch_folder(std::string("script-") + testing::UnitTest::GetInstance()->current_test_info()->name());

    Ended run(const std::string& script)
    {
        const Ended ended = run_viewer(folder, {"--script", SPIA_SOURCE_DIR "/tests/ui/scripts/" + script});
        EXPECT_EQ(ended.exit_code, 0) << ended.errors;
        return ended;
    }
};

TEST_F(Scripts, PickByEveryTool)
{
    shapes::write_mesh(folder / "folded.obj", folded());
    run("picking.json");
}

TEST_F(Scripts, LookAtFieldsProbesAndDirections)
{
    shapes::write_mesh(folder / "folded.obj", folded());
    run("looking.json");
}

TEST_F(Scripts, MendAPartOfTwoPieces)
{
    shapes::write_mesh(folder / "two-pieces.obj", two_pieces());
    run("faults.json");
}

/// Two sheets of 60 x 60 mm, bent a little, 3 x 3 quads each.
std::string deck_of_two_parts()
{
    std::string text = "*NODE\n";
    for (int part = 0; part < 2; ++part)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                text += fmt::format("{}, {}, {}, {}\n", 100 * part + 4 * i + j + 1, 500 * part + 20 * i, 20 * j, i * i);
    for (int part = 0; part < 2; ++part) {
        text += fmt::format("*ELEMENT, TYPE=S4R, ELSET={}\n", part == 0 ? "Lid" : "Base");
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const int n = 100 * part + 4 * i + j + 1;
                text += fmt::format("{}, {}, {}, {}, {}\n", 100 * part + 3 * i + j + 1, n, n + 4, n + 5, n + 1);
            }
    }
    return text + "*SHELL SECTION, ELSET=Lid, MATERIAL=DC04\n0.8, 5\n*SHELL SECTION, ELSET=Base, MATERIAL=DC01\n1.5\n";
}

TEST_F(Scripts, ImportAPartOfADeckRemeshItAndReadAnother)
{
    std::ofstream(folder / "two-parts.inp") << deck_of_two_parts();
    run("importing.json");
}

TEST_F(Scripts, UnfoldStepByStep)
{
    run("unfolding.json");
    EXPECT_EQ(png_size(folder / "unfolding.png"), std::pair(600, 400));
}

TEST_F(Scripts, CancelALongSolveAndKeepWhatWasThere)
{
    shapes::write_mesh(folder / "large.obj", shapes::sample("fender").make(60000));
    run("cancel.json");
}

TEST_F(Scripts, WriteFilesPicturesAndAReportAsWanted)
{
    shapes::write_mesh(folder / "folded.obj", folded());
    const Ended ended = run("leaving.json");
    EXPECT_NE(ended.report["messages"].dump().find("no-such-format"), std::string::npos);

    const fs::path out = folder / "out";
    EXPECT_NE(content(out / "leg.dxf").find("$INSUNITS\n 70\n1\n"), std::string::npos) << "inches are 1";
    EXPECT_NE(content(out / "leg.step").find("INCH"), std::string::npos);
    EXPECT_NE(content(out / "leg.iges").find("4HINCH"), std::string::npos);
    for (const char* file : {"leg-gismo.xml", "leg-gismo-thickness.xml", "leg-gismo-plastic_strain.xml", "leg-iga.k"})
        EXPECT_NE(content(out / file).find("lengths inch"), std::string::npos) << file;
    const std::string glb = content(out / "leg.glb");
    EXPECT_NE(glb.find("\"blank\""), std::string::npos);
    EXPECT_NE(glb.find("\"control_net\""), std::string::npos);
    EXPECT_EQ(glb.find("\"quad_mesh\""), std::string::npos);
    EXPECT_FALSE(fs::exists(out / "leg-fields.csv"));
    std::istringstream outline(content(out / "leg-outline.csv"));
    std::string line;
    double least = 1e9, greatest = -1e9, perimeter = 0;
    std::optional<std::pair<double, double>> first, last;
    for (bool head = true; std::getline(outline, line); head = false) {
        int loop = 0, index = 0;
        double x = 0, y = 0;
        if (head || std::sscanf(line.c_str(), "%d,%d,%lf,%lf", &loop, &index, &x, &y) != 4)
            continue;
        least = std::min(least, x);
        greatest = std::max(greatest, x);
        if (last)
            perimeter += std::hypot(x - last->first, y - last->second);
        else
            first = {x, y};
        last = {x, y};
    }
    ASSERT_TRUE(last) << "an outline";
    perimeter += std::hypot(first->first - last->first, first->second - last->second);
    EXPECT_NEAR(perimeter, 400 / 25.4, 1e-3) << "120 x 80 mm in inches";

    EXPECT_EQ(png_size(folder / "with-legend.png"), std::pair(500, 300));
    EXPECT_EQ(png_size(folder / "large.png"), std::pair(5000, 3000));
    EXPECT_EQ(png_size(folder / "window.png"), std::pair(1440, 900));
    EXPECT_NE(content(folder / "with-legend.png"), content(folder / "without-legend.png"));

    const std::string html = content(folder / "report.html");
    EXPECT_NE(html.find("Leg &lt;1&gt; &amp; more"), std::string::npos);
    EXPECT_EQ(html.find("Leg <1>"), std::string::npos);
    EXPECT_NE(html.find("second"), std::string::npos);
    EXPECT_EQ(html.find("Convergence of the solver"), std::string::npos);
    size_t pictures = 0;
    for (size_t at = 0; (at = html.find("data:image/png", at)) != std::string::npos; ++at)
        ++pictures;
    EXPECT_EQ(pictures, 1);
    EXPECT_FALSE(fs::exists(folder / "early.html"));
}

/// Takes out how long everything took, of a stage as of each attempt in it.
void erase_times(Json& report)
{
    if (report.is_object())
        report.erase("seconds");
    for (Json& part : report)
        if (part.is_structured())
            erase_times(part);
}

/// What a project does not keep: how long things took, what was said, what can be undone, what the
/// user prefers (scripts have the standard preferences).
Json lasting(Json report)
{
    for (const char* each :
         {"frames", "frames_while_solving", "messages", "history", "window", "hovered", "job", "preferences"})
        report.erase(each);
    erase_times(report["figures"]);
    // a project knows its part by the whole path
    for (const char* each : {"peak_memory_mb", "input"})
        report["figures"].erase(each);
    report["part"].erase("file");
    return report;
}

TEST_F(Scripts, AReopenedProjectIsWhatWasSaved)
{
    fs::create_directory(folder / "kept");
    const Ended saved = run("working.json");
    ASSERT_TRUE(fs::exists(folder / "kept/dome.spia"));
    // the theme is that of the screen
    const Ended reopened = run_viewer(folder, {"kept/dome.spia", "--light"});
    ASSERT_EQ(reopened.exit_code, 0) << reopened.errors;
    const Json before = lasting(saved.report), after = lasting(reopened.report);
    ASSERT_GT(before["regions"][0]["faces"], 0);
    for (const auto& [name, value] : before.items())
        EXPECT_TRUE(after.contains(name) && after[name] == value)
            << name << ": " << (after.contains(name) ? Json::diff(value, after[name]).dump(1) : "missing");
}

/// Of this process and those it starts; as it was at the end.
struct Environment {
    std::string name;
    std::optional<std::string> before;
    Environment(const char* variable, const char* value) : name(variable)
    {
        if (const char* is = getenv(variable))
            before = is;
        setenv(variable, value, 1);
    }
    ~Environment() { before ? setenv(name.c_str(), before->c_str(), 1) : unsetenv(name.c_str()); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
};

TEST_F(Scripts, WithoutOpenGlOrDisplayThereIsAWayOut)
{
    {
        const Environment old("MESA_GL_VERSION_OVERRIDE", "2.1");
        const Ended ended = run_viewer(folder, {"assets/parts/dome.obj"});
        EXPECT_EQ(ended.exit_code, 5);
        EXPECT_NE(ended.errors.find("no OpenGL 3.3"), std::string::npos) << ended.errors;
        EXPECT_NE(ended.errors.find("spia run PART"), std::string::npos) << ended.errors;
    }
    const Environment none("DISPLAY", ":9999");
    const Ended ended = run_viewer(folder, {"assets/parts/dome.obj"});
    EXPECT_EQ(ended.exit_code, 5);
    EXPECT_NE(ended.errors.find("no window can be opened"), std::string::npos) << ended.errors;
    EXPECT_NE(ended.errors.find("spia run PART"), std::string::npos) << ended.errors;
}

TEST_F(Scripts, EveryBadFileIsAMessageAndNoEnd)
{
    std::ofstream(folder / "empty.stl");
    std::ofstream(folder / "noise.obj") << "v 1 2\nf 1 2 3\n";
    std::ofstream(folder / "points.obj") << "v 1 2 3\nv 2 2 3\n"; // nothing to show at all
    std::ofstream(folder / "far.obj") << "v 1e30 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder / "broken.spia") << "{\"schema\": \"spia-project/1\"";
    std::ofstream(folder / "newer.spia") << "{\"schema\": \"spia-project/99\"}";
    for (const char* file :
         {"empty.stl", "noise.obj", "points.obj", "far.obj", "broken.spia", "newer.spia", "missing.ply", "assets"}) {
        const Ended ended = run_viewer(folder, {file});
        EXPECT_EQ(ended.exit_code, 1) << file << ": " << ended.errors;
        ASSERT_FALSE(ended.report.is_null()) << file;
        EXPECT_TRUE(ended.report["part"].is_null()) << file;
        ASSERT_EQ(ended.report["messages"].size(), 1) << file;
        EXPECT_EQ(ended.report["messages"][0]["severity"], "error") << file;
        EXPECT_NE(ended.report["messages"][0]["text"].get<std::string>().find(fs::path(file).stem()), std::string::npos)
            << ended.report["messages"][0];
    }
}

} // namespace
} // namespace spia::viewer

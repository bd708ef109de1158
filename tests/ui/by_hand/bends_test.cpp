// Bends, cracks, closed corners and the DXF file of a blank, by mouse and keyboard.
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "tests/support/bent_parts.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_file.h"
#include "tests/support/profile.h"
#include "tests/support/shapes.h"
#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

using std::numbers::pi;

/// Legs of 40 and 25 mm around a bend by 90 degrees, 30 mm wide. @param middle mm, radius of the
/// middle surface
TriMesh bracket(double middle)
{
    return shapes::extruded(shapes::Profile({0, 0}, 0).straight(40).bend(middle, pi / 2).straight(25), 30, 600).mesh;
}

/// Torn along the faces on either side of a plane y = at: those beyond it get vertices of their own
/// there, off by up to the gap.
TriMesh torn(const TriMesh& mesh, double at, double gap)
{
    TriMesh result = mesh;
    std::vector<int> copy(size_t(mesh.vertices()), -1);
    for (int f = 0; f < mesh.triangles(); ++f) {
        if (mesh.position(1, mesh.triangle.col(f)).mean() < at)
            continue;
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.triangle(k, f);
            if (std::abs(mesh.position(1, v) - at) > 1e-6)
                continue;
            if (copy[size_t(v)] < 0) {
                copy[size_t(v)] = result.vertices();
                result.position.conservativeResize(3, result.position.cols() + 1);
                result.position.rightCols(1) = mesh.position.col(v) + Eigen::Vector3d(0, gap * (v % 2 ? 1 : 0.5), 0);
            }
            result.triangle(k, f) = copy[size_t(v)];
        }
    }
    return result;
}

/// A row of vertices about the middle of the part lies at this y.
double middle_row(const TriMesh& mesh)
{
    const double middle = (mesh.position.row(1).minCoeff() + mesh.position.row(1).maxCoeff()) / 2;
    Eigen::Index nearest = 0;
    (mesh.position.row(1).array() - middle).abs().minCoeff(&nearest);
    return mesh.position(1, nearest);
}

Eigen::Vector2d blank_size(const Json& now)
{
    const Json& box = now["figures"]["blank"]["bounding_box_mm"];
    return {box[2].get<double>() - box[0].get<double>(), box[3].get<double>() - box[1].get<double>()};
}

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

class BendsByHand : public OnPart {
protected:
    Json solve()
    {
        hands->keys("F6");
        return hands->see_that("a blank", [](const Json& now) {
            return now["job"]["running"] == false && now["stages"]["solve"] == true;
        });
    }
    /// Until the blank is that of a K factor.
    Json laid_with(const Json& k)
    {
        return hands->see_that("the blank with K " + k.dump(), [&](const Json& now) {
            return now["options"]["k_factor"] == k && now["job"]["running"] == false && now["stages"]["solve"] == true;
        });
    }
};

TEST_F(BendsByHand, TheKFactorIsChosenAndTheBlankFollows)
{
    constexpr double inner = 4.5, legs = 65; // of 1 mm sheet
    const auto length = [&](double k) { return legs + pi / 2 * (inner + k); };
    shapes::write_mesh(folder / "bracket.obj", bracket(inner + 0.5));
    std::ofstream(folder / "k.csv") << "R/t, K\n1, 0.33\n10, 0.42\n";
    start((folder / "bracket.obj").string());
    solve();
    hands->see("1 bend");
    click_left("0.5, middle surface");
    hands->click("number");
    hands->see_that("K 0.5", [](const Json& r) { return r["options"]["k_factor"] == "0.5"; });
    hands->see("number");
    hands->click_beside("number", 0, 32); // the field below
    hands->keys("ctrl+a");
    hands->type("0.38");
    hands->keys("Return");
    Json now = laid_with("0.38");
    EXPECT_NEAR(blank_size(now)[0], length(0.38), 1e-3);
    hands->see("0.38");
    hands->see("7.665"); // pi/2 (4.5 + 0.38)
    hands->see_part_of_line("neutral fibre");

    click_left("number");
    hands->click("DIN 6935");
    now = laid_with("din6935");
    EXPECT_NEAR(blank_size(now)[0], length((0.65 + 0.5 * std::log10(inner)) / 2), 1e-3);

    click_left("DIN 6935");
    hands->click("Table from a file...");
    hands->see("Choose a table of K factors");
    hands->type((folder / "k.csv").string());
    hands->keys("Return");
    now = laid_with((folder / "k.csv").string());
    EXPECT_NEAR(blank_size(now)[0], length(0.365), 1e-3);
    hands->see("k.csv");
    hands->click_part("1 up"); // the view goes to the bend
    hands->see_that("the bend", [](const Json& r) { return r["spot"].is_number(); });
}

TEST_F(BendsByHand, ACrackIsClosed)
{
    const TriMesh whole = bracket(5);
    shapes::write_mesh(folder / "torn.stl", torn(whole, middle_row(whole), 0.01));
    start((folder / "torn.stl").string());
    hands->see_part_of_line("Refused");
    click_left("Close the crack");
    hands->see_that("the part", [](const Json& r) { return r["part"].is_object() && !r["job"]["running"]; });
    const Json now = solve();
    EXPECT_EQ(now["part"]["vertices"], whole.vertices()) << "each on both sides of the crack is one now";
    EXPECT_EQ(now["part"]["triangles"], whole.triangles());
    EXPECT_EQ(now["figures"]["part"]["boundary_loops"], 1);
    EXPECT_NEAR(blank_size(now)[0], 65 + 5 * pi / 2, 0.1) << "chords for arcs";
    EXPECT_NEAR(blank_size(now)[1], 30, 0.02);
}

TEST_F(BendsByHand, TheCornersOfATrayAreCutAndItUnrolls)
{
    const shapes::LippedBox box;
    shapes::write_mesh(folder / "tray.obj", shapes::lipped_box(box));
    start((folder / "tray.obj").string());
    hands->see("1 note on the file"); // open, for something can be done
    click_left("Cut the corners");
    const Json now = hands->see_that("a blank with cuts", [](const Json& r) {
        return r["part"].is_object() && r["part"]["seam"].size() == 4 && r["stages"]["solve"] == true &&
               r["job"]["running"] == false;
    });
    hands->see_part_of_line("With the corners cut the equivalent strain is up to");
    EXPECT_NEAR(now["part"]["seam_length"].get<double>(), 4 * box.height, 1e-6);
    const double flap = 2 * (box.height + box.lip);
    EXPECT_NEAR(blank_size(now)[0], box.width + flap, 1e-3);
    EXPECT_NEAR(blank_size(now)[1], box.depth + flap, 1e-3);
    EXPECT_LT(now["figures"]["corner_cut"]["strain_after"]["most"], 1e-6);
    EXPECT_GT(now["figures"]["corner_cut"]["strain_before"]["most"], 0.1);
    hands->scroll_to("Strain, corners joined", left_x, left_y);
}

TEST_F(BendsByHand, TheDxfFileIsAsItsChoicesSay)
{
    TriMesh plate = shapes::rectangle(100, 60, 40, 24);
    for (int v = 0; v < plate.vertices(); ++v) // one side waves: no arc
        plate.position(1, v) += plate.position(1, v) / 60 * 8 * std::sin(2 * pi * plate.position(0, v) / 100);
    shapes::write_mesh(folder / "plate.obj", plate);
    start((folder / "plate.obj").string());
    solve();
    const auto file = folder / "plate-out" / "plate.dxf";
    const auto written = [&] {
        hands->keys("Return");
        hands->see_part_of_line("files written");
        const std::string text = text_of(file);
        hands->keys("Return");
        hands->see_no("files written");
        return text;
    };
    hands->keys("ctrl+e");
    hands->click("arcs, else polylines");
    hands->click("arcs, else splines");
    std::string text = written();
    EXPECT_NE(text.find("AC1015"), std::string::npos);
    EXPECT_NE(text.find("\nSPLINE\n"), std::string::npos);

    hands->keys("ctrl+e");
    hands->click("R2000");
    hands->click("R12");
    hands->see("arcs, else polylines"); // it has no splines
    hands->click("arcs, else polylines");
    hands->click("polylines only");
    text = written();
    EXPECT_NE(text.find("AC1009"), std::string::npos);
    for (const char* curve : {"\nSPLINE\n", "\nARC\n", "\nCIRCLE\n", "\nLWPOLYLINE\n"})
        EXPECT_EQ(text.find(curve), std::string::npos) << curve;
    EXPECT_NE(text.find("\nPOLYLINE\n"), std::string::npos);
}

} // namespace
} // namespace spia::viewer

#include "engine/pipeline/outputs/deck_outputs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/read_number.h"
#include "engine/exchange/deck/part_shells.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "tests/unit/exchange/sample_chain.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_outputs_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// Element ids with the ids of their corners.
std::map<std::int64_t, std::vector<std::int64_t>> shells_of(const Deck& deck)
{
    std::map<std::int64_t, std::vector<std::int64_t>> shells;
    for (int e = 0; e < deck.elements(); ++e)
        for (const int v : deck.corner[size_t(e)])
            if (v >= 0)
                shells[deck.element[size_t(e)]].push_back(deck.node[size_t(v)]);
    return shells;
}

std::map<std::int64_t, Vector3d> places_of(const Deck& deck)
{
    std::map<std::int64_t, Vector3d> places;
    for (int v = 0; v < deck.nodes(); ++v)
        places[deck.node[size_t(v)]] = deck.position[size_t(v)];
    return places;
}

Deck deck_in(const fs::path& file) { return read_deck(file, content_of(file)); }

/// Each line behind a keyword, up to the next one.
std::vector<std::string> cards(const fs::path& file, const std::string& keyword)
{
    std::istringstream lines(content_of(file));
    std::vector<std::string> found;
    bool inside = false;
    for (std::string line; std::getline(lines, line);)
        if (line[0] == '*')
            inside = line == keyword;
        else if (inside && line[0] != '$')
            found.push_back(line);
    return found;
}

double column(const std::string& line, size_t k, size_t width) { return std::stod(line.substr(k * width, width)); }

/// All formats of a part with a blank that is no solution: what is drawn on it by x and y, with
/// fields of any size.
class DeckFiles : public testing::Test {
protected:
    PartFile read(const std::string& name, const std::string& text, const ReadOptions& options = {})
    {
        put(scratch / name, text);
        return read_part(scratch / name, options);
    }
    void write(const PartFile& part)
    {
        fields = samples::smooth_fields(part.mesh.triangles());
        for (int f = 0; f < part.mesh.triangles(); ++f) // across the direction of the sample: on
                                                        // the face
            fields.direction_major.col(f) =
                (part.mesh.position.col(part.mesh.triangle(1, f)) - part.mesh.position.col(part.mesh.triangle(0, f)))
                    .normalized();
        blank.position = part.mesh.position.topRows<2>() / 3;
        files = write_deck_files(scratch / "", "out", deck_formats(), part, blank, fields);
    }
    Deck written(const char* file) { return deck_in(scratch / file); }

    ScratchFolder scratch;
    SheetFields fields;
    Blank blank;
    std::vector<fs::path> files;
};

const char* const mesh_files[] = {"out-dynain.k",  "out-thickness.bdf", "out-blank.k",
                                  "out-blank.bdf", "out-blank.inp",     "out-blank.msh"};

TEST_F(DeckFiles, ReadBackWithTheIdsCornersPartsAndPlacesOfTheDeck)
{
    for (const auto& [name, text] : sample::decks()) {
        SCOPED_TRACE(name);
        const PartFile part = read(name, text);
        write(part);
        EXPECT_EQ(files.size(), 9u);
        const Deck before = sample::read(name, text);
        for (const char* file : mesh_files) {
            SCOPED_TRACE(file);
            const Deck after = written(file);
            EXPECT_EQ(shells_of(after), shells_of(before)); // quads are quads
            const bool flat = std::string(file).find("blank") != std::string::npos;
            for (const auto& [id, place] : places_of(after)) {
                Vector3d expected = places_of(before).at(id);
                if (flat)
                    expected = {expected[0] / 3, expected[1] / 3, 0};
                // 12 digits
                EXPECT_LT((place - expected).norm(), 1e-11 * (1 + expected.norm())) << id;
            }
            EXPECT_EQ(after.nodes(), before.nodes());
            for (int e = 0; e < after.elements(); ++e) {
                const DeckPart& deck_part = after.parts[size_t(after.part_of[size_t(e)])];
                const bool hood = after.element[size_t(e)] <= 504;
                if (!name.ends_with(".inp") && !std::string(file).ends_with(".inp")) {
                    EXPECT_EQ(deck_part.id, hood ? 7 : 9);
                }
                if (flat) {
                    EXPECT_TRUE(same_letters(deck_part.name, hood ? "Hood" : "Rail")) << deck_part.name;
                }
                if (flat && !std::string(file).ends_with(".msh")) {
                    EXPECT_EQ(deck_part.thickness, 0.8);
                }
            }
        }
    }
}

TEST_F(DeckFiles, IdsThatAreTooLongForKeywordFilesAreToldBeforeTheSolve)
{
    const PartFile part =
        read("long.k", "*KEYWORD\n*NODE\n123456789001,0,0,0\n123456789002,1,0,0\n123456789003,1,1,0\n"
                       "*ELEMENT_SHELL\n1,5,123456789001,123456789002,123456789003,123456789003\n*END\n");
    for (const char* format : {"dynain", "blank-k"}) {
        const std::string formats[] = {"mapping", format};
        EXPECT_THROW(require_deck_ids(formats, part), InputError) << format;
    }
    for (const char* format : {"mapping", "blank-msh", "blank-inp", "blank-bdf", "nastran"}) {
        const std::string one[] = {format};
        EXPECT_NO_THROW(require_deck_ids(one, part)) << format;
    }
    const std::string all[] = {"dynain", "blank-k"};
    EXPECT_NO_THROW(require_deck_ids(
        all, read("short.k", "*KEYWORD\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n*ELEMENT_SHELL\n1,5,1,2,3,3\n*END\n")));
}

TEST_F(DeckFiles, AUniformlyStretchedPatchHasItsStrainAndThicknessOnEveryElement)
{
    const double along_x = 1.2, along_y = 1.05, h0 = 0.8;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    std::string text = "*KEYWORD\n*NODE\n";
    const auto id = [](int i, int j) { return 10 * i + j + 1; };
    std::map<int, Eigen::Vector2d> flat;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const Eigen::Vector2d x(10 * i + (j == 1 ? 2.5 : 0), 8 * j + (i == 2 ? 1.5 : 0));
            flat[id(i, j)] = {x[0] / along_x, x[1] / along_y};
            const Vector3d p = turn * Vector3d(x[0], x[1], 0);
            text += fmt::format("{},{},{},{}\n", id(i, j), p[0], p[1], p[2]);
        }
    text += "*ELEMENT_SHELL\n";
    std::vector<std::vector<int>> corners;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            std::vector<int> quad = {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)};
            if ((i + j) % 2)
                std::reverse(quad.begin(), quad.end()); // mixed sides
            if (i == 1 && j == 1)
                quad[3] = quad[2];
            corners.push_back(quad);
            text += fmt::format("{},1,{},{},{},{}\n", 100 + corners.size(), quad[0], quad[1], quad[2], quad[3]);
        }
    // the other half of the quad in the middle
    text += fmt::format("200,1,{},{},{},0\n", id(1, 1), id(2, 2), id(1, 2));
    const PartFile part = read("patch.k", text);
    ASSERT_TRUE(part.doctor.find(Fault::flipped_face));
    blank.position.resize(2, part.mesh.vertices());
    for (int v = 0; v < part.mesh.vertices(); ++v)
        blank.position.col(v) = flat.at(int(part.deck->node_id[size_t(part.source_vertex[size_t(v)])]));
    const Material steel{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1, 1, 1, ""};
    fields = face_fields(part.mesh, elements(part.mesh), blank,
                         uniform_sheet(MembraneLaw(steel), h0, part.mesh.triangles()));
    write_deck_files(scratch / "", "out", deck_formats(), part, blank, fields);

    const double e1 = std::log(along_x), e2 = std::log(along_y);
    const double equivalent = std::sqrt((e1 * e1 + e2 * e2 + e1 * e2) * 4 / 3), thickness = h0 / along_x / along_y;
    const Eigen::Matrix3d strain = turn * Vector3d(e1, e2, -e1 - e2).asDiagonal() * turn.transpose();
    const auto stress_cards = cards(scratch / "out-dynain.k", "*INITIAL_STRESS_SHELL");
    const auto strain_cards = cards(scratch / "out-dynain.k", "*INITIAL_STRAIN_SHELL");
    const auto shell_cards = cards(scratch / "out-dynain.k", "*ELEMENT_SHELL_THICKNESS");
    ASSERT_EQ(stress_cards.size(), 3 * 10u);
    ASSERT_EQ(strain_cards.size(), 5 * 10u);
    ASSERT_EQ(shell_cards.size(), 2 * 10u);
    for (size_t e = 0; e < 10; ++e) {
        const double id_of_element = e < 9 ? 101. + double(e) : 200;
        EXPECT_EQ(stress_cards[3 * e],
                  fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}", id_of_element, 1, 1, 0, 0, 1));
        EXPECT_EQ(stress_cards[3 * e + 1].size(), 80u);
        EXPECT_EQ(stress_cards[3 * e + 2].size(), 48u);
        EXPECT_NEAR(column(stress_cards[3 * e + 2], 2, 16), equivalent, 1e-12);
        EXPECT_EQ(strain_cards[5 * e], fmt::format("{:>10}{:>10}{:>10}{:>10}", id_of_element, 1, 2, 1));
        for (const size_t skin : {1, 3}) {
            const std::pair<int, int> at[] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
            for (size_t k = 0; k < 6; ++k)
                EXPECT_NEAR(column(strain_cards[5 * e + skin + k / 5], k % 5, 16), strain(at[k].first, at[k].second),
                            1e-10);
            EXPECT_EQ(column(strain_cards[5 * e + skin + 1], 1, 16), skin == 1 ? -1 : 1);
        }
        for (size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(column(shell_cards[2 * e + 1], k, 16), thickness, 1e-12);
            if (e < 9) { // the side of the deck
                EXPECT_EQ(column(shell_cards[2 * e], 2 + k, 8), corners[e][k]);
            }
        }
    }
    for (const char* file : {"out-dynain.k", "out-thickness.bdf"}) {
        const Deck deck = written(file);
        ASSERT_EQ(deck.thickness.size(), 10u) << file;
        for (const double t : deck.thickness)
            EXPECT_NEAR(t, thickness, 1e-12) << file;
    }
    std::istringstream table(content_of(scratch / "out-elements.csv")),
        strains(content_of(scratch / "out-strains.csv"));
    std::string line, strain_line;
    std::getline(table, line);
    std::getline(strains, strain_line);
    EXPECT_EQ(line, "element,part,thickness,thinning,plastic_strain,strain_major,strain_minor");
    int rows = 0;
    while (std::getline(table, line) && std::getline(strains, strain_line)) {
        double element = 0, in_part = 0, t = 0, thinning = 0, plastic = 0, major = 0, minor = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &element, &in_part, &t, &thinning, &plastic,
                              &major, &minor),
                  7);
        EXPECT_EQ(element, rows < 9 ? 101 + rows : 200);
        EXPECT_EQ(in_part, 1);
        EXPECT_NEAR(t, thickness, 1e-12);
        EXPECT_NEAR(thinning, 1 - thickness / h0, 1e-12);
        EXPECT_NEAR(plastic, equivalent, 1e-12);
        EXPECT_NEAR(major, e1, 1e-12);
        EXPECT_NEAR(minor, e2, 1e-12);
        ASSERT_EQ(std::sscanf(strain_line.c_str(), "%lf,%lf,%lf,%lf,%lf", &element, &in_part, &plastic, &major, &minor),
                  5);
        EXPECT_NEAR(plastic, equivalent, 1e-12);
        EXPECT_NEAR(minor, e2, 1e-12);
        ++rows;
    }
    EXPECT_EQ(rows, 10);
}

TEST_F(DeckFiles, ThicknessTimesAreaAddsUpToTheVolumeAtElementsAndAtCorners)
{
    const PartFile part = read("strip.k", sample::dyna());
    write(part);
    fields.thickness.tail(5) *= 1.75; // a thicker sheet of a tailored blank
    double volume = 0;
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const auto t = part.mesh.triangle.col(f);
        const Vector3d a = part.mesh.position.col(t[0]);
        volume +=
            (part.mesh.position.col(t[1]) - a).cross(part.mesh.position.col(t[2]) - a).norm() / 2 * fields.thickness[f];
    }
    const PartShells shells = part_shells(part);
    const ElementFields on = element_fields(shells, part.mesh, fields);
    EXPECT_NEAR(on.thickness.dot(on.area) / volume, 1, 1e-14);
    double by_corners = 0;
    for (int e = 0; e < shells.mesh.elements(); ++e)
        by_corners += on.area[e] * on.corner_thickness.col(e).sum() / double(shells.mesh.corners(e));
    EXPECT_NEAR(by_corners / volume, 1, 1e-14);
    // and they do differ
    EXPECT_GT((on.corner_thickness.row(0) - on.corner_thickness.row(1)).norm(), 1e-3);
    const auto at = [&](std::int64_t id) {
        return std::find(shells.mesh.element.begin(), shells.mesh.element.end(), id) - shells.mesh.element.begin();
    };
    // 503 is thin and 505 thick, with an edge in common: both keep their sheet there
    EXPECT_LT(on.corner_thickness.col(at(503)).head(4).maxCoeff(), 1);
    EXPECT_GT(on.corner_thickness.col(at(505)).head(4).minCoeff(), 1.2);
}

TEST_F(DeckFiles, KeepTheUnitOfTheDeck)
{
    ReadOptions options;
    options.unit = LengthUnit::inch;
    const PartFile part = read("strip.bdf", sample::nastran(sample::Field::small), options);
    write(part);
    const Deck before = sample::read("strip.bdf", sample::nastran(sample::Field::small));
    EXPECT_EQ(places_of(written("out-thickness.bdf")), places_of(before));
    const auto blank_places = places_of(written("out-blank.msh"));
    for (const auto& [id, place] : places_of(before))
        EXPECT_NEAR(blank_places.at(id)[0], place[0] / 3, 1e-12);
    // six digits in ten columns
    EXPECT_NEAR(*written("out-blank.k").parts[0].thickness, 0.8 / 25.4, 5e-8);
    EXPECT_NE(content_of(scratch / "out-elements.csv").find("thickness_inch"), std::string::npos);
}

std::string with_ids(std::string text, int node, int element)
{
    const sample::Strip strip;
    std::string result = "*KEYWORD\n*NODE\n";
    for (const auto& [id, x] : strip.node)
        result += fmt::format("{},{},{},{}\n", std::int64_t(node) + id, x[0], x[1], x[2]);
    result += "1,1000,1000,1000\n*ELEMENT_SHELL\n"; // a node that no shell uses
    for (const auto& s : strip.shell)
        result += fmt::format("{},{},{},{},{},{}\n", std::int64_t(element) + s.id, s.part,
                              std::int64_t(node) + s.node[0], std::int64_t(node) + s.node[1],
                              std::int64_t(node) + s.node[2], s.node.size() > 3 ? std::int64_t(node) + s.node[3] : 0);
    return result + text;
}

TEST_F(DeckFiles, HoldIdsThatFillTheirColumns)
{
    // 211 and 507 are the last ones: up to eight digits, and more
    for (const auto& [node, element, i10] :
         {std::tuple(99999999 - 211, 99999999 - 507, false), std::tuple(100000000, 2000000000, true)}) {
        const std::string text = with_ids("", node, element);
        write(read("strip.k", text));
        const Deck before = sample::read("strip.k", text);
        for (const char* file : mesh_files) {
            EXPECT_EQ(shells_of(written(file)), shells_of(before)) << file;
            EXPECT_EQ(written(file).nodes(), before.nodes() - 1) << file;
        }
        EXPECT_EQ(content_of(scratch / "out-dynain.k").starts_with("*KEYWORD I10=Y"), i10);
    }
    const PartFile part = read("long.msh", [] {
        std::string text = sample::gmsh("2.2");
        for (size_t at = text.find("\n101 "); at != text.npos; at = text.npos)
            text.replace(at + 1, 3, "12345678901");
        for (size_t at = text.find(" 101"); at != text.npos; at = text.find(" 101", at + 12))
            text.replace(at + 1, 3, "12345678901");
        return text;
    }());
    EXPECT_THROW(write(part), InputError);
}

TEST_F(DeckFiles, TakeAQuadOnThreeNodesForATriangle)
{
    // 601 repeats its first node, 602 its last one, and 603 closes with its first.
    const PartFile part = read(
        "repeated.k", "*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,20,0,0\n6,20,10,0\n*ELEMENT_SHELL\n"
                      "601,1,1,1,2,3\n602,1,1,3,4,4\n603,1,2,5,6,2\n604,1,2,6,3,3\n");
    write(part);
    const std::map<std::int64_t, std::vector<std::int64_t>> expected = {
        {601, {1, 2, 3}}, {602, {1, 3, 4}}, {603, {2, 5, 6}}, {604, {2, 6, 3}}};
    for (const char* file : mesh_files)
        EXPECT_EQ(shells_of(written(file)), expected) << file;
}

TEST_F(DeckFiles, LeaveOutWhatTheDoctorLeftOutAndSaySo)
{
    const std::string text =
        "*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,20,0,0\n6,20,10,0\n11,50,0,0\n12,60,0,0\n"
        "13,60,10,0\n*ELEMENT_SHELL\n600,1,11,12,13,0\n601,1,1,2,3,4\n602,1,4,3,2,1\n603,1,2,5,6,3\n";
    ReadOptions options;
    options.doctor.keep_largest = true; // the second piece is 600, and 602 is 601 again
    write(read("pieces.k", text, options));
    const std::map<std::int64_t, std::vector<std::int64_t>> expected = {{601, {1, 2, 3, 4}}, {603, {2, 5, 6, 3}}};
    for (const char* file : mesh_files) {
        EXPECT_EQ(shells_of(written(file)), expected) << file;
        EXPECT_EQ(written(file).nodes(), 6) << file;
        EXPECT_NE(content_of(scratch / file).find("2 elements that the part does not have"), std::string::npos) << file;
    }
}

TEST_F(DeckFiles, KeepNodesThatWereJoined)
{
    const std::string text =
        "*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n12,10,0,0\n13,10.000001,10,0\n5,20,0,0\n6,20,10,0\n"
        "*ELEMENT_SHELL\n601,1,1,2,3,4\n603,1,12,5,6,13\n";
    ReadOptions options;
    options.weld = true;
    const PartFile part = read("welded.k", text, options);
    ASSERT_EQ(part.mesh.vertices(), 6);
    write(part);
    const Deck before = sample::read("welded.k", text);
    for (const char* file : mesh_files)
        EXPECT_EQ(shells_of(written(file)), shells_of(before)) << file;
    EXPECT_EQ(places_of(written("out-dynain.k")), places_of(before)); // where they were
    const auto flat = places_of(written("out-blank.msh"));
    EXPECT_EQ(flat.at(2), flat.at(12));
    EXPECT_EQ(flat.at(3), flat.at(13));
}

TEST_F(DeckFiles, GiveThePlacesOfASeamIdsOfTheirOwn)
{
    std::string text = "*KEYWORD\n*NODE\n";
    const int around = 8, along = 3;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i)
            text += fmt::format("{},{},{},{}\n", 100 * j + i + 1, 30 * std::cos(2 * std::numbers::pi * i / around),
                                30 * std::sin(2 * std::numbers::pi * i / around), 25 * j);
    text += "9000,7,7,7\n*ELEMENT_SHELL\n";
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i)
            text += fmt::format("{},1,{},{},{},{}\n", 100 * j + i + 1, 100 * j + i + 1, 100 * j + (i + 1) % around + 1,
                                100 * j + 100 + (i + 1) % around + 1, 100 * j + 100 + i + 1);
    ReadOptions straight, slanted;
    straight.seam.mode = slanted.seam.mode = SeamOptions::Mode::given;
    straight.seam.path = {{0, 8, 16, 24}};
    const PartFile part = read("tube.k", text, straight);
    ASSERT_EQ(part.mesh.vertices(), 32 + 4);
    write(part);
    const Deck before = sample::read("tube.k", text);
    EXPECT_EQ(shells_of(written("out-dynain.k")), shells_of(before)); // the tube is whole
    EXPECT_EQ(written("out-dynain.k").nodes(), 32);
    const Deck flat = written("out-blank.k");
    EXPECT_EQ(flat.nodes(), 36);
    ASSERT_EQ(flat.elements(), 24);
    std::map<std::int64_t, int> copies;
    for (const auto& [id, corners] : shells_of(flat)) {
        ASSERT_EQ(corners.size(), 4u);
        for (size_t k = 0; k < 4; ++k)
            if (corners[k] > 9000)
                ++copies[corners[k]];
            else
                EXPECT_EQ(corners[k], shells_of(before).at(id)[k]);
    }
    EXPECT_EQ(copies, (std::map<std::int64_t, int>{{9001, 1}, {9002, 2}, {9003, 2}, {9004, 1}}));
    std::istringstream rows(content_of(scratch / "out-nodes.csv"));
    int doubled = 0;
    for (std::string line; std::getline(rows, line);)
        doubled += line.starts_with("1,9001,") || line.starts_with("101,9002,") || line.starts_with("301,9004,");
    EXPECT_EQ(doubled, 3);

    // A seam through the diagonal of a quad tears it: two triangles, the first with its id.
    const Eigen::Vector3i t = part.mesh.triangle.col(0);
    std::set<int> corners;
    for (const int v : t)
        corners.insert(part.source_vertex[size_t(v)]);
    const bool rising = corners.count(0) && corners.count(9); // which diagonal the first quad has
    slanted.seam.path = {rising ? std::vector<int>{0, 9, 17, 25} : std::vector<int>{1, 8, 16, 24}};
    const PartFile torn = read("tube.k", text, slanted);
    write(torn);
    EXPECT_EQ(shells_of(written("out-dynain.k")), shells_of(before));
    const auto shells = shells_of(written("out-blank.k"));
    EXPECT_EQ(shells.size(), 25u);
    EXPECT_EQ(shells.at(1).size(), 3u);
    EXPECT_EQ(shells.at(208).size(), 4u);
    EXPECT_EQ(shells.rbegin()->first, 209);
    EXPECT_EQ(shells.at(209).size(), 3u);
}

TEST_F(DeckFiles, AreRefusedWhereAnIdStandsForTwo)
{
    std::string text = "*PART, NAME=A\n*NODE\n1,0,0,0\n2,10,0,0\n3,0,10,0\n*ELEMENT, TYPE=S3\n1,1,2,3\n*END PART\n"
                       "*PART, NAME=B\n*NODE\n1,10,0,0\n2,10,10,0\n3,0,10,0\n*ELEMENT, TYPE=S3\n1,1,2,3\n*END PART\n";
    ReadOptions options;
    options.weld = true;
    const PartFile part = read("twice.inp", text, options);
    try {
        write(part);
        FAIL() << "written";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("node 1 is there more than once"), std::string::npos) << error.what();
    }
    options.parts = {"A"};
    write(read("twice.inp", text, options));
    EXPECT_EQ(shells_of(written("out-dynain.k")).size(), 1u);
}

TEST_F(DeckFiles, AreRefusedForFacesThatAreNotOfTheDeck)
{
    PartFile part = read("strip.k", sample::dyna());
    part.source_face.pop_back();
    EXPECT_THROW(part_shells(part), InputError);
    part.source_face.assign(size_t(part.mesh.triangles()), 1000);
    EXPECT_THROW(part_shells(part), InputError);
}

TEST_F(DeckFiles, OfAnotherFileAreItsTrianglesNumberedFromOne)
{
    const PartFile part = read("part.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 20 5 1\nf 1 2 3 4\nf 2 5 3\n");
    write(part);
    for (const char* file : mesh_files) {
        const Deck deck = written(file);
        EXPECT_EQ(deck.node, (std::vector<std::int64_t>{1, 2, 3, 4, 5})) << file;
        EXPECT_EQ(deck.element, (std::vector<std::int64_t>{1, 2, 3})) << file;
        for (int e = 0; e < 3; ++e)
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(deck.corner[size_t(e)][size_t(k)], part.mesh.triangle(k, e));
    }
}

TEST_F(DeckFiles, OfRealDecksHaveTheirElements)
{
    const fs::path folder = fs::path(SPIA_SOURCE_DIR) / "../shared/data/fe";
    if (!fs::exists(folder))
        GTEST_SKIP() << "no " << folder;
    for (const char* name : {"car_hood_coarse.k", "crash_box_upper.k", "crash_box_upper.rad", "support_panel.bdf",
                             "support_trough.bdf", "aileron_skin.inp", "recliner_bracket.k", "drawn_cone_28k.k"}) {
        SCOPED_TRACE(name);
        if (!fs::exists(folder / name))
            continue;
        ReadOptions as_it_is;
        as_it_is.seam.mode = SeamOptions::Mode::none;
        const PartFile part = read_part(folder / name, as_it_is);
        const Deck before = deck_in(folder / name);
        write(part);
        for (const char* file : mesh_files) {
            const Deck after = written(file);
            EXPECT_EQ(shells_of(after), shells_of(before)) << file; // with their sides
            EXPECT_EQ(after.nodes(), part.file_vertices) << file;
        }
        const auto places = places_of(written("out-dynain.k"));
        double worst = 0, size = 0;
        for (const auto& [id, place] : places_of(before))
            if (places.count(id)) {
                worst = std::max(worst, (places.at(id) - place).norm());
                size = std::max(size, place.norm());
            }
        EXPECT_LE(worst, 1e-11 * size);
    }
}

TEST(DeckOutputs, OfASolvedPartConserveTheVolumeOfItsBlank)
{
    const fs::path file = fs::path(SPIA_SOURCE_DIR) / "../shared/data/fe/support_panel.bdf";
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    const ScratchFolder folder;
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session = completed(run_chain(std::move(session), Stage::read, Stage::solve, {.thickness = 1.2}));
    const auto files = write_outputs(session, folder / "out", deck_formats());
    EXPECT_EQ(files.size(), 9u);
    EXPECT_EQ(files, output_files(session, folder / "out", deck_formats()));
    const Deck formed = deck_in(folder / "out" / "support_panel-dynain.k"),
               flat = deck_in(folder / "out" / "support_panel-blank.msh");
    const auto area = [](const Deck& deck, int e) {
        const auto& c = deck.corner[size_t(e)];
        const auto at = [&](size_t k) { return deck.position[size_t(c[k])]; };
        const auto triangle = [&](size_t i, size_t j, size_t k) {
            return (at(j) - at(i)).cross(at(k) - at(i)).norm() / 2;
        };
        // a quad that is not flat has an area for each diagonal: the mean
        return c[3] < 0 ? triangle(0, 1, 2)
                        : (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(0, 1, 3) + triangle(1, 2, 3)) / 2;
    };
    ASSERT_EQ(formed.thickness.size(), size_t(formed.elements()));
    double volume = 0, before = 0;
    for (int e = 0; e < formed.elements(); ++e)
        volume += formed.thickness[size_t(e)] * area(formed, e);
    for (int e = 0; e < flat.elements(); ++e)
        before += 1.2 * area(flat, e);
    EXPECT_NEAR(volume / before, 1, 1e-4); // what is left is the choice of diagonals
    const PartShells shells = part_shells(*session.part);
    const ElementFields on = element_fields(shells, session.part->mesh, session.blank->face);
    double sheet = 0;
    for (int f = 0; f < session.part->mesh.triangles(); ++f) {
        const auto X = session.blank->blank.position(Eigen::all, session.part->mesh.triangle.col(f)).eval();
        sheet += 1.2 * (X.rightCols<2>().colwise() - X.col(0)).determinant() / 2;
    }
    EXPECT_NEAR(on.thickness.dot(on.area) / std::abs(sheet), 1, 1e-12);
    EXPECT_GT(std::abs(1.2 * on.area.sum() / std::abs(sheet) - 1), 1e-9) << "thickness makes no difference here";
}

} // namespace
} // namespace spia::deck_outputs_test

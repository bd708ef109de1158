#include <fstream>
#include <gtest/gtest.h>
#include <map>

#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/read_part.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_files_test {
namespace {

namespace fs = std::filesystem;

const fs::path data_folder = fs::path(SPIA_SOURCE_DIR) / "../shared/data";

/// As its origin states.
struct KnownDeck {
    const char* file;
    int nodes, quads, triangles, loops; ///< nodes: used by shells
    double thickness;                   ///< 0: none
    const char* material;
    bool flipped;
};

void PrintTo(const KnownDeck& deck, std::ostream* out) { *out << deck.file; }

class RealDeck : public testing::TestWithParam<KnownDeck> {};

TEST_P(RealDeck, HasTheElementsItsOriginStates)
{
    const KnownDeck known = GetParam();
    const fs::path file = data_folder / known.file;
    if (!fs::exists(file))
        GTEST_SKIP() << "no " << file;
    const Deck deck = read_deck(file, content_of(file));
    int quads = 0;
    for (const auto& corner : deck.corner)
        quads += corner[3] >= 0;
    EXPECT_EQ(quads, known.quads);
    EXPECT_EQ(deck.elements() - quads, known.triangles);
    EXPECT_EQ(int(choose_parts(deck, {}).node.size()), known.nodes);
    if (known.loops == 0) // several parts with joints of three faces
        return;
    ReadOptions as_it_is;
    as_it_is.seam.mode = SeamOptions::Mode::none;
    const PartFile part = read_part(file, as_it_is);
    EXPECT_EQ(part.mesh.vertices(), known.nodes);
    EXPECT_EQ(part.file_faces, known.quads + known.triangles);
    EXPECT_EQ(part.doctor.boundary_loops, known.loops);
    EXPECT_EQ(part.doctor.genus, 0);
    EXPECT_EQ(part.thickness_mm.value_or(0), known.thickness);
    EXPECT_EQ(part.material, known.material);
    EXPECT_EQ(part.doctor.find(Fault::flipped_face) != nullptr, known.flipped);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealDeck,
    testing::Values(KnownDeck{"fe/recliner_bracket.k", 1972, 1811, 54, 12, 2.5, "MAT_ELASTIC", false},
                    KnownDeck{"fe/crash_box_upper.rad", 646, 589, 5, 1, 2.2, "Steel_DP600", true},
                    KnownDeck{"fe/crash_box_upper.k", 646, 589, 5, 1, 2.2, "MAT_PIECEWISE_LINEAR_PLASTICITY", true},
                    KnownDeck{"fe/support_panel.bdf", 832, 736, 4, 14, 1.2, "MAT1", true},
                    KnownDeck{"fe/support_trough.bdf", 1001, 920, 4, 1, 1.2, "MAT1", true},
                    KnownDeck{"fe/aileron_skin.inp", 4644, 4494, 0, 1, 1.55, "Aluminium", false},
                    KnownDeck{"fe/drawn_cone_28k.k", 28306, 27902, 272, 3, 1, "MAT_PIECEWISE_LINEAR_PLASTICITY", false},
                    KnownDeck{"fe/car_hood_coarse.k", 275, 240, 0, 1, 0, "MAT_PLASTIC_KINEMATIC", false},
                    KnownDeck{"deck/car6_crash_v223.k", 2378, 2388, 36, 0, 0, "", false},
                    KnownDeck{"deck/dummy_wing_metallic.bdf", 1810, 1613, 369, 0, 0, "", false}),
    [](const auto& parameter) {
        std::string name = parameter.param.file;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
        return name;
    });

TEST(RealDecks, TheSamePartInTwoFormatsIsTheSameMesh)
{
    const fs::path keyword = data_folder / "fe/crash_box_upper.k", radioss = data_folder / "fe/crash_box_upper.rad";
    if (!fs::exists(keyword) || !fs::exists(radioss))
        GTEST_SKIP() << "no " << keyword;
    const Deck a = read_deck(keyword, content_of(keyword)), b = read_deck(radioss, content_of(radioss));
    EXPECT_EQ(a.node, b.node);
    const auto by_id = [](const Deck& deck) {
        std::map<std::int64_t, std::array<int, 4>> corners; // the one has its triangles first, the
                                                            // other last
        for (int e = 0; e < deck.elements(); ++e)
            corners[deck.element[size_t(e)]] = deck.corner[size_t(e)];
        return corners;
    };
    EXPECT_EQ(by_id(a), by_id(b));
    for (int v = 0; v < a.nodes(); ++v)
        // nine digits against fifteen
        EXPECT_LT((a.position[size_t(v)] - b.position[size_t(v)]).norm(), 1e-5);
}

TEST(RealDecks, OnePartOfACarAndOnePropertyOfAWing)
{
    const fs::path car = data_folder / "deck/car6_crash_v223.k", wing = data_folder / "deck/dummy_wing_metallic.bdf";
    if (!fs::exists(car) || !fs::exists(wing))
        GTEST_SKIP() << "no " << car;
    ReadOptions options;
    options.parts = {"Roof"};
    const PartFile roof = read_part(car, options);
    EXPECT_EQ(roof.file_faces, 72);
    EXPECT_EQ(roof.thickness_mm, 2);
    EXPECT_EQ(roof.doctor.boundary_loops, 1);
    try {
        read_part(car);
        ADD_FAILURE() << "a whole car is no sheet";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("5 Longeron (front)"), std::string::npos) << error.what();
    }
    const Deck deck = read_deck(wing, content_of(wing));
    const auto part =
        std::find_if(deck.parts.begin(), deck.parts.end(), [](const DeckPart& p) { return p.id == 31000000; });
    ASSERT_NE(part, deck.parts.end());
    EXPECT_EQ(part->thickness, 12);
    EXPECT_EQ(part->name, "PLATE Property");
    EXPECT_EQ(int(choose_parts(deck, std::vector<std::string>{"31000000"}).element.size()), part->elements);
}

} // namespace
} // namespace spia::deck_files_test

#include <algorithm>
#include <gtest/gtest.h>

#include "engine/exchange/deck/deck_choice.h"
#include "engine/exchange/read_part.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_gmsh_radioss_test {
namespace {

using sample::has_note;
using sample::refusal;

const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";

Deck read(const std::string& text) { return sample::read("a.msh", text); }

TEST(GmshDeck, ElementsOfHigherOrderGiveTheirCornersAndSolidsAreTold)
{
    const Deck deck = read(
        head + nodes +
        "$Elements\n7\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 9 2 0 5 1 2 3 4 4 4\n4 16 2 0 5 1 2 3 4 1 2 3 4\n5 10 2 0 5 1 2 3 4 1 2 3 4 1\n"
        "6 4 2 0 1 1 2 3 4\n7 2 4 0 6 2 1 1 2 3\n$EndElements\n$ElementData\n1\n\"x\"\n$EndElementData\n");
    ASSERT_EQ(deck.elements(), 4);
    EXPECT_EQ(deck.corner[0], (std::array<int, 4>{0, 1, 2, -1}));
    EXPECT_EQ(deck.corner[2], (std::array<int, 4>{0, 1, 2, 3}));
    EXPECT_EQ(deck.parts[0].name, "surface 5");
    EXPECT_EQ(deck.parts[1].name, "surface 6"); // behind the tags of two partitions
    EXPECT_TRUE(has_note(deck, "type 4"));
    EXPECT_FALSE(has_note(deck, "type 1"));
}

TEST(GmshDeck, ASurfaceOfSeveralGroupsCanBeChosenByEach)
{
    const Deck deck = read("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 5 \"Skin\"\n2 6 \"Hood\"\n"
                           "$EndPhysicalNames\n$Entities\n0 0 2 0\n1 0 0 0 1 1 0 2 5 6 0\n2 0 0 0 1 1 0 2 5 -8 0\n"
                           "$EndEntities\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
                           "$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n2 2 2 1\n2 1 3 4\n$EndElements\n");
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"Skin"}).element, (std::vector<int>{0, 1}));
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"Hood"}).element, (std::vector<int>{0}));
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"8"}).element, (std::vector<int>{1})) << "turned over in it";
}

TEST(GmshDeck, IsRefusedWithItsLineWhereItIsWrong)
{
    const auto expect = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal("a.msh", text).find(words), std::string::npos) << words << "\nin: " << refusal("a.msh", text);
    };
    expect("$MeshFormat\n4 1 8\n\x01", "line 2: binary meshes of version 4.0 are not read");
    expect("$MeshFormat\n1 0 8\n", "version 1 of the format is not read, but 2, 4 and 4.1 and, with $NOD, 1");
    expect("$MeshFormat\n4.2 0 8\n", "version 4.2 of the format is not read");
    expect("(0 \"a mesh of another program\")\n", "this is no mesh of Gmsh: there is neither $MeshFormat nor $NOD");
    expect(nodes, "$MeshFormat must come first");
    expect(head + "$Nodes\n9000000000000000000\n1 0 0 0\n", "the file ends in the middle of a section");
    expect(head + "$Nodes\n5\n1 0 0 0\n$EndNodes\n", "line 7: the section is shorter than it says");
    expect(head + "$Nodes\n1\n1 0 z 0\n", "line 6: 'z' is not a number");
    expect(head + nodes + "$Elements\n1\n1 2 99 0 1 1 2 3\n", "the element has 99 tags");
    expect(head + nodes + "$Elements\n1\n1 2 2 0 1 1 2\n", "a number is missing");
    expect(head + "$Comments\nnever ends\n", "$EndComments is missing");
}

const std::string cards =
    "/NODE\n         1                 0.0                 0.0                 0.0\n         2                 1.0                 0.0                 0.0\n"
    "         3                 1.0               1.+00                 0.0\n         4                                     1.0\n";

TEST(RadiossDeck, ElementsHaveTheirOwnThicknessAndUnits)
{
    const auto card = [](std::initializer_list<std::pair<const char*, int>> fields) {
        std::string line;
        for (const auto& [text, width] : fields)
            line += fmt::format("{:>{}}", text, width);
        return line + "\n";
    };
    const Deck deck = sample::read(
        "a.rad", "/BEGIN\nrun\n      2022         0\n" + card({{"Mg", 20}, {"m", 20}, {"s", 20}}) + cards +
                     "/SHELL/4\n" +
                     card({{"1", 10}, {"1", 10}, {"2", 10}, {"3", 10}, {"4", 10}, {"", 10}, {"0.3", 20}, {"1.5", 20}}) +
                     "/SH3N/4\n# a comment\n" +
                     card({{"2", 10}, {"1", 10}, {"2", 10}, {"3", 10}, {"", 20}, {"0.3", 20}, {"1.5", 20}}) +
                     "/BRICK/9\n1\n2\n/PART/4\nlid\n" + card({{"1", 10}, {"3", 10}}) + "/PROP/TYPE1/1\np\n0\n0\n" +
                     card({{"5", 10}, {"0", 10}, {"0.7", 20}}) + "/MAT/LAW2/3\n\n/GRBRIC/PART/1\nx\n");
    ASSERT_EQ(deck.elements(), 2);
    EXPECT_EQ(deck.position[3], Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(deck.parts[0].thickness, 1.5);
    EXPECT_EQ(deck.parts[0].name, "lid");
    EXPECT_EQ(deck.parts[0].material, "LAW2");
    EXPECT_EQ(deck.unit, LengthUnit::m);
    EXPECT_TRUE(has_note(deck, "/BRICK lines (2)"));
    EXPECT_TRUE(has_note(deck, "/GRBRIC"));
}

TEST(RadiossDeck, AUnitThatIsGivenAgainstThatOfTheDeckIsTold)
{
    const ScratchFolder scratch;
    put(scratch / "a.rad", "/BEGIN\nrun\n      2022         0\n" + fmt::format("{:>20}{:>20}{:>20}\n", "Mg", "m", "s") +
                               cards + "/SH3N/4\n         1         1         2         3\n");
    const auto told = [&](std::optional<LengthUnit> unit) {
        const PartFile part = read_part(scratch / "a.rad", {.unit = unit});
        return std::any_of(part.notes.begin(), part.notes.end(), [](const std::string& note) {
            return note == "the deck gives its lengths in m; they are read as mm, as requested";
        });
    };
    EXPECT_FALSE(told({}));
    EXPECT_FALSE(told(LengthUnit::m));
    EXPECT_TRUE(told(LengthUnit::mm));
}

TEST(RadiossDeck, AThicknessInUnitsOfItsOwnIsToldAndNotTaken)
{
    const auto with = [](const std::string& unit) {
        return sample::read("a.rad", "/BEGIN\nrun\n      2022         0\n" + cards +
                                         "/SH3N/4\n         1         1         2         3\n/PART/4\nlid\n         1\n"
                                         "/PROP/TYPE1/1" +
                                         unit + "\np\n0\n0\n" + fmt::format("{:>10}{:>10}{:>20}\n", 5, 0, 0.7) +
                                         "//SUBMODEL/3\nx\n");
    };
    EXPECT_EQ(with("").parts[0].thickness, 0.7);
    EXPECT_EQ(with("/0").parts[0].thickness, 0.7);
    EXPECT_FALSE(with("/2").parts[0].thickness);
    EXPECT_TRUE(has_note(with("/2"), "the thickness of property 1 is not taken"));
    EXPECT_TRUE(has_note(with(""), "//SUBMODEL"));
}

TEST(RadiossDeck, ALengthUnitThatIsNotKnownIsTold)
{
    const auto with = [](const std::string& unit) {
        return sample::read("a.rad", "/BEGIN\nrun\n      2022         0\n" +
                                         fmt::format("{:>20}{:>20}{:>20}\n", "Mg", unit, "s") + cards +
                                         "/SH3N/4\n         1         1         2         3\n");
    };
    EXPECT_EQ(with("MM").unit, LengthUnit::mm);
    EXPECT_EQ(with("in").unit, LengthUnit::inch);
    EXPECT_FALSE(with("furlong").unit);
    EXPECT_TRUE(has_note(with("furlong"), "length unit \"furlong\" is not known"));
    EXPECT_FALSE(has_note(with("cm"), "is not known"));
}

TEST(RadiossDeck, FilesAreIncluded)
{
    const ScratchFolder scratch;
    put(scratch / "nodes.inc", cards);
    put(scratch / "main.rad",
        "#include nodes.inc\n/SHELL/4\n         1         1         2         3         4\n/END\n");
    EXPECT_EQ(read_deck(scratch / "main.rad", content_of(scratch / "main.rad")).elements(), 1);
}

TEST(RadiossDeck, IsRefusedWithItsLineWhereItIsWrong)
{
    const auto expect = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal("a.rad", text).find(words), std::string::npos) << words << "\nin: " << refusal("a.rad", text);
    };
    expect("/BEGIN\nrun\n        41\n", "line 3: cards of version 41 are not read");
    expect("/NODE/3\n", "unit system of their own");
    expect("/NODE\n         1                   q\n", "line 2: 'q' is not a number");
    expect("/SHELL\n", "line 1: a number is missing");
    expect("/SHELL/4\n         1         1         2\n", "line 2: a number is missing");
    expect(cards, "no shell element");
}

} // namespace
} // namespace spia::deck_gmsh_radioss_test

#include <algorithm>
#include <gtest/gtest.h>

#include "engine/exchange/deck/deck_choice.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_abaqus_test {
namespace {

using sample::has_note;
using sample::refusal;

const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1\n5,.5,0\n6,1,.5\n7,.5,1\n8,0,.5\n";

Deck read(const std::string& text) { return sample::read("a.inp", text); }
const DeckPart& part(const Deck& deck, int element) { return deck.parts[size_t(deck.part_of[size_t(element)])]; }

TEST(AbaqusDeck, EveryTypeOfShellGivesItsCorners)
{
    for (const char* type :
         {"S3", "S3R", "STRI3", "M3D3", "DS3", "S3RS", "CPS3", "CPE3H", "cpeg3", "DC2D3", "AC2D3", "SFM3D3"}) {
        const Deck deck = read(nodes + "*Element, type=" + type + "\n 9, 1, 2, 3\n");
        EXPECT_EQ(deck.corner.at(0), (std::array<int, 4>{0, 1, 2, -1})) << type;
    }
    for (const char* type : {"S4", "S4R", "s4r", "S4R5", "S4RSW", "M3D4R", "SFM3D4", "CPS4", "CPS4R", "CPE4I", "CPE4RT",
                             "CPEG4", "DC2D4", "DCC2D4", "AC2D4R", "DS4"}) {
        const Deck deck = read(nodes + "*Element, type=" + type + "\n 9, 1, 2, 3, 4\n");
        EXPECT_EQ(deck.corner.at(0), (std::array<int, 4>{0, 1, 2, 3})) << type;
    }
    for (const char* type : {"STRI65", "S6", "CPS6M", "CPE6", "M3D6", "DC2D6"}) {
        const Deck deck = read(nodes + "*Element, type=" + type + "\n 9, 1, 2, 3,\n 5, 6, 8\n");
        EXPECT_EQ(deck.corner.at(0), (std::array<int, 4>{0, 1, 2, -1})) << type;
        EXPECT_TRUE(has_note(deck, "1 shell has nodes between corners"));
    }
    EXPECT_EQ(read(nodes + "*Element, type=S8R\n 9, 1, 2, 3, 4, 5, 6,\n7, 8\n10, 4,3,2,1,7,6,5,8\n").corner.at(1),
              (std::array<int, 4>{3, 2, 1, 0}));
    const Deck deck = read(
        nodes + "*Element, type=S3\n9,1,2,3\n*Element, type=C3D4\n1,1,2,3,4\n*Element, type=SC8R\n2,1,2,3,4,5,6,7,8\n"
                "*Element, type=R3D4\n3,1,2,3,4\n*Element, type=SAX1\n4,1,2\n");
    EXPECT_EQ(deck.elements(), 1);
    EXPECT_TRUE(has_note(deck, "C3D4 lines, R3D4 lines, SAX1 lines, SC8R lines"));
}

const std::string five = nodes + "*ELEMENT, TYPE=S3, ELSET=All\n1,1,2,3\n2,1,3,4\n3,2,3,4\n11,1,2,4\n13,3,4,1\n";

TEST(AbaqusDeck, SectionsTakeTheElementsOfTheirSets)
{
    const Deck deck = read(
        five +
        "*ELSET, ELSET=odd, GENERATE\n1, 13, 2\n*ELSET, elset=\"a name\"\n2\n*ELSET, ELSET=Rest\n\"A NAME\",\n"
        "*SHELL SECTION, ELSET=ODD, MATERIAL=DC04\n.75\n*Shell Section, elset=Rest, composite\n.25, 3, Inner\n.5, 3, Outer\n");
    for (const int e : {0, 2, 3, 4}) {
        EXPECT_EQ(part(deck, e).name, "ODD");
        EXPECT_EQ(part(deck, e).thickness, 0.75);
        EXPECT_EQ(part(deck, e).material, "DC04");
    }
    EXPECT_EQ(part(deck, 1).thickness, 0.75);
    EXPECT_EQ(part(deck, 1).name, "Rest");
    EXPECT_EQ(part(deck, 1).material, "Inner");
    ASSERT_EQ(deck.sets.size(), 4u); // in the order of the alphabet
    EXPECT_EQ(deck.sets[0].name, "a name");
    EXPECT_EQ(deck.sets[1].elements, (std::vector<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(deck.sets[2].name, "odd");
    EXPECT_EQ(deck.sets[2].elements, (std::vector<int>{0, 2, 3, 4}));
    EXPECT_EQ(deck.sets[3].elements, (std::vector<int>{1}));
}

TEST(AbaqusDeck, NamesBetweenQuotesMayHaveCommas)
{
    const Deck deck = read(
        nodes +
        "*ELEMENT, ELSET=\"a, type=S4\", TYPE=S3\n1,1,2,3\n*SHELL SECTION, MATERIAL=\"b, c\", ELSET=\"a, type=S4\"\n2.\n");
    EXPECT_EQ(part(deck, 0).name, "a, type=S4");
    EXPECT_EQ(part(deck, 0).material, "b, c");
    EXPECT_EQ(part(deck, 0).thickness, 2);
}

TEST(AbaqusDeck, ASectionByItsStiffnessHasNoThickness)
{
    const std::string skin = nodes + "*ELEMENT, ELSET=SKIN, TYPE=S3\n1,1,2,3\n*SHELL GENERAL SECTION, ELSET=SKIN";
    const Deck stiff = read(skin + "\n230769., 69231., 230769., 0., 0., 80769.\n");
    EXPECT_FALSE(part(stiff, 0).thickness) << "the first number is a stiffness";
    EXPECT_TRUE(has_note(stiff, "*SHELL GENERAL SECTION by its stiffness"));
    EXPECT_EQ(part(read(skin + ", MATERIAL=DC04\n.8\n"), 0).thickness, 0.8);
}

TEST(AbaqusDeck, LayersMayBeMirrored)
{
    const std::string skin = nodes + "*ELEMENT, ELSET=SKIN, TYPE=S3\n1,1,2,3\n*SHELL SECTION, ELSET=SKIN, COMPOSITE";
    EXPECT_EQ(part(read(skin + "\n.25,3,A\n.5,3,B\n"), 0).thickness, 0.75);
    EXPECT_EQ(part(read(skin + ", Symmetric\n.25,3,A\n.5,3,B\n"), 0).thickness, 1.5);
}

TEST(AbaqusDeck, AThicknessThatVariesIsToldAndNotThatOfTheSection)
{
    for (const char* by : {", NODAL THICKNESS", ", Shell Thickness=field"}) {
        const Deck deck = read(nodes + "*ELEMENT, ELSET=SKIN, TYPE=S3\n1,1,2,3\n*SHELL SECTION, ELSET=SKIN" + by +
                               "\n.25\n*NODAL THICKNESS\n1,1.5\n");
        EXPECT_FALSE(part(deck, 0).thickness) << by;
        EXPECT_TRUE(has_note(deck, "the thickness of the section for SKIN is given by its nodes")) << by;
    }
}

TEST(AbaqusDeck, ASectionForNoSetIsTold)
{
    const Deck deck = read(nodes + "*ELEMENT, ELSET=SKIN, TYPE=S3\n1,1,2,3\n*SHELL SECTION, ELSET=Skn\n.25\n");
    EXPECT_TRUE(has_note(deck, "a section for the element set Skn, but no such set"));
    EXPECT_EQ(part(deck, 0).name, "SKIN");
}

TEST(AbaqusDeck, ASetOfWhichASectionTookAPartIsStillWhole)
{
    const Deck deck = read(five + "*ELSET, ELSET=Two\n2,3\n*SHELL SECTION, ELSET=Two\n.5\n");
    EXPECT_EQ(part(deck, 0).name, "All (rest)");
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"All"}).element.size(), 5u);
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"All (rest)"}).element.size(), 3u);
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"Two"}).element, (std::vector<int>{1, 2}));
}

TEST(AbaqusDeck, AMeshThatStandsInItsInstanceIsMoved)
{
    const auto third = [](const std::string& lines) {
        const Deck deck = read("*Assembly, name=A\n*Instance, name=I, part=P\n" + lines + nodes +
                               "*ELEMENT, TYPE=S3, ELSET=Skin\n1,1,2,3\n*End Instance\n*End Assembly\n");
        EXPECT_TRUE(deck.doubts.empty());
        return deck.position.at(2);
    };
    const auto expect = [](const Eigen::Vector3d& x, const Eigen::Vector3d& expected) {
        EXPECT_LT((x - expected).norm(), 1e-12) << x.transpose();
    };
    expect(third(""), {1, 1, 0});
    expect(third("0.,0.,0.\n"), {1, 1, 0});
    expect(third("0.,0.,0.\n0.,0.,0.,0.,0.,1.,90.\n"), {-1, 1, 0});
    expect(third("0.,0.,1.\n0.,0.,0.,0.,0.,1.,90.\n"), {-1, 1, 1});
    expect(third("1.,0.,0.\n0.,0.,0.,0.,0.,1.,90.\n"), {-1, 2, 0}); // moved, then turned
}

TEST(AbaqusDeck, SetsOfAnInstanceAreTold)
{
    EXPECT_TRUE(has_note(read(five + "*ELSET, ELSET=Roof, INSTANCE=Body-1\n1, 2\n"), "*ELSET of an instance"));
}

TEST(AbaqusDeck, ElementsWithoutASectionGoByTheirSet)
{
    const Deck deck = read(five + "*ELEMENT, TYPE=S3\n20,1,2,3\n");
    EXPECT_EQ(part(deck, 0).name, "All");
    EXPECT_EQ(part(deck, 5).name, "elements without a set");
    EXPECT_FALSE(part(deck, 0).thickness);
}

TEST(AbaqusDeck, PartsHaveNumbersAndSetsOfTheirOwn)
{
    const std::string
        one =
            "*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=S3, ELSET=Skin\n1,1,2,3\n*SHELL SECTION, ELSET=Skin, MATERIAL=A\n1.\n",
        two =
            "*NODE\n1,5,0\n2,6,0\n3,5,1\n*ELEMENT, TYPE=S3, ELSET=Skin\n1,3,2,1\n*SHELL SECTION, ELSET=Skin, MATERIAL=B\n2.\n";
    const Deck deck = read(
        "*PART, NAME=Left\n" + one + "*ELSET, ELSET=Extra\n1\n*END PART\n*Part, name=Right\n" + two +
        "*End Part\n*Assembly, name=Assembly\n*Instance, name=Left-1, part=Left\n0.,0.,7.\n*End Instance\n"
        "*Instance, name=Right-1, part=Right\n*End Instance\n*Elset, elset=Skin, instance=Right-1, generate\n1,9,1\n*End Assembly\n");
    ASSERT_EQ(deck.elements(), 2);
    EXPECT_EQ(deck.position[size_t(deck.corner[1][0])], Eigen::Vector3d(5, 1, 0));
    EXPECT_EQ(part(deck, 0).name, "Skin");
    EXPECT_EQ(part(deck, 0).thickness, 1);
    EXPECT_EQ(part(deck, 1).name, "Right.Skin");
    EXPECT_EQ(part(deck, 1).thickness, 2);
    EXPECT_EQ(part(deck, 1).material, "B");
    EXPECT_EQ(deck.position[size_t(deck.corner[0][0])], Eigen::Vector3d(0, 0, 7));
    const auto sets_called = [&](const std::string& name) {
        return std::count_if(deck.sets.begin(), deck.sets.end(), [&](const DeckSet& set) { return set.name == name; });
    };
    EXPECT_EQ(sets_called("Skin"), 1);
    EXPECT_EQ(sets_called("Right.Skin"), 1) << "one name, one choice";
    EXPECT_EQ(sets_called("Extra"), 1);
    // Meshed in the assembly: nodes and elements lie in the instance.
    EXPECT_EQ(read("*Assembly, name=A\n*Instance, name=I, part=P\n 1.,0.,0.\n" + one + "*End Instance\n*End Assembly\n")
                  .elements(),
              1);
}

TEST(AbaqusDeck, FilesAreIncludedInTheMiddleOfABlock)
{
    const ScratchFolder scratch;
    put(scratch / "more nodes.inp", "3,1,1,0\n4,0,1,0\n");
    put(scratch / "shells.inp", "1,1,2,3\n");
    put(scratch / "main.inp",
        "*NODE\n1,0,0,0\n2,1,0,0\n*INCLUDE, INPUT=more nodes.inp\n5,9,9,9\n*ELEMENT, TYPE=S3,\nELSET=X, INPUT=shells.inp\n2,1,3,4\n");
    const Deck deck = read_deck(scratch / "main.inp", content_of(scratch / "main.inp"));
    EXPECT_EQ(deck.node, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(deck.elements(), 2);
    EXPECT_EQ(part(deck, 1).name, "X");
}

TEST(AbaqusDeck, SetsThatAskForTooMuchAreRefused)
{
    std::string text = five;
    for (int e = 100; e < 3000; ++e)
        text += fmt::format("{},1,2,3\n", e);
    std::string sets;
    for (int s = 0; s < 2000; ++s)
        sets += fmt::format("*ELSET, ELSET=S{}, GENERATE\n1,9000000000000000000,1\n", s);
    const Deck deck = read(text + sets); // 5.8 million numbers from 100 kB
    EXPECT_TRUE(has_note(deck, "cannot be chosen"));
    size_t total = 0;
    for (const DeckSet& set : deck.sets)
        total += set.elements.size();
    EXPECT_LE(total, 64u * 2905u);
    const std::string ends = "-9223372036854775808, 9223372036854775807\n";
    EXPECT_EQ(
        read(
            five +
            "*ELSET, ELSET=A\n1,-9223372036854775808,9223372036854775807,-9223372036854775808\n*ELSET, ELSET=B, GENERATE\n" +
            ends + "*SHELL SECTION, ELSET=B\n1.\n")
            .sets.size(),
        3u);
    std::string circle = "*ELSET, ELSET=A\nB\n*ELSET, ELSET=B\nA, 1\n*SHELL SECTION, ELSET=A, MATERIAL=M\n1.\n";
    EXPECT_EQ(part(read(five + circle), 0).name, "A");
}

TEST(AbaqusDeck, IsRefusedWithItsLineWhereItIsWrong)
{
    const auto expect = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal("a.inp", text).find(words), std::string::npos) << words << "\nin: " << refusal("a.inp", text);
    };
    expect("*NODE\n1,0,y,0\n", "line 2: 'y' is not a number");
    expect("*NODE, SYSTEM=Q\n1,1,90,0\n", "line 1: the coordinates SYSTEM=Q are not known");
    expect("*SYSTEM\n1,0,0,2,0,0\n3,0,0\n*NODE\n", "line 4: the points of *SYSTEM lie on a line");
    expect("*SYSTEM\n1,0,0,1,0,5\n*NODE\n", "line 3: the points of *SYSTEM lie on a line");
    expect("*ELEMENT\n1,1,2,3\n", "does not say which TYPE");
    expect(nodes + "*ELEMENT, TYPE=S4\n1,1,2,3\n*NODE\n", "element 1 of type S4 has 4 nodes, not 3");
    expect(nodes + "*ELEMENT, TYPE=S3\n1,1,2,3,4\n", "line 11: an element of type S3 has 3 nodes, not 4");
    expect(five + "*ELSET, ELSET=A, GENERATE\n1,9,0\n", "the step is 0");
    expect(five + "*ELSET\n1\n", "does not say which ELSET");
    expect(five +
               "*ELSET, ELSET=A\n1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1\n",
           "there are 42 entries");
    expect("hello\nworld\n", "no shell element");
}

} // namespace
TEST(AbaqusDeck, NodesStandInTheSystemBeforeThem)
{
    const auto third = [](const std::string& system, const std::string& nodes = "*NODE\n") {
        const Deck deck = read("*NODE\n1,0,0,0\n2,1,0,0\n" + system + nodes +
                               "3,2,30,5\n*SYSTEM\n*NODE\n4,7,8,9\n*ELEMENT,TYPE=S4\n1,1,2,3,4\n");
        EXPECT_EQ(deck.position.at(3), Eigen::Vector3d(7, 8, 9)) << "*SYSTEM alone ends it";
        return deck.position.at(2);
    };
    const auto expect = [](const Eigen::Vector3d& x, const Eigen::Vector3d& expected) {
        EXPECT_LT((x - expected).norm(), 1e-12) << x.transpose();
    };
    expect(third(""), {2, 30, 5});
    expect(third("*SYSTEM\n10,20,30\n"), {12, 50, 35});
    expect(third("*SYSTEM\n10,20,30,\n"), {12, 50, 35});
    // the first axis seen from above is y
    expect(third("*SYSTEM\n10,20,30,10,21,39\n"), {10 - 30, 20 + 2, 30 + 5});
    expect(third("*SYSTEM\n10,20,30,10,20,31\n10,21,30\n"), {10 - 5, 20 + 30, 30 + 2});
    expect(third("", "*NODE, SYSTEM=C\n"), {std::sqrt(3), 1, 5});
    expect(third("*SYSTEM\n0,0,0,0,1,0\n", "*NODE, SYSTEM=C\n"), {-1, std::sqrt(3), 5});
}

} // namespace spia::deck_abaqus_test

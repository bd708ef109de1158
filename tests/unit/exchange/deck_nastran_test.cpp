#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_nastran_test {
namespace {

using sample::has_note;
using sample::refusal;

const std::string square =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nCQUAD4,1,7,1,2,3,4\n";

Deck read(const std::string& text) { return sample::read("a.bdf", text); }
Eigen::Vector3d place(const Deck& deck, int v) { return deck.position[size_t(v)]; }

TEST(NastranDeck, WhatAddsToAMaterialIsNotTheMaterial)
{
    const Deck deck = read(square + "PSHELL,7,3,1.2\nMAT1,3,206000.,,.3\nMATS1,3,,PLASTIC,0.,1,1,180.\nMATT8,3,5\n");
    EXPECT_EQ(deck.parts[0].material, "MAT1");
    EXPECT_TRUE(has_note(deck, "MATS1"));
}

TEST(NastranDeck, FieldsAreCutAsTheirLineSays)
{
    // small, no blanks between
    const Deck deck = read("GRID           1       0-1072.75-1226.601.5+3\n"
                           "GRID*                  2               0            1.25           -2.5\n"
                           "*                    7.5\n" // large
                           "GRID*                  3               0            1.25            -2.5+LONG\n"
                           "*LONG               -7.5\n"  // large with a mark
                           "grid, 4, , 1.+2, -.5\n"      // free, lower case, a field left out
                           "GRID*,5,,1.5,2.5,+\n*,3.5\n" // free and large
                           "GRID\t6\t\t1.0\t2.0\t3.0\n"  // tabs
                           "GRID    7               4.      5.      6.$ a comment\n"
                           "$ another\n\n"
                           "CTRIA3  1       9       1       2       3\n"
                           "CQUAD4  2       9       4       5       6       7       0.5     +\n"
                           "+                       1.25    1.25    1.25    1.25\n");
    ASSERT_EQ(deck.nodes(), 7);
    EXPECT_EQ(place(deck, 0), Eigen::Vector3d(-1072.75, -1226.6, 1500));
    EXPECT_EQ(place(deck, 1), Eigen::Vector3d(1.25, -2.5, 7.5));
    EXPECT_EQ(place(deck, 2), Eigen::Vector3d(1.25, -2.5, -7.5));
    EXPECT_EQ(place(deck, 3), Eigen::Vector3d(100, -0.5, 0));
    EXPECT_EQ(place(deck, 4), Eigen::Vector3d(1.5, 2.5, 3.5));
    EXPECT_EQ(place(deck, 5), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(place(deck, 6), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(deck.corner[0], (std::array<int, 4>{0, 1, 2, -1}));
    EXPECT_EQ(deck.corner[1], (std::array<int, 4>{3, 4, 5, 6}));
    EXPECT_TRUE(has_note(deck, "their own thicknesses, up to 1.25, others none; none is used")) << deck.notes.size();
}

TEST(NastranDeck, ControlSectionsAndTheEndMayBeThereOrNot)
{
    EXPECT_EQ(read(square).elements(), 1);
    EXPECT_EQ(read("SOL 101\nCEND\nSET 1 = 5 THRU 7,\n  9\nBEGIN BULK\n" + square + "ENDDATA\nGRID,1,,x\n").elements(),
              1);
    EXPECT_EQ(read("ID a,b\n  begin   bulk $ now\n" + square + "enddata\n").elements(), 1);
    EXPECT_NE(refusal("a.dat", "this is\nno deck\n").find("line 1: 'this is' is no entry of Nastran"),
              std::string::npos)
        << refusal("a.dat", "this is\nno deck\n");
}

TEST(NastranDeck, AnEndThatIsMissingIsTold)
{
    EXPECT_TRUE(has_note(read("CEND\nBEGIN BULK\n" + square), "does not end with ENDDATA"));
    EXPECT_FALSE(has_note(read("CEND\nBEGIN BULK\n" + square + "ENDDATA\n"), "does not end with ENDDATA"));
    EXPECT_FALSE(has_note(read(square), "does not end with ENDDATA"));
}

TEST(NastranDeck, PropertiesGiveThicknessMaterialAndName)
{
    const auto part = [](const std::string& text) { return read(square + text).parts.at(0); };
    EXPECT_EQ(part("PSHELL,7,3,.9\nMAT8,3,1.\n").thickness, 0.9);
    EXPECT_EQ(part("PSHELL,7,3,.9\nMAT8,3,1.\n").material, "MAT8");
    EXPECT_EQ(part("PSHELL,7,3,.9\n").material, "");
    EXPECT_EQ(part("PSHELL  7       3       9.-1\n").thickness, 0.9);
    EXPECT_EQ(part("PCOMP,7,,,,,,,SYM,+\n+,3,.25,0.,,3,.125\n").thickness, 0.75);
    EXPECT_EQ(part("pcomp,7,,,,,,,sym,+\n+,3,.25,0.,,3,.125\n").thickness, 0.75);
    EXPECT_EQ(part("PCOMP,7,,,,,,,,+\n+,3,.25,0.,,3,,45.\n").thickness, 0.5); // the same again
    EXPECT_EQ(part("$ Femap with NX Nastran Property 7 : WING SKIN\n").name, "WING SKIN");
    EXPECT_EQ(part("$HMNAME PROP            7\"Hood\" 4\n").name, "Hood");
    EXPECT_FALSE(part("PSHELL,8,3,.9\n").thickness);
    const Deck deck =
        // relative thickness, property as its id
        read(square + "CQUAD4,12,,1,2,3,4,,,+\n+,,1,.5,.5,.5,.5\n");
    EXPECT_EQ(deck.parts.at(1).id, 12);
    EXPECT_FALSE(deck.parts.at(1).thickness);
    const Deck own = read(square.substr(0, square.find("CQUAD4")) +
                          "CQUAD4,1,7,1,2,3,4,,,+\n+,,,.8,.8,.8,.8\nCTRIA3,2,7,1,2,3,,,,+\n+,,,.8,.8,.8\n");
    EXPECT_EQ(own.parts.at(0).thickness, 0.8); // of the elements, and exactly the same in both
}

TEST(NastranDeck, ThicknessesAtCornersMayBeSharesOrMissing)
{
    const std::string nodes = square.substr(0, square.find("CQUAD4"));
    const auto thickness = [&](const std::string& fields, const std::string& rest) {
        return read(nodes + "CQUAD4,1,7,1,2,3,4,,,+\n+," + fields + "\n" + rest).parts.at(0).thickness;
    };
    EXPECT_EQ(thickness(",1,.5,.5,.5,.5", "PSHELL,7,3,2.\n"), 1.0) << "a share of the property's, which comes later";
    EXPECT_EQ(thickness(",,1.,,1.,", "PSHELL,7,3,2.\n"), 1.5) << "corners without one have the property's";
    EXPECT_EQ(thickness(",0,1.,1.,1.,1.", "PSHELL,7,3,2.\n"), 1.0);
    EXPECT_TRUE(has_note(read(nodes + "CQUAD4,1,7,1,2,3,4,,,+\n+,,1,.5,.5,.5,.5\n"), "their property has none"));
}

TEST(NastranDeck, FieldsThatAreNotWrittenBackAreTold)
{
    const std::string nodes = square.substr(0, square.find("CQUAD4"));
    EXPECT_TRUE(has_note(read(nodes + "CQUAD4,1,7,1,2,3,4,45.\nCTRIA3,2,7,1,2,3,,.5\nCQUAD4,3,7,1,2,3,4\n"),
                         "2 shells have a material direction or an offset"));
    EXPECT_FALSE(has_note(read(square), "a material direction"));
}

TEST(NastranDeck, ShellsOfHigherOrderGiveTheirCornersAndOthersAreTold)
{
    const Deck deck = read(
        square +
        "GRID,5,,.5\nCQUAD8,2,7,1,2,3,4,5,5,+\n+,5,5\nCTRIA6,3,7,1,2,3,5,5,5\nCQUADR,4,7,1,2,3,4\nCTRIAR,5,7,1,2,3\n"
        "CHEXA,9,1,1,2,3,4,1,2,+\n+,3,4\nCBAR,10,1,1,2\nFORCE,1,1\nFORCE,2,1\n");
    EXPECT_EQ(deck.elements(), 5);
    EXPECT_EQ(deck.corner[2], (std::array<int, 4>{0, 1, 2, -1}));
    EXPECT_TRUE(has_note(deck, "2 shells have nodes between corners"));
    EXPECT_TRUE(has_note(deck, "left out: CBAR, CHEXA"));
    EXPECT_TRUE(has_note(deck, "not read: FORCE (2)"));
}

TEST(NastranDeck, NodesInOtherSystemsArePlaced)
{
    // 1: turned about z by 90 degrees and moved; 2: cylinder about y given in 1; 3: sphere.
    const std::string systems = "CORD2R,1,,10.,20.,30.,10.,20.,31.,+\n+,10.,21.,30.\n"
                                "CORD2C,2,1,0.,0.,0.,0.,1.,0.,+\n+,1.,0.,0.\n"
                                "CORD2S,3,,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
    const Deck deck =
        read("GRID,1,1,1.,2.,3.\nGRID,2,2,2.,90.,5.\nGRID,3,3,2.,60.,30.\nGRID,4,0,1.,1.,1.\nCQUAD4,1,7,1,2,3,4\n" +
             systems);
    const auto expect = [&](int v, const Eigen::Vector3d& x) {
        EXPECT_LT((place(deck, v) - x).norm(), 1e-12) << place(deck, v);
    };
    expect(0, {10 - 2, 20 + 1, 30 + 3});
    // In system 1: third axis y, first axis x, second z cross x ... = y cross x = -z; so (0, 5,
    // -2), then as above.
    expect(1, {10 - 5, 20 + 0, 30 - 2});
    const double across = 2 * std::sin(std::numbers::pi / 3);
    expect(2, {across * std::cos(std::numbers::pi / 6), across * 0.5, 2 * 0.5});
    expect(3, {1, 1, 1});
    EXPECT_LT((place(read("GRDSET,,1\n" + systems + square), 0) - Eigen::Vector3d(10, 20, 30)).norm(), 1e-12);
}

TEST(NastranDeck, NodesWhoseSystemIsNotThereAreLeftOut)
{
    for (const std::string system :
         {"", "CORD1R,1,1,2,2\n", "CORD1R,1,1,2,99\n", "CORD1R,1,1,2,5\n",
          "CORD2R,1,1,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n",
          "CORD2R,1,2,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\nCORD2R,2,1,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n",
          "CORD2R,1,,0.,0.,0.,0.,0.,1.,+\n+,0.,0.,2.\n", "CORD2R,1,9,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n"}) {
        const Deck deck = read(square + "GRID,5,1,9.,9.,9.\nCTRIA3,2,8,1,2,5\n" + system);
        EXPECT_EQ(deck.elements(), 1) << system;
        EXPECT_TRUE(has_note(deck, "first: node 5 in system 1")) << system;
        EXPECT_EQ(deck.parts.at(1).missing_node, 5) << system;
    }
}

TEST(NastranDeck, FilesAreIncludedWithAndWithoutQuotesOverLines)
{
    const ScratchFolder scratch;
    std::filesystem::create_directories(scratch / "a folder");
    put(scratch / "a folder/nodes.bdf", square.substr(0, square.find("CQUAD4")));
    put(scratch / "shell.bdf", "CQUAD4,1,7,1,2,3,4,,\n,,,,.5,.5,.5,.5\n");
    put(scratch / "main.bdf",
        "CEND\nBEGIN BULK\nINCLUDE 'a folder/\n         nodes.bdf'\ninclude shell.bdf\nPSHELL,7,1,2.\nENDDATA\n");
    const Deck deck = read_deck(scratch / "main.bdf", content_of(scratch / "main.bdf"));
    EXPECT_EQ(deck.elements(), 1);
    EXPECT_EQ(deck.parts[0].thickness, 0.875); // 2 from the property at the first corner, .5 at the
                                               // others
    EXPECT_TRUE(has_note(read("INCLUDE \"none.bdf\"\n" + square), "none.bdf is not there"));
    EXPECT_NE(refusal("a.bdf", "INCLUDE 'none\n").find("does not end"), std::string::npos);
}

TEST(NastranDeck, IsRefusedWithItsLineWhereItIsWrong)
{
    const auto expect = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal("a.bdf", text).find(words), std::string::npos) << words << "\nin: " << refusal("a.bdf", text);
    };
    expect("GRID,1,,0.,x,0.\n", "line 1: 'x' is not a number");
    expect("GRID,1\nGRID,a\n", "line 2: 'a' is not a whole number");
    // though line 3 is known by then
    expect("GRID,1,,0.,x,0.\n$ a comment\nGRID,2\n", "line 1: 'x' is not a number");
    expect("GRID,1\nGRID,2,,,,,,,+\n+,y\nCQUAD4,1,7,1,,3,4\nGRID,3\n", "line 4: a number is missing");
    const ScratchFolder scratch;
    put(scratch / "inc.bdf", "GRID,1,,x\n");
    EXPECT_NE(refusal("a.bdf", "INCLUDE '" + (scratch / "inc.bdf").string() + "'\n" + square)
                  .find("inc.bdf, line 1: 'x' is not a number"),
              std::string::npos);
    expect("GRID*                  1               0             1.0             2.0+A\n*B                   3.0\n",
           "line 1: the continuations of this GRID are not in their order");
    expect(square + "GRID,2,,5.\n", "node 2 is given twice");
    expect("CQUAD4,1,7,1,2,3\n", "line 1: a number is missing");
    expect("=,*(1),,*(10.)\n", "is no entry of Nastran bulk data");
}

} // namespace
} // namespace spia::deck_nastran_test

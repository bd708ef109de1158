#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_dyna_test {
namespace {

using sample::has_note;
using sample::refusal;

const std::string four_nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n";

Deck read(const std::string& text) { return sample::read("a.k", text); }

TEST(DynaDeck, EveryOptionOfShellsHasItsCards)
{
    const std::string quad = "       1       5       1       2       3       4\n",
                      triangle = "       2       5       1       2       3       3\n";
    const std::string thick = "             0.8             0.8             0.8             0.8\n",
                      two = "             1.5             0.5             1.0             9.0\n";
    struct Known {
        std::string option, behind_first, behind_second;
        double thickness;
    };
    for (const Known& known :
         std::vector<Known>{{"", "", "", 0},
                            {"_THICKNESS", thick, thick, 0.8},
                            {"_BETA", thick, thick, 0.8},
                            {"_THICKNESS_MCID", thick, thick, 0.8},
                            {"_OFFSET", "             0.1\n", "             0.1\n", 0},
                            {"_DOF", "               7       7\n", "               7       7\n", 0},
                            {"_THICKNESS_OFFSET", thick + "             0.1\n", thick + "             0.1\n", 0.8},
                            {"_THICKNESS", two, two, 2}}) {
        SCOPED_TRACE(known.option);
        const Deck deck = read(four_nodes + "*ELEMENT_SHELL" + known.option + "\n" + quad + known.behind_first +
                               triangle + known.behind_second);
        ASSERT_EQ(deck.elements(), 2);
        EXPECT_EQ(deck.corner[0], (std::array<int, 4>{0, 1, 2, 3}));
        EXPECT_EQ(deck.corner[1], (std::array<int, 4>{0, 1, 2, -1}));
        if (known.thickness > 0)
            EXPECT_EQ(deck.parts[0].thickness, known.thickness);
        else
            EXPECT_FALSE(deck.parts[0].thickness);
    }
    // The mean over the corners of each: 3 for the quad, 1 for the triangle; the part has their
    // mean, whatever its section says.
    const Deck deck = read(four_nodes + "*ELEMENT_SHELL_THICKNESS\n" + quad + two + triangle + two);
    EXPECT_TRUE(has_note(deck, "from 1 to 3; their mean, 2, is used"));
    EXPECT_EQ(read(four_nodes + "*ELEMENT_SHELL_THICKNESS\n" + quad + two + triangle + two +
                   "*PART\nside\n2,8\n*SECTION_SHELL\n8,2\n1.5,1.5,1.5,1.5\n")
                  .parts[0]
                  .thickness,
              2.);
}

TEST(DynaDeck, ACornerWithoutAThicknessHasThatOfTheSection)
{
    const std::string shells = four_nodes + "*ELEMENT_SHELL_THICKNESS\n1,5,1,2,3,4\n1.2,1.2,,\n";
    const Deck alone = read(shells);
    EXPECT_FALSE(alone.parts[0].thickness) << "and not the mean with zeros";
    EXPECT_TRUE(has_note(alone, "1 shell has a thickness at some of their corners only"));
    const Deck with = read(shells + "*PART\nside\n5,8\n*SECTION_SHELL\n8,2\n1.5,1.5,1.5,1.5\n");
    EXPECT_EQ(with.parts[0].thickness, 1.5);
    EXPECT_FALSE(
        has_note(read(four_nodes + "*ELEMENT_SHELL_THICKNESS\n1,5,1,2,3,4\n0,0,0,0\n"), "some of their corners"));
}

TEST(DynaDeck, ACardThatIsNotThereDoesNotCostAnElementOfTheNextBlock)
{
    EXPECT_EQ(read(four_nodes + "*ELEMENT_SHELL_OFFSET\n1,5,1,2,3,4\n*ELEMENT_SHELL\n2,5,1,2,3,4\n").elements(), 2);
}

TEST(DynaDeck, ShellsWithNodesOnTheirEdgesGiveTheirCorners)
{
    const Deck deck = read(
        four_nodes +
        "*NODE\n5,.5,0,0\n6,1,.5,0\n7,.5,1,0\n8,0,.5,0\n*ELEMENT_SHELL_THICKNESS\n1,5,1,2,3,4,5,6,7,8\n.8,.8,.8,.8\n"
        ".8,.8,.8,.8\n2,5,1,2,3,0\n.8,.8,.8\n");
    ASSERT_EQ(deck.elements(), 2);
    EXPECT_EQ(deck.corner[0], (std::array<int, 4>{0, 1, 2, 3}));
    EXPECT_EQ(deck.parts[0].thickness, 0.8);
    EXPECT_TRUE(has_note(deck, "1 shell has nodes between corners"));
}

TEST(DynaDeck, PartsWithFurtherCardsDoNotLoseTheNextOne)
{
    const std::string shells = four_nodes + "*ELEMENT_SHELL\n1,7,1,2,3,0\n2,8,1,3,4,0\n*SECTION_SHELL\n5,2\n.9\n";
    const std::string card = ",5,6\n";
    for (const auto& [option, behind] : std::vector<std::pair<std::string, std::string>>{
             {"", ""},
             {"_CONTACT", "0.1,0.2\n"},
             {"_INERTIA", "0,0,0,1,0,3\n1,0,0,1,0,1\n0,0,0\n"},
             {"_INERTIA", "0,0,0,1,1,3\n1,0,0,1,0,1\n0,0,0\n1,0,0,0,1,0\n"},
             {"_REPOSITION_PRINT", "1,2\n0\n"},
             {"_INERTIA_CONTACT", "0,0,0,1,1,3\n1,0,0,1,0,1\n0,0,0\n1,0,0,0,1,0\n0.1,0.2\n"},
             {"_ATTACHMENT_NODES", "12\n"}}) {
        SCOPED_TRACE(option);
        const Deck deck =
            read("*PART" + option + "\nfirst one\n7" + card + behind + "second\n8" + card + behind + shells);
        ASSERT_EQ(deck.parts.size(), 2u);
        EXPECT_EQ(deck.parts[0].name, "first one");
        EXPECT_EQ(deck.parts[1].name, "second");
        EXPECT_EQ(deck.parts[1].thickness, 0.9);
        EXPECT_EQ(deck.parts[1].material_id, 6);
    }
    const Deck layered = read(
        "*PART_COMPOSITE\nlaminate\n7,2\n6,.5,0,0,6,.25,45\n6,.5\n*PART_COMPOSITE_LONG\nother\n8,2\n6,.5,0,0,0,11\n6,.125,0,0,0,12\n" +
        shells);
    EXPECT_EQ(layered.parts[0].thickness, 1.25);
    EXPECT_EQ(layered.parts[0].name, "laminate");
    EXPECT_EQ(layered.parts[1].thickness, 0.625);
    EXPECT_EQ(layered.parts[1].material_id, 6);
    EXPECT_EQ(read("*PART_MOVE\n7,0.1,0,0,0\n*PART\n\n7,5,6\n" + shells).parts[0].name, "");
}

TEST(DynaDeck, SectionsAndMaterialsWithTheirOptions)
{
    const std::string shells = four_nodes + "*PART\nlid\n7,5,6\n*ELEMENT_SHELL\n1,7,1,2,3,4\n";
    const auto thickness = [&](const std::string& section) { return read(shells + section).parts[0].thickness; };
    EXPECT_EQ(thickness("*SECTION_SHELL\n5,2\n.9\n"), 0.9);
    EXPECT_EQ(thickness("*SECTION_SHELL_TITLE\n5,2\n5,2\n.9,.9,.9,.9\n"), 0.9);
    EXPECT_EQ(thickness("*SECTION_SHELL\n5,2\n1,2,3,4\n"), 2.5);
    // Angles of eight layers follow on a card, then the next section.
    EXPECT_EQ(thickness("*SECTION_SHELL\n4,2,0,8,0,0,1\n.7\n0,0,0,0,0,0,0,0\n5,2\n.9\n"), 0.9);
    EXPECT_EQ(thickness("*SECTION_SHELL\n4,2,0,9,0,0,1\n.7\n0,0,0,0,0,0,0,0\n5\n5,2\n.9\n"), 0.9);
    // Two layers if it says none.
    EXPECT_EQ(thickness("*SECTION_SHELL\n4,2,0,,0,0,1\n.7\n0,90\n5,2\n.9\n"), 0.9);
    EXPECT_EQ(thickness("*SECTION_SHELL_MISC\n5,2\n.9\n5,5\n7,7\n"), 0.9);
    EXPECT_FALSE(thickness("*SECTION_SHELL\n5,2\n0,0,0,0\n"));
    EXPECT_FALSE(thickness("*SECTION_SOLID\n5,2\n.9\n"));
    const auto material = [&](const std::string& text) { return read(shells + text).parts[0].material; };
    EXPECT_EQ(material("*MAT_ELASTIC\n6,7.8e-9\n9,9\n"), "MAT_ELASTIC");
    EXPECT_EQ(material("*MAT_ELASTIC_TITLE\nDC04 of the mill\n6,7.8e-9\n"), "DC04 of the mill");
    EXPECT_EQ(material("*mat_024\n         6\n*MAT_ADD_EROSION\n6,1\n"), "MAT_024");
    EXPECT_EQ(material("*MAT_ELASTIC_TITLE\nT\xfcr\n6\n"), "T\xc3\xbcr");
}

TEST(DynaDeck, ParametersAreTakenWhereTheyAreDefined)
{
    const std::string shells =
        four_nodes + "*PART\nlid\n&pid,5,6\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*SECTION_SHELL\n5,2\n&Thick,&thick,&thick\n";
    const Deck deck = read("*PARAMETER\nR    thick       0.8I      pid         7\n" + shells);
    EXPECT_EQ(deck.parts[0].thickness, 0.8);
    EXPECT_EQ(deck.parts[0].name, "lid");
    EXPECT_EQ(read("*PARAMETER\nI pid, 7\n*PARAMETER_EXPRESSION\nR thick   1.25\n" + shells).parts[0].thickness, 1.25);
    EXPECT_EQ(read("*PARAMETER\nI pid, 7\n*PARAMETER_EXPRESSION\nR thick   2*pid\n" + shells).parts[0].thickness, 14);
    const Deck without = read("*PARAMETER\nI pid, 7\n*PARAMETER_EXPRESSION\nR thick   2*pod\n" + shells);
    EXPECT_FALSE(without.parts[0].thickness);
    EXPECT_TRUE(has_note(without, "&Thick"));
    EXPECT_TRUE(std::any_of(without.doubts.begin(), without.doubts.end(), [](const std::string& doubt) {
        return doubt.find("*PARAMETER_EXPRESSION") != std::string::npos;
    }));
    EXPECT_NE(refusal("a.k", "*NODE\n1,0,&x,0\n" + shells).find("line 2: the parameter &x is not defined before"),
              std::string::npos);
}

TEST(DynaDeck, ExpressionsComeToTheirValues)
{
    const auto thickness = [](const std::string& expression) {
        return read("*PARAMETER\nR a, 2.0\nI n, 3\n*PARAMETER_EXPRESSION\nR b, a*1.5\nI m, 7.9/a\nR thick, " +
                    expression + "\n" + four_nodes +
                    "*PART\nlid\n7,5,6\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*SECTION_SHELL\n5,2\n&thick\n")
            .parts[0]
            .thickness;
    };
    for (const auto& [text, value] : {std::pair<const char*, double>{"a*0.75+sqrt(0.25)*0", 1.5},
                                      {"&a/4", 0.5},
                                      {"2**n", 8},
                                      {"2**3**2", 512},
                                      {"(a+b)*n/m", 5},
                                      {"1.5d-1*A", 0.3},
                                      {"max(a,b,n)-min(a,b)", 1},
                                      {"mod(n,2)", 1},
                                      {"sign(a,-n)+n", 1},
                                      {"exp(log(a))", 2},
                                      {"4*atan(1.0)-pi+1", 1},
                                      {"int(2.7)+nint(2.7)", 5},
                                      {"-(-a)", 2},
                                      {"3/2", 1.5}}) {
        ASSERT_TRUE(thickness(text)) << text;
        EXPECT_NEAR(*thickness(text), value, 1e-12) << text;
    }
    for (const char* text : {"a*", "(a", "a)", "c", "a b", "1/0", "sqrt(-1)", "system(1)", "a=3", "\"a\"", "0/0"})
        EXPECT_FALSE(thickness(text)) << text;
    EXPECT_FALSE(thickness(std::string(5000, '(')));
    // In columns commas stand between arguments only.
    const Deck columns =
        read("*PARAMETER\nR        a       2.0\n*PARAMETER_EXPRESSION\nR    thick max(a,3)+mod(7,4)\n" + four_nodes +
             "*PART\nlid\n7,5,6\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*SECTION_SHELL\n5,2\n&thick\n");
    EXPECT_EQ(columns.parts[0].thickness, 6);
}

class DynaIncludes : public testing::Test {
protected:
    void put(const std::string& name, const std::string& text) { spia::put(scratch / name, text); }
    Deck read(const std::string& name) { return read_deck(scratch / name, content_of(scratch / name)); }
    std::string refusal(const std::string& name)
    {
        try {
            read(name);
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    }
    ScratchFolder scratch;
};

TEST_F(DynaIncludes, FilesBesideTheDeckAndBelowItInTheirOwnFormats)
{
    std::filesystem::create_directories(scratch / "sub folder");
    put("main.k",
        "*KEYWORD\n*INCLUDE\n$ a comment\nsub folder/nodes.k\nsub folder/\xc3\xa4 very long +\nname.k\n*INCLUDE %\ni10.k\n*PART\nlid\n"
        "         7         5         6\n*END\n");
    put("sub folder/nodes.k",
        "*KEYWORD LONG=Y\n*NODE\n                   1                 0.0                 0.0                 0.0\n*INCLUDE -\nmore.k\n"
        "*NODE\n                   2                 1.0                 0.0                 0.0\n");
    put("sub folder/more.k", "*NODE\n       3             1.0             1.0             0.0\n*END\nnothing\n");
    put("sub folder/\xc3\xa4 very longname.k", "*NODE\n       4             0.0             1.0             0.0\n");
    put("i10.k", "*ELEMENT_SHELL\n         1         7         1         2         3         4\n");
    const Deck deck = read("main.k");
    EXPECT_EQ(deck.node, (std::vector<std::int64_t>{1, 3, 2, 4})); // in the order of the lines
    ASSERT_EQ(deck.elements(), 1);
    EXPECT_EQ(deck.corner[0], (std::array<int, 4>{0, 2, 1, 3}));
    EXPECT_EQ(deck.parts[0].name, "lid");
    EXPECT_EQ(deck.notes, std::vector<std::string>());
}

TEST_F(DynaIncludes, LocalParametersHoldInTheirFileAndThoseItIncludes)
{
    const std::string part = "*SECTION_SHELL\n5,2\n&t\n";
    put("local.k", "*PARAMETER_LOCAL\nR t, 9.9\n*INCLUDE\ninner.k\n*NODE\n5,&t,0,0\n");
    put("inner.k", "*NODE\n6,&t,0,0\n");
    put("main.k", "*PARAMETER\nR t, 0.8\n" + four_nodes + "*INCLUDE\nlocal.k\n*PART\nlid\n7,5,6\n" + part +
                      "*ELEMENT_SHELL\n1,7,1,2,3,4\n*NODE\n7,&t,0,0\n");
    const Deck deck = read("main.k");
    EXPECT_EQ(deck.parts.at(0).thickness, 0.8);
    EXPECT_EQ(deck.position.at(4).x(), 9.9) << "included by the file that has it";
    EXPECT_EQ(deck.position.at(5).x(), 9.9) << "its own";
    EXPECT_EQ(deck.position.at(6).x(), 0.8);
    put("own.k", "*PARAMETER_LOCAL\nR t, 1.5\n*PARAMETER\nR t, 0.8\n" + four_nodes + "*PART\nlid\n7,5,6\n" + part +
                     "*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    EXPECT_EQ(read("own.k").parts.at(0).thickness, 1.5) << "what is local comes first";
}

TEST(DynaDeck, ThicknessesWithoutSenseAreToldAndNotTaken)
{
    const std::string shells = four_nodes + "*PART\nlid\n7,5,6\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*SECTION_SHELL\n5,2\n";
    for (const char* absurd : {"-1", "1e300", "1e6"}) {
        const Deck deck = deck_dyna_test::read(shells + absurd + "\n");
        EXPECT_FALSE(deck.parts[0].thickness) << absurd;
        EXPECT_TRUE(has_note(deck, "part 7 lid: its thickness of")) << absurd;
    }
    EXPECT_EQ(deck_dyna_test::read(shells + "1e5\n").parts[0].thickness, 1e5);
    const Deck own = deck_dyna_test::read(four_nodes + "*ELEMENT_SHELL_THICKNESS\n9,7,1,2,3,4\n-2,-2,-2,-2\n");
    EXPECT_TRUE(has_note(own, "1 shell has an own thickness that is invalid"));
    EXPECT_TRUE(has_note(own, "first: element 9"));
    EXPECT_FALSE(own.parts[0].thickness);
}

TEST(DynaDeck, AMinusBeforeAParameterTurnsItsSign)
{
    const auto second_node = [](const std::string& value, const std::string& field) {
        return deck_dyna_test::read("*PARAMETER\nR x, " + value + "\n*NODE\n1,0,0,0\n2," + field +
                                    ",0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT_SHELL\n1,7,1,2,3,4\n")
            .position.at(1)
            .x();
    };
    EXPECT_EQ(second_node("1.5", "&x"), 1.5);
    EXPECT_EQ(second_node("1.5", "-&x"), -1.5);
    EXPECT_EQ(second_node("-1.5", "-&x"), 1.5);
    EXPECT_EQ(second_node("+1.5", "-&x"), -1.5);
    EXPECT_THROW(second_node("1.5", "-&y"), InputError);
}

TEST(DynaDeck, FieldsThatAreNotWrittenBackAreTold)
{
    const std::string shell = four_nodes + "*ELEMENT_SHELL";
    EXPECT_TRUE(
        has_note(deck_dyna_test::read(shell + "_OFFSET\n1,7,1,2,3,4\n.5\n"), "1 shell has a material direction"));
    EXPECT_FALSE(has_note(deck_dyna_test::read(shell + "\n1,7,1,2,3,4\n"), "material direction"));
}

TEST(DynaDeck, CardsOfOtherKindsOfShellsAreNotShells)
{
    const Deck deck =
        deck_dyna_test::read(four_nodes + "*ELEMENT_SHELL\n1,7,1,2,3,4\n*ELEMENT_SHELL_SOURCE_SINK\n12,1,2\n");
    EXPECT_EQ(deck.elements(), 1);
    EXPECT_TRUE(has_note(deck, "*ELEMENT_SHELL_SOURCE_SINK lines"));
}

TEST_F(DynaIncludes, FoldersAreAddedAndBackslashesAreSlashes)
{
    std::filesystem::create_directories(scratch / "lib");
    put("lib/nodes.k", four_nodes);
    put("main.k", "*INCLUDE_PATH_RELATIVE\nlib\n*INCLUDE\nnodes.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    EXPECT_EQ(read("main.k").elements(), 1);
    put("main.k", "*INCLUDE\n.\\lib\\nodes.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    EXPECT_EQ(read("main.k").elements(), 1);
    put("main.k",
        "*INCLUDE_PATH\n" + (scratch / "lib").string() + "\n*INCLUDE\nnodes.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    EXPECT_EQ(read("main.k").elements(), 1);
    put("main.k", "*INCLUDE_PATH\nlib\n*INCLUDE\nnodes.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*END\n");
    EXPECT_EQ(read("main.k").elements(), 1) << "beside the deck, wherever the program was started";
    EXPECT_TRUE(read("main.k").doubts.empty());
}

TEST_F(DynaIncludes, AFileThatIsMissingIsADoubtAboutThePart)
{
    put("main.k", four_nodes + "*INCLUDE\nlost.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n*END\n");
    const Deck deck = read("main.k");
    ASSERT_EQ(deck.doubts.size(), 1u);
    EXPECT_NE(deck.doubts[0].find("lost.k is not there"), std::string::npos);
    EXPECT_TRUE(has_note(deck, deck.doubts[0]));
}

TEST_F(DynaIncludes, CirclesAndTowersAreRefusedAndRepetitionsTakenOnce)
{
    put("main.k", "*INCLUDE\nb.k\n" + four_nodes);
    put("b.k", "*NODE\n9,1,1,1\n*INCLUDE\nmain.k\n");
    EXPECT_NE(refusal("main.k").find("b.k, line 4: the file "), std::string::npos) << refusal("main.k");
    EXPECT_NE(refusal("main.k").find("includes itself"), std::string::npos);
    for (int k = 0; k < 30; ++k)
        put(fmt::format("t{}.k", k), fmt::format("*INCLUDE\nt{}.k\n", k + 1));
    EXPECT_NE(refusal("t0.k").find("included 20 deep"), std::string::npos) << refusal("t0.k");
    // Each file includes the next one twice: 2^18 readings, if they were read so often.
    for (int k = 0; k < 18; ++k)
        put(fmt::format("t{}.k", k), fmt::format("*INCLUDE\nt{0}.k\nt{0}.k\n", k + 1));
    put("t18.k", four_nodes + "*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    const Deck deck = read("t0.k");
    EXPECT_EQ(deck.elements(), 1);
    EXPECT_TRUE(has_note(deck, "included more than once"));
}

TEST_F(DynaIncludes, WhatIsMissingIsTold)
{
    put("main.k", four_nodes + "*INCLUDE\nnone.k\n*ELEMENT_SHELL\n1,7,1,2,3,4\n");
    EXPECT_TRUE(has_note(read("main.k"), "none.k is not there"));
    put("broken.k", "*NODE\n5,1,x,0\n");
    put("main.k", four_nodes + "*INCLUDE\nbroken.k\n");
    EXPECT_NE(refusal("main.k").find("broken.k, line 2: 'x' is not a number"), std::string::npos) << refusal("main.k");
}

TEST(DynaDeck, AnEndThatIsMissingIsTold)
{
    const std::string deck = four_nodes + "*ELEMENT_SHELL\n1,7,1,2,3,4\n";
    EXPECT_TRUE(has_note(read("*KEYWORD\n" + deck), "does not end with *END"));
    EXPECT_FALSE(has_note(read("*KEYWORD\n" + deck + "*end\n"), "does not end with *END"));
    EXPECT_FALSE(has_note(read(deck), "does not end with *END")) << "a file to be included";
}

TEST(DynaDeck, WhatIsNotReadIsTold)
{
    const Deck deck = read(
        "*CONTACT_SINGLE\n1\n*CONTACT_SINGLE\n1\n*ELEMENT_SOLID\n9,9,1,2,3,4,4,4,4,4\n*ELEMENT_BEAM\n1,1,1,2\n2,1,1,2\n" +
        four_nodes + "*ELEMENT_SHELL\n1,7,1,2,3,4\n2,7,1,2,99,4\n1,7,2,3,4,1\n");
    EXPECT_EQ(deck.elements(), 2);
    EXPECT_EQ(deck.parts[0].broken, 1);
    EXPECT_EQ(deck.parts[0].broken_element, 2);
    EXPECT_EQ(deck.parts[0].missing_node, 99);
    EXPECT_TRUE(has_note(deck, "*CONTACT_SINGLE (2)"));
    EXPECT_TRUE(has_note(deck, "*ELEMENT_BEAM lines (2), *ELEMENT_SOLID lines"));
    EXPECT_TRUE(has_note(deck, "1 shell element names nodes"));
    EXPECT_TRUE(has_note(deck, "more than once (first: 1)"));
}

TEST(DynaDeck, IsRefusedWithItsLineWhereItIsWrong)
{
    const auto expect = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal("a.k", text).find(words), std::string::npos) << words << "\nin: " << refusal("a.k", text);
    };
    expect("*NODE\n       1             0.x\n", "line 2: '0.x' is not a number");
    expect("*NODE\n\n\n     1.5             0.0\n", "line 4: '1.5' is not a whole number");
    expect("*NODE\n1,1e31,0,0\n", "line 2: the coordinate '1e31'");
    expect(four_nodes + "*ELEMENT_SHELL\n1,7,1,2,x\n", "line 7: 'x' is not a whole number");
    expect(four_nodes + "*ELEMENT_SHELL_THICKNESS\n1,7,1,2,3,4\n*END\n",
           "line 8: the card with the thickness of element 1");
    expect(four_nodes + "*NODE\n2,1,0,1e-9\n*ELEMENT_SHELL\n1,7,1,2,3,4\n", "node 2 is given twice");
    EXPECT_EQ(refusal("a.k", four_nodes + "*NODE\n2,1,0,0\n*ELEMENT_SHELL\n1,7,1,2,3,4\n"), "");
    expect(four_nodes, "no shell element");
    expect("*ELEMENT_SOLID\n1\n", "elements that are no shells");
}

TEST(DynaDeck, TabsAndBlankFieldsAreRead)
{
    const Deck deck = read(
        "*NODE\n1\t0.0\t0.0\t0.0\n2\t1.0\t0.0\t0.0\n       3             1.0             1.0\n       4                             1.0\n"
        "*ELEMENT_SHELL\n1\t7\t1\t2\t3\t4\n");
    ASSERT_EQ(deck.elements(), 1);
    EXPECT_EQ(deck.position[2], Eigen::Vector3d(1, 1, 0));
    EXPECT_EQ(deck.position[3], Eigen::Vector3d(0, 1, 0));
}

TEST(DynaDeck, StopsWhenAsked)
{
    std::string text = four_nodes;
    for (int k = 0; k < 40000; ++k)
        text += fmt::format("{},0,0,0\n", k + 5);
    text += "*ELEMENT_SHELL\n1,7,1,2,3,4\n";
    std::vector<double> fractions;
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    const Progress watch([&](double fraction, std::string_view) { fractions.push_back(fraction); }, cancel);
    read_deck("/nowhere/a.k", text, watch);
    EXPECT_GE(fractions.size(), 2u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    *cancel = true;
    EXPECT_THROW(read_deck("/nowhere/a.k", text, watch), Cancelled);
}

} // namespace
} // namespace spia::deck_dyna_test

#include "engine/exchange/deck/deck_choice.h"

#include <fstream>
#include <gtest/gtest.h>

#include "engine/exchange/read_part.h"
#include "engine/options/option.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deck_choice_test {
namespace {

Deck strip() { return sample::read("a.k", sample::dyna()); }

std::string refusal(const Deck& deck, const std::vector<std::string>& wanted)
{
    try {
        choose_parts(deck, wanted);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(DeckChoice, TakesPartsByIdOrNameInTheOrderOfTheDeck)
{
    const Deck deck = strip();
    EXPECT_EQ(choose_parts(deck, {}).element, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
    for (const char* name : {"7", "Hood", " hood ", "HOOD"}) {
        const DeckChoice choice = choose_parts(deck, std::vector<std::string>{name});
        EXPECT_EQ(choice.element, (std::vector<int>{0, 1, 2, 3})) << name;
        EXPECT_EQ(choice.node, (std::vector<int>{0, 1, 2, 4, 5, 6, 8, 9, 10}));
        EXPECT_EQ(choice.thickness, 1.25);
        EXPECT_EQ(choice.material, "DC04");
        ASSERT_EQ(choice.soup.polygons(), 4);
        for (int f = 0; f < 4; ++f)
            for (size_t k = 0; k < 4; ++k)
                EXPECT_EQ(choice.node[size_t(choice.soup.polygon(f)[k])],
                          deck.corner[size_t(choice.element[size_t(f)])][k]);
    }
    const DeckChoice both = choose_parts(deck, std::vector<std::string>{"Rail", "7"});
    EXPECT_EQ(both.element.size(), 7u);
    EXPECT_FALSE(both.thickness);
    EXPECT_EQ(both.material, "DC04");
    ASSERT_EQ(both.notes.size(), 1u);
    EXPECT_EQ(both.notes[0], "the parts have thicknesses from 0.75 to 1.25 in the deck; none is used");
}

TEST(DeckChoice, TakesSetsByName)
{
    Deck deck = strip();
    deck.sets = {{"corner", {5, 6}}};
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"Corner"}).element, (std::vector<int>{5, 6}));
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"corner", "7"}).element,
              (std::vector<int>{0, 1, 2, 3, 5, 6}));
}

TEST(DeckChoice, ASetNeedsOnlyItsOwnNodes)
{
    Deck deck = strip();
    deck.parts[1].broken = 2; // of the part that the set lies in
    deck.sets = {{"corner", {5, 6}}, {"torn", {5}, 1}};
    EXPECT_EQ(choose_parts(deck, std::vector<std::string>{"corner"}).element, (std::vector<int>{5, 6}));
    EXPECT_NE(refusal(deck, {"torn"}).find("element set torn: 1 shell names nodes"), std::string::npos);
}

TEST(DeckChoice, SaysWhichPartsThereAre)
{
    Deck deck = strip();
    const std::string none = refusal(deck, {"8"});
    EXPECT_NE(none.find("there is no part '8'"), std::string::npos);
    EXPECT_NE(none.find("7 Hood"), std::string::npos);
    EXPECT_NE(none.find("4 shells, thickness 1.25, DC04"), std::string::npos) << none;
    deck.parts.push_back({.id = 8, .name = "solid"});
    EXPECT_NE(refusal(deck, {"8"}).find("part 8 solid has no shell elements"), std::string::npos);
    EXPECT_NE(refusal(deck, {"solid"}).find("no part 'solid'"), std::string::npos);
    deck.parts[1].name = "hood";
    EXPECT_EQ(refusal(deck, {"Hood"}), ""); // as written before any case
    EXPECT_NE(refusal(deck, {"HOOD"}).find("several parts"), std::string::npos);
    deck.parts[1].broken = 2;
    deck.parts[1].broken_element = 17;
    deck.parts[1].missing_node = 4;
    EXPECT_NE(refusal(deck, {"9"}).find("2 shells name nodes that are not in the deck (first: element 17, node 4)"),
              std::string::npos);
    EXPECT_NE(refusal(deck, {}).find("2 shells name nodes"), std::string::npos);
    EXPECT_EQ(refusal(deck, {"7"}), "");
    for (int p = 0; p < 50; ++p)
        deck.parts.push_back({.id = 100 + p, .elements = 1});
    EXPECT_NE(part_list(deck.parts).find("and 12 more"), std::string::npos) << part_list(deck.parts);
}

class PartOfDeck : public testing::Test {
protected:
    PartFile read(const std::string& text, const ReadOptions& options = {}, const std::string& name = "deck.k")
    {
        put(scratch / name, text);
        return read_part(scratch / name, options);
    }
    std::string refusal(const std::string& text, const ReadOptions& options = {}, const std::string& name = "deck.k")
    {
        try {
            read(text, options, name);
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    }
    ScratchFolder scratch;
};

TEST_F(PartOfDeck, KeepsTheIdsOfTheDeck)
{
    ReadOptions options;
    options.parts = {"Rail"};
    const PartFile part = read(sample::dyna(), options);
    EXPECT_EQ(part.file_faces, 3);
    EXPECT_EQ(part.mesh.triangles(), 4);
    ASSERT_TRUE(part.deck);
    EXPECT_EQ(part.deck->element, (std::vector<int>{4, 5, 6}));
    EXPECT_EQ(part.deck->element_id, (std::vector<std::int64_t>{505, 506, 507}));
    EXPECT_EQ(part.source_face, (std::vector<int>{0, 0, 1, 2}));
    const sample::Strip strip;
    for (int t = 0; t < part.mesh.triangles(); ++t) {
        const auto& shell = strip.shell[size_t(part.deck->element[size_t(part.source_face[size_t(t)])])];
        for (int k = 0; k < 3; ++k) {
            const auto id = part.deck->node_id[size_t(part.source_vertex[size_t(part.mesh.triangle(k, t))])];
            EXPECT_TRUE(std::find(shell.node.begin(), shell.node.end(), id) != shell.node.end());
            const auto& place = strip.node[size_t((id - 101) / 10)];
            EXPECT_EQ(place.first, id);
            EXPECT_EQ(part.mesh.position.col(part.mesh.triangle(k, t)), Eigen::Vector3d(place.second.data()));
        }
    }
    EXPECT_EQ(part.thickness_mm, 0.75);
    EXPECT_EQ(part.material, "DC04");
    EXPECT_EQ(part.notes.back(), "the deck gives a thickness of 0.75 mm and the material DC04");
    EXPECT_EQ(part.format, "LS-DYNA keyword");
}

TEST_F(PartOfDeck, UnitsScaleLengthsAndThicknessOnly)
{
    ReadOptions options;
    options.parts = {"7"};
    const PartFile mm = read(sample::dyna(), options);
    options.unit = LengthUnit::inch;
    const PartFile inch = read(sample::dyna(), options);
    EXPECT_LT((inch.mesh.position - 25.4 * mm.mesh.position).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_DOUBLE_EQ(*inch.thickness_mm, 25.4 * 1.25);
    std::string metres = sample::radioss();
    for (size_t at = metres.find("  mm "); at != metres.npos; at = metres.find("  mm "))
        metres.replace(at, 5, "   m ");
    options.unit.reset();
    EXPECT_EQ(read(metres, options, "deck.rad").unit, LengthUnit::m); // the deck says so
    EXPECT_DOUBLE_EQ(*read(metres, options, "deck.rad").thickness_mm, 1250);
    options.unit = LengthUnit::cm;
    EXPECT_DOUBLE_EQ(*read(metres, options, "deck.rad").thickness_mm, 12.5);
}

TEST_F(PartOfDeck, OfSeveralPartsTheMessageListsThem)
{
    // The same strip once more, 1000 mm away: two pieces.
    std::string two = sample::dyna_commas();
    const sample::Strip strip;
    two += "*PART\nother\n11,7,2\n*NODE\n";
    for (const auto& [id, x] : strip.node)
        two += fmt::format("{}, {}, {}, {}\n", id + 1000, x[0] + 1000, x[1], x[2]);
    two += "*ELEMENT_SHELL\n";
    for (const auto& s : strip.shell)
        two += fmt::format("{},11,{},{},{},{}\n", s.id + 1000, s.node[0] + 1000, s.node[1] + 1000, s.node[2] + 1000,
                           s.node.size() > 3 ? s.node[3] + 1000 : 0);
    const std::string text = command_line_text(refusal(two));
    EXPECT_NE(text.find("2 separate pieces"), std::string::npos) << text;
    EXPECT_NE(text.find("choose by id or name (--part):\n  7 Hood"), std::string::npos) << text;
    EXPECT_NE(text.find("11 other"), std::string::npos);
    ReadOptions options;
    options.parts = {"7", "Rail"};
    EXPECT_EQ(read(two, options).mesh.triangles(), 12);
    options.parts = {"7", "other"};
    EXPECT_EQ(refusal(two, options).find("choose by id"), std::string::npos); // it has been chosen
    EXPECT_NE(refusal(two, options).find("separate pieces"), std::string::npos);
    options.parts = {"7"};
    EXPECT_NE(
        refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", options, "a.obj").find("from solver decks and CAD files only"),
        std::string::npos);
}

TEST_F(PartOfDeck, ShellsTurnedOverAreTurnedBack)
{
    std::string text = sample::nastran(sample::Field::free);
    const size_t at = text.find("CQUAD4,502");
    std::string line = text.substr(at, text.find('\n', at) - at);
    const auto comma = [&](int n) {
        size_t place = 0;
        while (n-- > 0)
            place = line.find(',', place) + 1;
        return place;
    };
    const std::string second = line.substr(comma(4), 3), fourth = line.substr(comma(6), 3);
    line.replace(comma(6), 3, second).replace(comma(4), 3, fourth);
    text.replace(at, line.size(), line);
    const PartFile part = read(text, {}, "deck.bdf");
    ASSERT_TRUE(part.doctor.find(Fault::flipped_face));
    EXPECT_EQ(part.doctor.find(Fault::flipped_face)->where, (std::vector<int>{1, 1}));
    EXPECT_EQ(part.mesh.triangles(), 12);
}

} // namespace
} // namespace spia::deck_choice_test

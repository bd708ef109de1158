// Radioss submodels and LS-DYNA *NODE_TRANSFORM, against the same parts written plainly.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/unit/exchange/plain_deck.h"
#include "tests/unit/exchange/sample_decks.h"

namespace spia::submodel_test {
namespace {

using sample::Chance;
using sample::expect_same;
using sample::grid;
using sample::PlainDeck;
using sample::refusal;
using sample::turned;

constexpr unsigned family = 30; ///< decks per test

std::string number(double x) { return fmt::format("{:20.12g}", x); } // as wide as the columns
/// What number() leaves of it.
Eigen::Vector3d written(const Eigen::Vector3d& x)
{
    return {std::stod(number(x.x())), std::stod(number(x.y())), std::stod(number(x.z()))};
}
std::string ten(std::int64_t id) { return fmt::format("{:10}", id); }
std::string point(std::int64_t id, const Eigen::Vector3d& x, const std::string& more = "")
{
    return (id ? ten(id) : std::string(10, ' ')) + number(x.x()) + number(x.y()) + number(x.z()) + more + "\n";
}

/// Nodes and quads of a Radioss deck; its numbers are less by the offsets of what it stands in.
std::string radioss(const PlainDeck& deck, int part)
{
    std::string text = "/NODE\n";
    for (const auto& [id, x] : deck.node)
        text += point(id, x);
    text += fmt::format("/SHELL/{}\n", part);
    for (const auto& [id, corner] : deck.shell) {
        text += ten(id);
        for (const std::int64_t each : corner)
            text += ten(each);
        text += "\n";
    }
    return text;
}
std::string begin(const std::string& unit)
{
    return "/BEGIN\nrun\n      2022         0\n" + fmt::format("{:>20}{:>20}{:>20}\n", "Mg", unit, "s") +
           fmt::format("{:>20}{:>20}{:>20}\n", "Mg", unit, "s");
}

/// A transformation of a group or of a submodel, and what it does.
struct Transform {
    std::string text;
    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> move;
};

/// @param length  of a unit of what it stands in, in that of the deck
Transform transform(Chance& chance, std::int64_t group, std::int64_t submodel, double length = 1)
{
    const Eigen::Vector3d a = written(chance.vector(50)), b = written(a + chance.vector(20));
    const std::string of_submodel = ten(0) + ten(0) + ten(submodel);
    if (chance.whole(0, 1))
        return {"/TRANSFORM/TRA/1\nby\n" + point(group, a, of_submodel),
                [=](const auto& x) { return Eigen::Vector3d(x + length * a); }};
    const double degrees = chance.whole(-170, 170);
    return {"/TRANSFORM/ROT/1\nturn\n" + point(group, a, of_submodel) + point(0, b, number(degrees)),
            [=](const auto& x) { return turned(x, length * a, length * b, degrees); }};
}

PlainDeck shifted(const PlainDeck& deck, std::int64_t nodes, std::int64_t shells,
                  const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& move)
{
    PlainDeck result;
    for (const auto& [id, x] : deck.node)
        result.node[id + nodes] = move(x);
    for (auto [id, corner] : deck.shell) {
        for (std::int64_t& each : corner)
            each += nodes;
        result.shell[id + shells] = corner;
    }
    return result;
}
void add(PlainDeck& deck, const PlainDeck& more)
{
    deck.node.insert(more.node.begin(), more.node.end());
    deck.shell.insert(more.shell.begin(), more.shell.end());
}

PlainDeck some_grid(Chance& chance)
{
    const double width = chance.real(1, 9);
    return grid(chance.whole(1, 6), chance.whole(1, 6), chance.whole(1, 9), 20, chance.whole(1, 9), [&](int i, int j) {
        return written({width * i, 2. * j, 0.1 * i * j});
    });
}

TEST(Submodels, OneInAnotherHasItsOffsetsItsUnitAndItsMoves)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(seed);
        const PlainDeck own = some_grid(chance), outer = some_grid(chance), inner = some_grid(chance);
        const bool in_cm = chance.whole(0, 1);
        const double length = in_cm ? 10 : 1;
        const Transform of_outer = transform(chance, 0, 4), again = transform(chance, 0, 4),
                        of_inner = transform(chance, 0, 5, length);
        const std::string text = begin("mm") + radioss(own, 1) + "//SUBMODEL/4\nouter\n" + ten(0) + ten(1000) +
                                 ten(2000) + ten(10) + "\n" + (in_cm ? begin("cm") : "") + radioss(outer, 1) +
                                 "//SUBMODEL/5\ninner\n" + ten(3000) + "\n" + radioss(inner, 1) + "//ENDSUB\n" +
                                 of_inner.text + "/PART/1\nlid\n" + ten(3) + ten(0) + "\n//ENDSUB\n" + of_outer.text +
                                 again.text + "/END\n";
        PlainDeck truth = own;
        add(truth, shifted(outer, 1000, 2000, [&](const auto& x) { return again.move(of_outer.move(length * x)); }));
        add(truth, shifted(inner, 4000, 5000,
                           [&](const auto& x) { return again.move(of_outer.move(of_inner.move(length * x))); }));
        const Deck deck = sample::read("a.rad", text);
        EXPECT_TRUE(deck.doubts.empty()) << deck.doubts.front();
        expect_same(PlainDeck(deck), truth);
        const DeckPart& part = deck.parts[size_t(deck.part_of[size_t(own.shell.size())])];
        EXPECT_EQ(part.id, 11);
        EXPECT_EQ(part.name, "lid");
    }
}

TEST(Submodels, AGroupInASubmodelIsMovedInItsFrame)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(100 + seed);
        const PlainDeck inner = some_grid(chance);
        const Transform of_submodel = transform(chance, 0, 4), of_group = transform(chance, 7, 0);
        const std::string text = begin("mm") + "//SUBMODEL/4\nframe\n" + ten(500) + "\n" + radioss(inner, 1) +
                                 "/GRNOD/PART/7\nall\n" + ten(1) + "\n" + of_group.text + "//ENDSUB\n" +
                                 of_submodel.text;
        // what moves x in the submodel moves it before the submodel is placed
        expect_same(PlainDeck(sample::read("a.rad", text)),
                    shifted(inner, 500, 500, [&](const auto& x) { return of_submodel.move(of_group.move(x)); }));
    }
}

TEST(Submodels, WayAndAxisMayBeGivenByNodes)
{
    const PlainDeck plate = grid(1, 1, 1, 10, 1, [](int i, int j) { return Eigen::Vector3d(i, j, 0); });
    const std::string deck = begin("mm") + "//SUBMODEL/4\nframe\n\n" + radioss(plate, 1) + "//ENDSUB\n";
    const auto moved = [&](const std::string& text) { return PlainDeck(sample::read("a.rad", deck + text)); };
    const auto by_nodes = [](const char* kind, std::int64_t a, std::int64_t b) {
        return fmt::format("/TRANSFORM/{}/1\nx\n", kind) + point(0, {0, 0, 0}, ten(a) + ten(b) + ten(4));
    };
    expect_same(moved(by_nodes("TRA", 1, 12)),
                shifted(plate, 0, 0, [](const auto& x) { return Eigen::Vector3d(x.x() + 1, x.y() + 1, 0); }));
    // the second time the nodes of the axis have been moved as well
    const std::string quarter = by_nodes("ROT", 1, 2) + point(0, {0, 0, 0}, number(90));
    expect_same(moved("/TRANSFORM/TRA/1\nx\n" + point(0, {0, 5, 0}, ten(0) + ten(0) + ten(4)) + quarter),
                shifted(plate, 0, 0, [](const auto& x) { return Eigen::Vector3d(x.x(), 5, x.y()); }));
}

TEST(Submodels, WhatIsNotReadIsADoubtOrRefused)
{
    const PlainDeck plate = grid(1, 1, 1, 10, 1, [](int i, int j) { return Eigen::Vector3d(i, j, 0); });
    const std::string deck = begin("mm") + radioss(plate, 1);
    const auto has_doubt = [&](const std::string& text, const std::string& words) {
        for (const std::string& doubt : sample::read("a.rad", deck + text).doubts)
            if (doubt.find(words) != doubt.npos)
                return true;
        return false;
    };
    const std::string sub = "//SUBMODEL/4\nx\n\n//ENDSUB\n";
    EXPECT_TRUE(has_doubt("//SUBMODEL/4\nx\n", "no //ENDSUB"));
    EXPECT_TRUE(has_doubt("//SUBMODEL/4/3\nx\n\n//ENDSUB\n", "//SUBMODEL in a unit system of its own"));
    EXPECT_TRUE(has_doubt("//SUBMODEL/4\nx\n\n" + begin("furlong") + "//ENDSUB\n", "unit system of its own"));
    EXPECT_TRUE(has_doubt(sub + "/TRANSFORM/TRA/1\nx\n" + point(0, {1, 1, 1}, ten(0) + ten(0) + ten(9)),
                          "/TRANSFORM of a submodel"));
    EXPECT_TRUE(
        has_doubt(sub + "/TRANSFORM/SCA/1\nx\n" + point(0, {2, 1, 1}, ten(0) + ten(4)), "/TRANSFORM of a submodel"));
    EXPECT_TRUE(has_doubt("/SUBMODEL/4\n", "/SUBMODEL"));
    EXPECT_FALSE(has_doubt(sub, ""));
    const auto expect = [&](const std::string& text, const std::string& words) {
        const std::string said = refusal("a.rad", text);
        EXPECT_NE(said.find(words), std::string::npos) << words << "\nin: " << said;
    };
    expect("/BEGIN\n//ENDSUB\n", "line 2: //ENDSUB stands without //SUBMODEL");
    expect("//SUBMODEL/4\nx\n         z\n", "line 3: 'z' is not a whole number");
    expect("//SUBMODEL/4/0/V41\n", "line 1: cards of version 41 are not read");
    expect("//SUBMODEL/4\nx\n9000000000\n//SUBMODEL/9223372036854775807\n", "line 4: the id 9223372036854775807");
    std::string deep;
    for (int k = 0; k < 200; ++k)
        deep += "//SUBMODEL/4\nx\n\n";
    expect(deep, "submodels are nested 100 deep");
}

// ---- LS-DYNA ----

std::string dyna(const PlainDeck& deck)
{
    std::string text = "*NODE\n";
    for (const auto& [id, x] : deck.node)
        text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", id, x.x(), x.y(), x.z());
    text += "*ELEMENT_SHELL\n";
    for (const auto& [id, corner] : deck.shell)
        text += fmt::format("{}, {}, {}, {}, {}, {}\n", id, id % 2 + 1, corner[0], corner[1], corner[2], corner[3]);
    return text;
}

/// Some nodes of a grid, and the cards that name them.
struct NodeSet {
    std::string text;
    std::function<bool(const PlainDeck&, std::int64_t)> holds;
};

bool is_of_part(const PlainDeck& deck, std::int64_t node, int part)
{
    for (const auto& [id, corner] : deck.shell)
        if (id % 2 + 1 == part && std::find(corner.begin(), corner.end(), node) != corner.end())
            return true;
    return false;
}

std::vector<NodeSet> node_sets()
{
    const auto is_in = [](std::int64_t low, std::int64_t high) {
        return [=](const PlainDeck&, std::int64_t id) { return id >= low && id <= high; };
    };
    return {{"*SET_NODE_LIST_TITLE\nsome\n3\n21,22,23,24\n",
             [](const auto&, std::int64_t id) { return id >= 21 && id <= 24; }},
            {"*SET_NODE\n3\n5,6,,7\n", is_in(5, 7)},
            {"*SET_NODE_LIST_GENERATE\n3\n1,9,41,60\n",
             [](const auto&, std::int64_t id) { return id <= 9 || (id >= 41 && id <= 60); }},
            {"*SET_NODE_LIST_GENERATE_INCREMENT\n3\n2,1000000000000,3\n",
             [](const auto&, std::int64_t id) { return id >= 2 && id % 3 == 2; }},
            {"*SET_NODE_GENERAL\n3\nPART,1\nDNODE,21,22\n",
             [](const PlainDeck& deck, std::int64_t id) { return is_of_part(deck, id, 1) && id != 21 && id != 22; }},
            {"*SET_NODE_GENERAL\n3\nALL\nDPART,2\n",
             [](const PlainDeck& deck, std::int64_t id) { return !is_of_part(deck, id, 2); }},
            {"*SET_NODE_LIST\n8\n5,6\n*SET_NODE_ADD\n3\n8,9\n*SET_NODE_LIST\n9\n7\n", is_in(5, 7)}};
}

TEST(NodeTransform, MovesTheNodesOfItsSet)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(200 + seed);
        const PlainDeck plate = some_grid(chance);
        const Eigen::Vector3d by = chance.vector(50), axis = chance.vector(1);
        const double degrees = chance.real(-180, 180);
        const std::string transformation =
            fmt::format("*DEFINE_TRANSFORMATION\n7\nTRANSL,{:.17g},{:.17g},{:.17g}\nROTATE,{:.17g},{:.17g},{:.17g},0,"
                        "0,0,{:.17g}\n",
                        by.x(), by.y(), by.z(), axis.x(), axis.y(), axis.z(), degrees);
        for (const NodeSet& set : node_sets()) {
            PlainDeck truth = plate;
            for (auto& [id, x] : truth.node)
                if (set.holds(plate, id))
                    x = turned(x + by, {0, 0, 0}, axis, degrees);
            const Deck later =
                sample::read("a.k", "*NODE_TRANSFORM\n7,3\n" + transformation + set.text + dyna(plate) + "*END\n");
            EXPECT_TRUE(later.doubts.empty()) << later.doubts.front() << set.text;
            expect_same(PlainDeck(later), truth);
            expect_same(PlainDeck(sample::read("a.k", transformation + set.text + dyna(plate) +
                                                          "*NODE_TRANSFORM\n7,3,1\n*END\n")),
                        truth);
        }
    }
}

TEST(NodeTransform, WhatIsNotReadIsADoubtWithItsLine)
{
    const PlainDeck plate = grid(1, 1, 1, 10, 1, [](int i, int j) { return Eigen::Vector3d(i, j, 0); });
    const std::string moved = "*DEFINE_TRANSFORMATION\n7\nTRANSL,1\n";
    const auto doubt = [&](const std::string& text) {
        const Deck deck = sample::read("a.k", text + dyna(plate));
        EXPECT_EQ(PlainDeck(deck).node.at(1), Eigen::Vector3d(0, 0, 0)) << "nothing is moved";
        return deck.doubts.empty() ? std::string() : deck.doubts.front();
    };
    EXPECT_NE(doubt("*NODE_TRANSFORM\n7,3\n" + moved).find("line 2: *NODE_TRANSFORM is not read: the *SET_NODE 3"),
              std::string::npos);
    EXPECT_NE(doubt("*SET_NODE\n3\n1\n*NODE_TRANSFORM\n7,3\n").find("the *DEFINE_TRANSFORMATION 7"), std::string::npos);
    EXPECT_NE(doubt(moved + "*SET_NODE_GENERAL\n3\nBOX,1\n*NODE_TRANSFORM\n7,3\n").find("*SET_NODE 3"),
              std::string::npos);
    EXPECT_NE(doubt(moved + "*SET_NODE_COLUMN\n3\n1\n*NODE_TRANSFORM\n7,3\n").find("*SET_NODE 3"), std::string::npos);
    EXPECT_NE(refusal("a.k", "*NODE_TRANSFORM\nx,3\n").find("line 2: 'x' is not a whole number"), std::string::npos);
}

} // namespace
} // namespace spia::submodel_test

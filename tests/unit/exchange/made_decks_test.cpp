// Abaqus decks whose nodes and elements are made by keywords, against the same parts written
// plainly.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/unit/exchange/plain_deck.h"
#include "tests/unit/exchange/sample_decks.h"

namespace spia::made_decks_test {
namespace {

using sample::Chance;
using sample::expect_same;
using sample::grid;
using sample::PlainDeck;
using sample::refusal;
using sample::turned;

constexpr unsigned family = 30; ///< decks per test

Deck read(const std::string& text) { return sample::read("a.inp", text); }
PlainDeck plain(const std::string& text) { return PlainDeck(read(text)); }

std::string place(const Eigen::Vector3d& x) { return fmt::format("{:.17g},{:.17g},{:.17g}", x.x(), x.y(), x.z()); }
std::string node(std::int64_t id, const Eigen::Vector3d& x) { return fmt::format("{},{}\n", id, place(x)); }

/// A plate between four corners: its nodes lie on straight lines between two straight edges.
struct Plate {
    int columns, rows;
    std::int64_t first, row;
    std::array<Eigen::Vector3d, 4> corner;

    explicit Plate(Chance& chance)
        : columns(chance.whole(1, 9)), rows(chance.whole(1, 9)), first(chance.whole(1, 500)),
          row(columns + chance.whole(1, 90))
    {
        for (Eigen::Vector3d& x : corner)
            x = chance.vector(300);
    }
    PlainDeck by(const std::function<double(int)>& part_of_line) const
    {
        return grid(columns, rows, first, row, 7, [&](int i, int j) {
            const double s = double(i) / columns, t = part_of_line(j);
            return Eigen::Vector3d((1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
                                   t * ((1 - s) * corner[2] + s * corner[3]));
        });
    }
    std::string edges() const
    {
        const std::int64_t top = first + row * rows;
        return "*NODE\n" + node(first, corner[0]) + node(first + columns, corner[1]) + node(top, corner[2]) +
               node(top + columns, corner[3]) +
               fmt::format("*NGEN, NSET=Low\n{}, {}\n*NGEN, nset=HIGH\n{}, {}, 1\n", first, first + columns, top,
                           top + columns);
    }
    std::string shells() const
    {
        return fmt::format("*ELEMENT, TYPE=S4R\n7, {}, {}, {}, {}\n*ELGEN, ELSET=All\n7, {}, 1, 1, {}, {}, {}\n", first,
                           first + 1, first + row + 1, first + row, columns, rows, row, columns);
    }
};

TEST(MadeDecks, APlateBetweenItsEdgesIsThatOfItsPlainDeck)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(seed);
        const Plate plate(chance);
        const Deck deck = read(plate.edges() + fmt::format("*NFILL\nLow, High, {}, {}\n", plate.rows, plate.row) +
                               plate.shells() + "*SHELL SECTION, ELSET=ALL\n.75\n");
        EXPECT_TRUE(deck.doubts.empty());
        EXPECT_FALSE(deck.copies) << "nodes of neighbours are the same";
        EXPECT_EQ(deck.parts[size_t(deck.part_of.back())].thickness, 0.75) << "the set has what was made";
        expect_same(PlainDeck(deck), plate.by([&](int j) { return double(j) / plate.rows; }));
    }
}

TEST(MadeDecks, BiasIsTheRatioOfNeighbouringIntervals)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(100 + seed);
        const Plate plate(chance);
        const double bias = chance.real(0.5, 1.8);
        const auto part = [&](int j) { // a geometric row, each length 1 / bias of the one before
            const double q = 1 / bias;
            return (1 - std::pow(q, j)) / (1 - std::pow(q, plate.rows));
        };
        expect_same(plain(plate.edges() +
                          fmt::format("*NFILL, BIAS={:.17g}\nLOW, HIGH, {}, {}\n", bias, plate.rows, plate.row) +
                          plate.shells()),
                    plate.by(part));
        const auto two_step = [&](int j) {
            const double q = 1 / bias, pairs = double(plate.rows) / 2;
            const double full = std::floor(j / 2.), rest = (j % 2) * 0.5 * std::pow(q, full);
            return ((1 - std::pow(q, full)) / (1 - q) + rest) * (1 - q) / (1 - std::pow(q, pairs));
        };
        if (plate.rows % 2 == 0)
            expect_same(
                plain(plate.edges() +
                      fmt::format("*NFILL, TWO STEP, BIAS={:.17g}\nLOW, HIGH, {}, {}\n", bias, plate.rows, plate.row) +
                      plate.shells()),
                plate.by(two_step));
    }
}

TEST(MadeDecks, UnsortedSetsArePairedInTheirOrder)
{
    const std::string nodes = "*NODE\n10,0,0\n20,1,0\n30,2,0\n110,9,5\n120,8,5\n130,7,5\n";
    const auto filled = [&](const std::string& set) {
        const Deck deck = read(nodes + "*NSET, NSET=A\n10,20,30\n*NSET, NSET=B" + set +
                               "\n130,120,110\n*NFILL\nA, B, 2, 5\n*ELEMENT, TYPE=S3\n1,10,20,120\n");
        return PlainDeck(deck).node.at(15);
    };
    EXPECT_EQ(filled(", UNSORTED"), Eigen::Vector3d(3.5, 2.5, 0)) << "between 10 and 130";
    EXPECT_EQ(filled(""), Eigen::Vector3d(4.5, 2.5, 0)) << "between 10 and 110";
}

/// A strip along an arc that is seen from the end of its normal.
TEST(MadeDecks, NodesOnArcsAreThoseOfTheCircle)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(200 + seed);
        const int columns = chance.whole(3, 20);
        const double radius = chance.real(1, 100), width = chance.real(1, 50);
        const bool is_long = seed % 3 == 0, is_whole = seed % 6 == 0;
        const double degrees = is_whole ? 360 : is_long ? chance.real(181, 359) : chance.real(5, 175);
        const Eigen::Vector3d centre = chance.vector(100), normal = chance.vector(1).normalized();
        const Eigen::Vector3d start = centre + radius * normal.unitOrthogonal();
        const PlainDeck truth = grid(columns, 1, 1, 1000, 1, [&](int i, int j) {
            return Eigen::Vector3d(turned(start, centre, centre + normal, degrees * i / columns) + j * width * normal);
        });
        std::string text = "*NODE, NSET=Ends\n" + node(1, truth.node.at(1)) +
                           node(1 + columns, truth.node.at(1 + columns)) + "*NODE\n" + node(999, centre) +
                           "*NGEN, LINE=C, NSET=Arc\n";
        const std::string turn = is_long ? "," + place(normal) : "";
        text += seed % 2 ? fmt::format("1,{},1,999,,,{}\n", 1 + columns, turn)
                         : fmt::format("1,{},1,,{}{}\n", 1 + columns, place(centre), turn);
        text += "*NCOPY, CHANGE NUMBER=1000, OLD SET=Arc, SHIFT\n" + place(width * normal) +
                "\n*ELEMENT, TYPE=S4\n1,1,2,1002,1001\n" + fmt::format("*ELGEN\n1,{}\n", columns);
        PlainDeck made = plain(text);
        made.node.erase(999);
        expect_same(made, truth);
    }
}

TEST(MadeDecks, NodesStandInTheirCoordinates)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(300 + seed);
        const double r = chance.real(1, 100), a = chance.real(-400, 400), b = chance.real(-90, 90);
        const auto third = [&](const std::string& system) {
            return plain("*NODE\n1,0,0,0\n2,1,0,0\n*NODE, SYSTEM=" + system + "\n3," + place({r, a, b}) +
                         "\n*ELEMENT, TYPE=S3\n1,1,2,3\n")
                .node.at(3);
        };
        const double pi = std::numbers::pi;
        EXPECT_LT((third("C") - Eigen::Vector3d(r * std::cos(a * pi / 180), r * std::sin(a * pi / 180), b)).norm(),
                  1e-9);
        const Eigen::Vector3d sphere = third("s");
        EXPECT_NEAR(sphere.norm(), r, 1e-9);
        EXPECT_NEAR(sphere.z(), r * std::sin(b * pi / 180), 1e-9) << "the third is the angle above the plane";
        EXPECT_NEAR(std::remainder(std::atan2(sphere.y(), sphere.x()) * 180 / pi - a, 360), 0, 1e-9);
    }
    EXPECT_FALSE(read("*NODE, SYSTEM=S\n1,1,0,0\n2,1,9,0\n3,1,0,9\n*ELEMENT, TYPE=S3\n1,1,2,3\n").doubts.empty());
}

struct Way {
    std::string keyword, lines;
    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> move;
};

std::vector<Way> ways(Chance& chance)
{
    const Eigen::Vector3d by = chance.vector(50), a = chance.vector(50), b = a + chance.vector(50),
                          c = a + chance.vector(50);
    const double degrees = chance.real(-200, 200);
    const int times = chance.whole(2, 5);
    const std::string axis = place(a) + "," + place(b);
    const auto in_plane = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
        return x - 2 * n.dot(x - a) * n;
    };
    const auto over_line = [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const Eigen::Vector3d k = (b - a).normalized();
        return 2 * (a + k * k.dot(x - a)) - x;
    };
    return {
        {"SHIFT", place(by) + "\n", [=](const auto& x) { return Eigen::Vector3d(x + by); }},
        {"SHIFT", place(by) + fmt::format("\n{},{:.17g}\n", axis, degrees),
         [=](const auto& x) { return turned(x + by, a, b, degrees); }},
        {fmt::format("SHIFT, MULTIPLE={}", times), place(by) + fmt::format("\n{},{:.17g}\n", axis, degrees),
         [=](const auto& x) { return turned(x + by, a, b, times * degrees); }},
        {"REFLECT=MIRROR", axis + "\n" + place(c) + "\n", in_plane},
        {"REFLECT=LINE", axis + "\n", over_line},
        {"REFLECT=POINT", place(a) + "\n", [=](const auto& x) { return Eigen::Vector3d(2 * a - x); }},
        {"POLE", "," + place(a) + "\n", [=](const auto& x) { return Eigen::Vector3d(2 * x - a); }},
        {"POLE", "", {}}, // by the number of the first node
    };
}

TEST(MadeDecks, CopiesAreTheMovedOriginals)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(400 + seed);
        const Plate plate(chance);
        const PlainDeck original = plate.by([&](int j) { return double(j) / plate.rows; });
        for (const Way& way : ways(chance))
            for (const bool turn_over : {false, true}) {
                const std::int64_t nodes = 5000, shells = chance.whole(1000, 2000);
                PlainDeck truth = original;
                const Eigen::Vector3d pole = original.node.begin()->second;
                for (const auto& [id, x] : original.node)
                    truth.node[id + nodes] = way.move ? way.move(x) : Eigen::Vector3d(2 * x - pole);
                for (const auto& [id, corner] : original.shell) {
                    std::vector<std::int64_t> made = corner;
                    for (std::int64_t& each : made)
                        each += nodes;
                    if (turn_over)
                        std::reverse(made.begin() + 1, made.end());
                    truth.shell[id + shells] = made;
                }
                std::string text = original.abaqus();
                text += fmt::format("*NSET, NSET=All, GENERATE\n1,100000,1\n*NCOPY, CHANGE NUMBER={}, OLD SET=ALL, "
                                    "NEW SET=Copy, {}\n{}",
                                    nodes, way.keyword,
                                    way.move ? way.lines : fmt::format("{}\n", original.node.begin()->first));
                text += "*ELSET, ELSET=Old, GENERATE\n1,100000\n" +
                        fmt::format("*ELCOPY, ELEMENT SHIFT={}, OLD SET=old, SHIFT NODES={}{}\n", shells, nodes,
                                    turn_over ? ", REFLECT" : "");
                const Deck deck = read(text);
                EXPECT_TRUE(deck.copies);
                expect_same(PlainDeck(deck), truth);
            }
    }
}

TEST(MadeDecks, ACopyMayTakeTheNumberOfAnOriginal)
{
    const PlainDeck deck =
        plain("*NODE, NSET=A\n1,1,0\n2,2,0\n3,3,5,0\n*NCOPY, CHANGE NUMBER=1, OLD SET=A, SHIFT\n0,0,9\n"
              "*ELEMENT, TYPE=S3\n1,2,3,4\n");
    EXPECT_EQ(deck.node.at(2), Eigen::Vector3d(1, 0, 9)) << "the last place that a node is given holds";
    EXPECT_EQ(deck.node.at(3), Eigen::Vector3d(2, 0, 9)) << "from where the second node was";
    EXPECT_EQ(deck.node.at(4), Eigen::Vector3d(3, 5, 9));
}

TEST(MadeDecks, LayersOfShellsAreMadeFromOne)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(500 + seed);
        const std::array<int, 3> count = {chance.whole(1, 4), chance.whole(1, 4), chance.whole(1, 4)};
        PlainDeck truth;
        std::string text = "*NODE\n";
        for (int k = 0; k < 6; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 6; ++i) {
                    truth.node[1 + i + 10 * j + 100 * k] = Eigen::Vector3d(i, j, k);
                    text += node(1 + i + 10 * j + 100 * k, Eigen::Vector3d(i, j, k));
                }
        for (int k = 0; k < count[2]; ++k)
            for (int j = 0; j < count[1]; ++j)
                for (int i = 0; i < count[0]; ++i) {
                    const std::int64_t n = 1 + i + 10 * j + 100 * k;
                    truth.shell[1 + 2 * i + 20 * j + 300 * k] = {n, n + 1, n + 11};
                }
        expect_same(plain(text + fmt::format("*ELEMENT, TYPE=S3R\n1,1,2,12\n*ELGEN\n1,{},1,2,{},10,20,{},100,300\n",
                                             count[0], count[1], count[2])),
                    truth);
    }
}

TEST(MadeDecks, APartIsThereOnceForEachOfItsInstances)
{
    for (unsigned seed = 0; seed < family; ++seed) {
        Chance chance(600 + seed);
        const Plate plate(chance);
        const PlainDeck part = plate.by([&](int j) { return double(j) / plate.rows; });
        const int instances = chance.whole(1, 4);
        std::string text = "*PART, NAME=Wing\n" + part.abaqus() +
                           "*ELSET, ELSET=Skin, GENERATE\n1,1000\n*SHELL SECTION, ELSET=Skin, MATERIAL=M\n1.5\n"
                           "*END PART\n*PART, NAME=Spare\n*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=S3\n1,1,2,3\n"
                           "*END PART\n*ASSEMBLY, NAME=A\n";
        std::vector<std::vector<Eigen::Vector3d>> truth;
        for (int k = 0; k < instances; ++k) {
            const Eigen::Vector3d by = k == 2 ? Eigen::Vector3d(0, 0, 0) : chance.vector(100), a = chance.vector(100),
                                  b = a + chance.vector(10);
            const double degrees = k == 1 ? 0 : chance.real(-180, 180);
            text += fmt::format("*INSTANCE, NAME=Wing-{}, PART=WING\n", k + 1);
            if (k != 2)
                text += place(by) + "\n";
            if (k != 1)
                text += fmt::format("{},{},{:.17g}\n", place(a), place(b), degrees);
            text += "*END INSTANCE\n";
            truth.emplace_back();
            for (const auto& [id, x] : part.node)
                truth.back().push_back(turned(x + by, a, b, degrees));
        }
        const Deck deck = read(text + "*END ASSEMBLY\n");
        EXPECT_TRUE(deck.doubts.empty());
        ASSERT_EQ(deck.elements(), instances * int(part.shell.size())) << "without the spare part";
        EXPECT_TRUE(sample::has_note(deck, "1 part has no instance"));
        EXPECT_EQ(deck.copies, instances > 1);
        int e = 0;
        for (int k = 0; k < instances; ++k)
            for (const auto& [id, corners] : part.shell) {
                EXPECT_EQ(deck.element[size_t(e)], id);
                const DeckPart& of = deck.parts[size_t(deck.part_of[size_t(e)])];
                EXPECT_EQ(of.name, k == 0 ? "Skin" : fmt::format("Wing-{}.Skin", k + 1));
                EXPECT_EQ(of.thickness, 1.5);
                for (size_t c = 0; c < corners.size(); ++c) {
                    const auto at = std::distance(part.node.begin(), part.node.find(corners[c]));
                    const Eigen::Vector3d x = truth[size_t(k)][size_t(at)];
                    EXPECT_LT((deck.position[size_t(deck.corner[size_t(e)][c])] - x).norm(), 1e-9 * (1 + x.norm()));
                }
                ++e;
            }
        size_t of_sets = 0;
        for (const DeckSet& set : deck.sets)
            of_sets += set.elements.size();
        EXPECT_EQ(of_sets, size_t(deck.elements()));
    }
}

TEST(MadeDecks, WhatCannotBeReadIsADoubtWithItsKeyword)
{
    const std::string deck =
        "*NODE\n1,0,0\n2,1,0\n3,0,1\n*NSET,NSET=A\n1\n*NSET,NSET=B\n3\n*ELEMENT,TYPE=S3,ELSET=E\n1,1,2,3\n";
    const auto doubt = [&](const std::string& text) {
        std::string all;
        for (const std::string& each : read(deck + text).doubts)
            all += each + "\n";
        return all;
    };
    EXPECT_EQ(doubt(""), "");
    EXPECT_NE(doubt("*NMAP, NSET=A\n").find("*NMAP"), std::string::npos);
    EXPECT_NE(doubt("*NGEN, LINE=P\n1,3,1,2\n").find("line 11: *NGEN, LINE=P"), std::string::npos);
    EXPECT_NE(doubt("*NFILL, SINGULAR=1\nA,B,2,1\n").find("*NFILL, SINGULAR"), std::string::npos);
    EXPECT_NE(doubt("*SYSTEM\n1,1,1\n*NCOPY, CHANGE NUMBER=9, OLD SET=A, SHIFT\n1,1,1\n").find("*NCOPY"),
              std::string::npos);
    EXPECT_NE(doubt("*NSET,NSET=C,ELSET=E\n*NFILL\nA,C,2,1\n").find("*NFILL"), std::string::npos);
    EXPECT_NE(doubt("*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n").find("1 instance is of parts"), std::string::npos);
    EXPECT_NE(doubt("*INSTANCE, LIBRARY=old, INSTANCE=I\n*END INSTANCE\n").find("*INSTANCE, LIBRARY"),
              std::string::npos);
}

TEST(MadeDecks, DamagedKeywordsAreRefusedWithTheirLine)
{
    const std::string deck =
        "*NODE\n1,0,0\n2,1,0\n3,0,1\n10,9,0\n*NSET,NSET=A\n1,2\n*NSET,NSET=B\n3,77\n*ELEMENT,TYPE=S3,ELSET=E\n1,1,2,3\n";
    const auto expect = [&](const std::string& text, const std::string& words) {
        const std::string said = refusal("a.inp", deck + text);
        EXPECT_NE(said.find(words), std::string::npos) << words << "\nin: " << said;
    };
    expect("*NGEN\n1,10,2\n", "line 13: *NGEN: steps of 2 do not lead from node 1 to node 10");
    expect("*NGEN\n1,10,0\n", "line 13: *NGEN: steps of 0");
    expect("*NGEN\n10,1,1\n", "line 13: *NGEN: steps of 1");
    expect("*NGEN\n1,8\n", "line 13: node 8 is not there");
    expect("*NGEN\n1,9000000000000000000\n", "line 13: the number 9000000000000000000 is beyond 999999999");
    expect("*NODE\n900000000,1,1\n*NGEN\n1,900000000\n", "line 15: *NGEN makes 899999998 nodes or shells");
    expect("*NGEN, LINE=C\n1,3,1,,5,0\n", "line 13: *NGEN: nodes 1 and 3 are at different distances");
    expect("*NGEN, LINE=C\n1,10,1,,4.5,0\n", "line 13: *NGEN: an arc of 180 degrees or more needs its normal");
    expect("*NGEN, LINE=C\n1,10,1,,4.5,0,0,1,0,0\n", "line 13: *NGEN: the ends of the arc do not lie in the plane");
    expect("*NFILL\nA,X,2,1\n", "line 13: *NFILL: there is no node set X");
    expect("*NFILL\nA,B,2,1\n", "line 13: *NFILL: node 77 of the node set B is not there");
    expect("*NFILL\nA,A,0,1\n", "line 13: *NFILL: 0 intervals");
    expect("*NFILL\nA,A,900000000,1\n", "line 13: *NFILL makes 1799999998 nodes or shells");
    expect("*NFILL, BIAS=-1\nA,A,2,1\n", "line 12: *NFILL: the BIAS is -1");
    expect("*NFILL, BIAS=1e-9\nA,A,200,1\n", "line 13: *NFILL: the BIAS 1e-09 is too far from 1");
    expect("*NCOPY, OLD SET=A, SHIFT\n1,1,1\n", "line 12: a number is missing");
    expect("*NCOPY, CHANGE NUMBER=999999999, OLD SET=A, SHIFT\n1,1,1\n", "line 12: the number 1 with 999999999 added");
    expect("*NCOPY, CHANGE NUMBER=9, OLD SET=A\n1,1,1\n", "line 12: *NCOPY says neither SHIFT");
    expect("*NCOPY, CHANGE NUMBER=9, OLD SET=A, REFLECT=MIRROR\n0,0,0,1,1,1\n2,2,2\n",
           "line 12: *NCOPY: the points lie");
    expect("*NCOPY, CHANGE NUMBER=9, OLD SET=A, REFLECT=LINE\n0,0,0\n*HEADING\n",
           "line 12: *NCOPY: 2 points are needed");
    expect("*NCOPY, CHANGE NUMBER=9, OLD SET=A, SHIFT\n1,x,1\n", "line 13: 'x' is not a number");
    expect("*ELGEN\n5,2\n", "line 13: *ELGEN: element 5 is not there");
    expect("*ELGEN\n1,900000000\n", "line 13: *ELGEN makes 899999999 nodes or shells");
    expect("*ELGEN\n1,900000000,1,1,900000000,1,1,900000000,1,1\n", "line 13: *ELGEN makes ");
    expect("*ELGEN\n1,2,-5\n", "line 13: the number 1 with -5 added");
    expect("*ELGEN\n1,2,1,1,2\n", "line 13: a number is missing");
    expect("*ELCOPY, ELEMENT SHIFT=1, SHIFT NODES=1, OLD SET=X\n", "line 12: *ELCOPY: there is no element set X");
    expect("*ELCOPY, ELEMENT SHIFT=1, OLD SET=E\n", "line 12: a number is missing");
    std::string twice = "*NSET,NSET=S0\n1,2\n";
    for (int k = 0; k < 60; ++k)
        twice += fmt::format("*NSET,NSET=S{}\nS{},S{}\n", k + 1, k, k);
    expect(twice, "and others name too many nodes");
    std::string poles = "*NCOPY, CHANGE NUMBER=1, OLD SET=A, POLE, NEW SET=N0\n,1,1,1\n";
    for (int k = 0; k < 200; ++k)
        poles += fmt::format("*NCOPY, CHANGE NUMBER=2, OLD SET=N{}, POLE, NEW SET=N{}\n,9,9,9\n", k, k + 1);
    expect(poles, "is not a usable number");
}

TEST(MadeDecks, InstancesWithoutEndAreRefused)
{
    std::string nodes = "*PART,NAME=P\n*NODE\n";
    for (int k = 1; k <= 3000; ++k)
        nodes += fmt::format("{},{},{}\n", k, k % 50, k / 50);
    nodes += "*ELEMENT,TYPE=S3\n1,1,2,51\n*END PART\n*ASSEMBLY,NAME=A\n";
    for (int k = 0; k < 5000; ++k)
        nodes += fmt::format("*INSTANCE,NAME=I{},PART=P\n{},0,0\n*END INSTANCE\n", k, k);
    EXPECT_NE(refusal("a.inp", nodes).find("*INSTANCE makes 3001 nodes or shells"), std::string::npos)
        << refusal("a.inp", nodes);
}

} // namespace
} // namespace spia::made_decks_test

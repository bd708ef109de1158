// Decks whose geometry is moved, copied or made by keywords.
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::moved_decks_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct MovedDecks : testing::Test {
    ScratchFolder folder;

    fs::path put(const char* name, const std::string& text)
    {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    /// Two squares of 10 mm beside each other in x, as they stand in an LS-DYNA deck.
    static std::string squares()
    {
        std::string text = "*NODE\n";
        for (int k = 0; k < 6; ++k)
            text += fmt::format("{:8}{:16}{:16}{:16}\n", k + 1, 10 * (k % 3), 10 * (k / 3), 0);
        return text + fmt::format("*ELEMENT_SHELL\n{:8}{:8}{:8}{:8}{:8}{:8}\n{:8}{:8}{:8}{:8}{:8}{:8}\n", 1, 1, 1, 2, 5,
                                  4, 2, 1, 2, 3, 6, 5);
    }
    static std::string head()
    {
        return "*KEYWORD\n*PART\nsheet\n         1         1         1\n*SECTION_SHELL\n         1         2\n"
               "       1.5\n*MAT_ELASTIC\n         1\n";
    }
    static std::string transformation(const std::string& steps)
    {
        return "*DEFINE_TRANSFORMATION\n         7\n" + steps;
    }
    /// Cards behind the name; nothing is offset but nodes and elements.
    static std::string include_transform(const std::string& file, double length = 0, int transformation = 7,
                                         int part = 0)
    {
        return fmt::format("*INCLUDE_TRANSFORM\n{}\n{:10}{:10}{:10}\n\n{:10}{:10}{:10}\n{:10}\n", file, 1000, 1000,
                           part, 0, 0, length, transformation);
    }
    static std::string card(const std::string& option, const std::vector<double>& values)
    {
        std::string text = fmt::format("{:10}", option);
        for (const double value : values)
            text += fmt::format("{:10}", value);
        return text + "\n";
    }
    static Eigen::Vector3d size(const PartFile& part)
    {
        return part.mesh.position.rowwise().maxCoeff() - part.mesh.position.rowwise().minCoeff();
    }
    /// The squares, and once more by a transformation.
    PartFile with_copy(const std::string& steps, double length = 0)
    {
        put("copy.k", squares());
        return examine_part(
            put("main.k", head() + transformation(steps) + include_transform("copy.k", length) + squares() + "*END\n"),
            {});
    }
};

} // namespace

TEST_F(MovedDecks, AMirroredHalfMakesThePartWhole)
{
    const PartFile part = with_copy(card("MIRROR", {0, 0, 0, 0, -1, 0, 0}));
    EXPECT_TRUE(part.doubts.empty());
    EXPECT_EQ(part.doctor.components, 1) << "the common edge is joined";
    EXPECT_NEAR(area(part.mesh), 400, 1e-9);
    EXPECT_TRUE(size(part).isApprox(Eigen::Vector3d(20, 20, 0)));
}

TEST_F(MovedDecks, EveryStepOfATransformationDoesWhatTheManualSays)
{
    const auto size_of = [&](const std::string& steps, double length = 0) { return size(with_copy(steps, length)); };
    EXPECT_TRUE(size_of(card("TRANSL", {20, 0, 0})).isApprox(Eigen::Vector3d(40, 10, 0)));
    EXPECT_TRUE(size_of(card("SCALE", {1, -2, 1})).isApprox(Eigen::Vector3d(20, 30, 0)));
    EXPECT_TRUE(size_of(card("ROTATE", {1, 0, 0, 0, 0, 0, 90})).isApprox(Eigen::Vector3d(20, 10, 10)));
    EXPECT_TRUE(size_of(card("POINT", {1, 0, 0, 0}) + card("POINT", {2, 5, 0, 0}) + card("ROTATE", {1, 2, 90}))
                    .isApprox(Eigen::Vector3d(20, 10, 10)));
    std::string points;
    const std::vector<Eigen::Vector3d> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    for (size_t k = 0; k < p.size(); ++k)
        points += card("POINT", {double(k + 1), p[k].x(), p[k].y(), p[k].z()});
    EXPECT_TRUE(size_of(points + card("POS6P", {1, 2, 3, 4, 5, 6})).isApprox(Eigen::Vector3d(20, 20, 20)));
    // one after the other
    EXPECT_TRUE(size_of(card("TRANSL", {0, 5, 0}) + card("SCALE", {1, -2, 1})).isApprox(Eigen::Vector3d(20, 40, 0)));
    EXPECT_TRUE(size_of(card("TRANSL", {0, 0, 0}), 2).isApprox(Eigen::Vector3d(40, 20, 0))) << "factor of lengths";
}

TEST_F(MovedDecks, AFileIncludedTwiceIsThereTwice)
{
    put("copy.k", squares());
    const auto turn = [&](int id, double degrees) {
        return fmt::format("*DEFINE_TRANSFORMATION\n{:10}\n", id) + card("ROTATE", {1, 0, 0, 0, 0, 0, degrees});
    };
    std::string second = include_transform("copy.k", 0, 8);
    second.replace(second.find("1000"), 4, "2000");
    const PartFile part = examine_part(
        put("main.k", head() + turn(7, 90) + turn(8, 180) + include_transform("copy.k") + second + "*END\n"), {});
    EXPECT_NEAR(area(part.mesh), 400, 1e-9);
    EXPECT_TRUE(size(part).isApprox(Eigen::Vector3d(20, 10, 10))) << size(part).transpose();
}

TEST_F(MovedDecks, WhatIsNotReadIsADoubtWithItsKeyword)
{
    const auto doubts = [&](const std::string& name, const std::string& text) {
        std::string all;
        for (const std::string& doubt : examine_part(put(name.c_str(), text), {}).doubts)
            all += doubt + "\n";
        return all;
    };
    EXPECT_THAT(doubts("a.k", head() + squares() + "*NODE_TRANSFORM\n         1         1\n*END\n"),
                HasSubstr("*NODE_TRANSFORM"));
    EXPECT_THAT(doubts("b.k", head() + squares() + "*ELEMENT_SHELL_NURBS_PATCH\n*END\n"), HasSubstr("NURBS_PATCH"));
    put("copy.k", squares());
    EXPECT_THAT(doubts("c.k", head() + squares() + transformation(card("ROTATE3NA", {1, 2, 3})) +
                                  include_transform("copy.k") + "*END\n"),
                HasSubstr("copy.k is not moved"));
    const std::string inp = "*NODE\n1, 0., 0., 0.\n2, 10., 0., 0.\n3, 0., 10., 0.\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n";
    EXPECT_THAT(doubts("a.inp", inp + "*NMAP, NSET=A\n0,0,0\n"), HasSubstr("*NMAP"));
    EXPECT_EQ(doubts("b.inp", inp), "");
}

TEST_F(MovedDecks, RadiossMovesGroupsOfNodes)
{
    const auto deck = [&](const std::string& transform) {
        std::string text =
            "#RADIOSS STARTER\n/BEGIN\nsheet\n      2020         0\n                  kg                  mm"
            "                  ms\n                  kg                  mm                  ms\n/NODE\n";
        for (int k = 0; k < 6; ++k)
            text += fmt::format("{:10}{:20}{:20}{:20}\n", k + 1, 10 * (k % 3), 10 * (k / 3), 0);
        text += fmt::format("/SHELL/1\n{:10}{:10}{:10}{:10}{:10}\n{:10}{:10}{:10}{:10}{:10}\n", 1, 1, 2, 5, 4, 2, 2, 3,
                            6, 5);
        text += "/GRNOD/NODE/5\nupper\n         4         5         6\n/GRNOD/PART/6\nall\n         1\n";
        return examine_part(put("part_0000.rad", text + transform + "/END\n"), {});
    };
    const auto line = [](int group, double x, double y, double z, const std::string& more = "") {
        return fmt::format("{:10}{:20}{:20}{:20}{}\n", group, x, y, z, more);
    };
    const PartFile stretched = deck("/TRANSFORM/TRA/1\nstretch\n" + line(5, 0, 20, 0));
    EXPECT_TRUE(stretched.doubts.empty());
    EXPECT_TRUE(size(stretched).isApprox(Eigen::Vector3d(20, 30, 0)));
    EXPECT_TRUE(size(deck("/TRANSFORM/SCA/1\nlarger\n" + line(6, 2, 3, 1))).isApprox(Eigen::Vector3d(40, 30, 0)));
    EXPECT_TRUE(size(deck("/TRANSFORM/ROT/1\nbent\n" + line(5, 0, 0, 0) + line(0, 1, 0, 0, fmt::format("{:20}", 90.0))))
                    .isApprox(Eigen::Vector3d(20, 0, 10)));
    EXPECT_TRUE(size(deck("/TRANSFORM/SYM/1\nover\n" + line(5, 0, 0, 0) + line(0, 0, 1, 0)))
                    .isApprox(Eigen::Vector3d(20, 10, 0)));
    EXPECT_FALSE(deck("/TRANSFORM/MATRIX/1\nany\n" + line(5, 1, 0, 0)).doubts.empty());
    EXPECT_FALSE(deck("//SUBMODEL/4\nother\n").doubts.empty());
}

TEST_F(MovedDecks, AHalfThatIsCopiedOverItsEdgeIsWhole)
{
    const std::string half = "*NODE, NSET=Half\n1, 0., 0., 0.\n2, 10., 0., 0.\n3, 0., 10., 0.\n4, 10., 10., 0.\n"
                             "*ELEMENT, TYPE=S4, ELSET=Half\n1, 1, 2, 4, 3\n";
    const PartFile copied =
        examine_part(put("copied.inp", half + "*NCOPY, CHANGE NUMBER=10, OLD SET=Half, REFLECT=MIRROR\n"
                                              "10., 0., 0., 10., 1., 0.\n10., 0., 1.\n"
                                              "*ELCOPY, OLD SET=Half, ELEMENT SHIFT=10, SHIFT "
                                              "NODES=10, REFLECT\n"),
                     {});
    const PartFile twice =
        examine_part(put("twice.inp", "*PART, NAME=P\n" + half +
                                          "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
                                          "*INSTANCE, NAME=J, PART=P\n10., 0., 0.\n*END INSTANCE\n*END ASSEMBLY\n"),
                     {});
    for (const PartFile* part : {&copied, &twice}) {
        EXPECT_TRUE(part->doubts.empty());
        EXPECT_EQ(part->doctor.components, 1) << "the common edge is joined";
        EXPECT_NEAR(area(part->mesh), 200, 1e-9);
        EXPECT_TRUE(size(*part).isApprox(Eigen::Vector3d(20, 10, 0)));
    }
}

TEST_F(MovedDecks, TheCasesOfUsersAreWhole)
{
    const fs::path cases = fs::path(SPIA_SOURCE_DIR) / "../shared/cases";
    if (!fs::exists(cases))
        GTEST_SKIP() << cases << " is not there";
    for (const char* name : {"13-main.k", "13-transform.rad"}) {
        const PartFile part = read_part(cases / name);
        EXPECT_TRUE(part.doubts.empty()) << name;
        EXPECT_NEAR(size(part).y(), 40, 1e-9) << name;
        EXPECT_EQ(part.doctor.components, 1) << name;
    }
}

} // namespace spia::moved_decks_test

#include "engine/pipeline/files/deform_file.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/joined_patches.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::deform_file_test {
namespace {

std::string refusal(const std::string& text)
{
    const ScratchFolder folder;
    put(folder / "d.json", text);
    try {
        read_deformation(folder / "d.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string with(const std::string& members) { return R"({"schema": "spia.deformation/1", )" + members + "}"; }

} // namespace

TEST(DeformFile, ComesBackAsItWasWritten)
{
    const MultiPatch surface = patches::samples()[1].patches;
    Deformation deformation;
    deformation.moves = {{0, 1, 2, {0.1, -3, 1e-7}}, {1, 3, 0, {1. / 3, 0, 5}}};
    deformation.lattice = lattice_around(surface, {5, 2, 4}, {2, 1, 3});
    deformation.lattice->move.col(7) << 0.1, 0.2, 1. / 7;
    const ScratchFolder folder;
    write_deformation(folder / "d.json", deformation);
    EXPECT_EQ(deformation_of(read_deformation(folder / "d.json"), surface), deformation);
}

TEST(DeformFile, WithoutABoxTheLatticeIsLaidAroundTheSurface)
{
    const ScratchFolder folder;
    put(folder / "d.json", with(R"("lattice": {"count": [3, 3, 2], "moves": [{"at": [2, 1, 0], "by": [1, 2, 3]}]})"));
    const MultiPatch surface = patches::samples()[0].patches;
    Lattice expected = lattice_around(surface, {3, 3, 2});
    expected.move.col(expected.index(2, 1, 0)) << 1, 2, 3;
    EXPECT_EQ(deformation_of(read_deformation(folder / "d.json"), surface), (Deformation{{}, expected}));
    EXPECT_EQ(expected.degree, (std::array{2, 2, 1})) << "as many as the points allow";
}

TEST(DeformFile, WhatIsWrongIsNamedWithItsPlace)
{
    const auto has = [](const std::string& text, const char* what) {
        const std::string said = refusal(text);
        return said.find(what) != std::string::npos ? testing::AssertionSuccess()
                                                    : testing::AssertionFailure() << text << ": " << said;
    };
    EXPECT_TRUE(has("{}", "/schema"));
    EXPECT_TRUE(has(with(R"("moves": [])"), "must have moves of control points or a lattice"));
    EXPECT_TRUE(has(with(R"("knots": [])"), "knots"));
    EXPECT_TRUE(has(with(R"("moves": [{"at": [1], "by": [0, 0, 1]}])"), "/moves/0/at"));
    EXPECT_TRUE(has(with(R"("moves": [{"at": [1, -1], "by": [0, 0, 1]}])"), "/moves/0/at/1"));
    EXPECT_TRUE(has(with(R"("moves": [{"at": [1, 1.5], "by": [0, 0, 1]}])"), "/moves/0/at/1"));
    EXPECT_TRUE(has(with(R"("moves": [{"at": [1, 1], "by": [0, 0]}])"), "/moves/0/by"));
    EXPECT_TRUE(has(with(R"("moves": [{"at": [1, 1]}])"), "by"));
    EXPECT_TRUE(has(with(R"("moves": [{"patch": 1e30, "at": [1, 1], "by": [0, 0, 1]}])"), "/moves/0/patch"));
    EXPECT_TRUE(has(with(R"("lattice": {"count": [1, 4, 4]})"), "/lattice/count/0"));
    EXPECT_TRUE(has(with(R"("lattice": {"count": [65, 4, 4]})"), "/lattice/count/0"));
    EXPECT_TRUE(has(with(R"("lattice": {"count": [4, 4, 4], "degree": [4, 3, 3]})"), "a degree from 1 to 3"));
    EXPECT_TRUE(has(with(R"("lattice": {"count": [4, 4, 4], "origin": [0, 0, 0]})"), "both \"origin\" and \"edges\""));
    EXPECT_TRUE(
        has(with(R"("lattice": {"count": [4, 4, 4], "origin": [0, 0, 0], "edges": [[1, 0, 0], [0, 1, 0], [1, 1, 0]]})"),
            "no volume"));
    EXPECT_TRUE(has(with(R"("lattice": {"count": [4, 4, 4], "moves": [{"at": [4, 0, 0], "by": [0, 0, 1]}]})"),
                    "/lattice/moves/0/at/0"));
    EXPECT_TRUE(has(
        with(
            R"("lattice": {"count": [4, 4, 4], "moves": [{"at": [3, 0, 0], "by": [0, 0, 1]}, {"at": [3, 0, 0], "by": [1, 0, 1]}]})"),
        "moved already"));
}

} // namespace spia::deform_file_test

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "tests/unit/exchange/sample_assembly.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_choice_test {
namespace {

namespace fs = std::filesystem;

/// Two assemblies and bodies in them; two bodies have one name, two differ by the case of letters.
CadTree small_tree()
{
    using Kind = CadItem::Kind;
    CadTree tree;
    tree.item = {{Kind::assembly, "Car", 0, -1, 6},      {Kind::assembly, "Front", 1, 0, 4},
                 {Kind::solid, "Clip", 0, 1, 2},         {Kind::sheet_body, "Clip", 1, 1, 2},
                 {Kind::solid, "hood", 2, 0, 1},         {Kind::solid, "Hood", 3, 0, 1},
                 {Kind::loose_faces, "body:0", 4, -1, 1}};
    tree.body_of = {2, 2, 3, 4, 3, 5, 6};
    return tree;
}

std::string refusal(const fs::path& file, const ReadOptions& options = {})
{
    try {
        read_part(file, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(CadChoice, TakesFacesBodiesAssembliesAndNames)
{
    const CadTree tree = small_tree();
    const auto chosen = [&](std::vector<std::string> wanted) { return chosen_faces(tree, wanted); };
    EXPECT_EQ(chosen({}), (std::vector{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(chosen({"2", "4-5"}), (std::vector{2, 4, 5}));
    EXPECT_EQ(chosen({"body:1"}), (std::vector{2, 4}));
    EXPECT_EQ(chosen({" BODY:1 ", "0"}), (std::vector{0, 2, 4}));
    EXPECT_EQ(chosen({"assembly:1"}), (std::vector{0, 1, 2, 4}));
    EXPECT_EQ(chosen({"car"}), (std::vector{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(chosen({"hood"}), std::vector{3});
    EXPECT_EQ(chosen({"Hood"}), std::vector{5});
    EXPECT_EQ(chosen({"body:0"}), (std::vector{0, 1})) << "a number is not taken for a name";
    for (const char* wrong :
         {"clip", "Clip", "HOOD", "body:5", "body:-1", "body:", "body", "assembly:2", "roof", "", "7", "3-2"})
        EXPECT_THROW(chosen({wrong}), InputError) << wrong;
    try {
        chosen({"Clip"});
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("2 things"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("body:3"), std::string::npos) << "the list: " << error.what();
    }
}

TEST(CadChoice, ATreeOfAHundredBodiesIsListedInPart)
{
    CadTree tree;
    for (int b = 0; b < 100; ++b) {
        tree.item.push_back({CadItem::Kind::solid, "", b, -1, 1});
        tree.body_of.push_back(b);
    }
    const std::string list = item_list(tree);
    EXPECT_NE(list.find("body:39 "), std::string::npos);
    EXPECT_EQ(list.find("body:40 "), std::string::npos);
    EXPECT_NE(list.find("60 more"), std::string::npos);
}

TEST(CadChoice, OneSolidOfAnAssemblyGivesItsSkin)
{
    const ScratchFolder folder;
    write_sample_assembly(folder / "car.step");
    const std::string all = refusal(folder / "car.step");
    for (const std::string& said :
         std::vector<std::string>{"body:0", "right", "Cover", "assembly:1", mention(option::part)})
        EXPECT_NE(all.find(said), std::string::npos) << all;
    ReadOptions options;
    for (const char* choice : {"right", "body:1", "6-11"}) {
        options.parts = {choice};
        const PartFile plate = read_part(folder / "car.step", options);
        ASSERT_TRUE(plate.solid) << choice;
        EXPECT_NEAR(*plate.thickness_mm, 1, 1e-6);
        EXPECT_NEAR(area(plate.mesh), 40 * 30, 1e-6);
        EXPECT_NEAR(plate.mesh.position.row(0).minCoeff(), 60, 1e-6) << "where it stands in the assembly";
        EXPECT_NEAR(plate.mesh.position.row(2).maxCoeff(), 100.5, 0.5 + 1e-6);
        EXPECT_EQ(plate.cad->tree.item.size(), 6u);
    }
    options.parts = {"Cover"};
    const PartFile cover = read_part(folder / "car.step", options);
    EXPECT_FALSE(cover.solid) << "a sheet, whatever else the file holds";
    EXPECT_NEAR(area(cover.mesh), 200, 1e-6);
    options.parts = {"Front"};
    const PartFile front = examine_part(folder / "car.step", options);
    EXPECT_EQ(front.doctor.components, 3);
    const Finding* several = front.doctor.find(Fault::several_components);
    ASSERT_TRUE(several);
    EXPECT_EQ(several->severity, Severity::fatal);
    EXPECT_NE(several->text.find("body:0; body:1; body:2"), std::string::npos) << several->text;
    EXPECT_NE(refusal(folder / "car.step", {.parts = {"Plate"}}), "")
        << "it is there twice, by the names of its places";
}

TEST(CadChoice, OneBodyOfAnIgesFileGivesItsSkin)
{
    const ScratchFolder folder;
    for (const bool solids : {true, false}) {
        write_sample_bodies(folder / "bodies.igs", solids);
        EXPECT_NE(refusal(folder / "bodies.igs").find("body:2"), std::string::npos);
        ReadOptions options;
        options.parts = {solids ? "box 2" : "body:1"};
        options.skin = Skin::outer; // loose faces do not say that they are a solid
        const PartFile part = read_part(folder / "bodies.igs", options);
        ASSERT_TRUE(part.solid);
        EXPECT_NEAR(area(part.mesh), 20 * 20, 1e-6);
    }
}

} // namespace spia::cad_choice_test

#include "engine/exchange/list_items.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "tests/unit/exchange/sample_assembly.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::list_items_test {
namespace {

namespace fs = std::filesystem;

/// Lowest and highest corner of the polygons of one CAD face.
std::pair<Eigen::Vector3d, Eigen::Vector3d> box_of(const PolygonSoup& soup, const std::vector<int>& face_of, int face)
{
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
    for (int p = 0; p < soup.polygons(); ++p)
        if (face_of[size_t(p)] == face)
            for (const int v : soup.polygon(p)) {
                low = low.cwiseMin(soup.position[size_t(v)]);
                high = high.cwiseMax(soup.position[size_t(v)]);
            }
    return {low, high};
}

} // namespace

TEST(ListItems, GivesTheTreeOfAnAssemblyWithNamesAndPlaces)
{
    const ScratchFolder folder;
    write_sample_assembly(folder / "car.step");
    const FileItems items = list_items(folder / "car.step");
    struct Expected {
        const char *choice, *name, *kind;
        int parent, faces;
        double area;
    };
    const double plate = 2 * (40 * 30 + 40 + 30), roof = 2 * (50 * 50 + 50 * 2 + 50 * 2);
    const std::vector<Expected> expected = {{"assembly:0", "Car", "assembly", -1, 20, 2 * plate + 200 + roof},
                                            {"assembly:1", "Front", "assembly", 0, 14, 2 * plate + 200},
                                            {"body:0", "left", "solid", 1, 6, plate},
                                            {"body:1", "right", "solid", 1, 6, plate},
                                            {"body:2", "Cover", "sheet body", 1, 2, 200},
                                            {"body:3", "Roof", "solid", 0, 6, roof}};
    ASSERT_EQ(items.item.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        const FileItem& item = items.item[i];
        EXPECT_EQ(item.choice, expected[i].choice);
        EXPECT_EQ(item.name, expected[i].name);
        EXPECT_EQ(item.kind, expected[i].kind);
        EXPECT_EQ(item.parent, expected[i].parent);
        EXPECT_EQ(item.faces, expected[i].faces);
        EXPECT_NEAR(item.area, expected[i].area, 1e-6);
        EXPECT_EQ(item.solid, std::string(expected[i].kind) == "solid");
    }
    const std::pair<Eigen::Vector3d, Eigen::Vector3d> boxes[] = {{{0, 0, 100}, {40, 30, 101}},
                                                                 {{60, 0, 100}, {100, 30, 101}},
                                                                 {{0, 50, 100}, {20, 60, 100}},
                                                                 {{-100, 0, 0}, {-50, 50, 2}}};
    ASSERT_EQ(items.item_of.size(), size_t(items.preview.polygons()));
    for (int p = 0; p < items.preview.polygons(); ++p) {
        const auto& [low, high] = boxes[items.item_of[size_t(p)] - 2];
        for (const int v : items.preview.polygon(p)) {
            EXPECT_GE((items.preview.position[size_t(v)] - low).minCoeff(), -1e-6);
            EXPECT_LE((items.preview.position[size_t(v)] - high).maxCoeff(), 1e-6);
        }
    }
}

TEST(ListItems, NumbersFacesAsReadingDoes)
{
    const ScratchFolder folder;
    write_sample_assembly(folder / "car.step");
    write_sample_bodies(folder / "solids.igs", true);
    write_sample_bodies(folder / "loose.igs", false);
    for (const char* file : {"car.step", "solids.igs", "loose.igs"}) {
        const FileItems items = list_items(folder / file);
        const CadContent cad = read_cad(folder / file);
        EXPECT_GE(cad.faces, 18);
        for (int face = 0; face < cad.faces; ++face) {
            const auto [low, high] = box_of(items.preview, items.face_of, face);
            const auto [read_low, read_high] = box_of(cad.soup, cad.face, face);
            EXPECT_LT((low - read_low).norm() + (high - read_high).norm(), 1e-6) << file << " face " << face;
        }
    }
}

TEST(ListItems, TellsBodiesOfIgesApart)
{
    const ScratchFolder folder;
    write_sample_bodies(folder / "solids.igs", true);
    const FileItems items = list_items(folder / "solids.igs");
    ASSERT_EQ(items.item.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        const double size = 10 * double(i + 1);
        EXPECT_EQ(items.item[i].kind, "solid");
        EXPECT_EQ(items.item[i].name, "Box " + std::to_string(i + 1));
        EXPECT_NEAR(items.item[i].area, 2 * size * size + 4 * size, 1e-6);
    }
    write_sample_bodies(folder / "loose.igs", false);
    const FileItems loose = list_items(folder / "loose.igs");
    ASSERT_EQ(loose.item.size(), 3u);
    EXPECT_EQ(loose.item[2].kind, "loose faces");
    EXPECT_EQ(loose.item[2].choice, "body:2");
    EXPECT_EQ(loose.item[2].faces, 6);
}

TEST(ListItems, GivesPartsAndSetsOfADeck)
{
    const ScratchFolder folder;
    std::ofstream(folder / "two.inp") << "*NODE\n1,0,0,0\n2,4,0,0\n3,4,2,0\n4,0,2,0\n5,8,0,0\n6,8,2,0\n"
                                         "*ELEMENT,TYPE=S4,ELSET=HOOD\n11,1,2,3,4\n"
                                         "*ELEMENT,TYPE=S3,ELSET=FLOOR\n12,2,5,3\n13,5,6,3\n"
                                         "*SHELL SECTION,ELSET=HOOD,MATERIAL=DC04\n0.8\n"
                                         "*SHELL SECTION,ELSET=FLOOR,MATERIAL=DC06\n1.2\n"
                                         "*ELSET,ELSET=MIXED\n11,13\n";
    const FileItems items = list_items(folder / "two.inp");
    ASSERT_GE(items.item.size(), 3u);
    EXPECT_EQ(items.item[0].choice, "HOOD");
    EXPECT_EQ(items.item[0].faces, 1);
    EXPECT_NEAR(items.item[0].area, 8, 1e-12);
    EXPECT_EQ(items.item[0].thickness, 0.8);
    EXPECT_EQ(items.item[1].choice, "FLOOR");
    EXPECT_EQ(items.item[1].faces, 2);
    EXPECT_EQ(items.item[1].material, "DC06");
    EXPECT_EQ(items.item_of, (std::vector{0, 1, 1}));
    EXPECT_EQ(items.face_of, (std::vector{0, 1, 2}));
    const auto mixed =
        std::find_if(items.item.begin(), items.item.end(), [](const FileItem& item) { return item.choice == "MIXED"; });
    ASSERT_NE(mixed, items.item.end());
    EXPECT_EQ(mixed->kind, "element set");
    EXPECT_NEAR(mixed->area, 12, 1e-12);
    for (const FileItem& item : items.item) {
        ReadOptions options;
        options.parts = {item.choice};
        EXPECT_EQ(examine_part(folder / "two.inp", options).file_faces, item.faces) << item.choice;
    }
}

TEST(ListItems, TakesAMeshFileAsOneItem)
{
    const ScratchFolder folder;
    std::ofstream(folder / "quad.obj") << "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 9 9 9\nf 1 2 3 4\nf 1 3 99\n";
    EXPECT_THROW(list_items(folder / "quad.obj"), InputError);
    std::ofstream(folder / "quad.obj") << "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nf 1 2 3 4\n";
    const FileItems items = list_items(folder / "quad.obj");
    ASSERT_EQ(items.item.size(), 1u);
    EXPECT_EQ(items.item[0].choice, "");
    EXPECT_NEAR(items.item[0].area, 6, 1e-12);
    EXPECT_EQ(items.preview.polygons(), 1);
    EXPECT_EQ(items.item_of, std::vector{0});
}

TEST(ListItems, NamesTheFileThatIsDamaged)
{
    const ScratchFolder folder;
    write_sample_assembly(folder / "car.step");
    fs::resize_file(folder / "car.step", fs::file_size(folder / "car.step") / 2);
    try {
        list_items(folder / "car.step");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("car.step"), std::string::npos) << error.what();
    }
    EXPECT_THROW(list_items(folder / "none.txt"), InputError);
    const auto stop = std::make_shared<std::atomic<bool>>(true);
    write_sample_assembly(folder / "car.step");
    EXPECT_THROW(list_items(folder / "car.step", Progress([](double, std::string_view) {}, stop)), Cancelled);
}

} // namespace spia::list_items_test

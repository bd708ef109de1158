#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/cad/brep_check.h"
#include "engine/exchange/cad/read_cad.h"
#include "tests/unit/exchange/sample_faces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::brep_test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& file)
{
    try {
        read_cad(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

double area(const CadContent& cad)
{
    double sum = 0;
    for (int f = 0; f < cad.soup.polygons(); ++f) {
        const auto corner = [&](size_t k) { return cad.soup.position[size_t(cad.soup.polygon(f)[k])]; };
        const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
        sum += 0.5 * a.cross(b).norm();
    }
    return sum;
}

/// A file with one word, the pole of a surface, that can be exchanged.
struct WithWord {
    ScratchFolder folder;
    fs::path file = folder / "swept.brep";
    std::string whole, word;
    size_t begin = 0;

    WithWord()
    {
        write_swept_cylinder(file, Swept::line_up);
        whole = content_of(file);
        const size_t point = whole.find("5.403");
        begin = whole.find_last_of(" \n", point) + 1;
        word = whole.substr(begin, whole.find_first_of(" \n", begin) - begin);
    }

    std::string refusal_of(const std::string& content) const
    {
        std::ofstream(file, std::ios::binary) << content;
        return refusal(file);
    }
    std::string with(const std::string& other) const
    {
        return refusal_of(whole.substr(0, begin) + other + whole.substr(begin + word.size()));
    }
};

} // namespace

TEST(BrepFiles, SeamsAreReadInAllVersions)
{
    const ScratchFolder folder;
    for (const int version : {1, 2, 3})
        for (const bool triangles : {false, true}) {
            write_tube(folder / "tube.brep", version, triangles);
            EXPECT_NE(content_of(folder / "tube.brep").find("CN"), std::string::npos) << "this is about seams";
            const CadContent cad = read_cad(folder / "tube.brep", {.deflection = 0.01});
            EXPECT_NEAR(area(cad), 2 * std::numbers::pi * 10 * 30, 5) << "version " << version;
        }
}

TEST(BrepFiles, EdgesInsideAFaceAreRead)
{
    const ScratchFolder folder;
    write_square_with_inner_edge(folder / "square.brep");
    EXPECT_NE(content_of(folder / "square.brep").find("\ni"), std::string::npos)
        << "this is about orientation INTERNAL";
    EXPECT_NEAR(area(read_cad(folder / "square.brep")), 400, 1e-9);
}

TEST(BrepFiles, TheWordsOfTheFormatAreKnown)
{
    for (const char* right : {"Ve", "CS",  "*",     "p",  "+1",        "-7",        "i12", "e7", "0",  "1001000",
                              "CN", "2CN", "294G1", "G2", "Polygon3D", "-1.5E-101", "1.",  ".5", "-0", "1e999"})
        EXPECT_EQ(fault_of_brep(std::string("Locations 0\n") + right + "\n"), "") << right;
    for (const std::string wrong :
         {"+", "-", "+-5", "O", "Hello", "cn", "2CX", "xCN", "-2CN", "i", "e1.5", "ve", "1D0", "0x10", "1,5"})
        EXPECT_NE(fault_of_brep("Locations 0\n" + wrong + " 0\n").find("stands '" + wrong + "'"), std::string::npos)
            << wrong;
    EXPECT_NE(fault_of_brep("Locations 0\n" + std::string(300, '1') + " 0\n"), "");
    EXPECT_EQ(fault_of_brep("by Hello, 1,5\nLocations 0\n"), "") << "who wrote it";
}

TEST(BrepFiles, NumbersAreNotReadInPart)
{
    const WithWord sample;
    EXPECT_EQ(sample.refusal_of(sample.whole), "");
    ASSERT_EQ(sample.word.substr(0, 5), "5.403");
    for (const std::string wrong : {"-1,5", "1D0", "1.d-3", "10,2", ",5", "5,", "5;4", "5.4x30", "5.4q+00", "5.4E",
                                    "x5.4", "++5", "5.4-977", ";", "-1.1102230246251565D-16"}) {
        const std::string said = sample.with(wrong);
        EXPECT_NE(said.find("(byte " + std::to_string(sample.begin) + ") stands '" + wrong + "'"), std::string::npos)
            << said;
        const auto line =
            std::count(sample.whole.begin(), sample.whole.begin() + std::ptrdiff_t(sample.begin), '\n') + 1;
        EXPECT_NE(said.find("in line " + std::to_string(line)), std::string::npos) << said;
        EXPECT_EQ(said.find("export it again"), said.rfind("export it again")) << said;
    }
    for (const std::string& right : {"+" + sample.word, sample.word + "E+00", sample.word + "e0", "00" + sample.word})
        EXPECT_EQ(sample.with(right), "") << right;
}

TEST(BrepFiles, AnEndWithinANumberIsSaid)
{
    const WithWord sample;
    const std::string said = sample.refusal_of(sample.whole.substr(0, sample.begin) + "5.403E");
    EXPECT_NE(said.find("cut short"), std::string::npos) << said;
    EXPECT_NE(said.find("within '5.403E'"), std::string::npos) << said;
}

} // namespace spia::brep_test

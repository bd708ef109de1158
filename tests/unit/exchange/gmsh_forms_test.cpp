// Meshes of Gmsh in its other forms: binary, in both orders of bytes, and version 1.
#include <algorithm>
#include <gtest/gtest.h>

#include "engine/part/part_file.h"
#include "tests/unit/exchange/sample_decks.h"

namespace spia::gmsh_forms_test {
namespace {

using sample::refusal;
using testing::Test;

Deck read(const std::string& text) { return sample::read("a.msh", text); }

/// Writes numbers as bytes, as the manual of Gmsh says.
struct Bytes {
    bool swapped = false;
    std::string text = {};

    template <class T> Bytes& put(T value)
    {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (swapped)
            std::reverse(raw.begin(), raw.end());
        text += raw;
        return *this;
    }
    template <class... T> Bytes& ints(T... values) { return (put(std::int32_t(values)), ..., *this); }
    template <class... T> Bytes& sizes(T... values) { return (put(std::int64_t(values)), ..., *this); }
    template <class... T> Bytes& reals(T... values) { return (put(double(values)), ..., *this); }
    Bytes& words(const std::string& words)
    {
        text += words;
        return *this;
    }
};

const std::string names = "$PhysicalNames\n2\n1 4 \"Rim\"\n2 5 \"Skin\"\n$EndPhysicalNames\n";

const std::string text_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
                           "$Nodes\n5\n1 0 0 0.5\n2 1 0 0\n3 1 1 0\n4 0 1 0\n10 -2 0.1 0\n$EndNodes\n"
                           "$Elements\n4\n1 1 2 4 1 1 2\n2 3 2 5 7 1 2 3 4\n3 2 2 5 7 1 4 10\n4 2 2 0 8 1 2 10\n"
                           "$EndElements\n";

std::string binary_2(bool swapped)
{
    Bytes file{swapped};
    file.words("$MeshFormat\n2.2 1 8\n").ints(1).words("\n$EndMeshFormat\n" + names + "$Nodes\n5\n");
    file.ints(1).reals(0, 0, 0.5).ints(2).reals(1, 0, 0).ints(3).reals(1, 1, 0).ints(4).reals(0, 1, 0);
    file.ints(10).reals(-2, 0.1, 0).words("\n$EndNodes\n$Elements\n4\n");
    file.ints(1, 1, 2, /**/ 1, 4, 1, 1, 2);
    file.ints(3, 1, 2, /**/ 2, 5, 7, 1, 2, 3, 4);
    file.ints(2, 2, 2, /**/ 3, 5, 7, 1, 4, 10, /**/ 4, 0, 8, 1, 2, 10);
    return file.words("\n$EndElements\n").text;
}

const std::string text_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
                           "$Entities\n1 1 2 0\n1 0 0 0 1 6\n1 0 0 0 1 0 0 1 4 2 1 -1\n7 0 0 0 1 1 0 1 5 1 1\n"
                           "8 0 0 0 1 1 0 0 0\n$EndEntities\n"
                           "$Nodes\n2 5 1 10\n1 1 1 2\n1\n2\n0 0 0.5 0.25\n1 0 0 0.75\n2 7 0 3\n3\n4\n10\n1 1 0\n"
                           "0 1 0\n-2 0.1 0\n$EndNodes\n"
                           "$Elements\n4 4 1 4\n1 1 1 1\n1 1 2\n2 7 3 1\n2 1 2 3 4\n2 7 2 1\n3 1 4 10\n2 8 2 1\n"
                           "4 1 2 10\n$EndElements\n";

std::string binary_4(bool swapped)
{
    Bytes file{swapped};
    file.words("$MeshFormat\n4.1 1 8\n").ints(1).words("\n$EndMeshFormat\n" + names + "$Entities\n");
    file.sizes(1, 1, 2, 0);
    file.ints(1).reals(0, 0, 0).sizes(1).ints(6);
    file.ints(1).reals(0, 0, 0, 1, 0, 0).sizes(1).ints(4).sizes(2).ints(1, -1);
    file.ints(7).reals(0, 0, 0, 1, 1, 0).sizes(1).ints(5).sizes(1).ints(1);
    file.ints(8).reals(0, 0, 0, 1, 1, 0).sizes(0).sizes(0);
    file.words("\n$EndEntities\n$PartitionedEntities\n").sizes(3).ints(10).words("\n$EndPartitionedEntities\n$Nodes\n");
    file.sizes(2, 5, 1, 10).ints(1, 1, 1).sizes(2, /**/ 1, 2).reals(0, 0, 0.5, 0.25).reals(1, 0, 0, 0.75);
    file.ints(2, 7, 0).sizes(3, /**/ 3, 4, 10).reals(1, 1, 0).reals(0, 1, 0).reals(-2, 0.1, 0);
    file.words("\n$EndNodes\n$Elements\n").sizes(4, 4, 1, 4);
    file.ints(1, 1, 1).sizes(1, /**/ 1, 1, 2).ints(2, 7, 3).sizes(1, /**/ 2, 1, 2, 3, 4);
    file.ints(2, 7, 2).sizes(1, /**/ 3, 1, 4, 10).ints(2, 8, 2).sizes(1, /**/ 4, 1, 2, 10);
    return file.words("\n$EndElements\n").text;
}

const std::string text_1 = "$NOD\n5\n1 0 0 0.5\n2 1 0 0\n3 1 1 0\n4 0 1 0\n10 -2 0.1 0\n$ENDNOD\n"
                           "$ELM\n4\n1 1 4 1 2 1 2\n2 3 5 7 4 1 2 3 4\n3 2 5 7 3 1 4 10\n4 2 0 8 3 1 2 10\n$ENDELM\n";

void expect_same(const Deck& deck, const Deck& expected, const std::string& which)
{
    ASSERT_EQ(deck.node, expected.node) << which;
    EXPECT_EQ(deck.position, expected.position) << which;
    EXPECT_EQ(deck.corner, expected.corner) << which;
    EXPECT_EQ(deck.element, expected.element) << which;
    ASSERT_EQ(deck.parts.size(), expected.parts.size()) << which;
    EXPECT_EQ(deck.part_of, expected.part_of) << which;
}

} // namespace

TEST(GmshForms, ABinaryMeshIsThatOfItsText)
{
    const Deck two = read(text_2), four = read(text_4);
    ASSERT_EQ(two.elements(), 3);
    EXPECT_EQ(two.parts.at(0).name, "Skin");
    EXPECT_EQ(two.position.at(4), Eigen::Vector3d(-2, 0.1, 0));
    for (const bool swapped : {false, true}) {
        expect_same(read(binary_2(swapped)), two, "2.2");
        expect_same(read(binary_4(swapped)), four, "4.1");
        EXPECT_EQ(read(binary_2(swapped)).parts.at(0).name, "Skin");
        EXPECT_EQ(read(binary_4(swapped)).parts.at(0).name, "Skin");
    }
    expect_same(four, two, "the same mesh in both versions");
}

TEST(GmshForms, NodesWithParametersAreNodes)
{
    std::string text = text_2;
    text.replace(text.find("$Nodes"), text.find("$Elements") - text.find("$Nodes"),
                 "$ParametricNodes\n5\n1 0 0 0.5 0 1\n2 1 0 0 1 1 0.25\n3 1 1 0 2 7 1 1\n4 0 1 0 2 7 0 1\n"
                 "10 -2 0.1 0 2 7 -2 0.1\n$EndParametricNodes\n");
    expect_same(read(text), read(text_2), "text");
    std::string binary = binary_2(false);
    Bytes nodes;
    nodes.words("$ParametricNodes\n5\n").ints(1).reals(0, 0, 0.5).ints(0, 1).ints(2).reals(1, 0, 0).ints(1, 1);
    nodes.reals(0.25).ints(3).reals(1, 1, 0).ints(2, 7).reals(1, 1).ints(4).reals(0, 1, 0).ints(2, 7).reals(0, 1);
    nodes.ints(10).reals(-2, 0.1, 0).ints(2, 7).reals(-2, 0.1).words("\n$EndParametricNodes\n");
    binary.replace(binary.find("$Nodes"), binary.find("$Elements") - binary.find("$Nodes"), nodes.text);
    expect_same(read(binary), read(text_2), "binary");
}

TEST(GmshForms, VersionOneIsRead) { expect_same(read(text_1), read(text_2), "1"); }

TEST(GmshForms, ACutOffBinaryMeshIsRefusedReadably)
{
    for (const std::string& whole : {binary_2(false), binary_4(false)})
        for (size_t length = whole.find("EndMeshFormat"); length + 30 < whole.size(); ++length) {
            const std::string text = whole.substr(0, length);
            if (refusal("a.msh", text).empty()) {
                EXPECT_LT(sample::read("a.msh", text).elements(), 3) << "only where no section is cut: " << length;
            }
        }
    std::string as_text = binary_2(false); // line ends changed: what a transfer as text does
    for (size_t at = 0; (at = as_text.find('\n', at)) != as_text.npos; at += 2)
        as_text.insert(at, "\r");
    EXPECT_NE(refusal("a.msh", as_text), "");
    Bytes large;
    large.words("$MeshFormat\n2.2 1 8\n").ints(1).words("\n$EndMeshFormat\n$Nodes\n1\n").ints(1).reals(1e300, 0, 0);
    EXPECT_NE(refusal("a.msh", large.text).find("1e+300 is not a usable number"), std::string::npos);
    Bytes unknown;
    unknown.words("$MeshFormat\n2.2 1 8\n").ints(1).words("\n$EndMeshFormat\n$Elements\n1\n").ints(34, 1, 2, 1, 1, 1);
    EXPECT_NE(refusal("a.msh", unknown.text).find("elements of type 34 are not known"), std::string::npos);
}

} // namespace spia::gmsh_forms_test

#include "engine/exchange/deck/write_shell_mesh.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/exchange/text/text_encoding.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

ShellMesh triangle_called(const std::string& name)
{
    ShellMesh mesh;
    mesh.node = {1, 2, 3};
    mesh.position.setZero(3, 3);
    mesh.position(0, 1) = mesh.position(1, 2) = 1;
    mesh.corner = {{0, 1, 2, -1}};
    mesh.element = {1};
    mesh.part_of = {0};
    mesh.parts = {{.name = name}};
    return mesh;
}

TEST(ShellMeshFile, LongNamesEndWithAWholeLetter)
{
    const ScratchFolder scratch;
    constexpr size_t most = 70; // of a title of LS-DYNA
    for (const std::string letter : {"x", "\xc3\xbc", "\xe2\x82\xac", "\xf0\x9f\x98\x80"})
        for (size_t before = most - 5; before <= most + 1; ++before) {
            const std::string name = std::string(before, 'a') + letter + letter + "b";
            write_shell_mesh(scratch / "a.k", triangle_called(name), "a part");
            const std::string text = content_of(scratch / "a.k");
            const size_t from = text.find("*PART\n") + 6;
            const std::string title = text.substr(from, text.find('\n', from) - from);
            EXPECT_TRUE(name.starts_with(title)) << title;
            EXPECT_EQ(readable(title), title) << before << ": a letter is cut";
            EXPECT_LE(title.size(), most);
            EXPECT_GT(title.size() + letter.size(), std::min(most, name.size())) << "no more than that is lost";
        }
}

TEST(ShellMeshFile, IdsLeaveRoomForThoseOfCopies)
{
    const std::string deck = "*NODE\n1,0,0,0\n2,1,0,0\n9223372036854775807,0,1,0\n*ELEMENT, TYPE=S3\n";
    EXPECT_NE(sample::refusal("a.inp", deck + "1,1,2,9223372036854775807\n").find("node id 9223372036854775807"),
              std::string::npos);
    EXPECT_NE(
        sample::refusal("a.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT, TYPE=S3\n-9223372036854775807,1,2,3\n")
            .find("element id -9223372036854775807"),
        std::string::npos);
}

} // namespace
} // namespace spia

#include <clocale>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <locale>

#include "engine/core/read_number.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

const DeckPart& part_of(const Deck& deck, int element) { return deck.parts[size_t(deck.part_of[size_t(element)])]; }

void expect_strip(const Deck& deck, const std::string& name)
{
    SCOPED_TRACE(name);
    const sample::Strip strip;
    ASSERT_EQ(deck.nodes(), int(strip.node.size()));
    ASSERT_EQ(deck.elements(), int(strip.shell.size()));
    for (int v = 0; v < deck.nodes(); ++v) {
        EXPECT_EQ(deck.node[size_t(v)], strip.node[size_t(v)].first);
        EXPECT_EQ(deck.position[size_t(v)], Eigen::Vector3d(strip.node[size_t(v)].second.data()));
    }
    const bool has_sheets = !name.ends_with(".msh"), has_ids = !name.ends_with(".inp");
    for (int e = 0; e < deck.elements(); ++e) {
        const auto& shell = strip.shell[size_t(e)];
        EXPECT_EQ(deck.element[size_t(e)], shell.id);
        const auto& corner = deck.corner[size_t(e)];
        EXPECT_EQ(corner[3] < 0, shell.node.size() == 3);
        for (size_t k = 0; k < shell.node.size(); ++k)
            EXPECT_EQ(deck.node[size_t(corner[k])], shell.node[k]);
        const DeckPart& part = part_of(deck, e);
        EXPECT_TRUE(same_letters(part.name, shell.part == 7 ? "Hood" : "Rail")) << part.name;
        EXPECT_EQ(part.id, has_ids ? std::optional<std::int64_t>(shell.part) : std::nullopt);
        if (has_sheets) {
            EXPECT_EQ(part.thickness, shell.part == 7 ? 1.25 : 0.75);
            EXPECT_EQ(part.material,
                      name.ends_with("bdf") || name.ends_with("nas") || name.ends_with("dat") ? "MAT1" : "DC04");
        }
        EXPECT_EQ(part.elements, shell.part == 7 ? 4 : 3);
    }
}

TEST(SameDeck, IsTheSameMeshInEveryFormatAndSpelling)
{
    for (const auto& [name, text] : sample::decks())
        expect_strip(sample::read(name, text), name);
}

TEST(SameDeck, IsTheSameMeshWithLineEndsOfWindowsAndAMarkOfUtf8)
{
    for (const auto& [name, text] : sample::decks()) {
        std::string windows = "\xef\xbb\xbf";
        for (const char c : text)
            windows += c == '\n' ? "\r\n" : std::string(1, c);
        expect_strip(sample::read(name, windows), name);
    }
}

struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(SameDeck, IsTheSameMeshInALocaleWithDecimalCommas)
{
    const auto decks = sample::decks();
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const std::locale streams = std::locale::global(std::locale(std::locale(), new DecimalComma));
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) // where they are installed; strtod()
                                                            // obeys these
        std::setlocale(LC_NUMERIC, name);
    for (const auto& [name, text] : decks)
        expect_strip(sample::read(name, text), name);
    std::locale::global(streams);
    std::setlocale(LC_ALL, before.c_str());
}

TEST(SameDeck, IsTheSamePartFromFilesInAFolderWithBlanksAndUmlauts)
{
    const ScratchFolder scratch;
    const std::filesystem::path folder = scratch / "T\xc3\xbcr innen";
    std::filesystem::create_directories(folder);
    std::optional<PartFile> first;
    for (const auto& [name, text] : sample::decks()) {
        SCOPED_TRACE(name);
        std::ofstream(folder / name, std::ios::binary) << text;
        const PartFile part = read_part(folder / name);
        EXPECT_EQ(part.mesh.triangles(), 12);
        EXPECT_EQ(part.file_faces, 7);
        EXPECT_EQ(part.doctor.boundary_loops, 1);
        EXPECT_FALSE(part.doctor.find(Fault::flipped_face));
        if (!first)
            first = part;
        EXPECT_EQ(part.mesh.position, first->mesh.position);
        EXPECT_EQ(part.mesh.triangle, first->mesh.triangle);
        EXPECT_EQ(part.source_face, first->source_face);
    }
}

} // namespace
} // namespace spia

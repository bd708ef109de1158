#include "app/viewer/model/reports/wrapped_text.h"

#include <gtest/gtest.h>

namespace spia::viewer {
namespace {

/// As if every letter were one pixel wide.
std::string in_width(std::string_view text, float room)
{
    return broken_at_spaces(text, room, [](std::string_view piece) { return float(piece.size()); });
}

TEST(WrappedText, BreaksAtSpacesAndNeverInANumber)
{
    EXPECT_EQ(in_width("deviates by 0.017 in some", 17), "deviates by\n0.017 in some");
    EXPECT_EQ(in_width("deviates by 0.017, there", 14), "deviates by\n0.017, there");
    for (int room = 1; room < 30; ++room) {
        const std::string lines = in_width("a tolerance of 0.017 mm, at (12.0, 3.5, 1.25 mm)", float(room));
        for (const char* whole : {"0.017 mm,", "(12.0,", "3.5,", "1.25 mm)"})
            EXPECT_NE(lines.find(whole), std::string::npos) << lines;
    }
}

TEST(WrappedText, NoLineIsWiderThanTheRoomButAWordThatIs)
{
    const std::string text = "the quick brown fox jumps over the lazy dog and /a/very/long/path/to/somewhere ends";
    for (int room = 6; room < 90; ++room) {
        const std::string lines = in_width(text, float(room));
        std::string joined = lines;
        for (char& c : joined)
            c = c == '\n' ? ' ' : c;
        EXPECT_EQ(joined, text);
        for (size_t at = 0; at < lines.size();) {
            const size_t end = std::min(lines.find('\n', at), lines.size());
            const std::string line = lines.substr(at, end - at);
            EXPECT_TRUE(line.size() <= size_t(room) || line.find(' ') == line.npos) << line;
            at = end + 1;
        }
    }
}

TEST(WrappedText, KeepsItsOwnLines)
{
    EXPECT_EQ(in_width("one\n\ntwo three", 5), "one\n\ntwo\nthree");
    EXPECT_EQ(in_width("", 5), "");
}

} // namespace
} // namespace spia::viewer

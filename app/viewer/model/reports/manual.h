#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The user guide, chapters of Markdown in assets/manual, as it is shown inside the program.
namespace spia::viewer {

/// Words of one look.
struct ManualSpan {
    std::string text;
    bool bold = false, code = false;
    std::string link = {}; ///< the file of another chapter, e.g. "export.md"; empty: none

    friend bool operator==(const ManualSpan&, const ManualSpan&) = default;
};
using ManualText = std::vector<ManualSpan>;

/// What stands below another block.
struct ManualBlock {
    enum class Kind { heading, paragraph, item, table, picture, verbatim };
    Kind kind = Kind::paragraph;
    int level = 0;                             ///< of a heading from 1, of an item in a list from 1
    std::string mark;                          ///< of an item: a bullet, or its number
    ManualText text;                           ///< of a picture: what it shows
    std::vector<std::vector<ManualText>> rows; ///< of a table, the first one its heads
    std::filesystem::path picture;

    std::string plain() const; ///< all its words
};

struct ManualChapter {
    std::string file, title;
    std::vector<ManualBlock> blocks;
};

struct Manual {
    std::vector<ManualChapter> chapters;

    /// -1: there is no such chapter.
    int chapter(std::string_view file) const;
};

/// One chapter. Pictures are looked for in `folder`. @throws InputError if it has no heading
ManualChapter manual_chapter(std::string_view markdown, const std::string& file, const std::filesystem::path& folder);

/// The chapters of a folder that its contents.txt names, a file a line, in this order. @throws
/// InputError
Manual read_manual(const std::filesystem::path& folder);

/// Where words stand in the manual.
struct ManualPlace {
    size_t chapter = 0;
    int block = 0;
    std::string excerpt; ///< around the words

    friend bool operator==(const ManualPlace&, const ManualPlace&) = default;
};
/// Blocks that hold all of the words, in upper or lower case; those whose heading does go first.
/// None for words shorter than two letters.
std::vector<ManualPlace> places_of(const Manual& manual, std::string_view words);

} // namespace spia::viewer

#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"

namespace spia {

/// The lines of a deck, through the files that it includes; says where it is when something is
/// wrong. Lines stay valid as long as this does. A file is taken once, unless it is asked for
/// again: what is included again holds nothing new.
class DeckLines {
public:
    DeckLines(std::filesystem::path file, std::string content, Progress progress = {});

    bool next(); ///< goes to the next line, empty or not; false at the end of the deck
    /// without its end (LF or CR LF)
    std::string_view line() const { return line_; }
    /// all of the deck, without the files it includes
    std::string_view text() const { return *content_.front(); }
    /// skips the rest of the current file
    void leave_file();
    /// of the current file, behind the current line
    size_t bytes_left() const { return open_.back().rest.size(); }
    /// The bytes behind the current line, or behind those taken before. @throws InputError if there
    /// are not so many
    std::string_view bytes(size_t count);
    int depth() const { return int(open_.size()); } ///< 1: the deck itself

    /// Goes on with the first line of another file, and comes back at its end. It is looked for
    /// beside the current file, beside the deck and in the folders added; if it is not there a note
    /// says so and nothing happens.
    /// @throws InputError if the file includes itself, or files are nested too deep
    /// @param again  also if it was taken before
    void include(std::string_view name, bool again = false);
    void add_folder(std::string_view name, bool relative); ///< where to look for included files

    std::int64_t whole(std::string_view field) const; ///< @throws InputError if it is no whole
                                                      ///< number
    double number(std::string_view field) const;      ///< @throws InputError if it is no number
    double coordinate(std::string_view field) const;  ///< @throws InputError if it is no length
    double checked_coordinate(double value) const;    ///< the same of a number
    /// A whole number, or 0 for a field of blanks.
    std::int64_t whole_or_zero(std::string_view field) const;
    [[noreturn]] void fail(std::string_view what) const; ///< @throws InputError "line 12: what"

    /// A line in its file.
    struct Place {
        std::filesystem::path file;
        long line = 0;
        bool included = false;
    };
    Place place() const; ///< of the current line
    /// What is wrong from here on is said of this line: a reader that has to look ahead knows where
    /// it is.
    void speak_of(std::optional<Place> place) { spoken_of_ = std::move(place); }

    std::vector<std::string> notes;  ///< what was wrong with included files; the first ones
    std::vector<std::string> doubts; ///< those of files that are not there

private:
    struct File {
        std::filesystem::path path;
        std::string_view rest;
        long line = 0;
    };
    void open(const std::filesystem::path& path, std::string content);
    void checkpoint() const;
    void note(std::string text);

    // of all files, for lines that are still looked at
    std::vector<std::unique_ptr<const std::string>> content_;
    std::vector<File> open_;
    std::set<std::filesystem::path> seen_;
    std::vector<std::filesystem::path> folders_;
    std::string_view line_;
    std::optional<Place> spoken_of_; // none: the current line
    Progress progress_;
    long lines_ = 0;
    size_t taken_ = 0; // bytes
};

} // namespace spia

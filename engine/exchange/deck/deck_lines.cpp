#include "engine/exchange/deck/deck_lines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/core.h>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/core/read_number.h"
#include "engine/exchange/text/text_encoding.h"
#include "engine/exchange/text/text_lines.h"

namespace spia {
namespace {

namespace fs = std::filesystem;

constexpr size_t deepest = 20;        ///< files that include files; LS-DYNA stops at 10
constexpr size_t most_files = 10'000; ///< a few that include each other more than once are soon
                                      ///< without number

fs::path unique_name(const fs::path& path)
{
    std::error_code problem;
    fs::path canonical = fs::canonical(path, problem);
    return problem ? path.lexically_normal() : canonical;
}

std::string_view without_mark(std::string_view content)
{
    return content.starts_with("\xef\xbb\xbf") ? content.substr(3) : content;
}

} // namespace

DeckLines::DeckLines(fs::path file, std::string content, Progress progress) : progress_(std::move(progress))
{
    open(file, std::move(content));
}

void DeckLines::open(const fs::path& path, std::string content)
{
    seen_.insert(unique_name(path));
    content_.push_back(std::make_unique<const std::string>(std::move(content)));
    open_.push_back({path, without_mark(*content_.back()), 0});
}

bool DeckLines::next()
{
    while (open_.back().rest.empty()) {
        if (open_.size() == 1)
            return false;
        open_.pop_back();
    }
    File& file = open_.back();
    const void* found = std::memchr(file.rest.data(), '\n', file.rest.size());
    const size_t length = found ? size_t(static_cast<const char*>(found) - file.rest.data()) : file.rest.size();
    line_ = file.rest.substr(0, length);
    file.rest.remove_prefix(std::min(length + 1, file.rest.size()));
    ++file.line;
    if (line_.ends_with('\r'))
        line_.remove_suffix(1);
    constexpr long between_checkpoints = 1 << 14;
    if (++lines_ % between_checkpoints == 0)
        checkpoint();
    return true;
}

std::string_view DeckLines::bytes(size_t count)
{
    File& file = open_.back();
    if (count > file.rest.size())
        fail("the file is cut off");
    const std::string_view taken = file.rest.substr(0, count);
    file.rest.remove_prefix(count);
    constexpr size_t between_checkpoints = size_t(1) << 20;
    if (taken_ / between_checkpoints != (taken_ + count) / between_checkpoints)
        checkpoint();
    taken_ += count;
    return taken;
}

void DeckLines::checkpoint() const
{
    const double whole = double(content_.front()->size());
    progress_.checkpoint(1 - double(open_.front().rest.size()) / whole, "reading the deck");
}

void DeckLines::leave_file() { open_.back().rest = {}; }

void DeckLines::add_folder(std::string_view name, bool relative)
{
    constexpr size_t most = 100; // every file that is included is looked for in all of them
    // of an absolute name that name
    std::vector<fs::path> meant = {open_.front().path.parent_path() / fs::path(name)};
    if (!relative)
        meant.insert(meant.begin(), fs::path(name));
    for (fs::path& folder : meant) {
        if (std::find(folders_.begin(), folders_.end(), folder) != folders_.end())
            continue;
        if (folders_.size() >= most)
            fail(fmt::format("more than {} folders to look for included files", most));
        folders_.push_back(std::move(folder));
    }
}

void DeckLines::include(std::string_view name, bool again)
{
    if (name.empty() || name.find('\0') != name.npos)
        fail("an included file has no name");
    checkpoint();
    std::string slashes(name);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    std::vector<fs::path> folders = {open_.back().path.parent_path(), open_.front().path.parent_path()};
    folders.insert(folders.end(), folders_.begin(), folders_.end());
    std::error_code problem;
    for (const fs::path& folder : folders)
        for (const fs::path& file : {folder / fs::path(name), folder / fs::path(slashes)}) {
            if (!fs::is_regular_file(file, problem))
                continue;
            const fs::path unique = unique_name(file);
            for (const File& other : open_)
                if (unique_name(other.path) == unique)
                    fail(fmt::format("the file {} includes itself", file.string()));
            if (fs::file_size(file, problem) == 0)
                return;
            if (seen_.contains(unique) && !again) {
                return note(fmt::format("the file {} is included more than once; it was taken once", name));
            }
            if (open_.size() >= deepest)
                fail(fmt::format("files are included {} deep", deepest));
            if (content_.size() >= most_files)
                fail(fmt::format("more than {} files are included", most_files));
            try {
                open(file, file_content(file));
            } catch (const InputError& error) {
                fail(fmt::format("the included file {}: {}", file.string(), error.what()));
            }
            return;
        }
    const size_t reported = notes.size();
    note(fmt::format("the included file {} is not there, and what it holds is missing", name.substr(0, 200)));
    doubts.insert(doubts.end(), notes.begin() + long(reported), notes.end());
}

void DeckLines::note(std::string text)
{
    constexpr size_t most = 20;
    if (notes.size() < most)
        notes.push_back(std::move(text));
    else if (notes.size() == most)
        notes.emplace_back("and so for more files");
}

std::int64_t DeckLines::whole(std::string_view field) const
{
    if (const auto value = read_whole_number(field))
        return *value;
    fail(trimmed(field).empty() ? std::string("a number is missing")
                                : fmt::format("'{}' is not a whole number", trimmed(field).substr(0, 40)));
}

std::int64_t DeckLines::whole_or_zero(std::string_view field) const
{
    return trimmed(field).empty() ? 0 : whole(field);
}

double DeckLines::number(std::string_view field) const
{
    if (const auto value = read_number(field))
        return *value;
    fail(trimmed(field).empty() ? std::string("a number is missing")
                                : fmt::format("'{}' is not a number", trimmed(field).substr(0, 40)));
}

double DeckLines::coordinate(std::string_view field) const
{
    const double value = number(field);
    if (!(std::abs(value) <= largest_coordinate))
        fail(fmt::format("the coordinate '{}' is not a usable number", trimmed(field).substr(0, 40)));
    return value;
}

double DeckLines::checked_coordinate(double value) const
{
    if (!(std::abs(value) <= largest_coordinate))
        fail(fmt::format("the coordinate {} is not a usable number", value));
    return value;
}

void DeckLines::fail(std::string_view what) const
{
    const Place at = spoken_of_.value_or(place());
    const std::string where = at.included ? fmt::format("in the included file {}, ", at.file.string()) : "";
    throw InputError(fmt::format("{}line {}: {}", where, at.line, readable(what)));
}

DeckLines::Place DeckLines::place() const { return {open_.back().path, open_.back().line, open_.size() > 1}; }

} // namespace spia

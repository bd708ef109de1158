#include "engine/exchange/text/text_lines.h"

#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"

namespace spia {
namespace {

constexpr std::string_view blank = " \t\r\v\f";

std::string_view without_plus(std::string_view word) // from_chars does not know it
{
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

} // namespace

bool TextLines::next()
{
    words_.clear();
    while (words_.empty() && !rest_.empty()) {
        for (bool more = true; more && !rest_.empty();) {
            const size_t end = rest_.find('\n');
            std::string_view line = rest_.substr(0, end);
            rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
            ++line_;
            while (joined_ && !line.empty() && line.back() == '\r')
                line.remove_suffix(1);
            more = joined_ && !line.empty() && line.back() == '\\';
            if (more)
                line.remove_suffix(1);
            cut(line);
        }
    }
    return !words_.empty();
}

void TextLines::cut(std::string_view line)
{
    if (comment_ != 0)
        line = line.substr(0, line.find(comment_));
    for (size_t begin = line.find_first_not_of(blank); begin != line.npos;) {
        const size_t end = line.find_first_of(blank, begin);
        words_.push_back(line.substr(begin, end - begin));
        begin = end == line.npos ? end : line.find_first_not_of(blank, end);
    }
}

double TextLines::coordinate(size_t i) const
{
    if (i >= words_.size())
        fail("a coordinate is missing");
    const double value = number_or_nan(i);
    if (!(std::abs(value) <= largest_coordinate))
        fail(fmt::format("the coordinate '{}' is not a usable number", words_[i].substr(0, 40)));
    return value;
}

double TextLines::number_or_nan(size_t i) const
{
    const std::string_view word = without_plus(words_.at(i));
    double value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end == word.data() + word.size() && problem == std::errc())
        return value;
    const bool underflow = problem == std::errc::result_out_of_range && word.find_first_of("eE") != word.npos &&
                           word[word.find_first_of("eE") + 1] == '-';
    return underflow ? 0 : std::numeric_limits<double>::quiet_NaN();
}

int TextLines::integer(size_t i) const
{
    if (i >= words_.size())
        fail("a number is missing");
    const std::string_view word = without_plus(words_[i]);
    int value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size())
        fail(fmt::format("'{}' is not a whole number", words_[i].substr(0, 40)));
    return value;
}

void TextLines::fail(std::string_view what) const { throw InputError(fmt::format("line {}: {}", line_, what)); }

} // namespace spia

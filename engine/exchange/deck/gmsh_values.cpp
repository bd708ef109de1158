#include "engine/exchange/deck/gmsh_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/core.h>

#include "engine/core/read_number.h"

namespace spia {
namespace {

template <class T> T load(const char* bytes, bool swapped)
{
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes, sizeof(T));
    if (swapped)
        std::reverse(raw.begin(), raw.end());
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
}

} // namespace

void GmshValues::begin_binary(std::int64_t size_bytes)
{
    if (size_bytes != 4 && size_bytes != 8)
        lines_.fail(fmt::format("sizes have {} bytes, not 4 or 8", size_bytes));
    const char* one = lines_.bytes(4).data();
    swapped_ = load<std::int32_t>(one, true) == 1;
    if (!swapped_ && load<std::int32_t>(one, false) != 1)
        lines_.fail("the number behind the format of a binary mesh is not 1: the file was changed on its way, as by a "
                    "transfer as text");
    size_bytes_ = size_t(size_bytes);
    binary_ = true;
}

void GmshValues::next_line()
{
    if (!lines_.next())
        lines_.fail("the file ends in the middle of a section");
    if (trimmed(lines_.line()).starts_with('$'))
        lines_.fail("the section is shorter than it says");
    fields_.cut_words(lines_.line());
    in_words_ = true;
}

void GmshValues::next(std::string_view kinds)
{
    if (!binary_)
        return next_line();
    values_.clear();
    in_words_ = false;
    more(kinds);
}

void GmshValues::more(std::string_view kinds, std::int64_t times)
{
    if (!binary_)
        return;
    size_t once = 0;
    for (const char kind : kinds)
        once += bytes_of(kind);
    if (times < 0 || size_t(times) > lines_.bytes_left() / std::max<size_t>(once, 1))
        lines_.fail("the file ends in the middle of a section");
    const char* bytes = lines_.bytes(once * size_t(times)).data();
    for (std::int64_t k = 0; k < times; ++k)
        for (const char kind : kinds) {
            values_.push_back(value_of(kind, bytes));
            bytes += bytes_of(kind);
        }
}

GmshValues::Value GmshValues::value_of(char kind, const char* bytes) const
{
    if (kind == 'd')
        return {0, load<double>(bytes, swapped_)};
    return {bytes_of(kind) == 4 ? load<std::int32_t>(bytes, swapped_) : load<std::int64_t>(bytes, swapped_), 0};
}

const GmshValues::Value& GmshValues::value(size_t i) const
{
    if (i >= values_.size())
        lines_.fail("a number is missing");
    return values_[i];
}

std::int64_t GmshValues::whole(size_t i) const { return in_words_ ? lines_.whole(fields_[i]) : value(i).whole; }

double GmshValues::coordinate(size_t i) const
{
    return in_words_ ? lines_.coordinate(fields_[i]) : lines_.checked_coordinate(value(i).real);
}

} // namespace spia

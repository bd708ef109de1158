#include "engine/exchange/text/fixed_number.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

std::string with_point(std::string text)
{
    if (text.find('.') != text.npos)
        return text;
    return text.insert(std::min(text.find('E'), text.size()), ".0");
}

} // namespace

std::string fixed_number(double value, int width)
{
    if (!std::isfinite(value))
        throw InputError(fmt::format("{} is no number for a solver deck", value));
    value += 0.0; // no minus before a zero
    std::string text = with_point([&] {
        std::string shortest = fmt::format("{}", value); // all digits, and no more than it takes
        for (char& c : shortest)
            c = c == 'e' ? 'E' : c;
        return shortest;
    }());
    for (int digits = 17; int(text.size()) > width - 1; --digits)
        text = fmt::format("{:#.{}G}", value, digits);
    return fmt::format("{:>{}}", text, width);
}

std::string fixed_number(std::int64_t value, int width)
{
    std::string text = fmt::format("{:>{}}", value, width);
    if (int(text.size()) > width)
        throw InputError(fmt::format("the number {} does not fit into {} columns of a solver deck; renumber the deck",
                                     value, width));
    return text;
}

} // namespace spia

#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace spia::fuzz {

std::string damaged(std::string content, const std::vector<std::string>& spice, std::mt19937& random)
{
    const auto line_at = [&](size_t at) {
        const size_t begin = at == 0 ? 0 : content.rfind('\n', at - 1) + 1;
        const size_t end = std::min(content.find('\n', at), content.size() - 1);
        return std::pair(begin, end + 1 - begin);
    };
    for (uint32_t changes = 1 + random() % 4; changes > 0 && !content.empty(); --changes) {
        const size_t at = random() % content.size();
        const auto [begin, length] = line_at(at);
        switch (random() % 9) {
        case 0: content.resize(at); break;
        case 1: content[at] = char(random()); break;
        case 2: content[at] = char(content[at] ^ (1 << random() % 8)); break;
        case 3: content.erase(at, random() % 40); break;
        case 4: {
            const size_t where = random() % 2 ? at : begin; // first: the same files on every
                                                            // compiler
            content.insert(where, spice[random() % spice.size()]);
            break;
        }
        case 5: content.insert(begin, content.substr(begin, length)); break;
        case 6: content.insert(line_at(random() % content.size()).first, content.substr(begin, length)); break;
        case 7: content.erase(begin, length); break;
        case 8: {
            const size_t from = random() % content.size();
            content.insert(at, content.substr(from, random() % 60));
            break;
        }
        }
    }
    return content;
}

std::string with_other_number(std::string content, std::mt19937& random)
{
    constexpr std::string_view of_numbers = "0123456789.+-eE";
    static const std::string limits[] = {"0",       "-1", "1",  "2147483647", "-2147483648", "1e308",
                                         "-1e-308", "99", "0.", "1e10",       "1e-7",        "6.283185307"};
    if (content.find_first_of(of_numbers.substr(0, 10)) == std::string::npos)
        return content;
    const auto number = [&] { // where one begins, and its length
        size_t digit = content.find_first_of(of_numbers.substr(0, 10), random() % content.size());
        if (digit == std::string::npos)
            digit = content.find_first_of(of_numbers.substr(0, 10));
        const size_t before = content.find_last_not_of(of_numbers, digit);
        const size_t begin = before == std::string::npos ? 0 : before + 1;
        return std::pair(begin, std::min(content.find_first_not_of(of_numbers, digit), content.size()) - begin);
    };
    const auto [begin, length] = number();
    switch (random() % 3) {
    case 0: {
        const size_t at = content.find_first_of(of_numbers.substr(0, 10), begin + random() % length);
        content[std::min(at, begin + length - 1)] = char('0' + random() % 10);
        break;
    }
    case 1: {
        const auto [from, size] = number();
        content.replace(begin, length, content.substr(from, size));
        break;
    }
    case 2: content.replace(begin, length, limits[random() % std::size(limits)]); break;
    }
    return content;
}

} // namespace spia::fuzz

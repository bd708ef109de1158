#include "tests/fuzz/mutate.h"

#include <algorithm>

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
            const size_t where = random() % 2 ? at : begin; // first: the same files on every compiler
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

} // namespace spia::fuzz

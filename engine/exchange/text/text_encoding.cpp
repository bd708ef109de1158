#include "engine/exchange/text/text_encoding.h"

#include <algorithm>
#include <cstdint>

#include "engine/core/text.h"

namespace spia {

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\'': result += "&#39;"; break;
        default: result += c;
        }
    return result;
}

std::string base64(const std::string& bytes)
{
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t given = std::min<size_t>(3, bytes.size() - i);
        uint32_t triple = 0;
        for (size_t k = 0; k < 3; ++k)
            triple = triple << 8 | (k < given ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            result += k <= given ? letters[triple >> (18 - 6 * k) & 63] : '=';
    }
    return result;
}

std::string readable(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const size_t length = utf8_length(text);
        const auto byte = static_cast<unsigned char>(text[0]);
        if (length == 0) {
            result += char(0xc0 | byte >> 6);
            result += char(0x80 | (byte & 0x3f));
        } else if (byte < 0x20 || byte == 0x7f) {
            result += ' ';
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(std::max<size_t>(length, 1));
    }
    return result;
}

} // namespace spia

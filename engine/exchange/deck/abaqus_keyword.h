#pragma once
#include <map>
#include <string>
#include <string_view>

namespace spia {

/// A keyword line of Abaqus, "*ELEMENT, type=S4R, elset=Skin". Names count without regard to case;
/// blanks in them are skipped except between quotes.
struct AbaqusKeyword {
    explicit AbaqusKeyword(std::string_view line);

    std::string name;                          ///< upper case, "SHELL SECTION"
    std::map<std::string, std::string> values; ///< by upper-case parameter; as written, without
                                               ///< quotes

    bool has(const char* parameter) const { return values.contains(parameter); }
    std::string_view operator[](const char* parameter) const ///< empty if it is not given
    {
        const auto found = values.find(parameter);
        return found == values.end() ? std::string_view() : std::string_view(found->second);
    }
};

std::string upper_case(std::string_view text);          ///< ASCII letters
std::string_view without_quotes(std::string_view text); ///< of a name that stands between them

} // namespace spia

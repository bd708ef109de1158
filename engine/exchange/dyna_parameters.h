#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "engine/exchange/deck_fields.h"

namespace spia {

/// What *PARAMETER gives a name; cards refer to it by "&name".
class DynaParameters {
public:
    void define(const DeckFields& card);                      ///< "R name", value, up to four times
    void define_expression(std::string_view line, int width); ///< "R name", expression: known only if it is a number

    static bool is_name(std::string_view field) { return field.starts_with('&'); }
    /// The text that "&name" stands for; a null pointer if it is not defined, and then it is remembered.
    const std::string* find(std::string_view field);

    std::string undefined() const; ///< "&a, &b": all that were asked for in vain; empty if none

private:
    void set(std::string_view name, std::string_view value);
    std::map<std::string, std::string> value_;
    std::set<std::string> undefined_;
};

} // namespace spia

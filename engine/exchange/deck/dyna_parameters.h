#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_fields.h"

namespace spia {

/// What *PARAMETER gives a name; cards refer to it by "&name", and by "-&name" to its negative.
/// What is local holds in its file and in those that it includes, before what is global. [LS-DYNA
/// Keyword User's Manual, volume I, *PARAMETER]
class DynaParameters {
public:
    void define(const DeckFields& card, bool local); ///< "R name", value, up to four times
    /// "R name", expression of those that are known, see dyna_expression(); of type I without what
    /// is behind the point
    void define_expression(std::string_view line, int width, bool local);

    void enter_file() { values_.emplace_back(); } ///< one that is included
    void leave_file() { values_.pop_back(); }

    static bool is_name(std::string_view field) { return field.starts_with('&') || field.starts_with("-&"); }
    /// The text that "&name" or "-&name" stands for; nothing if it is not defined, and then it is
    /// remembered.
    std::optional<std::string> find(std::string_view field);

    std::string undefined() const; ///< "&a, &b": all that were asked for in vain; empty if none

private:
    std::optional<std::string> known(const std::string& name) const; ///< in small letters
    void set(std::string_view name, std::string_view value, bool local);
    /// What is global, then what is local to each of the files that are open.
    std::vector<std::map<std::string, std::string>> values_ = {{}, {}};
    std::set<std::string> undefined_;
};

} // namespace spia

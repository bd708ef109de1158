#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// The entries of Nastran bulk data, each with its continuations: small field (8 columns), large
/// field (16 columns, *) and free field (commas), INCLUDE followed. Executive and case control
/// before BEGIN BULK are passed over.
class NastranEntries {
public:
    explicit NastranEntries(DeckLines& lines);

    bool next(); ///< false at ENDDATA or the end
    const std::string& name() const
    {
        return name_;
    } ///< upper case, without the star of a large
      ///< field
    /// Data field i, counted from 0 behind the name over all lines; without blanks around it, empty
    /// if there is none.
    std::string_view operator[](size_t i) const { return i < field_.size() ? field_[i] : std::string_view(); }
    /// @throws InputError if its continuations are not in their order, or too many, so that what
    /// was read is not all of it
    void require_whole() const;

    /// Names that comments give to properties (HyperMesh, Femap).
    const std::map<std::int64_t, std::string>& property_names() const { return property_name_; }

    bool end_missing() const
    {
        return end_missing_;
    } ///< it says where it begins and not where it
      ///< ends

private:
    bool next_line();
    bool continues() const;
    void take(std::string_view line);
    void include(std::string_view rest);
    void comment(std::string_view line);

    DeckLines& lines_;
    std::string_view line_;            // without its comment, tabs replaced
    std::deque<std::string> expanded_; // lines of this entry that had tabs
    std::string name_, mark_;          // mark: at the end of the last line
    std::vector<std::string_view> field_;
    DeckFields cut_;
    bool end_missing_; // of a deck that says where it begins
    bool in_bulk_, ahead_ = false, in_order_ = true, too_long_ = false;
    std::map<std::int64_t, std::string> property_name_;
};

} // namespace spia

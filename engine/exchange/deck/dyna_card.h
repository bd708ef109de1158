#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "engine/exchange/deck/deck_fields.h"

namespace spia {

/// How wide the columns of an LS-DYNA keyword deck are: as the manual says, at least 10 (I10=Y, %),
/// at least 20 characters (LONG=Y, +).
enum class DynaFormat { standard, i10, wide };

/// The head of a block, "*MAT_ELASTIC_TITLE +".
struct DynaKeyword {
    explicit DynaKeyword(std::string_view line, DynaFormat usual);

    std::string name;                        ///< upper case, without star and mark
    std::string_view options;                ///< what follows the name
    DynaFormat format;                       ///< by its mark %, + or -; else the usual one
    bool is(std::string_view prefix) const;  ///< this keyword, alone or with suffixes: "MAT" is not
                                             ///< "MATRIX"
    bool has(std::string_view suffix) const; ///< whether one of its words is this
};

/// I10=Y, LONG=Y or LONG=S behind *KEYWORD; the usual one where they say nothing.
DynaFormat dyna_format(std::string_view options, DynaFormat usual);

/// Cuts a card at its commas if it has any, at its blanks if it has tabs, else in columns.
/// @param widths  of the standard format
void cut_dyna_card(std::string_view line, std::initializer_list<int> widths, DynaFormat format, DeckFields& fields);

} // namespace spia

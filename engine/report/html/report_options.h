#pragma once
#include <string>

#include "engine/core/length_unit.h"
#include "engine/options/option.h"

namespace spia {

/// Which tables a report has.
struct ReportTables {
    bool key_figures = true, worst_spots = true, assumptions = true, solver = true, repairs = true;

    friend bool operator==(const ReportTables&, const ReportTables&) = default;
};

/// How the reader is told what the engine says, which speaks of mm and mentions options.
struct ReportReader {
    LengthUnit lengths = LengthUnit::mm;                        ///< mm or inch
    std::string (*words)(std::string_view) = command_line_text; ///< or window_text

    std::string told(std::string text) const;
};

/// What a report holds beside what it always has: who, when, the four great figures and what makes
/// the result poorer.
struct ReportOptions {
    std::string title;   ///< empty: the file of the part
    std::string remarks; ///< of the user, line by line; may be empty
    ReportTables tables;
    ReportReader reader;
};

} // namespace spia

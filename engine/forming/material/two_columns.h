#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace spia {

/// A table of two columns of numbers, as test machines and spreadsheets write it.
struct TwoColumns {
    std::vector<std::string> heading;      ///< lines above the first number, comments included, in
                                           ///< small letters
    std::vector<std::string> column_title; ///< the two titles, in small letters; empty if no line
                                           ///< above has two
    std::vector<double> first, second;
    std::vector<long> line; ///< of the file, counted from 1, for each row

    /// Whether a word stands in the heading by itself: "true" in "true_stress", not "psi" in
    /// "epsilon".
    /// @param word in small letters; signs like % are found anywhere
    bool heading_has(const std::string& word) const;
    /// The same of the two titles; of the heading if there are none.
    bool titles_have(const std::string& word) const;
};

/// Reads a text with two columns of numbers.
///
/// Columns are separated by ';', a tab, ',' or blanks; the decimal sign is a point, or a comma
/// where the comma does not separate. Lines without a number may stand above the first row; what
/// follows '#' is a comment; empty lines do not count.
/// @throws InputError with the file and the line: no file, no text, no numbers, a row of other than
/// two finite numbers
TwoColumns read_two_columns(const std::filesystem::path& file);

/// The same of a text. @param name of the text, for messages
TwoColumns parse_two_columns(const std::string& text, const std::string& name);

} // namespace spia

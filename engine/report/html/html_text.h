#pragma once
#include <Eigen/Core>
#include <string>

/// The words and numbers of an HTML report: one style, numbers as printers set them. What comes in
/// as plain text goes out escaped.
namespace spia {

std::string fixed(double value, int digits);       ///< no -0.0
std::string significant(double value);             ///< three digits
std::string power_of_ten(double value);            ///< HTML: 6.7 x 10^-10 with the exponent raised
std::string grouped(double value, int digits = 0); ///< 1 234 567, with narrow spaces
std::string vector_text(const Eigen::Vector3d& v); ///< (0.000, 0.000, -1.000)

/// A row of a table of facts.
std::string row(const std::string& what, const std::string& value);
/// @param html is not escaped
std::string html_row(const std::string& what, const std::string& html);
/// A heading and its table, on one page if it fits.
std::string facts(const char* heading, const std::string& rows);
/// One figure in large print. @param more a line below it
std::string tile(const std::string& what, const std::string& value, const std::string& unit, const std::string& more);

/// A whole page, for the screen and for A4 paper. @param body HTML
std::string html_page(const std::string& title, const std::string& body);

} // namespace spia

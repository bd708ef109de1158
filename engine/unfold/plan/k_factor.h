#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spia {

/// Where the neutral fibre of a bend lies: K times the thickness from its inner side, by inner
/// radius over thickness.
struct KFactor {
    std::string name = "0.5"; ///< for people: "0.44", "din6935", the file
    /// (R/t, K), ascending; between two the straight line, beyond the ends their values. One row:
    /// it holds everywhere.
    std::vector<std::pair<double, double>> table = {{0, 0.5}};

    double at(double radius_over_thickness) const;
    bool one_value() const { return table.size() == 1; }

    friend bool operator==(const KFactor&, const KFactor&) = default;
};

/// One value for all bends. @throws InputError unless it is above 0 and below 1
KFactor constant_k(double k);

/// DIN 6935 (steel, cold): the neutral fibre lies k t/2 from the inner side, k = 0.65 + 0.5 lg(R/t)
/// for R/t <= 5 and 1 beyond, so K = k/2. Below R/t = 0.05, where the formula leaves the sheet, K
/// is that of 0.05.
KFactor din6935_k();

/// Reads a table: a row per line with R/t and K, parted by spaces, tabs, a comma or a semicolon;
/// what follows a # is left out, and a first line of words. R/t ascends from 0 or above, K is above
/// 0 and below 1; 1 to 10,000 rows.
/// @throws InputError with the line at fault
KFactor parse_k_table(std::string_view text, const std::string& name);

} // namespace spia

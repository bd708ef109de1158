#include "engine/limits/forming_limit_curve.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/forming/material/two_columns.h"

namespace spia {
namespace {

// mm; of the sheets behind the formula
constexpr double least_n = 0.05, largest_n = 0.21, largest_thickness = 3;
constexpr double right_slope = 0.6, right_end = 0.2; // engineering

/// The lowest point lies at plane strain, and the curve rises from there to both sides.
void note_odd_shape(FormingLimitCurve& curve)
{
    if (curve.minor.front() > 0 || curve.minor.back() < 0)
        curve.notes.push_back("the points of the forming limit curve do not reach plane strain (minor strain 0); it is "
                              "prolonged to there");
    for (size_t i = 1; i < curve.minor.size(); ++i) {
        const bool rises = curve.major[i] > curve.major[i - 1];
        if ((curve.minor[i] <= 0 && rises) || (curve.minor[i - 1] >= 0.05 && !rises)) {
            curve.notes.push_back(fmt::format("the forming limit curve {} between the minor strains {:.3f} and {:.3f}, "
                                              "where such curves do the opposite; check its points",
                                              rises ? "rises" : "falls", curve.minor[i - 1], curve.minor[i]));
            return;
        }
    }
}

bool is_engineering(const TwoColumns& table, const std::string& name)
{
    const bool truly = table.heading_has("true") || table.heading_has("logarithmic"),
               engineering = table.heading_has("engineering") || table.heading_has("nominal");
    if (truly == engineering)
        throw InputError(fmt::format("{}: the heading {}; write \"engineering\" or \"true\" into its first line", name,
                                     truly ? "says both engineering and true"
                                           : "does not say whether the strains are engineering or true"));
    return engineering;
}

} // namespace

double engineering_strain(double logarithmic) { return std::expm1(logarithmic); }
double logarithmic_strain(double engineering) { return std::log1p(engineering); }

double FormingLimitCurve::operator()(double minor_strain) const
{
    const auto above = std::upper_bound(minor.begin(), minor.end(), minor_strain) - minor.begin();
    const size_t i = size_t(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(minor.size()) - 2));
    const double slope = (major[i + 1] - major[i]) / (minor[i + 1] - minor[i]);
    constexpr double most = 5; // a line prolonged beyond all strains of sheet must stay a number
    return std::clamp(major[i] + slope * (minor_strain - minor[i]), 0., most);
}

FormingLimitCurve keeler_brazier(double thickness, double n)
{
    if (!(thickness > 0 && std::isfinite(thickness)))
        throw InputError(fmt::format("no forming limit for a sheet of {} mm; give its thickness in mm", thickness));
    if (!(n > 0 && n < 1))
        throw InputError(
            fmt::format("no forming limit for n = {:.4g}: the sheet necks at once, or the hardening law is not "
                        "realistic; give a curve by points",
                        n));
    const double percent = (23.3 + 14.13 * thickness) * std::min(n, largest_n) / largest_n;
    const double flc0 = percent / 100, plane = logarithmic_strain(flc0);
    FormingLimitCurve curve;
    curve.formula =
        fmt::format("Keeler-Brazier: FLC0 = (23.3 + 14.13 t) n / 0.21 = {:.2f} % with t = {:.4g} mm, n = {:.4g}; "
                    "left: eps1 = ln(1 + FLC0) - eps2; right: e1 = FLC0 + 0.6 e2",
                    percent, thickness, std::min(n, largest_n));
    if (n > largest_n)
        curve.notes.push_back(
            fmt::format("n = {:.3f} is above 0.21, where Keeler-Brazier levels off: 0.21 was taken", n));
    if (n < least_n)
        curve.notes.push_back(
            fmt::format("n = {:.3g} is below that of sheets for forming ({}): the curve of Keeler-Brazier "
                        "is hardly above 0; check the hardening law or give a curve by points",
                        n, least_n));
    if (thickness > largest_thickness)
        curve.notes.push_back(fmt::format(
            "{:.4g} mm is thicker than the sheets behind Keeler-Brazier (3 mm): an extrapolation", thickness));
    curve.minor = {-plane}; // uniaxial tension of an isotropic sheet
    curve.major = {2 * plane};
    constexpr int pieces = 20; // the right branch bends a little in logarithmic strains
    for (int i = 0; i <= pieces; ++i) {
        const double e2 = right_end * i / pieces;
        curve.minor.push_back(logarithmic_strain(e2));
        curve.major.push_back(logarithmic_strain(flc0 + right_slope * e2));
    }
    return curve;
}

FormingLimitCurve curve_through(const std::vector<double>& minor, const std::vector<double>& major, bool engineering,
                                const std::string& name)
{
    if (minor.size() != major.size() || minor.size() < 2)
        throw InputError(
            fmt::format("{}: {} minor and {} major strains; a forming limit curve needs two points at least", name,
                        minor.size(), major.size()));
    FormingLimitCurve curve;
    curve.formula = fmt::format("{} points of {}", minor.size(), name);
    curve.measured = true;
    for (size_t i = 0; i < minor.size(); ++i) {
        const auto fail = [&](const std::string& what) {
            throw InputError(fmt::format("{}, point {} of the forming limit curve ({:.4g}, {:.4g}): {}", name, i + 1,
                                         minor[i], major[i], what));
        };
        if (!(std::abs(minor[i]) < 2 && major[i] < 3) || (engineering && minor[i] <= -0.95))
            fail("no sheet bears such strains; are they percent?");
        if (!(major[i] > 0) || major[i] < minor[i])
            fail("the major strain must be above 0 and not below the minor one; the columns are minor, major");
        if (i > 0 && !(minor[i] > minor[i - 1]))
            fail("the minor strains must rise from point to point");
        curve.minor.push_back(engineering ? logarithmic_strain(minor[i]) : minor[i]);
        curve.major.push_back(engineering ? logarithmic_strain(major[i]) : major[i]);
    }
    note_odd_shape(curve);
    return curve;
}

FormingLimitCurve read_forming_limit_curve(const std::filesystem::path& file)
{
    const TwoColumns table = read_two_columns(file);
    const std::string name = file.string();
    const bool engineering = is_engineering(table, name);
    const auto& title = table.column_title;
    const bool swapped = !title.empty() && title[0].find("major") != std::string::npos;
    std::vector<double> minor = swapped ? table.second : table.first, major = swapped ? table.first : table.second;
    const bool percent =
        table.titles_have("%") || table.titles_have("percent") || *std::max_element(major.begin(), major.end()) > 2;
    for (size_t i = 0; percent && i < minor.size(); ++i) {
        minor[i] /= 100;
        major[i] /= 100;
    }
    return curve_through(minor, major, engineering, file.filename().string());
}

} // namespace spia

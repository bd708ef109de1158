#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace spia {

/// Engineering strain (length / length before - 1) of a logarithmic one, and back.
double engineering_strain(double logarithmic);
double logarithmic_strain(double engineering);

/// The major strain at which a sheet begins to neck locally, over the minor strain, for straight
/// strain paths.
struct FormingLimitCurve {
    std::vector<double> minor, major; ///< logarithmic; minor rising; straight between the points
    std::string formula;              ///< how it came about, in words
    std::vector<std::string> notes;   ///< where it is not to be trusted, in words
    bool measured = false;            ///< through points, not by a formula

    /// Limit of the logarithmic major strain. Outside the points the first and last line are
    /// prolonged, within 0 to 5.
    double operator()(double minor_strain) const;
    double at_plane_strain() const { return (*this)(0); } ///< FLC0, logarithmic

    friend bool operator==(const FormingLimitCurve&, const FormingLimitCurve&) = default;
};

/// Forming limit curve of low-carbon steel by thickness t and hardening exponent n:
///   FLC0 = (23.3 + 14.13 t/mm) n / 0.21 percent, engineering; n above 0.21 counts as 0.21
///   [Keeler and Brazier 1977]
///   minor strain < 0: eps_1 = ln(1 + FLC0) - eps_2, logarithmic: the thickness at necking is one
///   and the same
///   minor strain > 0: e_1 = FLC0 + 0.6 e_2, engineering, up to e_2 = 0.2
///   [AHSS Application Guidelines]
/// Keeler and Brazier, "Relationship between laboratory material characterization and press-shop
/// formability", Microalloying 75 (1977), give FLC0. Both branches are worded so in the
/// WorldAutoSteel AHSS Application Guidelines, "Forming limit curves", of which Keeler was the
/// technical editor. The left branch is straight in logarithmic strains, not in engineering ones.
/// @param thickness mm, of the flat sheet; above 3 the curve is noted as an extrapolation
/// @param n at uniform elongation; above 0.21 it is noted that 0.21 was taken, below 0.05 that this
///         is no sheet for forming
/// @throws InputError unless both are above 0 and n is below 1
FormingLimitCurve keeler_brazier(double thickness, double n);

/// A curve through measured points.
/// @param engineering  whether the strains are engineering ones; else they are logarithmic
/// @param name  where they come from, for messages and the formula
/// @throws InputError naming the point, counted from 1: fewer than two points, minor strains that
/// do not rise, a
///         major strain not above 0 or below the minor one, strains that cannot be
FormingLimitCurve curve_through(const std::vector<double>& minor, const std::vector<double>& major, bool engineering,
                                const std::string& name);

/// Reads a table of minor and major strain (see read_two_columns()). Its heading says `engineering`
/// or `true`; the columns are minor, major unless their titles say otherwise; strains are in
/// percent if the titles say % or one exceeds 2.
/// @throws InputError with file and line
FormingLimitCurve read_forming_limit_curve(const std::filesystem::path& file);

} // namespace spia

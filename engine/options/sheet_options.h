#pragma once
#include "engine/options/option.h"

/// Of what the sheet is, how it is formed, and what it is judged by.
namespace spia::option {

inline constexpr Option material{
    .name = "material", .value = "NAME|FILE", .help = "a grade of `spia materials`, or a material file"};
inline constexpr Option thickness{.name = "thickness",
                                  .value = "MM",
                                  .help = "of the flat sheet (default: that of the part, else 1)",
                                  .label = "Thickness",
                                  .place = "the step Sheet"};
inline constexpr Option both_skins{
    .name = "skins",
    .key = "skins",
    .help = "also the strains of both skins: bending over radii added to those of the middle surface",
    .label = "Strains of both skins",
    .place = "the step Unfold"};
inline constexpr Option direction{.name = "direction",
                                  .value = "X,Y,Z",
                                  .help = "stamping direction x,y,z (default: automatic)",
                                  .label = "Direction",
                                  .place = "the step Unfold"};
inline constexpr Option process{.name = "process",
                                .value = "FILE",
                                .help =
                                    "binder, friction, drawbeads, pilots, tailored pieces, rolling direction (JSON)"};
inline constexpr Option rolling{
    .name = "rolling",
    .value = "X,Y,Z",
    .help = "rolling direction of the sheet x,y,z, projected onto the blank: r-values are measured from it, and it "
            "lies along x of the blank (default: the mean r-value in all directions, the blank lies straight)"};
inline constexpr Option k_factor{
    .name = "k-factor",
    .value = "K|din6935|FILE",
    .help = "distance of the neutral fibre from the inside of a bend, as a share of the thickness: a number, din6935 "
            "(by radius over thickness), or a file of rows R/t K (default: 0.5, the middle)",
    .label = "K factor",
    .place = "the step Unfold"};

inline constexpr Option flc{
    .name = "flc",
    .value = "keeler-brazier|FILE.csv|none",
    .help = "forming limit curve: keeler-brazier, none, a file of minor and major strains, or automatic: "
            "keeler-brazier for steel, none for other metals"};
inline constexpr Option flc_n{.name = "flc-n",
                              .key = "n",
                              .range = Range{1e-6, 1},
                              .help = "n of keeler-brazier (default: the uniform strain of the material)"};
inline constexpr Option marginal{
    .name = "marginal",
    .key = "margin",
    .value = "PERCENT",
    .range = Range{0, 1},
    .help = "safety margin below the curve, in points of engineering major strain: faces within it are marginal, "
            "within its upper half at risk (default 10, aluminium 8)"};
inline constexpr Option max_thinning{.name = "max-thinning",
                                     .key = "max_thinning",
                                     .value = "PERCENT",
                                     .range = Range{0, 1},
                                     .help = "allowable thinning, of the initial thickness",
                                     .label = "Allowed thinning",
                                     .place = "Forming limits"};
inline constexpr Option max_thickening{.name = "max-thickening",
                                       .key = "max_thickening",
                                       .value = "PERCENT",
                                       .range = Range{0, 10},
                                       .help = "allowable thickening, of the initial thickness",
                                       .label = "Allowed thickening",
                                       .place = "Forming limits"};

inline constexpr Choice stress_measures[] = {{"engineering"}, {"true"}};
inline constexpr Option stress_measure{.name = "data",
                                       .key = "kind",
                                       .choices = stress_measures,
                                       .help = "stress and strain (default: as the heading says)",
                                       .label = "Stress and strain",
                                       .place = "the fields above"};
inline constexpr Choice strain_units[] = {{"fraction"}, {"percent"}};
inline constexpr Option strain_unit{.name = "strain",
                                    .key = "in_percent",
                                    .choices = strain_units,
                                    .help = "unit of strain (default: by the heading, else by its size)"};
inline constexpr Option young{.name = "young",
                              .key = "young_MPa",
                              .value = "MPA",
                              .range = Range{1e3, 1e6},
                              .help = "Young's modulus (default: the slope of the first rows)",
                              .label = "Young's modulus",
                              .place = "the fields above"};
inline constexpr Option poisson{
    .name = "poisson", .key = "poisson", .range = Range{-0.99, 0.5}, .help = "Poisson's ratio"};
inline constexpr Option density{.name = "density", .key = "density_kg_m3", .range = Range{1, 9e4}, .help = "kg/m3"};

/// All of this file.
inline constexpr const Option* of_sheets[] = {
    &material, &thickness,    &both_skins,     &direction,      &process,     &rolling, &k_factor, &flc,    &flc_n,
    &marginal, &max_thinning, &max_thickening, &stress_measure, &strain_unit, &young,   &poisson,  &density};

} // namespace spia::option

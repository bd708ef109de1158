#pragma once
#include "engine/options/option.h"

/// The grid on the blank, and the surface through it or within a tolerance.
namespace spia::option {

inline constexpr Option grid{.name = "grid",
                             .value = "NxM",
                             .help = "cells of the quad grid (default: automatic)",
                             .label = "Cells",
                             .place = "the step Corners and grid",
                             .patches = Patches::one};
inline constexpr Option corners{.name = "corners",
                                .value = "a,b,c,d",
                                .help = "four vertices of the outer boundary, numbers as in the file, from 0",
                                .place = "the corners in the step Corners and grid",
                                .patches = Patches::one};

// A number of cells that is 0 follows from the other one.
inline constexpr Option columns{.name = "",
                                .key = "columns",
                                .range = Range{0, 2000},
                                .help = "cells along u",
                                .label = "Columns",
                                .patches = Patches::one};
inline constexpr Option rows{.name = "",
                             .key = "rows",
                             .range = Range{0, 2000},
                             .help = "cells along v",
                             .label = "Rows",
                             .patches = Patches::one};
inline constexpr Option cells{.name = "",
                              .key = "cells",
                              .range = Range{1, 2000},
                              .help = "cells along the longer sides, where they are square",
                              .label = "Cells",
                              .patches = Patches::one};
inline constexpr Option smoothing{.name = "",
                                  .key = "smoothing",
                                  .range = Range{0, 100'000},
                                  .help = "maximum number of smoothing passes over a Coons grid with folded cells",
                                  .label = "Smoothing",
                                  .patches = Patches::one};
inline constexpr Choice grid_methods[] = {
    {"automatic", {}, "Coons, or harmonic where that folds"},
    {"coons", "Coons", "lines blended between opposite sides as in the paper, smoothed where cells fold"},
    {"harmonic", {}, "lines of a harmonic map (as heat would flow from side to side), without folded cells"}};
inline constexpr Option grid_method{.name = "grid-method",
                                    .key = "method",
                                    .choices = grid_methods,
                                    .help = "how the lines of the grid are laid",
                                    .label = "Method",
                                    .patches = Patches::one};
inline constexpr Option line_grading{
    .name = "to-bends",
    .key = "to_bends",
    .value = "0-0.9",
    .range = Range{0, 0.9},
    .help = "share of the grid lines that are moved to the bends; the others are evenly spaced. 0.5 suits a flat part "
            "with narrow bends",
    .label = "Lines to bends",
    .patches = Patches::one};
inline constexpr Option even_cells{
    .name = "even-cells",
    .key = "even_cells",
    .help = "move the inner nodes of the grid towards right angles; no cell folds on the way",
    .label = "Improve cell angles",
    .patches = Patches::one};

inline constexpr Option tolerance{
    .name = "tolerance",
    .key = "tolerance",
    .value = "MM",
    .range = Range{1e-9, 1e9},
    .help = "mm, two-sided, between the surface and the part: least squares with knots where they are needed (default: "
            "1/1000 of the part's diagonal; of one patch that is asked for the surface through the nodes of the grid)",
    .label = "Within a tolerance",
    .place = "the step NURBS surface"};
inline constexpr Option degree{.name = "degree",
                               .value = "U[,V]",
                               .range = Range{2, 5},
                               .help = "of the surface along u and v, 2 to 5; one number for both",
                               .label = "Degree"};
inline constexpr Option degree_u{
    .name = "", .key = "degree_u", .range = degree.range, .help = "of the surface along u"};
inline constexpr Option degree_v{
    .name = "", .key = "degree_v", .range = degree.range, .help = "of the surface along v"};
inline constexpr Choice curve_ends[] = {
    {"averaged", "averaged knots", "free at the border, accurate up to the border"},
    {"clamped", {}, "with the slope estimated from the part, accurate up to the border"},
    {"natural", {}, "without curvature at the border as in the paper (degree 3 only), less accurate there"}};
inline constexpr Option ends{.name = "ends",
                             .key = "ends",
                             .choices = curve_ends,
                             .help = "of the surface at its borders",
                             .label = "End conditions",
                             .patches = Patches::one};
inline constexpr Choice fit_parameter_choices[] = {{"blank"}, {"corrected"}};
inline constexpr Option fit_parameters{
    .name = "fit-parameters",
    .key = "parameters",
    .choices = fit_parameter_choices,
    .help = "within a tolerance: those of the blank, or corrected: points slide along the surface while it is fitted, "
            "which then needs fewer control points but gives up the places in the blank",
    .label = "Fewer control points",
    .patches = Patches::one,
    .within_tolerance = true};
inline constexpr Option max_control_points{
    .name = "max-control-points",
    .key = "max_control_points",
    .range = Range{16, 4'000'000},
    .help = "of the surface within a tolerance: the fit stops there even if the tolerance is not reached",
    .label = "Max control points",
    .place = "the step NURBS surface",
    .within_tolerance = true};
inline constexpr Option fill_holes{
    .name = "fill-holes",
    .help = "the surface covers the holes of the part; else IGES and STEP have it trimmed by them (files for "
            "isogeometric analysis cannot)",
    .patches = Patches::one};
inline constexpr Option deform{
    .name = "deform",
    .value = "FILE",
    .help = "moves control points of the finished surface, or all of it by a lattice around it (JSON, "
            "spia.deformation/1)"};

inline constexpr Choice layouts[] = {{"best", {}, {}, "\"automatic\" in the step NURBS surface"},
                                     {"one", {}, {}, "\"one patch\" in the step NURBS surface"},
                                     {"auto", {}, {}, "\"several patches\" in the step NURBS surface"},
                                     {"FILE", {}, {}, "pick their ends with the tool Vertex"}};
inline constexpr Option patches{
    .name = "patches",
    .value = "best|one|auto|FILE",
    .choices = layouts,
    .help =
        "best: one patch if it is within the tolerance, by default 1/1000 of the part's diagonal, with no fold and "
        "no more control points than the part has vertices (552 in any case), else several. one: over the blank with its holes "
        "filled, without a tolerance through the grid; also where an option of one patch is given. auto: "
        "four-sided patches around the holes and along sharp edges, which share their sides. FILE: {\"cuts\": "
        "[[12, 40], ...], \"corners\": [...], \"edge_deg\": 45, \"smooth_joins\": true}, vertices of the part's "
        "file",
    .label = "Made of",
    .place = "the step NURBS surface"};
inline constexpr Option patch_edges{
    .name = "patch-edges",
    .key = "edge_deg",
    .value = "DEG",
    .range = Range{1, 180},
    .help = "patches end on edges over which the sheet turns more than this (45; 20 where the tolerance is "
            "missed); 180: on none. Not where cuts or corners are given",
    .label = "Edges from",
    .place = "the step NURBS surface",
    .patches = Patches::several};
inline constexpr Option smooth_joins{
    .name = "smooth-joins",
    .key = "smooth_joins",
    .help = "smooth the joins, as far as the tolerance allows; edges of the part (joins with more than "
            "10 degrees) stay sharp",
    .label = "Smooth joins",
    .place = "the step NURBS surface",
    .patches = Patches::several};

/// All of this file.
inline constexpr const Option* of_surfaces[] = {
    &grid,       &corners,   &columns, &rows,        &cells,       &smoothing, &grid_method,    &line_grading,
    &even_cells, &tolerance, &degree,  &degree_u,    &degree_v,    &ends,      &fit_parameters, &max_control_points,
    &fill_holes, &deform,    &patches, &patch_edges, &smooth_joins};

} // namespace spia::option

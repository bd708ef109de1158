#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/exchange/lines/dxf_options.h"
#include "engine/options/described.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/session.h"

namespace spia::cli {

/// How a CAD file becomes triangles.
struct CadArguments {
    std::optional<double> sewing, deflection; ///< mm; not given: found from the part
    std::optional<double> angle_deg;
    bool skip_bad_faces = false;
};

/// What a DXF file of the blank is made of.
struct DxfArguments {
    std::string curves = "arcs", version = "r2000";
    double tolerance = DxfOptions{}.tolerance; ///< mm
};

/// @throws InputError if one makes no sense
DxfOptions dxf_options(const DxfArguments& arguments);

/// Of the part's triangles.
struct RemeshArguments {
    bool wanted = false, unwanted = false;
    std::optional<double> size, tolerance;             ///< mm; not given: chosen from the part
    std::optional<double> least_angle_deg, edge_ratio; ///< targets for the triangles, remeshed or
                                                       ///< not
};

/// What is read of a part's file, and how.
struct ReadArguments {
    std::string unit, skin;         ///< of a solid: outer, inner, middle; empty: middle
    std::vector<std::string> parts; ///< of a solver deck, ids or names
    std::string seam = "auto";      ///< auto, none, or a file of paths
    std::optional<double> weld;     ///< mm, up to which open edges are joined; 0: what is at one
                                    ///< place; not given: as the format needs
    bool keep_largest = false;
    CadArguments cad;
    RemeshArguments remesh;
};

/// @throws InputError if something is given that the part's file has no use for
ReadOptions read_options(const ReadArguments& arguments, const std::filesystem::path& part);

struct RunArguments {
    std::filesystem::path part, folder = "spia-out", json, report, process;
    ReadArguments read;
    std::string material = "mild_steel";
    std::string k_factor;            ///< a number, a name or a file; empty: 0.5
    std::optional<double> thickness; ///< mm; not given: that of the part, else 1
    std::string cells;               ///< NxM; empty: automatic
    std::vector<int> corners;
    std::vector<double> direction, rolling;
    GridOptions grid; ///< without the numbers of cells
    CurveEnds ends = CurveEnds::averaged_knots;
    FitParameters fit_parameters = FitParameters::blank;
    std::optional<double> tolerance;  ///< mm, of the surface; not given: of one patch none
    std::vector<int> degree = {3, 3}; ///< of the surface, along u and v
    int max_control_points = FitOptions{}.max_control_points;
    bool fill_holes = false;
    std::string deform;                     ///< file of a deformation of the finished surface;
                                            ///< empty: none
    std::string patches = "best";           ///< best, one, auto, or a file of cuts
    bool smooth_joins = false;              ///< of patches
    std::optional<double> patch_edges = {}; ///< degrees, of edges on which patches end
    std::vector<std::string> formats;
    std::string export_unit = "mm", name; ///< of the files; empty name: the part's
    std::vector<std::string> glb_nodes = {"part", "blank", "quad_mesh", "surface", "control_net"};
    std::vector<std::string> csv_tables = {"fields", "outline", "faces"};
    std::string flc = "automatic"; ///< automatic, keeler-brazier, none, or a file of points
    std::optional<double> flc_n;
    std::optional<double> marginal;                ///< percent
    double max_thinning = 25, max_thickening = 10; ///< percent
    bool strict = false, skins = false;
    DxfArguments dxf;
};

/// The direction of --rolling; none: not asked for. @throws InputError if it is none
std::optional<Eigen::Vector3d> rolling_direction(const std::vector<double>& numbers);

/// Runs the whole chain on a part, writes the files and prints a summary.
/// @returns 0, or 1 if the result has shortcomings and `strict` was asked for
int run(const RunArguments& arguments);

struct InfoArguments {
    std::filesystem::path part, json;
    ReadArguments read;
};

/// Prints what the mesh doctor says. @returns 0, or 2 if the part would be refused
int info(const InfoArguments& arguments);

struct CompareArguments {
    std::filesystem::path part, json;
    ReadArguments read;
    std::string material = "mild_steel";
    std::optional<double> thickness; ///< mm; not given: that of the deck, else 1
    std::vector<double> direction;
    std::vector<std::string> methods;
    bool markdown = false;
};

/// Unfolds a part by several methods and prints how their maps compare.
/// @returns 0, or 3 if no method had a result
int compare(const CompareArguments& arguments);

struct UnfoldArguments {
    std::filesystem::path part, script, folder, json;
    std::filesystem::path to_part, to_blank; ///< files of lines to carry over
    ReadArguments read;
    std::vector<std::string> formats;
    bool automatic = false;
    std::string material = "mild_steel", name; ///< of the files; empty: the part's
    std::string k_factor;                      ///< as for run
    /// direction of the sheet; empty: none
    std::vector<double> rolling;
    /// mm; not given: that of the deck, else 1
    std::optional<double> thickness;
    int root = 0;                             ///< of --auto: the region that stays, from 1; 0: the
                                              ///< largest flat one
    std::string redo;                         ///< "auto", or the step, from 1, from which on a
                                              ///< script is run again; empty: all of it
    std::string surface;                      ///< grid and surface of which blank: "steps",
                                              ///< "polished"; empty: none
    std::vector<std::string> surface_formats; ///< of output_formats(); usual_formats() unless
                                              ///< others are asked for
    std::optional<double> tolerance;          ///< mm, of that surface; not given: it runs through
                                              ///< the grid
    /// also the blank of the whole part at once, started from that of the steps
    bool polish = false;
    bool strict = false;
    DxfArguments dxf;
};

/// Unfolds a part step by step, as a script says or by steps of its own, writes the states and
/// prints a summary.
/// @returns 0, 1 if the result is poorer or the script did not fit and `strict` was asked for, or 3
/// if a step had no result
int unfold(const UnfoldArguments& arguments);

/// Prints the built-in grades. @returns 0
int materials();

struct FitArguments {
    std::filesystem::path table, out;
    std::string law = "best", name; ///< empty name: the stem of `out`
    std::string data, strain;       ///< engineering or true; fraction or percent; empty: as the
                                    ///< heading says
    std::optional<double> young;    ///< MPa
    double poisson = 0.3, density = 7850;
    std::vector<double> r = {1, 1, 1};
};

/// Fits the hardening laws to a tensile test, prints them and writes a material file. @returns 0
int fit_material(const FitArguments& arguments);

/// @throws InputError if a K factor and a skin other than the middle surface are asked for
void require_one_surface(const std::string& k_factor, const std::string& skin);
/// Where the thickness of the sheet is from; empty if that needs no word.
std::string describe_thickness(const std::optional<double>& asked, const PartFile& part);

/// Where the materials and sample parts lie: SPIA_ASSETS, or the folder the program was built from.
std::filesystem::path assets();

} // namespace spia::cli

namespace spia {

template <>
inline constexpr auto described<cli::RunArguments> =
    std::tuple{describe(option::k_factor, &cli::RunArguments::k_factor),
               describe(option::material, &cli::RunArguments::material),
               describe(option::thickness, &cli::RunArguments::thickness),
               describe(option::both_skins, &cli::RunArguments::skins),
               describe(option::flc, &cli::RunArguments::flc),
               describe(option::flc_n, &cli::RunArguments::flc_n),
               describe(option::marginal, &cli::RunArguments::marginal),
               describe(option::max_thinning, &cli::RunArguments::max_thinning),
               describe(option::max_thickening, &cli::RunArguments::max_thickening),
               describe(option::process, &cli::RunArguments::process),
               describe(option::grid, &cli::RunArguments::cells),
               describe(option::corners, &cli::RunArguments::corners),
               describe(option::tolerance, &cli::RunArguments::tolerance),
               describe(option::patches, &cli::RunArguments::patches),
               describe(option::patch_edges, &cli::RunArguments::patch_edges),
               describe(option::smooth_joins, &cli::RunArguments::smooth_joins),
               describe(option::deform, &cli::RunArguments::deform),
               describe(option::degree, &cli::RunArguments::degree),
               describe(option::ends, &cli::RunArguments::ends),
               describe(option::fit_parameters, &cli::RunArguments::fit_parameters),
               describe(option::max_control_points, &cli::RunArguments::max_control_points),
               describe(option::fill_holes, &cli::RunArguments::fill_holes)};

} // namespace spia

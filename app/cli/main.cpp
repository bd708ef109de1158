#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/compare/compare.h"
#include "engine/core/error.h"
#include "engine/pipeline/outputs.h"
#include "engine/pipeline/unfold_outputs.h"

namespace {

constexpr const char* part_files =
    "STL, OBJ, PLY, OFF, glTF or GLB file, CAD file (.step .stp .iges .igs .brep), or solver deck (LS-DYNA .k .key .dyn, Nastran .bdf .nas .dat, Abaqus and CalculiX "
    ".inp, Gmsh .msh, Radioss .rad)";

void add_parts(CLI::App* command, std::vector<std::string>& parts)
{
    command
        ->add_option(
            "--part", parts,
            "of a solver deck: the part, property or element set to take, by id or name; of a CAD file: a body or "
            "assembly by its number or name as `spia info` lists them, e.g. body:2, or faces by number from 0, e.g. 7 or "
            "10-19 (default: all)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("ID|NAME");
}

void add_cad(CLI::App* command, spia::cli::CadArguments& cad)
{
    command
        ->add_option("--sewing", cad.sewing,
                     "of a CAD file: gaps between faces up to this are closed, 0: none (default: found from the gaps)")
        ->type_name("MM");
    command
        ->add_option(
            "--deflection", cad.deflection,
            "of a CAD file: distance between triangles and faces (default: 1/2000 of the diagonal of a box around the faces and their control points)")
        ->type_name("MM");
    command
        ->add_option("--angle", cad.angle_deg,
                     "of a CAD file: between the tangents at both ends of a chord (default 20)")
        ->type_name("DEG");
    command->add_flag("--skip-bad-faces", cad.skip_bad_faces,
                      "of a CAD file: leave out faces that cannot be read or meshed, and take the rest");
}

void add_skin(CLI::App* command, std::string& skin)
{
    command
        ->add_option(
            "--skin", skin,
            "of a solid of sheet: the surface that stands for it, outer (outside of its bends), inner or middle "
            "(default: middle)")
        ->check(CLI::IsMember({"outer", "inner", "middle"}));
}

void add_k_factor(CLI::App* command, std::string& k_factor)
{
    command
        ->add_option(
            "--k-factor", k_factor,
            "where the neutral fibre of bends lies, as a share of the thickness from their inner side: a number, "
            "din6935 (by radius over thickness), or a file of rows R/t K (default: 0.5, the middle)")
        ->type_name("K|din6935|FILE");
}

void add_thickness(CLI::App* command, std::optional<double>& thickness, const char* text)
{
    command->add_option("--thickness", thickness, text)->type_name("MM");
}

void add_rolling(CLI::App* command, std::vector<double>& rolling)
{
    command
        ->add_option(
            "--rolling", rolling,
            "rolling direction of the sheet x,y,z, seen square to the blank: r-values apply along it, and the "
            "blank lies with it along x (default: no r-values of their own directions, the blank lies straight)")
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z");
}

void add_dxf(CLI::App* command, spia::cli::DxfArguments& dxf)
{
    command
        ->add_option(
            "--dxf-curves", dxf.curves,
            "what the outline is in the DXF file of the blank: circles, arcs and lines where they are found, else straight "
            "pieces (arcs) or splines (splines); or straight pieces throughout (polylines)")
        ->check(CLI::IsMember({"arcs", "polylines", "splines"}))
        ->capture_default_str();
    command->add_option("--dxf-version", dxf.version, "of that file: r12 (AC1009, no splines) or r2000 (AC1015)")
        ->check(CLI::IsMember({"r12", "r2000"}))
        ->capture_default_str();
    command
        ->add_option("--dxf-tolerance", dxf.tolerance, "how far a place of the outline may be from what is drawn there")
        ->type_name("MM")
        ->capture_default_str();
}

void add_remesh(CLI::App* command, spia::cli::RemeshArguments& remesh)
{
    CLI::Option* wanted = command->add_flag(
        "--remesh", remesh.wanted,
        "replace the triangles by well-shaped ones that stay within a tolerance; deviations are those from the original");
    command
        ->add_flag(
            "--no-remesh", remesh.unwanted,
            "keep the triangles of CAD faces also where they are needles on a surface that does not unroll; such "
            "parts are remeshed else")
        ->excludes(wanted);
    command
        ->add_option("--remesh-size", remesh.size,
                     "length of their edges where nothing asks for shorter ones (default: the part's median edge, from "
                     "1/250 to 1/40 of its diagonal)")
        ->type_name("MM")
        ->needs(wanted);
    command
        ->add_option("--remesh-tolerance", remesh.tolerance,
                     "largest distance of both meshes anywhere (default: 1/1000 of the part's diagonal)")
        ->type_name("MM")
        ->needs(wanted);
    command
        ->add_option("--min-angle", remesh.least_angle_deg,
                     "a target: triangles with smaller angles are a shortcoming, the worst is named")
        ->type_name("DEG");
    command
        ->add_option("--max-edge-ratio", remesh.edge_ratio,
                     "a target likewise, for the longest edge of a triangle over its shortest")
        ->type_name("RATIO");
}

void add_weld(CLI::App* command, std::optional<double>& gap)
{
    command
        ->add_option("--weld", gap,
                     "join vertices at one place (always done for STL and glTF), with a number also across gaps up to "
                     "it; `spia info` proposes one where it finds a crack")
        ->check(CLI::Range(0., 1e3))
        ->type_name("[MM]");
}

/// The words of the command line. The number behind --weld may be left out, which CLI11 would take
/// the next word for.
std::vector<std::string> arguments_of(int count, char** values)
{
    std::vector<std::string> words;
    for (int i = 1; i < count; ++i) {
        words.emplace_back(values[i]);
        double number = 0;
        if (words.back() != "--weld")
            continue;
        if (i + 1 < count && CLI::detail::lexical_cast(std::string(values[i + 1]), number))
            words.back() += fmt::format("={}", values[++i]);
        else
            words.back() += "=0";
    }
    return words;
}

enum ExitCode { fine = 0, poorer = 1, bad_input = 2, no_solution = 3, bad_file = 4, internal = 5, cancelled = 130 };

int failed(ExitCode code, std::string_view what)
{
    fmt::print(stderr, "spia: {}\n", spia::cli::shown(what));
    return code;
}

} // namespace

int main(int count, char** values)
{
    using namespace spia;
    // Messages of libraries belong to the standard error; the standard output is for results.
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("spia", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
    spdlog::set_level(spdlog::level::warn);

    CLI::App app{
        "SPIA: from a stamped sheet-metal part to its flat blank, with the strains that forming costs, and to a "
        "NURBS surface."};
    app.set_version_flag("--version", SPIA_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 poorer result with --strict, 2 the input is at fault, 3 no solution, 4 a file cannot "
        "be read or written, 130 cancelled (`unfold` leaves the states of the steps that are done).");
    int threads = 0;

    cli::RunArguments run;
    run.formats = usual_formats();
    CLI::App* run_command = app.add_subcommand("run", "Unfold a part and write blank, strains and surface");
    run_command->add_option("part", run.part, part_files)->required()->type_name("PART");
    run_command->add_option("--out", run.folder, "folder for the files")->type_name("DIR")->capture_default_str();
    add_parts(run_command, run.parts);
    add_cad(run_command, run.cad);
    add_skin(run_command, run.skin);
    add_k_factor(run_command, run.k_factor);
    add_remesh(run_command, run.remesh);
    run_command->add_option("--unit", run.unit, "length unit of the file (default mm, glTF: m)")
        ->check(CLI::IsMember({"mm", "cm", "m", "inch"}));
    add_weld(run_command, run.weld);
    run_command->add_flag("--keep-largest", run.keep_largest,
                          "leave out all but the largest piece, and ribs on edges of three faces");
    run_command
        ->add_option(
            "--seam", run.seam,
            "where a closed part, a tube or a part with handles is cut open: auto (a short seam), none, corners (where a few cuts let it unroll), or a "
            "file {\"seam\": [[a, b, ...]]} of vertices, numbers as in the part's file, from 0")
        ->type_name("auto|none|corners|FILE")
        ->capture_default_str();
    run_command->add_option("--material", run.material, "a grade of `spia materials`, or a material file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    add_thickness(run_command, run.thickness, "of the flat sheet (default: that of the part, else 1)");
    run_command->add_flag("--skins", run.skins,
                          "also the strains of both skins: bending over radii added to those of the middle surface");
    run_command
        ->add_option("--flc", run.flc,
                     "forming limit curve: keeler-brazier, none, a file of minor and major strains, or automatic: "
                     "keeler-brazier for steel, none else")
        ->type_name("keeler-brazier|FILE.csv|none")
        ->capture_default_str();
    run_command->add_option("--flc-n", run.flc_n, "n of keeler-brazier (default: the uniform strain of the material)")
        ->check(CLI::Range(1e-3, 0.99));
    run_command
        ->add_option(
            "--marginal", run.marginal,
            "points of engineering major strain below the curve that are marginal, the upper half of them at risk "
            "(default 10, aluminium 8)")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PERCENT");
    run_command->add_option("--max-thinning", run.max_thinning, "allowable thinning")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PERCENT")
        ->capture_default_str();
    run_command->add_option("--max-thickening", run.max_thickening, "allowable thickening")
        ->check(CLI::Range(0.0, 1000.0))
        ->type_name("PERCENT")
        ->capture_default_str();
    run_command
        ->add_option("--process", run.process,
                     "binder, friction, drawbeads, pilots, tailored pieces, rolling direction (JSON)")
        ->type_name("FILE");
    run_command->add_option("--direction", run.direction, "stamping direction x,y,z (default: automatic)")
        ->delimiter(',')
        ->expected(3);
    add_rolling(run_command, run.rolling);
    run_command->add_option("--grid", run.grid, "cells of the quad grid (default: automatic)")->type_name("NxM");
    run_command->add_option("--grid-method", run.grid_method, "automatic, coons (the paper's, may fold) or harmonic")
        ->check(CLI::IsMember({"automatic", "coons", "harmonic"}))
        ->capture_default_str();
    run_command
        ->add_option(
            "--to-bends", run.line_grading,
            "share of the lines of the grid that go where the part bends; the others lie evenly (of one patch only)")
        ->check(CLI::Range(0., 0.9))
        ->type_name("0-0.9")
        ->capture_default_str();
    run_command->add_flag(
        "--even-cells", run.even_cells,
        "move the inner nodes of the grid towards right angles; no cell folds on the way (of one patch only)");
    run_command
        ->add_option("--corners", run.corners, "four vertices of the outer boundary, numbers as in the file, from 0")
        ->delimiter(',')
        ->expected(4)
        ->type_name("a,b,c,d");
    run_command
        ->add_option("--tolerance", run.tolerance,
                     "mm, two-sided, between the surface and the part: least squares with knots where they are needed "
                     "(default: the surface through the nodes of the grid)")
        ->check(CLI::PositiveNumber)
        ->type_name("MM");
    run_command
        ->add_option(
            "--patches", run.patches,
            "one patch over the blank with its holes filled, auto: four-sided patches around the holes and along sharp "
            "edges, which share their sides, or a file {\"cuts\": [[12, 40], ...], \"corners\": [...], \"edge_deg\": 45, "
            "\"smooth_joins\": true}, vertices of the file")
        ->type_name("auto|one|FILE")
        ->capture_default_str();
    run_command
        ->add_option(
            "--patch-edges", run.patch_edges,
            "of patches: they end on edges over which the sheet turns more than this (45; 20 where the tolerance is missed); "
            "180: on none. Not where cuts or corners are given")
        ->type_name("DEG")
        ->check(CLI::Range(1.0, 180.0));
    run_command->add_flag(
        "--smooth-joins", run.smooth_joins,
        "of patches: take the angles out of their joins, as far as the tolerance allows; edges of the part "
        "(joins with more than 10 degrees) stay");
    run_command
        ->add_option(
            "--deform", run.deform,
            "moves control points of the finished surface, or all of it by a lattice around it (JSON, spia.deformation/1)")
        ->type_name("FILE");
    run_command->add_option("--degree", run.degree, "of the surface along u and v, 2 to 5; one number for both")
        ->delimiter(',')
        ->expected(1, 2)
        ->check(CLI::Range(2, 5))
        ->type_name("U[,V]")
        ->capture_default_str();
    run_command
        ->add_option("--ends", run.ends,
                     "of the surface: averaged knots, clamped by estimated tangents, or natural as in the paper")
        ->check(CLI::IsMember({"averaged", "clamped", "natural"}))
        ->capture_default_str();
    run_command
        ->add_option(
            "--fit-parameters", run.fit_parameters,
            "within a tolerance: those of the blank, or corrected, which follows the part with fewer knots but gives up "
            "the places in the blank")
        ->check(CLI::IsMember({"blank", "corrected"}))
        ->capture_default_str();
    run_command->add_option("--max-control-points", run.max_control_points, "of the surface within a tolerance")
        ->check(CLI::Range(16, 4'000'000))
        ->capture_default_str();
    run_command->add_flag(
        "--fill-holes", run.fill_holes,
        "the surface covers the holes of the part; else IGES and STEP have it trimmed by them (files for "
        "isogeometric analysis cannot)");
    run_command
        ->add_option(
            "--formats", run.formats,
            "files to write; for isogeometric analysis the surface with thickness and plastic strain: gismo (G+Smo XML), mfem, "
            "geopdes (no fields), iga-k (LS-DYNA, mean thickness); for solver decks, with their ids: dynain (LS-DYNA), nastran, mapping (CSV): "
            "thickness and plastic strain of the elements; blank-k, -bdf, -inp, -msh: the blank as a mesh")
        ->delimiter(',')
        ->check(CLI::IsMember(output_formats()))
        ->type_name("LIST")
        ->capture_default_str();
    run_command
        ->add_option("--export-unit", run.export_unit,
                     "of IGES, STEP, isogeometric files, DXF, CSV and VTU (glTF: always metres)")
        ->check(CLI::IsMember({"mm", "cm", "m", "inch"}))
        ->capture_default_str();
    add_dxf(run_command, run.dxf);
    run_command->add_option("--glb-nodes", run.glb_nodes, "what the GLB file shows")
        ->delimiter(',')
        ->check(CLI::IsMember(run.glb_nodes))
        ->type_name("LIST")
        ->capture_default_str();
    run_command->add_option("--csv-tables", run.csv_tables, "which CSV files")
        ->delimiter(',')
        ->check(CLI::IsMember(run.csv_tables))
        ->type_name("LIST")
        ->capture_default_str();
    run_command->add_option("--name", run.name, "of the files, without ending (default: the part's)");
    run_command->add_option("--json", run.json, "write the figures of the run")->type_name("FILE");
    run_command
        ->add_option("--report", run.report,
                     "write a report to print or pass on: figures, warnings, assumptions, pictures, in one HTML file "
                     "(in inch with --export-unit inch, else in mm)")
        ->type_name("FILE.html");
    run_command->add_flag("--strict", run.strict, "exit 1 if the result has shortcomings");
    run_command->add_option("--threads", threads, "most threads (default: all); the result is the same for any")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));

    cli::InfoArguments info;
    CLI::App* info_command =
        app.add_subcommand("info", "Examine a part: what it is, what is wrong with it, what to do");
    info_command->add_option("part", info.part, part_files)->required()->type_name("PART");
    add_parts(info_command, info.parts);
    add_cad(info_command, info.cad);
    add_skin(info_command, info.skin);
    add_remesh(info_command, info.remesh);
    info_command->add_option("--unit", info.unit, "length unit of the file")
        ->check(CLI::IsMember({"mm", "cm", "m", "inch"}));
    add_weld(info_command, info.weld);
    info_command->add_flag("--keep-largest", info.keep_largest,
                           "leave out all but the largest piece, and ribs on edges of three faces");
    info_command
        ->add_option(
            "--seam", info.seam,
            "where a closed part, a tube or a part with handles is cut open: auto (a short seam), none, corners (where a few cuts let it unroll), or a "
            "file {\"seam\": [[a, b, ...]]} of vertices, numbers as in the part's file, from 0")
        ->type_name("auto|none|corners|FILE")
        ->capture_default_str();
    info_command->add_option("--json", info.json, "write the findings")->type_name("FILE");

    cli::CompareArguments comparison;
    for (const FlatMethod method : flat_methods)
        comparison.methods.emplace_back(name(method));
    CLI::App* compare_command = app.add_subcommand(
        "compare", "Unfold a part by this solver, ABF++, ARAP, LSCM and SLIM; compare time, memory and distortion");
    compare_command->add_option("part", comparison.part, part_files)->required()->type_name("PART");
    compare_command->add_option("--methods", comparison.methods, "which, in this order")
        ->delimiter(',')
        ->check(CLI::IsMember(comparison.methods))
        ->type_name("LIST")
        ->capture_default_str();
    compare_command->add_flag("--markdown", comparison.markdown, "print the table as Markdown");
    compare_command->add_option("--json", comparison.json, "write the figures, with their definitions")
        ->type_name("FILE");
    compare_command->add_option("--material", comparison.material, "for this solver: a grade, or a material file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    add_thickness(compare_command, comparison.thickness,
                  "for this solver: of the flat sheet (default: that of the part, else 1)");
    compare_command
        ->add_option("--direction", comparison.direction,
                     "for this solver: stamping direction x,y,z (default: automatic)")
        ->delimiter(',')
        ->expected(3);
    compare_command
        ->add_option(
            "--seam", comparison.seam,
            "where a closed part, a tube or a part with handles is cut open, for all methods: auto (a short "
            "seam), none, or a file {\"seam\": [[a, b, ...]]} of vertices, numbers as in the part's file, from 0")
        ->type_name("auto|none|corners|FILE")
        ->capture_default_str();
    add_parts(compare_command, comparison.parts);
    add_cad(compare_command, comparison.cad);
    add_skin(compare_command, comparison.skin);
    compare_command->add_option("--unit", comparison.unit, "length unit of the file")
        ->check(CLI::IsMember({"mm", "cm", "m", "inch"}));
    add_weld(compare_command, comparison.weld);
    compare_command->add_flag("--keep-largest", comparison.keep_largest,
                              "leave out all but the largest piece, and ribs on edges of three faces");
    compare_command->add_option("--threads", threads, "most threads (default: all); the result is the same for any")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));

    cli::UnfoldArguments unfolding;
    CLI::App* unfold_command = app.add_subcommand(
        "unfold", "Unfold a part step by step: outer flanges first, each onto the face of its neighbour");
    unfold_command->add_option("part", unfolding.part, part_files)->required()->type_name("PART");
    CLI::Option* by_script =
        unfold_command->add_option("--script", unfolding.script, "the steps (JSON, engine/pipeline/README.md)")
            ->type_name("FILE");
    unfold_command
        ->add_flag("--auto", unfolding.automatic,
                   "steps of its own; with --out they are written as a script, to be edited")
        ->excludes(by_script);
    unfold_command
        ->add_option("--redo", unfolding.redo,
                     "with --script: the states of steps that were done are taken from an earlier run with this --out; "
                     "auto: as many as are the same, N: those before step N")
        ->type_name("auto|N");
    unfold_command
        ->add_option("--root", unfolding.root, "with --auto: the region that stays (default: the largest flat one)")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000))
        ->excludes(by_script);
    unfold_command
        ->add_option("--out", unfolding.folder,
                     "folder for the states, trim lines, the blank with its bend lines and the script")
        ->type_name("DIR");
    unfolding.formats = unfold_formats();
    unfold_command
        ->add_option(
            "--formats", unfolding.formats,
            "of the files: VTU for states, DXF, IGES and STEP for lines, states for --redo; blank-k, -bdf, -inp and "
            "-msh: the blank as a mesh with the ids of the deck")
        ->delimiter(',')
        ->check(CLI::IsMember(all_unfold_formats()))
        ->type_name("LIST")
        ->capture_default_str();
    add_dxf(unfold_command, unfolding.dxf);
    unfold_command
        ->add_option("--to-part", unfolding.to_part,
                     "lines drawn on the blank (DXF or JSON, mm): written as they lie on the part")
        ->type_name("FILE");
    unfold_command
        ->add_option("--to-blank", unfolding.to_blank,
                     "lines that lie on the part (DXF or JSON, mm): written as they lie on the blank")
        ->type_name("FILE");
    unfold_command->add_option("--name", unfolding.name, "of the files, without ending (default: the part's)");
    unfold_command->add_option("--json", unfolding.json, "write the figures of the run")->type_name("FILE");
    unfold_command->add_option("--material", unfolding.material, "a grade of `spia materials`, or a material file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    add_thickness(unfold_command, unfolding.thickness, "of the flat sheet (default: that of the part, else 1)");
    add_rolling(unfold_command, unfolding.rolling);
    add_parts(unfold_command, unfolding.parts);
    add_cad(unfold_command, unfolding.cad);
    add_skin(unfold_command, unfolding.skin);
    add_k_factor(unfold_command, unfolding.k_factor);
    add_remesh(unfold_command, unfolding.remesh);
    unfold_command->add_option("--unit", unfolding.unit, "length unit of the file (default mm, glTF: m)")
        ->check(CLI::IsMember({"mm", "cm", "m", "inch"}));
    add_weld(unfold_command, unfolding.weld);
    unfold_command->add_flag("--keep-largest", unfolding.keep_largest,
                             "leave out all but the largest piece, and ribs on edges of three faces");
    unfold_command->add_option("--seam", unfolding.seam, "where a closed part is cut open, as for `spia run`")
        ->type_name("auto|none|corners|FILE")
        ->capture_default_str();
    unfold_command->add_flag("--polish", unfolding.polish,
                             "also solve the whole part at once, from the blank of the steps, and compare both blanks");
    unfold_command->add_flag(
        "--surface{steps}", unfolding.surface,
        "also grid and NURBS surface of the blank of the steps (--surface=polished: of the polished one), with "
        "--out written as by `spia run`, and its report as NAME.json");
    unfolding.surface_formats = usual_formats();
    unfold_command
        ->add_option("--tolerance", unfolding.tolerance,
                     "mm, of that surface, as for `spia run` (default: the surface through the nodes of the grid)")
        ->check(CLI::PositiveNumber)
        ->type_name("MM");
    unfold_command->add_option("--surface-formats", unfolding.surface_formats, "of these files")
        ->delimiter(',')
        ->check(CLI::IsMember(output_formats()))
        ->type_name("LIST")
        ->capture_default_str();
    unfold_command->add_flag("--strict", unfolding.strict, "exit 1 if the result is poorer or a script did not fit");
    unfold_command->add_option("--threads", threads, "most threads (default: all); the result is the same for any")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));

    CLI::App* materials_command = app.add_subcommand("materials", "List the built-in sheet grades");

    cli::FitArguments fit;
    CLI::App* material_command = app.add_subcommand("material", "Make a material file");
    material_command->require_subcommand(1);
    CLI::App* fit_command = material_command->add_subcommand(
        "fit", "Fit the hardening laws to a tensile test: a text file of two columns, strain and stress in MPa");
    fit_command->add_option("table", fit.table, "the test; columns separated by ';', ',', tabs or blanks")
        ->required()
        ->type_name("FILE.csv");
    fit_command->add_option("--out", fit.out, "the material file")->required()->type_name("GRADE.json");
    fit_command->add_option("--law", fit.law, "the law to take; best weighs its error and its number of parameters")
        ->check(CLI::IsMember({"best", "swift", "hollomon", "voce", "ludwik", "hockett_sherby", "swift_voce"}))
        ->capture_default_str();
    fit_command->add_option("--name", fit.name, "of the grade (default: the file's)");
    fit_command->add_option("--r", fit.r, "Lankford coefficients r0,r45,r90 (a tensile curve does not hold them)")
        ->delimiter(',')
        ->expected(3)
        ->check(CLI::Range(1e-3, 99.0))
        ->type_name("r0,r45,r90")
        ->capture_default_str();
    fit_command->add_option("--data", fit.data, "stress and strain (default: as the heading says)")
        ->check(CLI::IsMember({"engineering", "true"}));
    fit_command->add_option("--strain", fit.strain, "unit of strain (default: by the heading, else by its size)")
        ->check(CLI::IsMember({"fraction", "percent"}));
    fit_command->add_option("--young", fit.young, "Young's modulus (default: the slope of the first rows)")
        ->check(CLI::Range(1e3, 1e6))
        ->type_name("MPA");
    fit_command->add_option("--poisson", fit.poisson, "Poisson's ratio")
        ->check(CLI::Range(-0.99, 0.5))
        ->capture_default_str();
    fit_command->add_option("--density", fit.density, "kg/m3")->check(CLI::Range(1.0, 9e4))->capture_default_str();

    // The parser takes an empty word for an option that was not given, as of a variable that a script did not set.
    for (int i = 1; i < count; ++i)
        if (const std::string_view word = values[i]; word.empty() || (word.starts_with("--") && word.ends_with('=')))
            return failed(bad_input, word.empty() ? fmt::format("the word after '{}' is empty", values[i - 1])
                                                  : fmt::format("nothing stands behind '{}'", word));
    try {
        std::vector<std::string> words = arguments_of(count, values);
        std::reverse(words.begin(), words.end()); // as CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? fine : bad_input;
    }
    std::optional<tbb::global_control> limit;
    if (threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, size_t(threads));
    try {
        if (*run_command)
            return cli::run(run);
        if (*info_command)
            return cli::info(info);
        if (*compare_command)
            return cli::compare(comparison);
        if (*unfold_command)
            return cli::unfold(unfolding);
        if (*materials_command)
            return cli::materials();
        if (*fit_command)
            return cli::fit_material(fit);
    } catch (const InputError& error) {
        return failed(bad_input, error.what());
    } catch (const SolveError& error) {
        return failed(no_solution, error.what());
    } catch (const ExchangeError& error) {
        return failed(bad_file, error.what());
    } catch (const Cancelled& error) {
        return failed(cancelled, fmt::format("{}; files that were finished stay", error.what()));
    } catch (const std::bad_alloc&) {
        return failed(no_solution, "there is not enough memory for this part");
    } catch (const std::exception& error) {
        return failed(internal, (std::string("an error of the program itself: ") + error.what()));
    }
    return fine;
}

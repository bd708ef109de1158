// Runs every shape of the family and every mesh of a folder, and prints a table per family: what
// ended how, and what failed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/core.h>
#include <map>

#include "engine/core/atomic_file.h"
#include "engine/exchange/part_formats.h"
#include "engine/forming/material/material_library.h"
#include "engine/report/json/attempts_json.h"
#include "tests/robustness/layout_run.h"
#include "tests/robustness/shape_run.h"
#include "tests/robustness/unfold_run.h"
#include "tests/support/check_grid.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shape_family.h"

namespace {

using namespace spia;

/// What was tried for each shape, for tests/bench/attempts.py.
class Tried {
public:
    /// @param stage  solve, grid or fit
    void add(const std::string& shape, const char* stage, const std::vector<AttemptReport>& attempts)
    {
        shapes_.push_back({{"input", shape}, {stage, {{"attempts", attempts_json(attempts)}}}});
    }

    /// To no file: not at all.
    void write(const std::filesystem::path& file) const
    {
        if (!file.empty())
            write_atomically(file, shapes_.dump(1) + "\n");
    }

private:
    nlohmann::ordered_json shapes_ = nlohmann::ordered_json::array();
};

struct Row {
    int shapes = 0, blanks = 0, refusals = 0, failures = 0, cut = 0, overlapping = 0, short_of_force = 0;
    std::map<SolvedSystem, int> system;
    double seconds = 0, slowest = 0, most_strain = 0;
};

void count(Row& row, const ShapeRun& run)
{
    ++row.shapes;
    row.blanks += run.end == ShapeRun::End::blank;
    row.refusals += run.end == ShapeRun::End::refusal;
    row.failures += run.end == ShapeRun::End::failure;
    row.cut += run.seam_mm > 0;
    row.overlapping += run.crossings + run.wound > 0;
    row.short_of_force += run.end == ShapeRun::End::blank && run.process_share < 1;
    if (run.end == ShapeRun::End::blank)
        ++row.system[run.system];
    row.seconds += run.seconds;
    row.slowest = std::max(row.slowest, run.seconds);
    row.most_strain = std::max(row.most_strain, run.most_strain);
}

std::string line(const std::string& name, Row& row)
{
    return fmt::format(
        "| {:<22} | {:>6} | {:>6} | {:>8} | {:>6} | {:>3} | {:>6} | {:>9} | {:>7} | {:>6} | {:>7} | {:>13} | {:>9.2f} | {:>9.2f} |",
        name, row.shapes, row.blanks, row.refusals, row.failures, row.cut, row.system[SolvedSystem::strict],
        row.system[SolvedSystem::continued], row.system[SolvedSystem::relaxed], row.system[SolvedSystem::energy],
        row.overlapping, row.short_of_force, row.most_strain, row.slowest);
}

std::string cells(const MethodRun& run)
{
    if (!run.failure.empty())
        return "none | none | none";
    return fmt::format("{:.3g} | {:.3g} | {:.3g}{}", run.quality.angular_rms, run.quality.area_rms,
                       std::max(0., run.quality.symmetric_dirichlet - 4),
                       run.quality.flips > 0 ? fmt::format(" ({} flips)", run.quality.flips) : "");
}

std::string necking(const BentRun& run)
{
    if (run.necking == 0 && run.at_hinge_end == 0)
        return "";
    return fmt::format(" ({} neck, {} at ends of hinges)", run.necking, run.at_hinge_end);
}

/// A table of the bent parts, step by step and by others. @returns how many have no blank, or one
/// with flips
int unfold_all(int triangles, std::uint64_t seed, const std::string& only, const FlattenOptions& options)
{
    fmt::print(
        "| part | triangles | regions | steps | converged | flips | on itself | strain up to | off exact mm | steps: angular | "
        "area | isometry | at once: angular | area | isometry | strain up to | ABF++: angular | area | isometry | ARAP: angular | "
        "area | isometry | seconds |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    int wrong = 0;
    for (const shapes::BentShape& shape : shapes::bent_family(triangles, seed)) {
        if (shape.family.find(only) == std::string::npos)
            continue;
        const BentRun run = run_bent(shape.make(), options);
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.3g}{} | {} | {} | {} | {:.3g}{} | {} | {} | {:.2f} |\n",
                   shape.name(), run.triangles, run.regions, run.steps, run.converged, run.local.quality.flips,
                   run.overlaps, run.strain, necking(run),
                   run.local.off_exact ? fmt::format("{:.1e}", *run.local.off_exact) : "", cells(run.local),
                   cells(run.whole), run.whole_strain, run.whole_converged ? "" : " (not converged)", cells(run.abf),
                   cells(run.arap), run.seconds);
        std::fflush(stdout);
        if (!run.local.failure.empty())
            fmt::print("no blank of {}: {}\n", shape.name(), run.local.failure);
        wrong += !run.local.failure.empty() || run.local.quality.flips > 0;
    }
    return wrong;
}

/// A table of grids over outlines and corners drawn at random, 40 of each kind. @returns how many
/// are not sound, or were refused
int grid_all(const std::string& only, int each, Tried& tried)
{
    fmt::print(
        "| kind | outlines | sound | refused as winding too much | not sound | slowest s |\n|---|---|---|---|---|---|\n");
    int wrong = 0;
    for (int kind = 0; kind < shapes::outline_kinds; ++kind) {
        if (shapes::outline_kind(kind).find(only) == std::string_view::npos)
            continue;
        int refused = 0, faulty = 0;
        double slowest = 0;
        std::string names;
        for (int number = 0; number < each; ++number) {
            const shapes::RandomOutline drawn = shapes::random_outline(kind, number);
            const auto clock = std::chrono::steady_clock::now();
            const shapes::RandomGrid made = shapes::random_grid(drawn);
            slowest =
                std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count());
            tried.add(drawn.name, "grid", made.attempts);
            refused += made.refused;
            faulty += !made.fault.empty();
            if (made.refused || !made.fault.empty())
                names += fmt::format("{}: {}\n", drawn.name, made.refused ? "winds too much" : made.fault);
        }
        fmt::print("| {} | {} | {} | {} | {} | {:.1f} |\n{}", shapes::outline_kind(kind), each, each - refused - faulty,
                   refused, faulty, slowest, names);
        std::fflush(stdout);
        wrong += refused + faulty;
    }
    return wrong;
}

/// A table of patches around the holes of plates drawn at random. @returns how many have none, or
/// faulty ones
int layout_all(int plates, Tried& tried)
{
    fmt::print("| plate | patches | divided | within the tolerance | seconds | fault |\n|---|---|---|---|---|---|\n");
    int wrong = 0;
    for (int number = 0; number < plates; ++number) {
        const shapes::RandomOutline drawn = shapes::random_outline(shapes::outline_kinds - 1, number);
        const auto clock = std::chrono::steady_clock::now();
        const LayoutRun run = run_layout(drawn);
        tried.add(drawn.name, "fit", run.attempts);
        fmt::print("| {} | {} | {} | {} | {:.1f} | {} |\n", drawn.name, run.patches, run.split ? "yes" : "",
                   run.reached ? "yes" : "no",
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count(), run.fault);
        std::fflush(stdout);
        wrong += !run.fault.empty();
    }
    fmt::print("{} of {} plates have no patches, or faulty ones\n", wrong, plates);
    return wrong;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Runs awkward shapes: 100 % have to end with a valid blank or a refusal that helps."};
    int triangles = 600;
    std::uint64_t seed = 1;
    std::string only;
    std::filesystem::path folder, attempts;
    bool verbose = false, unfold = false;
    int grids = 0, layouts = 0;
    double edge = 0;
    app.add_option("--triangles", triangles, "about how many each shape has")->capture_default_str();
    app.add_option("--seed", seed, "of all random draws")->capture_default_str();
    app.add_option("--only", only, "families whose name has this in it");
    app.add_option("--folder", folder, "meshes to run as well");
    app.add_option("--edge", edge, "restraint of the outer edge, a share of the lock force")->capture_default_str();
    app.add_flag("--verbose", verbose, "a line per shape");
    app.add_flag("--unfold", unfold, "the bent parts instead, step by step, beside other methods");
    app.add_option("--grids", grids,
                   "grids over that many outlines of each kind instead, with corners drawn at random");
    app.add_option("--layouts", layouts, "patches around the holes of that many plates drawn at random instead");
    app.add_option("--attempts", attempts, "JSON file of what was tried for each shape (tests/bench/attempts.py)");
    CLI11_PARSE(app, argc, argv);
    Tried tried;
    if (grids > 0 || layouts > 0) {
        const int wrong = grids > 0 ? grid_all(only, grids, tried) : layout_all(layouts, tried);
        tried.write(attempts);
        return wrong == 0 ? 0 : 1;
    }

    FlattenOptions flattening;
    flattening.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    if (unfold)
        return unfold_all(triangles, seed, only, flattening) == 0 ? 0 : 1;
    flattening.process.edge_restraint = edge;
    std::vector<std::pair<std::string, Row>> rows;
    Row all;
    int wrong = 0;
    const auto take = [&](const std::string& family, const std::string& name, const ShapeRun& run, bool as_expected) {
        if (rows.empty() || rows.back().first != family)
            rows.emplace_back(family, Row{});
        tried.add(name, "solve", run.attempts);
        count(rows.back().second, run);
        count(all, run);
        wrong += !as_expected;
        if (verbose || !as_expected)
            fmt::print("{:<28} {:>7} {} {} strain {:.2f}, seam {:.4g}, {} crossings, {:.2f} s {}\n", name,
                       run.triangles, as_expected ? "" : "WRONG",
                       run.end == ShapeRun::End::blank ? spia::name(run.system) : "no blank", run.most_strain,
                       run.seam_mm, run.crossings, run.seconds, run.why);
        std::fflush(stdout);
    };
    for (const shapes::FamilyShape& shape : shapes::shape_family(triangles, seed)) {
        if (shape.family.find(only) == std::string::npos)
            continue;
        ReadOptions options;
        options.doctor.keep_largest = shape.keep_largest;
        const ShapeRun run = run_shape(shapes::soup_of(shape.make()), options, flattening);
        const bool fits = shape.expected == shapes::Expected::either
                              ? run.end != ShapeRun::End::failure
                              : run.end == (shape.expected == shapes::Expected::blank ? ShapeRun::End::blank
                                                                                      : ShapeRun::End::refusal);
        take(shape.family, shape.name(), run, fits);
    }
    std::vector<std::filesystem::path> files;
    if (!folder.empty())
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (kind_of_file(entry.path()) == FileKind::mesh)
                files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        const ShapeRun run = run_shape(file, {}, flattening);
        take("files", file.filename().string(), run, run.end != ShapeRun::End::failure);
    }

    tried.write(attempts);
    fmt::print(
        "\n| {:<22} | shapes | blanks | refusals | failed | cut | strict | continued | relaxed | energy | overlap | part of forces | strain up | slowest s |\n",
        "family");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (auto& [name, row] : rows)
        fmt::print("{}\n", line(name, row));
    fmt::print("{}\n{:.1f} s in all; {} of {} shapes did not end as they should\n", line("all", all), all.seconds,
               wrong, all.shapes);
    return wrong == 0 ? 0 : 1;
}

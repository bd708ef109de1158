#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/print_summary.h"
#include "app/cli/surface_of_steps.h"
#include "app/cli/terminal.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/blank/parts_of_table.h"
#include "engine/pipeline/blank/sharp_folds.h"
#include "engine/pipeline/files/line_file.h"
#include "engine/pipeline/files/unfold_file.h"
#include "engine/pipeline/flat_thickness.h"
#include "engine/pipeline/outputs/deck_outputs.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/outputs/unfold_outputs.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/pipeline/shortcomings/unfold_shortcomings.h"
#include "engine/pipeline/unfold_states.h"
#include "engine/report/figures/figures.h"
#include "engine/report/json/report_json.h"
#include "engine/report/json/unfold_report_json.h"
#include "engine/report/text/number_text.h"
#include "engine/unfold/automatic_unfolding.h"
#include "engine/unfold/map_lines.h"
#include "engine/unfold/step/polish.h"
#include "engine/unfold/step/upright.h"

namespace spia::cli {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// All but the thickness, if the deck has to say it.
FlattenOptions flatten_options(const UnfoldArguments& arguments)
{
    FlattenOptions options;
    options.material = find_material(arguments.material, assets() / "materials");
    options.process.rolling = rolling_direction(arguments.rolling);
    if (arguments.thickness)
        options.thickness = *arguments.thickness;
    return options;
}

std::optional<KFactor> wanted_k(const UnfoldArguments& arguments)
{
    return arguments.k_factor.empty() ? std::nullopt : std::optional(k_factor(arguments.k_factor));
}

PartFile part_of(const UnfoldArguments& arguments)
{
    const ReadOptions read = read_options(arguments.read, arguments.part);
    JobDisplay display{"read"};
    return read_part(arguments.part, read, display.progress());
}

/// @param table  numbers its bends in its own way, by which files and `run` name them
void print_map(const BendMap& map, const BendTable& table)
{
    say("part      {}, {}{}\n", counted(map.regions.size(), "region", "regions"),
        counted(map.bends.size(), "bend", "bends"), map.smoothed ? ", its noise smoothed for this" : "");
    constexpr size_t most = 12;
    std::vector<char> taken;
    const std::vector<int> number = bends_in_table(map, table, taken);
    for (size_t k = 0; k < std::min(most, map.bends.size()); ++k) {
        const Bend& bend = map.bends[k];
        say("          {:<8} {:>12} - {:<12} {:7.1f} deg, mean radius {:7.4g} mm, length {:7.4g} mm{}\n",
            map.name(int(map.regions.size() + k)), map.name(bend.a), bend.b >= 0 ? map.name(bend.b) : "edge",
            bend.angle * degrees, bend.radius, bend.length,
            number[k] >= 0 && number[k] != int(k) ? fmt::format(" (bend {} of the table)", number[k] + 1) : "");
    }
    if (map.bends.size() > most)
        say("          and {} more\n", map.bends.size() - most);
    if (const auto small = std::count(taken.begin(), taken.end(), char(0)); small > 0)
        say("          {} treated as a separate bend by the steps: too small, or part of another\n",
            counted(small, "bend of the table is not", "bends of the table are not"));
}

void print_states(const UnfoldRun& run, const TriMesh& part, double diagonal)
{
    for (size_t k = 0; k < run.states.size(); ++k) {
        const UnfoldState& state = run.states[k];
        std::vector<int> moved; // by this step; the report has what is reached so far
        for (Eigen::Index f = 0; f < state.step.size(); ++f)
            if (state.step[f] == int(k + 1))
                moved.push_back(int(f));
        const SheetFigures figures = sheet_figures(state.face, moved);
        say("step {:<4} {}: {}, equivalent strain up to {:.4f}, thinning {}{}\n", k + 1, state.name, state.plain,
            figures.strain_equivalent, percent_range(figures.thinning), state.converged ? "" : ", NOT converged");
        if (state.on && (std::holds_alternative<HeightFace>(state.on->face) || creased(*state.on, diagonal)))
            say("          along the hinge {:.3g} mm off the fixed faces, turned by {:.2f} deg\n",
                state.on->distance_mm, state.on->angle * degrees);
        if (state.friction_share < 1)
            say("          {:.2g} % of the friction is applied: {}\n", 100 * state.friction_share, state.reason);
        if (state.overlap.places > 0)
            say("          overlaps itself at {}, {} of them caused by this step, first at {} mm\n",
                counted(state.overlap.places, "place", "places"), state.overlap.landed,
                place_text(state.overlap.first));
    }
    if (!run.blank)
        return;
    const BlankSize blank = blank_size(part, *run.blank);
    say("blank     {:.6g} x {:.6g} mm, {:.6g} mm2, {}\n", blank.sides()[0], blank.sides()[1], blank.area,
        counted(run.flipped, "flipped triangle", "flipped triangles"));
}

void print_blank(const char* what, const BlankFigures& blank)
{
    say("  {:<9} equivalent strain up to {:.4f}, thinning {}, distortion {:.3g} angular, {:.3g} area{}\n", what,
        blank.strain, percent_range({blank.least_thinning, blank.most_thinning}), blank.distortion.angular_rms,
        blank.distortion.area_rms, blank.converged ? "" : ", NOT converged");
}

void print_polish(const PolishedBlank& polished)
{
    say("polish    outlines up to {:.4g} mm apart, {:.4g} mm on average; {}\n", polished.outline_distance_mm,
        polished.outline_distance_mean_mm, polished.whole.report.reason);
    print_blank("steps", polished.steps);
    print_blank("whole", polished.polished);
    for (const std::string& text : polished.worse)
        say("  the polished blank is worse: {}\n", text);
}

/// Both blanks are wanted: where the whole cannot be solved that of the steps stays.
std::optional<PolishedBlank> polished_blank(const PartFile& part, const UnfoldRun& run, const FlattenOptions& options,
                                            std::vector<std::string>& findings)
{
    if (!run.blank || run.flipped > 0) {
        findings.emplace_back("the blank of the steps cannot be polished: there is none without a flip");
        return std::nullopt;
    }
    JobDisplay display{"polish"};
    try {
        PolishedBlank polished = polish(part.mesh, run, options, display.progress());
        display.done(polished.whole.report.seconds);
        // It lies on the blank of the steps, whose rolling direction is along x, area by area: its
        // own edges may be turned a little.
        Eigen::Matrix2Xd& flat = polished.whole.blank.position;
        flat =
            upright(part.mesh, flat,
                    options.process.rolling ? std::optional<Eigen::Vector2d>(Eigen::Vector2d::UnitX()) : std::nullopt);
        return polished;
    } catch (const SolveError& error) {
        findings.push_back(fmt::format("the blank of the steps could not be polished: {}", error.what()));
        return std::nullopt;
    }
}

std::string stem_of(const UnfoldArguments& arguments)
{
    return arguments.name.empty() ? arguments.part.stem().string() : arguments.name;
}

std::filesystem::path states_file(const UnfoldArguments& arguments)
{
    return arguments.folder / (stem_of(arguments) + "-states.cbor");
}

/// Where the steps of --auto are written.
std::filesystem::path script_file(const UnfoldArguments& arguments)
{
    return arguments.folder / (stem_of(arguments) + "-script.json");
}

/// What --redo means; 0: as many states as hold. @throws InputError if it is neither auto nor the
/// number of a step
size_t redone_from(const std::string& text)
{
    size_t step = 0;
    if (text == "auto")
        return step;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), step);
    if (error != std::errc() || end != text.data() + text.size() || step == 0)
        throw InputError(fmt::format("--redo \"{}\" is neither auto nor the number of a step, from 1", text));
    return step;
}

/// The states of an earlier run that are not solved again.
KeptStates kept_states(const UnfoldArguments& arguments, const PartFile& part, const FlattenOptions& options,
                       const UnfoldScript& steps)
{
    if (arguments.redo.empty())
        return {};
    const size_t from = redone_from(arguments.redo);
    KeptStates kept = read_unfold_states(states_file(arguments), part.mesh, options, steps);
    if (from > steps.size())
        throw InputError(fmt::format("--redo {}: the script has {}", from, counted(steps.size(), "step", "steps")));
    if (from > kept.keep + 1)
        throw InputError(fmt::format(
            "--redo {}: only {}, for {}; give --redo auto", from,
            counted(kept.keep, "state of the earlier run holds", "states of the earlier run hold"), kept.why));
    if (from > 0)
        kept.keep = from - 1;
    say("kept      {} of an earlier run{}\n", counted(kept.keep, "state", "states"),
        from == 0 && !kept.why.empty() ? "; " + kept.why : "");
    return kept;
}

/// A script of an earlier run that says something else may have been edited: it is kept beside.
void keep_edited(const std::filesystem::path& file, const std::string& proposal)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string before{std::istreambuf_iterator<char>(stream), {}};
    if (!stream.is_open() || before == proposal)
        return;
    std::filesystem::path aside = file;
    aside.replace_extension(".before.json");
    for (int k = 2; std::filesystem::exists(aside); ++k) // which may be what was edited
        aside = std::filesystem::path(file).replace_extension(fmt::format(".before-{}.json", k));
    std::error_code failed;
    std::filesystem::rename(file, aside, failed);
    if (failed)
        throw ExchangeError(
            fmt::format("{} may have been edited and cannot be kept as {}: {}; choose another folder or name",
                        file.string(), aside.string(), failed.message()));
    say("  note: the script that was there is kept as {}\n", aside.string());
}

bool states_are_written(const UnfoldArguments& arguments, const UnfoldRun& run)
{
    return !arguments.folder.empty() && !run.states.empty() &&
           std::count(arguments.formats.begin(), arguments.formats.end(), "states");
}

/// Whether the file of states holds for these steps what a run that was broken off has, or more.
bool holds_as_much(const UnfoldArguments& arguments, const PartFile& part, const FlattenOptions& options,
                   const UnfoldScript& steps, const UnfoldRun& run)
{
    try {
        return read_unfold_states(states_file(arguments), part.mesh, options, steps).keep >= run.states.size();
    } catch (const InputError&) { // none is there, or it is of no use
        return false;
    }
}

/// What a later run can go on from, as soon as the steps are done or broken off: the states, and
/// the script of --auto. What an earlier run wrote beside them goes.
/// @param kept states that are in their file already
std::vector<std::filesystem::path> keep_states(const UnfoldArguments& arguments, const PartFile& part,
                                               const BendMap& map, const FlattenOptions& options,
                                               const UnfoldScript& steps, const UnfoldRun& run, size_t kept)
{
    if (arguments.folder.empty())
        return {};
    std::vector<std::filesystem::path> files;
    remove_unfolding(arguments.folder, stem_of(arguments));
    if (states_are_written(arguments, run) && run.states.size() > kept) {
        files.push_back(states_file(arguments));
        write_unfold_states(files.back(), part.mesh, options, steps, run);
    }
    if (arguments.automatic) {
        const std::string proposal = unfold_script_json(map, steps, part.source_face);
        files.push_back(script_file(arguments));
        keep_edited(files.back(), proposal);
        write_atomically(files.back(), proposal);
    }
    return files;
}

/// What a run that a step broke off leaves; empty: nothing.
std::string describe_kept(const UnfoldArguments& arguments, const UnfoldRun& run)
{
    if (!states_are_written(arguments, run))
        return "";
    return fmt::format("; {} kept: --redo auto goes on from there",
                       run.states.size() == 1
                           ? "the state of the step before it is"
                           : fmt::format("the states of the {} steps before it are", run.states.size()));
}

/// Of a run that was cancelled: leaves its states and says how to go on.
[[noreturn]] void keep_cancelled(const UnfoldArguments& arguments, const PartFile& part, const BendMap& map,
                                 const FlattenOptions& options, const UnfoldScript& steps, const UnfoldRun& run)
{
    std::string what =
        fmt::format("cancelled after {} of {}", run.states.size(), counted(steps.size(), "step", "steps"));
    if (!states_are_written(arguments, run))
        throw Cancelled(what);
    if (!holds_as_much(arguments, part, options, steps, run))
        for (const auto& file : keep_states(arguments, part, map, options, steps, run, 0))
            say("wrote     {}\n", file.string());
    throw Cancelled(fmt::format("{}; to go on from their states: --script {} --out {} --redo auto", what,
                                (arguments.automatic ? script_file(arguments) : arguments.script).string(),
                                arguments.folder.string()));
}

/// The steps and what they gave.
struct RunSteps {
    UnfoldScript steps;
    std::vector<std::string> findings; ///< what of the script made no sense
    UnfoldRun run;
    size_t kept = 0; ///< states that are in their file already
};

RunSteps run_steps(const UnfoldArguments& arguments, const PartFile& part, const BendMap& map,
                   const FlattenOptions& options)
{
    RunSteps done;
    JobDisplay display{"unfold"};
    const auto clock = std::chrono::steady_clock::now();
    if (arguments.automatic) {
        AutomaticUnfolding unfolded =
            automatic_unfolding(part.mesh, map, {.root = arguments.root - 1}, options, display.progress());
        for (const std::string& note : unfolded.sequence.notes)
            say("  note: {}\n", note);
        done.steps = std::move(unfolded.sequence.steps);
        done.run = std::move(unfolded.run);
    } else {
        ReadScript script = read_unfold_script(arguments.script, part, map);
        done.steps = std::move(script.steps);
        done.findings = std::move(script.findings);
        if (done.steps.empty())
            throw InputError(fmt::format("no step of the script makes sense on this part; {}", done.findings.front()));
        const KeptStates kept = kept_states(arguments, part, options, done.steps);
        done.run = run_unfolding(part.mesh, done.steps, options, display.progress(), &kept.run, kept.keep);
        done.kept = kept.keep;
    }
    display.done(std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count());
    return done;
}

/// What is drawn on the blank or on the part, carried over to the other one.
void carry_lines(const UnfoldArguments& arguments, const PartFile& part, const UnfoldRun& run,
                 std::vector<std::filesystem::path>& files, std::vector<std::string>& findings)
{
    for (const bool up : {true, false}) {
        const std::filesystem::path& file = up ? arguments.to_part : arguments.to_blank;
        if (file.empty())
            continue;
        if (!run.blank)
            throw SolveError(fmt::format("{}: cannot be carried over, because there is no blank", file.string()));
        const DxfLines drawn = read_line_file(file);
        for (const std::string& kind : drawn.left_out)
            findings.push_back(fmt::format("{}: not read: {}", file.string(), kind));
        const Eigen::Matrix2Xd& flat = run.blank->position;
        const MappedLines mapped = up ? to_part(part.mesh, flat, drawn.lines) : to_blank(part.mesh, flat, drawn.lines);
        for (const std::string& line : mapped.left_out)
            findings.push_back(fmt::format("{}: {}", file.string(), line));
        say("lines     {} of {} of {} carried to the {}\n", mapped.lines.size(), drawn.lines.size(), file.string(),
            up ? "part" : "blank");
        if (mapped.lines.empty())
            continue;
        const std::string name =
            fmt::format("{}-{}-on-{}", stem_of(arguments), file.stem().string(), up ? "part" : "blank");
        std::vector<std::string> formats = arguments.formats;
        formats.push_back("json");
        for (const auto& written : write_line_files(arguments.folder, name, mapped.lines, formats))
            files.push_back(written);
    }
}

/// Before the work begins: refuses what cannot be done, and makes the folder of the files.
void prepare(const UnfoldArguments& arguments)
{
    if (arguments.automatic == !arguments.script.empty())
        throw InputError("give either --script FILE or --auto");
    if (!arguments.surface.empty() && arguments.surface != "steps" && arguments.surface != "polished")
        throw InputError(fmt::format("--surface={}: there is steps (the default) and polished", arguments.surface));
    if (arguments.tolerance && arguments.surface.empty())
        throw InputError("--tolerance is for the surface; ask for it with --surface, or leave it out");
    for (const std::string& format : arguments.formats)
        if (!arguments.surface.empty() &&
            std::count(arguments.surface_formats.begin(), arguments.surface_formats.end(), format) &&
            is_deck_format(format))
            throw InputError(
                fmt::format("--formats and --surface-formats both name {}, which is one file; give it once", format));
    if (arguments.folder.empty() && !(arguments.to_part.empty() && arguments.to_blank.empty()))
        throw InputError("lines that are carried over need a place: give --out DIR");
    if (!arguments.redo.empty() && (arguments.automatic || arguments.folder.empty()))
        throw InputError("--redo goes on from an earlier run: give --script FILE and the --out DIR of that run");
    require_file_name(arguments.name);
    dxf_options(arguments.dxf);
    redone_from(arguments.redo.empty() ? "auto" : arguments.redo);
    for (const auto& file : {arguments.to_part, arguments.to_blank})
        if (!file.empty())
            read_line_file(file);
    if (!arguments.folder.empty())
        prepare_folder(arguments.folder);
    if (!arguments.json.empty())
        require_writable(arguments.json);
    require_one_surface(arguments.k_factor, arguments.read.skin);
    wanted_k(arguments);
}

void print_states_and_bends(const UnfoldArguments& arguments, const PartFile& part, const UnfoldRun& run,
                            const BendTable& table)
{
    print_states(run, part.mesh, bounding_diagonal(part.mesh));
    if (!run.blank)
        return;
    print_bends(table);
    const auto laid = [](const SheetBend& bend) { return bend.laid; };
    if (!arguments.folder.empty() && std::ranges::any_of(table.bends, laid))
        say("bends     only the blank is laid so: the states of the steps keep the lengths of the part's mesh\n");
}

/// Of part, steps and surface; what the surface says again is left out.
std::vector<std::string> all_shortcomings(const PartFile& part, const UnfoldRun& run,
                                          const std::vector<std::string>& findings,
                                          const std::optional<ChainRun>& surface)
{
    auto poorer = part.doubts;
    for (std::string& text : spia::shortcomings(run, bounding_diagonal(part.mesh), findings))
        poorer.push_back(std::move(text));
    if (surface)
        for (std::string& text : spia::shortcomings(surface->session))
            // both doubt the part
            if (std::find(poorer.begin(), poorer.end(), text) == poorer.end())
                poorer.push_back(std::move(text));
    return poorer;
}

} // namespace

int unfold(const UnfoldArguments& arguments)
{
    prepare(arguments);
    FlattenOptions options = flatten_options(arguments);
    const PartFile part = part_of(arguments);
    require_deck_ids(arguments.formats, part);
    for (const std::string& line : reading_notes(part))
        say("  {}\n", line);
    require_surface_place(arguments, part);
    options.thickness = flat_thickness(arguments.thickness, part);
    if (const std::string text = describe_thickness(arguments.thickness, part); !text.empty())
        say("  note: {}\n", text);
    BendMap map = bends_for_steps(part);
    NeutralFibre fibre = part_bends(part, options.thickness, wanted_k(arguments));
    take_radii(fibre.zone, map);
    print_map(map, fibre.table);
    RunSteps done;
    try {
        done = run_steps(arguments, part, map, options);
    } catch (const UnfoldingCancelled& cancelled) {
        keep_cancelled(arguments, part, map, options, cancelled.steps, cancelled.done);
    }
    const UnfoldScript& steps = done.steps;
    const UnfoldRun& run = done.run;
    std::vector<std::string>& findings = done.findings;
    const auto kept = keep_states(arguments, part, map, options, steps, run, done.kept);
    std::optional<PolishedBlank> polished;
    if (arguments.polish)
        polished = polished_blank(part, run, options, findings);
    const PolishedBlank* both = polished ? &*polished : nullptr;
    lay_anew(part.mesh, options, fibre, done.run);
    if (run.blank)
        add_sharp_folds(part, *run.blank, fibre.table);
    if (done.run.blank)
        for (std::string& doubt : bend_doubts(part, fibre.table, !arguments.k_factor.empty()))
            findings.push_back(std::move(doubt));
    std::vector<std::filesystem::path> files;
    if (!arguments.folder.empty())
        files = write_unfolding(arguments.folder, stem_of(arguments), part, map, steps, run,
                                polished ? &polished->whole : nullptr, arguments.formats, dxf_options(arguments.dxf),
                                &fibre.table);
    files.insert(files.end(), kept.begin(), kept.end());
    if (run.failure.empty())
        carry_lines(arguments, part, run, files, findings);
    std::optional<ChainRun> surface;
    if (!arguments.surface.empty() && run.failure.empty() && run.blank) {
        surface = surface_of_steps(arguments, part, run, options);
        for (const auto& file : write_surface(arguments, *surface))
            files.push_back(file);
        if (surface->failure)
            findings.push_back(fmt::format("the surface ends before the stage \"{}\": {}",
                                           name(surface->failure->stage), surface->failure->message));
    }
    if (!arguments.json.empty())
        write_atomically(arguments.json, unfold_report_json(arguments.part, part, map, steps, run, findings, files,
                                                            both, run.blank ? &fibre.table : nullptr));
    print_states_and_bends(arguments, part, run, fibre.table);
    if (polished)
        print_polish(*polished);
    if (surface && surface->session.blank)
        print_summary(surface->session);
    for (const auto& file : files)
        say("wrote     {}\n", file.string());
    const std::vector<std::string> poorer = all_shortcomings(part, run, findings, surface);
    for (const std::string& text : poorer)
        say("WARNING   {}\n", text);
    if (!run.failure.empty())
        throw SolveError(fmt::format("step {} \"{}\": {}{}", run.states.size() + 1, steps[run.states.size()].name,
                                     run.failure, describe_kept(arguments, run)));
    if (!arguments.surface.empty() && !surface)
        throw SolveError("there is no surface, because the steps gave no blank");
    if (surface && surface->error)
        std::rethrow_exception(surface->error);
    return arguments.strict && !poorer.empty() ? 1 : 0;
}

} // namespace spia::cli

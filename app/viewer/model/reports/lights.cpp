#include "app/viewer/model/reports/lights.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/document/unfolding_steps.h"
#include "app/viewer/model/reports/export_check.h"
#include "app/viewer/model/reports/viewer_words.h"
#include "engine/core/text.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/smooth_joins.h"
#include "engine/options/option.h"
#include "engine/pipeline/make_surface.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/pipeline/shortcomings/surface_shortcomings.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/number_text.h"
#include "engine/report/text/sentence.h"
#include "engine/report/text/shown_lengths.h"

namespace spia::viewer {
namespace {

std::string grade(const Document& document)
{
    const std::filesystem::path named(document.material);
    return (named.extension() == ".json" ? named.stem() : named.filename()).string();
}

void judge_sheet(const Document& document, LengthUnit lengths, std::vector<Doubt>& doubts)
{
    if (!document.session.part || (is_given(document.thickness_from) && is_given(document.material_from)))
        return;
    const double thickness = document.session.options.flatten.thickness;
    const std::string& called = document.session.part->material;
    const std::string file_says = called.empty() ? "" : fmt::format(" The file calls the material \"{}\".", called);
    const std::string thick = thickness_text(thickness, lengths);
    Doubt doubt{ChainStep::sheet, {}};
    if (!is_given(document.thickness_from)) {
        doubt.text = document.thickness_from == SheetSource::before
                         ? fmt::format("The thickness {} is that of the previous part; this file gives none.", thick)
                         : fmt::format("The thickness {} is assumed; the file gives none.", thick);
    }
    if (!is_given(document.material_from)) {
        doubt.text += fmt::format(
            "{}The grade {} is {}.{}", doubt.text.empty() ? "" : " ", grade(document),
            document.material_from == SheetSource::before ? "that of the previous part" : "assumed", file_says);
    }
    const bool neither = !is_given(document.thickness_from) && !is_given(document.material_from);
    doubt.next = neither ? "Choose them here, or confirm." : "Choose it here, or confirm.";
    doubt.button = neither                            ? fmt::format("Confirm {} of {}", thick, grade(document))
                   : is_given(document.material_from) ? "Confirm " + thick
                                                      : "Confirm " + grade(document);
    doubt.remedy = Remedy::confirm_sheet;
    doubts.push_back(std::move(doubt));
}

/// What the engine says of a stage's result, with the click that answers it.
Doubt with_click(ChainStep step, const std::string& text, const Document& document)
{
    const Session& session = document.session;
    const auto about = [&](std::string_view words) { return text.find(words) != std::string::npos; };
    Doubt doubt{step, sentence(window_text(text))};
    if (about("yields at") || about("mm thick: is that in mm") || about("its bends are laid with the thickness"))
        doubt.step = ChainStep::sheet;
    else if (step == ChainStep::unfold && text == session.blank->report.reason) {
        const auto& steps = document.made_with.steps;
        doubt.next =
            steps && !steps->polish ? "See the steps below that have not converged." : advice(session.blank->report);
    } else if (about("only bent, but joined")) {
        doubt.button = "Cut the corners";
        doubt.remedy = Remedy::cut_corners;
    } else if (about("strained beyond") && session.blank) {
        Eigen::Index most = 0;
        session.blank->face.strain_equivalent.maxCoeff(&most);
        doubt.face = int(most);
        doubt.field = Field::necking;
    } else if ((about("crosses itself") || about("winds around")) && document.steps.empty()) {
        doubt.button = "Propose steps";
        doubt.remedy = Remedy::propose_steps;
    } else if (step == ChainStep::grid && about("folded") && session.options.grid.method != GridMethod::harmonic) {
        doubt.button = "Use the harmonic method";
        doubt.remedy = Remedy::harmonic_grid;
    }
    return doubt;
}

/// Those that a stage adds to the engine's list.
void add_shortcomings(ChainStep step, const Session& upto, const Document& document, std::vector<std::string>& known,
                      std::vector<Doubt>& doubts)
{
    for (const std::string& text : shortcomings(upto))
        if (std::find(known.begin(), known.end(), text) == known.end()) {
            known.push_back(text);
            doubts.push_back(with_click(step, text, document));
        }
}

/// A part that is hardly larger than its sheet is thick, or of no size that sheet parts have: its
/// unit is likely another.
void judge_size(const Document& document, LengthUnit lengths, std::vector<Doubt>& doubts)
{
    const PartFile& part = *document.session.part;
    const SessionOptions& options = document.session.options;
    const double diagonal = bounding_diagonal(part.mesh), thickness = options.flatten.thickness;
    const auto unit = likelier_unit(part, diagonal, thickness);
    const bool thick = diagonal < least_size_in_thicknesses * thickness;
    if (!thick && (!unit || options.read.unit)) // that was said
        return;
    Doubt doubt{
        ChainStep::part,
        thick ? fmt::format(
                    "The part is {} across and the sheet {} thick: a sheet is at least {:.0f} times as large as "
                    "it is thick.",
                    plain_length(diagonal, lengths), thickness_text(thickness, lengths), least_size_in_thicknesses)
              : fmt::format("The part is {} across, which is unlikely for a sheet part.",
                            plain_length(diagonal, lengths)),
        thick ? "Check the length unit of the file and the thickness." : "Check the length unit of the file."};
    if (unit) {
        doubt.button = fmt::format("Read it in {}", name(*unit));
        doubt.remedy = Remedy::read_in_other_unit;
    }
    doubts.push_back(std::move(doubt));
}

void judge_cracks(const Document& document, std::vector<Doubt>& doubts)
{
    if (!document.session.limits)
        return;
    const LimitsResult& limits = *document.session.limits;
    const auto faces = [&](Zone zone) { return limits.zones.share[size_t(zone)].faces; };
    std::string text;
    if (const int count = faces(Zone::crack); count > 0)
        text = fmt::format("{} above the forming limit curve: the sheet cracks there.",
                           counted(count, "face is", "faces are"));
    if (const int count = faces(Zone::excessive_thinning); count > 0)
        text += fmt::format("{} the allowed thinning of {:.4g} %.",
                            text.empty() ? counted(count, "face exceeds", "faces exceed")
                                         : " " + counted(count, "more face exceeds", "more faces exceed"),
                            100 * limits.settings.max_thinning);
    if (text.empty())
        return;
    Doubt doubt{ChainStep::unfold, text};
    doubt.field = Field::zone;
    if (!limits.zones.spots.empty())
        doubt.face = limits.zones.spots.front().face;
    doubts.push_back(std::move(doubt));
}

void judge_cells(const Document& document, std::vector<Doubt>& doubts)
{
    const GridResult& grid = document.session.grid->result;
    const double worst = grid.quality.min_scaled_jacobian;
    if (grid.quality.folded_cells > 0 || worst >= least_scaled_jacobian)
        return;
    Doubt doubt{
        ChainStep::grid,
        fmt::format("A cell is nearly folded (scaled Jacobian {:.3f}); analysis will be inaccurate there.", worst),
        "Drag the corners to sharp corners of the blank, or choose more cells."};
    if (grid.route < GridRoute::harmonic) {
        doubt.next = "Drag the corners to sharp corners of the blank, or:";
        doubt.button = "Use the harmonic method";
        doubt.remedy = Remedy::harmonic_grid;
    }
    const auto [i, j] = grid.planar.column_and_row(grid.quality.worst_cell);
    if (const MeshPoint& node = grid.place[size_t(grid.planar.node(i, j))]; node.face >= 0) {
        const TriMesh& mesh = grid.filled->mesh;
        doubt.place = mesh.position(Eigen::all, mesh.triangle.col(node.face)) * node.barycentric;
    }
    doubts.push_back(std::move(doubt));
}

/// What the engine says of a fit that has not reached its tolerance has the click that answers it.
void answer_shortfall(const Document& document, const SurfaceStage& surface, LengthUnit lengths, Doubt& doubt)
{
    const SessionOptions& options = document.session.options;
    const bool one_patch = !options.patches && !options.best_surface; // else both were tried
    const double reached = reached_tolerance(surface);
    doubt.place = surface.deviation.worse().where;
    doubt.next = fmt::format("Or raise the tolerance to {}.", length_text(reached, lengths, 3));
    switch (surface.fit->shortfall.reason) {
    case FitShortfall::Reason::sharp_edge:
    case FitShortfall::Reason::outline_corner:
        if (one_patch) {
            doubt.button = "Use several patches";
            doubt.remedy = Remedy::several_patches;
            return;
        }
        break;
    case FitShortfall::Reason::data:
        if (one_patch) {
            doubt.button = fmt::format("Make the grid of {} cells", finer_cells(options.grid));
            doubt.remedy = Remedy::finer_grid;
            return;
        }
        break;
    default:
        if (options.best_surface)
            break;
        doubt.button = fmt::format("Allow {} control points", more_control_points(options.max_control_points));
        doubt.remedy = Remedy::more_control_points;
        return;
    }
    doubt.next = "";
    doubt.button = fmt::format("Raise the tolerance to {}", length_text(reached, lengths, 3));
    doubt.remedy = Remedy::looser_tolerance;
}

void judge_distance(const Document& document, LengthUnit lengths, std::vector<Doubt>& doubts)
{
    const SurfaceStage& surface = *document.session.surface;
    if (surface.fit) { // the engine says whether that is reached
        for (Doubt& doubt : doubts)
            if (!surface.fit->reached && doubt.text == sentence(window_text(surface.fit->shortfall.text)))
                answer_shortfall(document, surface, lengths, doubt);
        return;
    }
    const FitVerdict verdict = fit_verdict(document.session);
    if (verdict.fit == Fit::within)
        return;
    doubts.push_back(
        {ChainStep::surface,
         fmt::format("The surface deviates from the part by up to {}, on {} of its area by more than a usual "
                     "tolerance, {}.",
                     length_text(verdict.greatest, lengths, 3), area_share(verdict.beyond),
                     length_text(verdict.tolerance, lengths, 3)),
         "", fmt::format("Fit it within {}", length_text(verdict.tolerance, lengths, 3)), Remedy::fit_within_tolerance,
         surface.deviation.worse().where});
}

/// What the engine says of a surface, with a way out in place of its own.
Doubt with_way_out(const std::string& said, std::string next)
{
    return {ChainStep::surface, sentence(said.substr(0, said.find_last_of(":;"))), std::move(next)};
}

void judge_control_points(const Document& document, std::vector<Doubt>& doubts)
{
    if (const auto heavy = heavy_surface(document.session))
        doubts.push_back(with_way_out(*heavy, "A larger tolerance needs fewer."));
}

void judge_joints(const Document& document, std::vector<Doubt>& doubts)
{
    if (const auto kinked = kinked_surface(document.session))
        doubts.push_back(with_way_out(
            *kinked,
            document.session.options.best_surface
                ? "Choose \"several patches\" and cut elsewhere."
                : "Choose \"one patch\", or cut elsewhere: \"Smooth joins\" leaves joins of more than 10 degrees."));
}

void judge_folds(const Document& document, std::vector<Doubt>& doubts)
{
    const auto folded = folded_surface(document.session);
    if (!folded)
        return;
    Doubt doubt = with_way_out(*folded, "");
    for (const PatchCertificate& patch : surface_certificate(document.session).patch)
        if (patch.refusal && !doubt.place)
            doubt.place = patch.refusal->place.position;
    if (made_of_patches(document.session))
        doubt.next = "Add a cut there with the tool Vertex, or choose \"one patch\".";
    else {
        doubt.next = "Drag the corners to sharp corners of the blank, or:";
        doubt.button = fmt::format("Make the grid of {} cells", finer_cells(document.session.options.grid));
        doubt.remedy = Remedy::finer_grid;
    }
    doubts.push_back(std::move(doubt));
}

/// The first step of the list that has no good result; empty: none.
std::string poor_step(const Document& document)
{
    for (size_t k = 0; k < document.steps.size(); ++k)
        switch (step_status(document, k)) {
        case StepStatus::poor: return fmt::format("Step {} of the unfolding has not converged", k + 1);
        case StepStatus::failed: return fmt::format("Step {} of the unfolding has no result", k + 1);
        case StepStatus::needs_pick: return fmt::format("Step {} of the unfolding has lost its fixed faces", k + 1);
        default: break;
        }
    return "";
}

} // namespace

std::optional<int> face_of(const Doubt& doubt, const TriMesh& part)
{
    if (doubt.face || !doubt.place || part.triangles() == 0)
        return doubt.face;
    return ClosestPointSearch(part).nearest(*doubt.place).face;
}

DoubtsOf doubts_of(const Document& document, LengthUnit lengths)
{
    const Session& session = document.session;
    return {session.part,
            session.blank,
            session.limits,
            session.grid,
            session.surface,
            session.deformed,
            document.unfolding,
            document.material,
            session.options.flatten.thickness,
            document.material_from,
            document.thickness_from,
            first_stale(document),
            lengths,
            session.options.k_factor.has_value()};
}

int finer_cells(const GridOptions& grid)
{
    constexpr int most = 2000; // as SetGrid takes
    return std::min(2 * grid.cells, most);
}

double wanted_tolerance(const SessionOptions& options) { return options.tolerance.value_or(usual_tolerance); }

int more_control_points(int most)
{
    constexpr int greatest = 4'000'000; // as SetFit takes
    return most > greatest / 2 ? greatest : 2 * most;
}

double reached_tolerance(const SurfaceStage& surface)
{
    const double left = surface.deviation.max();
    if (!(left > 0))
        return usual_tolerance;
    const double digit = std::pow(10, std::floor(std::log10(left)) - 1);
    return std::ceil(left / digit) * digit;
}

std::optional<LengthUnit> likelier_unit(const PartFile& part, double diagonal, double thickness)
{
    constexpr double small = 5, large = 20'000; // mm, as read_part() says
    const bool likely = diagonal >= small && diagonal <= large && diagonal >= least_size_in_thicknesses * thickness;
    if (!(diagonal > 0) || likely || (part.cad && part.cad->unit_stated))
        return std::nullopt;
    for (const LengthUnit unit : {LengthUnit::m, LengthUnit::mm, LengthUnit::cm, LengthUnit::inch}) {
        const double other = diagonal / millimetres(part.unit) * millimetres(unit);
        if (unit != part.unit && other >= std::max(4 * small, 2 * least_size_in_thicknesses * thickness) &&
            other <= large)
            return unit;
    }
    return std::nullopt;
}

std::vector<Doubt> find_doubts(const Document& document, LengthUnit lengths)
{
    std::vector<Doubt> doubts;
    const Session made = as_made(document);
    if (!made.part)
        return doubts;
    const auto stale = first_stale(document);
    const auto holds = [&](Stage stage) { return !stale || *stale > stage; };
    std::vector<std::string> known;
    Session upto = made; // all that the engine's list looks at, but for stages that come later
    upto.blank = nullptr;
    upto.grid = nullptr;
    upto.surface = nullptr;
    upto.deformed = nullptr;
    add_shortcomings(ChainStep::part, upto, document, known, doubts);
    judge_size(document, lengths, doubts);
    judge_sheet(document, lengths, doubts);
    if (document.session.options.k_factor && made.part->solid && made.part->solid->skin != Skin::middle)
        doubts.push_back(
            {ChainStep::part, "The K factor needs the middle surface, but the lengths are those of a skin.",
             "Choose \"middle\" as \"Skin\", or \"none, skin lengths\" as \"K factor\" in the step Unfold."});
    if (made.blank && holds(Stage::solve)) {
        upto.blank = made.blank;
        add_shortcomings(ChainStep::unfold, upto, document, known, doubts);
        judge_cracks(document, doubts);
        if (const std::string left_out = made.options.steps ? left_out_by_steps(document) : ""; !left_out.empty())
            doubts.push_back({ChainStep::unfold, "The blank was made step by step. " + left_out,
                              "Unfold in one step to take it into account, or remove it."});
    }
    if (made.grid && holds(Stage::grid)) {
        upto.grid = made.grid;
        add_shortcomings(ChainStep::grid, upto, document, known, doubts);
        judge_cells(document, doubts);
    }
    if (made.surface && holds(Stage::fit)) {
        upto.surface = made.surface;
        upto.deformed = made.deformed;
        // said below, with a click
        for (const auto& text : {far_surface(upto), folded_surface(upto), heavy_surface(upto), kinked_surface(upto)})
            if (text)
                known.push_back(*text);
        add_shortcomings(ChainStep::surface, upto, document, known, doubts);
        judge_distance(document, lengths, doubts);
        judge_control_points(document, doubts);
        judge_joints(document, doubts);
        judge_folds(document, doubts);
    }
    for (Doubt& doubt : doubts) { // the engine speaks of mm
        doubt.text = in_shown_lengths(doubt.text, lengths);
        doubt.next = in_shown_lengths(doubt.next, lengths);
    }
    std::stable_sort(doubts.begin(), doubts.end(), [](const Doubt& a, const Doubt& b) { return a.step < b.step; });
    return doubts;
}

Readiness readiness(const ViewerState& state)
{
    const Document& document = state.document;
    if (!document.session.part)
        return state.refused ? Readiness{false, "The part was refused; see its faults in the step Part"}
                             : Readiness{true, "Open a part, or drop one on the window"};
    if (shows_refused(state))
        return {false, fmt::format("Showing {}, which was refused", state.refused_file->file.filename().string())};
    if (!out_of_date(document).empty())
        return {false,
                fmt::format("Out of date from the step {} on: Update all (F5)", heading(*first_stale(document)))};
    const size_t count = state.doubts ? state.doubts->size() : 0;
    if (count > 0)
        return {false, count == 1 ? "1 thing to look at" : fmt::format("{} things to look at", count), true};
    if (const std::string poor = poor_step(document); !poor.empty())
        return {false, poor};
    return {true, "Ready"};
}

} // namespace spia::viewer

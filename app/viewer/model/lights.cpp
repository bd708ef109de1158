#include "app/viewer/model/lights.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/chain.h"
#include "app/viewer/model/lengths.h"
#include "app/viewer/model/number_text.h"
#include "app/viewer/model/state.h"
#include "app/viewer/model/viewer_words.h"
#include "engine/coons/cell_quality.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/certificate_report.h"
#include "engine/pipeline/shortcomings.h"

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
        doubt.text +=
            fmt::format("{}The grade {} is assumed.{}", doubt.text.empty() ? "" : " ", grade(document), file_says);
    }
    doubt.next = "Choose them here, or confirm.";
    const bool neither = !is_given(document.thickness_from) && !is_given(document.material_from);
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
    Doubt doubt{step, sentence(in_viewer_words(text))};
    if (about("yields at") || about("mm thick: is that in mm"))
        doubt.step = ChainStep::sheet;
    else if (step == ChainStep::unfold && text == session.blank->report.reason) {
        const auto& steps = document.made_with.steps;
        doubt.next =
            steps && !steps->polish ? "See the steps below that have not converged." : advice(session.blank->report);
    } else if (about("strained beyond")) {
        doubt.button = "Show where";
        doubt.remedy = Remedy::show_necking;
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

void judge_size(const Document& document, LengthUnit lengths, std::vector<Doubt>& doubts)
{
    const PartFile& part = *document.session.part;
    const double diagonal = bounding_diagonal(part.mesh);
    if (document.session.options.read.unit) // it was said
        return;
    if (const auto unit = likelier_unit(part, diagonal))
        doubts.push_back(
            {ChainStep::part,
             fmt::format("The part is {} across, which is unlikely for a sheet part.", plain_length(diagonal, lengths)),
             "Check the length unit of the file.", fmt::format("Read it in {}", name(*unit)),
             Remedy::read_in_other_unit});
}

void judge_cracks(const Document& document, std::vector<Doubt>& doubts)
{
    if (!document.session.limits)
        return;
    const LimitsResult& limits = *document.session.limits;
    const auto faces = [&](Zone zone) { return limits.zones.share[size_t(zone)].faces; };
    const auto counted = [](int count, const char* one, const char* more) {
        return count == 1 ? fmt::format("1 face {}", one) : fmt::format("{} faces {}", count, more);
    };
    std::string text;
    if (const int count = faces(Zone::crack); count > 0)
        text = fmt::format("{} above the forming limit curve: the sheet cracks there.", counted(count, "is", "are"));
    if (const int count = faces(Zone::excessive_thinning); count > 0)
        text += fmt::format("{}{} the allowed thinning of {:.4g} %.", text.empty() ? "" : " ",
                            counted(count, "exceeds", "exceed"), 100 * limits.settings.max_thinning);
    if (text.empty())
        return;
    Doubt doubt{ChainStep::unfold, text};
    doubt.button = "Show the zones";
    doubt.remedy = Remedy::show_zones;
    doubts.push_back(std::move(doubt));
}

void judge_cells(const Document& document, std::vector<Doubt>& doubts)
{
    const GridResult& grid = document.session.grid->result;
    const double worst = scaled_jacobians(grid.planar).minCoeff();
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
    doubts.push_back(std::move(doubt));
}

void judge_distance(const Document& document, LengthUnit lengths, std::vector<Doubt>& doubts)
{
    const SurfaceStage& surface = *document.session.surface;
    if (surface.fit) // the engine says whether that is reached
        return;
    const double off = surface.deviation.max();
    if (off <= usual_tolerance)
        return;
    doubts.push_back({ChainStep::surface,
                      fmt::format("The surface deviates from the part by up to {}; a usual tolerance is {}.",
                                  plain_length(off, lengths), length_text(usual_tolerance, lengths, 3)),
                      "", fmt::format("Fit it within {}", length_text(usual_tolerance, lengths, 3)),
                      Remedy::fit_within_tolerance});
}

/// Whether the normal only vanishes at a corner: on a smooth outline the grid has no angle there, which CAD does not mind.
bool at_a_corner(const Refusal& refusal)
{
    const auto end = [](double parameter) { return parameter == 0 || parameter == 1; };
    return refusal.why == Refusal::Why::vanishes && end(refusal.place.u) && end(refusal.place.v);
}

void judge_folds(const Document& document, std::vector<Doubt>& doubts)
{
    const Certificate& certificate = surface_certificate(document.session);
    const SurfaceStage& surface = *document.session.surface;
    const bool refused =
        !certificate.leak.empty() ||
        std::any_of(certificate.patch.begin(), certificate.patch.end(),
                    [](const PatchCertificate& each) { return each.refusal && !at_a_corner(*each.refusal); });
    std::string text;
    if (refused)
        text = fmt::format("The surface may have a fold: {}.", unsuited(certificate).value_or(""));
    else if (const double turned = surface.deviation.normal.turned; turned > 0)
        text = fmt::format("The surface folds: on {} of its area the normal is opposite to that of the part.",
                           turned < 0.001 ? "less than 0.1 %" : fmt::format("{:.1f} %", 100 * turned));
    else
        return;
    if (document.session.options.patches) {
        doubts.push_back({ChainStep::surface, text, "Add a cut there with the tool Vertex, or choose \"one patch\"."});
        return;
    }
    doubts.push_back({ChainStep::surface, text, "Drag the corners to sharp corners of the blank, or:",
                      fmt::format("Make the grid of {} cells", finer_cells(document.session.options.grid)),
                      Remedy::finer_grid});
}

const char* heading(Stage stage)
{
    switch (stage) {
    case Stage::read: return "Part";
    case Stage::solve: return "Unfold";
    case Stage::grid:
    case Stage::lift: return "Corners and grid";
    case Stage::fit: return "NURBS surface";
    }
    return "";
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
            lengths};
}

int finer_cells(const GridOptions& grid)
{
    constexpr int most = 2000; // as SetGrid takes
    return std::min(2 * grid.cells, most);
}

double wanted_tolerance(const SessionOptions& options) { return options.tolerance.value_or(usual_tolerance); }

std::optional<LengthUnit> likelier_unit(const PartFile& part, double diagonal)
{
    constexpr double small = 5, large = 20'000; // mm, as read_part() says
    if (!(diagonal > 0) || (diagonal >= small && diagonal <= large) || (part.cad && part.cad->unit_stated))
        return std::nullopt;
    for (const LengthUnit unit : {LengthUnit::m, LengthUnit::mm, LengthUnit::cm, LengthUnit::inch}) {
        const double other = diagonal / millimetres(part.unit) * millimetres(unit);
        if (other >= 4 * small && other <= large)
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
    Session upto;
    upto.options = made.options;
    upto.part = made.part;
    add_shortcomings(ChainStep::part, upto, document, known, doubts);
    judge_size(document, lengths, doubts);
    judge_sheet(document, lengths, doubts);
    if (made.blank && holds(Stage::solve)) {
        upto.blank = made.blank;
        add_shortcomings(ChainStep::unfold, upto, document, known, doubts);
        judge_cracks(document, doubts);
    }
    if (made.grid && holds(Stage::grid)) {
        upto.grid = made.grid;
        add_shortcomings(ChainStep::grid, upto, document, known, doubts);
        judge_cells(document, doubts);
    }
    if (made.surface && holds(Stage::fit)) {
        upto.surface = made.surface;
        upto.deformed = made.deformed;
        add_shortcomings(ChainStep::surface, upto, document, known, doubts);
        judge_distance(document, lengths, doubts);
        judge_folds(document, doubts);
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

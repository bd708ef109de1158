#include "app/viewer/model/document/project_file.h"

#include <array>
#include <charconv>
#include <fmt/core.h>

#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/document/k_choice.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/provenance.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/blank/part_bends.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

constexpr std::string_view schema_name = "spia-project/";
constexpr int version = 1;

/// Two ways to a file: they still lead there when the folder of the project, or the project alone,
/// is moved.
struct StoredPath {
    fs::path file;   ///< relative to the project's folder
    fs::path was_at; ///< absolute
};

struct StoredPart : Reading {
    StoredPath path;
    std::optional<LengthUnit> unit;
    SeamOptions seam;
    std::optional<RemeshOptions> remesh;
};

struct StoredProject {
    std::string schema, program;
    StoredPart part;
    std::string material; ///< a grade; empty: of the file
    std::optional<StoredPath> material_file;
    double thickness = 1;
    /// as older files mean it
    SheetSource material_from = SheetSource::chosen, thickness_from = SheetSource::chosen;
    bool skins = false;
    std::optional<Eigen::Vector3d> direction;
    std::string k_factor; ///< empty: none, or a table
    std::optional<StoredPath> k_table;
    std::vector<std::array<double, 2>> k_table_rows; ///< of it, for when the file has gone
    GridOptions grid;
    bool natural_ends = false; ///< how older files have the ends
    std::optional<FitChoice> fit;
    std::optional<LayoutOptions> patches;
    bool best_surface = false; ///< older files have one patch then
    std::vector<ControlMove> moved_controls;
    std::optional<Lattice> lattice;
    InterpolateOptions::Parameters parameters = InterpolateOptions::Parameters::chord;
    std::optional<Stage> ran;
    bool steps_ran = false;
    std::optional<bool> blank_of_steps;
    double edge_restraint = 0;
    std::optional<Eigen::Vector3d> rolling;
    LimitsChoice limits;
    std::optional<StoredPath> limits_table;
    FieldDisplay display;
    ViewSettings view;
    StoredPicks picks;
    std::optional<SectionLine> section;
    fs::path recovers;
};

constexpr Between anywhere_in_space{-most_mm, most_mm};

} // namespace

inline constexpr auto is_sound = [](const std::optional<Lattice>& lattice, const Place& place) {
    try {
        if (lattice)
            require_sound(*lattice);
    } catch (const InputError& error) {
        place.fail(fmt::format("is no lattice: {}", error.what()));
    }
};
template <>
inline constexpr auto members_of<Lattice> =
    std::tuple{required("origin", &Lattice::origin, anywhere_in_space), required("edge", &Lattice::edge),
               required("count", &Lattice::count, lattice_points),
               required("degree", &Lattice::degree, lattice_degrees), required("move", &Lattice::move)};

template <>
inline constexpr auto members_of<StoredPatch> =
    std::tuple{member("face", &StoredPatch::face, any_index), member("piece", &StoredPatch::piece, any_index),
               member("point", &StoredPatch::point, anywhere_in_space), member("triangle", &StoredPatch::triangle)};
template <>
inline constexpr auto members_of<StoredRegion> =
    std::tuple{member("name", &StoredRegion::name),
               member("kind", &StoredRegion::kind),
               member("colour", &StoredRegion::colour, Between{0, 1}),
               member("patch", &StoredRegion::patch),
               member("contact", &StoredRegion::contact, force_or_pressure),
               member("sheet", &StoredRegion::sheet)};
template <>
inline constexpr auto members_of<StoredProbe> =
    std::tuple{required("face", &StoredProbe::face, any_index), member("piece", &StoredProbe::piece, any_index),
               required("barycentric", &StoredProbe::barycentric, is_barycentric),
               required("at", &StoredProbe::at, anywhere_in_space), required("normal", &StoredProbe::normal)};
template <>
inline constexpr auto members_of<StoredMeasurement> =
    std::tuple{required("kind", &StoredMeasurement::kind), required("at", &StoredMeasurement::at)};
template <>
inline constexpr auto members_of<StoredCorner> = std::tuple{required("vertex", &StoredCorner::vertex, any_index),
                                                            required("at", &StoredCorner::at, anywhere_in_space)};
template <>
inline constexpr auto members_of<StoredVertex> =
    std::tuple{required("vertex", &StoredVertex::vertex, any_index), member("boundary", &StoredVertex::boundary),
               required("at", &StoredVertex::at, anywhere_in_space), required("normal", &StoredVertex::normal)};
template <>
inline constexpr auto members_of<StoredStep> =
    std::tuple{member("kind", &StoredStep::kind),
               required("name", &StoredStep::name),
               member("fixed", &StoredStep::fixed, any_index),
               required("freed", &StoredStep::freed, any_index),
               member("carrying", &StoredStep::carrying, any_index),
               member("rubbing", &StoredStep::rubbing, any_index),
               member("within_mm", &StoredStep::within_mm, Between{0, most_mm}),
               member("offset_mm", &StoredStep::offset_mm, Between{-most_mm, most_mm}),
               member("extent_mm", &StoredStep::extent_mm, Between{1e-9, most_mm}),
               member("tolerance", &StoredStep::tolerance, Between{least_step_tolerance, most_step_tolerance}),
               member("most_energy_steps", &StoredStep::most_energy_steps, Between{0, 1e6}),
               member("most_newton_steps", &StoredStep::most_newton_steps, Between{0, 1e6}),
               member("target", &StoredStep::target, one_target),
               member("friction", &StoredStep::friction, one_pressure),
               member("carrying_lost", &StoredStep::carrying_lost)};
template <>
inline constexpr auto members_of<StoredSteps> =
    std::tuple{member("patch", &StoredSteps::patch), member("step", &StoredSteps::step),
               member("proposed", &StoredSteps::proposed), member("root", &StoredSteps::root, any_index)};
template <>
inline constexpr auto members_of<StoredPicks> = std::tuple{member("fingerprint", &StoredPicks::fingerprint),
                                                           member("selected", &StoredPicks::selected),
                                                           member("vertices", &StoredPicks::vertices),
                                                           member("regions", &StoredPicks::regions),
                                                           member("probes", &StoredPicks::probes),
                                                           member("lines", &StoredPicks::lines),
                                                           member("measurements", &StoredPicks::measurements),
                                                           member("corners", &StoredPicks::corners),
                                                           member("steps", &StoredPicks::steps)};
template <>
inline constexpr auto members_of<SectionLine> =
    std::tuple{required("from", &SectionLine::from, anywhere_in_space),
               required("to", &SectionLine::to, anywhere_in_space),
               required("depth", &SectionLine::depth, anywhere_in_space), member("on_blank", &SectionLine::on_blank)};
template <>
inline constexpr auto members_of<StoredPath> =
    std::tuple{required("file", &StoredPath::file), member("was_at", &StoredPath::was_at)};
template <>
inline constexpr auto members_of<StoredPart> =
    std::tuple{required("path", &StoredPart::path),
               member("unit", &StoredPart::unit),
               member("weld", &StoredPart::weld),
               member("weld_gap_mm", &StoredPart::weld_gap_mm, gap_width),
               member("keep_largest", &StoredPart::keep_largest),
               member("seam", &StoredPart::seam),
               member("parts", &StoredPart::parts),
               member("skin", &StoredPart::skin),
               member("sewing_mm", &StoredPart::sewing_mm, gap_width),
               member("deflection_mm", &StoredPart::deflection_mm, chord_height),
               member("leave_out_bad_faces", &StoredPart::leave_out_bad_faces),
               member("keep_triangles", &StoredPart::keep_triangles),
               member("remesh", &StoredPart::remesh)};
template <>
inline constexpr auto members_of<StoredProject> =
    std::tuple{required("schema", &StoredProject::schema),
               member("program", &StoredProject::program),
               required("part", &StoredProject::part),
               member("material", &StoredProject::material),
               member("material_file", &StoredProject::material_file),
               required("thickness", &StoredProject::thickness, Between{1e-6, 1e6}),
               member("material_from", &StoredProject::material_from),
               member("thickness_from", &StoredProject::thickness_from),
               member("skins", &StoredProject::skins),
               member("direction", &StoredProject::direction),
               member("k_factor", &StoredProject::k_factor),
               member("k_table", &StoredProject::k_table),
               member("k_table_rows", &StoredProject::k_table_rows),
               member("grid", &StoredProject::grid),
               member("natural_ends", &StoredProject::natural_ends),
               member("fit", &StoredProject::fit),
               member("patches", &StoredProject::patches),
               member("best_surface", &StoredProject::best_surface),
               member("moved_controls", &StoredProject::moved_controls),
               member("lattice", &StoredProject::lattice, is_sound),
               member("parameters", &StoredProject::parameters),
               member("ran", &StoredProject::ran),
               member("steps_ran", &StoredProject::steps_ran),
               member("blank_of_steps_polished", &StoredProject::blank_of_steps),
               member("edge_restraint", &StoredProject::edge_restraint, Between{0, 1}),
               member("rolling", &StoredProject::rolling),
               member("limits", &StoredProject::limits),
               member("limits_table", &StoredProject::limits_table),
               member("display", &StoredProject::display),
               member("view", &StoredProject::view),
               member("picks", &StoredProject::picks),
               member("section", &StoredProject::section),
               member("recovers", &StoredProject::recovers)};

namespace {

StoredPath stored_path(const fs::path& path, const fs::path& folder)
{
    const fs::path whole = fs::weakly_canonical(fs::absolute(path));
    return {whole.lexically_proximate(folder), whole};
}

fs::path found_path(const StoredPath& stored, const fs::path& folder)
{
    const fs::path near = (folder / stored.file).lexically_normal();
    std::error_code ignored;
    return !fs::exists(near, ignored) && fs::exists(stored.was_at, ignored) ? stored.was_at : near;
}

/// As find_material() tells a path from a grade.
bool is_file(const std::string& material)
{
    const fs::path path(material);
    return path.has_parent_path() || path.extension() == ".json";
}

std::optional<Stage> last_stage(const Session& session)
{
    const bool there[] = {session.part != nullptr, session.blank != nullptr, session.grid != nullptr,
                          session.lifted != nullptr, session.surface != nullptr};
    std::optional<Stage> last;
    for (const Stage stage : chain)
        if (there[size_t(stage)])
            last = stage;
    return last;
}

/// Before anything else is looked at: another version may look otherwise.
void require_version(const Json& json, const fs::path& file)
{
    const auto found = json.is_object() ? json.find("schema") : json.end();
    const std::string schema = found != json.end() && found->is_string() ? found->get<std::string>() : "";
    int number = 0;
    const char* end = schema.data() + schema.size();
    const char* digits = schema.data() + std::min(schema.size(), schema_name.size());
    const auto [rest, error] = std::from_chars(digits, end, number);
    if (!schema.starts_with(schema_name) || error != std::errc() || rest != end || number < 1)
        throw InputError(fmt::format("{} is not a SPIA project: it does not begin with \"schema\": \"{}{}\"",
                                     file.string(), schema_name, version));
    if (number > version)
        throw InputError(
            fmt::format("{} was saved by a newer version of the program ({}); this one reads projects up to "
                        "{}{}: install the newer version to open it",
                        file.string(), schema, schema_name, version));
}

/// Members that older projects of this version have otherwise.
void translate_older(Json& json)
{
    // Older projects name vertices of the triangles of the CAD faces: these stay.
    if (const auto part = json.find("part");
        part != json.end() && part->is_object() && !part->contains("keep_triangles"))
        (*part)["keep_triangles"] = true;
    // Thickening was a field of its own; it is thinning below 0.
    if (const auto display = json.find("display");
        display != json.end() && display->is_object() && display->value("field", Json()) == "thickening") {
        (*display)["field"] = "thinning";
        if (const auto range = display->find("range"); range != display->end() && range->is_array() &&
                                                       range->size() == 2 && (*range)[0].is_number() &&
                                                       (*range)[1].is_number())
            *range = {-(*range)[1].get<double>(), -(*range)[0].get<double>()};
    }
    const auto view = json.find("view");
    if (view == json.end() || !view->is_object())
        return;
    if (const auto deviation = view->find("surface_deviation"); deviation != view->end() && deviation->is_boolean()) {
        (*view)["surface_look"] = name_in_table(deviation->get<bool>() ? SurfaceLook::deviation : SurfaceLook::plain);
        view->erase("surface_deviation");
    }
}

void require_directions(const StoredProject& stored, const Place& place)
{
    if (stored.direction && !(stored.direction->norm() > 0))
        place.member("direction").fail("must have a length; null stands for the automatic direction");
    if (stored.rolling && !(stored.rolling->norm() > 0))
        place.member("rolling").fail("must have a length; null stands for a sheet that is isotropic in its plane");
}

void require_section(const StoredProject& stored, const Place& place)
{
    const auto& line = stored.section;
    if (line && !((line->to - line->from).cross(line->depth).norm() > 0))
        place.member("section").fail("must have two places and a depth that is not along their line");
}

std::optional<KFactor> stored_k(const StoredProject& stored, const fs::path& file, const fs::path& folder)
{
    if (!stored.k_table && stored.k_factor.empty())
        return std::nullopt;
    try {
        if (!stored.k_table)
            return k_factor(stored.k_factor);
        const fs::path table = found_path(*stored.k_table, folder);
        std::error_code ignored;
        if (fs::is_regular_file(table, ignored))
            return k_factor(table.string());
        if (stored.k_table_rows.empty())
            throw InputError(fmt::format("its table {} no longer exists; put it back", table.string()));
        std::string text;
        for (const auto& [ratio, k] : stored.k_table_rows)
            text += fmt::format("{} {}\n", ratio, k);
        return parse_k_table(text, table.string());
    } catch (const Error& error) {
        throw InputError(fmt::format("{}: its K factor cannot be read: {}", file.string(), error.what()));
    }
}

Document document_of(const StoredProject& stored, const fs::path& file, const fs::path& folder,
                     const fs::path& materials)
{
    Document document;
    Session& session = document.session;
    session.file = found_path(stored.part.path, folder);
    session.options.read.unit = stored.part.unit;
    session.options.read.seam = stored.part.seam;
    set_reading(session.options.read, stored.part);
    session.options.read.remesh = stored.part.remesh;
    document.material = stored.material_file ? found_path(*stored.material_file, folder).string() : stored.material;
    try {
        session.options.flatten.material = find_material(document.material, materials);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: its material cannot be read: {}", file.string(), error.what()));
    }
    session.options.flatten.thickness = stored.thickness;
    const auto source = [](SheetSource from) { // the part before is another one by now
        return from == SheetSource::before ? SheetSource::assumed : from;
    };
    document.material_from = source(stored.material_from);
    document.thickness_from = source(stored.thickness_from);
    session.options.flatten.skins = stored.skins;
    session.options.flatten.direction = stored.direction;
    session.options.k_factor = stored_k(stored, file, folder);
    session.options.grid = stored.grid;
    set_fit(session.options, stored.fit.value_or(FitChoice{.ends = stored.natural_ends ? CurveEnds::natural
                                                                                       : CurveEnds::averaged_knots}));
    session.options.interpolate.parameters = stored.parameters;
    session.options.patches = stored.patches;
    session.options.best_surface = stored.best_surface && !stored.patches;
    if (!stored.moved_controls.empty() || stored.lattice)
        session.options.deformation = Deformation{stored.moved_controls, stored.lattice};
    document.edge_restraint = stored.edge_restraint;
    document.rolling = stored.rolling;
    document.limits = stored.limits;
    if (stored.limits_table)
        document.limits.table = found_path(*stored.limits_table, folder);
    try {
        session.options.limits = limits_options(document.limits);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: its forming limit curve cannot be read: {}", file.string(), error.what()));
    }
    document.display = stored.display;
    document.section = stored.section;
    return document;
}

} // namespace

void save_project(const fs::path& file, const Document& document, const ViewSettings& view, const fs::path& recovers)
{
    const Session& session = document.session;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file)).parent_path();
    StoredProject stored;
    stored.schema = fmt::format("{}{}", schema_name, version);
    stored.program = program_name();
    stored.picks = store_picks(document);
    static_cast<Reading&>(stored.part) = reading_of(session.options.read);
    stored.part.path = stored_path(session.file, folder);
    stored.part.unit = session.options.read.unit;
    stored.part.seam = session.options.read.seam;
    stored.part.remesh = session.options.read.remesh;
    if (is_file(document.material))
        stored.material_file = stored_path(document.material, folder);
    else
        stored.material = document.material;
    stored.thickness = session.options.flatten.thickness;
    stored.material_from = document.material_from;
    stored.thickness_from = document.thickness_from;
    stored.skins = session.options.flatten.skins;
    stored.direction = session.options.flatten.direction;
    if (const auto& k = session.options.k_factor; k_source(k) == KSource::table) {
        stored.k_table = stored_path(k->name, folder);
        for (const auto& [ratio, value] : k->table)
            stored.k_table_rows.push_back({ratio, value});
    } else
        stored.k_factor = k_text(k);
    stored.grid = session.options.grid;
    stored.natural_ends = session.options.interpolate.ends == CurveEnds::natural;
    stored.fit = fit_choice(session.options);
    stored.patches = session.options.patches;
    stored.best_surface = session.options.best_surface;
    if (const auto& deformation = session.options.deformation) {
        stored.moved_controls = deformation->moves;
        stored.lattice = deformation->lattice;
    }
    stored.parameters = session.options.interpolate.parameters;
    stored.ran = last_stage(session);
    stored.steps_ran = steps_done(document) > 0;
    if (const auto& steps = document.made_with.steps; steps && session.blank)
        stored.blank_of_steps = steps->polish;
    stored.edge_restraint = document.edge_restraint;
    stored.rolling = document.rolling;
    stored.limits = document.limits;
    if (!std::exchange(stored.limits.table, {}).empty())
        stored.limits_table = stored_path(document.limits.table, folder);
    stored.display = document.display;
    stored.view = view;
    stored.section = document.section;
    stored.recovers = recovers;
    Json json = written(stored);
    json["view"].erase("mouse"); // a habit of the user
    write_atomically(file, lines_of(json, file.string()));
}

Project open_project(const fs::path& file, const fs::path& materials)
{
    Json json = read_json(file);
    require_version(json, file);
    translate_older(json);
    StoredProject stored;
    const std::string name = file.string();
    const Place place(name);
    read(json, stored, place);
    require_directions(stored, place);
    require_section(stored, place);
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(file), error);
    const fs::path folder = (error ? file : whole).parent_path();
    return {document_of(stored, file, folder, materials),
            stored.view,
            std::move(stored.picks),
            stored.ran,
            stored.steps_ran,
            stored.blank_of_steps,
            stored.recovers};
}

} // namespace spia::viewer

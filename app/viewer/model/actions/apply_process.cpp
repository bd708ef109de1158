#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/actions/names.h"
#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/grades.h"
#include "engine/core/atomic_file.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/material/material_text.h"

namespace spia::viewer {

template <class Edit> void ViewerModel::Apply::change_process(std::string name, bool merge, const Edit& edit)
{
    Document edited = document;
    edit(edited);
    edited.session.options.flatten.process = process_of(edited, model.assets() / "materials");
    change(std::move(name), merge);
    edited.unsaved = document.unsaved;
    document = std::move(edited);
}

/// What only judges a sheet takes effect at once, as SetLimits does: the blank need not be made
/// anew.
void ViewerModel::Apply::change_material(std::string name, const std::function<void(Document&)>& edit)
{
    change_process(std::move(name), false, edit);
    const Material& wanted = session.options.flatten.material;
    Material& made = document.made_with.flatten.material;
    if (!session.blank || made == wanted || !formed_alike(made, wanted))
        return;
    made = wanted;
    session.limits = judge_limits(as_made(document)).limits;
}

void ViewerModel::Apply::operator()(const SetMaterial& action)
{
    const Grade* grade = grade_called(*state.grades, action.material);
    // a file keeps its meaning
    const std::string reference = grade && grade->own ? grade->reference : action.material;
    const Material material = find_material(reference, model.assets() / "materials");
    change_material("Change material", [&](Document& edited) {
        edited.material = reference;
        edited.material_from = SheetSource::chosen;
        edited.session.options.flatten.material = material;
    });
}

void ViewerModel::Apply::operator()(const FitMaterial& action)
{
    const std::filesystem::path out = std::filesystem::absolute(action.out);
    if (out == std::filesystem::absolute(action.table))
        throw InputError(fmt::format("{} would be overwritten; choose another file for the material.", out.string()));
    MaterialFitOptions options = action.fit;
    if (options.name.empty())
        options.name = out.stem().string();
    const MaterialFit fit = fit_material(action.table, options);
    write_atomically(out, material_text(fit.material));
    if (out.parent_path() == own_materials())
        state.grades =
            std::make_shared<const std::vector<Grade>>(read_grades(model.assets() / "materials", own_materials()));
    (*this)(SetMaterial{out.string()});
    model.say(Severity::hint,
              fmt::format("The material {} was written to {}: {}.", options.name, out.string(), fit.material.source));
}

void ViewerModel::Apply::operator()(const SetThickness& action)
{
    if (!(action.thickness > 0 && action.thickness < 1000))
        throw InputError("The thickness must be above 0 and below 1000 mm.");
    change_process("Change thickness", true, [&](Document& edited) {
        edited.session.options.flatten.thickness = action.thickness;
        edited.thickness_from = SheetSource::chosen;
    });
}

void ViewerModel::Apply::operator()(const ChangeRegion& action)
{
    const size_t number = region(action.region);
    require_some_free(action.kind, document.regions[number].faces);
    change_process("Change region", true, [&](Document& edited) {
        FaceRegion& changed = edited.regions[number];
        changed.name = action.name;
        changed.kind = action.kind;
        if (action.colour[3] > 0)
            changed.colour = action.colour;
        if (!is_tool(changed.kind))
            changed.contact.reset();
        if (changed.kind != RegionKind::material)
            changed.sheet.reset();
    });
}

void ViewerModel::Apply::operator()(const RemoveRegion& action)
{
    const size_t number = region(action.region);
    change_process("Remove region", false,
                   [&](Document& edited) { edited.regions.erase(edited.regions.begin() + long(number)); });
}

void ViewerModel::Apply::operator()(const SetContact& action)
{
    const size_t number = region(action.region);
    const FaceRegion& pressed = document.regions[number];
    if (action.contact && !is_tool(pressed.kind))
        throw InputError(
            fmt::format("The region \"{}\" is {}: only a binder, a pad or the punch presses on the sheet. Change its "
                        "kind first.",
                        pressed.name, name(pressed.kind)));
    if (action.contact && action.contact->force_N.has_value() == action.contact->pressure_MPa.has_value())
        throw InputError("A tool presses either with a force or with a pressure.");
    change_process("Change contact", true, [&](Document& edited) { edited.regions[number].contact = action.contact; });
}

void ViewerModel::Apply::operator()(const SetOwnSheet& action)
{
    const size_t number = region(action.region);
    change_process("Change sheet of region", true, [&](Document& edited) {
        edited.regions[number].sheet = action.sheet;
        if (action.sheet)
            edited.regions[number].kind = RegionKind::material;
    });
}

size_t ViewerModel::Apply::line(int number) const
{
    if (number < 0 || size_t(number) >= document.lines.size())
        throw InputError(fmt::format("There is no line {}.", number + 1));
    return size_t(number);
}

void ViewerModel::Apply::operator()(const AddLine& action)
{
    part();
    ProcessLine line = action.line;
    if (line.kind == LineKind::drawbead && line.point.size() < 2)
        throw InputError("A drawbead needs a line of at least two points.");
    if (line.name.empty()) {
        const auto alike = std::count_if(document.lines.begin(), document.lines.end(),
                                         [&](const ProcessLine& each) { return each.kind == line.kind; });
        line.name = fmt::format("{} {}", name_in_table(line.kind), alike + 1);
    }
    change_process(line.kind == LineKind::drawbead ? "Draw drawbead" : "Draw pilot", false,
                   [&](Document& edited) { edited.lines.push_back(std::move(line)); });
}

void ViewerModel::Apply::operator()(const ChangeLine& action)
{
    const size_t number = line(action.number);
    if (action.line.kind == LineKind::drawbead && action.line.point.size() < 2)
        throw InputError("A drawbead needs a line of at least two points.");
    change_process("Change line", true, [&](Document& edited) { edited.lines[number] = action.line; });
}

void ViewerModel::Apply::operator()(const RemoveLine& action)
{
    const size_t number = line(action.number);
    change_process("Remove line", false,
                   [&](Document& edited) { edited.lines.erase(edited.lines.begin() + long(number)); });
}

void ViewerModel::Apply::operator()(const PinVertices&)
{
    if (document.vertices.empty())
        throw InputError("Pick vertices first; each becomes a pilot.");
    change_process("Pin vertices", false, [&](Document& edited) {
        for (const int v : document.vertices)
            edited.lines.push_back({LineKind::pilot,
                                    fmt::format("pilot at {}", part().source_vertex[size_t(v)]),
                                    {part().mesh.position.col(v)}});
    });
}

void ViewerModel::Apply::operator()(const SetProcess& action)
{
    if (!(action.edge_restraint >= 0 && action.edge_restraint <= 1))
        throw InputError("The edge restraint is a share of the lock force, from 0 to 1.");
    if (action.rolling && !(action.rolling->norm() > 0))
        throw InputError("The rolling direction needs a length above 0.");
    change_process("Change process", true, [&](Document& edited) {
        edited.edge_restraint = action.edge_restraint;
        edited.rolling = action.rolling;
    });
}

} // namespace spia::viewer

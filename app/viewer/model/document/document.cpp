#include "app/viewer/model/document/document.h"

#include <algorithm>

#include "app/viewer/model/actions/names.h"
#include "engine/forming/material/material_library.h"

namespace spia::viewer {

std::string_view name(RegionKind kind) { return name_in_table(kind); }
RegionKind region_kind(std::string_view name) { return value_by_name<RegionKind>(name); }

bool is_tool(RegionKind kind)
{
    return kind == RegionKind::binder || kind == RegionKind::pad || kind == RegionKind::punch;
}

std::optional<double> bead_force(const Document& document, size_t line)
{
    const auto bead = [](const ProcessLine& each) { return each.kind == LineKind::drawbead; };
    const auto here = document.lines.begin() + long(line);
    const std::vector<Drawbead>& beads = document.session.options.flatten.process.drawbeads;
    const auto before = size_t(std::count_if(document.lines.begin(), here, bead));
    return bead(*here) && before < beads.size() ? std::optional(beads[before].force_N_mm) : std::nullopt;
}

ProcessConditions process_of(const Document& document, const std::filesystem::path& materials)
{
    ProcessConditions process;
    for (const FaceRegion& region : document.regions) {
        if (region.contact)
            process.contact.push_back({region.name, region.faces, region.contact->pressure_MPa, region.contact->force_N,
                                       region.contact->friction, region.kind == RegionKind::binder ? 2 : 1});
        if (region.sheet)
            process.tailored.push_back(
                {region.name, region.faces, find_material(region.sheet->material, materials), region.sheet->thickness});
    }
    const FlattenOptions& sheet = document.session.options.flatten;
    for (const ProcessLine& line : document.lines)
        if (line.kind == LineKind::pilot)
            process.pilots.push_back({line.name, line.point});
        else if (line.shape && document.session.part)
            process.drawbeads.push_back({line.name, line.point,
                                         drawbead_force(*line.shape, line.point, document.session.part->mesh,
                                                        sheet.material, sheet.thickness, process.tailored)});
        else
            process.drawbeads.push_back(
                {line.name, line.point,
                 line.shape ? drawbead_force(*line.shape, sheet.material, sheet.thickness) : line.force_N_mm});
    process.edge_restraint = document.edge_restraint;
    process.rolling = document.rolling;
    return process;
}

FieldDisplay with_field(FieldDisplay display, Field field, std::optional<ColourMap> map)
{
    display.field = field;
    display.range.reset();
    display.map = map;
    return display;
}

bool by_face(const FieldDisplay& display) { return display.per_face || display.field == Field::zone; }

bool is_smoothed(const FieldDisplay& display)
{
    return !by_face(display) && display.field != Field::none &&
           display.field != Field::deviation; // that is measured at the vertices
}

} // namespace spia::viewer

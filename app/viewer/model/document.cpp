#include "app/viewer/model/document.h"

#include "app/viewer/model/names.h"
#include "engine/forming/material_library.h"

namespace spia::viewer {

std::string_view name(RegionKind kind) { return name_in_table(kind); }
RegionKind region_kind(std::string_view name) { return value_by_name<RegionKind>(name); }

bool is_tool(RegionKind kind)
{
    return kind == RegionKind::binder || kind == RegionKind::pad || kind == RegionKind::punch;
}

double bead_force(const ProcessLine& bead, const Document& document)
{
    const FlattenOptions& sheet = document.session.options.flatten;
    return bead.shape ? drawbead_force(*bead.shape, sheet.material, sheet.thickness) : bead.force_N_mm;
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
    for (const ProcessLine& line : document.lines)
        if (line.kind == LineKind::drawbead)
            process.drawbeads.push_back({line.name, line.point, bead_force(line, document)});
        else
            process.pilots.push_back({line.name, line.point});
    process.edge_restraint = document.edge_restraint;
    process.rolling = document.rolling;
    return process;
}

} // namespace spia::viewer

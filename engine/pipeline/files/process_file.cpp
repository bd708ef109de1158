#include "engine/pipeline/files/process_file.h"

#include <optional>

#include "engine/core/json_file.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/process/drawbead.h"
#include "engine/pipeline/files/file_members.h"

namespace spia {
namespace {

using namespace members;

constexpr double most_force = 1e9, largest_mm = 1e9;

ContactRegion contact(const Json& json, const Place& place, const std::string& name, const PartFile& part)
{
    require_object(json, place, {"name", "faces", "box", "force_N", "pressure_MPa", "friction", "sides"});
    ContactRegion region;
    region.name = text_in(json, place, "name", name);
    region.faces = faces_in(json, place, part);
    region.force_N = number_in(json, place, "force_N", 0, most_force);
    region.pressure_MPa = number_in(json, place, "pressure_MPa", 0, 1e5);
    region.friction = *number_in(json, place, "friction", 0, 10, true);
    const double sides = number_in(json, place, "sides", 1, 2).value_or(2);
    if (sides != 1 && sides != 2)
        place.member("sides").fail("must be 1 or 2");
    region.sides = int(sides);
    if (region.force_N.has_value() == region.pressure_MPa.has_value())
        place.fail("needs either the member \"force_N\" or \"pressure_MPa\"");
    return region;
}

/// @param force_of  the force of a shape on a line
template <class ForceOf>
Drawbead drawbead(const Json& json, const Place& place, const std::string& name, const ForceOf& force_of)
{
    require_object(json, place, {"name", "line", "force_N_mm", "shape"});
    Drawbead bead{text_in(json, place, "name", name), line(*find(json, place, "line", true), place.member("line")), 0};
    const Json* shape = find(json, place, "shape", false);
    const std::optional<double> force = number_in(json, place, "force_N_mm", 0, most_force);
    if (force.has_value() == (shape != nullptr))
        place.fail("needs either the member \"force_N_mm\" or \"shape\"");
    if (force) {
        bead.force_N_mm = *force;
        return bead;
    }
    const Place at = place.member("shape");
    require_object(*shape, at, {"radius", "shoulder_radius", "depth", "friction"});
    BeadShape form;
    form.radius = *number_in(*shape, at, "radius", 0, largest_mm, true);
    form.shoulder_radius = *number_in(*shape, at, "shoulder_radius", 0, largest_mm, true);
    form.depth = *number_in(*shape, at, "depth", 0, largest_mm, true);
    form.friction = number_in(*shape, at, "friction", 0, 10).value_or(form.friction);
    bead.force_N_mm = force_of(form, bead.line);
    return bead;
}

} // namespace

ProcessConditions read_process(const std::filesystem::path& file, const PartFile& part, const Material& material,
                               double thickness, const std::filesystem::path& materials)
{
    const Json json = read_json(file, true);
    const std::string name = file.string();
    const Place top(name);
    require_object(json, top, {"contact", "drawbeads", "edge_restraint", "pilots", "tailored", "rolling"});
    ProcessConditions process;
    each_of(json, top, "contact", [&](const Json& each, const Place& place, const std::string& otherwise) {
        process.contact.push_back(contact(each, place, otherwise, part));
    });
    process.edge_restraint = number_in(json, top, "edge_restraint", 0, 1).value_or(0);
    each_of(json, top, "pilots", [&](const Json& each, const Place& place, const std::string& otherwise) {
        require_object(each, place, {"name", "line"});
        process.pilots.push_back(
            {text_in(each, place, "name", otherwise), line(*find(each, place, "line", true), place.member("line"))});
    });
    each_of(json, top, "tailored", [&](const Json& each, const Place& place, const std::string& otherwise) {
        require_object(each, place, {"name", "faces", "box", "material", "thickness"});
        process.tailored.push_back({text_in(each, place, "name", otherwise), faces_in(each, place, part),
                                    find(each, place, "material", false)
                                        ? find_material(text_in(each, place, "material", ""), materials)
                                        : material,
                                    *number_in(each, place, "thickness", 1e-6, 1e3, true)});
    });
    const auto force_of = [&](const BeadShape& shape, const std::vector<Eigen::Vector3d>& line) {
        return drawbead_force(shape, line, part.mesh, material, thickness, process.tailored);
    };
    each_of(json, top, "drawbeads", [&](const Json& each, const Place& place, const std::string& otherwise) {
        process.drawbeads.push_back(drawbead(each, place, otherwise, force_of));
    });
    if (const Json* rolling = find(json, top, "rolling", false))
        process.rolling = vector(*rolling, top.member("rolling"));
    return process;
}

} // namespace spia

#include "engine/pipeline/process_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/forming/drawbead.h"
#include "engine/forming/material_library.h"

namespace spia {
namespace {

void require_object(const Json& json, const Place& place, std::initializer_list<std::string_view> members)
{
    if (!json.is_object())
        place.fail("must be an object { }");
    for (const auto& item : json.items())
        if (std::find(members.begin(), members.end(), item.key()) == members.end())
            place.fail(fmt::format("has no member \"{}\"; there are: {}", item.key(), fmt::join(members, ", ")));
}

/// @returns the value, or null where it may be missing
const Json* find(const Json& json, const Place& place, std::string_view name, bool required)
{
    const auto found = json.find(name);
    if (found == json.end() && required)
        place.fail(fmt::format("needs the member \"{}\"", name));
    return found == json.end() ? nullptr : &*found;
}

double number(const Json& json, const Place& place, double least, double greatest)
{
    if (!json.is_number() || !std::isfinite(json.get<double>()))
        place.fail("must be a number");
    const double value = json.get<double>();
    if (value < least || value > greatest)
        place.fail(fmt::format("is {} but must be from {} to {}", value, least, greatest));
    return value;
}

std::optional<double> number_in(const Json& json, const Place& place, std::string_view name, double least,
                                double greatest, bool required = false)
{
    const Json* value = find(json, place, name, required);
    return value ? std::optional(number(*value, place.member(name), least, greatest)) : std::nullopt;
}

std::string text_in(const Json& json, const Place& place, std::string_view name, const std::string& otherwise)
{
    const Json* value = find(json, place, name, false);
    if (value && !value->is_string())
        place.member(name).fail("must be a text in \" \"");
    return value ? value->get<std::string>() : otherwise;
}

Eigen::Vector3d vector(const Json& json, const Place& place)
{
    if (!json.is_array() || json.size() != 3)
        place.fail("must be three numbers [x, y, z]");
    Eigen::Vector3d v;
    for (size_t k = 0; k < 3; ++k)
        v[Eigen::Index(k)] = number(json[k], place.entry(k), -1e9, 1e9);
    return v;
}

std::vector<Eigen::Vector3d> line(const Json& json, const Place& place)
{
    if (!json.is_array() || json.empty())
        place.fail("must be a list of places [[x, y, z], ...]");
    std::vector<Eigen::Vector3d> result;
    for (size_t i = 0; i < json.size(); ++i)
        result.push_back(vector(json[i], place.entry(i)));
    return result;
}

/// By "faces", numbers in the file, and by "box", the least and the greatest corner; both together are united.
std::vector<int> faces_in(const Json& json, const Place& place, const PartFile& part)
{
    std::vector<char> chosen(size_t(part.mesh.triangles()), 0);
    const Json *faces = find(json, place, "faces", false), *box = find(json, place, "box", false);
    if (!faces && !box)
        place.fail("needs the member \"faces\" or \"box\"");
    if (faces) {
        const Place at = place.member("faces");
        if (!faces->is_array())
            at.fail("must be a list of face numbers");
        for (size_t i = 0; i < faces->size(); ++i) {
            const double wanted = number((*faces)[i], at.entry(i), 0, 2147483647);
            const auto [from, to] =
                std::equal_range(part.source_face.begin(), part.source_face.end(), int(wanted)); // never decreases
            if (wanted != std::floor(wanted) || from == to)
                at.entry(i).fail(fmt::format("is {}: the part has no such face", wanted));
            for (auto f = from; f != to; ++f)
                chosen[size_t(f - part.source_face.begin())] = 1;
        }
    }
    if (box) {
        const std::vector<Eigen::Vector3d> ends = line(*box, place.member("box"));
        if (ends.size() != 2)
            place.member("box").fail("must be two places: the least and the greatest corner");
        for (int f = 0; f < part.mesh.triangles(); ++f) {
            const Eigen::Vector3d middle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f)).rowwise().mean();
            chosen[size_t(f)] |= char((middle.array() >= ends[0].array() && middle.array() <= ends[1].array()).all());
        }
    }
    std::vector<int> result;
    for (size_t f = 0; f < chosen.size(); ++f)
        if (chosen[f])
            result.push_back(int(f));
    if (result.empty())
        place.fail("picks no face of the part");
    return result;
}

/// Reads the entries of a list member, each at its place.
template <class Read> void each_of(const Json& json, const Place& place, std::string_view name, const Read& read)
{
    const Json* list = find(json, place, name, false);
    if (!list)
        return;
    const Place at = place.member(name);
    if (!list->is_array())
        at.fail("must be a list [ ]");
    for (size_t i = 0; i < list->size(); ++i)
        read((*list)[i], at.entry(i), fmt::format("{} {}", name, i + 1));
}

constexpr double most_force = 1e9, most_mm = 1e9;

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
    form.radius = *number_in(*shape, at, "radius", 0, most_mm, true);
    form.shoulder_radius = *number_in(*shape, at, "shoulder_radius", 0, most_mm, true);
    form.depth = *number_in(*shape, at, "depth", 0, most_mm, true);
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

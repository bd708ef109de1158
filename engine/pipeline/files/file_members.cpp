#include "engine/pipeline/files/file_members.h"

#include <cmath>

namespace spia::members {

void require_object(const Json& json, const Place& place, std::initializer_list<std::string_view> members)
{
    if (!json.is_object())
        place.fail("must be an object { }");
    for (const auto& item : json.items())
        if (std::find(members.begin(), members.end(), item.key()) == members.end())
            place.fail(fmt::format("has no member \"{}\"; there are: {}", item.key(), fmt::join(members, ", ")));
}

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
                                double greatest, bool required)
{
    const Json* value = find(json, place, name, required);
    return value ? std::optional(number(*value, place.member(name), least, greatest)) : std::nullopt;
}

std::string text(const Json& json, const Place& place)
{
    if (!json.is_string())
        place.fail("must be a text in \" \"");
    return json.get<std::string>();
}

std::string text_in(const Json& json, const Place& place, std::string_view name, const std::string& otherwise)
{
    const Json* value = find(json, place, name, false);
    return value ? text(*value, place.member(name)) : otherwise;
}

std::string entry_name(std::string_view list, size_t index)
{
    if (list.ends_with('s'))
        list.remove_suffix(1);
    return fmt::format("{} {}", list, index + 1);
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

void choose_faces(const Json& json, const Place& place, const PartFile& part, std::vector<char>& chosen)
{
    if (!json.is_array())
        place.fail("must be a list of face numbers");
    std::vector<int> wanted;
    for (size_t i = 0; i < json.size(); ++i) {
        const double face = number(json[i], place.entry(i), 0, 2147483647);
        if (face != std::floor(face) || !has_face(part, int(face)))
            place.entry(i).fail(fmt::format("is {}: the part has no such face", face));
        wanted.push_back(int(face));
    }
    const std::vector<char> called = faces_called(part, wanted);
    for (size_t f = 0; f < called.size(); ++f)
        chosen[f] = char(chosen[f] | called[f]);
}

void choose_box(const Json& json, const Place& place, const PartFile& part, std::vector<char>& chosen)
{
    const std::vector<Eigen::Vector3d> ends = line(json, place);
    if (ends.size() != 2)
        place.fail("must be two places: the least and the greatest corner");
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const Eigen::Vector3d middle = part.mesh.position(Eigen::all, part.mesh.triangle.col(f)).rowwise().mean();
        chosen[size_t(f)] |= char((middle.array() >= ends[0].array() && middle.array() <= ends[1].array()).all());
    }
}

std::vector<int> chosen_faces(const std::vector<char>& chosen)
{
    std::vector<int> result;
    for (size_t f = 0; f < chosen.size(); ++f)
        if (chosen[f])
            result.push_back(int(f));
    return result;
}

std::vector<int> faces_in(const Json& json, const Place& place, const PartFile& part)
{
    std::vector<char> chosen(size_t(part.mesh.triangles()), 0);
    const Json *faces = find(json, place, "faces", false), *box = find(json, place, "box", false);
    if (!faces && !box)
        place.fail("needs the member \"faces\" or \"box\"");
    if (faces)
        choose_faces(*faces, place.member("faces"), part, chosen);
    if (box)
        choose_box(*box, place.member("box"), part, chosen);
    const std::vector<int> result = chosen_faces(chosen);
    if (result.empty())
        place.fail("picks no face of the part");
    return result;
}

} // namespace spia::members

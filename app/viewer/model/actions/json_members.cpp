#include "app/viewer/model/actions/json_members.h"

#include <algorithm>

namespace spia::viewer {
namespace {

std::string names(std::span<const AnyMember> members)
{
    std::string list;
    for (const AnyMember& each : members)
        list += fmt::format("{}{}", list.empty() ? "" : ", ", each.name);
    return list.empty() ? "none" : list;
}

} // namespace

void read_any_members(const Json& json, void* owner, std::span<const AnyMember> members, const Place& place,
                      std::string_view besides)
{
    if (!json.is_object())
        place.fail("must be an object { }");
    for (const auto& item : json.items()) {
        const std::string& key = item.key();
        const bool known =
            std::any_of(members.begin(), members.end(), [&](const AnyMember& m) { return m.name == key; });
        if (!known && (besides.empty() || key != besides))
            place.fail(fmt::format("has no member \"{}\"; there are: {}", key, names(members)));
    }
    for (const AnyMember& member : members) {
        const auto found = json.find(member.name);
        if (found != json.end())
            member.read(member.member, *found, owner, place.member(member.name));
        else if (member.required)
            place.fail(fmt::format("needs the member \"{}\"", member.name));
    }
}

void write_any_members(const void* owner, std::span<const AnyMember> members, Json& json)
{
    for (const AnyMember& member : members)
        json[std::string(member.name)] = member.write(member.member, owner);
}

} // namespace spia::viewer

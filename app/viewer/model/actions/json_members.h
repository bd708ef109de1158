#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "app/viewer/model/actions/names.h"
#include "engine/core/json_file.h"
#include "engine/options/option.h"
#include "engine/report/figures/field.h"

/// Structs to and from JSON by a list of their members, once for scripts, projects and reports:
///
///     template <> inline constexpr auto members_of<Probe> =
///         std::tuple{required("face", &Probe::face, Between{0, most}),
///                    member("barycentric", &Probe::barycentric)};
///
/// Reading is strict (an unknown member or a wrong type is an InputError that names the place and
/// what is allowed there) and partial: what is not given keeps the value it has.
namespace spia::viewer {

/// Bounds of a number, both allowed. Not given is allowed, too.
struct Between {
    double least, greatest;

    template <class T> void operator()(const T& value, const Place& place) const
    {
        if constexpr (std::is_arithmetic_v<T>) {
            if (!(double(value) >= least && double(value) <= greatest))
                place.fail(fmt::format("is {} but must be from {} to {}", value, least, greatest));
        } else if constexpr (requires { value.has_value(); }) {
            if (value)
                (*this)(*value, place);
        } else if constexpr (requires { value.reshaped(); }) {
            for (Eigen::Index i = 0; i < value.size(); ++i)
                (*this)(value.reshaped()[i], place.entry(size_t(i)));
        } else {
            for (size_t i = 0; i < value.size(); ++i)
                (*this)(value[i], place.entry(i));
        }
    }
};

/// Of an option, where it has a range.
struct InRange {
    std::optional<Range> range;

    void operator()(const auto& value, const Place& place) const
    {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>> || requires { *value + 1.; }) {
            if (range)
                Between{range->least, range->greatest}(value, place);
        }
    }
};

inline constexpr Between any_index{0, std::numeric_limits<int>::max()};
inline constexpr double most_mm = 1e9; ///< no part is larger: what is beyond is damage
struct Anything {
    void operator()(const auto&, const Place&) const {}
};

template <class S, class T, class Check> struct Member {
    std::string_view name;
    T S::*where;
    bool required;
    Check check; ///< of the value read: check(value, place)
};
template <class S, class T, class Check = Anything>
constexpr Member<S, T, Check> member(std::string_view name, T S::*where, Check check = {})
{
    return {name, where, false, check};
}
/// As an option is described.
template <class S, class T> constexpr Member<S, T, InRange> member(const Option& option, T S::*where)
{
    return {option.key, where, false, {option.range}};
}
template <class S, class T, class Check = Anything>
constexpr Member<S, T, Check> required(std::string_view name, T S::*where, Check check = {})
{
    return {name, where, true, check};
}

struct NoMembers {};
template <class T> inline constexpr NoMembers members_of{}; ///< specialised: a tuple of Member
template <class T>
concept HasMembers = !std::is_same_v<std::remove_const_t<decltype(members_of<T>)>, NoMembers>;
template <class T>
concept HasNames = !std::is_same_v<std::remove_const_t<decltype(names_of<T>)>, NoNames>;

template <class T> struct IsOptional : std::false_type {
};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {
};
template <class T> struct IsList : std::false_type {
};
template <class T> struct IsList<std::vector<T>> : std::true_type {
};
template <class T> struct IsArray : std::false_type {
};
template <class T, size_t n> struct IsArray<std::array<T, n>> : std::true_type {
};
template <class T>
concept IsMatrix = std::is_base_of_v<Eigen::MatrixBase<T>, T>;

template <class T> void read(const Json& json, T& value, const Place& place);
template <class T> Json written(const T& value);

/// A Member without its types, so that what reading and writing do for all of them alike is compiled
/// once, not for each list (a script's hundred actions took 73 s of processor, now 44).
struct AnyMember {
    std::string_view name;
    bool required;
    const void* member;
    void (*read)(const void* member, const Json& json, void* owner, const Place& place); ///< and check
    Json (*write)(const void* member, const void* owner);
};

template <class Owner, class S, class T, class Check> AnyMember any_member(const Member<S, T, Check>& member)
{
    using This = Member<S, T, Check>;
    return {member.name, member.required, &member,
            [](const void* member, const Json& json, void* owner, const Place& place) {
                const This& each = *static_cast<const This*>(member);
                T& value = static_cast<Owner*>(owner)->*each.where;
                spia::viewer::read(json, value, place);
                each.check(value, place);
            },
            [](const void* member, const void* owner) {
                return written(static_cast<const Owner*>(owner)->*static_cast<const This*>(member)->where);
            }};
}
template <class Owner, class Members> auto any_members(const Members& members)
{
    return std::apply([](const auto&... m) { return std::array<AnyMember, sizeof...(m)>{any_member<Owner>(m)...}; },
                      members);
}

/// @param owner  the struct that the members are of
void read_any_members(const Json& json, void* owner, std::span<const AnyMember> members, const Place& place,
                      std::string_view besides);
void write_any_members(const void* owner, std::span<const AnyMember> members, Json& json);

/// @param besides  a member of the JSON object that is none of the struct: the name of an action
template <class T, class Members>
void read_members(const Json& json, T& value, const Members& members, const Place& place, std::string_view besides = {})
{
    read_any_members(json, &value, any_members<T>(members), place, besides);
}

template <class T, class Members> void write_members(const T& value, const Members& members, Json& json)
{
    write_any_members(&value, any_members<T>(members), json);
}

/// count numbers, or any count where it is negative.
template <class Write> void read_list(const Json& json, const Place& place, long count, const Write& write)
{
    if (!json.is_array() || (count >= 0 && json.size() != size_t(count)))
        place.fail(count < 0 ? std::string("must be a list [ ]") : fmt::format("must be a list of {} values", count));
    for (size_t i = 0; i < json.size(); ++i)
        write(i, json[i], place.entry(i));
}

template <class T> void read(const Json& json, T& value, const Place& place)
{
    if constexpr (std::is_same_v<T, Json>) {
        value = json;
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean())
            place.fail("must be true or false");
        value = json.get<bool>();
    } else if constexpr (std::is_same_v<T, int>) {
        constexpr auto most = std::numeric_limits<int>::max();
        const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= std::uint64_t(most)
                                                    : json.is_number_integer() && json.get<std::int64_t>() >= -most;
        if (!fits)
            place.fail("must be a whole number");
        value = json.get<int>();
    } else if constexpr (std::is_floating_point_v<T>) {
        if (!json.is_number() || !std::isfinite(json.get<T>()))
            place.fail("must be a number");
        value = json.get<T>();
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path>) {
        if (!json.is_string())
            place.fail("must be a text in \" \"");
        value = json.get<std::string>();
        if (std::string(value).find('\0') != std::string::npos)
            place.fail("must not hold the character 0");
    } else if constexpr (std::is_same_v<T, Field> || HasNames<T>) {
        std::string name;
        read(json, name, place);
        try {
            if constexpr (HasNames<T>)
                value = value_by_name<T>(name);
            else
                value = field_by_name(name);
        } catch (const InputError& error) {
            place.fail(fmt::format("is wrong: {}", error.what()));
        }
    } else if constexpr (IsOptional<T>::value) {
        if (json.is_null() && !std::is_same_v<T, std::optional<Json>>) {
            value.reset();
        } else {
            typename T::value_type inner = value ? *value : typename T::value_type{};
            read(json, inner, place);
            value = std::move(inner);
        }
        // by view, so that one alone can be given
    } else if constexpr (std::is_same_v<T, std::array<Camera, 4>>) {
        if (!json.is_object())
            place.fail("must be an object { }");
        for (const auto& [key, camera] : json.items()) {
            View view;
            read(Json(key), view, place);
            read(camera, value[size_t(view)], place.member(key));
        }
    } else if constexpr (IsArray<T>::value) {
        read_list(json, place, long(value.size()),
                  [&](size_t i, const Json& each, const Place& at) { read(each, value[i], at); });
    } else if constexpr (IsList<T>::value) {
        value.clear();
        read_list(json, place, -1,
                  [&](size_t, const Json& each, const Place& at) { read(each, value.emplace_back(), at); });
    } else if constexpr (IsMatrix<T>) { // column by column
        constexpr long rows = T::RowsAtCompileTime, columns = T::ColsAtCompileTime;
        if (columns == Eigen::Dynamic) {
            if (!json.is_array() || json.size() % size_t(rows) != 0)
                place.fail(fmt::format("must be a list of numbers, {} for each entry", rows));
            value.resize(rows, Eigen::Index(json.size()) / rows);
        }
        read_list(json, place, value.size(), [&](size_t i, const Json& each, const Place& at) {
            read(each, value.reshaped()[Eigen::Index(i)], at);
        });
    } else if constexpr (requires {
                             value.length();
                             value.x;
                         }) { // of GLM; a quaternion as w, x, y, z
        if constexpr (std::is_same_v<T, glm::dquat>) {
            std::array<double, 4> wxyz;
            read(json, wxyz, place);
            value = glm::dquat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
        } else {
            read_list(json, place, value.length(),
                      [&](size_t i, const Json& each, const Place& at) { read(each, value[int(i)], at); });
        }
    } else {
        static_assert(HasMembers<T>, "list the members of this type in members_of");
        read_members(json, value, members_of<T>, place);
    }
}

/// The JSON that read() reads.
template <class T> Json written(const T& value)
{
    if constexpr (std::is_same_v<T, std::filesystem::path>) {
        return value.string();
    } else if constexpr (std::is_same_v<T, Field>) {
        return info(value).name;
    } else if constexpr (HasNames<T>) {
        return name_in_table(value);
    } else if constexpr (IsOptional<T>::value) {
        return value ? written(*value) : Json(nullptr);
    } else if constexpr (std::is_same_v<T, std::array<Camera, 4>>) {
        Json json = Json::object();
        for (const View view : all_views)
            json[std::string(name(view))] = written(value[size_t(view)]);
        return json;
    } else if constexpr (IsArray<T>::value || IsList<T>::value) {
        Json json = Json::array();
        for (const auto& each : value)
            json.push_back(written(each));
        return json;
    } else if constexpr (IsMatrix<T>) {
        Json json = Json::array();
        for (const auto number : value.reshaped())
            json.push_back(number);
        return json;
    } else if constexpr (std::is_same_v<T, glm::dquat>) {
        return Json{value.w, value.x, value.y, value.z};
    } else if constexpr (requires {
                             value.length();
                             value.x;
                         }) {
        Json json = Json::array();
        for (int i = 0; i < value.length(); ++i)
            json.push_back(value[i]);
        return json;
    } else if constexpr (HasMembers<T>) {
        Json json = Json::object();
        write_members(value, members_of<T>, json);
        return json;
    } else {
        return Json(value);
    }
}

} // namespace spia::viewer

#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json_file.h"
#include "engine/part/part_file.h"

/// Members of files that people write: every fault is told with its place, and a member that is not
/// known is one.
namespace spia::members {

void require_object(const Json& json, const Place& place, std::initializer_list<std::string_view> members);

/// @returns the value, or null where it may be missing
const Json* find(const Json& json, const Place& place, std::string_view name, bool required);

double number(const Json& json, const Place& place, double least, double greatest);
std::optional<double> number_in(const Json& json, const Place& place, std::string_view name, double least,
                                double greatest, bool required = false);
std::string text(const Json& json, const Place& place);
std::string text_in(const Json& json, const Place& place, std::string_view name, const std::string& otherwise);
Eigen::Vector3d vector(const Json& json, const Place& place);
std::vector<Eigen::Vector3d> line(const Json& json, const Place& place);

/// @name Picked faces: of each face of the part 1 where it is chosen
///@{
/// By numbers in the part's file.
void choose_faces(const Json& json, const Place& place, const PartFile& part, std::vector<char>& chosen);
/// By the least and the greatest corner of a box that holds their middles.
void choose_box(const Json& json, const Place& place, const PartFile& part, std::vector<char>& chosen);
std::vector<int> chosen_faces(const std::vector<char>& chosen);
///@}

/// By "faces" and by "box"; both together are united. At least one face.
std::vector<int> faces_in(const Json& json, const Place& place, const PartFile& part);

/// What an entry without a name is called: "line 3" of "lines".
std::string entry_name(std::string_view list, size_t index);

/// Reads the entries of a list member, each at its place; without a name an entry is called as its
/// list and number.
template <class Read> void each_of(const Json& json, const Place& place, std::string_view name, const Read& read)
{
    const Json* list = find(json, place, name, false);
    if (!list)
        return;
    const Place at = place.member(name);
    if (!list->is_array())
        at.fail("must be a list [ ]");
    for (size_t i = 0; i < list->size(); ++i)
        read((*list)[i], at.entry(i), entry_name(name, i));
}

} // namespace spia::members

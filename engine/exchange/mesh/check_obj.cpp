#include <algorithm>
#include <charconv>
#include <fmt/core.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/text/text_lines.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

/// The vertex of a corner "7", "7/1", "7//3" or "-1/1/1", counted from 0.
int vertex_of(const TextLines& lines, std::string_view corner, size_t vertices_so_far)
{
    int number = 0;
    const auto [end, problem] = std::from_chars(corner.data(), corner.data() + corner.size(), number);
    const std::string_view rest = corner.substr(size_t(end - corner.data()));
    if (problem != std::errc() || number == 0 || (!rest.empty() && rest[0] != '/') ||
        rest.find_first_not_of("-/0123456789") != rest.npos)
        lines.fail(fmt::format("'{}' is not the corner of a face", corner.substr(0, 40)));
    // negative numbers count back from here
    return number > 0 ? number - 1 : int(vertices_so_far) + number;
}

bool has_repetition(std::vector<int> corners)
{
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
}

} // namespace

CheckedFile check_obj(std::string_view file)
{
    CheckedFile result{.format = "OBJ", .extension = "obj"};
    TextLines lines(file, '#', true);
    int largest = -1, skipped = 0;
    std::vector<int> corners;
    std::string faces;
    while (lines.next()) {
        const auto& words = lines.words();
        if (words[0] == "v") {
            result.position.emplace_back(lines.coordinate(1), lines.coordinate(2), lines.coordinate(3));
            fmt::format_to(std::back_inserter(result.content), "v {} {} {}\n", words[1], words[2], words[3]);
        } else if (words[0] == "f") {
            corners.clear();
            for (size_t k = 1; k < words.size(); ++k) {
                corners.push_back(vertex_of(lines, words[k], result.position.size()));
                if (corners.back() < 0)
                    lines.fail(fmt::format("the face names vertex '{}', which does not exist", words[k].substr(0, 40)));
                largest = std::max(largest, corners.back());
            }
            if (corners.size() < 3 || has_repetition(corners)) {
                result.aside[result.faces] = corners;
            } else {
                faces += "f";
                for (const int v : corners)
                    fmt::format_to(std::back_inserter(faces), " {}", v + 1);
                faces += "\n";
            }
            ++result.faces;
        } else if (words[0] == "l" || words[0] == "p" || words[0] == "curv" || words[0] == "curv2" ||
                   words[0] == "surf") {
            ++skipped;
        }
        if (result.faces > most_elements || int(result.position.size()) > most_elements)
            lines.fail(fmt::format("more than {} vertices or faces", most_elements));
    }
    if (largest >= int(result.position.size()))
        throw InputError(
            fmt::format("a face names vertex {} (counted from 1), but the file has {}; it is damaged or cut off",
                        largest + 1, result.position.size()));
    if (skipped > 0)
        result.notes.push_back(
            fmt::format("{} skipped: only faces are read", counted(skipped, "point, line or free-form piece was",
                                                                   "points, lines or free-form pieces were")));
    result.content += faces;
    return result;
}

} // namespace spia

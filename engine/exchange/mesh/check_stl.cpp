#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/text/text_lines.h"

namespace spia {
namespace {

constexpr size_t header_bytes = 84, facet_bytes = 50;
using Point = std::array<float, 3>;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in the file");

/// OpenMesh counts values closer than the smallest normal number as equal, which is no equivalence
/// among numbers that small. They are zero lengths in any unit.
float without_dust(float value) { return std::abs(value) < 1e-30f ? 0.0f : value; }

bool corners_coincide(const std::array<Point, 3>& p) { return p[0] == p[1] || p[1] == p[2] || p[2] == p[0]; }

CheckedFile check_binary(std::string_view file, uint32_t claimed)
{
    CheckedFile result{.format = "STL (binary)", .extension = "stl", .binary = true};
    const double needed = double(header_bytes) + double(facet_bytes) * claimed;
    if (needed > double(file.size()))
        throw InputError(
            fmt::format("the file claims {} facets, which need {:.0f} bytes, but has {}; it is cut off or not an "
                        "STL file",
                        claimed, needed, file.size()));
    if (claimed > uint32_t(most_elements))
        throw InputError(fmt::format("{} facets are more than the {} that are read", claimed, most_elements));
    if (needed < double(file.size()))
        result.notes.push_back(
            fmt::format("{} bytes behind the last facet were ignored", double(file.size()) - needed));
    result.faces = int(claimed);
    result.content = file.substr(0, size_t(needed));
    for (int f = 0; f < result.faces; ++f) {
        char* facet =
            // behind the normal
            result.content.data() + header_bytes + facet_bytes * size_t(f) + sizeof(Point);
        std::array<Point, 3> corner;
        std::memcpy(&corner, facet, sizeof corner);
        for (Point& p : corner)
            for (float& value : p) {
                if (!(std::abs(value) <= float(largest_coordinate)))
                    throw InputError(
                        fmt::format("facet {} has the coordinate {}, which is not a usable number", f, value));
                value = without_dust(value);
            }
        std::memcpy(facet, &corner, sizeof corner);
        if (corners_coincide(corner))
            result.aside[f]; // a face without corners: the doctor counts it
    }
    return result;
}

CheckedFile check_text(std::string_view file)
{
    CheckedFile result{.format = "STL (text)", .extension = "stl"};
    TextLines lines(file, 0);
    int corners = -1; // in the open loop; -1 outside
    bool ended = false;
    std::array<Point, 3> corner{};
    while (lines.next()) {
        const std::string word = lower_case(lines.words()[0]);
        ended = word == "endsolid";
        if (word == "outer") {
            if (corners >= 0)
                lines.fail("a loop begins inside another");
            corners = 0;
        } else if (word == "vertex") {
            if (corners < 0 || corners > 2)
                lines.fail("a facet must have three vertices between 'outer loop' and 'endloop'");
            for (size_t k = 0; k < 3; ++k)
                corner[size_t(corners)][k] = without_dust(float(lines.coordinate(k + 1)));
            ++corners;
        } else if (word == "endloop") {
            if (corners != 3)
                lines.fail("a facet must have three vertices between 'outer loop' and 'endloop'");
            corners = -1;
            result.content += "outer loop\n";
            for (const Point& p : corner)
                // shortest text of the same float
                result.content += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
            if (corners_coincide(corner))
                result.aside[result.faces];
            if (++result.faces > most_elements)
                lines.fail(fmt::format("more than {} facets", most_elements));
        } else if (word != "facet" && word != "endfacet" && word != "solid" && word != "endsolid" && word != "color") {
            lines.fail(fmt::format("'{}' does not belong into an STL file", word.substr(0, 40)));
        }
    }
    if (corners >= 0 || !ended)
        throw InputError(fmt::format("the file is cut off: it ends without 'endsolid', after {} facets", result.faces));
    return result;
}

} // namespace

CheckedFile check_stl(std::string_view file)
{
    uint32_t claimed = 0;
    if (file.size() >= header_bytes)
        std::memcpy(&claimed, file.data() + 80, sizeof claimed);
    // Some binary files begin with "solid", so an exact length decides first.
    const bool exact = file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * size_t(claimed);
    const size_t start = std::min(file.find_first_not_of(" \t\r\n"), file.size());
    const bool text = lower_case(file.substr(start, 5)) == "solid" && file.substr(0, 1000).find('\0') == file.npos;
    if (!exact && text)
        return check_text(file);
    if (file.size() < header_bytes)
        throw InputError(fmt::format("{} bytes are too few for an STL file", file.size()));
    return check_binary(file, claimed);
}

} // namespace spia

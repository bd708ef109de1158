#include <fmt/core.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/text/text_lines.h"

namespace spia {
namespace {

/// Reads "OFF", also with the letters for texture, colours and normals, which follow the
/// coordinates and are ignored.
void check_header(const TextLines& lines)
{
    std::string_view head = lines.words()[0];
    for (const std::string_view prefix : {"ST", "C", "N"})
        if (head.substr(0, prefix.size()) == prefix)
            head.remove_prefix(prefix.size());
    if (head != "OFF")
        lines.fail("the file does not begin with OFF (four-dimensional variants are not read)");
    if (lines.words().size() > 1 && lines.words()[1] == "BINARY")
        lines.fail("binary OFF is not read; save the mesh as text");
}

} // namespace

CheckedFile check_off(std::string_view file)
{
    CheckedFile result{.format = "OFF", .extension = "off"};
    TextLines lines(file);
    if (!lines.next())
        throw InputError("the file is empty");
    check_header(lines);
    size_t at = 1; // the numbers may stand behind OFF or on the next line
    if (lines.words().size() == 1) {
        if (!lines.next())
            throw InputError("the file ends behind its first line");
        at = 0;
    }
    const int vertices = lines.integer(at), faces = lines.integer(at + 1);
    // The shortest vertex is "0 0 0", the shortest face "0", each with its line end.
    if (vertices < 0 || faces < 0 || vertices > most_elements || faces > most_elements ||
        6.0 * vertices + 2.0 * faces > double(file.size()))
        lines.fail(
            fmt::format("{} vertices and {} faces do not fit into a file of {} bytes", vertices, faces, file.size()));

    result.content = fmt::format("OFF\n{} {} 0\n", vertices, faces);
    for (int v = 0; v < vertices; ++v) {
        if (!lines.next())
            throw InputError(fmt::format("the file is cut off: vertex {} of {} is missing", v, vertices));
        result.position.emplace_back(lines.coordinate(0), lines.coordinate(1), lines.coordinate(2));
        fmt::format_to(std::back_inserter(result.content), "{} {} {}\n", lines.words()[0], lines.words()[1],
                       lines.words()[2]);
    }
    for (int f = 0; f < faces; ++f) {
        if (!lines.next())
            throw InputError(fmt::format("the file is cut off: face {} of {} is missing", f, faces));
        const int corners = lines.integer(0);
        if (corners < 0 || size_t(corners) >= lines.words().size())
            lines.fail(
                fmt::format("face {} claims {} corners, the line has {} numbers", f, corners, lines.words().size()));
        fmt::format_to(std::back_inserter(result.content), "{}", corners);
        for (int k = 1; k <= corners; ++k) {
            const int v = lines.integer(size_t(k));
            if (v < 0 || v >= vertices)
                lines.fail(fmt::format("face {} names vertex {}, but there are {} (counted from 0)", f, v, vertices));
            fmt::format_to(std::back_inserter(result.content), " {}", v);
        }
        result.content += "\n";
    }
    result.faces = faces;
    return result;
}

} // namespace spia

#include "engine/exchange/part_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/exchange/mesh/mesh_file.h"

namespace spia {
namespace {

struct Group {
    FileKind kind;
    std::string_view name;
    std::vector<FileFormat> formats;
};

const std::array<Group, 3>& groups()
{
    static const std::array<Group, 3> all = {{{FileKind::cad, "CAD files", cad_file_formats()},
                                              {FileKind::deck, "solver decks", deck_file_formats()},
                                              {FileKind::mesh, "meshes", mesh_file_formats()}}};
    return all;
}

/// @param text  of one format
template <class Text> std::string listed(const Text& text)
{
    std::vector<std::string> words;
    for (const Group& group : groups()) {
        std::vector<std::string> formats;
        for (const FileFormat& format : group.formats)
            formats.push_back(text(format));
        words.push_back(fmt::format("{} ({})", group.name, fmt::join(formats, ", ")));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

} // namespace

std::optional<FileKind> kind_of_file(const std::filesystem::path& path)
{
    for (const Group& group : groups())
        for (const FileFormat& format : group.formats)
            if (has_ending(format, path))
                return group.kind;
    return std::nullopt;
}

FileKind require_kind_of_file(const std::filesystem::path& path)
{
    if (const auto kind = kind_of_file(path))
        return *kind;
    throw InputError(fmt::format("the extension '{}' is not known; parts are read from {}", path.extension().string(),
                                 part_format_endings()));
}

std::vector<std::string> part_endings()
{
    std::vector<std::string> endings;
    for (const Group& group : groups())
        for (const FileFormat& format : group.formats)
            endings.insert(endings.end(), format.endings.begin(), format.endings.end());
    return endings;
}

std::string part_format_names()
{
    return listed([](const FileFormat& format) { return std::string(format.name); });
}

std::string part_format_endings()
{
    return listed(
        [](const FileFormat& format) { return fmt::format("{} {}", format.name, fmt::join(format.endings, " ")); });
}

} // namespace spia

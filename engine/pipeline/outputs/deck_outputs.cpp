#include "engine/pipeline/outputs/deck_outputs.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/exchange/deck/original_results.h"
#include "engine/exchange/deck/part_shells.h"
#include "engine/exchange/deck/write_element_results.h"
#include "engine/exchange/deck/write_shell_mesh.h"
#include "engine/exchange/text/fixed_number.h"

namespace spia {
namespace {

constexpr std::string_view blank_prefix = "blank-";

} // namespace

const std::vector<std::string>& deck_formats()
{
    static const std::vector<std::string> formats = [] {
        std::vector<std::string> all = {"dynain", "nastran", "mapping"};
        all.insert(all.end(), blank_mesh_formats().begin(), blank_mesh_formats().end());
        return all;
    }();
    return formats;
}

const std::vector<std::string>& blank_mesh_formats()
{
    static const std::vector<std::string> formats = {"blank-k", "blank-bdf", "blank-inp", "blank-msh"};
    return formats;
}

bool is_deck_format(const std::string& format)
{
    return std::find(deck_formats().begin(), deck_formats().end(), format) != deck_formats().end();
}

std::vector<std::string> deck_file_names(const std::string& format, const std::string& name)
{
    if (format == "dynain")
        return {name + "-dynain.k"};
    if (format == "nastran")
        return {name + "-thickness.bdf", name + "-strains.csv"};
    if (format == "mapping")
        return {name + "-elements.csv", name + "-nodes.csv"};
    return {name + "-blank." + format.substr(blank_prefix.size())};
}

void require_deck_ids(std::span<const std::string> formats, const PartFile& part)
{
    if (std::none_of(formats.begin(), formats.end(), is_deck_format))
        return;
    const PartShells shells = part_shells(part.deck ? as_read(part) : part);
    const bool keyword = std::any_of(formats.begin(), formats.end(), [](const std::string& format) {
        return format == "dynain" || format == "blank-k";
    });
    if (!keyword)
        return;
    constexpr int widest = 10; // of keyword files, even with I10=Y; copies of nodes along a seam
                               // get ids above all others
    fixed_number(shells.last_node + std::int64_t(shells.mesh.node.size()), widest);
    fixed_number(shells.last_element + std::int64_t(shells.mesh.element.size()), widest);
}

std::vector<std::filesystem::path> write_deck_files(const std::filesystem::path& folder, const std::string& name,
                                                    std::span<const std::string> formats, const PartFile& part,
                                                    const Blank& blank, const SheetFields& face, LengthUnit unit)
{
    std::vector<std::filesystem::path> files;
    if (std::none_of(formats.begin(), formats.end(), is_deck_format))
        return files;
    if (part.deck && part.remeshed) { // the elements of the deck, not ours, are what another
                                      // program knows
        const OriginalResults original = on_original(part, blank, face);
        return write_deck_files(folder, name, formats, original.part, original.blank, original.face, unit);
    }
    const PartShells shells = part_shells(part, unit);
    const ElementFields fields = element_fields(shells, part.mesh, face);
    const BlankShells flat = blank_shells(part, shells, blank, face);
    const ElementResults results{&shells, &fields};
    const std::string formed = fmt::format("{} as formed, thickness and plastic strain", name);
    for (const std::string& format : formats) {
        if (!is_deck_format(format))
            continue;
        const size_t first = files.size();
        for (const std::string& file : deck_file_names(format, name))
            files.push_back(folder / file);
        if (format == "dynain")
            write_dynain(files[first], results, formed);
        else if (format == "nastran") {
            write_nastran_thickness(files[first], results, formed);
            write_strains_csv(files[first + 1], results);
        } else if (format == "mapping") {
            write_elements_csv(files[first], results);
            write_nodes_csv(files[first + 1], flat);
        } else
            write_shell_mesh(files[first], flat.mesh, fmt::format("blank of {}", name));
    }
    return files;
}

} // namespace spia

#include "engine/exchange/deck/read_deck.h"

#include <algorithm>
#include <array>

#include "engine/core/text.h"

namespace spia {
namespace {

struct Format {
    std::string_view extension;
    Deck (*read)(DeckLines&);
};
constexpr std::array<Format, 9> formats = {{{".k", read_dyna},
                                            {".key", read_dyna},
                                            {".dyn", read_dyna},
                                            {".bdf", read_nastran},
                                            {".nas", read_nastran},
                                            {".dat", read_nastran},
                                            {".inp", read_abaqus},
                                            {".msh", read_gmsh},
                                            {".rad", read_radioss}}};

const Format* format_of(std::string_view extension)
{
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& format) { return format.extension == extension; });
    return found == formats.end() ? nullptr : &*found;
}

} // namespace

bool is_deck(std::string_view extension) { return format_of(extension) != nullptr; }

Deck read_deck(const std::filesystem::path& file, std::string content, const Progress& progress)
{
    const std::string extension = lower_case(file.extension().string());
    DeckLines lines(file, std::move(content), progress);
    return format_of(extension)->read(lines);
}

} // namespace spia

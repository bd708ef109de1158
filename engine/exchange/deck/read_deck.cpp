#include "engine/exchange/deck/read_deck.h"

namespace spia {
namespace {

using ReadDeck = Deck (*)(DeckLines&);

const std::vector<FormatReader<ReadDeck>>& deck_readers()
{
    static const std::vector<FormatReader<ReadDeck>> all = {{{"LS-DYNA", {".k", ".key", ".dyn"}}, read_dyna},
                                                            {{"Nastran", {".bdf", ".nas", ".dat"}}, read_nastran},
                                                            {{"Abaqus and CalculiX", {".inp"}}, read_abaqus},
                                                            {{"Gmsh", {".msh"}}, read_gmsh},
                                                            {{"Radioss", {".rad"}}, read_radioss}};
    return all;
}

} // namespace

std::vector<FileFormat> deck_file_formats() { return formats_of(deck_readers()); }

Deck read_deck(const std::filesystem::path& file, std::string content, const Progress& progress)
{
    DeckLines lines(file, std::move(content), progress);
    return reader_of(deck_readers(), file)(lines);
}

} // namespace spia

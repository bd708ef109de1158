#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace spia::fuzz {

/// The file of that number. It depends on nothing else.
/// @throws std::out_of_range if there is no such format
std::string damaged_cad_file(std::string_view format, int number);

/// What became of damaged CAD files.
struct CadSearch {
    int files = 0;
    int accepted = 0;
    int refused = 0; ///< with a word
    int crashed = 0; ///< ended their process, in OpenCASCADE most often; refused or accepted by
                     ///< read_cad()
    int endless = 0; ///< read for seconds on end; read_cad() was cancelled, at once
};

/// Reads damaged files of a format, many in one process, for one of its own for each would take
/// longer than reading does. Where that process ends or does not, the file is read as users do, by
/// read_cad(), which has to come back with an answer.
/// @throws std::logic_error, naming the file's number, if one is accepted that makes no sense, or
/// read_cad() does not do as it should
CadSearch search_cad(std::string_view format, int first, int files);

/// Reads a file as users do, by read_cad(), which has to come back with an answer or to be
/// cancelled at once.
/// @returns whether it has been answered within seconds; else it was cancelled
/// @throws std::logic_error if it could not be
bool is_answered(const std::filesystem::path& file);

} // namespace spia::fuzz

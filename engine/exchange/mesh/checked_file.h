#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace spia {

/// A mesh file that was gone through before OpenMesh reads it. Its readers (version 9.0) trust what
/// they are given: they round all coordinates to single precision, skip lines they cannot read
/// (which shifts the numbers of all later vertices), wait for ever at a cut-off PLY header, take
/// PLY lists other than the corners and OFF colours for faces, open files that an OBJ names, and
/// drop faces without a word. So each format is checked here word by word; OpenMesh gets the
/// geometry alone in a plain form of the same format, and read_openmesh() compares what it makes of
/// it.
struct CheckedFile {
    std::string format;    ///< for people, e.g. "STL (binary)"
    std::string extension; ///< for OpenMesh, e.g. "stl"
    bool binary = false;
    std::string content = {}; ///< what OpenMesh reads
    /// File units, full precision; empty if the format has none (STL).
    std::vector<Eigen::Vector3d> position = {};
    int faces = 0; ///< in the file
    /// Number and corners of the faces OpenMesh would drop or shorten because a corner comes twice.
    std::map<int, std::vector<int>> aside = {};
    std::vector<std::string> notes = {}; ///< what was left out or deserves a word
};

/// @throws InputError  names the line, face or vertex
CheckedFile check_obj(std::string_view file);
CheckedFile check_off(std::string_view file);
CheckedFile check_ply(std::string_view file);
CheckedFile check_stl(std::string_view file);

/// Most faces, and most vertices, that a file may have.
constexpr int most_elements = 20'000'000;

} // namespace spia

#pragma once
#include <TopoDS_Face.hxx>
#include <XSControl_Reader.hxx>
#include <span>
#include <string>
#include <vector>

namespace spia {

/// A face, shell or solid of a STEP or IGES file that could not be made.
struct LostShape {
    std::string label;       ///< in the file: "#123", in IGES "D12"
    std::vector<int> beside; ///< faces, ascending, of the nearest thing that holds it and was made;
                             ///< empty: none is known
    bool solid = false;      ///< a body of its own
};

/// For .cpp files of engine/exchange that hold an OcctSession.
/// @param faces  of the file, by their numbers
std::vector<LostShape> not_translated(const XSControl_Reader& read, std::span<const TopoDS_Face> faces);

/// Whether it may be missing in what was chosen: any face of its body was, or, of a solid,
/// everything that stands beside it in its assembly; or its body is not known.
/// @param chosen  faces, ascending
bool may_lack(std::span<const int> chosen, const LostShape& lost);

} // namespace spia

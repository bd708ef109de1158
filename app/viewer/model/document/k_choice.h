#pragma once
#include <optional>
#include <string>

#include "app/viewer/model/document/document.h"

namespace spia::viewer {

/// Who says where the neutral fibre of the bends lies.
enum class KSource {
    automatic, ///< nobody: the middle surface, and meshes of no solid keep their triangles
    number,
    din6935,
    table ///< a file
};
KSource k_source(const std::optional<KFactor>& k);

/// As on the screen: "0.5, middle surface", "0.44", "DIN 6935", the file without its folder.
std::string k_words(const std::optional<KFactor>& k);

/// What makes the K factor of the options, as in the action set_k_factor; empty: none.
std::string k_text(const std::optional<KFactor>& k);

/// The figures of a bend by the K factor that is wanted now, also while the blank is yet that of
/// another one. A bend that is not laid keeps those that the blank has.
/// @param bend  of the session's bends
SheetBend with_wanted_k(const Document& document, const SheetBend& bend);

} // namespace spia::viewer

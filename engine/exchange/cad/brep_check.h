#pragma once
#include <string>
#include <string_view>

namespace spia {

/// What a BREP text holds that neither is a number nor one of the words that BRepTools writes, with
/// line and byte; empty: nothing. OpenCASCADE takes what a word begins with for the number, 0 if
/// that is none, and goes on. A whole number is not told from another.
std::string fault_of_brep(std::string_view content);

/// The word from there on, fit to be shown.
std::string brep_word_at(std::string_view content, size_t at);

} // namespace spia

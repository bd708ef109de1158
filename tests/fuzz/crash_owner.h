#pragma once
#include <string>
#include <string_view>

namespace spia::fuzz {

/// Whose code that is. Innermost on the stack, it is the one to be looked at first; a wrong handle that the reader gave to OpenCASCADE
/// counts as OpenCASCADE's, for the stack cannot tell.
enum class Owner { unknown, opencascade, reader };

/// Unknown: of a library that both use, of the sanitizers, or a function of the reader that has no name outside of its file.
Owner owner_of(const void* code);

/// The innermost known one on the stack of the caller, and the name of its place.
Owner owner_of_stack(std::string& place);

/// The same of a signal's context (Linux on x86-64).
Owner owner_of_signal(void* context, std::string& place);

/// @returns what is wrong, if code cannot be told apart here: this program has to export its functions
std::string_view fault_of_owners();

} // namespace spia::fuzz

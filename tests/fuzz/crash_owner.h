#pragma once
#include <cstddef>
#include <string_view>

namespace spia::fuzz {

/// Whose code that is. Innermost on the stack, it is the one to be looked at first; a wrong handle
/// that the reader gave to OpenCASCADE counts as OpenCASCADE's, for the stack cannot tell.
enum class Owner { unknown, opencascade, reader };

struct Place {
    Owner owner = Owner::unknown;
    const void* code = nullptr;
};

// What follows is for handlers of signals, which may have come in the middle of an allocation: it
// allocates nothing.

/// Unknown: of a library that both use, of the sanitizers, or a function of the reader that has no
/// name outside of its file.
Owner owner_of(const void* code);

/// The innermost known one on the stack of the caller.
Place place_on_stack();

/// The same of a signal's context (Linux on x86-64).
Place place_of_signal(void* context);

/// "libTKMath.so.7+1f3b", at most size - 1 characters.
void put_name(const void* code, char* name, size_t size);

/// @returns what is wrong, if code cannot be told apart here: this program has to export its
/// functions
std::string_view fault_of_owners();

} // namespace spia::fuzz

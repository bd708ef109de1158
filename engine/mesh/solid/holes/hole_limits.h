#pragma once

namespace spia {

/// Of the thickness: single precision of STL files is that of usual sheet at most.
inline constexpr double same_in_hole = 1e-3;

/// Of the thickness: a hole that was punched is wider at one side by less.
inline constexpr double sunk_in_hole = 0.02;

} // namespace spia

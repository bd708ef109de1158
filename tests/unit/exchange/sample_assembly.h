#pragma once
#include <filesystem>

namespace spia {

/// Writes an assembly, in mm (faces by their number):
///   Car                                           assembly:0
///     Front                                       assembly:1, 100 mm above the ground
///       Plate, 40 x 30 x 1, as "left" at x = 0    body:0, faces 0-5
///       the same as "right" at x = 60             body:1, faces 6-11
///       Cover, a sheet of 20 x 10 in two faces    body:2, faces 12-13
///     Roof, a solid of 50 x 50 x 2 at x = -100    body:3, faces 14-19
void write_sample_assembly(const std::filesystem::path& step);

/// Writes solids of 10 x 10 x 1, 20 x 20 x 1 and 30 x 30 x 1, with their names, as IGES: bodies of
/// their own or loose faces.
void write_sample_bodies(const std::filesystem::path& iges, bool solids);

} // namespace spia

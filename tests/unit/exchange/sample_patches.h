#pragma once
#include <filesystem>

namespace spia {

/// A panel of 600 x 450 mm that is curved both ways: its height over x, y, mm.
double panel_height(double x, double y);

/// Writes the panel as IGES (.igs) or STEP (.step) in rows of `count` faces, every second row by
/// half a face to the side, as bricks. Each face is cut out of a B-spline surface of its own that
/// reaches further; its sides are moved at random (fixed), out and in, and it is lifted: at the
/// widest, neighbours are apart or overlap by `gap`. One face without a gap: the panel itself.
void write_panel(const std::filesystem::path& file, int count, double gap);

} // namespace spia

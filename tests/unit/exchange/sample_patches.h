#pragma once
#include <filesystem>

namespace spia {

/// A panel of 600 x 450 mm that is curved both ways: its height over x, y, mm.
double panel_height(double x, double y);

/// Writes the panel as IGES (.igs) or STEP (.step) in count x count faces of their own, cut out of B-spline surfaces that reach further. Each
/// side of each is moved by up to `gap` / 2 at random (fixed), out and in: neighbours are apart or overlap by up to `gap`. One face without
/// a gap: the panel itself.
void write_panel(const std::filesystem::path& file, int count, double gap);

} // namespace spia

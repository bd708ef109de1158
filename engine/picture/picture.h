#pragma once
#include <filesystem>

#include "engine/exchange/export_scene.h"

namespace spia {

/// Draws the chain as a PNG: the part in the colours of thinning, the flat blank with contours of thinning, the quad
/// mesh on the part, the NURBS surface with its control net - each in a titled panel, as far as the scene has them -
/// and a legend. The colours span all but the lowest and the highest hundredth of the vertices; the legend tells the
/// least and the greatest value, too. The part is seen from above and one side, its longer side across.
/// @throws InputError if the scene is incomplete or not finite; ExchangeError if the file cannot be written
void write_picture(const std::filesystem::path& path, const ExportScene& scene);

} // namespace spia

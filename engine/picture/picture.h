#pragma once
#include <filesystem>
#include <string>

#include "engine/core/length_unit.h"
#include "engine/exchange/export_scene.h"

namespace spia {

/// Which panels a picture has.
enum class Panels {
    all,   ///< of those below, in one row
    sheet, ///< part and blank, with the legend
    shape  ///< quad mesh and surface
};

/// Draws the chain as a PNG: the part in the colours of thinning, the flat blank with contours of
/// thinning, the quad mesh on the part, the NURBS surface with its control net - each in a titled
/// panel, as far as the scene has them - and a legend. The colours span all but the lowest and the
/// highest hundredth of the vertices; the legend tells the least and the greatest value, too. The
/// part is seen from above and one side, its longer side across.
/// @param lengths  in which sizes are told
/// @returns the bytes of the file; empty if the scene has nothing for these panels
/// @throws InputError if the scene is incomplete or not finite
std::string picture_png(const ExportScene& scene, Panels panels = Panels::all, LengthUnit lengths = LengthUnit::mm);

/// The same as a file.
/// @throws InputError if the scene is incomplete or not finite; ExchangeError if the file cannot be
/// written
void write_picture(const std::filesystem::path& path, const ExportScene& scene);

} // namespace spia

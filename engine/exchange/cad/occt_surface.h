#pragma once
#include <Geom_BSplineSurface.hxx>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "engine/nurbs/surface.h"

namespace spia {

/// @throws InputError unless counts, knots (clamped, not decreasing, no inner one more than degree
/// times), weights (>
///         0) and points (finite) make a surface that CAD files can hold
void require_exchangeable(const NurbsSurface& surface);

/// Writes what text() makes of the surfaces, whole or not at all. For .cpp files of
/// engine/exchange.
/// @throws InputError if there is no surface or one is not exchangeable; ExchangeError if
/// OpenCASCADE or the disk refuses
void write_cad_file(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces,
                    const std::function<std::string()>& text);

/// Writes a text that OpenCASCADE makes, whole or not at all. For .cpp files of engine/exchange.
/// @throws ExchangeError if OpenCASCADE or the disk refuses
void write_cad_file(const std::filesystem::path& path, const std::function<std::string()>& text);

/// For .cpp files of engine/exchange that hold an OcctSession; both copy poles and knots bit for
/// bit.
Handle(Geom_BSplineSurface) to_occt(const NurbsSurface& surface);

/// A periodic surface is cut open at its first knot; a knot range other than 0 to 1 is mapped to
/// it.
/// @throws InputError if the surface is not clamped
NurbsSurface from_occt(const Geom_BSplineSurface& surface);

} // namespace spia

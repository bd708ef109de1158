#pragma once
#include <string>

#include "engine/core/length_unit.h"

namespace spia {

enum class DxfVersion {
    r12,   ///< AC1009, of 1992: what the oldest controls read; it has no splines
    r2000, ///< AC1015
};

/// What the outline and the holes are drawn as.
enum class DxfCurves {
    arcs,      ///< circles, arcs and lines where they are found, else straight pieces through the
               ///< places of the mesh
    polylines, ///< straight pieces through the places of the mesh, all of them
    splines,   ///< circles, arcs and lines where they are found, else cubic splines through the
               ///< places of the mesh
};

struct DxfOptions {
    LengthUnit unit = LengthUnit::mm; ///< of the lengths in the file, which its header names
    DxfVersion version = DxfVersion::r2000;
    DxfCurves curves = DxfCurves::arcs;
    double tolerance = 0.01; ///< mm: no place of the mesh is farther from what is drawn; a tenth of
                             ///< what lasers cut within

    friend bool operator==(const DxfOptions&, const DxfOptions&) = default;
};

/// By the names the command line uses: r12, r2000. @throws InputError
DxfVersion dxf_version(const std::string& name);
/// arcs, polylines, splines. @throws InputError
DxfCurves dxf_curves(const std::string& name);

} // namespace spia

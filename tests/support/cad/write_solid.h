#pragma once
#include <TopoDS_Shape.hxx>
#include <filesystem>

#include "tests/support/cad/bent_solid.h"

namespace spia::shapes {

/// @throws std::runtime_error  not written
void write_solid(const std::filesystem::path& file, const TopoDS_Shape& shape, CadForm form);

/// @param deflection  mm; @param angle radians, of chords at most
void write_stl(const std::filesystem::path& file, const TopoDS_Shape& shape, double deflection, double angle);

} // namespace spia::shapes

#pragma once
#include <optional>

#include "engine/forming/flatten.h"
#include "engine/part/part_file.h"

namespace spia {

/// The thickness of the flat sheet in mm: as asked for, else that of the part (a deck says it, in a
/// solid it is found), else the usual one.
/// @throws InputError unless it is finite and above 0
double flat_thickness(const std::optional<double>& asked, const PartFile& part,
                      double usual = FlattenOptions{}.thickness);

} // namespace spia

#pragma once
#include "engine/exchange/cad/read_cad.h"
#include "engine/part/part_file.h"

namespace spia {

/// Adds what reading the CAD file found to the doctor's report, before what the doctor found in the
/// triangles.
void report_cad(const CadContent& cad, PartFile& part);

} // namespace spia

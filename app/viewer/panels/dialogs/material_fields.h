#pragma once
#include <vector>

#include "app/viewer/model/document/grades.h"

namespace spia::viewer {

struct Frame;

/// What a grade is made of, in three columns: sheet, hardening, forming limit; what is wrong is
/// said below its field.
/// @param figures  of the material as it is now
/// @returns whether `material` was changed
bool material_fields(Frame& frame, Material& material, bool editable, const std::vector<MaterialFault>& faults,
                     const GradeFigures& figures);

} // namespace spia::viewer

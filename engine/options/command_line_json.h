#pragma once
#include "engine/core/json_file.h"

namespace spia {

/// The same with all its texts as the command line has them.
Json with_command_line_texts(Json json);

} // namespace spia

#pragma once
#include <string>
#include <string_view>

#include "engine/exchange/cad/read_cad.h"

namespace spia {

/// The content as bytes, for another copy of this process. Not a file format.
std::string packed(const CadContent& cad);
CadContent unpacked(std::string_view bytes);

} // namespace spia

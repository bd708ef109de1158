#pragma once
#include <string>

namespace spia {

/// Of the OpenCASCADE that the program was built with, e.g. "7.6.3".
std::string cad_kernel_version();

} // namespace spia

#pragma once
#include <string>

namespace spia {

/// Of the SuiteSparse that the program runs with, e.g. "5.12.0".
std::string suitesparse_version();

} // namespace spia

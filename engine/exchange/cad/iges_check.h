#pragma once
#include <istream>
#include <string>

namespace spia {

/// What is wrong with the frame of an IGES file; empty: nothing. It is looked at before OpenCASCADE
/// is given the file, for that crashes on one that was cut short. (Its STEP reader finds that out
/// by itself.)
std::string fault_of_iges(std::istream& file);

} // namespace spia

#pragma once
#include <filesystem>

namespace spia {

/// What OpenCASCADE makes of a STEP file.
struct StepShell {
    int shells = 0, faces = 0;
    int free_edges = 0; ///< of one face only
    bool valid = false; ///< BRepCheck_Analyzer
};

/// All zero if it cannot be read.
StepShell read_step_shell(const std::filesystem::path& file);

} // namespace spia

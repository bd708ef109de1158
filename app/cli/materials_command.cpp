#include <fmt/core.h>

#include <cstdlib>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/material/membrane_law.h"

namespace spia::cli {

std::filesystem::path assets()
{
    if (const char* folder = std::getenv("SPIA_ASSETS"))
        return folder;
    return SPIA_ASSETS_DIR;
}

int materials()
{
    const auto folder = assets() / "materials";
    say("{:<16} {:<34} {:>9} {:>9} {:>5} {:>5} {:>5}\n", "name", "grade", "yield MPa", "E MPa", "r0", "r45", "r90");
    const auto files = material_files(folder);
    const auto grades = read_materials(folder); // in the order of the files
    for (size_t i = 0; i < grades.size(); ++i) {
        const Material& material = grades[i];
        const MembraneLaw law(material);
        say("{:<16} {:<34} {:>9.0f} {:>9.0f} {:>5.2f} {:>5.2f} {:>5.2f}\n", files[i].stem().string(), material.name,
            law.curve().yield_stress(), material.young_MPa, material.r0, material.r45, material.r90);
    }
    say("Give one with --material NAME, or your own file of the same form (see {}).\n",
        (folder / "README.md").string());
    return 0;
}

} // namespace spia::cli

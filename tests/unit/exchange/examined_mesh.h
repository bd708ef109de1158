#pragma once
#include <optional>
#include <string>

#include "engine/part/part_file.h"
#include "engine/part/prepare_part.h"
#include "engine/part/read_options.h"
#include "tests/support/mesh_tools.h"

namespace spia {

/// A closed mesh as if a file held it.
inline PartFile examined(const TriMesh& mesh, std::optional<Skin> skin = {})
{
    ReadOptions options;
    options.skin = skin;
    return examine_soup(shapes::soup_of(mesh), options);
}

/// All that is said of a part, a line each.
inline std::string texts_of(const PartFile& part)
{
    std::string result;
    for (const std::string& note : part.notes)
        result += note + "\n";
    for (const Finding& finding : part.doctor.findings)
        result += finding.text + "\n";
    return result;
}

} // namespace spia

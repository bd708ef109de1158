#include "engine/exchange/mesh/mesh_file.h"

#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/core/text.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/mesh/read_gltf.h"
#include "engine/exchange/mesh/read_openmesh.h"

namespace spia {
namespace {

CheckedFile check(std::string_view extension, std::string_view content)
{
    if (extension == "obj")
        return check_obj(content);
    if (extension == "off")
        return check_off(content);
    if (extension == "ply")
        return check_ply(content);
    return check_stl(content);
}

} // namespace

std::string part_extension(const std::filesystem::path& path)
{
    const std::string extension = lower_case(path.extension().string());
    for (const char* known : {".stl", ".obj", ".ply", ".off", ".gltf", ".glb"})
        if (extension == known)
            return extension.substr(1);
    if (is_deck(extension) || is_cad(extension))
        return extension.substr(1);
    throw InputError(fmt::format(
        "the extension '{}' is not known; parts are read from .stl, .obj, .ply, .off, .gltf and .glb files, "
        "from CAD files .step, .stp, .iges, .igs and .brep, and from solver decks .k, .key, .dyn, .bdf, .nas, .dat, .inp, .msh and .rad",
        extension));
}

MeshFile read_mesh_file(const std::filesystem::path& path, std::string_view extension, const Progress& progress)
{
    const std::string content = file_content(path);
    progress.checkpoint(0.2, "reading the file");
    if (extension == "gltf" || extension == "glb") {
        GltfContent gltf = read_gltf(path, content, progress.part(0.2, 1));
        return {std::move(gltf.soup), extension == "glb" ? "glTF (binary)" : "glTF (text)", std::move(gltf.notes)};
    }
    const CheckedFile checked = check(extension, content);
    progress.checkpoint(0.6, "reading the file");
    return {read_openmesh(checked), checked.format, checked.notes};
}

} // namespace spia

#include "engine/exchange/mesh/mesh_file.h"

#include "engine/core/file_content.h"
#include "engine/core/text.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/mesh/read_gltf.h"
#include "engine/exchange/mesh/read_openmesh.h"

namespace spia {
namespace {

/// @param content  of the file
using ReadMesh = MeshFile (*)(const std::filesystem::path& path, const std::string& content, const Progress& progress);

template <CheckedFile (*check)(std::string_view)>
MeshFile read_checked(const std::filesystem::path&, const std::string& content, const Progress& progress)
{
    const CheckedFile checked = check(content);
    progress.checkpoint(0.5, "reading the file");
    return {read_openmesh(checked), checked.format, checked.notes};
}

MeshFile read_stl(const std::filesystem::path& path, const std::string& content, const Progress& progress)
{
    MeshFile file = read_checked<check_stl>(path, content, progress);
    file.own_corners = true;
    return file;
}

MeshFile read_scene(const std::filesystem::path& path, const std::string& content, const Progress& progress)
{
    const bool binary = lower_case(path.extension().string()) == ".glb";
    GltfContent gltf = read_gltf(path, content, progress);
    return {std::move(gltf.soup), binary ? "glTF (binary)" : "glTF (text)", std::move(gltf.notes), LengthUnit::m, true};
}

const std::vector<FormatReader<ReadMesh>>& mesh_readers()
{
    static const std::vector<FormatReader<ReadMesh>> all = {{{"STL", {".stl"}}, read_stl},
                                                            {{"OBJ", {".obj"}}, read_checked<check_obj>},
                                                            {{"PLY", {".ply"}}, read_checked<check_ply>},
                                                            {{"OFF", {".off"}}, read_checked<check_off>},
                                                            {{"glTF", {".gltf", ".glb"}}, read_scene}};
    return all;
}

} // namespace

std::vector<FileFormat> mesh_file_formats() { return formats_of(mesh_readers()); }

MeshFile read_mesh_file(const std::filesystem::path& path, const Progress& progress)
{
    const std::string content = file_content(path);
    progress.checkpoint(0.2, "reading the file");
    return reader_of(mesh_readers(), path)(path, content, progress.part(0.2, 1));
}

} // namespace spia

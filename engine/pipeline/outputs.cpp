#include "engine/pipeline/outputs.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "engine/core/error.h"
#include "engine/exchange/blank_outline.h"
#include "engine/exchange/picture.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/exchange/write_csv.h"
#include "engine/exchange/write_dxf.h"
#include "engine/exchange/write_gltf.h"
#include "engine/exchange/write_iges.h"
#include "engine/exchange/write_step.h"
#include "engine/exchange/write_vtu.h"
#include "engine/nurbs/tessellate.h"

namespace spia {

const std::vector<std::string>& output_formats()
{
    static const std::vector<std::string> formats = {"iges", "step", "glb", "vtu", "dxf", "csv", "png"};
    return formats;
}

std::vector<std::filesystem::path> write_outputs(const Session& session, const std::filesystem::path& folder,
                                                 const std::vector<std::string>& formats, const Progress& progress)
{
    if (!session.blank)
        throw InputError("there is nothing to write yet: solve the part first");
    for (const std::string& format : formats)
        if (std::find(output_formats().begin(), output_formats().end(), format) == output_formats().end())
            throw InputError(
                fmt::format("the format \"{}\" is not known; known are {}", format, fmt::join(output_formats(), ", ")));
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed)
        throw ExchangeError(fmt::format("cannot make the folder {}: {}", folder.string(), failed.message()));

    const TriMesh& part = session.part->mesh;
    const FlattenResult& flat = *session.blank;
    const std::string name = session.file.stem().string();
    ExportScene scene;
    scene.name = name;
    scene.part = &part;
    scene.blank = &flat.blank;
    scene.fields = &flat.node;
    if (session.lifted)
        scene.quad_mesh = &session.lifted->lifted;
    Tessellation tessellation;
    const NurbsSurface* surface = nullptr;
    if (session.surface) {
        surface = &session.surface->result.surface;
        tessellation = tessellate(*surface, 3);
        scene.surface = &tessellation.mesh;
        scene.surface_normal = &tessellation.normal;
        scene.control_net = surface;
    }

    std::vector<std::filesystem::path> files;
    const auto file = [&](const std::string& file_name) -> const std::filesystem::path& {
        return files.emplace_back(folder / file_name);
    };
    for (size_t i = 0; i < formats.size(); ++i) {
        const std::string& format = formats[i];
        progress.checkpoint(double(i) / double(formats.size()), "writing " + format);
        if (format == "iges") {
            if (surface)
                write_iges(file(name + ".iges"), *surface, name);
        } else if (format == "step") {
            if (surface)
                write_step(file(name + ".step"), *surface, name);
        } else if (format == "glb")
            write_gltf(file(name + ".glb"), scene);
        else if (format == "vtu") {
            Eigen::VectorXd deviation;
            std::vector<NamedField> extra;
            if (session.surface) {
                deviation = session.surface->deviation.at_vertex.head(part.vertices());
                extra.push_back({"deviation", &deviation});
            }
            write_vtu(file(name + ".vtu"), part, flat.blank, flat.face, flat.node, extra);
        } else if (format == "dxf")
            write_dxf(file(name + ".dxf"), blank_outline(part, flat.blank));
        else if (format == "csv") {
            write_fields_csv(file("fields.csv"), part, flat.blank, flat.node, session.part->source_vertex);
            write_outline_csv(file("outline.csv"), blank_outline(part, flat.blank));
        } else if (format == "png")
            write_picture(file(name + ".png"), scene);
    }
    return files;
}

} // namespace spia

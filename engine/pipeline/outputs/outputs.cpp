#include "engine/pipeline/outputs/outputs.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/exchange/lines/blank_outline.h"
#include "engine/exchange/lines/write_dxf.h"
#include "engine/exchange/mesh/write_gltf.h"
#include "engine/exchange/mesh/write_vtu.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/exchange/text/write_csv.h"
#include "engine/picture/picture.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/outputs/deck_outputs.h"
#include "engine/pipeline/outputs/iga_outputs.h"
#include "engine/pipeline/outputs/session_scene.h"

namespace fs = std::filesystem;

namespace spia {
namespace {

std::string file_stem(const Session& session, const OutputOptions& options)
{
    return options.name.empty() ? session.file.stem().string() : options.name;
}

/// Whether the session has anything for a file of this format.
bool has_content(const std::string& format, const Session& session, const OutputOptions& options)
{
    if (is_of_surface(format))
        return session.surface != nullptr;
    const GltfNodes& glb = options.glb;
    return format != "glb" || glb.part || glb.blank || (glb.quad_mesh && session.lifted) ||
           (holds_surface(format, options) && session.surface);
}

/// @throws InputError if the format is unknown, the name is none, or nothing is chosen of the
/// format
std::vector<std::string> file_names(const std::string& format, const Session& session, const OutputOptions& options)
{
    if (std::find(output_formats().begin(), output_formats().end(), format) == output_formats().end())
        throw InputError(
            fmt::format("the format \"{}\" is not known; known are {}", format, fmt::join(output_formats(), ", ")));
    require_file_name(options.name);
    if (format == "csv") {
        if (options.csv == CsvTables{false, false, false})
            throw InputError("no CSV table is chosen; take fields, outline or faces");
        const std::string first = options.name.empty() ? "" : options.name + "-";
        std::vector<std::string> names;
        if (options.csv.fields)
            names.push_back(first + "fields.csv");
        if (options.csv.outline)
            names.push_back(first + "outline.csv");
        if (options.csv.faces)
            names.push_back(first + "faces.csv");
        return names;
    }
    if (is_deck_format(format))
        return deck_file_names(format, file_stem(session, options));
    if (is_iga_format(format))
        return iga_file_names(format, file_stem(session, options));
    if (format == "glb" && options.glb == GltfNodes{false, false, false, false, false})
        throw InputError("nothing is chosen for the GLB file; take part, blank, quad_mesh, surface or control_net");
    return {file_stem(session, options) + "." + format};
}

/// Also the straight bends of a bracket; what a drawn part has in their place is no matter for a
/// press brake.
BlankDrawing drawing_for_shop(const Session& session)
{
    return drawn_blank(*session.part, bends_for_shop(*session.part), session.blank->blank, session.blank->face, true,
                       session.bends.get());
}

DxfOptions dxf_options(const OutputOptions& options)
{
    DxfOptions dxf = options.dxf;
    dxf.unit = options.unit;
    return dxf;
}

} // namespace

void require_file_name(const std::string& name)
{
    if (name.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos || name == "." || name == "..")
        throw InputError(fmt::format("\"{}\" is not a file name; leave out folders", name));
}

const std::vector<std::string>& usual_formats()
{
    static const std::vector<std::string> formats = {"iges", "step", "glb", "vtu", "dxf", "csv", "png"};
    return formats;
}

const std::vector<std::string>& output_formats()
{
    static const std::vector<std::string> formats = [] {
        std::vector<std::string> all = usual_formats();
        all.insert(all.end(), iga_formats().begin(), iga_formats().end());
        all.insert(all.end(), deck_formats().begin(), deck_formats().end());
        return all;
    }();
    return formats;
}

bool is_of_surface(const std::string& format) { return format == "iges" || format == "step" || is_iga_format(format); }

bool holds_surface(const std::string& format, const OutputOptions& options)
{
    return is_of_surface(format) || (format == "glb" && (options.glb.surface || options.glb.control_net));
}

bool shows_surface(const std::string& format) { return format != "dxf" && format != "csv" && !is_deck_format(format); }

std::vector<fs::path> output_files(const Session& session, const fs::path& folder,
                                   const std::vector<std::string>& formats, const OutputOptions& options)
{
    std::vector<fs::path> files;
    for (const std::string& format : formats)
        for (const std::string& file : file_names(format, session, options))
            if (has_content(format, session, options))
                files.push_back(folder / file);
    return files;
}

bool same_place(const fs::path& a, const fs::path& b)
{
    std::error_code ignored; // weakly_canonical() leaves a path relative of which nothing is there
    const auto whole = [&](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, ignored), ignored); };
    return whole(a) == whole(b) || fs::equivalent(a, b, ignored);
}

void require_place(const Session& session, const fs::path& folder, const std::vector<std::string>& formats,
                   const std::vector<fs::path>& others, const OutputOptions& options)
{
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed || !fs::is_directory(folder))
        throw ExchangeError(fmt::format("cannot make the folder {}: {}; choose another one", folder.string(),
                                        failed ? failed.message() : "there is a file of that name"));
    if (session.part)
        require_deck_ids(formats, *session.part);
    std::vector<fs::path> files;
    for (const std::string& format : formats)
        // also what has no surface yet
        for (const std::string& file : file_names(format, session, options))
            files.push_back(folder / file);
    for (const fs::path& other : others) {
        if (other.empty())
            continue;
        for (const fs::path& file : files)
            if (same_place(file, other))
                throw ExchangeError(fmt::format("{} is wanted for two files; choose another name", other.string()));
        files.push_back(other);
    }
    for (const fs::path& file : files) {
        if (same_place(file, session.file))
            throw ExchangeError(fmt::format(
                "{} is the part itself and would be overwritten; choose another folder or name", file.string()));
        require_writable(file);
    }
}

std::vector<fs::path> write_outputs(const Session& session, const fs::path& folder,
                                    const std::vector<std::string>& formats, const OutputOptions& options,
                                    const Progress& progress, const WritingJob::Written& written_file)
{
    if (!session.blank)
        throw InputError("there is nothing to write yet: solve the part first");
    require_place(session, folder, formats, {}, options);

    const TriMesh& part = session.part->mesh;
    const FlattenResult& flat = *session.blank;
    const std::string name = file_stem(session, options);
    const LengthUnit unit = options.unit;
    constexpr double prepared = 0.1; // share of the time
    const SessionScene shown(session, name, progress.part(0, prepared));
    const ExportScene& scene = shown.scene();
    const Zones* zones = scene.zones;

    size_t of_all = 0;
    for (const std::string& format : formats)
        of_all += has_content(format, session, options) ? file_names(format, session, options).size() : 0;
    const Progress writing = progress.part(prepared, 1);
    const WritingJob job(writing, of_all, written_file);
    const std::string_view blank_from = spia::name(session.options.steps);
    std::vector<fs::path> files;
    const auto write = [&](const std::string& format) {
        if (is_deck_format(format)) {
            const auto written =
                write_deck_files(folder, name, std::span(&format, 1), *session.part, flat.blank, flat.face, unit);
            files.insert(files.end(), written.begin(), written.end());
            return;
        }
        if (is_iga_format(format)) {
            const auto written = write_iga_files(folder, name, format, session, unit);
            files.insert(files.end(), written.begin(), written.end());
            return;
        }
        const size_t first = files.size();
        for (const std::string& file : file_names(format, session, options))
            files.push_back(folder / file);
        const fs::path path = files[first];
        if (format == "iges")
            write_iges(path, surface_patches(session).patch, name, unit, std::span(&session.surface->trim.loop, 1));
        else if (format == "step")
            write_step(path, surface_patches(session).patch, name, unit, std::span(&session.surface->trim.loop, 1));
        else if (format == "glb")
            write_gltf(path, scene, options.glb);
        else if (format == "vtu") {
            Eigen::VectorXd deviation;
            std::vector<NamedField> extra;
            if (session.surface) {
                deviation = session.surface->deviation.at_vertex.head(part.vertices());
                extra.push_back({"deviation", &deviation});
            }
            write_vtu(path, part, flat.blank, flat.face, flat.node, extra, unit, zones,
                      flat.skins ? &*flat.skins : nullptr, blank_from);
        } else if (format == "dxf")
            write_dxf(path, drawing_for_shop(session), dxf_options(options));
        else if (format == "csv") {
            size_t table = first;
            if (options.csv.fields)
                write_fields_csv(files[table++], part, flat.blank, flat.node, session.part->source_vertex, unit);
            if (options.csv.outline)
                write_outline_csv(files[table++], blank_outline(part, flat.blank), unit);
            if (options.csv.faces)
                write_faces_csv(files[table], part, flat.face, zones, session.part->source_face, unit,
                                flat.skins ? &*flat.skins : nullptr);
        } else
            write_picture(path, scene);
    };
    std::exception_ptr failed; // a format that cannot be written keeps no other from being
    for (const std::string& format : formats) {
        if (!has_content(format, session, options))
            continue;
        writing.checkpoint(double(files.size()) / double(of_all), "writing " + format);
        try {
            write(format);
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) {
            failed = failed ? failed : std::current_exception();
        }
    }
    if (failed)
        std::rethrow_exception(failed);
    return files;
}

} // namespace spia

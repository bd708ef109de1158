#include "engine/pipeline/outputs/iga_outputs.h"

#include <algorithm>

#include "engine/coons/carry_field.h"
#include "engine/exchange/iga/write_geopdes.h"
#include "engine/exchange/iga/write_gismo.h"
#include "engine/exchange/iga/write_iga_dyna.h"
#include "engine/exchange/iga/write_mfem.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/blank_chart.h"
#include "engine/nurbs/evaluate.h"

namespace spia {
namespace {

constexpr const char* field_names[] = {"thickness", "plastic_strain"};

/// Where on the part the lines u[i], v[j] of the surface's data meet: nodes of the grid; of a fit
/// within a tolerance those of its finer chart, or what the surface is nearest to where its
/// parameters are no places of the blank any more.
std::vector<MeshPoint> places_of_data(const Session& session)
{
    const InterpolateResult& fitted = session.surface->result;
    if (!session.surface->fit)
        return session.lifted->place;
    const GridStage& grid = *session.grid;
    if (session.options.fit_parameters == FitParameters::blank)
        return BlankChart(grid.result, grid.boundary).refined(fitted.u, fitted.v).place;
    const ClosestPointSearch search(grid.result.filled->mesh);
    std::vector<MeshPoint> places;
    for (const double v : fitted.v)
        for (const double u : fitted.u) {
            const ClosestPoint nearest = search.nearest(evaluate(fitted.surface, u, v).position);
            places.push_back({nearest.face, nearest.barycentric});
        }
    return places;
}

/// From the vertices to the places where the data of the patches lie, and on to the patches.
std::vector<PatchField> fields_of_patches(const Session& session)
{
    const PatchesFit& fit = *session.surface->patches;
    const SheetFields& sheet = session.blank->node;
    const auto on_patches = [&](const char* name, const char* unit, const Eigen::VectorXd& at_vertices) {
        PatchField field{name, unit, {}};
        for (size_t p = 0; p < fit.patches.patch.size(); ++p) {
            Eigen::VectorXd nodes = Eigen::VectorXd::Zero(Eigen::Index(fit.place[p].size()));
            for (size_t n = 0; n < fit.place[p].size(); ++n)
                for (int k = 0; k < 3; ++k)
                    nodes[Eigen::Index(n)] += fit.place[p][n].barycentric[k] *
                                              at_vertices[session.part->mesh.triangle(k, fit.place[p][n].face)];
            field.value.push_back(fit_field(fit.patches.patch[p], fit.u[p], fit.v[p], nodes));
        }
        share_borders(fit.patches, field);
        return field;
    };
    return {on_patches(field_names[0], "mm", sheet.thickness),
            on_patches(field_names[1], "1", sheet.strain_equivalent)};
}

} // namespace

const std::vector<std::string>& iga_formats()
{
    static const std::vector<std::string> formats = {"gismo", "mfem", "geopdes", "iga-k"};
    return formats;
}

bool is_iga_format(const std::string& format)
{
    return std::find(iga_formats().begin(), iga_formats().end(), format) != iga_formats().end();
}

std::vector<std::string> iga_file_names(const std::string& format, const std::string& name)
{
    if (format == "geopdes")
        return {name + "-geopdes.txt"};
    if (format == "iga-k")
        return {name + "-iga.k"};
    const bool gismo = format == "gismo";
    std::vector<std::string> names = {name + (gismo ? "-gismo.xml" : "-mfem.mesh")};
    for (const char* field : field_names)
        names.push_back(name + (gismo ? "-gismo-" : "-mfem-") + field + (gismo ? ".xml" : ".gf"));
    return names;
}

std::vector<PatchField> surface_fields(const Session& session)
{
    if (session.surface->patches)
        return fields_of_patches(session);
    const InterpolateResult& fitted = session.surface->result;
    const SheetFields& sheet = session.blank->node;
    const std::vector<MeshPoint> places = places_of_data(session);
    const auto on_surface = [&](const char* name, const char* unit, const Eigen::VectorXd& at_vertices) {
        const Eigen::VectorXd nodes = carry_field(*session.grid->result.filled, at_vertices, places);
        return PatchField{name, unit, {fit_field(fitted.surface, fitted.u, fitted.v, nodes)}};
    };
    return {on_surface(field_names[0], "mm", sheet.thickness),
            on_surface(field_names[1], "1", sheet.strain_equivalent)};
}

std::vector<std::filesystem::path> write_iga_files(const std::filesystem::path& folder, const std::string& name,
                                                   const std::string& format, const Session& session, LengthUnit unit)
{
    std::vector<std::filesystem::path> files;
    for (const std::string& file : iga_file_names(format, name))
        files.push_back(folder / file);
    const MultiPatch patches = surface_patches(session);
    if (format == "geopdes") {
        write_geopdes(files[0], patches, name, unit);
        return files;
    }
    const std::vector<PatchField> fields = surface_fields(session);
    if (format == "iga-k") {
        std::vector<double> thickness;
        for (size_t p = 0; p < patches.patch.size(); ++p)
            thickness.push_back(field_mean(patches.patch[p], fields[0].value[p]));
        write_iga_dyna(files[0], patches, thickness, session.options.flatten.material, name, unit);
        return files;
    }
    const bool gismo = format == "gismo";
    (gismo ? write_gismo : write_mfem)(files[0], patches, name, unit);
    for (size_t k = 0; k < fields.size(); ++k)
        (gismo ? write_gismo_field : write_mfem_field)(files[k + 1], patches, fields[k], name, unit);
    return files;
}

} // namespace spia

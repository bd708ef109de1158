#include "engine/report/figures/figures.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"
#include "engine/part/curved_faces.h"
#include "engine/report/figures/face_values.h"

namespace spia {
namespace {

double flat_area(const TriMesh& part, const Eigen::Matrix2Xd& X)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const auto x = corners(X, part.triangle.col(f));
        const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
        sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    return sum;
}

std::array<double, 2> range(const Eigen::VectorXd& value) { return {value.minCoeff(), value.maxCoeff()}; }

} // namespace

PartFigures part_figures(const PartFile& part)
{
    const Eigen::Matrix3Xd& position = part.mesh.position;
    if (position.cols() == 0)
        return {};
    const Eigen::Vector3d size = position.rowwise().maxCoeff() - position.rowwise().minCoeff();
    constexpr double rounding = 1e-9; // of the diagonal: a flat part that is turned has no height
    const double diagonal = bounding_diagonal(part.mesh);
    return {(size.array() > rounding * diagonal).select(size, 0), diagonal};
}

SurfaceOfPart surface_of_part(const PartFile& part)
{
    return {int(boundary_loops(part.mesh).size()), sheet_area(part)};
}

BlankSize blank_size(const TriMesh& part, const Blank& blank)
{
    const Eigen::Matrix2Xd& X = blank.position;
    const auto loops = boundary_loops(part);
    return {X.rowwise().minCoeff(), X.rowwise().maxCoeff(), flat_area(part, X),
            length(loops[size_t(outer_loop(loops, X))], X)};
}

SheetFigures sheet_figures(const SheetFields& face)
{
    return {range(face.thinning), range(face.strain_major), range(face.strain_minor), range(face.thickness),
            face.strain_equivalent.maxCoeff()};
}

SheetFigures sheet_figures(const SheetFields& face, const std::vector<int>& faces)
{
    if (faces.empty())
        return {};
    return {range(face.thinning(faces)), range(face.strain_major(faces)), range(face.strain_minor(faces)),
            range(face.thickness(faces)), face.strain_equivalent(faces).maxCoeff()};
}

SheetFigures without_noise(SheetFigures figures)
{
    const double floor = noise(Field::strain_major, 0);
    const auto clear = [&](double& value) { value = std::abs(value) < floor ? 0 : value; };
    for (auto* range : {&figures.thinning, &figures.strain_major, &figures.strain_minor})
        std::for_each(range->begin(), range->end(), clear);
    clear(figures.strain_equivalent);
    return figures;
}

std::array<double, 4> side_lengths(const GridStage& grid, const Blank& blank)
{
    std::array<double, 4> lengths{};
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int>& side = grid.boundary.side[k];
        for (size_t i = 1; i < side.size(); ++i)
            lengths[k] += (blank.position.col(side[i]) - blank.position.col(side[i - 1])).norm();
    }
    return lengths;
}

SurfaceFigures surface_figures(const SurfaceStage& surface)
{
    const Deviation& d = surface.deviation;
    SurfaceFigures figures;
    if (const auto& patches = surface.patches) {
        figures.patches = int(patches->patches.patch.size());
        figures.joints = int(patches->patches.interfaces.size());
        figures.control_points = shared_controls(patches->patches).count;
        figures.singular_nodes = singular_nodes(patches->patches);
    } else
        figures.control_points = surface.result.surface.count_u * surface.result.surface.count_v;
    figures.deviation_max = d.max();
    figures.deviation_rms = std::max(d.surface_to_mesh.rms, d.mesh_to_surface.rms);
    figures.deviation_p95 = std::max(d.surface_to_mesh.p95, d.mesh_to_surface.p95);
    return figures;
}

CertificateFigures certificate_figures(const Certificate& certificate)
{
    CertificateFigures figures;
    figures.least_scaled = certificate.poorest().least_scaled;
    figures.patch = size_t(&certificate.poorest() - certificate.patch.data());
    for (const InterfaceCertificate& joint : certificate.interfaces)
        figures.greatest_angle = std::max(figures.greatest_angle, joint.greatest_angle);
    return figures;
}

std::vector<PatchFigures> patch_figures(const PatchesFit& fit, const Certificate& certificate)
{
    std::vector<PatchFigures> figures;
    for (size_t p = 0; p < certificate.patch.size(); ++p) {
        const PatchCertificate& proved = certificate.patch[p];
        figures.push_back({p, proved.refusal.has_value(), proved.least_scaled, proved.mean_scaled,
                           fit.patch_deviation[p], int(fit.patches.patch[p].control.cols())});
    }
    return figures;
}

std::vector<PatchFigures> worst_first(std::vector<PatchFigures> patches, PatchMeasure measure)
{
    std::ranges::stable_sort(patches, {}, [&](const PatchFigures& patch) {
        switch (measure) {
        case PatchMeasure::number: return std::pair(true, double(patch.patch));
        case PatchMeasure::least_scaled: return std::pair(!patch.refused, patch.least_scaled);
        case PatchMeasure::mean_scaled: return std::pair(!patch.refused, patch.mean_scaled);
        case PatchMeasure::deviation: return std::pair(true, -patch.deviation.max);
        case PatchMeasure::control_points: return std::pair(true, -double(patch.control_points));
        }
        return std::pair(true, 0.0);
    });
    return patches;
}

ResultFigures result_figures(const Session& session)
{
    const TriMesh& part = session.part->mesh;
    const Blank& blank = session.blank->blank;
    ResultFigures figures{surface_of_part(*session.part),
                          blank_size(part, blank),
                          sheet_figures(session.blank->face),
                          distortion(part, blank.position),
                          {},
                          {}};
    if (session.surface) {
        figures.surface = surface_figures(*session.surface);
        figures.certificate = certificate_figures(surface_certificate(session));
    }
    return figures;
}

} // namespace spia

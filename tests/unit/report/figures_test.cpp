#include "engine/report/figures/figures.h"

#include <gtest/gtest.h>

#include "engine/coons/cell_quality.h"
#include "engine/core/json_file.h"
#include "engine/report/json/report_json.h"
#include "tests/support/shapes.h"
#include "tests/unit/report/report_samples.h"

namespace spia {

TEST(Figures, AreTheLeastAndGreatestOfAllVerticesFacesAndCells)
{
    const Session session = session_of(dome, Stage::grid);
    const TriMesh& mesh = session.part->mesh;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (int v = 0; v < mesh.vertices(); ++v)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], mesh.position(k, v));
            high[k] = std::max(high[k], mesh.position(k, v));
        }
    const PartFigures part = part_figures(*session.part);
    EXPECT_EQ(part.size, high - low);
    EXPECT_NEAR(part.diagonal, (high - low).norm(), 1e-9);

    const SheetFigures sheet = sheet_figures(session.blank->face);
    double least = 1e300, greatest = -1e300, strain = 0, minor = 1e300, major = -1e300;
    for (int f = 0; f < mesh.triangles(); ++f) {
        least = std::min(least, session.blank->face.thinning[f]);
        greatest = std::max(greatest, session.blank->face.thinning[f]);
        strain = std::max(strain, session.blank->face.strain_equivalent[f]);
        minor = std::min(minor, session.blank->face.strain_minor[f]);
        major = std::max(major, session.blank->face.strain_major[f]);
    }
    EXPECT_EQ(sheet.thinning, (std::array{least, greatest}));
    EXPECT_EQ(sheet.strain_equivalent, strain);
    EXPECT_EQ(sheet.strain_minor[0], minor);
    EXPECT_EQ(sheet.strain_major[1], major);

    const GridResult& grid = session.grid->result;
    const Eigen::VectorXd jacobian = scaled_jacobians(grid.planar);
    for (const double value : jacobian)
        EXPECT_GE(value, grid.quality.min_scaled_jacobian);
    EXPECT_EQ(jacobian[grid.quality.worst_cell], grid.quality.min_scaled_jacobian);
    double border = 0, around = 0; // the outline of the blank, as the loop of its boundary
    for (const double side : side_lengths(*session.grid, session.blank->blank))
        border += side;
    for (const auto& side : session.grid->boundary.side)
        for (size_t k = 0; k + 1 < side.size(); ++k)
            around +=
                std::hypot(session.blank->blank.position(0, side[k]) - session.blank->blank.position(0, side[k + 1]),
                           session.blank->blank.position(1, side[k]) - session.blank->blank.position(1, side[k + 1]));
    EXPECT_NEAR(border, around, 1e-9);
}

TEST(Figures, OfARectangleWithAHoleAreThoseOfTheClosedForm)
{
    // 400 x 200 mm in cells of 10 mm, without 8 x 4 of them, laid 3 % longer along x.
    const TriMesh whole = shapes::rectangle(400, 200, 40, 20);
    TriMesh part = whole;
    int kept = 0;
    for (int f = 0; f < whole.triangles(); ++f) {
        const Eigen::Vector3d middle = whole.position(Eigen::all, whole.triangle.col(f)).rowwise().mean();
        const Eigen::Vector2d from = middle.head<2>() - whole.position.col(0).head<2>();
        if (from[0] < 100 || from[0] > 180 || from[1] < 80 || from[1] > 120)
            part.triangle.col(kept++) = whole.triangle.col(f);
    }
    part.triangle.conservativeResize(3, kept);
    const double area = 400 * 200 - 80 * 40;
    PartFile file;
    file.mesh = part;
    const SurfaceOfPart sheet = surface_of_part(file);
    EXPECT_EQ(sheet.boundary_loops, 2);
    EXPECT_NEAR(sheet.area, area, 1e-9 * area);
    Blank blank{part.position.topRows(2)};
    blank.position.row(0) *= 1.03;
    const BlankSize size = blank_size(part, blank);
    EXPECT_NEAR(size.sides()[0], 412, 1e-9);
    EXPECT_NEAR(size.sides()[1], 200, 1e-9);
    EXPECT_NEAR(size.area, 1.03 * area, 1e-9 * area);
    EXPECT_NEAR(size.perimeter, 2 * (412 + 200), 1e-9) << "of the outer loop alone";
}

TEST(Figures, NoiseIsNothingOnlyForPeople)
{
    SheetFields face;
    face.thinning = Eigen::Vector3d(-3e-6, 0, 0.2);
    face.thickness = 1 - face.thinning.array();
    face.strain_major = face.strain_minor = face.strain_equivalent = Eigen::Vector3d(1e-6, 2e-6, 3e-6);
    const SheetFigures sheet = sheet_figures(face), shown = without_noise(sheet);
    EXPECT_EQ(sheet.thinning, (std::array{-3e-6, 0.2})) << "what JSON says";
    EXPECT_EQ(sheet.strain_equivalent, 3e-6);
    EXPECT_EQ(sheet.thickness, (std::array{face.thickness[2], face.thickness[0]}));
    EXPECT_EQ(shown.thinning, (std::array{0., 0.2}));
    EXPECT_EQ(shown.strain_equivalent, 0);
    EXPECT_EQ(shown.thickness, sheet.thickness);
    const SheetFigures some = sheet_figures(face, {1, 0});
    EXPECT_EQ(some.thinning, (std::array{-3e-6, 0.}));
    EXPECT_EQ(some.strain_equivalent, 2e-6);
    EXPECT_EQ(sheet_figures(face, {}).thinning, (std::array{0., 0.}));
}

TEST(Figures, OfPatchesAreThoseOfTheWorstOfThem)
{
    Certificate certificate;
    certificate.patch.resize(3);
    certificate.patch[0].least_scaled = 0.7;
    certificate.patch[1].least_scaled = 0.2;
    certificate.patch[2].least_scaled = 0.9;
    certificate.interfaces.resize(2);
    certificate.interfaces[0].greatest_angle = 0.3;
    certificate.interfaces[1].greatest_angle = 0.1;
    const CertificateFigures figures = certificate_figures(certificate);
    EXPECT_EQ(figures.least_scaled, 0.2);
    EXPECT_EQ(figures.patch, 1);
    EXPECT_EQ(figures.greatest_angle, 0.3);
}

TEST(Figures, ListTheWorstPatchFirst)
{
    Certificate certificate;
    certificate.patch.resize(4);
    PatchesFit fit;
    fit.patches.patch.resize(4);
    for (size_t p = 0; p < 4; ++p) {
        certificate.patch[p].least_scaled = std::array{0.7, 0.2, 0.9, 0.2}[p];
        certificate.patch[p].mean_scaled = std::array{0.8, 0.9, 0.95, 0.7}[p];
        fit.patch_deviation.push_back({std::array{0.1, 0.3, 0.3, 0.2}[p], Eigen::Vector3d(double(p), 0, 0)});
        fit.patches.patch[p].control.resize(4, std::array{16, 20, 36, 36}[p]);
    }
    certificate.patch[2].refusal = Refusal{};
    const auto order = [&](PatchMeasure measure) {
        std::vector<size_t> numbers;
        for (const PatchFigures& patch : worst_first(patch_figures(fit, certificate), measure))
            numbers.push_back(patch.patch);
        return numbers;
    };
    EXPECT_EQ(order(PatchMeasure::number), (std::vector<size_t>{0, 1, 2, 3}));
    EXPECT_EQ(order(PatchMeasure::least_scaled), (std::vector<size_t>{2, 1, 3, 0}));
    EXPECT_EQ(order(PatchMeasure::mean_scaled), (std::vector<size_t>{2, 3, 0, 1}));
    EXPECT_EQ(order(PatchMeasure::deviation), (std::vector<size_t>{1, 2, 3, 0}));
    EXPECT_EQ(order(PatchMeasure::control_points), (std::vector<size_t>{2, 3, 1, 0}));
    const PatchFigures last = patch_figures(fit, certificate).back();
    EXPECT_EQ(last.deviation.where.x(), 3);
    EXPECT_EQ(last.control_points, 36);
}

TEST(Figures, AreTheSameInJson)
{
    const Session session = session_of(dome, Stage::fit);
    const ResultFigures figures = result_figures(session);
    const Json json = parse_json(report_json(session, {}, 0), "report");
    EXPECT_EQ(json["part"]["area_mm2"].get<double>(), figures.part.area);
    EXPECT_EQ(json["blank"]["area_mm2"].get<double>(), figures.blank.area);
    EXPECT_EQ(json["blank"]["bounding_box_mm"][2].get<double>(), figures.blank.high[0]);
    EXPECT_EQ(json["result"]["thinning_max"].get<double>(), figures.sheet.thinning[1]);
    EXPECT_EQ(json["distortion"]["area_rms"].get<double>(), figures.distortion.area_rms);
    EXPECT_EQ(json["surface"]["deviation_rms_mm"].get<double>(), figures.surface->deviation_rms);
    const Deviation& deviation = session.surface->deviation;
    EXPECT_EQ(figures.surface->deviation_rms, std::max(deviation.surface_to_mesh.rms, deviation.mesh_to_surface.rms));
    EXPECT_EQ(json["surface"]["control_points_u"].get<int>() * json["surface"]["control_points_v"].get<int>(),
              figures.surface->control_points);
    EXPECT_EQ(json["certificate"]["patches"][0]["scaled_jacobian_min"].get<double>(),
              figures.certificate->least_scaled);
}

} // namespace spia

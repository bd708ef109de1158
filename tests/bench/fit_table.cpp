// How many control points surfaces within a tolerance need: fit(), uniform interpolation, and
// OpenCASCADE's approximation of the points of the fit. The deviation of all three is measured in
// the same way: from the known sheet, at dense places.
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <chrono>
#include <fmt/core.h>
#include <string>

#include "engine/coons/quad_grid.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit.h"
#include "engine/nurbs/interpolate.h"
#include "tests/support/meshed_sheet.h"

using namespace spia;

namespace {

constexpr int mesh_cells = 250;

template <class Place> double distance_from(const shapes::KnownSheet& sheet, const Place& place)
{
    double largest = 0;
    const int n = 301;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            largest = std::max(largest, sheet.distance(place(double(i) / n, double(j) / n)));
    return largest;
}

double distance_from(const shapes::KnownSheet& sheet, const NurbsSurface& surface)
{
    return distance_from(sheet, [&](double u, double v) { return evaluate(surface, u, v).position; });
}

/// The fewest control points of a bicubic surface through even nodes, as many along u as along v.
std::string uniform_interpolation(const shapes::KnownSheet& sheet, const TriMesh& mesh, double tolerance)
{
    for (int cells = 3; cells <= 200; cells += 1 + cells / 20) {
        const QuadGrid grid = shapes::even_grid(mesh, mesh_cells, cells);
        const InterpolateOptions options{.parameters = InterpolateOptions::Parameters::uniform};
        if (distance_from(sheet, interpolate(grid, options).surface) <= tolerance)
            return fmt::format("{}", (cells + 1) * (cells + 1));
    }
    return "> 40000";
}

std::string open_cascade(const shapes::KnownSheet& sheet, const FitSource& source, const FitResult& fitted,
                         double tolerance, double wanted)
{
    const Eigen::Matrix3Xd points = source.at(fitted.u, fitted.v);
    const int n = int(fitted.u.size()), m = int(fitted.v.size());
    TColgp_Array2OfPnt array(1, n, 1, m);
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i)
            array.SetValue(i + 1, j + 1, gp_Pnt(points(0, i + j * n), points(1, i + j * n), points(2, i + j * n)));
    // It takes its tolerance for a mean: it is asked for less until what is measured is as little
    // as was wanted.
    try {
        double asked = tolerance;
        std::string text;
        for (int tries = 0; tries < 12; ++tries, asked *= 0.8) {
            const auto clock = std::chrono::steady_clock::now();
            const GeomAPI_PointsToBSplineSurface made(array, 3, 3, GeomAbs_C2, asked);
            const Handle(Geom_BSplineSurface) surface = made.Surface();
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
            double u0, u1, v0, v1;
            surface->Bounds(u0, u1, v0, v1);
            const double distance = distance_from(sheet, [&](double u, double v) {
                const gp_Pnt p = surface->Value(u0 + u * (u1 - u0), v0 + v * (v1 - v0));
                return Eigen::Vector3d(p.X(), p.Y(), p.Z());
            });
            if (tries == 0 || distance <= wanted)
                text += fmt::format("{}{} ({:.2g} mm, {:.2f} s)", tries > 0 ? "; " : "",
                                    surface->NbUPoles() * surface->NbVPoles(), distance, seconds);
            if (distance <= wanted)
                return text;
        }
        return text + "; not within";
    } catch (const Standard_Failure& failure) {
        return fmt::format("fails: {}", failure.GetMessageString());
    }
}

} // namespace

int main(int count, char** values)
{
    const std::string only = count > 1 ? values[1] : ""; // a sheet

    fmt::print(
        "| sheet | tolerance / size | mm | fit: control points (measured) | s | corrected parameters | uniform interpolation | OpenCASCADE "
        "(measured, s) |\n|---|---|---|---|---|---|---|---|\n");
    for (const shapes::KnownSheet& sheet : shapes::known_sheets()) {
        if (!only.empty() && sheet.name != only)
            continue;
        const TriMesh mesh = shapes::mesh_of(sheet, mesh_cells);
        FitSource source;
        source.at = [&](const std::vector<double>& u, const std::vector<double>& v) {
            Eigen::Matrix3Xd points(3, Eigen::Index(u.size() * v.size()));
            for (size_t j = 0; j < v.size(); ++j)
                for (size_t i = 0; i < u.size(); ++i)
                    points.col(Eigen::Index(i + j * u.size())) = shapes::on_mesh(mesh, mesh_cells, u[i], v[j]);
            return points;
        };
        const double chord = shapes::chord_error(sheet, mesh);
        for (const double relative : {1e-1, 1e-2, 1e-3, 1e-4}) {
            FitOptions options;
            options.tolerance = relative * sheet.size;
            const auto clock = std::chrono::steady_clock::now();
            const FitResult fitted = fit(source, mesh, options);
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
            options.parameters = FitParameters::corrected;
            const FitResult corrected = fit(source, mesh, options);
            const auto counts = [&](const FitResult& result) {
                return fmt::format("{} x {} = {}{} ({:.2g} mm)", result.surface.count_u, result.surface.count_v,
                                   result.surface.control.cols(), result.report.reached ? "" : " NOT reached",
                                   distance_from(sheet, result.surface));
            };
            fmt::print("| {} | {:.0e} | {:.4g} | {} | {:.2f} | {} | {} | {} |\n", sheet.name, relative,
                       options.tolerance, counts(fitted), seconds, counts(corrected),
                       uniform_interpolation(sheet, mesh, options.tolerance + chord),
                       open_cascade(sheet, source, fitted, options.tolerance, options.tolerance + chord));
            std::fflush(stdout);
        }
    }
}

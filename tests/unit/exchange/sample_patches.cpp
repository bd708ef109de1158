#include "tests/unit/exchange/sample_patches.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/occt_surface.h"

namespace spia {
namespace {

constexpr double panel_length = 600, panel_width = 450;

/// Bezier heights of the panel, 4 by 4 over x and y.
constexpr double pole[4][4] = {{0, 20, 25, 5}, {30, 70, 60, 20}, {20, 55, 75, 35}, {-5, 15, 30, 10}};

double bernstein(int i, double t)
{
    constexpr double choose[] = {1, 3, 3, 1};
    return choose[i] * std::pow(t, i) * std::pow(1 - t, 3 - i);
}

/// Of a cubic through the polynomial's values at four places: its Bezier values from t0 to t1.
template <class Value> std::array<double, 4> bezier(double t0, double t1, const Value& value)
{
    // Blossoms: b(t0, t0, t0), b(t0, t0, t1), ... from values and the polar form of a cubic by its
    // interpolation.
    const double h = t1 - t0, f0 = value(t0), f1 = value(t0 + h / 3), f2 = value(t0 + 2 * h / 3), f3 = value(t1);
    return {f0, (-5 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 6, (2 * f0 - 9 * f1 + 18 * f2 - 5 * f3) / 6, f3};
}

/// The panel over a rectangle, exactly.
NurbsSurface piece(double x0, double x1, double y0, double y1, double lift)
{
    NurbsSurface s;
    s.degree_u = s.degree_v = 3;
    s.count_u = s.count_v = 4;
    s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
    s.control.resize(3, 16);
    s.weight.setOnes(16);
    std::array<std::array<double, 4>, 4> along_x; // at four y
    for (size_t j = 0; j < 4; ++j)
        along_x[j] = bezier(x0, x1, [&](double x) { return panel_height(x, y0 + (y1 - y0) * double(j) / 3); });
    for (int i = 0; i < 4; ++i) {
        const auto along_y = bezier(0, 1, [&](double t) { return along_x[size_t(std::lround(3 * t))][size_t(i)]; });
        for (int j = 0; j < 4; ++j)
            s.control.col(s.index(i, j)) << x0 + (x1 - x0) * i / 3, y0 + (y1 - y0) * j / 3, along_y[size_t(j)] + lift;
    }
    return s;
}

} // namespace

double panel_height(double x, double y)
{
    double height = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            height += pole[i][j] * bernstein(i, x / panel_length) * bernstein(j, y / panel_width);
    return height;
}

void write_panel(const std::filesystem::path& file, int count, double gap)
{
    const OcctSession session;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    Interface_Static::SetCVal("write.step.unit", "MM"); // whatever another test has left
    std::mt19937 random(2026);
    const auto upto = [&](double most) { return most * (2 * double(random()) / double(std::mt19937::max()) - 1); };
    const auto moved = [&] { return upto(0.45 * gap); };
    TopoDS_Compound faces;
    const BRep_Builder builder;
    builder.MakeCompound(faces);
    constexpr double further = 1; // mm
    for (int j = 0; j < count; ++j)
        for (int i = 0; i < count + (j % 2); ++i) { // every second row by half a patch to the side
            const double shift = j % 2 * 0.5;
            const double x0 = std::max(0.0, panel_length * (i - shift) / count),
                         x1 = std::min(panel_length, panel_length * (i + 1 - shift) / count),
                         y0 = panel_width * j / count, y1 = panel_width * (j + 1) / count;
            const double west = x0 > 0 ? x0 + moved() : x0, east = x1 < panel_length ? x1 + moved() : x1,
                         south = j > 0 ? y0 + moved() : y0, north = j + 1 < count ? y1 + moved() : y1;
            const double u_span = x1 - x0 + 2 * further, v_span = y1 - y0 + 2 * further;
            const auto surface =
                to_occt(piece(x0 - further, x1 + further, y0 - further, y1 + further, upto(0.1 * gap)));
            builder.Add(faces,
                        BRepBuilderAPI_MakeFace(surface, (west - x0 + further) / u_span, (east - x0 + further) / u_span,
                                                (south - y0 + further) / v_span, (north - y0 + further) / v_span, 1e-7)
                            .Face());
        }
    bool written = false;
    if (file.extension() == ".step") {
        STEPControl_Writer writer;
        written = writer.Transfer(faces, STEPControl_AsIs) == IFSelect_RetDone &&
                  writer.Write(file.c_str()) == IFSelect_RetDone;
    } else {
        IGESControl_Writer writer("MM", 0);
        writer.AddShape(faces);
        writer.ComputeModel();
        written = writer.Write(file.c_str());
    }
    if (!written)
        throw std::runtime_error("no panel was written");
}

} // namespace spia

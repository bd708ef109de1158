#include "engine/exchange/lines/write_lines.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepShape_GeometricCurveSet.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_HArray1OfXYZ.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <fmt/core.h>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/exchange/cad/occt_iges.h"
#include "engine/exchange/cad/occt_step.h"
#include "engine/exchange/cad/occt_surface.h"

namespace spia {
namespace {

/// With the first point again at the end of a closed line.
Eigen::Matrix3Xd run(const SheetLine& line)
{
    Eigen::Matrix3Xd points = line.point;
    if (line.closed) {
        points.conservativeResize(3, points.cols() + 1);
        points.rightCols<1>() = points.col(0);
    }
    return points;
}

/// The arc length up to every point.
std::vector<double> arc(const Eigen::Matrix3Xd& points)
{
    std::vector<double> at(size_t(points.cols()), 0);
    for (Eigen::Index k = 1; k < points.cols(); ++k)
        at[size_t(k)] = at[size_t(k - 1)] + (points.col(k) - points.col(k - 1)).norm();
    return at;
}

double greatest_coordinate(std::span<const SheetLine> lines)
{
    double largest = 0;
    for (const SheetLine& line : lines)
        largest = std::max(largest, line.point.cwiseAbs().maxCoeff());
    return largest;
}

Handle(IGESData_IGESEntity) entity_126(const SheetLine& line, LengthUnit unit)
{
    const Eigen::Matrix3Xd points = run(line) / millimetres(unit);
    const std::vector<double> at = arc(points);
    const int last = int(points.cols()) - 1;
    // IGES counts them from -degree
    Handle(TColStd_HArray1OfReal) knots = new TColStd_HArray1OfReal(-1, last + 1),
                                  weights = new TColStd_HArray1OfReal(0, last);
    Handle(TColgp_HArray1OfXYZ) poles = new TColgp_HArray1OfXYZ(0, last);
    for (int k = 0; k <= last; ++k) {
        knots->SetValue(k, at[size_t(k)]);
        weights->SetValue(k, 1);
        poles->SetValue(k, gp_XYZ(points(0, k), points(1, k), points(2, k)));
    }
    knots->SetValue(-1, at.front());
    knots->SetValue(last + 1, at.back());
    const bool planar = (line.point.row(2).array() == line.point(2, 0)).all();
    Handle(IGESGeom_BSplineCurve) entity = new IGESGeom_BSplineCurve;
    entity->Init(last, 1, planar, line.closed, true, false, knots, weights, poles, at.front(), at.back(),
                 gp_XYZ(0, 0, planar ? 1 : 0));
    Handle(IGESBasic_Name) name = new IGESBasic_Name;
    name->Init(1, iges_string(line.name));
    entity->AddProperty(name);
    return entity;
}

TopoDS_Edge edge(const SheetLine& line)
{
    const Eigen::Matrix3Xd points = run(line);
    const std::vector<double> at = arc(points);
    const int count = int(points.cols());
    TColgp_Array1OfPnt poles(1, count);
    TColStd_Array1OfReal knots(1, count);
    TColStd_Array1OfInteger multiplicity(1, count);
    for (int k = 0; k < count; ++k) {
        poles(k + 1) = gp_Pnt(points(0, k), points(1, k), points(2, k));
        knots(k + 1) = at[size_t(k)];
        multiplicity(k + 1) = k == 0 || k == count - 1 ? 2 : 1;
    }
    BRepBuilderAPI_MakeEdge made(Handle(Geom_Curve)(new Geom_BSplineCurve(poles, knots, multiplicity, 1)));
    if (!made.IsDone())
        throw ExchangeError(fmt::format("OpenCASCADE makes no curve of the line \"{}\"", line.name));
    return made.Edge();
}

TopoDS_Shape compound(std::span<const SheetLine> lines)
{
    TopoDS_Compound all;
    BRep_Builder builder;
    builder.MakeCompound(all);
    for (const SheetLine& line : lines)
        builder.Add(all, edge(line));
    return all;
}

/// Curves stand in their set in the order of the edges. @throws ExchangeError if one is missing
void name_curves(const StepData_StepModel& model, std::span<const SheetLine> lines)
{
    size_t next = 0;
    for (int i = 1; i <= model.NbEntities(); ++i) {
        const auto set = Handle(StepShape_GeometricCurveSet)::DownCast(model.Value(i));
        if (set.IsNull())
            continue;
        for (int k = 1; k <= set->NbElements(); ++k, ++next) {
            const Handle(StepGeom_Curve) curve = set->ElementsValue(k).Curve();
            if (curve.IsNull() || next >= lines.size())
                continue;
            curve->SetName(new TCollection_HAsciiString(lines[next].name.c_str()));
            if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve); !trimmed.IsNull())
                trimmed->BasisCurve()->SetName(curve->Name());
        }
    }
    if (next != lines.size())
        throw ExchangeError(
            fmt::format("OpenCASCADE put {} of {} lines into the STEP file; they may be shorter than its "
                        "resolution of {} mm",
                        next, lines.size(), step_resolution));
}

} // namespace

void require_lines(std::span<const SheetLine> lines)
{
    if (lines.empty())
        throw InputError("there is no line to write");
    for (const SheetLine& line : lines) {
        if (line.point.cols() < 2 || !line.point.allFinite())
            throw InputError(fmt::format("the line \"{}\" needs two finite points or more", line.name));
        const std::vector<double> at = arc(run(line));
        for (size_t k = 1; k < at.size(); ++k)
            if (!(at[k] > at[k - 1]))
                throw InputError(fmt::format("the line \"{}\" has two running points at one place: {} mm", line.name,
                                             place_text(line.point.col(Eigen::Index(k - 1)))));
    }
}

void write_lines_iges(const std::filesystem::path& path, std::span<const SheetLine> lines, const std::string& part_name,
                      LengthUnit unit)
{
    require_lines(lines);
    write_cad_file(path, [&] {
        const auto entities = [&] {
            std::vector<Handle(IGESData_IGESEntity)> list;
            for (const SheetLine& line : lines)
                list.push_back(entity_126(line, unit));
            return list;
        };
        return iges_text(entities, greatest_coordinate(lines), path.filename().string(), part_name, unit);
    });
}

void write_lines_step(const std::filesystem::path& path, std::span<const SheetLine> lines, const std::string& part_name,
                      LengthUnit unit)
{
    require_lines(lines);
    write_cad_file(path, [&] {
        return step_text([&] { return compound(lines); }, STEPControl_GeometricCurveSet,
                         [&](const StepData_StepModel& model) { name_curves(model, lines); }, path.filename().string(),
                         part_name, unit);
    });
}

} // namespace spia

#include "engine/exchange/cad/iges_trims.h"

#include <IGESData_HArray1OfIGESEntity.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGeom_CompositeCurve.hxx>
#include <IGESGeom_CurveOnSurface.hxx>
#include <IGESGeom_HArray1OfCurveOnSurface.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfXYZ.hxx>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit_curve.h"
#include "engine/nurbs/trim.h"

namespace spia {
namespace {

// Of a directory entry: subordinate status, use and hierarchy. [IGES 5.3, 2.2.4.4.9]
constexpr int visible = 0, physically_dependent = 1, geometry = 0, parametric = 5, own_level = 0;

Handle(IGESGeom_BSplineCurve)
    entity_126(int degree, const std::vector<double>& knots, const Eigen::Matrix3Xd& control, int use)
{
    const int last = int(control.cols()) - 1;
    Handle(TColStd_HArray1OfReal) values = new TColStd_HArray1OfReal(-degree, int(knots.size()) - 1 - degree),
                                  weights = new TColStd_HArray1OfReal(0, last);
    Handle(TColgp_HArray1OfXYZ) poles = new TColgp_HArray1OfXYZ(0, last);
    for (int i = 0; i < int(knots.size()); ++i)
        values->SetValue(i - degree, knots[size_t(i)]);
    for (int i = 0; i <= last; ++i) {
        weights->SetValue(i, 1);
        poles->SetValue(i, gp_XYZ(control(0, i), control(1, i), control(2, i)));
    }
    Handle(IGESGeom_BSplineCurve) entity = new IGESGeom_BSplineCurve;
    const bool planar = use == parametric;
    entity->Init(last, degree, planar, false, true, false, values, weights, poles, 0, 1, gp_XYZ(0, 0, planar ? 1 : 0));
    entity->InitStatus(visible, physically_dependent, use, own_level);
    return entity;
}

/// One curve, or several as one.
Handle(IGESData_IGESEntity) joined(const std::vector<Handle(IGESGeom_BSplineCurve)>& curves, int use)
{
    if (curves.size() == 1)
        return Handle(IGESData_IGESEntity)(curves[0].get());
    Handle(IGESData_HArray1OfIGESEntity) list = new IGESData_HArray1OfIGESEntity(1, int(curves.size()));
    for (int i = 0; i < int(curves.size()); ++i)
        list->SetValue(i + 1, curves[size_t(i)]);
    Handle(IGESGeom_CompositeCurve) whole = new IGESGeom_CompositeCurve;
    whole->Init(list);
    whole->InitStatus(visible, physically_dependent, use, own_level);
    return whole;
}

/// What the curve in (u, v) is in space, as close as numbers of a file need.
CurveFitResult in_space(const NurbsSurface& surface, const PlaneCurve& curve)
{
    CurveFitOptions options;
    options.tolerance = 1e-4; // mm
    const CurveFitResult fitted = fit_curve(
        [&](const std::vector<double>& parameters) {
            Eigen::Matrix3Xd points(3, Eigen::Index(parameters.size()));
            for (size_t i = 0; i < parameters.size(); ++i) {
                const Eigen::Vector2d uv = evaluate(curve, parameters[i]);
                points.col(Eigen::Index(i)) = evaluate(surface, uv.x(), uv.y()).position;
            }
            return points;
        },
        options);
    const double as_the_border = TrimOptions{}.tolerance; // of the vertices of the hole, on a
                                                          // surface with a kink there
    if (!fitted.reached && !(fitted.largest <= as_the_border)) {
        const Eigen::Vector2d uv = evaluate(curve, 0);
        const Eigen::Vector3d place = evaluate(surface, uv.x(), uv.y()).position;
        throw ExchangeError(fmt::format(
            "no IGES file is written: the border of the hole at {} mm comes no nearer than "
            "{:.2g} mm to a smooth curve, for the surface folds there; fit it within a tolerance, or choose "
            "other formats",
            place_text(place), fitted.largest));
    }
    return fitted;
}

/// Pieces of a polyline by themselves: in space each is smooth.
std::vector<PlaneCurve> smooth_pieces(const TrimLoop& loop)
{
    std::vector<PlaneCurve> pieces;
    for (const PlaneCurve& curve : loop)
        if (curve.degree > 1)
            pieces.push_back(curve);
        else
            for (Eigen::Index i = 0; i + 1 < curve.control.cols(); ++i)
                pieces.push_back({1, {0, 0, 1, 1}, curve.control.middleCols(i, 2)});
    return pieces;
}

Handle(IGESGeom_CurveOnSurface) entity_142(const NurbsSurface& surface, const Handle(IGESGeom_BSplineSurface) & entity,
                                           const TrimLoop& loop, LengthUnit unit)
{
    std::vector<Handle(IGESGeom_BSplineCurve)> plane, space;
    for (const PlaneCurve& curve : smooth_pieces(loop)) {
        Eigen::Matrix3Xd control = Eigen::Matrix3Xd::Zero(3, curve.control.cols());
        control.topRows<2>() = curve.control;
        plane.push_back(entity_126(curve.degree, curve.knots, control, parametric));
        const CurveFitResult fitted = in_space(surface, curve);
        constexpr int cubic = 3;
        space.push_back(entity_126(cubic, fitted.knots, fitted.control / millimetres(unit), geometry));
    }
    Handle(IGESGeom_CurveOnSurface) border = new IGESGeom_CurveOnSurface;
    constexpr int unspecified = 0, parametric_is_preferred = 1;
    border->Init(unspecified, entity, joined(plane, parametric), joined(space, geometry), parametric_is_preferred);
    border->InitStatus(visible, physically_dependent, geometry, own_level);
    return border;
}

} // namespace

Handle(IGESGeom_TrimmedSurface) entity_144(const NurbsSurface& surface, const Handle(IGESGeom_BSplineSurface) & entity,
                                           std::span<const TrimLoop> holes, LengthUnit unit)
{
    entity->InitStatus(visible, physically_dependent, geometry, own_level);
    Handle(IGESGeom_HArray1OfCurveOnSurface) inner = new IGESGeom_HArray1OfCurveOnSurface(1, int(holes.size()));
    for (int i = 0; i < int(holes.size()); ++i)
        inner->SetValue(i + 1, entity_142(surface, entity, holes[size_t(i)], unit));
    Handle(IGESGeom_TrimmedSurface) trimmed = new IGESGeom_TrimmedSurface;
    constexpr int natural_border = 0;
    trimmed->Init(entity, natural_border, nullptr, inner);
    return trimmed;
}

} // namespace spia

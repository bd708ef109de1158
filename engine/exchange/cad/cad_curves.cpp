#include "engine/exchange/cad/cad_curves.h"

#include <BRepAdaptor_Curve.hxx>
#include <Eigen/Geometry>
#include <Standard_Failure.hxx>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Lin.hxx>

#include "engine/exchange/cad/occt_values.h"

namespace spia {
namespace {

constexpr int samples = 9;
/// Of its extent, that a spline may be off the line or circle it is: what arcs have that were
/// written as rational splines, with some room for the decimals of a file. Others keep what their
/// vertices say.
constexpr double same = 1e-8;

StatedCurve line_through(const Eigen::Matrix3Xd& points)
{
    const Eigen::Vector3d way = points.rightCols<1>() - points.col(0);
    const double length = way.norm();
    const Eigen::Vector3d unit = way / length;
    for (const auto point : points.colwise())
        if (!((point - points.col(0)).cross(unit).norm() <= same * length))
            return {};
    return {StatedCurve::Kind::line, points.col(0), unit, 0};
}

/// Through three of the points, a third of the curve from one to the next.
StatedCurve circle_through(const Eigen::Matrix3Xd& points)
{
    const Eigen::Vector3d a = points.col(0), u = points.col(samples / 3) - a, v = points.col(2 * (samples / 3)) - a,
                          w = u.cross(v);
    const Eigen::Vector3d arm = (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u)) / (2 * w.squaredNorm());
    const StatedCurve circle{StatedCurve::Kind::circle, a + arm, w.normalized(), arm.norm()};
    const double extent = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
    for (const auto point : points.colwise()) {
        const Eigen::Vector3d out = point - circle.point;
        if (!(std::abs(out.norm() - circle.radius) <= same * extent) ||
            !(std::abs(out.dot(circle.direction)) <= same * extent))
            return {};
    }
    return circle;
}

StatedCurve recognised(const BRepAdaptor_Curve& curve)
{
    const double from = curve.FirstParameter(), to = curve.LastParameter();
    Eigen::Matrix3Xd points(3, samples);
    for (int k = 0; k < samples; ++k)
        points.col(k) = vector(curve.Value(from + (to - from) * k / (samples - 1)).XYZ());
    if (!points.allFinite())
        return {};
    const StatedCurve line = line_through(points);
    return line.kind == StatedCurve::Kind::line ? line : circle_through(points);
}

StatedCurve stated(const BRepAdaptor_Curve& curve)
{
    switch (curve.GetType()) {
    case GeomAbs_Line:
        return {StatedCurve::Kind::line, vector(curve.Line().Location().XYZ()), vector(curve.Line().Direction().XYZ()),
                0};
    case GeomAbs_Circle:
        return {StatedCurve::Kind::circle, vector(curve.Circle().Location().XYZ()),
                vector(curve.Circle().Axis().Direction().XYZ()), curve.Circle().Radius()};
    case GeomAbs_BezierCurve:
    case GeomAbs_BSplineCurve: return recognised(curve);
    default: return {};
    }
}

} // namespace

StatedCurve stated_curve(const TopoDS_Edge& edge)
{
    try {
        const StatedCurve curve = stated(BRepAdaptor_Curve(edge));
        const bool sound = curve.point.allFinite() && curve.direction.allFinite() && std::isfinite(curve.radius) &&
                           (curve.kind != StatedCurve::Kind::circle || curve.radius > 0);
        return sound ? curve : StatedCurve{};
    } catch (const Standard_Failure&) { // of a damaged edge: the reader says so elsewhere
        return {};
    }
}

} // namespace spia

#include "engine/exchange/cad/occt_surface.h"

#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <fmt/core.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace spia {
namespace {

void require_knots(const std::vector<double>& knots, int degree, int count, char direction)
{
    const auto refuse = [&](const std::string& what) {
        throw InputError(
            fmt::format("the surface cannot be written: along {} {}; interpolate or fit it again", direction, what));
    };
    if (degree < 1 || degree > Geom_BSplineSurface::MaxDegree())
        refuse(fmt::format("its degree is {}, outside 1 to {}", degree, Geom_BSplineSurface::MaxDegree()));
    if (count < degree + 1 || knots.size() != size_t(count + degree + 1))
        refuse(fmt::format("{} control points of degree {} do not go with {} knots", count, degree, knots.size()));
    for (size_t i = 0; i < knots.size(); ++i)
        if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1]))
            refuse(fmt::format("knot {} is smaller than the one before it or not a number", i));
    if (knots.front() != knots[size_t(degree)] || knots.back() != knots[size_t(count)])
        refuse("the knots are not clamped");
    for (int i = 1; i < count; ++i)
        if (knots[size_t(i)] == knots[size_t(i + degree)])
            refuse(fmt::format("knot {} is repeated more than {} times", i, degree));
}

struct DistinctKnots {
    TColStd_Array1OfReal value;
    TColStd_Array1OfInteger multiplicity;
};

DistinctKnots distinct(const std::vector<double>& knots)
{
    std::vector<double> value;
    std::vector<int> multiplicity;
    for (const double knot : knots)
        if (!value.empty() && value.back() == knot)
            ++multiplicity.back();
        else
            value.push_back(knot), multiplicity.push_back(1);
    DistinctKnots result{{1, int(value.size())}, {1, int(value.size())}};
    for (int i = 0; i < int(value.size()); ++i) {
        result.value(i + 1) = value[size_t(i)];
        result.multiplicity(i + 1) = multiplicity[size_t(i)];
    }
    return result;
}

std::vector<double> knots_from_0_to_1(const TColStd_Array1OfReal& repeated)
{
    std::vector<double> knots(repeated.begin(), repeated.end());
    const double first = knots.front(), length = knots.back() - first;
    if (first != 0 || length != 1)
        for (double& knot : knots)
            knot = (knot - first) / length;
    return knots;
}

} // namespace

void require_exchangeable(const NurbsSurface& surface)
{
    require_knots(surface.knots_u, surface.degree_u, surface.count_u, 'u');
    require_knots(surface.knots_v, surface.degree_v, surface.count_v, 'v');
    const Eigen::Index count = Eigen::Index(surface.count_u) * surface.count_v;
    if (surface.control.cols() != count || surface.weight.size() != count)
        throw InputError(
            fmt::format("the surface cannot be written: {} control points and {} weights for a net of {} x {}; "
                        "interpolate or fit it again",
                        surface.control.cols(), surface.weight.size(), surface.count_u, surface.count_v));
    for (int j = 0; j < surface.count_v; ++j)
        for (int i = 0; i < surface.count_u; ++i) {
            const int k = surface.index(i, j);
            if (!surface.control.col(k).allFinite() || !std::isfinite(surface.weight[k]) || !(surface.weight[k] > 0))
                throw InputError(
                    fmt::format("the surface cannot be written: control point ({}, {}) is not a finite point "
                                "of positive weight; interpolate or fit it again",
                                i, j));
        }
}

Handle(Geom_BSplineSurface) to_occt(const NurbsSurface& surface)
{
    const DistinctKnots u = distinct(surface.knots_u), v = distinct(surface.knots_v);
    TColgp_Array2OfPnt poles(1, surface.count_u, 1, surface.count_v);
    TColStd_Array2OfReal weights(1, surface.count_u, 1, surface.count_v);
    for (int j = 0; j < surface.count_v; ++j)
        for (int i = 0; i < surface.count_u; ++i) {
            const auto point = surface.control.col(surface.index(i, j));
            poles(i + 1, j + 1) = gp_Pnt(point.x(), point.y(), point.z());
            weights(i + 1, j + 1) = surface.weight[surface.index(i, j)];
        }
    return new Geom_BSplineSurface(poles, weights, u.value, v.value, u.multiplicity, v.multiplicity, surface.degree_u,
                                   surface.degree_v);
}

NurbsSurface from_occt(const Geom_BSplineSurface& original)
{
    const auto opened = Handle(Geom_BSplineSurface)::DownCast(original.Copy());
    if (opened->IsUPeriodic() || opened->IsVPeriodic()) {
        double u1, u2, v1, v2;
        opened->Bounds(u1, u2, v1, v2);
        opened->Segment(u1, u2, v1, v2);
    }
    NurbsSurface result;
    result.degree_u = opened->UDegree();
    result.degree_v = opened->VDegree();
    result.count_u = opened->NbUPoles();
    result.count_v = opened->NbVPoles();
    if (opened->UMultiplicity(1) != result.degree_u + 1 || opened->VMultiplicity(1) != result.degree_v + 1 ||
        opened->UMultiplicity(opened->NbUKnots()) != result.degree_u + 1 ||
        opened->VMultiplicity(opened->NbVKnots()) != result.degree_v + 1)
        throw InputError("a B-spline surface of the file is not clamped; export it with clamped (open) knot vectors");
    result.knots_u = knots_from_0_to_1(opened->UKnotSequence());
    result.knots_v = knots_from_0_to_1(opened->VKnotSequence());
    result.control.resize(3, result.count_u * result.count_v);
    result.weight.resize(result.count_u * result.count_v);
    for (int j = 0; j < result.count_v; ++j)
        for (int i = 0; i < result.count_u; ++i) {
            const gp_Pnt pole = opened->Pole(i + 1, j + 1);
            result.control.col(result.index(i, j)) << pole.X(), pole.Y(), pole.Z();
            result.weight[result.index(i, j)] = opened->Weight(i + 1, j + 1);
        }
    return result;
}

void write_cad_file(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces,
                    const std::function<std::string()>& text)
{
    if (surfaces.empty())
        throw InputError(fmt::format("there is no surface to write to {}", path.string()));
    for (const NurbsSurface& surface : surfaces)
        require_exchangeable(surface);
    write_cad_file(path, text);
}

void write_cad_file(const std::filesystem::path& path, const std::function<std::string()>& text)
{
    std::string content;
    try {
        content = text();
    } catch (const Standard_Failure& failure) {
        throw ExchangeError(
            fmt::format("cannot write {}: OpenCASCADE says \"{}\"", path.string(), failure.GetMessageString()));
    }
    write_atomically(path, content);
}

} // namespace spia

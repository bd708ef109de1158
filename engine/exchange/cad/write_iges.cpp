#include "engine/exchange/cad/write_iges.h"

#include <IGESGeom_BSplineSurface.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <TColgp_HArray2OfXYZ.hxx>

#include "engine/exchange/cad/iges_trims.h"
#include "engine/exchange/cad/occt_iges.h"
#include "engine/exchange/cad/occt_surface.h"

namespace spia {
namespace {

/// IGES counts the knots of degree p from -p.
Handle(TColStd_HArray1OfReal) knots_from_minus_degree(const std::vector<double>& knots, int degree)
{
    Handle(TColStd_HArray1OfReal) result = new TColStd_HArray1OfReal(-degree, int(knots.size()) - 1 - degree);
    for (int i = 0; i < int(knots.size()); ++i)
        result->SetValue(i - degree, knots[size_t(i)]);
    return result;
}

/// Filled field by field, not through a kernel surface: that way nothing between us and the file
/// can touch a number.
Handle(IGESGeom_BSplineSurface) entity_128(const NurbsSurface& surface, LengthUnit unit)
{
    const int last_u = surface.count_u - 1, last_v = surface.count_v - 1;
    Handle(TColStd_HArray2OfReal) weights = new TColStd_HArray2OfReal(0, last_u, 0, last_v);
    Handle(TColgp_HArray2OfXYZ) poles = new TColgp_HArray2OfXYZ(0, last_u, 0, last_v);
    for (int j = 0; j <= last_v; ++j)
        for (int i = 0; i <= last_u; ++i) {
            const Eigen::Vector3d point = surface.control.col(surface.index(i, j)) / millimetres(unit);
            poles->SetValue(i, j, gp_XYZ(point.x(), point.y(), point.z()));
            weights->SetValue(i, j, surface.weight[surface.index(i, j)]);
        }
    bool closed_u = true, closed_v = true;
    for (int j = 0; j <= last_v; ++j)
        closed_u &= surface.control.col(surface.index(0, j)) == surface.control.col(surface.index(last_u, j));
    for (int i = 0; i <= last_u; ++i)
        closed_v &= surface.control.col(surface.index(i, 0)) == surface.control.col(surface.index(i, last_v));
    const bool polynomial = (surface.weight.array() == surface.weight[0]).all();

    Handle(IGESGeom_BSplineSurface) entity = new IGESGeom_BSplineSurface;
    entity->Init(last_u, last_v, surface.degree_u, surface.degree_v, closed_u, closed_v, polynomial, false, false,
                 knots_from_minus_degree(surface.knots_u, surface.degree_u),
                 knots_from_minus_degree(surface.knots_v, surface.degree_v), weights, poles, surface.knots_u.front(),
                 surface.knots_u.back(), surface.knots_v.front(), surface.knots_v.back());
    return entity;
}

double greatest_coordinate(std::span<const NurbsSurface> surfaces)
{
    double result = 0;
    for (const NurbsSurface& surface : surfaces)
        result = std::max(result, surface.control.cwiseAbs().maxCoeff());
    return result;
}

} // namespace

void write_iges(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces, const std::string& part_name,
                LengthUnit unit, std::span<const std::vector<TrimLoop>> holes)
{
    write_cad_file(path, surfaces, [&] {
        const auto entities = [&] {
            std::vector<Handle(IGESData_IGESEntity)> list;
            for (size_t i = 0; i < surfaces.size(); ++i) {
                const Handle(IGESGeom_BSplineSurface) plain = entity_128(surfaces[i], unit);
                if (i < holes.size() && !holes[i].empty())
                    list.push_back(entity_144(surfaces[i], plain, holes[i], unit));
                else
                    list.push_back(plain);
            }
            return list;
        };
        return iges_text(entities, greatest_coordinate(surfaces), path.filename().string(), part_name, unit);
    });
}

} // namespace spia

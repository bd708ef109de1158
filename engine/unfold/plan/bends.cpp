#include "engine/unfold/plan/bends.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/unfold/plan/bend_bands.h"
#include "engine/unfold/plan/label_measures.h"
#include "engine/unfold/plan/region_borders.h"
#include "engine/unfold/plan/sheet_pieces.h"
#include "engine/unfold/plan/turns.h"

namespace spia {
namespace {

void require_sheet(const TriMesh& part, const SheetTurns& turns)
{
    if (part.triangles() == 0)
        throw InputError("the part has no faces; there is nothing to split at bends");
    for (int f = 0; f < part.triangles(); ++f)
        if (!(turns.area[f] > 0) || !std::isfinite(turns.area[f]))
            throw InputError(fmt::format("face {} has no area; weld or remove it before looking for bends", f));
    if (turns.rim.size() + 2 * turns.edge.size() != 3 * size_t(part.triangles()))
        throw InputError("an edge belongs to more than two faces; examine the part and separate it there");
}

std::vector<SheetRegion> measured_regions(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region,
                                          size_t count)
{
    const std::vector<double> area = areas_of(turns, region, count);
    const std::vector<Eigen::Vector3d> place = places(part, turns, region, count);
    std::vector<SheetRegion> result;
    for (size_t r = 0; r < count; ++r)
        result.push_back({0, area[r], 0, Eigen::Vector3d::Zero(), place[r]});
    for (int f = 0; f < part.triangles(); ++f)
        if (const int r = region[size_t(f)]; r >= 0) {
            ++result[size_t(r)].faces;
            result[size_t(r)].normal += turns.area[f] / area[size_t(r)] * turns.normal.col(f);
        }
    for (SheetRegion& r : result) {
        r.flatness = r.normal.norm();
        r.normal.normalize();
    }
    return result;
}

} // namespace

BendMap find_bends(const TriMesh& part, const BendLimits& limits)
{
    if (!(limits.curvature > 0) || !(limits.sharp > 0) || !(limits.least_area >= 0 && limits.least_area < 1))
        throw InputError("the limits of bends must be positive, the least area a share below 1");
    const SheetTurns turns = sheet_turns(part);
    require_sheet(part, turns);
    const double side = std::sqrt(turns.area.sum());
    const SheetPieces pieces = sheet_pieces(turns, side, limits);

    std::vector<int> region(size_t(part.triangles()), -1), number(pieces.is_region.size(), -1);
    int regions = 0;
    for (size_t p = 0; p < number.size(); ++p)
        if (pieces.is_region[p])
            number[p] = regions++;
    for (size_t f = 0; f < region.size(); ++f)
        region[f] = number[size_t(pieces.piece[f])];
    give_borders(part, turns, limits.off_plane * side, regions, region);
    const std::vector<int> rank = by_area(areas_of(turns, region, size_t(regions)));
    for (int& r : region)
        r = r < 0 ? -1 : rank[size_t(r)];

    BendMap result;
    result.side = side;
    result.smoothed = turns.smoothed;
    const double least = limits.least_area * side * side * (turns.smoothed ? 5 : 1);
    Bands bands = find_bands(part, turns, region, least);
    if (give_dents(bands, region))
        bands = find_bands(part, turns, region, least);
    result.regions = measured_regions(part, turns, region, size_t(regions));
    result.bends = bands.bends;
    for (const Bend& sharp : sharp_bends(part, turns, region))
        result.bends.push_back(sharp);
    result.label.resize(part.triangles());
    for (int f = 0; f < part.triangles(); ++f)
        result.label[f] = region[size_t(f)] >= 0 ? region[size_t(f)] : regions + bands.of[size_t(f)];
    return result;
}

FaceSet BendMap::faces_of(int wanted) const
{
    FaceSet faces;
    for (int f = 0; f < int(label.size()); ++f)
        if (label[f] == wanted)
            faces.push_back(f);
    return faces;
}

double BendMap::area_of(int wanted) const
{
    const auto k = size_t(wanted);
    return k < regions.size() ? regions[k].area : bends[k - regions.size()].area;
}

std::string BendMap::name(int wanted) const
{
    return wanted < int(regions.size()) ? fmt::format("region {}", wanted + 1)
                                        : fmt::format("bend {}", wanted - int(regions.size()) + 1);
}

} // namespace spia

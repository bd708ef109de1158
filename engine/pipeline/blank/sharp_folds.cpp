#include "engine/pipeline/blank/sharp_folds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/parts_of_table.h"
#include "engine/unfold/plan/free_ends.h"
#include "engine/unfold/plan/neutral_fibre.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {
namespace {

/// Sharp folds of the map that belong in the table.
std::vector<size_t> folds_of(const PartFile& part, const BendMap& map, const Blank& blank, const BendTable& table)
{
    constexpr double least = 0.5 * std::numbers::pi / 180; // triangles that the rim of a hole tilts
                                                           // turn by less
    const std::vector<char> known = parts_of_table(part.mesh, map, table);
    const FreeEnds ends(part.mesh);
    std::vector<size_t> result;
    for (size_t k = 0; k < map.bends.size(); ++k)
        if (const Bend& bend = map.bends[k];
            bend.faces == 0 && !known[k] && std::abs(bend.angle) >= least && ends.of(map, k, blank.position))
            result.push_back(k);
    return result;
}

/// Of the thickness: how much longer the outer leg of a sharp fold is than the inner one. Flats
/// that lie on each other have no mitre; their legs end where the sheet does.
double mitre(double angle)
{
    constexpr double on_each_other = 175 * std::numbers::pi / 180;
    return angle < on_each_other ? std::tan(angle / 2) : 1;
}

/// Its faces, its direction and its middle on the part.
void place_fold(const TriMesh& part, const BendMap& map, const Bend& fold, SheetBend& bend)
{
    std::set<int> faces;
    Eigen::Vector3d low, high;
    for (const auto& [one, other] : edges_of(part, map, fold)) {
        if (faces.empty()) {
            low = high = part.position.col(one.low);
            bend.axis = (part.position.col(one.high) - low).normalized();
        }
        for (const int v : {one.low, one.high}) {
            const Eigen::Vector3d place = part.position.col(v);
            low = bend.axis.dot(place) < bend.axis.dot(low) ? place : low;
            high = bend.axis.dot(place) > bend.axis.dot(high) ? place : high;
        }
        faces.insert({one.face, other.face});
    }
    bend.axis = (high - low).normalized();
    bend.place = (low + high) / 2;
    bend.faces.assign(faces.begin(), faces.end());
}

} // namespace

double laid_fibre(const PartFile& part, bool bulges)
{
    if (!part.solid || part.solid->skin == Skin::middle)
        return 0.5;
    return (part.solid->skin == Skin::outer) == bulges ? 1 : 0;
}

void add_sharp_folds(const PartFile& part, const Blank& blank, BendTable& table)
{
    const BendMap map = bends_for_shop(part);
    const std::vector<size_t> folds = folds_of(part, map, blank, table);
    if (folds.empty())
        return;
    const std::vector<SheetLine> lines = bend_lines(part.mesh, map, blank.position);
    for (const size_t k : folds) {
        SheetBend bend;
        bend.sharp = bend.laid = true;
        bend.stated = part.cad.has_value();
        bend.angle = std::abs(map.bends[k].angle);
        bend.up = map.bends[k].angle < 0; // the outer side, from which the blank is seen, bulges
                                          // where legs go down
        bend.k = laid_fibre(part, !bend.up);
        bend.allowance = 2 * bend.k * table.thickness * mitre(bend.angle);
        bend.deduction = bend_deduction(0, bend.angle, bend.allowance, table.thickness);
        place_fold(part.mesh, map, map.bends[k], bend);
        const std::string name = map.name(int(map.regions.size() + k));
        for (const SheetLine& line : lines)
            if (line.name == name && line.point.cols() > 1) {
                bend.line.push_back({line.point.col(0).head<2>(), line.point.rightCols<1>().col(0).head<2>()});
                bend.length += (bend.line.back().to - bend.line.back().from).norm();
            }
        table.bends.push_back(std::move(bend));
    }
}

} // namespace spia

#include "engine/mesh/solid/marks/thin_floors.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

using Weighted = std::vector<std::pair<double, double>>;

/// How far away a skin lies straight behind a piece, by area.
struct Behind {
    Weighted distance;
    double area = 0;
    std::array<double, 2> of_skin{}; ///< mm2
};

std::vector<Behind> behind(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                           const std::vector<PieceSide>& side, double thickness, const std::vector<char>& known)
{
    constexpr double parallel = 0.94, thinner = 0.9; // 20 degrees, of chords over a bend; of the
                                                     // thickness
    std::vector<Behind> result(size_t(pieces.count()));
    for (const Opposite& at : places) {
        const auto p = size_t(pieces.piece[size_t(at.face)]);
        if (side[p] != PieceSide::rim || known[p] || at.hit < 0 || at.facing < parallel ||
            at.distance > thinner * thickness)
            continue;
        if (const PieceSide of = side[size_t(pieces.piece[size_t(at.hit)])]; of != PieceSide::rim) {
            result[p].distance.emplace_back(at.distance, at.area);
            result[p].area += at.area;
            result[p].of_skin[of == PieceSide::one ? 0 : 1] += at.area;
        }
    }
    return result;
}

} // namespace

std::optional<ThinFloor> thin_floor(const SurfacePieces& pieces, const std::vector<Opposite>& places,
                                    const std::vector<PieceSide>& side, double thickness,
                                    const std::vector<char>& known)
{
    constexpr double most = 0.8;  // of its area
    constexpr double even = 0.15; // of the thickness: bevels run out from nothing to all of it
    const std::vector<Behind> seen = behind(pieces, places, side, thickness, known);
    std::vector<char> floor(seen.size(), 0);
    for (size_t p = 0; p < seen.size(); ++p)
        floor[p] = seen[p].area > most * pieces.area[p] &&
                   quantile(seen[p].distance, 0.9) - quantile(seen[p].distance, 0.1) < even * thickness;
    DisjointSets together(seen.size());
    for (const PieceContact& c : pieces.contact)
        if (floor[size_t(c.a)] && floor[size_t(c.b)])
            together.join(c.a, c.b);
    std::map<int, double> size;
    for (int p = 0; p < pieces.count(); ++p)
        if (floor[size_t(p)])
            size[together.root(p)] += pieces.area[size_t(p)];
    const auto largest = std::ranges::max_element(size, {}, [](const auto& each) { return each.second; });
    if (largest == size.end())
        return std::nullopt;
    ThinFloor found{std::vector<char>(seen.size(), 0), largest->second};
    Weighted distance;
    std::array<double, 2> of_skin{};
    for (size_t p = 0; p < seen.size(); ++p)
        if (floor[p] && together.root(int(p)) == largest->first) {
            found.piece[p] = 1;
            distance.insert(distance.end(), seen[p].distance.begin(), seen[p].distance.end());
            for (const size_t s : {size_t(0), size_t(1)})
                of_skin[s] += seen[p].of_skin[s];
        }
    found.thickness = quantile(distance, 0.5);
    found.skin = of_skin[0] > of_skin[1] ? PieceSide::other : PieceSide::one;
    return found;
}

} // namespace spia

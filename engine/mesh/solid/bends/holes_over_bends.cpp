#include "engine/mesh/solid/bends/holes_over_bends.h"

#include <numeric>

#include "engine/mesh/solid/bends/bend_ends.h"
#include "engine/mesh/solid/bends/bend_holes.h"
#include "engine/mesh/solid/bends/fine_rims.h"
#include "engine/mesh/solid/bends/unrolled_bend.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

/// One of each cylinder that the middle surface has.
std::vector<StatedSurface> cylinders_of(const SkinMesh& middle, const std::vector<StatedSurface>& surface)
{
    std::vector<StatedSurface> cylinders;
    for (const int f : middle.source_face)
        if (const StatedSurface& s = surface[size_t(f)];
            s.kind == Kind::cylinder &&
            std::ranges::none_of(cylinders, [&](const StatedSurface& c) { return same_cylinder(c, s); }))
            cylinders.push_back(s);
    return cylinders;
}

bool sound(const PlaneTriangles& triangles)
{
    constexpr double least = 3e-6; // the doctor calls 1e-6 no area
    return std::ranges::all_of(triangles.triangle, [&](const auto& t) { return quality(triangles, t.corner) > least; });
}

/// The bend's triangles with the rims of the holes where their walls meet the middle of the sheet;
/// nothing if they cannot be made sound.
std::optional<PlaneTriangles> with_holes(const MiddleOfSolid& part, const UnrolledBend& bend,
                                         const std::vector<BendHole>& holes)
{
    std::vector<Eigen::Vector2d> to = bend.now;
    for (const BendHole& hole : holes)
        for (size_t i = 0; i < hole.rim.size(); ++i)
            to[size_t(hole.rim[i])] = hole.to[i];
    const auto coarse = moved(bend.triangles, to);
    if (!coarse)
        return std::nullopt;
    // Needles of a rim with many vertices may be cut into triangles without area: those keep the
    // rim as it is.
    for (const PlaneTriangles& triangles : {with_fine_rims(part, bend, holes, *coarse), *coarse})
        if (auto cut = cut_at_bend_ends(part, bend, triangles); cut && sound(*cut))
            return cut;
    return std::nullopt;
}

/// mm, per vertex of the middle surface and of those added in the plane: rims where they are in the
/// plane now.
Eigen::Matrix3Xd places_of(const SkinMesh& middle, const UnrolledBend& bend, const std::vector<BendHole>& holes,
                           const PlaneTriangles& triangles)
{
    const Eigen::Index own = middle.mesh.vertices(), all = Eigen::Index(triangles.at.size());
    Eigen::Matrix3Xd position(3, all);
    position.leftCols(own) = middle.mesh.position;
    for (const BendHole& hole : holes)
        for (const int v : hole.rim)
            position.col(v) = bend.skin.in_space(triangles.at[size_t(v)]);
    for (Eigen::Index v = own; v < all; ++v)
        position.col(v) = bend.skin.in_space(triangles.at[size_t(v)]);
    return position;
}

/// Puts a bend's triangles and vertices in the place of those it had, in the order of the solid's.
void put_in(SkinMesh& middle, const UnrolledBend& bend, const std::vector<BendHole>& holes,
            const PlaneTriangles& triangles)
{
    const Eigen::Matrix3Xd position = places_of(middle, bend, holes, triangles);
    const std::vector<int>& source = triangles.source_vertex;
    std::vector<int> order(source.size()), place(source.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int v) { return source[size_t(v)]; });
    for (size_t i = 0; i < order.size(); ++i)
        place[size_t(order[i])] = int(i);
    std::vector<PlaneTriangle> all = triangles.triangle;
    for (int f = 0; f < middle.mesh.triangles(); ++f)
        if (const auto t = middle.mesh.triangle.col(f); !bend.on[size_t(f)])
            all.push_back({{t[0], t[1], t[2]}, middle.source_face[size_t(f)]});
    std::ranges::stable_sort(all, {}, &PlaneTriangle::source);
    middle.mesh.position = position(Eigen::all, order);
    middle.source_vertex.clear();
    for (const int v : order)
        middle.source_vertex.push_back(source[size_t(v)]);
    middle.mesh.triangle.resize(3, Eigen::Index(all.size()));
    middle.source_face.clear();
    for (size_t f = 0; f < all.size(); ++f) {
        for (size_t k = 0; k < 3; ++k)
            middle.mesh.triangle(Eigen::Index(k), Eigen::Index(f)) = place[size_t(all[f].corner[k])];
        middle.source_face.push_back(all[f].source);
    }
}

} // namespace

std::vector<int> holes_over_bends(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                                  const std::vector<StatedSurface>& surface)
{
    const MiddleOfSolid part(middle, solid, sheet, surface);
    std::vector<int> walls;
    for (const StatedSurface& cylinder : cylinders_of(middle, surface)) {
        const auto bend = unrolled_bend(part, cylinder);
        if (!bend)
            continue;
        const std::vector<BendHole> holes = bend_holes(part, *bend);
        const auto triangles = holes.empty() ? std::nullopt : with_holes(part, *bend, holes);
        if (!triangles)
            continue;
        put_in(middle, *bend, holes, *triangles);
        for (const BendHole& hole : holes)
            walls.insert(walls.end(), hole.wall_triangles.begin(), hole.wall_triangles.end());
    }
    std::ranges::sort(walls);
    return walls;
}

} // namespace spia

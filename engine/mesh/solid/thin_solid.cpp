#include "engine/mesh/solid/thin_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <optional>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/solid/holes/open_counterbores.h"
#include "engine/mesh/solid/holes/round_holes.h"
#include "engine/mesh/solid/sides/sheet_conditions.h"
#include "engine/mesh/solid/sides/sheet_thickness.h"
#include "engine/mesh/solid/solid_in_pieces.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double thick =
    0.25; // of the side of a square with the area of one skin: what is open and thicker is no sheet

double signed_volume(const TriMesh& mesh)
{
    const Eigen::Vector3d apex = mesh.position.rowwise().mean();
    double volume = 0; // by the divergence theorem
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto t = mesh.triangle.col(f);
        volume += (mesh.position.col(t[0]) - apex)
                      .dot((mesh.position.col(t[1]) - apex).cross(mesh.position.col(t[2]) - apex)) /
                  6;
    }
    return volume;
}

/// How many outlines there are, whether they are rounded, and whether the skins are plane.
void describe_outline(const SolidInPieces& solid, ThinSolid& result)
{
    const SurfacePieces& pieces = solid.pieces;
    const auto rim = [&](int p) { return solid.sides.side[size_t(p)] == PieceSide::rim; };
    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (rim(c.a) && rim(c.b))
            together.join(c.a, c.b);
    double smooth = 0, whole = 0;
    std::vector<char> touches(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        if (rim(c.a) != rim(c.b)) {
            smooth += c.smooth;
            whole += c.length();
            const auto [outline, skin] = rim(c.a) ? std::pair(c.a, c.b) : std::pair(c.b, c.a);
            touches[size_t(together.root(outline))] |= solid.sides.side[size_t(skin)] == PieceSide::one ? 1 : 2;
        }
    result.outlines = int(std::count(touches.begin(), touches.end(), 3));
    result.rounded = whole > 0 ? smooth / whole : 0;
    constexpr double flat = 1e-4; // of the area: the whole plane but for a degree
    for (const PieceSide side : {PieceSide::one, PieceSide::other}) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double size = 0;
        for (int f = 0; f < solid.mesh.triangles(); ++f)
            if (solid.side(f) == side) {
                sum += solid.normal.col(f);
                size += solid.normal.col(f).norm();
            }
        result.bent |= sum.norm() < (1 - flat) * size;
    }
}

/// mm, of the sheet's bends: half of what both skins turn by across their edges, towards `other`,
/// times the length of these. Times the thickness it is by how much larger `one` is, but for what
/// is cut into either. [Steiner's formula for parallel surfaces]
/// @param marks  their walls are no part of a bend
double turning(const SolidInPieces& solid, const std::vector<SheetMark>& marks, double flipped)
{
    const TriMesh& mesh = solid.mesh;
    const Eigen::Matrix3Xi neighbour = face_neighbours(mesh.triangles(), edge_uses(mesh.triangle));
    std::vector<PieceSide> of;
    for (int f = 0; f < mesh.triangles(); ++f)
        of.push_back(solid.side(f));
    for (const SheetMark& mark : marks)
        for (const int f : mark.wall)
            of[size_t(f)] = PieceSide::rim;
    double sum = 0;
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = neighbour(k, f);
            const PieceSide side = of[size_t(f)];
            if (g < f || side == PieceSide::rim || of[size_t(g)] != side)
                continue;
            const Eigen::Vector3d edge =
                mesh.position.col(mesh.triangle((k + 1) % 3, f)) - mesh.position.col(mesh.triangle(k, f));
            const Eigen::Vector3d a = solid.normal.col(f), b = solid.normal.col(g);
            const double length = edge.norm(), sine = length > 0 ? a.cross(b).dot(edge) / length : 0;
            sum += (side == PieceSide::one ? flipped : -flipped) * length * std::atan2(sine, a.dot(b));
        }
    return sum / 2;
}

ThinSolid result_of(const SolidInPieces& solid, std::vector<SheetMark> marks, double thickness, double volume,
                    double flipped)
{
    ThinSolid result;
    result.thickness = thickness;
    result.volume = volume;
    result.flipped = flipped;
    double one = 0, other = 0;
    int first = -1;
    for (int f = 0; f < solid.mesh.triangles(); ++f) {
        const double size = solid.normal.col(f).norm();
        const PieceSide side = solid.side(f);
        (side == PieceSide::one ? one : side == PieceSide::other ? other : result.rim) += size;
        if (first < 0 && side != PieceSide::rim)
            first = f;
    }
    // By their bends: holes that are sunk would make the skin they are at the smaller one. Of a
    // sheet that turns as much to either side, by their areas.
    constexpr double rounding = 1e-9, turned = 1e-6;
    const double bends = thickness * turning(solid, marks, flipped), areas = one - other,
                 larger = std::abs(bends) > turned * (one + other) ? bends : areas;
    const PieceSide outer = std::abs(larger) <= rounding * (one + other) ? solid.side(first)
                            : larger > 0                                 ? PieceSide::one
                                                                         : PieceSide::other;
    result.outer = outer == PieceSide::one ? one : other;
    result.inner = outer == PieceSide::one ? other : one;
    for (int f = 0; f < solid.mesh.triangles(); ++f) {
        const PieceSide side = solid.side(f);
        result.side.push_back(side == PieceSide::rim ? SheetSide::rim
                              : side == outer        ? SheetSide::outer
                                                     : SheetSide::inner);
    }
    result.marks = std::move(marks);
    return result;
}

/// Per piece, whether it is of walls of holes or of floors of counterbores, whatever is opposite.
std::vector<char> known_of_holes(const SolidInPieces& solid, double thickness)
{
    std::vector<char> of_hole(size_t(solid.mesh.triangles()), 0), whole(size_t(solid.pieces.count()), 1);
    const auto take = [&](const std::vector<int>& faces) {
        for (const int f : faces)
            of_hole[size_t(f)] = 1;
    };
    for (const RoundHole& hole : round_holes(solid.mesh, solid.normal, thickness))
        take(hole.wall);
    for (const OpenCounterbore& each : open_counterbores(solid.mesh, solid.normal, thickness)) {
        take(each.floor);
        take(each.wall);
    }
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        whole[size_t(solid.piece(f))] &= of_hole[size_t(f)];
    return whole;
}

} // namespace

ThinSolid thin_solid(const TriMesh& mesh, const ThinSolidOptions& options, const Progress& progress)
{
    if (!options.unit.empty() && int(options.unit.size()) != mesh.triangles())
        throw InputError(
            fmt::format("{} triangles have {} CAD faces given; each needs one", mesh.triangles(), options.unit.size()));
    if (mesh.triangles() == 0)
        throw NotASheet("it has no face", -1, Eigen::Vector3d::Zero());
    const double volume = signed_volume(mesh), flipped = volume < 0 ? -1 : 1;
    SolidInPieces solid{mesh, options};
    solid.normal = flipped * area_vectors(mesh);
    solid.closed = boundary_loops(mesh).empty();
    const double area = solid.normal.colwise().norm().sum();
    progress.checkpoint(0, "looking for pieces of surface");
    solid.pieces = surface_pieces(mesh, solid.normal, options.unit);

    const double about = 2 * std::abs(volume) / area; // thickness of a closed sheet, less for its
                                                      // rim
    solid.places =
        opposites(mesh, solid.normal, std::max(3 * about, 1e-3 * bounding_diagonal(mesh)), progress.part(0.1, 0.6));
    double thickness = main_distance(solid.places, std::vector<char>(solid.places.size(), 1));
    require_thin(solid, thickness, area);

    progress.checkpoint(0.6, "taking the sides apart");
    const std::vector<char> of_hole = known_of_holes(solid, thickness);
    solid.sides = sheet_sides(solid.pieces, solid.places, thickness, of_hole);
    require_two_sides(solid, thickness, area);
    std::vector<SheetMark> marks;
    if (solid.closed)
        marks = find_marks(mesh, solid.normal, flipped, solid.pieces, solid.sides.side, thickness);
    require_connected(solid, thickness, area);
    if (solid.closed)
        require_no_thin_floor(solid, thickness, area, of_hole);
    else
        require_rim(solid);

    std::vector<char> from_skin_to_skin;
    for (const Opposite& at : solid.places)
        from_skin_to_skin.push_back(at.hit >= 0 && solid.side(at.face) != PieceSide::rim &&
                                    solid.side(at.hit) != PieceSide::rim);
    thickness = between_vertices(solid, main_distance(solid.places, from_skin_to_skin), marks);
    const std::vector<LocalThickness> local = local_thickness(solid, thickness, progress.part(0.7, 1));
    require_even(solid, local, marks, thickness);

    ThinSolid result = result_of(solid, std::move(marks), thickness, std::abs(volume), flipped);
    std::vector<std::pair<double, double>> spread;
    for (const LocalThickness& at : local)
        spread.emplace_back(at.thickness, at.area);
    result.least = std::min(thickness, quantile(spread, 0.01));
    result.most = std::max(thickness, quantile(spread, 0.99));
    result.thin_tenth = quantile(spread, 0.1);
    result.thick_tenth = quantile(spread, 0.9);
    describe_outline(solid, result);
    const double filled = volume * flipped / (thickness * (result.outer + result.inner) / 2);
    if (solid.closed && (filled < 0.8 || filled > 1.25))
        solid.refuse(fmt::format("its volume of {:.6g} mm3 is {:.3g} times that of a sheet {:.4g} mm thick with these "
                                 "skins",
                                 std::abs(volume), filled, thickness),
                     solid.largest([](int) { return true; }));
    progress.checkpoint(1, "measuring the thickness");
    return result;
}

bool seems_thin_solid(const TriMesh& mesh)
{
    constexpr int rays = 400;
    constexpr double most = 0.7;
    if (mesh.triangles() < 4)
        return false;
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    const double whole = normal.colwise().norm().sum(), off = 1e-7 * bounding_diagonal(mesh);
    if (!(whole > 0))
        return false;
    const RayPicker picker(mesh);
    std::array<int, 2> found{};
    double passed = 0;
    int next = 0;
    for (int f = 0; f < mesh.triangles(); ++f) {
        passed += normal.col(f).norm();
        for (; next < rays && passed >= (next + 0.5) / rays * whole; ++next) {
            const Eigen::Vector3d n = normal.col(f).normalized(), middle = (mesh.position.col(mesh.triangle(0, f)) +
                                                                            mesh.position.col(mesh.triangle(1, f)) +
                                                                            mesh.position.col(mesh.triangle(2, f))) /
                                                                           3;
            for (const size_t k : {size_t(0), size_t(1)}) {
                const Eigen::Vector3d along = k == 0 ? Eigen::Vector3d(-n) : n;
                const RayHit hit = picker.first(middle + off * along, along);
                found[k] += hit.face >= 0 && hit.face != f && hit.distance < thick * std::sqrt(whole / 2) &&
                            normal.col(hit.face).normalized().dot(n) < -0.72;
            }
        }
    }
    return std::max(found[0], found[1]) > most * rays;
}

} // namespace spia

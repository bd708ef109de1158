#include "engine/unfold/plan/neutral_fibre.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/unfold/plan/free_ends.h"
#include "engine/unfold/plan/turns_on.h"

namespace spia {
namespace {

constexpr double degree = std::numbers::pi / 180, k_of_middle = 0.5;

using Laid = Eigen::Matrix<double, 2, 3>;

/// A zone on the way to its row of the table.
struct Candidate {
    BendZone zone;
    SheetBend bend;
    double radius; ///< mm, with which it is laid
    std::vector<Laid> corner;
};

/// Radians of the bend, and beyond it where its plane that goes on would be if it bent on.
double developed(const BendZone& zone, double turn)
{
    const double on = std::clamp(turn, zone.from, zone.to);
    return on + std::tan(turn - on);
}

std::vector<Laid> laid_corners(const TriMesh& part, const BendZone& zone, double radius)
{
    // Around and along the axis; the faces' normals point to the reader.
    const double way = zone.bulging ? 1 : -1;
    // Beyond the bend a corner lies in the plane that goes on from it.
    const auto around = [&](double turn) {
        const double on = std::clamp(turn, zone.from, zone.to);
        return radius * on + zone.radius * std::tan(turn - on);
    };
    std::vector<Laid> result;
    for (size_t i = 0; i < zone.face.size(); ++i) {
        Laid x;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d from = part.position.col(part.triangle(k, zone.face[i])) - zone.point;
            x.col(k) << way * around(zone.turn[i][k]), from.dot(zone.axis);
        }
        result.push_back(x);
    }
    return result;
}

bool upright(const Laid& x)
{
    const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
    return p[0] * q[1] - p[1] * q[0] > 0;
}

void set_k(SheetBend& bend, double k, double thickness)
{
    bend.k = k;
    bend.allowance = bend.angle * (bend.inner_radius + k * thickness);
    bend.deduction = bend_deduction(bend.inner_radius, bend.angle, bend.allowance, thickness);
}

Candidate candidate(const TriMesh& part, BendZone zone, const SheetLayers& layers)
{
    const double t = layers.thickness, side = zone.bulging ? 1 : -1;
    const double of_mesh = zone.stated > 0 ? zone.stated + side * (layers.mesh_at - layers.face_at) : zone.radius;
    Candidate result{std::move(zone), {}, of_mesh, {}};
    const BendZone& at = result.zone;
    SheetBend& bend = result.bend;
    bend.angle = at.to - at.from;
    bend.stated = at.stated > 0;
    bend.up = !at.bulging;
    bend.axis = at.axis;
    bend.faces = at.face;
    bend.laid = true;
    const double inner = of_mesh - side * layers.mesh_at - t / 2;
    constexpr double rounding = 1e-6;
    bend.inner_radius = std::max(0., inner);
    const auto keeps = [&](std::string why, std::string way_out) {
        bend.why_not = std::move(why);
        bend.way_out = std::move(way_out);
    };
    double k = k_of_middle;
    if (inner < -rounding * t)
        keeps(fmt::format("the sheet of {:.4g} mm is thicker there than the radius allows", t),
              "check the thickness of the sheet");
    else if (layers.mesh_at == 0 && layers.k)
        k = layers.k->at(bend.inner_radius / t);
    if (layers.mesh_at != 0)
        k = k_of_middle + side * layers.mesh_at / t;
    else if (bend.why_not.empty()) {
        constexpr double nothing = 0.02; // of the thickness: triangles shorter than that are none
        const double laid = bend.inner_radius + k * t;
        if (laid < nothing * t)
            keeps(fmt::format("K {:.3g} at an inner radius of {:.3g} mm leaves almost no length for the bend", k,
                              bend.inner_radius),
                  "give a larger K factor");
        else
            result.radius = laid;
    }
    // Vertices that a mesher put on chords are off the cylinder by the sagitta of 20 degrees at
    // most, 0.4 to 1.5 % of the radius.
    constexpr double most_off = 0.02;
    const std::string finer = "give the part finer triangles there, or measure a trial bend";
    if (at.off + std::abs(at.radius - of_mesh) > most_off * of_mesh)
        keeps("triangles deviate from the cylinder", finer);
    set_k(bend, k, t);
    result.corner = laid_corners(part, at, result.radius);
    if (!std::all_of(result.corner.begin(), result.corner.end(), upright))
        keeps("triangles turn over on the cylinder", finer);
    bend.laid = bend.why_not.empty();
    return result;
}

/// Zones of a part of a turn only are no bends: their rows would have a wrong angle and radius.
void refuse_parts_of_turns(const TriMesh& part, double rounding, std::vector<Candidate>& candidates)
{
    std::vector<BendZone> zones;
    for (const Candidate& each : candidates)
        zones.push_back(each.zone);
    const std::vector<char> part_of_turn = turns_on(part, zones, rounding);
    for (size_t c = 0; c < candidates.size(); ++c)
        if (SheetBend& bend = candidates[c].bend; part_of_turn[c] && bend.laid) {
            bend.laid = false;
            bend.why_not = "beyond its ends the sheet turns on or is askew to it, so that its radius and its angle are "
                           "not those of the whole bend, whose corners lie on no cylinder";
            bend.way_out = fmt::format("export the mesh with more decimals{}, or the part as STEP",
                                       rounding > 0 ? fmt::format(" (they are off by up to {:.2g} mm)", rounding) : "");
        }
}

/// Zones whose edges have other lengths than the faces beside them have are no bends.
void compare_borders(const TriMesh& part, std::vector<Candidate>& candidates)
{
    constexpr double alike = 1e-4; // of a length; what a K factor or chords change is more
    // candidate, place in it
    std::vector<std::pair<int, int>> at(size_t(part.triangles()), {-1, -1});
    for (size_t c = 0; c < candidates.size(); ++c)
        for (size_t i = 0; i < candidates[c].zone.face.size(); ++i)
            at[size_t(candidates[c].zone.face[i])] = {int(c), int(i)};
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    const auto length = [&](const EdgeUse& use) {
        const auto [c, i] = at[size_t(use.face)];
        if (c < 0 || !candidates[size_t(c)].bend.laid)
            return (part.position.col(use.low) - part.position.col(use.high)).norm();
        const Laid& x = candidates[size_t(c)].corner[size_t(i)];
        return (x.col((use.corner + 1) % 3) - x.col(use.corner)).norm();
    };
    const double rounding = 1e-9 * bounding_diagonal(part);
    const auto along_arc = [&](int c, const EdgeUse& use) {
        const Laid& x = candidates[size_t(c)].corner[size_t(at[size_t(use.face)].second)];
        const Eigen::Vector2d edge = x.col((use.corner + 1) % 3) - x.col(use.corner);
        return std::abs(edge[0]) > std::abs(edge[1]);
    };
    /// Of a zone's edges, mm: of all, and of those with two lengths the ones around and along the
    /// axis.
    struct Border {
        double all = 0, around = 0, along = 0;
    };
    // Where the rim of a hole crosses the border of a bend, edges along it may be a little off;
    // where the zone goes over into drawn sheet, all edges around its end are.
    constexpr double share = 0.25;
    for (bool changed = true; changed;) {
        std::vector<Border> border(candidates.size());
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end != begin + 2)
                return;
            const EdgeUse &one = uses[begin], &other = uses[begin + 1];
            if (at[size_t(one.face)].first == at[size_t(other.face)].first)
                return;
            const double a = length(one), b = length(other);
            const bool same = std::abs(a - b) <= alike * std::max(a, b) + rounding;
            for (const EdgeUse& use : {one, other})
                if (const int c = at[size_t(use.face)].first; c >= 0) {
                    border[size_t(c)].all += length(use);
                    if (!same)
                        (along_arc(c, use) ? border[size_t(c)].around : border[size_t(c)].along) += length(use);
                }
        });
        changed = false;
        for (size_t c = 0; c < candidates.size(); ++c)
            if (candidates[c].bend.laid &&
                (border[c].around > share * candidates[c].bend.allowance || border[c].along > share * border[c].all)) {
                candidates[c].bend.laid = false;
                candidates[c].bend.why_not = "it does not end on straight lines across the sheet, but runs into sheet "
                                             "that is formed in another way";
                candidates[c].bend.way_out =
                    "add bend reliefs at its ends, or measure a trial bend: there the blank has the lengths of the "
                    "part";
                changed = true;
            }
    }
}

/// Where the K factor has no effect: in flat sheet and at sharp folds, which is as it should be,
/// and in sheet that bends but not over a cylinder.
void note_no_effect(const TriMesh& part, BendTable& table)
{
    constexpr double curved = 0.5 * degree, sharp = 40 * degree,
                     speck = 1e-3; // chords of CAD faces turn by up to 20 degrees
    std::vector<char> bent(size_t(part.triangles()), 0), otherwise(bent.size(), 0);
    for (const SheetBend& bend : table.bends)
        for (const int f : bend.faces)
            bent[size_t(f)] = 1;
    const Eigen::Matrix3Xd normal = area_vectors(part);
    const auto breadth = [&](int f, double edge) { return normal.col(f).norm() / edge; };
    double edges = 0;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const int f = uses[begin].face, g = uses[begin + 1].face;
        if (bent[size_t(f)] || bent[size_t(g)])
            return;
        const double turn = std::atan2(normal.col(f).cross(normal.col(g)).norm(), normal.col(f).dot(normal.col(g)));
        const double edge = (part.position.col(uses[begin].low) - part.position.col(uses[begin].high)).norm();
        if (turn > sharp)
            edges += edge;
        else if (turn > curved) { // a broad face beside a narrow one is the flat beside the first
                                  // chord of a bend
            constexpr double broader = 3;
            const double one = breadth(f, edge), other = breadth(g, edge);
            otherwise[size_t(f)] |= one <= broader * other;
            otherwise[size_t(g)] |= other <= broader * one;
        }
    });
    double area = 0, whole = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        whole += normal.col(f).norm() / 2;
        area += otherwise[size_t(f)] ? normal.col(f).norm() / 2 : 0;
    }
    const bool curves = area > speck * whole;
    if (curves)
        table.notes.push_back(fmt::format("{:.3g} % of the sheet is curved but not a cylindrical bend: there the K "
                                          "factor has no effect, and the blank has the lengths of the middle surface "
                                          "(K 0.5)",
                                          100 * area / whole));
    if (edges > 0)
        table.kept.push_back(fmt::format("sharp edges, {:.4g} mm of them, have no radius: there the K factor has no "
                                         "effect, and the blank is as long as the part's middle surface",
                                         edges));
    else if (!curves && table.bends.empty())
        table.kept.push_back("the sheet has no bend: the K factor has no effect");
}

std::string numbers_of(const std::vector<int>& bends)
{
    constexpr size_t most = 12;
    if (bends.size() > most)
        return fmt::format("{} bends, first {},", bends.size(),
                           fmt::join(bends.begin(), bends.begin() + long(most), ", "));
    return fmt::format("bend{} {}", bends.size() == 1 ? "" : "s", fmt::join(bends, ", "));
}

std::string describe_kept(const std::vector<int>& bends, bool of_middle, const std::string& why)
{
    return fmt::format("{} {} the lengths of {}: {}", numbers_of(bends), bends.size() == 1 ? "keeps" : "keep",
                       of_middle ? "the middle surface's triangles (K 0.5)" : "the skin's triangles", why);
}

std::string describe_surface(const BendTable& table, const SheetLayers& layers)
{
    if (layers.mesh_at != 0)
        return layers.mesh_at > 0 ? "outer skin" : "inner skin";
    double least = std::numeric_limits<double>::infinity(), most = 0;
    int laid = 0;
    for (const SheetBend& bend : table.bends)
        if (bend.laid) {
            ++laid;
            least = std::min(least, bend.k);
            most = std::max(most, bend.k);
        }
    constexpr double digits = 5e-5;
    const std::string of =
        laid == int(table.bends.size()) ? "" : fmt::format(" ({} of {} bends)", laid, table.bends.size());
    if (laid == 0 || std::max(std::abs(least - k_of_middle), std::abs(most - k_of_middle)) < 1e-9)
        return "middle surface, K 0.5";
    if (most - least < digits)
        return fmt::format("neutral fibre, K {:.4g}{}", most, of);
    return fmt::format("neutral fibre, K {:.4g} to {:.4g}{}", least, most, of);
}

} // namespace

double bend_deduction(double inner_radius, double angle, double allowance, double thickness)
{
    const double outer = inner_radius + thickness;
    return (angle < 90 * degree ? 2 * outer * std::tan(angle / 2) : 2 * outer) - allowance;
}

NeutralFibre neutral_fibre(const TriMesh& part, std::vector<BendZone> zones, const SheetLayers& layers)
{
    if (!(layers.thickness > 0) || !std::isfinite(layers.thickness))
        throw InputError(fmt::format("the sheet thickness is {} mm; it must be positive", layers.thickness));
    if (layers.k && layers.mesh_at != 0)
        throw InputError(fmt::format(
            "a K factor needs the middle surface, but a skin of the solid is laid flat: leave out the K factor ({}), or "
            "take the middle surface ({}); if no skin was chosen, the notes say why there is none",
            mention(option::k_factor), mention(option::skin)));
    constexpr double flat = 0.05 * degree; // what turns less is a plane that CAD tilted
    const FreeEnds ends(part);
    std::vector<Candidate> candidates;
    for (BendZone& zone : zones)
        if (zone.to - zone.from > flat && ends.of(zone)) // else the radius of drawn sheet
            candidates.push_back(candidate(part, std::move(zone), layers));
    compare_borders(part, candidates);
    if (layers.rounding)
        refuse_parts_of_turns(part, *layers.rounding, candidates);

    NeutralFibre result;
    BendTable& table = result.table;
    table.thickness = layers.thickness;
    table.of_middle = layers.mesh_at == 0;
    std::map<int, Laid> laid;
    std::map<std::string, std::vector<int>> kept;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.zone.face.front() < b.zone.face.front(); });
    for (Candidate& each : candidates) {
        if (!each.bend.laid && layers.mesh_at == 0)
            set_k(each.bend, k_of_middle, layers.thickness);
        if (each.bend.laid)
            for (size_t i = 0; i < each.corner.size(); ++i)
                laid.emplace(each.zone.face[i], each.corner[i]);
        else
            kept[each.bend.why_not].push_back(int(table.bends.size()) + 1);
        table.bends.push_back(std::move(each.bend));
        result.zone.push_back(std::move(each.zone));
    }
    for (const auto& [face, corner] : laid) {
        result.laid.face.push_back(face);
        result.laid.corner.push_back(corner);
    }
    for (const auto& [why, bends] : kept)
        table.kept.push_back(describe_kept(bends, table.of_middle, why));
    if (layers.k && *layers.k != KFactor{})
        note_no_effect(part, table);
    table.surface = describe_surface(table, layers);
    return result;
}

void keep_triangles(NeutralFibre& fibre, const std::string& why, const std::string& way_out)
{
    BendTable& table = fibre.table;
    std::vector<int> kept;
    for (size_t b = 0; b < table.bends.size(); ++b) {
        SheetBend& bend = table.bends[b];
        if (!bend.laid)
            continue;
        bend.laid = false;
        bend.why_not = why;
        bend.way_out = way_out;
        set_k(bend, table.of_middle ? k_of_middle : bend.k, table.thickness);
        kept.push_back(int(b) + 1);
    }
    fibre.laid = {};
    if (kept.empty())
        return;
    if (table.of_middle)
        table.surface = "middle surface, K 0.5";
    table.kept.push_back(describe_kept(kept, table.of_middle, why));
}

void place_on_blank(NeutralFibre& fibre, const TriMesh& part, const Blank& blank)
{
    for (size_t b = 0; b < fibre.zone.size(); ++b) {
        const BendZone& zone = fibre.zone[b];
        SheetBend& bend = fibre.table.bends[b];
        const double half = (zone.from + zone.to) / 2;
        std::vector<BlankSegment> pieces;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (size_t i = 0; i < zone.face.size(); ++i) {
            std::vector<Eigen::Vector2d> crossing;
            for (int k = 0; k < 3; ++k) {
                const int a = part.triangle(k, zone.face[i]), c = part.triangle((k + 1) % 3, zone.face[i]);
                const double from = developed(zone, zone.turn[i][k]) - half,
                             to = developed(zone, zone.turn[i][(k + 1) % 3]) - half;
                const double along = (part.position.col(a) - zone.point).dot(zone.axis);
                low = std::min(low, along);
                high = std::max(high, along);
                if ((from >= 0) != (to >= 0)) {
                    const double share = from / (from - to);
                    crossing.push_back((1 - share) * blank.position.col(a) + share * blank.position.col(c));
                }
            }
            if (crossing.size() == 2)
                pieces.push_back({crossing[0], crossing[1]});
        }
        Eigen::Matrix<double, 3, 2> frame;
        frame.col(0) = zone.axis.unitOrthogonal();
        frame.col(1) = zone.axis.cross(frame.col(0));
        bend.place = zone.point + zone.axis * (low + high) / 2 +
                     zone.radius * frame * Eigen::Vector2d(std::cos(half), std::sin(half));
        bend.line.clear();
        bend.length = 0;
        if (pieces.empty())
            continue;
        const auto longest = std::max_element(pieces.begin(), pieces.end(), [](const auto& p, const auto& q) {
            return (p.to - p.from).norm() < (q.to - q.from).norm();
        });
        const Eigen::Vector2d along = (longest->to - longest->from).normalized();
        for (BlankSegment& piece : pieces)
            if (along.dot(piece.to - piece.from) < 0)
                std::swap(piece.from, piece.to);
        std::stable_sort(pieces.begin(), pieces.end(), [&](const BlankSegment& p, const BlankSegment& q) {
            return along.dot(p.from) < along.dot(q.from);
        });
        const double joined = 1e-6 * bounding_diagonal(part);
        for (const BlankSegment& piece : pieces)
            if (bend.line.empty() || along.dot(piece.from - bend.line.back().to) > joined)
                bend.line.push_back(piece);
            else if (along.dot(piece.to - bend.line.back().to) > 0)
                bend.line.back().to = piece.to;
        for (const BlankSegment& piece : bend.line)
            bend.length += (piece.to - piece.from).norm();
    }
}

} // namespace spia

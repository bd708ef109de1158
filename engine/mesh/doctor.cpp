#include "engine/mesh/doctor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/flat_triangles.h"
#include "engine/mesh/largest_piece.h"
#include "engine/mesh/surface_triangles.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// The surface while it is mended.
struct Surface {
    const PolygonSoup& soup;
    std::vector<Triangle> triangle; ///< vertices of the soup, then copies of some
    std::vector<int> number;        ///< per triangle: its polygon in the soup
    std::vector<int> piece;         ///< per triangle: which connected piece
    std::vector<int> home;          ///< per vertex, copies included: the vertex of the soup
    bool two_faces_per_edge = true; ///< at most
    bool two_sided = true;
};

// ---- what makes every further step senseless ----

void check_coordinates(const PolygonSoup& soup, DoctorReport& report)
{
    constexpr double beyond_any_part = 1e9; // mm, a thousand kilometres
    Tally bad;
    for (int v = 0; v < soup.vertices(); ++v) {
        const Vector3d& p = soup.position[size_t(v)];
        if (!p.allFinite() || p.cwiseAbs().maxCoeff() > beyond_any_part)
            bad.add(v);
    }
    if (bad.count == 0)
        return;
    const Vector3d& p = soup.position[size_t(bad.first)];
    report.add(Fault::bad_coordinate, Severity::fatal, bad,
               fmt::format("{} a coordinate that is no number or beyond {} mm (first: vertex {} at {}, {}, {})",
                           counted(bad.count, "vertex has", "vertices have"), beyond_any_part, bad.first, p.x(), p.y(),
                           p.z()),
               "write the file anew and check the unit of length");
}

void check_indices(const PolygonSoup& soup, DoctorReport& report)
{
    Tally bad;
    int wrong = 0;
    for (int p = 0; p < soup.polygons(); ++p)
        for (const int v : soup.polygon(p))
            if (v < 0 || v >= soup.vertices()) {
                wrong = bad.count == 0 ? v : wrong;
                bad.add(p);
                break;
            }
    if (bad.count > 0)
        report.add(Fault::bad_index, Severity::fatal, bad,
                   fmt::format("{} a vertex that does not exist (first: face {}, vertex {} where there are {})",
                               counted(bad.count, "face names", "faces name"), bad.first, wrong, soup.vertices()),
                   "the file is damaged or cut off: write it anew");
}

bool readable(const PolygonSoup& soup, DoctorReport& report)
{
    if (soup.polygons() == 0)
        report.add(Fault::nothing_there, Severity::fatal, Tally{}, "there are no faces",
                   "give a surface mesh: points or curves alone cannot be flattened");
    check_coordinates(soup, report);
    check_indices(soup, report);
    return report.healthy();
}

// ---- triangles become a surface ----

/// Leaves out the marked triangles.
Tally remove(Surface& s, const std::vector<char>& marked)
{
    Tally removed;
    size_t kept = 0;
    for (size_t f = 0; f < s.triangle.size(); ++f) {
        if (marked[f]) {
            removed.add(s.number[f]);
            continue;
        }
        s.triangle[kept] = s.triangle[f];
        s.number[kept] = s.number[f];
        if (!s.piece.empty())
            s.piece[kept] = s.piece[f];
        ++kept;
    }
    s.triangle.resize(kept);
    s.number.resize(kept);
    if (!s.piece.empty())
        s.piece.resize(kept);
    return removed;
}

/// A triangle without area can be what makes an edge one of three faces. It is left out where this opens no
/// other edge.
Tally drop_flat_at_crowded_edges(Surface& s)
{
    enum : char { crowds = 1, holds = 2 };
    std::vector<char> mark(s.triangle.size(), 0);
    const auto uses = edge_uses(s.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        for (size_t i = begin; end - begin > 1 && i < end; ++i)
            mark[size_t(uses[i].face)] |= end - begin > 2 ? crowds : holds;
    });
    for (size_t f = 0; f < mark.size(); ++f)
        mark[f] = mark[f] == crowds && is_flat(s.triangle[f], s.soup.position);
    return remove(s, mark);
}

void check_edges(Surface& s, DoctorReport& report)
{
    int most = 0;
    std::vector<EdgeUse> crowded; ///< the first face of each
    const auto uses = edge_uses(s.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin <= 2)
            return;
        crowded.push_back(uses[begin]); // the uses of an edge are in the order of the faces
        most = std::max(most, int(end - begin));
    });
    s.two_faces_per_edge = crowded.empty();
    if (crowded.empty())
        return;
    std::stable_sort(crowded.begin(), crowded.end(),
                     [](const EdgeUse& a, const EdgeUse& b) { return a.face < b.face; });
    Tally faces;
    for (const EdgeUse& use : crowded)
        faces.add(s.number[size_t(use.face)]);
    const EdgeUse& first = crowded[0];
    report.add(
        Fault::crowded_edge, Severity::fatal, faces,
        fmt::format("{} to three or more faces, up to {} (first: the edge between the vertices {} and "
                    "{}, at face "
                    "{})",
                    counted(faces.count, "edge belongs", "edges belong"), most, first.low, first.high, faces.first),
        "a sheet goes on to two sides only: remove ribs and doubled layers, keep one skin of the part; --keep-largest "
        "leaves out what hangs on such edges");
}

/// A neighbour over an edge of two faces.
struct Step {
    int to;
    bool same_side; ///< the two run through the edge in opposite directions
};

std::vector<std::vector<Step>> neighbours(const std::vector<Triangle>& triangles)
{
    std::vector<std::vector<Step>> steps(triangles.size());
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        const EdgeUse &a = uses[begin], &b = uses[begin + 1];
        steps[size_t(a.face)].push_back({b.face, a.forward != b.forward});
        steps[size_t(b.face)].push_back({a.face, a.forward != b.forward});
    });
    return steps;
}

double area(const Triangle& t, const std::vector<Vector3d>& position)
{
    const Vector3d& a = position[size_t(t[0])];
    return 0.5 * (position[size_t(t[1])] - a).cross(position[size_t(t[2])] - a).norm();
}

/// Floods each piece from its first triangle and turns over whatever shows the other side; then the piece as a whole if
/// that was the smaller area.
void orient(Surface& s, DoctorReport& report)
{
    const auto steps = neighbours(s.triangle);
    s.piece.assign(s.triangle.size(), -1);
    std::vector<char> turned(s.triangle.size(), 0);
    int clash = -1;
    for (size_t seed = 0; seed < s.triangle.size(); ++seed) {
        if (s.piece[seed] >= 0)
            continue;
        const int piece = report.components++;
        s.piece[seed] = piece;
        std::vector<size_t> reached = {seed};
        double kept_area = 0, turned_area = 0;
        for (size_t i = 0; i < reached.size(); ++i) {
            const size_t f = reached[i];
            (turned[f] ? turned_area : kept_area) += area(s.triangle[f], s.soup.position);
            for (const Step& step : steps[f]) {
                const size_t g = size_t(step.to);
                const char side = char(step.same_side ? turned[f] : !turned[f]);
                if (s.piece[g] < 0) {
                    s.piece[g] = piece;
                    turned[g] = side;
                    reached.push_back(g);
                } else if (turned[g] != side && (clash < 0 || step.to < clash)) {
                    clash = step.to;
                }
            }
        }
        if (turned_area > kept_area)
            for (const size_t f : reached)
                turned[f] = !turned[f];
    }
    if (clash >= 0) {
        s.two_sided = false;
        Tally strip;
        strip.add(s.number[size_t(clash)]);
        report.add(Fault::one_sided, Severity::fatal, strip,
                   fmt::format("the surface has one side only, like a Moebius strip: going round it, one "
                               "comes back to face {} "
                               "from behind",
                               s.number[size_t(clash)]),
                   "cut it open, or look for a wrongly connected strip of faces");
        return;
    }
    Tally turns;
    for (size_t f = 0; f < s.triangle.size(); ++f)
        if (turned[f]) {
            std::swap(s.triangle[f][1], s.triangle[f][2]);
            turns.add(s.number[f]);
        }
    if (turns.count > 0)
        report.add(
            Fault::flipped_face, Severity::repaired, turns,
            fmt::format("{} turned against the others (first: face {}); turned over, the larger area kept its side",
                        counted(turns.count, "triangle was", "triangles were"), turns.first),
            "");
}

/// @param dropped  triangles without area that were left out earlier
void mend_flat_triangles(Surface& s, const Tally& dropped, DoctorReport& report)
{
    Tally flat;
    std::vector<int> all_flat;
    for (size_t f = 0; f < s.triangle.size(); ++f)
        if (is_flat(s.triangle[f], s.soup.position)) {
            flat.add(s.number[f]);
            all_flat.push_back(int(f));
        }
    if (flat.count + dropped.count == 0)
        return;
    const int first = flat.count == 0      ? dropped.first
                      : dropped.count == 0 ? flat.first
                                           : std::min(flat.first, dropped.first);
    FlatRepair repair;
    if (s.two_faces_per_edge && s.two_sided) {
        repair = repair_flat_triangles(s.triangle, s.soup.position);
    } else { // without a proper surface around them they stay
        repair.removed.assign(s.triangle.size(), 0);
        repair.left = all_flat;
    }
    const int mended = flat.count + dropped.count - int(repair.left.size());
    if (mended > 0) {
        Tally gone;
        for (const int number : dropped.where)
            gone.add(number);
        for (const int f : all_flat)
            if (std::find(repair.left.begin(), repair.left.end(), f) == repair.left.end())
                gone.add(s.number[size_t(f)]);
        gone.count = mended;
        gone.first = first;
        report.add(Fault::flat_face, Severity::repaired, gone,
                   fmt::format("{} no area (first: face {}): {} gone by joining two vertices at one place, "
                               "{} by turning the "
                               "longest edge, {} left out at the boundary or where the edge had other faces",
                               counted(mended, "triangle had", "triangles had"), first, repair.joined, repair.flipped,
                               repair.dropped + dropped.count),
                   "");
    }
    if (!repair.left.empty()) {
        const Triangle& t = s.triangle[size_t(repair.left[0])];
        const int number = s.number[size_t(repair.left[0])];
        Tally left;
        for (const int f : repair.left)
            left.add(s.number[size_t(f)]);
        report.add(
            Fault::flat_face, Severity::fatal, left,
            fmt::format("{} no area and cannot be taken out without tearing the surface (first: face {} with the "
                        "vertices {}, {}, {})",
                        counted(int(repair.left.size()), "triangle has", "triangles have"), number, t[0], t[1], t[2]),
            "mesh the part anew there");
    }
    remove(s, repair.removed);
}

// ---- the surface as a whole ----

/// Corner 3 f + k of triangle f; corners at one vertex that an edge of two faces links are one fan.
DisjointSets fans(const std::vector<Triangle>& triangles)
{
    DisjointSets sets(3 * triangles.size());
    const auto corner_at = [&](int f, int v) {
        const Triangle& t = triangles[size_t(f)];
        return 3 * f + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
    };
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin == 2)
            for (const int v : {uses[begin].low, uses[begin].high})
                sets.join(corner_at(uses[begin].face, v), corner_at(uses[begin + 1].face, v));
    });
    return sets;
}

/// Where faces meet in a vertex only, each further fan gets a copy of the vertex; the first face keeps it.
void separate_fans(Surface& s, DoctorReport& report)
{
    s.home.resize(size_t(s.soup.vertices()));
    std::iota(s.home.begin(), s.home.end(), 0);
    if (!s.two_faces_per_edge)
        return; // around an edge of three faces there is no fan

    DisjointSets sets = fans(s.triangle);
    std::vector<int> first_fan(s.home.size(), -1), copy(3 * s.triangle.size(), -1);
    std::vector<char> doubled(s.home.size(), 0);
    for (size_t c = 0; c < copy.size(); ++c) {
        int& v = s.triangle[c / 3][c % 3];
        const int fan = sets.root(int(c));
        int& keeper = first_fan[size_t(v)];
        keeper = keeper < 0 ? fan : keeper;
        if (keeper == fan)
            continue;
        if (copy[size_t(fan)] < 0) {
            copy[size_t(fan)] = int(s.home.size());
            s.home.push_back(v);
            doubled[size_t(v)] = 1;
        }
        v = copy[size_t(fan)];
    }
    Tally touching;
    for (size_t v = 0; v < doubled.size(); ++v)
        if (doubled[v])
            touching.add(int(v));
    if (touching.count > 0)
        report.add(
            Fault::touching_fans, Severity::repaired, touching,
            fmt::format("at {} parts of the sheet touched without a common edge (first: vertex {}); separated by "
                        "doubling the vertex",
                        counted(touching.count, "vertex", "vertices"), touching.first),
            "if they should hang together there, give them a common edge");
}

void report_strays(const Surface& s, DoctorReport& report)
{
    std::vector<char> named(size_t(s.soup.vertices()), 0);
    for (const int v : s.soup.corner)
        named[size_t(v)] = 1;
    Tally strays;
    for (int v = 0; v < s.soup.vertices(); ++v)
        if (!named[size_t(v)])
            strays.add(v);
    if (strays.count > 0)
        report.add(Fault::stray_vertex, Severity::repaired, strays,
                   fmt::format("{} to no face (first: vertex {}); left out",
                               counted(strays.count, "vertex belongs", "vertices belong"), strays.first),
                   "");
}

/// Vertices in the order of the soup, copies behind their originals, unused ones left out.
Examination number_vertices(const Surface& s, DoctorReport report)
{
    std::vector<char> used(s.home.size(), 0);
    for (const Triangle& t : s.triangle)
        for (const int v : t)
            used[size_t(v)] = 1;
    std::vector<int> order;
    for (size_t v = 0; v < s.home.size(); ++v)
        if (used[v])
            order.push_back(int(v));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return s.home[size_t(a)] < s.home[size_t(b)]; });

    Examination result;
    std::vector<int> new_number(s.home.size(), -1);
    result.mesh.position.resize(3, long(order.size()));
    for (size_t i = 0; i < order.size(); ++i) {
        const int home = s.home[size_t(order[i])];
        new_number[size_t(order[i])] = int(i);
        result.source_vertex.push_back(home);
        result.mesh.position.col(long(i)) = s.soup.position[size_t(home)];
    }
    result.mesh.triangle.resize(3, long(s.triangle.size()));
    for (size_t f = 0; f < s.triangle.size(); ++f)
        for (size_t k = 0; k < 3; ++k)
            result.mesh.triangle(long(k), long(f)) = new_number[size_t(s.triangle[f][k])];
    result.source_face = s.number;
    result.report = std::move(report);
    return result;
}

void count_pieces(const Surface& s, DoctorReport& report)
{
    std::vector<int> size(size_t(report.components), 0);
    for (const int piece : s.piece)
        ++size[size_t(piece)];
    const int largest = int(std::max_element(size.begin(), size.end()) - size.begin());
    std::vector<char> seen(size.size(), 0);
    seen[size_t(largest)] = 1;
    Tally others; // the first face of each
    for (size_t f = 0; f < s.piece.size(); ++f)
        if (!std::exchange(seen[size_t(s.piece[f])], char(1)))
            others.add(s.number[f]);
    std::erase(size, 0);
    report.components = int(size.size());
    if (report.components < 2)
        return;
    others.count = report.components;
    std::sort(size.rbegin(), size.rend());
    std::string sizes;
    for (size_t i = 0; i < std::min<size_t>(size.size(), 5); ++i)
        sizes += fmt::format("{}{}", i > 0 ? ", " : "", size[i]);
    const Finding* coincident = report.find(Fault::coincident_vertex);
    const bool unjoined = coincident && coincident->severity == Severity::note;
    report.add(
        Fault::several_components, Severity::fatal, others,
        fmt::format("there are {} separate pieces, of {}{} triangles (first face outside the largest: {})",
                    report.components, sizes, size.size() > 5 ? ", ..." : "", others.first),
        unjoined
            ? "join vertices at one place (--weld) if the pieces touch; otherwise keep the largest (--keep-largest), or "
              "save each as a file of its own"
            : "keep the largest (--keep-largest), or save each piece as a file of its own");
}

/// Edges of the surface, and boundary loops of each piece.
struct Outline {
    int edges = 0;
    std::vector<int> loops;
};

Outline outline(const Surface& s, int pieces)
{
    // Every vertex has one fan now, so at most two boundary edges meet there and a loop is a connected set of
    // them.
    DisjointSets sets(s.home.size());
    std::vector<int> piece_of(s.home.size(), -1);
    Outline result;
    const auto uses = edge_uses(s.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        ++result.edges;
        if (end - begin > 1)
            return;
        sets.join(uses[begin].low, uses[begin].high);
        piece_of[size_t(uses[begin].low)] = piece_of[size_t(uses[begin].high)] = s.piece[size_t(uses[begin].face)];
    });
    result.loops.assign(size_t(pieces), 0);
    for (size_t v = 0; v < piece_of.size(); ++v)
        if (piece_of[v] >= 0 && sets.root(int(v)) == int(v))
            ++result.loops[size_t(piece_of[v])];
    return result;
}

void check_topology(const Surface& s, int vertices, DoctorReport& report)
{
    if (s.triangle.empty()) {
        report.add(Fault::nothing_there, Severity::fatal, Tally{}, "no face is left after the repairs",
                   "the faces of the file have no area: write it anew");
        return;
    }
    const int pieces = report.components;
    count_pieces(s, report);
    if (!s.two_faces_per_edge)
        return; // boundary and genus mean nothing

    Outline around = outline(s, pieces);
    const int loops = std::accumulate(around.loops.begin(), around.loops.end(), 0);
    report.boundary_loops = loops;
    report.euler_characteristic = vertices - around.edges + int(s.triangle.size());
    if (s.two_sided) // chi = 2 components - 2 genus - loops
        report.genus = (2 * report.components - *report.euler_characteristic - loops) / 2;

    Tally closed;
    for (size_t f = 0; f < s.piece.size(); ++f)
        if (int& n = around.loops[size_t(s.piece[f])]; n == 0) {
            n = -1; // this piece is counted
            closed.add(s.number[f]);
        }
    if (closed.count > 0)
        report.add(Fault::closed_surface, Severity::fatal, closed,
                   report.components == 1 ? std::string("the surface is closed, it has no boundary")
                                          : fmt::format("{} closed, without a boundary (first: the one of face {})",
                                                        counted(closed.count, "piece is", "pieces are"), closed.first),
                   "a sheet is given by one of its skins: delete the other side and the faces across the thickness");
    if (report.genus.value_or(0) > 0)
        report.add(Fault::handle, Severity::fatal, Tally{*report.genus, -1, {}},
                   fmt::format("the surface has {} (genus {}), like that of a cup: it cannot be laid flat",
                               counted(*report.genus, "handle", "handles"), *report.genus),
                   "cut each handle open");
}

double least_angle(const Triangle& t, const std::vector<Vector3d>& position)
{
    double least = std::numbers::pi;
    for (size_t k = 0; k < 3; ++k) {
        const Vector3d& at = position[size_t(t[k])];
        const Vector3d a = position[size_t(t[(k + 1) % 3])] - at, b = position[size_t(t[(k + 2) % 3])] - at;
        least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
    return least;
}

void note_slivers(const Surface& s, double angle_deg, DoctorReport& report)
{
    Tally slivers;
    double least = std::numbers::pi;
    for (size_t f = 0; f < s.triangle.size(); ++f) {
        Triangle t = s.triangle[f];
        for (int& v : t)
            v = s.home[size_t(v)];
        const double angle = least_angle(t, s.soup.position);
        least = std::min(least, angle);
        if (angle < angle_deg * std::numbers::pi / 180)
            slivers.add(s.number[f]);
    }
    if (slivers.count > 0)
        report.add(Fault::sliver, Severity::note, slivers,
                   fmt::format("{} an angle below {:.3g} degrees (first: face {}); the smallest is {:.3g} degrees",
                               counted(slivers.count, "triangle has", "triangles have"), angle_deg, slivers.first,
                               least * 180 / std::numbers::pi),
                   "strains there mean little; a more even mesh is better");
}

} // namespace

std::string_view name(Fault fault)
{
    switch (fault) {
    case Fault::nothing_there: return "no faces";
    case Fault::bad_index: return "missing vertex";
    case Fault::bad_coordinate: return "bad coordinate";
    case Fault::coincident_vertex: return "coincident vertices";
    case Fault::repeated_corner: return "repeated corner";
    case Fault::duplicate_face: return "duplicate face";
    case Fault::polygon: return "polygon";
    case Fault::crossing_polygon: return "crossing polygon";
    case Fault::flat_face: return "face without area";
    case Fault::crowded_edge: return "non-manifold edge";
    case Fault::flipped_face: return "flipped orientation";
    case Fault::one_sided: return "one-sided surface";
    case Fault::stray_vertex: return "stray vertex";
    case Fault::touching_fans: return "non-manifold vertex";
    case Fault::several_components: return "several components";
    case Fault::closed_surface: return "closed surface";
    case Fault::handle: return "handle";
    case Fault::sliver: return "sliver";
    }
    return "";
}

bool DoctorReport::healthy() const
{
    return std::none_of(findings.begin(), findings.end(),
                        [](const Finding& f) { return f.severity == Severity::fatal; });
}

const Finding* DoctorReport::find(Fault fault) const
{
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.fault == fault; });
    return found == findings.end() ? nullptr : &*found;
}

void DoctorReport::add(Fault fault, Severity severity, const Tally& tally, std::string text, std::string advice)
{
    findings.push_back(
        {fault, severity, tally.count, tally.first, std::move(text), std::move(advice), tally.where, {}});
}

bool counts_vertices(Fault fault)
{
    return fault == Fault::bad_coordinate || fault == Fault::coincident_vertex || fault == Fault::stray_vertex ||
           fault == Fault::touching_fans;
}

/// Leaves out all but the largest piece of sheet.
static void keep_largest(Surface& s, DoctorReport& report)
{
    const Pieces pieces = smooth_pieces(s.triangle, s.soup.position);
    if (pieces.count < 2)
        return;
    std::vector<char> other(s.triangle.size());
    for (size_t f = 0; f < other.size(); ++f)
        other[f] = pieces.of[f] != pieces.largest;
    const Tally removed = remove(s, other);
    report.add(
        Fault::several_components, Severity::repaired, removed,
        fmt::format("{} pieces of sheet were there or hung together at edges of three faces; the largest was kept, "
                    "{} left out (first: face {})",
                    pieces.count, counted(removed.count, "triangle was", "triangles were"), removed.first),
        "");
}

/// Where the faults are; what is repaired may be gone from the mesh.
static void locate(const PolygonSoup& soup, DoctorReport& report)
{
    for (Finding& finding : report.findings)
        for (const int number : finding.where) {
            if (counts_vertices(finding.fault)) {
                finding.place.push_back(soup.position[size_t(number)]);
                continue;
            }
            Vector3d middle = Vector3d::Zero();
            int known = 0;
            for (const int v : soup.polygon(number))
                if (v >= 0 && v < soup.vertices()) {
                    middle += soup.position[size_t(v)];
                    ++known;
                }
            finding.place.push_back(known ? Vector3d(middle / known) : Vector3d(Vector3d::Zero()));
        }
}

Examination examine(const PolygonSoup& soup, const DoctorOptions& options, const Progress& progress)
{
    DoctorReport report;
    if (!readable(soup, report)) {
        locate(soup, report);
        return {{}, {}, {}, std::move(report)};
    }

    SurfaceTriangles split = surface_triangles(soup, options, report, progress.part(0, 0.6));
    Surface s{soup, std::move(split.triangle), std::move(split.number), {}, {}};
    const Tally dropped = drop_flat_at_crowded_edges(s);
    if (options.keep_largest)
        keep_largest(s, report);
    check_edges(s, report);
    progress.checkpoint(0.7, "turning faces to one side");
    orient(s, report);
    mend_flat_triangles(s, dropped, report);
    progress.checkpoint(0.8, "looking at vertices");
    separate_fans(s, report);
    report_strays(s, report);
    Examination result = number_vertices(s, std::move(report));
    progress.checkpoint(0.9, "counting loops and handles");
    check_topology(s, result.mesh.vertices(), result.report);
    note_slivers(s, options.sliver_angle_deg, result.report);
    locate(soup, result.report);
    return result;
}

void require_healthy(const DoctorReport& report)
{
    std::string message;
    int shown = 0;
    for (const Finding& f : report.findings)
        if (f.severity == Severity::fatal && shown++ < 3)
            message += fmt::format("{}{}; {}", shown > 1 ? "\n" : "", f.text, f.advice);
    if (shown > 3)
        message += fmt::format("\nand {} more", shown - 3);
    if (shown > 0)
        throw InputError(message + "\n(faces and vertices are counted from 0)");
}

} // namespace spia

#include "engine/limits/limits.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

bool has_spots(Zone zone) { return zone != Zone::safe && zone != Zone::low_strain; }

void require(const ZoneOptions& options)
{
    const auto between = [](double value, const char* what, double most) {
        if (!(value >= 0 && value <= most))
            throw InputError(fmt::format("{} is {}; give a number from 0 to {}", what, value, most));
    };
    between(options.margin, "the margin below the forming limit curve", 1);
    between(options.max_thinning, "the allowable thinning", 1);
    between(options.max_thickening, "the allowable thickening", 10);
    between(options.low_strain, "the strain below which it counts as low", 1);
}

void require(const TriMesh& part, const SheetFields& face)
{
    const Eigen::Index faces = part.triangles();
    for (const Eigen::VectorXd* field : {&face.thinning, &face.strain_major, &face.strain_minor})
        if (field->size() != faces || !field->allFinite())
            throw InputError(
                fmt::format("the strains are not {} finite numbers, one per face of the part; flatten this "
                            "part again before judging it",
                            faces));
}

constexpr double risk_share = 0.5; // of the margin

bool by_the_curve(Zone zone) { return zone == Zone::crack || zone == Zone::risk || zone == Zone::marginal; }

/// The first zone that holds, see Zone.
Zone zone_of(double major, double minor, double thinning, double distance, const ZoneOptions& o)
{
    if (distance < 0)
        return Zone::crack;
    if (distance < risk_share * o.margin)
        return Zone::risk;
    if (distance < o.margin)
        return Zone::marginal;
    if (thinning > o.max_thinning)
        return Zone::excessive_thinning;
    const double thickening = -thinning;
    if (thickening > o.max_thickening)
        return Zone::strong_thickening;
    if (std::abs(engineering_strain(major)) < o.low_strain && std::abs(engineering_strain(minor)) < o.low_strain)
        return Zone::low_strain;
    return thickening > 0 ? Zone::wrinkling_tendency : Zone::safe;
}

double value_of(Zone zone, double distance, double thinning)
{
    if (by_the_curve(zone))
        return distance;
    return zone == Zone::excessive_thinning ? thinning : -thinning;
}

/// How bad a face is beside others of its zone: the greater the worse.
double badness(Zone zone, double value) { return by_the_curve(zone) ? -value : value; }

/// For each face the least face of its region: faces of one zone that hang together by edges.
std::vector<int> regions(const TriMesh& part, const std::vector<Zone>& zone)
{
    DisjointSets sets{size_t(part.triangles())};
    const auto uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        for (size_t i = begin + 1; i < end; ++i)
            if (zone[size_t(uses[i].face)] == zone[size_t(uses[begin].face)])
                sets.join(uses[i].face, uses[begin].face);
    });
    std::vector<int> region(zone.size());
    for (int f = 0; f < part.triangles(); ++f)
        region[size_t(f)] = sets.root(f);
    return region;
}

std::vector<WorstSpot> worst_spots(const TriMesh& part, const SheetFields& face, const Zones& found,
                                   const Eigen::VectorXd& area, int most)
{
    const std::vector<int> region = regions(part, found.zone);
    std::vector<int> spot_of(region.size(), -1); // by the region's least face
    std::vector<WorstSpot> spots;
    for (int f = 0; f < part.triangles(); ++f) {
        const Zone zone = found.zone[size_t(f)];
        if (!has_spots(zone))
            continue;
        int& at = spot_of[size_t(region[size_t(f)])];
        const double value = value_of(zone, found.distance.size() ? found.distance[f] : 0, face.thinning[f]);
        const bool is_new = at < 0;
        if (is_new) {
            at = int(spots.size());
            spots.push_back({zone, f, Eigen::Vector3d::Zero(), value, 0, 0, 0, 0, 0});
        }
        WorstSpot& spot = spots[size_t(at)];
        ++spot.region_faces;
        spot.region_area_mm2 += area[f];
        if (!is_new && badness(zone, value) <= badness(zone, spot.value))
            continue;
        spot.face = f;
        spot.value = value;
    }
    const auto worse = [](const WorstSpot& a, const WorstSpot& b) {
        return a.zone != b.zone ? a.zone > b.zone : badness(a.zone, a.value) > badness(b.zone, b.value);
    };
    std::stable_sort(spots.begin(), spots.end(), worse);
    spots.resize(std::min(spots.size(), size_t(std::max(most, 0))));
    for (WorstSpot& spot : spots) {
        spot.position = part.position(Eigen::all, part.triangle.col(spot.face)).rowwise().mean();
        spot.strain_major = face.strain_major[spot.face];
        spot.strain_minor = face.strain_minor[spot.face];
        spot.thinning = face.thinning[spot.face];
    }
    return spots;
}

/// Densities and moduli of metals for sheet lie far apart: steel 7850 kg/m3 and 205 GPa, nickel
/// 8900 and 205, copper 8900 and 120, titanium 4500 and 110, aluminium 2700 and 70.
bool is_steel(const Material& material)
{
    return material.young_MPa > 170000 && material.density_kg_m3 > 7600 && material.density_kg_m3 < 8100;
}

/// By either: a fitted grade may have been left at the density of steel, but its modulus was
/// measured.
bool is_aluminium(const Material& material)
{
    return (material.density_kg_m3 > 2300 && material.density_kg_m3 < 3200) ||
           (material.young_MPa > 65000 && material.young_MPa < 75000);
}

double margin_for(const Material& material, const LimitsOptions& options)
{
    constexpr double of_steel = 0.10, of_aluminium = 0.08; // customs of the trade
    return options.margin ? *options.margin : is_aluminium(material) ? of_aluminium : of_steel;
}

std::optional<FormingLimitCurve> curve_for(const Material& material, double thickness, const LimitsOptions& options,
                                           std::vector<std::string>& notes)
{
    using Source = LimitsOptions::Source;
    if (options.source == Source::none)
        return {};
    if (options.source == Source::points)
        return options.curve;
    const GradeLimit& known = material.limit;
    if (options.source == Source::automatic && !known.minor.empty())
        return curve_through(known.minor, known.major, true, material.name);
    if (options.source == Source::automatic && !is_steel(material)) {
        notes.push_back(fmt::format("no forming limit curve: Keeler-Brazier is made for low-carbon steel, which {} is "
                                    "not; give measured points",
                                    material.name));
        return {};
    }
    if (!is_steel(material))
        notes.push_back(
            fmt::format("Keeler-Brazier is made for low-carbon steel; for {} its curve is a guess", material.name));
    constexpr double most = 0.99;
    const double uniform = uniform_strain(material.hardening, most);
    constexpr double of_ferrite = 0.3; // IF steels, the softest ferritic ones, strain uniformly up
                                       // to 0.25
    if (is_steel(material) && uniform > of_ferrite)
        notes.push_back(fmt::format(
            "{} strains uniformly up to {:.2f}, as austenitic and TRIP steels do; Keeler-Brazier is made for low-carbon"
            " steel, not for them: give measured points",
            material.name, uniform));
    return keeler_brazier(thickness, options.n ? *options.n : known.n ? *known.n : uniform);
}

/// What the faces of one sheet are judged by.
struct Judge {
    const FormingLimitCurve* curve = nullptr;
    double margin = 0;
};

/// @param judge_of  per face, into judges
Zones judged(const TriMesh& part, const SheetFields& face, const std::vector<Judge>& judges,
             const std::vector<int>& judge_of, const ZoneOptions& options)
{
    const int faces = part.triangles();
    Zones out;
    out.zone.resize(size_t(faces));
    if (std::any_of(judge_of.begin(), judge_of.end(),
                    [&](int judge) { return judges[size_t(judge)].curve != nullptr; }))
        out.distance = Eigen::VectorXd::Constant(faces, std::nan(""));
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    const double whole = area.sum();
    for (int f = 0; f < faces; ++f) {
        const auto& [curve, margin] = judges[size_t(judge_of[size_t(f)])];
        ZoneOptions mine = options;
        mine.margin = margin;
        double distance = 1 + margin; // no curve: as far as can be
        if (curve) {
            distance = engineering_strain((*curve)(face.strain_minor[f])) - engineering_strain(face.strain_major[f]);
            out.distance[f] = distance;
        }
        const Zone zone = zone_of(face.strain_major[f], face.strain_minor[f], face.thinning[f], distance, mine);
        out.zone[size_t(f)] = zone;
        ZoneShare& share = out.share[size_t(zone)];
        ++share.faces;
        share.area_mm2 += area[f];
    }
    for (ZoneShare& share : out.share)
        share.share = whole > 0 ? share.area_mm2 / whole : 0;
    out.spots = worst_spots(part, face, out, area, options.most_spots);
    return out;
}

/// Per face 0 for the base sheet, k + 1 for the piece k.
std::vector<int> sheet_of_face(const TriMesh& part, std::span<const TailoredPiece> pieces)
{
    std::vector<int> sheet(size_t(part.triangles()), 0);
    for (size_t k = 0; k < pieces.size(); ++k)
        for (const int f : pieces[k].faces) {
            if (f < 0 || f >= part.triangles())
                throw InputError(fmt::format("the tailored piece \"{}\" names face {}; the part has faces 0 to {}",
                                             pieces[k].name, f, part.triangles() - 1));
            sheet[size_t(f)] = int(k) + 1;
        }
    return sheet;
}

PieceLimits limits_of(const TailoredPiece& piece, int faces, const Material& base, const LimitsOptions& options,
                      std::vector<std::string>& notes)
{
    LimitsOptions own = options;
    if (piece.material != base)
        own.n.reset(); // was said of another grade
    PieceLimits limits{piece.name, piece.material.name, piece.thickness, faces, {}, margin_for(piece.material, own)};
    std::vector<std::string> own_notes;
    limits.curve = curve_for(piece.material, piece.thickness, own, own_notes);
    const std::string what = fmt::format("piece \"{}\" ({}, {:.4g} mm)", piece.name, limits.material, piece.thickness);
    const bool points = own.source == LimitsOptions::Source::points;
    if (limits.curve)
        notes.push_back(fmt::format("{}: judged by {}, FLC0 {:.1f} %, and a margin of {:.4g} points", what,
                                    points ? "the same points as the base sheet" : "a forming limit of its own",
                                    100 * engineering_strain(limits.curve->at_plane_strain()), 100 * limits.margin));
    if (limits.curve && !points) // what is to be minded of points is said once, for the base sheet
        own_notes.insert(own_notes.end(), limits.curve->notes.begin(), limits.curve->notes.end());
    for (const std::string& note : own_notes)
        notes.push_back(what + ": " + note);
    return limits;
}

/// Counts the faces beyond the ends of their curves; says so of measured ones where they are many:
/// prolonged lines are not measured.
void count_beyond(const SheetFields& face, const std::vector<Judge>& judges, const std::vector<int>& judge_of,
                  LimitsResult& out)
{
    constexpr double many = 0.05;
    int measured = 0, beyond = 0;   // faces that points judge, and those of them beyond the ends
    double least = 0, greatest = 0; // minor strains of all these
    for (size_t f = 0; f < judge_of.size(); ++f)
        if (const FormingLimitCurve* curve = judges[size_t(judge_of[f])].curve) {
            const double minor = face.strain_minor[Eigen::Index(f)];
            const bool outside = minor < curve->minor.front() || minor > curve->minor.back();
            out.beyond_curve += outside;
            if (!curve->measured)
                continue;
            least = measured == 0 ? minor : std::min(least, minor);
            greatest = measured == 0 ? minor : std::max(greatest, minor);
            beyond += outside;
            ++measured;
        }
    const double share = double(beyond) / std::max(measured, 1);
    if (share > many)
        out.notes.push_back(fmt::format(
            "{} ({:.0f} %) {} minor strains beyond the ends of the forming limit curve, which is prolonged straight "
            "to there: give points from {:.2f} to {:.2f}",
            counted(beyond, "face", "faces"), 100 * share, beyond == 1 ? "has" : "have", least, greatest));
}

} // namespace

std::string_view name(Zone zone)
{
    switch (zone) {
    case Zone::safe: return "safe";
    case Zone::low_strain: return "low_strain";
    case Zone::wrinkling_tendency: return "wrinkling_tendency";
    case Zone::strong_thickening: return "strong_thickening";
    case Zone::excessive_thinning: return "excessive_thinning";
    case Zone::marginal: return "marginal";
    case Zone::risk: return "risk";
    case Zone::crack: return "crack";
    }
    return "";
}

std::string definition(Zone zone, const ZoneOptions& options)
{
    switch (zone) {
    case Zone::crack: return "major strain above the forming limit curve";
    case Zone::risk:
        return fmt::format("below the forming limit curve by less than {:.4g} percentage points of engineering major "
                           "strain, half of the margin",
                           100 * risk_share * options.margin);
    case Zone::marginal:
        return fmt::format(
            "below the forming limit curve by less than {:.4g} percentage points of engineering major strain, "
            "the margin",
            100 * options.margin);
    case Zone::excessive_thinning: return fmt::format("thinner by more than {:.4g} %", 100 * options.max_thinning);
    case Zone::strong_thickening: return fmt::format("thicker by more than {:.4g} %", 100 * options.max_thickening);
    case Zone::low_strain:
        return fmt::format("both principal engineering strains smaller than {:.4g} %", 100 * options.low_strain);
    case Zone::wrinkling_tendency:
        return fmt::format("thicker than before, by at most {:.4g} %: compression outweighs tension",
                           100 * options.max_thickening);
    case Zone::safe: return "none of the others";
    }
    return "";
}

Zones zones(const TriMesh& part, const SheetFields& face, const FormingLimitCurve* curve, const ZoneOptions& options)
{
    require(options);
    require(part, face);
    return judged(part, face, {{curve, options.margin}}, std::vector<int>(size_t(part.triangles()), 0), options);
}

std::vector<Zone> zones_at_vertices(const TriMesh& part, const std::vector<Zone>& of_face)
{
    std::vector<Zone> worst(size_t(part.vertices()), Zone::safe);
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            worst[size_t(v)] = std::max(worst[size_t(v)], of_face[size_t(f)]);
    return worst;
}

LimitsResult forming_limits(const TriMesh& part, const SheetFields& face, const Material& material, double thickness,
                            const LimitsOptions& options, std::span<const TailoredPiece> pieces)
{
    LimitsResult out;
    out.settings = options.zones;
    out.settings.margin = margin_for(material, options);
    require(out.settings);
    require(part, face);
    const std::vector<int> sheet = sheet_of_face(part, pieces);
    out.curve = curve_for(material, thickness, options, out.notes);
    if (out.curve)
        out.notes.insert(out.notes.end(), out.curve->notes.begin(), out.curve->notes.end());
    for (size_t k = 0; k < pieces.size(); ++k)
        out.pieces.push_back(limits_of(pieces[k], int(std::count(sheet.begin(), sheet.end(), int(k) + 1)), material,
                                       options, out.notes));
    const auto curve_of = [](const auto& limits) { return limits.curve ? &*limits.curve : nullptr; };
    std::vector<Judge> judges{{curve_of(out), out.settings.margin}};
    for (const PieceLimits& piece : out.pieces)
        judges.push_back({curve_of(piece), piece.margin});
    out.zones = judged(part, face, judges, sheet, out.settings);
    count_beyond(face, judges, sheet, out);
    return out;
}

} // namespace spia

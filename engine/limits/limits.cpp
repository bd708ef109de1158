#include "engine/limits/limits.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
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

/// The first zone that holds, see Zone.
Zone zone_of(double major, double minor, double thinning, double distance, const ZoneOptions& o)
{
    if (distance < 0)
        return Zone::crack;
    if (distance < o.margin)
        return Zone::risk;
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
    if (zone == Zone::crack || zone == Zone::risk)
        return distance;
    return zone == Zone::excessive_thinning ? thinning : -thinning;
}

/// How bad a face is beside others of its zone: the greater the worse.
double badness(Zone zone, double value) { return zone == Zone::crack || zone == Zone::risk ? -value : value; }

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

/// Densities and moduli of metals for sheet lie far apart: aluminium 2700 kg/m3, copper 120 GPa, steel 7850 and 205.
bool is_steel(const Material& material) { return material.young_MPa > 170000 && material.density_kg_m3 > 7000; }
bool is_aluminium(const Material& material) { return material.density_kg_m3 > 2300 && material.density_kg_m3 < 3200; }

std::optional<FormingLimitCurve> curve_for(const Material& material, double thickness, const LimitsOptions& options,
                                           std::vector<std::string>& notes)
{
    using Source = LimitsOptions::Source;
    if (options.source == Source::none)
        return {};
    if (options.source == Source::points)
        return options.curve;
    if (options.source == Source::automatic && !is_steel(material)) {
        notes.push_back(fmt::format("no forming limit curve: Keeler-Brazier is made for low-carbon steel, and {} is "
                                    "none; give measured points",
                                    material.name));
        return {};
    }
    if (!is_steel(material))
        notes.push_back(
            fmt::format("Keeler-Brazier is made for low-carbon steel; for {} its curve is a guess", material.name));
    constexpr double most = 0.99;
    return keeler_brazier(thickness, options.n ? *options.n : uniform_strain(material.hardening, most));
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
        return fmt::format(
            "below the forming limit curve by less than {:.4g} percentage points of engineering major strain",
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
    const int faces = part.triangles();
    Zones out;
    out.zone.resize(size_t(faces));
    if (curve)
        out.distance.resize(faces);
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    const double whole = area.sum();
    for (int f = 0; f < faces; ++f) {
        double distance = 1 + options.margin; // no curve: as far as can be
        if (curve) {
            distance = engineering_strain((*curve)(face.strain_minor[f])) - engineering_strain(face.strain_major[f]);
            out.distance[f] = distance;
        }
        const Zone zone = zone_of(face.strain_major[f], face.strain_minor[f], face.thinning[f], distance, options);
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

std::vector<Zone> zones_at_vertices(const TriMesh& part, const std::vector<Zone>& of_face)
{
    std::vector<Zone> worst(size_t(part.vertices()), Zone::safe);
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            worst[size_t(v)] = std::max(worst[size_t(v)], of_face[size_t(f)]);
    return worst;
}

LimitsResult forming_limits(const TriMesh& part, const SheetFields& face, const Material& material, double thickness,
                            const LimitsOptions& options)
{
    LimitsResult out;
    out.settings = options.zones;
    constexpr double margin_of_steel = 0.10, margin_of_aluminium = 0.08; // customs of the trade
    out.settings.margin = options.margin           ? *options.margin
                          : is_aluminium(material) ? margin_of_aluminium
                                                   : margin_of_steel;
    out.curve = curve_for(material, thickness, options, out.notes);
    out.zones = zones(part, face, out.curve ? &*out.curve : nullptr, out.settings);
    if (out.curve) {
        out.notes.insert(out.notes.end(), out.curve->notes.begin(), out.curve->notes.end());
        for (const double minor : face.strain_minor)
            out.beyond_curve += minor < out.curve->minor.front() || minor > out.curve->minor.back();
    }
    return out;
}

} // namespace spia

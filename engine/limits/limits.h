#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/forming/process/process.h"
#include "engine/limits/forming_limit_curve.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// What forming does to a place of the sheet. The first of these that holds, from crack down, is
/// its zone:
///   crack               the major strain is above the forming limit curve
///   risk                it is below the curve by less than half of the margin, in points of
///                       engineering major strain
///   marginal            it is below the curve by less than the margin
///   excessive_thinning  the sheet is thinner than allowed: 1 - h/h0 above max_thinning
///   strong_thickening   it is thicker than allowed: h/h0 - 1 above max_thickening
///   low_strain          both principal engineering strains are smaller in size than low_strain:
///                       the place is hardly stretched, will be soft to the touch and spring back
///   wrinkling_tendency  the sheet thickens (eps_1 + eps_2 < 0): the compression outweighs the
///                       tension, and where no tool holds the sheet flat it can buckle. Whether it
///                       does, no membrane theory tells
///   safe                none of these
/// Numbers rise with what is at stake, so the worst of several zones is the greatest.
enum class Zone {
    safe = 0,
    low_strain = 1,
    wrinkling_tendency = 2,
    strong_thickening = 3,
    excessive_thinning = 4,
    marginal = 5,
    risk = 6,
    crack = 7
};
inline constexpr int zone_count = 8;
inline constexpr Zone all_zones[] = {Zone::crack,
                                     Zone::risk,
                                     Zone::marginal,
                                     Zone::excessive_thinning,
                                     Zone::strong_thickening,
                                     Zone::wrinkling_tendency,
                                     Zone::low_strain,
                                     Zone::safe};
std::string_view name(Zone zone); ///< as in files: "excessive_thinning"

/// Where the zones begin. Strains and shares as fractions.
struct ZoneOptions {
    double margin = 0.10;         ///< points of engineering major strain below the curve; half of
                                  ///< it is at risk
    double max_thinning = 0.25;   ///< of the initial thickness
    double max_thickening = 0.10; ///< of the initial thickness
    double low_strain = 0.02;     ///< engineering
    int most_spots = 20;

    friend bool operator==(const ZoneOptions&, const ZoneOptions&) = default;
};

/// A zone in words, with its numbers: "below the curve by less than 10 percentage points ...".
std::string definition(Zone zone, const ZoneOptions& options);

struct ZoneShare {
    int faces = 0;
    double area_mm2 = 0; ///< of the part
    double share = 0;    ///< of the part's area
};

/// The worst face of a connected region of one zone. Low strain and safe have none.
struct WorstSpot {
    Zone zone = Zone::safe;
    int face = 0;                      ///< of the part
    Eigen::Vector3d position;          ///< mm, middle of the face on the part
    double value;                      ///< crack, risk, marginal: distance to the curve; else
                                       ///< thinning or thickening, whatever the zone is about
    double strain_major, strain_minor; ///< logarithmic
    double thinning;
    int region_faces;       ///< in the region
    double region_area_mm2; ///< of the part
};

struct Zones {
    std::vector<Zone> zone; ///< per face
    /// per face, engineering major strain that is left up to the curve at the same minor strain,
    /// below 0 beyond it; no number where the sheet has no curve; empty if there is none at all
    Eigen::VectorXd distance;
    std::array<ZoneShare, zone_count> share; ///< by the number of the zone
    std::vector<WorstSpot> spots;            ///< worst zone first, in it worst value first
};

/// Sorts the faces of a part by what forming does to them.
/// @param face  one entry per face
/// @param curve null: no place cracks or is at risk, for all that is known
/// @throws InputError if the fields are not those of the part, or an option is not as described
Zones zones(const TriMesh& part, const SheetFields& face, const FormingLimitCurve* curve,
            const ZoneOptions& options = {});

/// The worst zone of the faces around each vertex.
std::vector<Zone> zones_at_vertices(const TriMesh& part, const std::vector<Zone>& of_face);

struct LimitsOptions {
    enum class Source {
        automatic,      ///< the grade's own points (Material::limit), else Keeler-Brazier for
                        ///< steel, none for other metals
        keeler_brazier, ///< whatever the metal; a note says where it is not made for it
        points,         ///< `curve`, for all faces
        none
    };
    Source source = Source::automatic;
    FormingLimitCurve curve = {};      ///< for Source::points
    std::optional<double> n = {};      ///< of the base sheet, for Keeler-Brazier; else that of its
                                       ///< grade or its law
    std::optional<double> margin = {}; ///< of all faces; else 0.10, and 0.08 where the sheet is
                                       ///< aluminium
    ZoneOptions zones = {};            ///< its margin is overwritten

    friend bool operator==(const LimitsOptions&, const LimitsOptions&) = default;
};

/// What the faces of a tailored piece were judged by.
struct PieceLimits {
    std::string name;     ///< of the piece
    std::string material; ///< of the piece
    double thickness;     ///< mm, flat
    int faces;            ///< judged so: those that no later piece covers
    std::optional<FormingLimitCurve> curve;
    double margin;
};

/// The forming limits of a solved part.
struct LimitsResult {
    std::optional<FormingLimitCurve> curve; ///< of the base sheet
    ZoneOptions settings;                   ///< as used; the margin is that of the base sheet
    std::vector<PieceLimits> pieces;        ///< of a tailored blank, in the order of its pieces
    Zones zones;
    int beyond_curve = 0;           ///< faces whose minor strain lies outside the points of their
                                    ///< curve
    std::vector<std::string> notes; ///< what to mind, in words
};

/// Judges a formed sheet: the curve by the options, and the zones by it. The n of Keeler-Brazier is
/// that of the options, else of the grade (Material::limit), else the uniform strain of the
/// hardening law, which for Hollomon's law is its n [Considere 1885].
/// @param face  one entry per face; @param material, thickness  of the base sheet; mm, flat
/// @param pieces  of a tailored blank: each face has the curve and the margin of its own grade and
/// gauge; where two
///                overlap the later one counts
/// @throws InputError if there is no curve for a sheet, a piece has faces that are none, or an
/// option is not as described
LimitsResult forming_limits(const TriMesh& part, const SheetFields& face, const Material& material, double thickness,
                            const LimitsOptions& options = {}, std::span<const TailoredPiece> pieces = {});

} // namespace spia

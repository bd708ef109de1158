#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/step_friction.h"
#include "app/viewer/model/document/step_target.h"
#include "engine/mesh/closest_point.h"

/// What the user picked on a part, kept so that it is found again: on the same part exactly, by the
/// numbers of the part's file; on a part that was changed (meshed anew, renumbered, a flange moved)
/// by its geometry.
namespace spia::viewer {

/// Some faces of a part.
struct StoredPatch {
    std::vector<int> face;     ///< numbers in the file, ascending
    std::vector<int> piece;    ///< per face: which triangle, where the file's face was split;
                               ///< empty: 0 for all
    Eigen::Matrix3Xd point;    ///< mm, the corners of the triangles
    Eigen::Matrix3Xi triangle; ///< per face, into `point`
};

struct StoredRegion {
    std::string name;
    RegionKind kind = RegionKind::other;
    Colour colour{};
    StoredPatch patch;
    std::optional<ToolContact> contact = {};
    std::optional<OwnSheet> sheet = {};
};

struct StoredProbe {
    int face = 0, piece = 0; ///< as in StoredPatch
    Eigen::Vector3d barycentric{1. / 3, 1. / 3, 1. / 3};
    Eigen::Vector3d at{0, 0, 0};     ///< mm
    Eigen::Vector3d normal{0, 0, 1}; ///< unit, of the face
};

struct StoredMeasurement {
    MeasureKind kind = MeasureKind::distance;
    std::vector<StoredProbe> at;
};

struct StoredCorner {
    int vertex = 0;              ///< number in the file
    Eigen::Vector3d at{0, 0, 0}; ///< mm
};

struct StoredVertex {
    int vertex = 0;                  ///< number in the file
    bool boundary = false;           ///< of the outline or a hole
    Eigen::Vector3d at{0, 0, 0};     ///< mm
    Eigen::Vector3d normal{0, 0, 1}; ///< unit, the mean of its faces'; 0 where they cancel
};

/// One step of unfolding: its faces are those of some patches.
struct StoredStep {
    UnfoldKind kind = UnfoldKind::lay;
    std::string name;
    std::vector<int> fixed, freed, carrying, rubbing; ///< into StoredSteps::patch
    double within_mm = 0, offset_mm = 0;
    std::optional<double> extent_mm, tolerance;
    std::optional<int> most_energy_steps, most_newton_steps;
    StepTarget target;
    std::optional<StepFriction> friction; ///< on the rubbing patches, on all that it moves if there
                                          ///< are none
    bool carrying_lost = false;           ///< as PlannedStep
};

/// The steps of unfolding. Faces that all steps treat alike are stored once.
struct StoredSteps {
    std::vector<StoredPatch> patch;
    std::vector<StoredStep> step;
    bool proposed = false;   ///< as they were proposed, none edited
    std::optional<int> root; ///< of the proposal; not given: automatic
};

struct StoredPicks {
    std::string fingerprint; ///< of the part they were made on, see fingerprint()
    StoredPatch selected;
    std::vector<StoredVertex> vertices;
    std::vector<StoredRegion> regions;
    std::vector<StoredProbe> probes;
    std::vector<StoredMeasurement> measurements;
    std::vector<ProcessLine> lines;                     ///< by their places
    std::optional<std::array<StoredCorner, 4>> corners; ///< of the grid, where the user chose them
    StoredSteps steps;
};

/// The part that picks belong to. @throws InputError if none is open
const PartFile& picked_part(const Document& document);

/// The same for two meshes with the same coordinates, triangles and numbers in the file, and
/// practically only for these.
std::string fingerprint(const PartFile& part);

/// @throws InputError if a face is none of the part
StoredPatch store_patch(const PartFile& part, const std::vector<int>& triangles);

/// @throws InputError if the document has no part, or a pick names a face, vertex or corner that
/// the part does not have
StoredPicks store_picks(const Document& document);

/// Puts the picks into a document whose part has been read: selection, vertices, regions, probes,
/// measurements, and the corners of the session's options. On a changed part a face belongs to a
/// patch where its middle lies on one of the patch's old triangles: no farther off than 1 % of the
/// part's diagonal, and with a normal within 60 degrees. A corner is the nearest vertex of the
/// outer boundary. A step of unfolding that has no faces to move any more is left out; one that has
/// none left of those that carried its target is marked so, and friction of which all faces are
/// gone is dropped. A vertex of any boundary is the nearest one there, another one the nearest of
/// the face that has come to its place. A line of the process moves to the nearest places of the
/// part, if all are within those 1 %.
/// @param search  of that part's mesh; null: made if need be
/// @returns in words what was not found (again); empty if the part is the same, or all was found
/// @throws InputError if the document has no part, or the picks make no sense
std::vector<std::string> restore_picks(Document& document, const StoredPicks& picks,
                                       std::shared_ptr<const ClosestPointSearch> search = nullptr);

} // namespace spia::viewer

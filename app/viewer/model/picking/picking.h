#pragma once
#include <optional>
#include <vector>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/picking/camera.h"
#include "app/viewer/model/picking/clip_plane.h"
#include "engine/forming/blank.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/region.h"
#include "engine/mesh/tri_mesh.h"

/// What a view shows at a pixel, and which faces a tool takes there. The mesh is the part or its
/// flat_mesh() (they have the same faces), the picker is built of it, the camera is that of the
/// view. What a clipping plane cuts away is not there.
namespace spia::viewer {

/// What is hit first from the viewer's side; face -1: nothing.
RayHit hit_at(const Camera& camera, const RayPicker& picker, glm::dvec2 pixel, glm::dvec2 size,
              const std::optional<HalfSpace>& kept = {});

/// The face under the pixel, or what is flooded from it; empty where there is none.
/// @param part_regions of the part, also if the view shows the blank, which has no angles
FaceSet faces_at(const PickAt& pick, const Camera& camera, const RayPicker& picker, const RegionSearch& part_regions,
                 const std::optional<HalfSpace>& kept = {});

/// Faces whose middle lies inside the polygon (even-odd rule) and is not hidden by another face;
/// with `through` hidden ones too. A face seen exactly from its edge counts as hidden, a face
/// behind the eye or the near plane never counts.
FaceSet faces_in(const PickArea& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                 const std::optional<HalfSpace>& kept = {});

/// Likewise in the circle of the brush, and always the face under its middle: on a coarse mesh a
/// brush may hold no middle.
FaceSet faces_under(const PickBrush& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                    const std::optional<HalfSpace>& kept = {});

/// The selection after picking some faces.
FaceSet picked(const FaceSet& selected, const FaceSet& faces, PickMode mode);

/// A place to watch: what is hit first at the pixel, or the vertex of that face within `snap`
/// pixels of it.
std::optional<Probe> probe_at(const Camera& camera, const TriMesh& mesh, const RayPicker& picker, glm::dvec2 pixel,
                              glm::dvec2 size, double snap = 8, const std::optional<HalfSpace>& kept = {});

inline constexpr double turn_reaches[] = {0.01, 0.03}; ///< of a boundary's length, to each side of
                                                       ///< a turn

/// The places of a closed boundary where it turns sharply and more than all around. A rounded
/// corner has one, in its middle.
/// @param turn radians per place, the mean over turn_reaches; @param place 2 or 3 by n, mm; @param
/// perimeter mm
std::vector<int> sharp_turns(const std::vector<double>& turn, const Eigen::MatrixXd& place, double perimeter);

/// The outer boundary of a blank, prepared for dragging a corner along it.
struct CornerTrack {
    std::vector<int> vertex; ///< of the part, counter-clockwise
    std::vector<int> sharp;  ///< of these the ones where the outline turns sharply outwards
    Eigen::Matrix2Xd place;  ///< 2 by #vertex, mm
};

/// @throws InputError if the blank has no outer boundary
CornerTrack corner_track(const TriMesh& part, const Blank& blank);

/// The vertex of the outline that is nearest to the pixel in the view of the blank; a sharp turn
/// within `snap` pixels goes before it.
int nearest_boundary_vertex(const CornerTrack& track, const Camera& camera, glm::dvec2 pixel, glm::dvec2 size,
                            double snap = 12);

} // namespace spia::viewer

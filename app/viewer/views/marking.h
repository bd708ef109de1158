#pragma once
#include "app/viewer/views/scene_cache.h"

/// What is drawn onto a sheet: marked faces, their outlines, watched places, extreme values.
namespace spia::viewer {

/// @return null if no face is marked
std::shared_ptr<const FaceMarks> face_marks(int faces, const std::vector<int>& selected,
                                            const std::vector<FaceRegion>& regions);

/// The face under the mouse is to be drawn over the scene, which stays as it is: a fine mesh is not
/// drawn again for it.
/// @param position 3 by #V of the part, mm: on the part, flat or on the way
void add_hovered(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position);

/// A ring around the face that the views went to.
/// @param position as of add_hovered()
void add_spot(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position);

/// Colours of the regions by number, as many as face_marks() tells apart.
std::vector<Colour> region_colours(const std::vector<FaceRegion>& regions);

/// Lines around a set of faces with a dark casing: white on it, they are seen on every colour.
/// @param faces ascending; numbers that the mesh does not have are left out
LineList outline_of_faces(const SceneMesh& mesh, const std::vector<int>& faces, float width, bool on_top,
                          const Colour& core = {1, 1, 1, 1});

/// The border of each region in its colour.
LineList region_borders(const SceneMesh& mesh, const std::vector<FaceRegion>& regions);

/// The name of each region on the face that is nearest to its middle.
/// @param position 3 by #V of the part, mm: on the part or flat
std::vector<SceneLabel> region_labels(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix3Xd& position,
                                      const std::vector<FaceRegion>& regions, bool dark,
                                      LengthUnit lengths = LengthUnit::mm);

/// Place of barycentric coordinates on a face, mm.
Eigen::Vector3d place_on(const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle, int face,
                         const Eigen::Vector3d& barycentric);

/// What stands at the least and the greatest value: "min 0.1", and of thinning and thickness
/// "thinnest 0.620 mm (38.0 %)".
std::string extreme_words(const ViewerState& state, int face, double value, bool greatest);

/// Dots and texts of the pinned probes and, if asked for, of the least and the greatest value.
/// @param position 3 by #V of the part, mm: on the part or flat
void add_watched_places(Scene& scene, const ViewerState& state, const FieldValues* values,
                        const Eigen::Matrix3Xd& position);

} // namespace spia::viewer

#pragma once
#include <Eigen/Core>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/picking/camera.h"
#include "app/viewer/views/label_layout.h"

namespace spia::viewer {

/// The lines of some levels of a field that is linear in each face, joined across the faces: each
/// runs until it meets the border of the mesh or itself. A level that a whole face has gives its
/// rim. Faces with a value that is no number are left out.
/// @param position 3 by #V, mm; @param value one per vertex; @param level ascending
std::vector<Isoline> isolines(const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle,
                              const Eigen::VectorXd& value, const std::vector<double>& level);

/// A value written onto its line.
struct IsolineLabel {
    std::string text;
    PixelBox box;
};

/// Whether the sheet hides a place: pixels, and its depth as of pixel_of().
using Hidden = std::function<bool(const glm::dvec3& place)>;

/// Places for the values of isolines, as on a map: a few on each line, where it runs straight, in
/// sight and well apart from each other. Long lines choose first. The same input gives the same
/// places.
/// @param size   of the view, pixels
/// @param text   what is written for a value, and its size in pixels
/// @param taken  what is there already
/// @param scale  of the screen
std::vector<IsolineLabel> isoline_labels(const std::vector<Isoline>& lines, const Camera& camera, glm::dvec2 size,
                                         const std::function<std::pair<std::string, glm::dvec2>(double)>& text,
                                         const Hidden& hidden, const std::vector<PixelBox>& taken, double scale = 1);

} // namespace spia::viewer

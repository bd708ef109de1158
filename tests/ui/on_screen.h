#pragma once
#include <Eigen/Core>
#include <glm/glm.hpp>

#include "app/viewer/model/document/view.h"
#include "engine/core/json_file.h"

/// Where things are in the window, in its pixels, by a report of the program.
namespace spia::viewer {

/// A place in the picture of a view, by shares of its width and height.
glm::dvec2 in_view(const Json& report, View view, double x, double y);

/// A place of the part, of the surface, or with z = 0 of the blank. @param place  mm
glm::dvec2 on_screen(const Json& report, View view, const Eigen::Vector3d& place);

} // namespace spia::viewer

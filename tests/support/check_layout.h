#pragma once
#include <string>

#include "engine/layout/layout.h"

namespace spia::shapes {

/// What is wrong with a layout, empty if nothing: every curve is a side of two patches, of one on
/// the border; as many loops of border as the part has; areas that add up to the blank's. Checked
/// without the layout's code but for its areas.
std::string fault_of_layout(const Layout& layout, const TriMesh& part, const Blank& blank);

/// The vertex nearest to a place of the blank.
int vertex_near(const Blank& blank, double x, double y);

} // namespace spia::shapes

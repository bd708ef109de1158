#pragma once
#include <GLFW/glfw3.h>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

/// A tool as the bar has it.
struct ToolButton {
    Tool tool;
    const char* label;
    char letter; ///< its key
    const char* help;
    bool begins_group = false;
    int key() const { return GLFW_KEY_A + (letter - 'A'); }
};

/// In the order of the bar: looking, faces, vertices and corners, measuring, drawing and shaping.
inline constexpr ToolButton tools[] = {
    {Tool::look, "Look", 'V', "Nothing is picked: the mouse turns, pans and zooms."},
    {Tool::pick, "Face", 'P', "Pick single faces; Shift adds, Ctrl takes away.", true},
    {Tool::box, "Box", 'B', "Pick all faces in a box."},
    {Tool::lasso, "Lasso", 'L', "Pick all faces inside a drawn line."},
    {Tool::brush, "Brush", 'U', "Paint faces."},
    {Tool::flood, "Flood", 'R', "Pick all around a face up to an angle between neighbours."},
    {Tool::smooth_region, "Smooth", 'N', "Pick the smooth piece of sheet around a face."},
    {Tool::vertex, "Vertex", 'D', "Pick vertices; two show their distance. Shift adds, Ctrl takes away.", true},
    {Tool::outline, "Outline", 'G',
     "Pick vertices of the outline and the holes; sharp turns attract the mouse. Four of the outline can become the corners "
     "of the grid."},
    {Tool::corners, "Corners", 'C', "Drag the four corners along the outline of the blank."},
    {Tool::probe, "Probe", 'O', "Pin the value at a point.", true},
    {Tool::section, "Section", 'X', "Draw a line: the field is plotted along the cut."},
    {Tool::measure, "Measure", 'M',
     "Measure distances, angles and radii on the part; Escape drops what was clicked so far."},
    {Tool::line, "Line", 'W',
     "Draw a drawbead, a pilot or a seam on the part, point by point; Return or a double click ends it, Escape drops "
     "it.",
     true},
    {Tool::shape, "Shape", 'K',
     "Pick control points of the surface, or points of its lattice, and drag them; Shift adds, Ctrl takes away."},
};

} // namespace spia::viewer

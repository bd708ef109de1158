#pragma once
#include <imgui.h>
#include <string>
#include <vector>

#include "app/viewer/model/document/grades.h"

namespace spia::viewer {

struct Frame;

/// Axes of true stress (MPa) over plastic strain, both from 0.
struct StressPlot {
    ImVec2 low, high;      ///< pixels: least and greatest values; high lies above
    double strain, stress; ///< at the ends of the axes

    ImVec2 place(double at_strain, double at_stress) const;
    double strain_at(float x) const;
    bool holds(ImVec2 at) const { return at.x >= low.x && at.x <= high.x && at.y <= low.y && at.y >= high.y; }
};

/// Draws the axes with round numbers in the width that there is and takes the room.
/// @param height  pixels; @param strain, stress  that must lie within
StressPlot stress_plot(const Frame& frame, float height, double strain, double stress, const std::string& title);

/// Drawn through, or in dashes of these pixels with gaps of half of that.
void draw_curve(const StressPlot& plot, const FlowCurve& curve, ImU32 colour, float width, float dash = 0);
void draw_dashed(ImDrawList* draw, const std::vector<ImVec2>& line, ImU32 colour, float width, float dash);

} // namespace spia::viewer

#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace spia {

struct ChartCurve {
    std::string label;  ///< beside its line in the key; empty: none
    std::string colour; ///< of CSS
    std::vector<Eigen::Vector2d> points;
    bool dots = false;   ///< one at every point
    bool joined = true;  ///< by a line
    bool dashed = false; ///< the line
};

/// A value on the horizontal axis that is worth a line.
struct ChartMark {
    double x;
    std::string label;
};

/// A small diagram for reports.
struct Chart {
    std::string x_label, y_label; ///< with their units
    bool logarithmic = false;     ///< the vertical axis; what is not positive is left out
    bool from_zero = false;       ///< the vertical axis begins at 0
    std::vector<ChartCurve> curves;
    std::vector<ChartMark> marks = {};
};

/// An <svg> element without outer references, 360 by 210 units; empty if there is nothing to draw.
std::string svg(const Chart& chart);

} // namespace spia

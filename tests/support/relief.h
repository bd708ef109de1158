#pragma once

namespace spia::shapes {

/// The wall of a pocket, a bead or an emboss: how far the surface has sunk at a distance t outside
/// the upper edge. Zero for t <= 0, then an arc, a straight wall, an arc back to level; smooth
/// (C1).
class Step {
public:
    /// @param angle_deg  slope of the wall; less where two arcs alone are already `depth` deep
    /// @param radius     mm, of both arcs
    Step(double depth, double angle_deg, double radius);

    double operator()(double t) const;

    double depth() const { return depth_; }
    double run() const { return run_; } ///< mm from the upper to the lower edge, seen from above

private:
    double depth_, radius_, arc_run_, run_, slope_;
};

} // namespace spia::shapes

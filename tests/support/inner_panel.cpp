#include "tests/support/inner_panel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/relief.h"

namespace spia::shapes {
namespace {

using Eigen::Vector2d;

// The layout, mm, seen from above with the origin in the middle of the panel.
const Vector2d panel_half(300, 200), plateau_half(245, 145);
constexpr double panel_corner = 40, plateau_corner = 50, draw_radius = 8;
constexpr double crown_x = 4000, crown_y = 3000; // radii of curvature

struct Box {
    Vector2d centre, half;
    double corner;

    double distance(const Vector2d& p) const { return box_distance(p, centre, half, corner); }
};
const Box window{{-95, 20}, {70, 55}, 25};
const Box window_frame{{-95, 20}, {95, 78}, 40}; // the sunk floor around the window
const Box deep_pocket{{120, 62}, {68, 45}, 25};
const Box wide_pocket{{120, -75}, {75, 38}, 22};

struct Bead {
    Vector2d from, to;
};
const std::vector<Bead> beads = {{{-190, -92}, {0, -92}},
                                 {{-190, -124}, {0, -124}}, // on the plateau
                                 {{80, -90}, {80, -60}},
                                 {{120, -90}, {120, -60}},
                                 {{160, -90}, {160, -60}}}; // in the wide pocket
constexpr double bead_top = 3;                              // half width of the ridge

const std::vector<Circle> embosses = {{{120, 62}, 20}, {{-223, -92}, 6}}; // their flat tops
const std::vector<Circle> holes = {{{120, 62}, 8},     {{70, 88}, 5},      {{170, 36}, 5},    {{225, -5}, 7},
                                   {{-223, -40}, 5},   {{-223, 60}, 5},    {{284, 100}, 5.5}, {{284, -100}, 5.5},
                                   {{-284, 100}, 5.5}, {{-284, -100}, 5.5}};

/// The height of the sheet after everything has been pressed into it.
class Relief {
public:
    explicit Relief(const InnerPanel& shape) : draw_(shape.depth, shape.wall_angle_deg, draw_radius) {}

    double operator()(const Vector2d& p) const
    {
        double z = -p.x() * p.x() / (2 * crown_x) - p.y() * p.y() / (2 * crown_y);
        z -= draw_(box_distance(p, {0, 0}, plateau_half, plateau_corner));
        z -= frame_.depth() - frame_(window_frame.distance(p));
        z -= deep_.depth() - deep_(deep_pocket.distance(p));
        z -= wide_.depth() - wide_(wide_pocket.distance(p));
        for (const Bead& bead : beads)
            z += bead_.depth() - bead_(capsule_distance(p, bead.from, bead.to, bead_top));
        for (const Circle& emboss : embosses)
            z += emboss_.depth() - emboss_(emboss.distance(p));
        return z;
    }

private:
    Step draw_, frame_{10, 60, 6}, deep_{14, 70, 5}, wide_{8, 45, 6}, bead_{5, 60, 5}, emboss_{4, 60, 5};
};

Region outline()
{
    Region region;
    region.distance = [](const Vector2d& p) {
        double d = std::max(box_distance(p, {0, 0}, panel_half, panel_corner), -window.distance(p));
        for (const Circle& hole : holes)
            d = std::max(d, -hole.distance(p));
        return d;
    };
    region.low = -panel_half;
    region.high = panel_half;
    region.smallest_feature = 5;
    return region;
}

} // namespace

ParametricMesh inner_panel(const InnerPanel& shape)
{
    const Relief relief(shape);
    const auto near_holes = edges_around(holes);
    return mesh_surface(
        outline(), [&](const Vector2d& p) { return Eigen::Vector3d(p.x(), p.y(), relief(p)); }, shape.triangles,
        [&](const Vector2d& p) { return std::min(near_holes(p), window.corner / 2 + std::abs(window.distance(p))); });
}

} // namespace spia::shapes

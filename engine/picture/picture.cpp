#include "engine/picture/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/atomic_file.h"
#include "engine/core/colour_map.h"
#include "engine/core/small_dense.h"
#include "engine/core/text.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "engine/picture/canvas.h"

namespace spia {
namespace {

using Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::Vector2d, Eigen::Vector3d;

// Pixels. A panel is a title, a line that tells sizes, and the shape below.
constexpr int panel_width = 500, panel_height = 460, legend_height = 100;
constexpr double margin = 24, head = 78;

const Vector3d ink(0.13, 0.16, 0.2), pale_ink(0.42, 0.46, 0.5), quad_colour(0.9, 0.92, 0.94),
    surface_colour(0.62, 0.75, 0.88), net_colour(0.78, 0.18, 0.12);

/// The direction in which points spread widest across `up`; on a round spread, the coordinate axis
/// nearest to that plane.
Vector3d long_axis(const Matrix3Xd& points, const Vector3d& up)
{
    const Matrix3Xd centred = points.colwise() - points.rowwise().mean();
    const Matrix3d across = Matrix3d::Identity() - up * up.transpose();
    const EigenPairs<3> spread = eigen_pairs(across * (centred * centred.transpose()) * across);
    Vector3d axis = spread.vector.col(2);
    if (spread.value[2] < 1.2 * spread.value[1])
        axis = (across * (std::abs(up.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY())).normalized();
    Eigen::Index largest;
    axis.cwiseAbs().maxCoeff(&largest);
    return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

/// Rows right, up and towards the viewer: slightly from above and from one side.
Matrix3d view_of(const TriMesh& mesh)
{
    const Vector3d sum = area_vectors(mesh).rowwise().sum();
    Vector3d up = sum.norm() > 0.2 * area(mesh) ? Vector3d(sum.normalized()) : Vector3d::UnitZ();
    if (up.z() < -0.1)
        up = -up;
    const Vector3d along = long_axis(mesh.position, up), across = up.cross(along);
    constexpr double turn = 0.5, rise = 0.75; // radians
    const Vector3d right = std::cos(turn) * along + std::sin(turn) * across;
    const Vector3d back = right.cross(up);
    const Vector3d viewer = std::cos(rise) * back + std::sin(rise) * up;
    Matrix3d view;
    view << right.transpose(), viewer.cross(right).transpose(), viewer.transpose();
    return view;
}

/// One panel: where points of a shape come to lie on the canvas.
struct Panel {
    Canvas& canvas;
    Matrix3d view;
    double scale;           ///< pixels per mm
    Vector3d centre, place; ///< centre in view axes comes to place on the canvas

    Panel(Canvas& target, int number, const Matrix3d& view_axes, const Matrix3Xd& points)
        : canvas(target), view(view_axes)
    {
        const Matrix3Xd seen = view * points;
        const Vector3d low = seen.rowwise().minCoeff(), high = seen.rowwise().maxCoeff();
        const double width = panel_width - 2 * margin, height = panel_height - head - margin;
        scale = std::min(width / std::max(high.x() - low.x(), 1e-30), height / std::max(high.y() - low.y(), 1e-30));
        centre = (low + high) / 2;
        place = {(number + 0.5) * panel_width, head + height / 2, 0};
    }

    Matrix3Xd on_canvas(const Matrix3Xd& points) const
    {
        const Vector3d turned_down(1, -1, 1); // y runs down on the canvas
        return (turned_down.asDiagonal() * (scale * ((view * points).colwise() - centre))).colwise() + place;
    }
    void title(const std::string& name, const std::string& sizes) const
    {
        canvas.text(name, place.x(), 36, 16, ink, Canvas::Align::centre);
        canvas.text(sizes, place.x(), 62, 10.5, pale_ink, Canvas::Align::centre);
    }
};

/// A soft light from the upper left and one from the viewer; both sides of the sheet are lit, the
/// back is a little darker.
double brightness(const Vector3d& seen_normal)
{
    const Vector3d light = Vector3d(-0.45, 0.6, 0.66).normalized();
    const bool back = seen_normal.z() < 0;
    const double key = std::max(0.0, (back ? -1 : 1) * seen_normal.dot(light));
    return (back ? 0.9 : 1) * (0.5 + 0.35 * key + 0.15 * std::abs(seen_normal.z()));
}

/// @param colour of a face and the barycentric coordinates in it
template <class Colour>
void draw_faces(const Panel& panel, const TriMesh& mesh, const Matrix3Xd& vertex_normal, const Colour& colour)
{
    const Matrix3Xd corner = panel.on_canvas(mesh.position), normal = panel.view * vertex_normal;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Vector3i t = mesh.triangle.col(f);
        panel.canvas.triangle(corner(Eigen::all, t), [&](const Vector3d& share) -> Vector3d {
            return brightness((normal(Eigen::all, t) * share).normalized()) * colour(t, share);
        });
    }
}

void draw_boundary(const Panel& panel, const TriMesh& mesh, double lift)
{
    const Matrix3Xd corner = panel.on_canvas(mesh.position);
    for (const std::vector<int>& loop : boundary_loops(mesh))
        for (size_t i = 0; i < loop.size(); ++i)
            panel.canvas.line(corner.col(loop[i]), corner.col(loop[(i + 1) % loop.size()]),
                              {.colour = ink, .width = 1.4, .lift = lift});
}

/// Light lines along the edges of the triangles, if there is room between them.
void draw_light_edges(const Panel& panel, const TriMesh& mesh, double lift)
{
    constexpr double least_room = 5; // pixels
    const Matrix3Xd corner = panel.on_canvas(mesh.position);
    const double triangle_pixels = area(mesh) * panel.scale * panel.scale / mesh.triangles();
    if (std::sqrt(2 * triangle_pixels) < least_room)
        return;
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangle(k, f), b = mesh.triangle((k + 1) % 3, f);
            if (a < b) // the face on the other side has it from b to a; those of the boundary are
                       // drawn dark
                panel.canvas.line(corner.col(a), corner.col(b),
                                  {.colour = {1, 1, 1}, .width = 0.7, .opacity = 0.3, .lift = lift});
        }
}

/// How many grid lines to go on at a time so that no more than `most` are drawn.
int stride(int count, int most) { return std::max(1, (count + most - 1) / most); }

std::string strided(int step) { return step > 1 ? fmt::format(", every {}. line", step) : ""; }

/// The lines of a structured net of count_u by count_v points, every step-th and the last one of
/// each family.
void draw_net(const Panel& panel, const Matrix3Xd& points, int count_u, int count_v, int step, const Canvas::Pen& pen)
{
    const Matrix3Xd p = panel.on_canvas(points);
    const auto drawn = [&](int i, int count) { return i % step == 0 || i == count - 1; };
    const Eigen::Matrix2Xi lines = net_lines(count_u, count_v);
    for (const auto ends : lines.colwise()) {
        const bool along_u = ends[1] == ends[0] + 1;
        if (along_u ? drawn(ends[0] / count_u, count_v) : drawn(ends[0] % count_u, count_u))
            panel.canvas.line(p.col(ends[0]), p.col(ends[1]), pen);
    }
}

/// The four sides of a patch.
void draw_sides(const Panel& panel, const NurbsSurface& patch, double lift)
{
    constexpr int pieces = 16; // of a side
    Matrix3Xd side(3, pieces + 1);
    for (const bool along_u : {true, false})
        for (const double across : {0., 1.}) {
            for (int k = 0; k <= pieces; ++k) {
                const double along = double(k) / pieces;
                side.col(k) = evaluate(patch, along_u ? along : across, along_u ? across : along).position;
            }
            const Matrix3Xd p = panel.on_canvas(side);
            for (int k = 0; k < pieces; ++k)
                panel.canvas.line(p.col(k), p.col(k + 1), {.colour = net_colour, .width = 1.1, .lift = lift});
        }
}

/// Round values (1, 2 or 5 times a power of ten apart) within the range, six to twelve of them as a
/// rule.
std::vector<double> round_values(const ColourRange& range)
{
    const double raw = (range.greatest - range.least) / 7;
    if (!(raw > 0))
        return {};
    const double power = std::pow(10, std::floor(std::log10(raw)));
    const double step = power * (raw < 1.5 * power ? 1 : raw < 3.5 * power ? 2 : raw < 7.5 * power ? 5 : 10);
    std::vector<double> values;
    for (double k = std::ceil(range.least / step); k * step <= range.greatest; ++k)
        values.push_back(k * step);
    return values;
}

/// A thin dark line where the value, linear over the triangle on the canvas, is one of the levels.
class Contour {
public:
    Contour(const Matrix3d& corner, const Vector3d& value, const std::vector<double>& levels)
        : value_(value), levels_(levels)
    {
        Eigen::Matrix2d edge;
        edge << (corner.col(1) - corner.col(0)).head<2>(), (corner.col(2) - corner.col(0)).head<2>();
        if (edge.determinant() != 0)
            slope_ = edge.transpose().inverse().operator*(Vector2d(value[1] - value[0], value[2] - value[0])).norm();
    }
    double darkness(const Vector3d& share) const
    {
        constexpr double half_width = 0.6; // pixels
        double nearest = INFINITY;
        for (const double level : levels_)
            nearest = std::min(nearest, std::abs(value_.dot(share) - level));
        return slope_ > 0 ? 0.55 * std::clamp(half_width + 0.5 - nearest / slope_, 0.0, 1.0) : 0;
    }

private:
    Vector3d value_;
    const std::vector<double>& levels_;
    double slope_ = 0; ///< per pixel
};

/// Rounding errors of strain (see noise() of the report) are worth no colour and no contour.
constexpr double least_half_width = 1e-4;

/// From the first to the last of a hundred equal shares: single extreme vertices must not take the
/// colours from the rest.
ColourRange central_range(const Eigen::VectorXd& values)
{
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const size_t cut = sorted.size() / 100;
    const double least = sorted[cut], greatest = sorted[sorted.size() - 1 - cut], middle = 0.5 * (least + greatest);
    return {std::min(least, middle - least_half_width), std::max(greatest, middle + least_half_width)};
}

/// None where all values are one but for rounding.
std::vector<double> contour_levels(const Eigen::VectorXd& values, const ColourRange& range)
{
    return values.maxCoeff() - values.minCoeff() > 2 * least_half_width ? round_values(range) : std::vector<double>{};
}

class Picture {
public:
    Picture(const ExportScene& scene, Panels panels, LengthUnit lengths)
        : scene_(scene), sheet_(panels != Panels::shape), quads_(panels != Panels::sheet && scene.quad_mesh),
          surface_(panels != Panels::sheet && (scene.surface || !scene.control_nets.empty())), lengths_(lengths),
          range_(central_range(scene.fields->thinning)), levels_(contour_levels(scene.fields->thinning, range_)),
          view_(view_of(*scene.part)), lift_(0.004 * bounding_diagonal(*scene.part)),
          canvas_((2 * sheet_ + quads_ + surface_) * panel_width, panel_height + sheet_ * legend_height)
    {
    }

    std::string png()
    {
        if (sheet_) {
            draw_part();
            draw_blank();
        }
        if (quads_)
            draw_quad_mesh(*scene_.quad_mesh);
        if (surface_)
            draw_surface();
        if (sheet_)
            draw_legend();
        return canvas_.png();
    }

private:
    /// Of the same shape as the part's panel, so that part, quads and surface can be compared.
    Panel next_panel() { return Panel(canvas_, panels_++, view_, scene_.part->position); }

    double lift_on(const Panel& panel) const { return lift_ * panel.scale; }

    Vector3d colour_of(double thinning) const { return viridis(range_.position(thinning)); }

    void draw_part()
    {
        const TriMesh& part = *scene_.part;
        const Panel panel = next_panel();
        draw_faces(panel, part, vertex_normals(part), [&](const Eigen::Vector3i& t, const Vector3d& share) {
            return colour_of(scene_.fields->thinning(t).dot(share));
        });
        draw_light_edges(panel, part, lift_on(panel));
        draw_boundary(panel, part, lift_on(panel));
        const Vector3d size =
            (part.position.rowwise().maxCoeff() - part.position.rowwise().minCoeff()) / millimetres(lengths_);
        panel.title("part", fmt::format("{} triangles, {:.4g} x {:.4g} x {:.4g} {}", part.triangles(), size.x(),
                                        size.y(), size.z(), name(lengths_)));
    }

    void draw_blank()
    {
        TriMesh flat{Matrix3Xd::Zero(3, scene_.part->vertices()), scene_.part->triangle};
        flat.position.topRows(2) = scene_.blank->position;
        // as it lies in the DXF
        const Panel panel(canvas_, panels_++, Matrix3d::Identity(), flat.position);
        const Matrix3Xd corner = panel.on_canvas(flat.position);
        for (int f = 0; f < flat.triangles(); ++f) {
            const Eigen::Vector3i t = flat.triangle.col(f);
            const Vector3d thinning = scene_.fields->thinning(t);
            const Contour contour(corner(Eigen::all, t), thinning, levels_);
            canvas_.triangle(corner(Eigen::all, t), [&](const Vector3d& share) -> Vector3d {
                const Vector3d colour = colour_of(thinning.dot(share));
                return colour + contour.darkness(share) * (ink - colour);
            });
        }
        draw_boundary(panel, flat, lift_on(panel));
        const Vector3d size =
            (flat.position.rowwise().maxCoeff() - flat.position.rowwise().minCoeff()) / millimetres(lengths_);
        panel.title("flat blank",
                    fmt::format("{:.4g} x {:.4g} {}, contours of thinning", size.x(), size.y(), name(lengths_)));
    }

    void draw_quad_mesh(const QuadGrid& grid)
    {
        const Panel panel = next_panel();
        const TriMesh cells = triangles_of(grid);
        draw_faces(panel, cells, vertex_normals(cells), [](const auto&, const auto&) { return quad_colour; });
        const int step = stride(std::max(grid.columns, grid.rows), 60);
        draw_net(panel, grid.position, grid.columns + 1, grid.rows + 1, step,
                 {.colour = {0.1, 0.25, 0.45}, .width = 1, .opacity = 0.85, .lift = lift_on(panel)});
        panel.title("quad mesh", fmt::format("{} x {} cells on the part{}", grid.columns, grid.rows, strided(step)));
    }

    void draw_surface()
    {
        const Panel panel = next_panel();
        std::string sizes = "in triangles";
        if (scene_.surface)
            draw_faces(panel, *scene_.surface,
                       scene_.surface_normal ? *scene_.surface_normal : vertex_normals(*scene_.surface),
                       [](const auto&, const auto&) { return surface_colour; });
        if (scene_.control_nets.size() > 1) { // their nets would hide the surface
            for (const NurbsSurface& net : scene_.control_nets)
                draw_sides(panel, net, lift_on(panel));
            sizes = counted(scene_.control_nets.size(), "patch", "patches");
        } else if (!scene_.control_nets.empty()) {
            const NurbsSurface* const net = &scene_.control_nets.front();
            const int step = stride(std::max(net->count_u, net->count_v), 40);
            for (const bool hidden : {false, true}) // faintly behind the surface, clearly before it
                draw_net(panel, net->control, net->count_u, net->count_v, step,
                         {.colour = net_colour,
                          .width = 1.1,
                          .opacity = hidden ? 0.85 : 0.2,
                          .hidden = hidden,
                          .lift = lift_on(panel)});
            if (step == 1) {
                const Matrix3Xd dots = panel.on_canvas(net->control);
                for (const auto dot : dots.colwise())
                    canvas_.line(dot, dot, {.colour = net_colour, .width = 3.2, .lift = 2 * lift_on(panel)});
            }
            sizes = fmt::format("{} x {} control points, degree {} x {}{}", net->count_u, net->count_v, net->degree_u,
                                net->degree_v, strided(step));
        }
        panel.title("NURBS surface", sizes);
    }

    void draw_legend()
    {
        const double left = panel_width - 300, right = panel_width + 300, top = panel_height + 34, bottom = top + 16;
        for (double x = left; x < right; x += 0.5)
            canvas_.rectangle(x, top, x + 0.5, bottom, viridis((x - left) / (right - left)));
        const ColourRange all = colour_range(scene_.fields->thinning);
        if (all.least < range_.least)
            draw_more(left - 3, -10, top, bottom, 0);
        if (all.greatest > range_.greatest)
            draw_more(right + 3, 10, top, bottom, 1);

        const double step = levels_.size() > 1 ? 100 * (levels_[1] - levels_[0]) : 1;
        const int digits = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
        const auto percent = [](double value, int places) {
            const std::string text = fmt::format("{:.{}f}", 100 * value, places);
            return text.find_first_of("123456789") == std::string::npos && text[0] == '-' ? text.substr(1) : text;
        };
        for (const double level : levels_) {
            const double x = left + range_.position(level) * (right - left);
            canvas_.line({x, bottom, 0}, {x, bottom + 5, 0}, {.colour = ink, .width = 1, .hidden = false});
            canvas_.text(percent(level, digits), x, bottom + 20, 10, ink, Canvas::Align::centre);
        }
        canvas_.text(fmt::format("min. {} %", percent(all.least, digits + 1)), left, top - 8, 10, pale_ink);
        canvas_.text("thinning in %", panel_width, top - 8, 11.5, ink, Canvas::Align::centre);
        canvas_.text(fmt::format("max. {} %", percent(all.greatest, digits + 1)), right, top - 8, 10, pale_ink,
                     Canvas::Align::right);
    }

    /// The sign that there are values beyond the end of the legend: a triangle of that end's
    /// colour.
    void draw_more(double x, double length, double top, double bottom, double end)
    {
        Matrix3d corner;
        corner << x, x, x + length, top, bottom, (top + bottom) / 2, 0, 0, 0;
        canvas_.triangle(corner, [&](const Vector3d&) { return viridis(end); });
    }

    const ExportScene& scene_;
    const bool sheet_, quads_, surface_; ///< which panels there are
    const LengthUnit lengths_;
    const ColourRange range_; ///< of thinning; values beyond it have the colours of its ends
    const std::vector<double> levels_;
    const Matrix3d view_;
    const double lift_; ///< mm
    Canvas canvas_;
    int panels_ = 0;
};

} // namespace

std::string picture_png(const ExportScene& scene, Panels panels, LengthUnit lengths)
{
    require_complete(scene);
    const bool shape = scene.quad_mesh || scene.surface || !scene.control_nets.empty();
    return panels == Panels::shape && !shape ? "" : Picture(scene, panels, lengths).png();
}

void write_picture(const std::filesystem::path& path, const ExportScene& scene)
{
    write_atomically(path, picture_png(scene));
}

} // namespace spia

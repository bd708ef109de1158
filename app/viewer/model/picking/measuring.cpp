#include "app/viewer/model/picking/measuring.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/model/picking/curvature_at.h"
#include "engine/core/error.h"
#include "engine/forming/flat_mesh.h"
#include "engine/mesh/vectors.h"
#include "engine/report/text/lengths.h"
#include "engine/unfold/target/fit_target.h"

namespace spia::viewer {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

Eigen::Matrix3d corners(const TriMesh& part, int face) { return part.position(Eigen::all, part.triangle.col(face)); }
Vector3d place(const TriMesh& part, const Probe& probe) { return corners(part, probe.face) * probe.barycentric; }
Vector3d normal(const TriMesh& part, int face)
{
    const Eigen::Matrix3d c = corners(part, face);
    return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).normalized();
}

std::vector<double> numbers(const Vector3d& at) { return {at[0] + 0., at[1] + 0., at[2] + 0.}; }

Eigen::Matrix3Xd polyline(const std::vector<Vector3d>& point)
{
    Eigen::Matrix3Xd line(3, Eigen::Index(point.size()));
    for (size_t i = 0; i < point.size(); ++i)
        line.col(Eigen::Index(i)) = point[i];
    return line;
}

/// An arc about a middle that begins at an arm and turns about an axis square to it.
Eigen::Matrix3Xd arc(const Vector3d& middle, const Vector3d& arm, const Vector3d& axis, double angle)
{
    constexpr double step = 5 * degree;
    const int pieces = std::max(1, int(std::ceil(angle / step)));
    std::vector<Vector3d> point;
    for (int k = 0; k <= pieces; ++k)
        point.push_back(middle + Eigen::AngleAxisd(angle * k / pieces, axis) * arm);
    return polyline(point);
}

Measured distance(const Vector3d& a, const Vector3d& b)
{
    const Vector3d way = b - a;
    Measured found;
    found.value = way.norm();
    found.more = {{"Along x, y, z", numbers(way.cwiseAbs())}};
    found.line = {polyline({a, b})};
    found.label = (a + b) / 2;
    return found;
}

Measured angle(const Vector3d& a, const Vector3d& tip, const Vector3d& b)
{
    const Vector3d to_a = a - tip, to_b = b - tip;
    if (!(to_a.norm() > 0) || !(to_b.norm() > 0))
        throw InputError("Two of the three points are the same; an angle needs three.");
    Measured found;
    const double radians = angle_between(to_a, to_b);
    found.value = radians / degree;
    found.more = {{"Sides", {to_a.norm(), to_b.norm()}}};
    found.line = {polyline({a, tip, b})};
    Vector3d axis = to_a.cross(to_b);
    axis = axis.norm() > 1e-12 * to_a.norm() * to_b.norm() ? axis.normalized() : to_a.unitOrthogonal();
    const double reach = 0.4 * std::min(to_a.norm(), to_b.norm());
    found.line.push_back(arc(tip, reach * to_a.normalized(), axis, radians));
    found.label = tip + Eigen::AngleAxisd(radians / 2, axis) * (reach * to_a.normalized());
    return found;
}

Measured between_faces(const TriMesh& part, const Probe& first, const Probe& second)
{
    if (first.face == second.face)
        throw InputError("Both clicks are on the same face; an angle between faces needs two.");
    const Vector3d a = place(part, first), b = place(part, second);
    Measured found;
    found.value = angle_between(normal(part, first.face), normal(part, second.face)) / degree;
    found.more = {{"Between their outer sides", {}, fmt::format("{:.2f} deg", 180 - found.value)}};
    // The normals, as long as they are told from the faces.
    const double length = 0.3 * (b - a).norm();
    found.line = {polyline({a, b}), polyline({a, a + length * normal(part, first.face)}),
                  polyline({b, b + length * normal(part, second.face)})};
    found.label = (a + b) / 2;
    return found;
}

Measured circle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
    const Vector3d to_b = b - a, to_c = c - a, across = to_b.cross(to_c);
    constexpr double straight = 1e-6; // radians; on a flat sheet places read from a file are no
                                      // nearer to a line
    if (!(across.norm() > straight * to_b.norm() * to_c.norm()))
        throw InputError("These three points lie on a straight line: no circle goes through them.");
    // The circumcentre of a triangle.
    const Vector3d arm = (to_c.squaredNorm() * across.cross(to_b) + to_b.squaredNorm() * to_c.cross(across)) /
                         (2 * across.squaredNorm());
    const Vector3d middle = a + arm;
    Measured found;
    found.value = arm.norm();
    found.more = {{"Diameter", {2 * found.value}}, {"Centre", numbers(middle)}};
    found.line = {arc(middle, -arm, across.normalized(), 2 * std::numbers::pi), polyline({middle, b})};
    found.label = (middle + b) / 2;
    return found;
}

/// How far the sheet goes around the axis, radians: all of the circle but its widest gap.
double swept(const TriMesh& part, const FaceSet& faces, const CylinderFace& cylinder)
{
    const Vector3d x = cylinder.towards, y = cylinder.axis.cross(x);
    std::vector<double> angle;
    for (const int f : faces)
        for (const int v : part.triangle.col(f)) {
            const Vector3d arm = part.position.col(v) - cylinder.origin;
            angle.push_back(std::atan2(y.dot(arm), x.dot(arm)));
        }
    std::sort(angle.begin(), angle.end());
    double gap = angle.front() + 2 * std::numbers::pi - angle.back();
    for (size_t k = 1; k < angle.size(); ++k)
        gap = std::max(gap, angle[k] - angle[k - 1]);
    return 2 * std::numbers::pi - gap;
}

double region_size(const TriMesh& part, const FaceSet& faces)
{
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : part.triangle.col(f))
            box.extend(part.position.col(v));
    return box.diagonal().norm();
}

/// Where the sheet bends but is no cylinder: its radius across the bend at the place that was
/// clicked.
Measured freeform_bend(const TriMesh& part, const Probe& probe, const FaceSet& region, const char* instead)
{
    const CurvatureAt here = curvature_at(part, probe.face, place(part, probe), region);
    const double most = std::abs(here.curvature[0]), least = std::abs(here.curvature[1]);
    // What the sheet rises over the patch has to stand out from how far the patch is from the
    // fitted face.
    const double rise = 0.5 * most * here.reach_mm * here.reach_mm;
    constexpr double flat = 1e-4; // of the patch's reach: what is read from single precision is no
                                  // flatter
    if (rise < std::max(2 * here.distance_mm, flat * here.reach_mm))
        throw InputError(fmt::format("The sheet is flat here: within {:.3g} mm over a circle of {:.3g} mm. It has no "
                                     "radius; click where it bends.",
                                     std::max(rise, here.distance_mm), 2 * here.reach_mm));
    Measured found;
    found.value = 1 / most;
    found.residual = here.distance_mm;
    constexpr double straight = 100; // times the radius: along the bend nobody sees that it is
                                     // curved
    found.more = {
        {"Measured", {}, fmt::format("curvature here ({})", instead)},
        {"Radius along the bend", least * straight > most ? std::vector{1 / least} : std::vector<double>{}, "straight"},
        {"Over a circle of", {2 * here.reach_mm}},
        {"Farthest from the fit", {here.distance_mm}},
        {"Fit", {}, fmt::format("{:.1f} % of the rise", 100 * here.distance_mm / rise)},
        {"Side", {}, here.curvature[0] < 0 ? "outer, convex" : "inner, concave"}};
    const Vector3d middle = here.place + here.normal / here.curvature[0], arm = here.place - middle;
    const Vector3d axis = here.normal.cross(here.across).normalized();
    constexpr double half = 60 * degree; // of the circle that lies on the bend
    found.line = {polyline({middle, here.place}), arc(middle, Eigen::AngleAxisd(-half, axis) * arm, axis, 2 * half)};
    found.label = here.place;
    return found;
}

Measured rounding(const TriMesh& part, const Probe& probe, const RegionSearch& regions)
{
    const FaceSet faces = regions.smooth_region(probe.face);
    std::optional<TargetFit> fit;
    // From what a CAD system means by round to what still is round for a press shop; shares of the
    // region's size.
    constexpr double tolerances[] = {1e-4, 1e-3, 5e-3, 1e-2};
    for (const double tolerance : tolerances)
        if (!fit)
            fit = fit_target(part, faces, tolerance);
    if (!fit || std::holds_alternative<ConeFace>(fit->face))
        return freeform_bend(part, probe, faces, fit ? "cone" : "no cylinder");
    if (std::holds_alternative<PlaneFace>(fit->face) && fit->distance_mm > tolerances[0] * region_size(part, faces))
        return freeform_bend(part, probe, faces, "no cylinder"); // a gentle bend is not flat
    if (std::holds_alternative<PlaneFace>(fit->face))
        throw InputError(
            fmt::format("The sheet around this point is flat (within {:.3g} mm): it has no radius. Click on the "
                        "rounded faces of a bend.",
                        fit->distance_mm));
    const CylinderFace& cylinder = std::get<CylinderFace>(fit->face);
    const Vector3d at = place(part, probe);
    const Vector3d foot = cylinder.origin + cylinder.axis.dot(at - cylinder.origin) * cylinder.axis;
    const double around = swept(part, faces, cylinder);
    Measured found;
    found.value = cylinder.radius;
    found.residual = fit->distance_mm;
    found.more = {{"Measured", {}, "cylinder through the bend"},
                  {"Farthest from the cylinder", {fit->distance_mm}},
                  {"Swept angle", {}, fmt::format("{:.1f} deg", around / degree)},
                  {"Faces", {}, fmt::format("{}", faces.size())},
                  {"Side", {}, cylinder.bulges ? "outer, convex" : "inner, concave"}};
    const Vector3d arm = cylinder.radius * (at - foot).normalized();
    found.line = {polyline({foot, foot + arm}), arc(foot, Eigen::AngleAxisd(-std::numbers::pi, cylinder.axis) * arm,
                                                    cylinder.axis, 2 * std::numbers::pi)};
    found.label = at;
    return found;
}

} // namespace

std::string_view name(MeasureKind kind) { return name_in_table(kind); }

size_t places_of(MeasureKind kind)
{
    switch (kind) {
    case MeasureKind::distance:
    case MeasureKind::faces: return 2;
    case MeasureKind::angle:
    case MeasureKind::circle: return 3;
    case MeasureKind::rounding: return 1;
    }
    return 0;
}

const char* title(MeasureKind kind)
{
    switch (kind) {
    case MeasureKind::distance: return "Distance";
    case MeasureKind::angle: return "Angle of three points";
    case MeasureKind::faces: return "Angle of two faces";
    case MeasureKind::circle: return "Radius of three points";
    case MeasureKind::rounding: return "Radius of a fillet or bend";
    }
    return "";
}

const char* advice(MeasureKind kind)
{
    switch (kind) {
    case MeasureKind::distance: return "Click two points";
    case MeasureKind::angle: return "Click three points; the angle is at the second one";
    case MeasureKind::faces: return "Click two faces: the angle between their normals";
    case MeasureKind::circle: return "Click three points: the circle through them";
    case MeasureKind::rounding: return "Click a fillet or bend: the cylinder through it, else its radius at that point";
    }
    return "";
}

Measured measured(const TriMesh& part, const Measurement& measurement, const RegionSearch* regions)
{
    const std::vector<Probe>& at = measurement.at;
    if (at.size() != places_of(measurement.kind))
        throw InputError(fmt::format("{} needs {} point{} but there {} {}.", title(measurement.kind),
                                     places_of(measurement.kind), places_of(measurement.kind) == 1 ? "" : "s",
                                     at.size() == 1 ? "is" : "are", at.size()));
    for (const Probe& probe : at)
        if (probe.face < 0 || probe.face >= part.triangles())
            throw InputError(fmt::format("There is no face {}.", probe.face));
    switch (measurement.kind) {
    case MeasureKind::distance: return distance(place(part, at[0]), place(part, at[1]));
    case MeasureKind::angle: return angle(place(part, at[0]), place(part, at[1]), place(part, at[2]));
    case MeasureKind::faces: return between_faces(part, at[0], at[1]);
    case MeasureKind::circle: return circle(place(part, at[0]), place(part, at[1]), place(part, at[2]));
    case MeasureKind::rounding:
        return regions ? rounding(part, at[0], *regions) : rounding(part, at[0], RegionSearch(part));
    }
    return {};
}

std::string text_of(const Measurement& measurement, LengthUnit unit)
{
    const double value = measurement.found->value;
    switch (measurement.kind) {
    case MeasureKind::distance: return fixed_length(value, unit, 2);
    case MeasureKind::angle:
    case MeasureKind::faces: return fmt::format("{:.2f} deg", value);
    case MeasureKind::circle:
    case MeasureKind::rounding: return "R " + fixed_length(value, unit, 2);
    }
    return "";
}

std::string text_of(const Measured::Figure& figure, LengthUnit unit)
{
    if (figure.mm.empty())
        return figure.words;
    if (figure.mm.size() == 1) // also one that is small beside the others: how far off a fit is
        return length_text(figure.mm[0], unit);
    std::string text;
    for (const double mm : figure.mm)
        text += fmt::format("{}{:.{}f}", text.empty() ? "" : ", ", shown_length(mm, unit), 2 + more_decimals(unit));
    return fmt::format("{} {}", text, length_word(unit));
}

static void measure_again(Document& document, bool part_is_other, bool blank_is_other, bool quads_are_others,
                          bool surface_is_other)
{
    // by View
    const bool others[] = {part_is_other, blank_is_other, quads_are_others, surface_is_other};
    const Session& session = document.session;
    for (Measurement& each : std::exchange(document.measurements, {}))
        try {
            if (others[size_t(each.on)]) {
                if (!keeps_faces(each.on) || (each.on == View::blank && !session.blank))
                    continue;
                const TriMesh& part = session.part->mesh;
                each.found = std::make_shared<const Measured>(
                    each.on == View::part ? measured(part, each)
                                          : measured(flat_mesh(part, session.blank->blank), each));
            }
            document.measurements.push_back(std::move(each));
        } catch (const InputError&) {
            continue;
        }
}

void measure_again(Document& document) { measure_again(document, true, true, true, true); }

void measure_again(Document& document, const Session& before)
{
    const Session& now = document.session;
    measure_again(document, now.part != before.part, now.blank != before.blank,
                  now.lifted != before.lifted || now.surface != before.surface,
                  now.surface != before.surface || now.deformed != before.deformed);
}

std::optional<double> on_blank(const Session& session, const Measurement& measurement)
{
    if (measurement.on != View::part || measurement.kind != MeasureKind::distance || measurement.at.size() != 2 ||
        !session.blank || !session.part)
        return std::nullopt;
    const auto flat = [&](const Probe& probe) -> Eigen::Vector2d {
        return session.blank->blank.position(Eigen::all, session.part->mesh.triangle.col(probe.face)) *
               probe.barycentric;
    };
    return (flat(measurement.at[0]) - flat(measurement.at[1])).norm();
}

} // namespace spia::viewer

#include "engine/forming/process/process.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/forming/process/contact_pressure.h"
#include "engine/forming/process/held_edges.h"
#include "engine/forming/process/line_on_part.h"
#include "engine/forming/process/rolling.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

void require_faces(const std::string& what, const std::vector<int>& faces, const TriMesh& part)
{
    if (faces.empty())
        throw InputError(fmt::format("{} has no faces; pick some or remove it", what));
    for (const int f : faces)
        if (f < 0 || f >= part.triangles())
            throw InputError(
                fmt::format("{} names face {}; the part has faces 0 to {}", what, f, part.triangles() - 1));
}

void require_positive(const std::string& what, double value, const char* unit)
{
    if (!(value > 0) || !std::isfinite(value))
        throw InputError(fmt::format("{} is {} {}; it must be positive", what, value, unit));
}

/// Of the tools that rest and of those that travel.
void add_tractions(const ProcessConditions& process, const TriMesh& part, const Eigen::Vector3d& direction,
                   ExternalForces& out)
{
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    for (const ContactRegion& region : process.contact) {
        require_contact(region, part, fmt::format("the contact region \"{}\"", region.name));
        const double pressure = contact_pressure(region, area_vector, direction).MPa;
        if (region.friction == 0)
            continue;
        Eigen::VectorXd& traction = region.sides == 2 ? out.traction : out.travelling;
        if (traction.size() == 0)
            traction = Eigen::VectorXd::Zero(part.triangles());
        for (const int f : region.faces)
            traction[f] += region.sides * region.friction * pressure;
    }
}

/// Adds up what comes to one vertex; lines that come from both ends of an edge do not cancel.
class RestraintSum {
public:
    void add(int vertex, const Eigen::Vector3d& force)
    {
        Eigen::Vector3d& sum = sum_.try_emplace(vertex, Eigen::Vector3d::Zero()).first->second;
        sum += sum.dot(force) < 0 ? Eigen::Vector3d(-force) : force;
    }
    void append_to(std::vector<Restraint>& restraint) const
    {
        for (const auto& [vertex, force] : sum_)
            if (force.norm() > 0)
                restraint.push_back({vertex, force.normalized(), force.norm()});
    }

private:
    std::map<int, Eigen::Vector3d> sum_;
};

void add_drawbead(const Drawbead& bead, const TriMesh& part, const LineOnPart& lines,
                  const Eigen::Matrix3Xd& area_vector, std::vector<Restraint>& restraint)
{
    const std::string what = fmt::format("the drawbead \"{}\"", bead.name);
    if (bead.force_N_mm != 0) // else of a shape too shallow to bend the sheet
        require_positive("the force of " + what, bead.force_N_mm, "N/mm");
    RestraintSum sum;
    for (const LinePlace& place : lines.places(what, bead.line)) {
        const Eigen::Vector3d normal = area_vector.col(place.on_part.face).normalized();
        const Eigen::Vector3d across = normal.cross(place.along);
        if (!(across.norm() > 0.1))
            throw InputError(fmt::format("{} leaves the sheet near {} mm; it must run along it", what,
                                         place_text(place.on_part.position)));
        for (int a = 0; a < 3; ++a)
            sum.add(part.triangle(a, place.on_part.face),
                    place.on_part.barycentric[a] * bead.force_N_mm * place.length * across.normalized());
    }
    sum.append_to(restraint);
}

/// @param force of each face, N/mm
void add_edge_restraint(const Eigen::VectorXd& force, const TriMesh& part, const Eigen::Matrix3Xd& normal,
                        std::vector<Restraint>& restraint)
{
    RestraintSum sum;
    for (const HeldEdge& held : held_edges(part)) {
        const Eigen::Vector3d edge = part.position.col(held.to) - part.position.col(held.from);
        for (const int v : {held.from, held.to}) {
            const Eigen::Vector3d across = edge.cross(normal.col(v));
            if (across.norm() > 0)
                sum.add(v, 0.5 * force[held.face] * edge.norm() * across.normalized());
        }
    }
    sum.append_to(restraint);
}

void add_pilot(const Pilot& pilot, const TriMesh& part, const LineOnPart& lines,
               const Eigen::Matrix<double, 3, 2>& plane, const Eigen::Vector3d& origin, std::vector<HeldVertex>& held)
{
    const std::string what = fmt::format("the pilot \"{}\"", pilot.name);
    std::vector<ClosestPoint> places;
    if (pilot.line.size() == 1)
        places.push_back(lines.at(what, pilot.line[0]));
    else
        for (const LinePlace& place : lines.places(what, pilot.line))
            places.push_back(place.on_part);
    for (const ClosestPoint& place : places) {
        int nearest = 0;
        place.barycentric.maxCoeff(&nearest);
        const int v = part.triangle(nearest, place.face);
        if (std::none_of(held.begin(), held.end(), [&](const HeldVertex& h) { return h.vertex == v; }))
            held.push_back({v, plane.transpose() * (part.position.col(v) - origin)});
    }
}

/// Of each face's own sheet, N/mm.
Eigen::VectorXd lock_forces(const ProcessConditions& process, const TriMesh& part, const Material& material,
                            double thickness)
{
    Eigen::VectorXd force = Eigen::VectorXd::Constant(part.triangles(), lock_force(material, thickness));
    for (const TailoredPiece& piece : process.tailored) {
        const double own = lock_force(piece.material, piece.thickness);
        for (const int f : piece.faces)
            force[f] = own;
    }
    return force;
}

} // namespace

void require_contact(const ContactRegion& region, const TriMesh& part, const std::string& what)
{
    require_faces(what, region.faces, part);
    if (!(region.friction >= 0) || !std::isfinite(region.friction) || region.sides < 1 || region.sides > 2)
        throw InputError(fmt::format("{}: friction {} on {} sides; friction must not be negative, sides 1 or 2", what,
                                     region.friction, region.sides));
    if (region.force_N.has_value() == region.pressure_MPa.has_value())
        throw InputError(fmt::format("{} needs either a force or a pressure", what));
    if (region.force_N)
        require_positive("the force of " + what, *region.force_N, "N");
    else
        require_positive("the pressure of " + what, *region.pressure_MPa, "MPa");
}

bool has_tools(const ProcessConditions& process)
{
    return !process.contact.empty() || !process.drawbeads.empty() || !process.pilots.empty() ||
           process.edge_restraint != 0;
}

double lock_force(const Material& material, double thickness)
{
    const double r = material.normal_anisotropy(), factor = (1 + r) / std::sqrt(1 + 2 * r);
    double greatest = 0;
    for (int k = 1; k <= 1000; ++k) { // of the force over the strain along the strip: one maximum,
                                      // flat there
        const double strain = 1e-3 * k;
        greatest =
            std::max(greatest, factor * flow_stress(material.hardening, factor * strain).stress * std::exp(-strain));
    }
    return thickness * greatest;
}

std::optional<Eigen::Vector2d> rolling_in(const ProcessConditions& process, const Eigen::Matrix<double, 3, 2>& plane)
{
    if (!process.rolling)
        return std::nullopt;
    const Eigen::Vector2d seen = plane.transpose() * *process.rolling;
    if (!seen.allFinite() || !(seen.norm() > 1e-6 * process.rolling->norm()))
        throw InputError("the rolling direction must be a finite vector across the stamping direction");
    return seen;
}

Sheet sheet_of(const Material& material, double thickness, const StressCurve::Options& curve,
               const ProcessConditions& process, const TriMesh& part, const Eigen::Matrix<double, 3, 2>& plane)
{
    std::optional<double> angle;
    if (const auto seen = rolling_in(process, plane))
        angle = std::atan2((*seen)[1], (*seen)[0]);
    Sheet sheet = uniform_sheet(MembraneLaw(material, curve, angle), thickness, part.triangles());
    if (!process.tailored.empty())
        sheet.grade = Eigen::VectorXi::Zero(part.triangles());
    for (const TailoredPiece& piece : process.tailored) {
        const std::string what = fmt::format("the tailored piece \"{}\"", piece.name);
        require_faces(what, piece.faces, part);
        require_positive("the thickness of " + what, piece.thickness, "mm");
        for (const int f : piece.faces) {
            sheet.grade[f] = int(sheet.law.size());
            sheet.thickness[f] = piece.thickness;
        }
        sheet.law.emplace_back(piece.material, curve, angle);
    }
    return sheet;
}

ExternalForces external_forces(const ProcessConditions& process, const TriMesh& part, const Material& material,
                               double thickness, const Eigen::Matrix<double, 3, 2>& plane,
                               const Eigen::Vector3d& origin)
{
    ExternalForces out;
    out.plane = plane;
    add_tractions(process, part, plane.col(0).cross(plane.col(1)), out);
    if (!(process.edge_restraint >= 0 && process.edge_restraint <= 1))
        throw InputError(fmt::format("the edge restraint is {} of the lock force; it must be between 0 and 1",
                                     process.edge_restraint));
    if (process.edge_restraint > 0)
        add_edge_restraint(process.edge_restraint * lock_forces(process, part, material, thickness), part,
                           vertex_normals(part), out.restraint);
    if (process.drawbeads.empty() && process.pilots.empty())
        return out;
    const LineOnPart lines(part);
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    for (const Drawbead& bead : process.drawbeads)
        add_drawbead(bead, part, lines, area_vector, out.restraint);
    for (const Pilot& pilot : process.pilots)
        add_pilot(pilot, part, lines, plane, origin, out.held);
    return out;
}

} // namespace spia

#include "engine/forming/process.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <optional>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
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

double mean_edge(const TriMesh& part)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            sum += (part.position.col(part.triangle((a + 1) % 3, f)) - part.position.col(part.triangle(a, f))).norm();
    return sum / (3 * part.triangles());
}

/// Places of a polyline on the part, close enough together that none of the faces it crosses is left out, each with
/// the length of line it stands for and the line's direction.
struct LinePlace {
    ClosestPoint on_part;
    double length; ///< mm
    Eigen::Vector3d along;
};

class LineOnPart {
public:
    explicit LineOnPart(const TriMesh& part)
        : search_(part), spacing_(0.25 * mean_edge(part)),
          reach_(std::max(4 * spacing_,
                          0.01 * (part.position.rowwise().maxCoeff() - part.position.rowwise().minCoeff()).norm()))
    {
    }

    ClosestPoint at(const std::string& what, const Eigen::Vector3d& point) const
    {
        const ClosestPoint found = search_.nearest(point);
        if (!point.allFinite() || found.distance > reach_)
            throw InputError(
                fmt::format("{}: the place ({:.6g}, {:.6g}, {:.6g}) is {:.3g} mm off the part; it must lie on it", what,
                            point[0], point[1], point[2], found.distance));
        return found;
    }

    std::vector<LinePlace> places(const std::string& what, const std::vector<Eigen::Vector3d>& line) const
    {
        std::vector<LinePlace> result;
        for (size_t k = 0; k + 1 < line.size(); ++k) {
            const Eigen::Vector3d way = line[k + 1] - line[k];
            const int pieces = std::max(1, int(std::ceil(way.norm() / spacing_)));
            for (int i = 0; i < pieces && way.norm() > 0; ++i)
                result.push_back(
                    {at(what, line[k] + way * ((i + 0.5) / pieces)), way.norm() / pieces, way.normalized()});
        }
        if (result.empty())
            throw InputError(fmt::format("{} needs a line of at least two different places", what));
        return result;
    }

private:
    ClosestPointSearch search_;
    double spacing_, reach_; ///< mm
};

Eigen::VectorXd tractions(const ProcessConditions& process, const TriMesh& part, const Eigen::Vector3d& direction)
{
    if (process.contact.empty())
        return {};
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    Eigen::VectorXd traction = Eigen::VectorXd::Zero(part.triangles());
    for (const ContactRegion& region : process.contact) {
        const std::string what = fmt::format("the contact region \"{}\"", region.name);
        require_faces(what, region.faces, part);
        if (!(region.friction >= 0) || !std::isfinite(region.friction) || region.sides < 1 || region.sides > 2)
            throw InputError(fmt::format("{}: friction {} on {} sides; friction must not be negative, sides 1 or 2",
                                         what, region.friction, region.sides));
        if (region.force_N.has_value() == region.pressure_MPa.has_value())
            throw InputError(fmt::format("{} needs either a force or a pressure", what));
        double pressure = 0;
        if (region.force_N) {
            require_positive("the force of " + what, *region.force_N, "N");
            double seen = 0;
            for (const int f : region.faces)
                seen += std::abs(area_vector.col(f).dot(direction));
            if (!(seen > 0))
                throw InputError(fmt::format("{} is not seen along the stamping direction: a force cannot press there; "
                                             "give a pressure",
                                             what));
            pressure = *region.force_N / seen;
        } else {
            require_positive("the pressure of " + what, *region.pressure_MPa, "MPa");
            pressure = *region.pressure_MPa;
        }
        for (const int f : region.faces)
            traction[f] += region.sides * region.friction * pressure;
    }
    return traction;
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
    require_positive("the force of " + what, bead.force_N_mm, "N/mm");
    RestraintSum sum;
    for (const LinePlace& place : lines.places(what, bead.line)) {
        const Eigen::Vector3d normal = area_vector.col(place.on_part.face).normalized();
        const Eigen::Vector3d across = normal.cross(place.along);
        if (!(across.norm() > 0.1))
            throw InputError(fmt::format("{} leaves the sheet near ({:.6g}, {:.6g}, {:.6g}); it must run along it",
                                         what, place.on_part.position[0], place.on_part.position[1],
                                         place.on_part.position[2]));
        for (int a = 0; a < 3; ++a)
            sum.add(part.triangle(a, place.on_part.face),
                    place.on_part.barycentric[a] * bead.force_N_mm * place.length * across.normalized());
    }
    sum.append_to(restraint);
}

void add_edge_restraint(double force, const TriMesh& part, const Eigen::Matrix3Xd& normal,
                        std::vector<Restraint>& restraint)
{
    RestraintSum sum;
    const std::vector<int> outline = boundary_loops(part).front();
    for (size_t k = 0; k < outline.size(); ++k) {
        const int a = outline[k], b = outline[(k + 1) % outline.size()];
        const Eigen::Vector3d edge = part.position.col(b) - part.position.col(a);
        for (const int v : {a, b}) {
            const Eigen::Vector3d across = edge.cross(normal.col(v));
            if (across.norm() > 0)
                sum.add(v, 0.5 * force * edge.norm() * across.normalized());
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

} // namespace

double lock_force(const Material& material, double thickness)
{
    const double r = material.normal_anisotropy(), factor = (1 + r) / std::sqrt(1 + 2 * r);
    double greatest = 0;
    for (int k = 1; k <= 1000; ++k) { // of the force over the strain along the strip: one maximum, flat there
        const double strain = 1e-3 * k;
        greatest =
            std::max(greatest, factor * flow_stress(material.hardening, factor * strain).stress * std::exp(-strain));
    }
    return thickness * greatest;
}

Sheet sheet_of(const Material& material, double thickness, const StressCurve::Options& curve,
               const ProcessConditions& process, const TriMesh& part, const Eigen::Matrix<double, 3, 2>& plane)
{
    std::optional<double> angle;
    if (process.rolling) {
        const Eigen::Vector2d seen = plane.transpose() * *process.rolling;
        if (!seen.allFinite() || !(seen.norm() > 1e-6 * process.rolling->norm()))
            throw InputError("the rolling direction must be a finite vector across the stamping direction");
        angle = std::atan2(seen[1], seen[0]);
    }
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
    out.origin = origin;
    out.traction = tractions(process, part, plane.col(0).cross(plane.col(1)));
    if (!(process.edge_restraint >= 0 && process.edge_restraint <= 1))
        throw InputError(fmt::format("the edge restraint is {} of the lock force; it must be between 0 and 1",
                                     process.edge_restraint));
    if (process.edge_restraint > 0)
        add_edge_restraint(process.edge_restraint * lock_force(material, thickness), part, vertex_normals(part),
                           out.restraint);
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

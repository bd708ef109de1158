#include "engine/pipeline/applied_process.h"

#include <fmt/core.h>
#include <utility>

#include "engine/core/text.h"
#include "engine/forming/process/contact_pressure.h"
#include "engine/forming/process/held_edges.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

AppliedContact applied(const ContactRegion& region, const Eigen::Matrix3Xd& area_vector,
                       const Eigen::Vector3d& direction)
{
    const auto [area, pressure] = contact_pressure(region, area_vector, direction);
    return {region.name,
            int(region.faces.size()),
            area,
            pressure,
            region.friction,
            region.sides,
            region.sides * region.friction * pressure * area};
}

double length(const std::vector<Eigen::Vector3d>& line)
{
    double sum = 0;
    for (size_t k = 1; k < line.size(); ++k)
        sum += (line[k] - line[k - 1]).norm();
    return sum;
}

std::vector<AppliedPiece> applied(const std::vector<TailoredPiece>& pieces, double edge_restraint,
                                  const Eigen::Matrix3Xd& area_vector)
{
    std::vector<int> piece_of(size_t(area_vector.cols()), -1);
    std::vector<AppliedPiece> result;
    for (const TailoredPiece& piece : pieces) {
        for (const int f : piece.faces)
            piece_of[size_t(f)] = int(result.size());
        result.push_back({piece.name, piece.material.name, piece.thickness, 0, 0,
                          edge_restraint * lock_force(piece.material, piece.thickness)});
    }
    for (size_t f = 0; f < piece_of.size(); ++f)
        if (piece_of[f] >= 0) {
            ++result[size_t(piece_of[f])].faces;
            result[size_t(piece_of[f])].area_mm2 += area_vector.col(Eigen::Index(f)).norm();
        }
    return result;
}

} // namespace

AppliedProcess applied_process(const Session& session)
{
    const FlattenOptions& options = session.options.flatten;
    const ProcessConditions& process = options.process;
    const Eigen::Matrix3Xd area_vector = area_vectors(session.part->mesh);
    AppliedProcess out;
    for (const ContactRegion& region : process.contact)
        out.contact.push_back(applied(region, area_vector, session.blank->stamping.direction));
    for (const Drawbead& bead : process.drawbeads)
        out.drawbeads.push_back({bead.name, length(bead.line), bead.force_N_mm});
    out.edge_restraint = process.edge_restraint;
    out.lock_force_N_mm = lock_force(options.material, options.thickness);
    if (process.edge_restraint > 0)
        for (const HeldEdge& edge : held_edges(session.part->mesh)) {
            constexpr double least_seen = 0.1; // share of a face's area
            const Eigen::Matrix3Xd& x = session.part->mesh.position;
            const double length = (x.col(edge.to) - x.col(edge.from)).norm();
            const Eigen::Vector3d area = area_vector.col(edge.face);
            out.held_mm += length;
            if (std::abs(area.dot(session.blank->stamping.direction)) < least_seen * area.norm())
                out.upright_mm += length;
        }
    for (const Pilot& pilot : process.pilots)
        out.pilots.push_back({pilot.name, int(pilot.line.size())});
    out.tailored = applied(process.tailored, process.edge_restraint, area_vector);
    out.rolling = process.rolling;
    return out;
}

std::vector<std::string> describe(const AppliedProcess& process)
{
    std::vector<std::string> lines;
    for (const AppliedContact& each : process.contact)
        lines.push_back(fmt::format("contact {}: {:.4g} MPa on {}, friction {:.4g} on {}, holds up to {:.4g} N",
                                    each.name, each.pressure_MPa, counted(each.faces, "face", "faces"), each.friction,
                                    counted(each.sides, "side", "sides"), each.friction_force_N));
    for (const AppliedBead& each : process.drawbeads)
        lines.push_back(
            fmt::format("drawbead {}: {:.4g} N/mm over {:.4g} mm", each.name, each.force_N_mm, each.length_mm));
    if (process.edge_restraint > 0)
        lines.push_back(
            fmt::format("edge restraint {:.4g} % of the lock force of {:.4g} N/mm: {:.4g} N/mm over {:.4g} mm",
                        100 * process.edge_restraint, process.lock_force_N_mm,
                        process.edge_restraint * process.lock_force_N_mm, process.held_mm) +
            (process.tailored.empty() ? "" : " on the base sheet"));
    for (const AppliedPilot& each : process.pilots)
        lines.push_back(fmt::format("pilot {}: {}", each.name, counted(each.places, "place", "places")));
    for (const AppliedPiece& each : process.tailored)
        lines.push_back(
            fmt::format("tailored piece {}: {}, {:.4g} mm, {}, {:.6g} mm2", each.name, each.material, each.thickness_mm,
                        counted(each.faces, "face", "faces"), each.area_mm2) +
            (each.edge_force_N_mm > 0 ? fmt::format(", edge held by {:.4g} N/mm", each.edge_force_N_mm) : ""));
    if (process.rolling)
        lines.push_back(fmt::format("rolled along {:.4g}, {:.4g}, {:.4g}", (*process.rolling)[0], (*process.rolling)[1],
                                    (*process.rolling)[2]));
    return lines;
}

std::string left_out_by_steps(const ProcessConditions& process)
{
    std::string what;
    for (const auto& [there, name] : {std::pair{!process.contact.empty(), "tools"},
                                      {!process.drawbeads.empty(), "drawbeads"},
                                      {!process.pilots.empty(), "pilots"},
                                      {process.edge_restraint != 0, "edge restraint"}})
        if (there)
            what.append(what.empty() ? "" : ", ").append(name);
    return what;
}

} // namespace spia

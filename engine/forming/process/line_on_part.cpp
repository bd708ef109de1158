#include "engine/forming/process/line_on_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

double mean_edge(const TriMesh& part)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            sum += (part.position.col(part.triangle((a + 1) % 3, f)) - part.position.col(part.triangle(a, f))).norm();
    return sum / (3 * part.triangles());
}

} // namespace

LineOnPart::LineOnPart(const TriMesh& part, double spacing)
    : part_(part), search_(part), spacing_(spacing > 0 ? spacing : 0.25 * mean_edge(part)),
      reach_(0.005 * bounding_diagonal(part))
{
}

ClosestPoint LineOnPart::within(const std::string& what, const Eigen::Vector3d& point, double reach) const
{
    const auto refuse = [&](double distance) {
        throw InputError(
            fmt::format("{}: the place ({}) is {:.3g} mm off the part; it must lie on it (places are in mm)", what,
                        place_text(point), distance));
    };
    if (!point.allFinite())
        refuse(std::numeric_limits<double>::infinity());
    const ClosestPoint found = search_.nearest(point);
    if (found.distance > reach)
        refuse(found.distance);
    if (found.distance > reach_) { // over a bulge the way to the part is square to it, beyond its
                                   // edge it is not
        const Eigen::Matrix3d corner = part_.position(Eigen::all, part_.triangle.col(found.face));
        const Eigen::Vector3d normal =
            (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).normalized();
        if (std::abs((point - found.position).dot(normal)) < 0.9 * found.distance)
            refuse(found.distance);
    }
    return found;
}

ClosestPoint LineOnPart::at(const std::string& what, const Eigen::Vector3d& point) const
{
    return within(what, point, reach_);
}

std::vector<LinePlace> LineOnPart::places(const std::string& what, const std::vector<Eigen::Vector3d>& line) const
{
    const auto off = [&](const Eigen::Vector3d& point) {
        return point.allFinite() ? search_.nearest(point).distance : std::numeric_limits<double>::infinity();
    };
    std::vector<double> distance;
    for (const Eigen::Vector3d& given : line)
        distance.push_back(off(given));
    if (!line.empty()) // the worst is named first
        at(what, line[size_t(std::max_element(distance.begin(), distance.end()) - distance.begin())]);
    std::vector<LinePlace> result;
    for (size_t k = 0; k + 1 < line.size(); ++k) {
        const Eigen::Vector3d way = line[k + 1] - line[k];
        const int pieces = std::max(1, int(std::ceil(way.norm() / spacing_)));
        for (int i = 0; i < pieces && way.norm() > 0; ++i)
            result.push_back({within(what, line[k] + way * ((i + 0.5) / pieces), 4 * reach_), way.norm() / pieces,
                              way.normalized()});
    }
    if (result.empty())
        throw InputError(fmt::format("{} needs a line of at least two different points", what));
    return result;
}

} // namespace spia

#include "app/viewer/model/reports/grid_advice.h"

#include <algorithm>
#include <fmt/core.h>
#include <string_view>

#include "app/viewer/model/picking/vertex_picking.h"
#include "engine/coons/border_check.h"
#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

/// Where one comes to after a length along the loop, forwards (step 1) or backwards (-1).
Eigen::Vector2d walked(const Eigen::Matrix2Xd& plane, const std::vector<int>& loop, size_t at, int step, double length)
{
    const size_t n = loop.size();
    size_t here = at;
    for (size_t k = 0; k < n; ++k) {
        const size_t next = (here + (step > 0 ? 1 : n - 1)) % n;
        const Eigen::Vector2d a = plane.col(loop[here]), b = plane.col(loop[next]);
        const double edge = (b - a).norm();
        if (edge >= length && edge > 0)
            return a + length / edge * (b - a);
        length -= edge;
        here = next;
    }
    return plane.col(loop[here]);
}

struct Corner {
    int number; ///< as in the views, from 1
    int vertex; ///< of the part
    double angle_deg;
};

/// The corner where the outline turns least; nothing if the corners are not all on one boundary.
std::optional<Corner> widest_corner(const Session& session, const std::array<int, 4>& corners)
{
    const Eigen::Matrix2Xd& plane = session.blank->blank.position;
    std::optional<Corner> widest;
    for (const std::vector<int>& loop : boundary_loops(session.part->mesh)) {
        if (std::find(loop.begin(), loop.end(), corners[0]) == loop.end())
            continue;
        for (size_t k = 0; k < 4; ++k) {
            const auto at = std::find(loop.begin(), loop.end(), corners[k]);
            if (at == loop.end())
                return std::nullopt;
            const double angle = outline_angle_deg(plane, loop, size_t(at - loop.begin()));
            if (!widest || angle > widest->angle_deg)
                widest = Corner{int(k) + 1, corners[k], angle};
        }
        return widest;
    }
    return widest;
}

/// The proposed corner that is farthest from all of these: a sharp turn that has none.
int free_turn(const Eigen::Matrix2Xd& plane, const std::array<int, 4>& proposed, const std::array<int, 4>& taken)
{
    const auto away = [&](int vertex) {
        double least = 1e300;
        for (const int other : taken)
            least = std::min(least, (plane.col(vertex) - plane.col(other)).norm());
        return least;
    };
    return *std::max_element(proposed.begin(), proposed.end(), [&](int a, int b) { return away(a) < away(b); });
}

} // namespace

double outline_angle_deg(const Eigen::Matrix2Xd& plane, const std::vector<int>& loop, size_t at, double share)
{
    double length = 0, twice_area = 0;
    for (size_t k = 0; k < loop.size(); ++k) {
        const Eigen::Vector2d a = plane.col(loop[k]), b = plane.col(loop[(k + 1) % loop.size()]);
        length += (b - a).norm();
        twice_area += a.x() * b.y() - a.y() * b.x();
    }
    const int forwards = twice_area > 0 ? 1 : -1;
    const Eigen::Vector2d here = plane.col(loop[at]);
    return inner_angle_deg(walked(plane, loop, at, forwards, share * length) - here,
                           walked(plane, loop, at, -forwards, share * length) - here);
}

std::string grid_advice(const Session& session, std::string_view message)
{
    const std::string other_way = session.options.grid.method == GridMethod::coons
                                      ? "choose the automatic or the harmonic method in the step Corners and grid"
                                      : "choose more cells in the step Corners and grid";
    const std::string all = "Drag the corners to sharp corners of the blank, or " + other_way + ".";
    if (!session.part || !session.blank)
        return all;
    std::array<int, 4> proposed, corners;
    try {
        proposed = corners = propose_corners(session.blank->blank, session.part->mesh);
    } catch (const Error&) { // a blank without extent
        return all;
    }
    if (session.options.corners) {
        const auto chosen = corners_called(*session.part, *session.options.corners);
        if (!chosen)
            return "Press \"Propose corners\": the chosen ones belong to another part.";
        corners = *chosen;
    }
    const auto widest = widest_corner(session, corners);
    constexpr double straight_deg = 150; // no turn to the eye
    if (!widest || widest->angle_deg < straight_deg)
        return all;
    const std::vector<int>& in_file = session.part->source_vertex;
    const int number = in_file.empty() ? widest->vertex : in_file[size_t(widest->vertex)];
    const std::string corner = fmt::format("corner {} (vertex {})", widest->number, number);
    const std::string why =
        message.find(corner) != std::string_view::npos
            ? ""
            : fmt::format("{} lies where the outline {} ({:.0f} degrees); ", corner,
                          widest->angle_deg > 200 ? "turns inwards" : "runs straight on", widest->angle_deg);
    if (!session.options.corners)
        return sentence(why + "drag it to a sharp corner of the blank, or " + other_way);
    const int turn = free_turn(session.blank->blank.position, proposed, corners);
    return sentence(why + fmt::format("drag it to a sharp corner, e.g. at vertex {}, or press \"Propose corners\"",
                                      in_file.empty() ? turn : in_file[size_t(turn)]));
}

} // namespace spia::viewer

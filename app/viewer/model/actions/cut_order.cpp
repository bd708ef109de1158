#include "app/viewer/model/actions/cut_order.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/picking/vertex_picking.h"
#include "engine/core/error.h"

namespace spia::viewer {

LayoutCut cut_through(const TriMesh& part, const Eigen::Matrix2Xd& position, const std::vector<int>& vertices,
                      const std::vector<int>& file_number)
{
    if (vertices.size() < 2)
        throw InputError("Pick two vertices of the border, and others between them if the cut is to bend.");
    int from = vertices[0], to = vertices[1];
    for (const int a : vertices)
        for (const int b : vertices)
            if ((position.col(a) - position.col(b)).squaredNorm() >
                (position.col(from) - position.col(to)).squaredNorm()) {
                from = a;
                to = b;
            }
    const std::vector<int> border = boundary_vertices(part).vertex;
    for (const int end : {from, to})
        if (!std::binary_search(border.begin(), border.end(), end))
            throw InputError(
                fmt::format("A cut begins and ends on the border of the part; vertex {} does not lie there.",
                            file_number.empty() ? end : file_number[size_t(end)]));
    const Eigen::Vector2d along = position.col(to) - position.col(from);
    LayoutCut cut = vertices;
    std::sort(cut.begin(), cut.end(), [&](int a, int b) {
        const double s = along.dot(position.col(a)), t = along.dot(position.col(b));
        return s != t ? s < t : a < b;
    });
    return cut;
}

} // namespace spia::viewer

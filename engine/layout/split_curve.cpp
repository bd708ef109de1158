#include <optional>
#include <utility>

#include "engine/layout/plane_graph.h"

namespace spia {

void split_curve(PlaneGraph& graph, int c, Eigen::Index at)
{
    LayoutCurve first = graph.curve[size_t(c)], second = first;
    const Eigen::Index n = first.plane.cols();
    const int vertex = int(graph.vertex.size());
    graph.vertex.push_back(first.plane.col(at));
    graph.border.push_back(std::nullopt);
    const auto cut = [&](auto& head, auto& tail) {
        head = head.leftCols(at + 1).eval();
        tail = tail.rightCols(n - at).eval();
    };
    if (first.on_border()) {
        graph.border.back() = BorderTurn{first.plane.col(at - 1), first.plane.col(at + 1)};
        cut(first.part, second.part);
    }
    cut(first.plane, second.plane);
    first.vertex[1] = second.vertex[0] = vertex;
    graph.curve[size_t(c)] = std::move(first);
    graph.curve.push_back(std::move(second));
}

Eigen::Index next_to_middle(const LayoutCurve& curve)
{
    const Eigen::Vector2d middle = points_on(curve, {0.5}).col(0);
    Eigen::Index next = 1;
    for (Eigen::Index i = 2; i + 1 < curve.plane.cols(); ++i)
        if ((curve.plane.col(i) - middle).norm() < (curve.plane.col(next) - middle).norm())
            next = i;
    return next;
}

} // namespace spia

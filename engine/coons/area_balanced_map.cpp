#include "engine/coons/area_balanced_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/coons/untangle_elements.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/orient2d.h"

namespace spia {

namespace {

constexpr double least_height = 1e-3; // over the longest edge: a lower triangle of the blank is
                                      // given this height
constexpr double thin = 1e-5;         // of its wanted area: opened with eps > 0, like a folded
                                      // triangle
constexpr int most_steps = 200;
constexpr int fine_enough = 10000; // triangles: fewer are divided

/// The edges (b - a, c - a) that a triangle of the square is to have: those of the blank, turned so
/// that the first one lies along x. Where the blank has a flat or turned triangle, one over the
/// same longest edge.
Eigen::Matrix2d wanted_edges(const Eigen::Vector2d& ab, const Eigen::Vector2d& ac)
{
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    const double doubled = ab.x() * ac.y() - ab.y() * ac.x();
    Eigen::Matrix2d edges;
    if (doubled >= least_height * longest) {
        edges << ab, ac;
    } else {
        const double half = std::sqrt(longest) / 2;
        edges << 2 * half, half, 0, 2 * least_height * half;
    }
    return edges;
}

/// Vertices that a triangle uses, numbered anew.
struct Used {
    std::vector<int> vertex, number;
    explicit Used(const HarmonicMap& map) : number(size_t(map.square.cols()), -1)
    {
        for (int t = 0; t < map.triangle.cols(); ++t)
            for (int k = 0; k < 3; ++k)
                if (int& n = number[size_t(map.triangle(k, t))]; n < 0) {
                    n = int(vertex.size());
                    vertex.push_back(map.triangle(k, t));
                }
    }
};

PlanarElements elements_of(const HarmonicMap& map, const Used& used, bool slide, double& area)
{
    PlanarElements elements;
    const Eigen::Index n = map.triangle.cols();
    elements.triangle.resize(3, n);
    elements.weight.resize(n);
    for (Eigen::Index t = 0; t < n; ++t) {
        const Eigen::Vector3i v = map.triangle.col(t);
        for (int k = 0; k < 3; ++k)
            elements.triangle(k, t) = used.number[size_t(v[k])];
        const Eigen::Matrix2d edges =
            wanted_edges(map.plane.col(v[1]) - map.plane.col(v[0]), map.plane.col(v[2]) - map.plane.col(v[0]));
        elements.to_shape.push_back(edges.inverse());
        elements.weight[t] = edges.determinant() / 2;
    }
    area = elements.weight.sum();
    elements.weight /= elements.weight.mean();
    elements.fixed = Eigen::Matrix2Xi::Zero(2, Eigen::Index(used.vertex.size()));
    for (size_t i = 0; i < used.vertex.size(); ++i) {
        const auto at = map.square.col(used.vertex[i]).array();
        const Eigen::Array2i on_side = (at == 0 || at == 1).cast<int>();
        elements.fixed.col(Eigen::Index(i)) = on_side;
        if (on_side.any() && !slide)
            elements.fixed.col(Eigen::Index(i)).setOnes();
    }
    return elements;
}

/// Each triangle in four: what folds cells is the edges between large triangles that the map shears
/// differently.
HarmonicMap divided(const HarmonicMap& map)
{
    const std::vector<EdgeUse> edges = edge_uses(map.triangle);
    std::vector<std::array<int, 3>> middle(size_t(map.triangle.cols()));
    int vertices = int(map.square.cols());
    for (size_t e = 0; e < edges.size(); ++e) {
        if (e == 0 || !edges[e].same_edge(edges[e - 1]))
            ++vertices;
        middle[size_t(edges[e].face)][size_t(edges[e].corner)] = vertices - 1;
    }
    HarmonicMap result;
    result.square.resize(2, vertices);
    result.plane.resize(2, vertices);
    result.square.leftCols(map.square.cols()) = map.square;
    result.plane.leftCols(map.plane.cols()) = map.plane;
    for (const EdgeUse& edge : edges) {
        const int m = middle[size_t(edge.face)][size_t(edge.corner)];
        result.square.col(m) = 0.5 * (map.square.col(edge.low) + map.square.col(edge.high));
        result.plane.col(m) = 0.5 * (map.plane.col(edge.low) + map.plane.col(edge.high));
    }
    result.triangle.resize(3, 4 * map.triangle.cols());
    for (int t = 0; t < map.triangle.cols(); ++t) {
        const Eigen::Vector3i v = map.triangle.col(t);
        const auto [ab, bc, ca] = middle[size_t(t)];
        const Eigen::Matrix3d& corner = map.corner[size_t(t)];
        const Eigen::Vector3d a = corner.col(0), b = corner.col(1), c = corner.col(2);
        const std::array<Eigen::Vector3i, 4> part = {Eigen::Vector3i(v[0], ab, ca), Eigen::Vector3i(v[1], bc, ab),
                                                     Eigen::Vector3i(v[2], ca, bc), Eigen::Vector3i(ab, bc, ca)};
        const std::array<std::array<Eigen::Vector3d, 3>, 4> place = {{{a, (a + b) / 2, (c + a) / 2},
                                                                      {b, (b + c) / 2, (a + b) / 2},
                                                                      {c, (c + a) / 2, (b + c) / 2},
                                                                      {(a + b) / 2, (b + c) / 2, (c + a) / 2}}};
        for (size_t k = 0; k < 4; ++k) {
            result.triangle.col(4 * t + int(k)) = part[k];
            result.parent.push_back(map.parent[size_t(t)]);
            Eigen::Matrix3d in_parent;
            in_parent << place[k][0], place[k][1], place[k][2];
            result.corner.push_back(in_parent);
        }
    }
    return result;
}

bool is_one_to_one(const HarmonicMap& map)
{
    for (int t = 0; t < map.triangle.cols(); ++t)
        if (orient2d(map.square.col(map.triangle(0, t)), map.square.col(map.triangle(1, t)),
                     map.square.col(map.triangle(2, t))) <= 0)
            return false;
    return true;
}

void open(HarmonicMap& map, const AreaBalanceOptions& how, const Progress& progress)
{
    const Used used(map);
    double area = 0;
    const PlanarElements elements = elements_of(map, used, how.slide, area);
    const Eigen::Array2d size(std::sqrt(area * how.oblong), std::sqrt(area / how.oblong));
    Eigen::Matrix2Xd position(2, Eigen::Index(used.vertex.size()));
    for (size_t i = 0; i < used.vertex.size(); ++i)
        position.col(Eigen::Index(i)) = map.square.col(used.vertex[i]).array() * size;
    UntangleElementsOptions options;
    options.most_steps = most_steps;
    options.area_weight = how.area_weight;
    options.element_area = area / double(map.triangle.cols());
    options.thin = thin;
    untangle_elements(position, elements, {}, options, progress);
    for (size_t i = 0; i < used.vertex.size(); ++i)
        for (int k = 0; k < 2; ++k) // what stays keeps its bits
            if (!elements.fixed(k, Eigen::Index(i)))
                map.square(k, used.vertex[i]) = position(k, Eigen::Index(i)) / size[k];
}

} // namespace

std::optional<HarmonicMap> area_balanced_map(const HarmonicMap& map, const AreaBalanceOptions& options,
                                             const Progress& progress)
{
    HarmonicMap opened = map;
    for (int level = 0;; ++level) {
        open(opened, options, progress.part(level == 0 ? 0 : 0.3, level == 0 ? 0.3 : 1));
        if (opened.triangle.cols() >= fine_enough || !is_one_to_one(opened))
            break;
        opened = divided(opened);
    }
    if (!is_one_to_one(opened))
        return std::nullopt;
    return opened;
}

} // namespace spia

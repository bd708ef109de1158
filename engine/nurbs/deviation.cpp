#include "engine/nurbs/deviation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <tuple>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/project.h"
#include "engine/nurbs/tessellate.h"

namespace spia {

namespace {

void require_in_range(const NurbsSurface& surface, const TriMesh& mesh, const DeviationOptions& options)
{
    if (options.part_faces == 0 || options.part_faces > mesh.triangles())
        throw InputError(fmt::format("{} of the mesh's {} faces cannot be the part's; give their number, or -1 for all",
                                     options.part_faces, mesh.triangles()));
    const auto inside = [](const std::vector<double>& parameters, const std::vector<double>& knots) {
        return std::is_sorted(parameters.begin(), parameters.end()) &&
               (parameters.empty() || (parameters.front() >= knots.front() && parameters.back() <= knots.back()));
    };
    if (!inside(options.data_u, surface.knots_u) || !inside(options.data_v, surface.knots_v) ||
        options.data_u.empty() != options.data_v.empty())
        throw InputError("the parameters of the data must rise within the surface's domain, along u and along v; give "
                         "those that came with the interpolated surface");
}

/// Runs body(i) for 0 <= i < count on the available threads, with a checkpoint now and then.
template <class Body> void for_each_sample(int count, const Progress& progress, std::string_view step, const Body& body)
{
    constexpr int at_a_time = 65536;
    for (int from = 0; from < count; from += std::min(at_a_time, count - from)) {
        progress.checkpoint(double(from) / count, step);
        parallel_for(std::min(at_a_time, count - from), [&](int i) { body(from + i); });
    }
}

/// One entry per sample; a sample that does not count has no weight.
struct Samples {
    std::vector<double> distance; ///< mm
    std::vector<double> weight;   ///< mm2, the area it stands for
    std::vector<char> counts;     ///< 0 where a hole was filled

    explicit Samples(int count) : distance(size_t(count)), weight(size_t(count)), counts(size_t(count), 1) {}
};

/// @param position  of sample i
template <class Position> DeviationStatistics statistics(const Samples& samples, const Position& position)
{
    std::vector<int> order;
    for (int i = 0; i < int(samples.counts.size()); ++i)
        if (samples.counts[size_t(i)])
            order.push_back(i);
    DeviationStatistics result;
    result.samples = int(order.size());
    result.excluded = int(samples.counts.size()) - result.samples;
    if (order.empty())
        return result;

    double area = 0, sum = 0, sum_of_squares = 0;
    for (int i : order) {
        const double distance = samples.distance[size_t(i)], weight = samples.weight[size_t(i)];
        area += weight;
        sum += weight * distance;
        sum_of_squares += weight * distance * distance;
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const double x = samples.distance[size_t(a)], y = samples.distance[size_t(b)];
        return x < y || (x == y && a > b); // of equally far ones the first is the worst
    });
    const int worst = order.back();
    result.max = samples.distance[size_t(worst)];
    result.where = position(worst);
    if (!(area > 0)) // nothing but collapsed places
        return result;
    result.mean = sum / area;
    result.rms = std::sqrt(sum_of_squares / area);
    double below = 0;
    for (int i : order) {
        below += samples.weight[size_t(i)];
        result.p95 = samples.distance[size_t(i)];
        if (below >= 0.95 * area)
            break;
    }
    return result;
}

/// The length of the parameter line that each sample stands for: half of the way to both neighbours.
std::vector<double> shares(const std::vector<double>& parameters)
{
    std::vector<double> result(parameters.size(), 0);
    for (size_t i = 0; i + 1 < parameters.size(); ++i) {
        result[i] += (parameters[i + 1] - parameters[i]) / 2;
        result[i + 1] += (parameters[i + 1] - parameters[i]) / 2;
    }
    return result;
}

/// The distances of the surface at u x v from the mesh.
DeviationStatistics measure_surface(const NurbsSurface& surface, const std::vector<double>& u,
                                    const std::vector<double>& v, const std::vector<double>& share_u,
                                    const std::vector<double>& share_v, const ClosestPointSearch& mesh, int part_faces,
                                    const Progress& progress)
{
    const int columns = int(u.size());
    if (double(columns) * double(v.size()) > std::numeric_limits<int>::max())
        throw InputError(
            fmt::format("{} x {} samples of the surface are too many; ask for fewer per span", columns, v.size()));
    const int count = columns * int(v.size());
    const auto at = [&](int i) { return evaluate(surface, u[size_t(i % columns)], v[size_t(i / columns)]); };
    Samples samples(count);
    for_each_sample(count, progress, "measuring from the surface to the mesh", [&](int i) {
        const SurfacePoint point = at(i);
        const ClosestPoint found = mesh.nearest(point.position);
        samples.distance[size_t(i)] = found.distance;
        samples.weight[size_t(i)] =
            point.S_u.cross(point.S_v).norm() * share_u[size_t(i % columns)] * share_v[size_t(i / columns)];
        samples.counts[size_t(i)] = found.face < part_faces;
    });
    return statistics(samples, [&](int i) { return at(i).position; });
}

/// The places of the mesh that are projected on the surface: all vertices first, then the midpoints of the part's edges
/// and faces. The weights integrate cubic functions exactly over each face (1/20, 2/15 and 9/20 of its area).
struct MeshSamples {
    Eigen::Matrix3Xd position;
    Samples samples;
};

MeshSamples sample_mesh(const TriMesh& mesh, int part_faces)
{
    struct EdgeOfFace {
        int a, b, face; ///< a < b
    };
    std::vector<EdgeOfFace> edges;
    edges.reserve(size_t(part_faces) * 3);
    for (int f = 0; f < part_faces; ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangle(k, f), b = mesh.triangle((k + 1) % 3, f);
            edges.push_back({std::min(a, b), std::max(a, b), f});
        }
    std::sort(edges.begin(), edges.end(), [](const EdgeOfFace& x, const EdgeOfFace& y) {
        return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face);
    });

    std::vector<Eigen::Vector3d> position;
    std::vector<double> weight(size_t(mesh.vertices()), 0);
    std::vector<char> counts(size_t(mesh.vertices()), 0);
    for (int v = 0; v < mesh.vertices(); ++v)
        position.push_back(mesh.position.col(v));
    const Eigen::VectorXd area = area_vectors(mesh).colwise().norm();
    for (int f = 0; f < part_faces; ++f) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int v : mesh.triangle.col(f)) {
            weight[size_t(v)] += area[f] / 20;
            counts[size_t(v)] = 1;
            middle += mesh.position.col(v) / 3;
        }
        position.push_back(middle);
        weight.push_back(area[f] * 9 / 20);
    }
    for (size_t e = 0; e < edges.size(); ++e) {
        if (e == 0 || edges[e].a != edges[e - 1].a || edges[e].b != edges[e - 1].b) {
            position.push_back((mesh.position.col(edges[e].a) + mesh.position.col(edges[e].b)) / 2);
            weight.push_back(0);
        }
        weight.back() += area[edges[e].face] * 2 / 15;
    }

    MeshSamples result{Eigen::Matrix3Xd(3, position.size()), Samples(int(position.size()))};
    for (size_t i = 0; i < position.size(); ++i)
        result.position.col(Eigen::Index(i)) = position[i];
    std::copy(counts.begin(), counts.end(), result.samples.counts.begin());
    result.samples.weight = std::move(weight);
    return result;
}

/// How densely the surface is tessellated to start the projections: as asked, but sparser on a very large net, where
/// memory is short and the spans are nearly flat.
int start_samples_per_span(const NurbsSurface& surface, int asked)
{
    constexpr double most = 1e6;
    const double spans = double(span_borders(surface.knots_u, surface.degree_u).size() - 1) *
                         double(span_borders(surface.knots_v, surface.degree_v).size() - 1);
    return std::clamp(int(std::sqrt(most / spans)), 1, asked);
}

std::vector<double> middles(const std::vector<double>& parameters)
{
    std::vector<double> result;
    for (size_t i = 0; i + 1 < parameters.size(); ++i)
        result.push_back((parameters[i] + parameters[i + 1]) / 2);
    return result;
}

std::vector<double> lengths(const std::vector<double>& parameters)
{
    std::vector<double> result;
    for (size_t i = 0; i + 1 < parameters.size(); ++i)
        result.push_back(parameters[i + 1] - parameters[i]);
    return result;
}

} // namespace

Deviation deviation(const NurbsSurface& surface, const TriMesh& mesh, const DeviationOptions& options,
                    const Progress& progress)
{
    require_in_range(surface, mesh, options);
    const int part_faces = options.part_faces < 0 ? mesh.triangles() : options.part_faces;
    const std::vector<double> u = sample_parameters(surface.knots_u, surface.degree_u, options.samples_per_span);
    const std::vector<double> v = sample_parameters(surface.knots_v, surface.degree_v, options.samples_per_span);
    const ClosestPointSearch search(mesh);

    Deviation result;
    result.surface_to_mesh =
        measure_surface(surface, u, v, shares(u), shares(v), search, part_faces, progress.part(0, 0.3));
    if (!options.data_u.empty())
        result.between_data =
            measure_surface(surface, middles(options.data_u), middles(options.data_v), lengths(options.data_u),
                            lengths(options.data_v), search, part_faces, progress.part(0.3, 0.35));

    progress.checkpoint(0.35, "preparing the surface");
    const SurfaceProjection projection(surface, start_samples_per_span(surface, options.samples_per_span));
    MeshSamples places = sample_mesh(mesh, part_faces);
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    result.at_vertex.resize(mesh.vertices());
    for_each_sample(int(places.position.cols()), progress.part(0.4, 1), "measuring from the mesh to the surface",
                    [&](int i) {
                        const Eigen::Vector3d point = places.position.col(i);
                        const SurfaceFoot foot = projection.nearest(point);
                        places.samples.distance[size_t(i)] = foot.distance;
                        if (i < mesh.vertices()) {
                            const bool outside = (foot.position - point).dot(normal.col(i)) >= 0;
                            result.at_vertex[i] = outside ? foot.distance : -foot.distance;
                        }
                    });
    result.mesh_to_surface =
        statistics(places.samples, [&](int i) -> Eigen::Vector3d { return places.position.col(i); });
    return result;
}

} // namespace spia

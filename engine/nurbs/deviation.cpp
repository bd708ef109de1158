#include "engine/nurbs/deviation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/sort_in_parts.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/mesh_samples.h"
#include "engine/nurbs/normal_deviation.h"
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

constexpr const char* summing_up = "summing up the distances";

/// One entry per sample; a sample that does not count has no weight.
struct Samples {
    std::vector<double> distance; ///< mm
    std::vector<double> weight;   ///< mm2, the area it stands for
    std::vector<char> counts;     ///< 0 where a hole was filled

    explicit Samples(int count) : distance(size_t(count)), weight(size_t(count)), counts(size_t(count), 1) {}
};

/// @param position  of sample i
template <class Position>
DeviationStatistics statistics(const Samples& samples, double tolerance, const Position& position,
                               const Progress& progress)
{
    progress.checkpoint(1, summing_up);
    std::vector<int> order;
    for (int i = 0; i < int(samples.counts.size()); ++i)
        if (samples.counts[size_t(i)])
            order.push_back(i);
    DeviationStatistics result;
    result.samples = int(order.size());
    result.excluded = int(samples.counts.size()) - result.samples;
    if (order.empty())
        return result;

    double area = 0, sum = 0, sum_of_squares = 0, within = 0;
    int samples_within = 0;
    for (int i : order) {
        const double distance = samples.distance[size_t(i)], weight = samples.weight[size_t(i)];
        area += weight;
        within += distance <= tolerance ? weight : 0;
        samples_within += distance <= tolerance;
        sum += weight * distance;
        sum_of_squares += weight * distance * distance;
    }
    const auto nearer = [&](int a, int b) {
        const double x = samples.distance[size_t(a)], y = samples.distance[size_t(b)];
        return x < y || (x == y && a > b); // of equally far ones the first is the worst
    };
    sort_in_parts(order, nearer, [&] { progress.checkpoint(1, summing_up); });
    const int worst = order.back();
    result.max = samples.distance[size_t(worst)];
    result.where = position(worst);
    if (!(area > 0)) // nothing but collapsed places
        return result;
    result.mean = sum / area;
    result.within = samples_within == result.samples ? 1 : within / area;
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

/// The length of the parameter line that each sample stands for: half of the way to both
/// neighbours.
std::vector<double> shares(const std::vector<double>& parameters)
{
    std::vector<double> result(parameters.size(), 0);
    for (size_t i = 0; i + 1 < parameters.size(); ++i) {
        result[i] += (parameters[i + 1] - parameters[i]) / 2;
        result[i + 1] += (parameters[i + 1] - parameters[i]) / 2;
    }
    return result;
}

/// What the surface is compared with.
struct Reference {
    const TriMesh& mesh;
    int part_faces;
    double tolerance, listed_from; ///< mm
    ClosestPointSearch search;
    MeshNormals normals;
};

struct SurfaceMeasure {
    DeviationStatistics distance;
    NormalDeviation normal;
    std::vector<BeyondTolerance> beyond, turned;
};

/// The surface at u x v compared with the mesh.
SurfaceMeasure measure_surface(const NurbsSurface& surface, const std::vector<double>& u, const std::vector<double>& v,
                               const std::vector<double>& share_u, const std::vector<double>& share_v,
                               const Reference& reference, const Progress& progress)
{
    const int columns = int(u.size());
    if (double(columns) * double(v.size()) > std::numeric_limits<int>::max())
        throw InputError(
            fmt::format("{} x {} samples of the surface are too many; ask for fewer per span", columns, v.size()));
    const int count = columns * int(v.size());
    const auto at = [&](int i) { return evaluate(surface, u[size_t(i % columns)], v[size_t(i / columns)]); };
    Samples samples(count);
    std::vector<NormalSample> normals(static_cast<size_t>(count));
    for_each_in_parts(count, progress, "measuring from the surface to the mesh", [&](int i) {
        const SurfacePoint point = at(i);
        const ClosestPoint found = reference.search.nearest(point.position);
        samples.distance[size_t(i)] = found.distance;
        samples.weight[size_t(i)] =
            point.S_u.cross(point.S_v).norm() * share_u[size_t(i % columns)] * share_v[size_t(i / columns)];
        samples.counts[size_t(i)] = found.face < reference.part_faces;
        normals[size_t(i)] = {point.normal(), samples.counts[size_t(i)] ? found.face : -1, samples.weight[size_t(i)]};
    });
    SurfaceMeasure result;
    const auto position = [&](int i) { return at(i).position; };
    result.distance = statistics(samples, reference.tolerance, position, progress);
    progress.checkpoint(1, summing_up);
    std::vector<int> turned;
    result.normal = normal_deviation(normals, reference.normals, position, turned, progress);
    progress.checkpoint(1, summing_up);
    for (const int i : turned)
        result.turned.push_back({u[size_t(i % columns)], v[size_t(i / columns)], samples.distance[size_t(i)]});
    for (int i = 0; i < count; ++i)
        if (samples.counts[size_t(i)] && samples.distance[size_t(i)] > reference.listed_from)
            result.beyond.push_back({u[size_t(i % columns)], v[size_t(i / columns)], samples.distance[size_t(i)]});
    return result;
}

/// How densely the surface is tessellated to start the projections: as asked, but sparser on a very
/// large net, where memory is short and the spans are nearly flat.
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
    const Reference reference{mesh,
                              part_faces,
                              options.tolerance,
                              options.listed_from * options.tolerance,
                              ClosestPointSearch(mesh, progress.part(0, 0)),
                              MeshNormals(mesh, part_faces, options.sharp_angle)};

    Deviation result;
    SurfaceMeasure measured = measure_surface(surface, u, v, shares(u), shares(v), reference, progress.part(0, 0.3));
    result.surface_to_mesh = measured.distance;
    result.normal = measured.normal;
    result.beyond = std::move(measured.beyond);
    result.turned = std::move(measured.turned);
    if (!options.data_u.empty())
        result.between_data =
            measure_surface(surface, middles(options.data_u), middles(options.data_v), lengths(options.data_u),
                            lengths(options.data_v), reference, progress.part(0.3, 0.35))
                .distance;
    if (!options.mesh_to_surface)
        return result;

    progress.checkpoint(0.35, "preparing the surface");
    const SurfaceProjection projection(surface, start_samples_per_span(surface, options.samples_per_span),
                                       progress.part(0.35, 0.4));
    progress.checkpoint(0.4, "measuring from the mesh to the surface");
    MeshSamples places = sample_mesh(mesh, part_faces);
    const int count = int(places.position.cols());
    Samples samples(count);
    samples.weight = std::move(places.weight);
    samples.counts = std::move(places.counts);
    Eigen::Matrix2Xd foot_uv(2, count);
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    result.at_vertex.resize(mesh.vertices());
    for_each_in_parts(count, progress.part(0.4, 1), "measuring from the mesh to the surface", [&](int i) {
        const Eigen::Vector3d point = places.position.col(i);
        const SurfaceFoot foot = projection.nearest(point);
        samples.distance[size_t(i)] = foot.distance;
        foot_uv.col(i) << foot.u, foot.v;
        if (i < mesh.vertices()) {
            const bool outside = (foot.position - point).dot(normal.col(i)) >= 0;
            result.at_vertex[i] = outside ? foot.distance : -foot.distance;
        }
    });
    result.mesh_to_surface = statistics(
        samples, options.tolerance, [&](int i) -> Eigen::Vector3d { return places.position.col(i); }, progress);
    for (int i = 0; i < count; ++i)
        if (samples.counts[size_t(i)] && samples.distance[size_t(i)] > reference.listed_from)
            result.beyond.push_back({foot_uv(0, i), foot_uv(1, i), samples.distance[size_t(i)]});
    return result;
}

} // namespace spia

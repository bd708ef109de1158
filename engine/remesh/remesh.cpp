#include "engine/remesh/remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/place_text.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/topology.h"
#include "engine/remesh/edge_sizes.h"
#include "engine/remesh/incremental.h"
#include "engine/remesh/kept_lines.h"
#include "engine/remesh/thin_faces.h"
#include "engine/remesh/two_way_distance.h"

namespace spia {
namespace {

void require_in_range(const TriMesh& part, const RemeshOptions& options, std::span<const int> label)
{
    const double diagonal = bounding_diagonal(part);
    if (options.size && !(*options.size >= 1e-4 * diagonal && *options.size <= diagonal))
        throw InputError(
            fmt::format("the size of remeshing is {} mm; give one from {:.3g} to {:.3g} mm, a ten-thousandth "
                        "of the part's diagonal to all of it",
                        *options.size, 1e-4 * diagonal, diagonal));
    if (options.tolerance && !(*options.tolerance >= 1e-7 * diagonal && *options.tolerance <= 0.1 * diagonal))
        throw InputError(
            fmt::format("the tolerance of remeshing is {} mm; give one from {:.3g} to {:.3g} mm, a ten-millionth "
                        "to a tenth of the part's diagonal",
                        *options.tolerance, 1e-7 * diagonal, 0.1 * diagonal));
    for (const auto& [angle, what] : {std::pair(options.sharp, "sharp edges"), {options.ridge, "ridges"}})
        if (!(angle > 0 && angle <= std::numbers::pi))
            throw InputError(
                fmt::format("the angle from which on {} are kept is {}; give one above 0 and up to pi", what, angle));
    if (!label.empty() && int(label.size()) != part.triangles())
        throw InputError(fmt::format("there are {} labels for {} faces", label.size(), part.triangles()));
}

/// The corner of the nearest face that is nearest.
int nearest_vertex(const TriMesh& part, const ClosestPointSearch& search, const Eigen::Vector3d& point)
{
    const ClosestPoint found = search.nearest(point);
    Eigen::Index corner;
    (part.position(Eigen::all, part.triangle.col(found.face)).colwise() - point)
        .colwise()
        .squaredNorm()
        .minCoeff(&corner);
    return part.triangle(corner, found.face);
}

/// Sorts vertices and faces by the given ones they are nearest to.
void sort_by_source(RemeshResult& result, const std::vector<int>& vertex, const std::vector<int>& face)
{
    const auto order_of = [](const std::vector<int>& key) {
        std::vector<int> order(key.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[size_t(a)] < key[size_t(b)]; });
        return order;
    };
    const std::vector<int> vertices = order_of(vertex), faces = order_of(face);
    std::vector<int> place(vertices.size());
    TriMesh sorted{Eigen::Matrix3Xd(3, vertices.size()), Eigen::Matrix3Xi(3, faces.size())};
    result.nearest_vertex.clear();
    result.nearest_face.clear();
    for (size_t i = 0; i < vertices.size(); ++i) {
        place[size_t(vertices[i])] = int(i);
        sorted.position.col(Eigen::Index(i)) = result.mesh.position.col(vertices[i]);
        result.nearest_vertex.push_back(vertex[size_t(vertices[i])]);
    }
    for (size_t i = 0; i < faces.size(); ++i) {
        for (int k = 0; k < 3; ++k)
            sorted.triangle(k, Eigen::Index(i)) = place[size_t(result.mesh.triangle(k, faces[i]))];
        result.nearest_face.push_back(face[size_t(faces[i])]);
    }
    result.mesh = std::move(sorted);
}

/// Fills what leads from the new mesh to the given one.
/// @param face  per new face: the given one nearest to its middle
void lead_back(RemeshResult& result, const TriMesh& part, const ClosestPointSearch& search,
               const std::vector<int>& face)
{
    std::vector<int> vertex(size_t(result.mesh.vertices()));
    parallel_for(result.mesh.vertices(),
                 [&](int v) { vertex[size_t(v)] = nearest_vertex(part, search, result.mesh.position.col(v)); });
    sort_by_source(result, vertex, face);
}

/// The median edge, or if that is longer that of as many equilateral triangles: long slivers have
/// short edges between them.
double usual_edge(const TriMesh& mesh, double median)
{
    return std::max(median, std::sqrt(4 / std::sqrt(3.0) * area(mesh) / mesh.triangles()));
}

constexpr double no_height = 0.1; // of the tolerance: the normal of such a face is noise

/// What stays the same for every attempt.
struct Given {
    const TriMesh &part, &even; ///< even: without thin faces, with the vertices of the part
    const KeptLines& lines;
    const ClosestPointSearch &on_part, &on_even;
};

/// What keeps a new mesh from being taken.
struct Fault {
    std::string text;      ///< empty: nothing
    EdgeSizes shorter;     ///< of the part: what may help if all is done again
    Eigen::VectorXd share; ///< #V of the new mesh: of the length of edges there, which may help;
                           ///< empty: none would
};

std::string describe_place(const Eigen::Vector3d& p) { return place_text(p) + " mm"; }

/// Faces of the part that look against those around them, as where its surface folds back within a
/// tight bend: new faces are not to do so.
std::vector<char> folded_faces(const TriMesh& part, const Eigen::Matrix3Xd& normal)
{
    Eigen::Matrix3Xd around = Eigen::Matrix3Xd::Zero(3, part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            around.col(v) += normal.col(f);
    std::vector<char> folded(size_t(part.triangles()), 0);
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3d others = around(Eigen::all, part.triangle.col(f)).rowwise().sum() - 3 * normal.col(f);
        folded[size_t(f)] = others.dot(normal.col(f)) < 0;
    }
    return folded;
}

/// New faces that look to the other side than the given one that is nearest.
std::vector<int> turned_over(const TriMesh& mesh, const std::vector<int>& nearest, const TriMesh& part,
                             double tolerance)
{
    const Eigen::Matrix3Xd normal = area_vectors(part), new_normal = area_vectors(mesh);
    const std::vector<char> folded = folded_faces(part, normal);
    std::vector<int> result;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const int near = nearest[size_t(f)];
        if (new_normal.col(f).dot(normal.col(near)) < 0 && !folded[size_t(near)] &&
            !is_thin(part, near, no_height * tolerance))
            result.push_back(f);
    }
    return result;
}

/// Where edges have to be shorter, on the part and on the new mesh.
class Shortening {
public:
    Shortening(Fault& fault, const Given& given, const TriMesh& mesh, const SizeField& size, double tolerance)
        : fault_(fault), given_(given), mesh_(mesh), size_(size), tolerance_(tolerance)
    {
        fault.shorter = size.sizes();
        fault.share = Eigen::VectorXd::Ones(mesh.vertices());
    }

    /// @param distance  mm; what cuts off a ridge does so in proportion to its length
    void at(int face, int given_face, double distance)
    {
        const double share = std::clamp(0.6 * tolerance_ / distance, 0.3, 0.75);
        for (const int v : given_.part.triangle.col(given_face))
            fault_.shorter.at_vertex[v] = std::min(fault_.shorter.at_vertex[v], share * size_.at_vertex(v));
        const Eigen::Vector3d place = mesh_.position(Eigen::all, mesh_.triangle.col(face)).rowwise().mean();
        const ClosestPoint near = given_.on_even.nearest(place);
        fault_.shorter.elsewhere.push_back({place, share * size_.in_face(near.face, near.barycentric)});
        for (const int v : mesh_.triangle.col(face))
            fault_.share[v] = std::min(fault_.share[v], share);
    }

private:
    Fault& fault_;
    const Given& given_;
    const TriMesh& mesh_;
    const SizeField& size_;
    double tolerance_;
};

/// @param distance  as measured for the mesh
Fault fault_of(const TriMesh& mesh, const TwoWayDistance& distance, const Given& given, const SizeField& size,
               double tolerance)
{
    const TriMesh& part = given.part;
    Fault fault;
    const MeshDistance &to_part = distance.to_part(), &from_part = distance.from_part();
    Shortening shorten(fault, given, mesh, size, tolerance);
    const std::vector<int> over = turned_over(mesh, to_part.nearest, part, tolerance);
    for (const int f : over)
        shorten.at(f, to_part.nearest[size_t(f)], to_part.of_face[f]);
    for (int f = 0; f < mesh.triangles(); ++f)
        if (to_part.of_face[f] > tolerance)
            shorten.at(f, to_part.nearest[size_t(f)], to_part.of_face[f]);
    for (int f = 0; f < part.triangles(); ++f)
        if (from_part.of_face[f] > tolerance)
            shorten.at(distance.on_mesh().nearest(from_part.place.col(f)).face, f, from_part.of_face[f]);
    if (distance.bound() > tolerance)
        fault.text =
            fmt::format("the remeshed part is {:.3g} mm from the given one at {}, beyond the tolerance of {:.3g} mm",
                        distance.bound(),
                        describe_place(to_part.seen > from_part.seen ? to_part.where : from_part.where), tolerance);
    else if (!over.empty())
        fault.text =
            fmt::format("a face of the remeshed part is turned over at {}",
                        describe_place(mesh.position(Eigen::all, mesh.triangle.col(over.front())).rowwise().mean()));
    return fault;
}

/// A mesh of another kind than the part is not measured.
Fault fault_of_type(const SurfaceType& before, const SurfaceType& after, const SizeField& size)
{
    if (before.loops == after.loops && before.genus == after.genus)
        return {};
    EdgeSizes half = size.sizes();
    half.at_vertex /= 2;
    for (EdgeSizes::Place& place : half.elsewhere)
        place.size /= 2;
    return {fmt::format("the remeshed part has {} boundary loops and genus {} in place of {} and {}", after.loops,
                        after.genus, before.loops, before.genus),
            std::move(half),
            {}};
}

/// Remeshes with these sizes. Where the mesh is not good it is made finer there until it is, a few
/// times.
/// @param limits  that the sizes are of
/// @returns what is wrong with it in the end
Fault attempt(RemeshResult& result, const Given& given, const SizeField& size, const SizeLimits& limits,
              const IncrementalOptions& options, const Progress& progress)
{
    constexpr int most_repairs = 8;       // two or three are usual
    constexpr int most_in_vain = 2;       // in a row: faces that are turned over may stay so
                                          // however small they are
    constexpr double most_at_fault = 0.1; // of the vertices; where most are the sizes are wrong
    constexpr double all_rounds = 0.7, share_of_making = 0.7;
    const SurfaceType type = surface_type(given.part);
    IncrementalRemesh remesh(given.even, given.lines, size, given.on_even, options, progress.part(0, 0));
    TwoWayDistance distance(given.part, given.on_part, result.tolerance);
    double least = limits.least;
    int in_vain = 0;
    Eigen::Index before = std::numeric_limits<Eigen::Index>::max(); // vertices at fault
    remesh.run(progress.part(0, share_of_making * all_rounds));
    for (int repair = 0;; ++repair) {
        const auto from = [&](double within) {
            return repair == 0 ? within * all_rounds
                               : all_rounds + (1 - all_rounds) * (repair - 1 + within) / most_repairs;
        };
        IncrementalRemesh::Snapshot snapshot = remesh.snapshot();
        result.mesh = std::move(snapshot.mesh);
        if (Fault other = fault_of_type(type, surface_type(result.mesh), size); !other.text.empty())
            return other;
        distance.measure(result.mesh, snapshot.was, progress.part(from(share_of_making), from(1)));
        result.distance = distance.bound();
        result.seen = distance.seen();
        Fault fault = fault_of(result.mesh, distance, given, size, result.tolerance);
        if (fault.text.empty())
            lead_back(result, given.part, given.on_part, distance.to_part().nearest);
        const Eigen::Index at_fault = (fault.share.array() < 1).count();
        in_vain = at_fault < before ? 0 : in_vain + 1;
        before = at_fault;
        if (fault.text.empty() || repair == most_repairs || in_vain == most_in_vain ||
            double(at_fault) >= most_at_fault * double(result.mesh.vertices()))
            return fault;
        least /= 2;
        const double next = all_rounds + (1 - all_rounds) * repair / most_repairs;
        remesh.refine(fault.share, least, limits.growth,
                      progress.part(next, next + share_of_making * (1 - all_rounds) / most_repairs));
    }
}

/// Edges that become longer within long faces leave out triangles that no tolerance asks for. They
/// are taken where they are half of all, as in needles across flat faces: fewer are of use to the
/// strains of a drawn sheet. (A drawn cone was solved in the law as given with 27 878 triangles,
/// and with the hardening curve continued with 23 155.)
SizeField::LongFaces in_long_faces(const TriMesh& even, const EdgeSizes& sizes)
{
    constexpr double worth = 2;
    using Long = SizeField::LongFaces;
    const double between = SizeField(even, sizes, Long::between_corners).triangles();
    return between > worth * SizeField(even, sizes, Long::grow).triangles() ? Long::grow : Long::between_corners;
}

} // namespace

RemeshResult remesh(const TriMesh& part, const RemeshOptions& options, std::span<const int> label,
                    const Progress& progress)
{
    const auto clock = std::chrono::steady_clock::now();
    require_in_range(part, options, label);
    const double diagonal = bounding_diagonal(part);
    RemeshResult result;
    result.before = triangle_quality(part);
    result.size =
        options.size.value_or(std::clamp(usual_edge(part, result.before.median_edge), diagonal / 250, diagonal / 40));
    result.tolerance = options.tolerance.value_or(diagonal / 1000);

    std::vector<int> labels(label.begin(), label.end());
    const TriMesh even =
        // with the vertices of the part
        without_thin_faces(part, no_height * result.tolerance, labels);
    const KeptLines lines = kept_lines(even, labels, options.sharp, options.ridge, result.size);
    result.lines = int(lines.line.size());
    result.corners = int(std::count(lines.corner.begin(), lines.corner.end(), 1));
    const ClosestPointSearch search(part), on_even(even);
    const Given given{part, even, lines, search, on_even};
    constexpr double planned = 0.6, allowed = 0.75; // of the tolerance, for chords
    SizeLimits limits{result.size, result.size / 10, planned * result.tolerance};
    Fault fault;
    constexpr int most_attempts = 6;
    double most_triangles = std::max(1e6, 4.0 * part.triangles());
    std::optional<SizeField::LongFaces> long_faces; // of the first attempt
    const auto refuse = [&](const char* what) {
        throw InputError(fmt::format("{}; give {} (now {:.4g} mm) or a larger tolerance, or take the part without "
                                     "remeshing",
                                     fault.text, what, result.size));
    };
    for (int done = 0;; ++done) {
        constexpr double left = 0.2; // of the way after an attempt: mostly the first one is good
        const Progress here = progress.part(1 - std::pow(left, done), 1 - std::pow(left, done + 1));
        EdgeSizes sizes = edge_sizes(even, lines, limits, fault.shorter);
        if (!long_faces)
            long_faces = in_long_faces(even, sizes);
        const SizeField size(even, std::move(sizes), *long_faces);
        const double count = size.triangles();
        if (count > most_triangles) {
            if (!fault.text.empty())
                refuse("a smaller size");
            fault.text =
                fmt::format("a size of {:.4g} mm and a tolerance of {:.3g} mm would take {:.2g} million triangles",
                            result.size, result.tolerance, count / 1e6);
            refuse("a larger size");
        }
        constexpr double most_growth = 20; // then shorter edges do not help
        // 1.5 for a triangle that is to be; the needles of CAD faces take up to 15 times as many on
        // the way.
        const double most_edges = std::max(2e6, 25 * 1.5 * count);
        if (done == 0)
            most_triangles = std::min(most_triangles, most_growth * count);
        fault = attempt(result, given, size, limits, {allowed * result.tolerance, most_edges}, here);
        if (fault.text.empty())
            break;
        if (done + 1 == most_attempts)
            refuse("a smaller size");
        limits.least /= 2;
    }
    result.after = triangle_quality(result.mesh);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return result;
}

} // namespace spia

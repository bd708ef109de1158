#include "engine/remesh/incremental.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numbers>

#include "engine/core/error.h"
#include "engine/remesh/border_clearance.h"
#include "engine/remesh/evolving_mesh.h"
#include "engine/remesh/triangle_quality.h"

namespace spia {
namespace {

using Vector = EvolvingMesh::Vector;
using Vertex = EvolvingMesh::Vertex;
using Edge = EvolvingMesh::Edge;
using Face = EvolvingMesh::Face;
using Quad = EvolvingMesh::Quad;

constexpr double degrees = std::numbers::pi / 180;

/// Calls each(i) for 0 <= i < count; large meshes take seconds.
template <class Each> void for_all(int count, const Progress& progress, const char* what, const Each& each)
{
    constexpr int at_a_time = 256; // mending takes milliseconds each
    for (int i = 0; i < count; ++i) {
        if (i % at_a_time == 0)
            progress.checkpoint(double(i) / count, what);
        each(i);
    }
}

/// Calls each(edge) for those that are free to change, but none that the calls make.
template <class Each>
void for_free_edges(const EvolvingMesh& mesh, const Progress& progress, const char* what, const Each& each)
{
    for_all(int(mesh.mesh().n_edges()), progress, what, [&](int e) {
        if (const Edge edge(e); !mesh.mesh().status(edge).deleted() && !mesh.on_line(edge))
            each(edge);
    });
}

/// How long it is beside the shorter one of the sizes at its ends.
double relative_length(const EvolvingMesh& mesh, Edge edge)
{
    const auto [a, b] = mesh.ends(edge);
    return mesh.length(a, b) / std::min(mesh.size(a), mesh.size(b));
}

void collapse_short(EvolvingMesh& mesh, const Progress& progress)
{
    for_free_edges(mesh, progress, "collapsing short edges", [&](Edge edge) {
        if (relative_length(mesh, edge) < EvolvingMesh::too_short)
            mesh.collapse_if_sound(edge);
    });
}

void split_long(EvolvingMesh& mesh, double most_edges, const Progress& progress)
{
    constexpr int most_sweeps = 12; // each halves
    constexpr size_t most_growth = 4;
    bool again = true;
    size_t before = mesh.mesh().n_edges();
    for (int sweep = 0; sweep < most_sweeps && again; ++sweep) {
        again = false;
        for_free_edges(mesh, sweep == 0 ? progress : progress.part(1, 1), "splitting long edges", [&](Edge edge) {
            if (relative_length(mesh, edge) <= EvolvingMesh::too_long)
                return;
            if (double(mesh.mesh().n_edges()) > most_edges) {
                const Vector at = mesh.at(mesh.ends(edge).first);
                throw InputError(fmt::format(
                    "remeshing would cut the needles near {:.6g}, {:.6g}, {:.6g} mm into more than {:.2g} million edges",
                    at.x(), at.y(), at.z(), most_edges / 1e6));
            }
            mesh.split(edge);
            again = true;
        });
        // Needles beside each other would all be cut to pieces as long as the sizes, a hundred times too many.
        if (mesh.mesh().n_edges() > most_growth * before) {
            collapse_short(mesh, progress.part(1, 1));
            before = mesh.mesh().n_edges();
        }
    }
}

/// Towards six neighbours of inner vertices and four of those at the boundary.
void flip_for_valence(EvolvingMesh& mesh, const Progress& progress)
{
    const auto excess = [&](Vertex v, int change) {
        const int wanted = mesh.mesh().is_boundary(v) ? 4 : 6, off = int(mesh.mesh().valence(v)) + change - wanted;
        return off * off;
    };
    for_free_edges(mesh, progress, "flipping edges", [&](Edge edge) {
        const auto v = mesh.quad(edge);
        if (!v)
            return;
        const int before = excess((*v)[0], 0) + excess((*v)[1], 0) + excess((*v)[2], 0) + excess((*v)[3], 0);
        const int after = excess((*v)[0], -1) + excess((*v)[1], -1) + excess((*v)[2], 1) + excess((*v)[3], 1);
        constexpr double still_good = 20 * degrees;
        if (after < before)
            mesh.flip_if_sound(edge, *v, std::min(mesh.worst_angle(*v), still_good));
    });
}

void flip_for_angle(EvolvingMesh& mesh, const Progress& progress)
{
    for_free_edges(mesh, progress, "flipping edges", [&](Edge edge) {
        if (const auto v = mesh.quad(edge))
            mesh.flip_if_sound(edge, *v, mesh.worst_angle(*v));
    });
}

/// To the mean of the middles of the faces around, each with its share of what the sizes ask for.
void smooth(EvolvingMesh& mesh, const Progress& progress)
{
    const HalfedgeMesh& around = mesh.mesh();
    for_all(int(around.n_vertices()), progress, "smoothing", [&](int i) {
        const Vertex v(i);
        if (around.status(v).deleted() || mesh.on_line(v))
            return;
        Vector sum = Vector::Zero(), normal = Vector::Zero();
        double weights = 0;
        for (const Face f : around.vf_range(v)) {
            const EvolvingMesh::Corners t = mesh.triangle(f);
            const Vector area = EvolvingMesh::area_of(t);
            double mean_size = 0;
            for (const Vertex w : around.fv_range(f))
                mean_size += mesh.size(w) / 3;
            const double weight = area.norm() / (mean_size * mean_size);
            sum += weight * t.rowwise().mean();
            weights += weight;
            normal += area;
        }
        if (!(weights > 0) || !(normal.norm() > 0))
            return;
        normal.normalize();
        Vector way = sum / weights - mesh.at(v);
        way -= normal.dot(way) * normal;
        constexpr double arrived = 0.003; // of the size
        if (way.norm() < arrived * mesh.size(v))
            return;
        constexpr double good_enough = 35 * degrees;
        for (const double share : {1.0, 0.4})
            if (mesh.move(v, mesh.at(v) + share * way, normal, good_enough))
                break;
    });
}

/// The shortest and the longest.
std::pair<Edge, Edge> extreme_edges(const EvolvingMesh& mesh, Face f)
{
    Edge shortest, longest;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Edge e : mesh.mesh().fe_range(f)) {
        const auto [a, b] = mesh.ends(e);
        const double length = mesh.length(a, b);
        if (length < least) {
            least = length;
            shortest = e;
        }
        if (length > most) {
            most = length;
            longest = e;
        }
    }
    return {shortest, longest};
}

bool flip_longest(EvolvingMesh& mesh, Face f)
{
    const Edge longest = extreme_edges(mesh, f).second;
    const auto v = longest.is_valid() ? mesh.quad(longest) : std::nullopt;
    return v && mesh.flip_if_sound(longest, *v, mesh.worst_angle(*v));
}

bool collapse_shortest(EvolvingMesh& mesh, Face f)
{
    const Edge shortest = extreme_edges(mesh, f).first;
    return shortest.is_valid() && !mesh.on_line(shortest) && mesh.collapse_if_sound(shortest);
}

/// Moves the free corners of the face up the least angle around them, by trial in eight directions.
void climb(EvolvingMesh& mesh, Face f)
{
    constexpr int directions = 8;
    std::array<Vertex, 3> corners;
    size_t corner = 0;
    for (const Vertex v : mesh.mesh().fv_range(f))
        corners[corner++] = v;
    for (const Vertex v : corners) {
        if (mesh.on_line(v))
            continue;
        Vector normal = Vector::Zero();
        for (const Face g : mesh.mesh().vf_range(v))
            normal += EvolvingMesh::area_of(mesh.triangle(g));
        if (!(normal.norm() > 0))
            continue;
        normal.normalize();
        const Vector u = normal.unitOrthogonal(), w = normal.cross(u);
        for (double step = 0.3 * mesh.size(v); step > 0.02 * mesh.size(v); step /= 2)
            for (int k = 0; k < directions; ++k) {
                const double turn = 2 * std::numbers::pi * k / directions;
                mesh.move(v, mesh.at(v) + step * (std::cos(turn) * u + std::sin(turn) * w), normal, std::numbers::pi);
            }
    }
}

/// Flips, collapses and moves what is left of thin triangles.
/// @param thin  radians
/// @returns how many there are
int mend_thin(EvolvingMesh& mesh, double thin, const Progress& progress)
{
    int left = 0;
    for_all(int(mesh.mesh().n_faces()), progress, "mending thin triangles", [&](int i) {
        const Face f(i);
        if (mesh.mesh().status(f).deleted() || least_angle(mesh.triangle(f)) >= thin)
            return;
        ++left;
        if (!flip_longest(mesh, f) && !collapse_shortest(mesh, f))
            climb(mesh, f);
    });
    return left;
}

} // namespace

TriMesh remesh_incrementally(const TriMesh& part, const KeptLines& lines, const Eigen::VectorXd& size,
                             const ClosestPointSearch& search, const IncrementalOptions& options,
                             const Progress& progress)
{
    progress.checkpoint(0, "dividing the kept lines");
    const Eigen::VectorXd gap = border_clearance(part, 1.5 * options.sagitta, progress.part(0, 0));
    EvolvingMesh mesh(part, lines, size, search, options.sagitta, gap, progress.part(0, 0));
    flip_for_angle(mesh, progress.part(0, 0.01)); // thin triangles hinder collapses
    mesh.drop_line_vertices();                    // strips: what will go is not split along their length before
    collapse_short(mesh, progress.part(0.01, 0.02));
    for (int round = 0; round < options.rounds; ++round) {
        const auto step = [&](double from, double to) {
            return progress.part(0.02 + 0.78 * (round + from) / options.rounds,
                                 0.02 + 0.78 * (round + to) / options.rounds);
        };
        split_long(mesh, options.most_edges, step(0, 0.2));
        mesh.drop_line_vertices();
        collapse_short(mesh, step(0.2, 0.5));
        flip_for_valence(mesh, step(0.5, 0.6));
        smooth(mesh, step(0.6, 0.8));
        smooth(mesh, step(0.8, 1));
    }
    constexpr int most_mends = 10;
    constexpr double thin = 30 * degrees;
    for (int mend = 0; mend < most_mends; ++mend) {
        const Progress here = progress.part(0.8 + 0.2 * mend / most_mends, 0.8 + 0.2 * (mend + 1) / most_mends);
        flip_for_angle(mesh, here.part(0, 0.2));
        smooth(mesh, here.part(0.2, 0.6));
        if (mend_thin(mesh, thin, here.part(0.6, 1)) == 0)
            break;
    }
    mesh.drop_line_vertices();
    return mesh.finished();
}

} // namespace spia

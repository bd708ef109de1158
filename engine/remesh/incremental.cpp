#include "engine/remesh/incremental.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/remesh/border_clearance.h"
#include "engine/remesh/evolving_mesh.h"

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
    constexpr int at_a_time = 256; // improving takes milliseconds each
    for (int i = 0; i < count; ++i) {
        if (i % at_a_time == 0)
            progress.checkpoint(double(i) / count, what);
        each(i);
    }
}

using Tick = EvolvingMesh::Tick;

/// When each edge, vertex or face was last tried: what was left as it was would be so again before
/// something around it changes.
class LastTried {
public:
    /// @param handle  of an edge, vertex or face
    /// @param since   changes up to then do not count
    template <class Handle> bool due(const EvolvingMesh& mesh, Handle handle, Tick since)
    {
        if (!mesh.open(handle))
            return false;
        const size_t i = size_t(handle.idx());
        if (i >= tried_.size())
            tried_.resize(i + i / 2 + 1, never);
        if (mesh.changed(handle) <= std::max(tried_[i], since))
            return false;
        tried_[i] = mesh.now();
        return true;
    }

private:
    static constexpr Tick never = -1;
    std::vector<Tick> tried_;
};

/// What is worked on, and what was tried there.
struct Work {
    explicit Work(EvolvingMesh evolving) : mesh(std::move(evolving)) {}

    EvolvingMesh mesh;
    LastTried to_split, to_collapse, to_flip_for_valence, to_flip_for_angle, to_smooth, to_improve;
    Tick since = -1; ///< only what has changed after this is looked at
};

/// Calls each(edge) for those that are free to change and due, but none that the calls make.
template <class Each>
void for_free_edges(Work& work, LastTried& tried, const Progress& progress, const char* what, const Each& each)
{
    const EvolvingMesh& mesh = work.mesh;
    for_all(int(mesh.mesh().n_edges()), progress, what, [&](int e) {
        if (const Edge edge(e);
            !mesh.mesh().status(edge).deleted() && !mesh.on_line(edge) && tried.due(mesh, edge, work.since))
            each(edge);
    });
}

/// How long it is beside the shorter one of the sizes at its ends.
double relative_length(const EvolvingMesh& mesh, Edge edge)
{
    const auto [a, b] = mesh.ends(edge);
    return mesh.length(a, b) / std::min(mesh.size(a), mesh.size(b));
}

void collapse_short(Work& work, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    for_free_edges(work, work.to_collapse, progress, "collapsing short edges", [&](Edge edge) {
        if (relative_length(mesh, edge) < EvolvingMesh::too_short)
            mesh.collapse_if_sound(edge);
    });
}

void split_long(Work& work, double most_edges, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    constexpr int most_sweeps = 12; // each halves
    constexpr size_t most_growth = 4;
    bool again = true;
    size_t before = mesh.mesh().n_edges();
    for (int sweep = 0; sweep < most_sweeps && again; ++sweep) {
        again = false;
        const Progress here = sweep == 0 ? progress : progress.part(1, 1);
        for_free_edges(work, work.to_split, here, "splitting long edges", [&](Edge edge) {
            if (relative_length(mesh, edge) <= EvolvingMesh::too_long)
                return;
            if (double(mesh.mesh().n_edges()) > most_edges) {
                const Vector at = mesh.at(mesh.ends(edge).first);
                throw InputError(
                    fmt::format("remeshing would cut the needles near {} mm into more than {:.2g} million edges",
                                place_text(at), most_edges / 1e6));
            }
            again = mesh.split(edge) || again;
        });
        // Needles beside each other would all be cut to pieces as long as the sizes, a hundred
        // times too many.
        if (mesh.mesh().n_edges() > most_growth * before) {
            collapse_short(work, progress.part(1, 1));
            before = mesh.mesh().n_edges();
        }
    }
}

/// Towards six neighbours of inner vertices and four of those at the boundary.
void flip_for_valence(Work& work, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    const auto excess = [&](Vertex v, int change) {
        int edges = 0;
        bool inner = true;
        for (const EvolvingMesh::Halfedge h : mesh.mesh().voh_range(v)) {
            ++edges;
            inner = inner && !mesh.mesh().is_boundary(h);
        }
        const int off = edges + change - (inner ? 6 : 4);
        return off * off;
    };
    for_free_edges(work, work.to_flip_for_valence, progress, "flipping edges", [&](Edge edge) {
        const auto v = mesh.quad(edge);
        if (!v)
            return;
        const int before = excess((*v)[0], 0) + excess((*v)[1], 0) + excess((*v)[2], 0) + excess((*v)[3], 0);
        const int after = excess((*v)[0], -1) + excess((*v)[1], -1) + excess((*v)[2], 1) + excess((*v)[3], 1);
        static const double still_good = EvolvingMesh::thinness(20 * degrees);
        if (after < before)
            mesh.flip_if_sound(edge, *v, std::max(mesh.thinness(*v), still_good));
    });
}

void flip_for_angle(Work& work, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    for_free_edges(work, work.to_flip_for_angle, progress, "flipping edges", [&](Edge edge) {
        if (const auto v = mesh.quad(edge))
            mesh.flip_if_sound(edge, *v, mesh.thinness(*v));
    });
}

/// To the mean of the middles of the faces around, each with its share of what the sizes ask for.
void smooth(Work& work, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    const HalfedgeMesh& around = mesh.mesh();
    for_all(int(around.n_vertices()), progress, "smoothing", [&](int i) {
        const Vertex v(i);
        if (around.status(v).deleted() || mesh.on_line(v) || !work.to_smooth.due(mesh, v, work.since))
            return;
        Vector sum = Vector::Zero(), normal = Vector::Zero();
        double weights = 0;
        for (const EvolvingMesh::Halfedge out : around.voh_range(v)) {
            if (around.is_boundary(out))
                continue;
            const Vertex a = around.to_vertex_handle(out),
                         b = around.to_vertex_handle(around.next_halfedge_handle(out));
            const EvolvingMesh::Corners t = mesh.triangle(v, a, b);
            const Vector area = EvolvingMesh::area_of(t);
            const double mean_size = (mesh.size(v) + mesh.size(a) + mesh.size(b)) / 3;
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
        if (way.norm() < arrived * mesh.size(v) && !mesh.on_chord(v))
            return;
        static const double good_enough = EvolvingMesh::thinness(35 * degrees);
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
    return v && mesh.flip_if_sound(longest, *v, mesh.thinness(*v));
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
                mesh.move(v, mesh.at(v) + step * (std::cos(turn) * u + std::sin(turn) * w), normal, 0);
            }
    }
}

/// Flips, collapses and moves what is left of thin triangles.
/// @param thin  which they are, as EvolvingMesh::thinness()
/// @returns how many there are that something may be done about
int improve_thin(Work& work, double thin, const Progress& progress)
{
    EvolvingMesh& mesh = work.mesh;
    int left = 0;
    for_all(int(mesh.mesh().n_faces()), progress, "improving thin triangles", [&](int i) {
        const Face f(i);
        if (mesh.mesh().status(f).deleted() || !work.to_improve.due(mesh, f, work.since) ||
            EvolvingMesh::thinness(mesh.triangle(f)) <= thin)
            return;
        ++left;
        if (!flip_longest(mesh, f) && !collapse_shortest(mesh, f))
            climb(mesh, f);
    });
    return left;
}

/// Halves edges of kept lines; divide_line() has divided them for the sizes that were asked for at
/// first.
void split_long_lines(Work& work)
{
    EvolvingMesh& mesh = work.mesh;
    for (int e = 0, edges = int(mesh.mesh().n_edges()); e < edges; ++e)
        if (const Edge edge(e); !mesh.mesh().status(edge).deleted() && mesh.on_line(edge) && mesh.open(edge) &&
                                mesh.changed(edge) > work.since && relative_length(mesh, edge) > EvolvingMesh::too_long)
            mesh.split_line(edge);
}

void one_round(Work& work, double most_edges, const Progress& progress)
{
    split_long(work, most_edges, progress.part(0, 0.2));
    work.mesh.drop_line_vertices();
    collapse_short(work, progress.part(0.2, 0.5));
    flip_for_valence(work, progress.part(0.5, 0.6));
    smooth(work, progress.part(0.6, 0.8));
    smooth(work, progress.part(0.8, 1));
}

void improve_shapes(Work& work, const Progress& progress)
{
    constexpr int most_rounds = 10;
    static const double thin = EvolvingMesh::thinness(30 * degrees);
    for (int round = 0; round < most_rounds; ++round) {
        const Progress here = progress.part(double(round) / most_rounds, double(round + 1) / most_rounds);
        flip_for_angle(work, here.part(0, 0.2));
        smooth(work, here.part(0.2, 0.6));
        if (improve_thin(work, thin, here.part(0.6, 1)) == 0)
            break;
    }
    work.mesh.drop_line_vertices();
}

} // namespace

struct IncrementalRemesh::State {
    Work work;
    IncrementalOptions options;
};

IncrementalRemesh::IncrementalRemesh(const TriMesh& part, const KeptLines& lines, const SizeField& size,
                                     const ClosestPointSearch& search, const IncrementalOptions& options,
                                     const Progress& progress)
{
    progress.checkpoint(0, "dividing the kept lines");
    const Eigen::VectorXd gap = border_clearance(part, 1.5 * options.sagitta, progress.part(0, 0));
    EvolvingMesh mesh(part, lines, size, search, options.sagitta, gap, progress.part(0, 0));
    state_ = std::make_unique<State>(State{Work(std::move(mesh)), options});
}

IncrementalRemesh::~IncrementalRemesh() = default;

void IncrementalRemesh::run(const Progress& progress)
{
    Work& work = state_->work;
    flip_for_angle(work, progress.part(0, 0.01)); // thin triangles hinder collapses
    work.mesh.drop_line_vertices();               // strips: what will go is not split along their
                                                  // length before
    collapse_short(work, progress.part(0.01, 0.02));
    const int rounds = state_->options.rounds;
    for (int round = 0; round < rounds; ++round)
        one_round(work, state_->options.most_edges,
                  progress.part(0.02 + 0.78 * round / rounds, 0.02 + 0.78 * (round + 1) / rounds));
    improve_shapes(work, progress.part(0.8, 1));
}

void IncrementalRemesh::refine(const Eigen::VectorXd& share, double least, double growth, const Progress& progress)
{
    Work& work = state_->work;
    work.since = work.mesh.now();
    work.mesh.shorten(share, least, growth);
    constexpr int rounds = 4; // one halves edges, and the rest lets those around follow
    for (int round = 0; round < rounds; ++round) {
        split_long_lines(work);
        one_round(work, state_->options.most_edges, progress.part(0.8 * round / rounds, 0.8 * (round + 1) / rounds));
    }
    improve_shapes(work, progress.part(0.8, 1));
}

IncrementalRemesh::Snapshot IncrementalRemesh::snapshot()
{
    EvolvingMesh::Finished finished = state_->work.mesh.finished();
    return {std::move(finished.mesh), std::move(finished.was)};
}

TriMesh remesh_incrementally(const TriMesh& part, const KeptLines& lines, const SizeField& size,
                             const ClosestPointSearch& search, const IncrementalOptions& options,
                             const Progress& progress)
{
    IncrementalRemesh remesh(part, lines, size, search, options, progress);
    remesh.run(progress);
    return remesh.snapshot().mesh;
}

} // namespace spia

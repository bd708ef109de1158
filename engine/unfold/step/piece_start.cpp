#include "engine/unfold/step/piece_start.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/forming/solver/energy_stage.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/rigid_steps.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The fixed faces beside the hinge, those first that share a vertex with it, then those beside
/// them.
std::vector<std::vector<int>> fixed_rings(const TriMesh& part, const std::vector<int>& fixed, const FreedPiece& piece)
{
    std::vector<std::vector<int>> faces_at(size_t(part.vertices()));
    for (const int f : fixed)
        for (const int v : part.triangle.col(f))
            faces_at[size_t(v)].push_back(f);
    std::vector<char> seen_face(size_t(part.triangles()), 0), seen_vertex(size_t(part.vertices()), 0);
    std::vector<int> front;
    for (const auto& edge : piece.hinge)
        for (const int v : edge)
            if (!std::exchange(seen_vertex[size_t(piece.vertex[size_t(v)])], char(1)))
                front.push_back(piece.vertex[size_t(v)]);
    std::vector<std::vector<int>> rings;
    while (!front.empty()) {
        std::vector<int> ring, next;
        for (const int v : front)
            for (const int f : faces_at[size_t(v)])
                if (!std::exchange(seen_face[size_t(f)], char(1)))
                    ring.push_back(f);
        for (const int f : ring)
            for (const int v : part.triangle.col(f))
                if (!std::exchange(seen_vertex[size_t(v)], char(1)))
                    next.push_back(v);
        if (!ring.empty())
            rings.push_back(std::move(ring));
        front = std::move(next);
    }
    return rings;
}

/// The piece with some fixed faces beside it, as it is in the state. Vertices and faces of the
/// piece come first.
TriMesh with_beside(const TriMesh& part, const Eigen::Matrix3Xd& state, const FreedPiece& piece,
                    const std::vector<int>& beside)
{
    std::vector<int> vertex = piece.vertex, number(size_t(part.vertices()), -1);
    for (size_t v = 0; v < vertex.size(); ++v)
        number[size_t(vertex[v])] = int(v);
    for (const int f : beside)
        for (const int v : part.triangle.col(f))
            if (number[size_t(v)] < 0) {
                number[size_t(v)] = int(vertex.size());
                vertex.push_back(v);
            }
    TriMesh mesh{state(Eigen::all, vertex), {}};
    mesh.triangle.resize(3, piece.mesh.triangle.cols() + Eigen::Index(beside.size()));
    mesh.triangle.leftCols(piece.mesh.triangles()) = piece.mesh.triangle;
    for (size_t k = 0; k < beside.size(); ++k)
        for (int a = 0; a < 3; ++a)
            mesh.triangle(a, piece.mesh.triangles() + Eigen::Index(k)) = number[size_t(part.triangle(a, beside[k]))];
    return mesh;
}

/// One piece without handles whose faces around each vertex are one fan.
bool is_sheet(const TriMesh& mesh)
{
    std::vector<int> rims(size_t(mesh.vertices()), 0);
    bool even = true;
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        even &= end - begin <= 2;
        if (end - begin == 1) {
            ++rims[size_t(uses[begin].low)];
            ++rims[size_t(uses[begin].high)];
        }
    });
    return even && *std::max_element(rims.begin(), rims.end()) <= 2 && surface_type(mesh).sheet();
}

/// Which fixed faces to take along, what promises most first: a band holds the hinge in shape and
/// costs little; a whole fixed region tells which of a ring's two edges is the outer one.
std::vector<std::vector<int>> choices(const std::vector<std::vector<int>>& rings, const FreedPiece& piece)
{
    constexpr size_t band_rings = 3, much = 3;
    std::vector<int> band, whole;
    for (size_t k = 0; k < rings.size(); ++k) {
        whole.insert(whole.end(), rings[k].begin(), rings[k].end());
        if (k < band_rings)
            band.insert(band.end(), rings[k].begin(), rings[k].end());
    }
    const bool ring = boundary_loops(piece.mesh).size() > 1;
    std::vector<std::vector<int>> out{band, whole, {}};
    if (ring && whole.size() <= much * piece.face.size())
        std::swap(out[0], out[1]);
    if (band.size() == whole.size())
        out.erase(out.begin() + 1);
    return out;
}

Eigen::Matrix2Xd snapped(Eigen::Matrix2Xd X, const std::vector<HeldVertex>& held)
{
    for (const HeldVertex& h : held)
        X.col(h.vertex) = h.place;
    return X;
}

double largest_strain(const SolveContext& context, const Eigen::Matrix2Xd& X)
{
    double largest = 0;
    for (int f = 0; f < context.part.triangles(); ++f) {
        const Eigen::Matrix2d G =
            inverse_gradient(context.element[size_t(f)], corners(X, context.part.triangle.col(f)));
        largest = std::max(largest, svd(G).s.array().log().abs().maxCoeff());
    }
    return largest;
}

struct Attempt {
    std::optional<Eigen::Matrix2Xd> position; ///< the start, if there is one
    std::string why;                          ///< else
    int in_the_way = 0;                       ///< a face of the piece
};

int first_flipped(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix2Xd& X)
{
    for (Eigen::Index f = 0; f < triangle.cols(); ++f)
        if (flipped_triangles(triangle.col(f), X) > 0)
            return int(f);
    return 0;
}

/// Springs that grow stiffer, until the held vertices can be put where they belong.
Attempt drawn_to_places(SolveContext& context, Eigen::Matrix2Xd X, const Progress& progress)
{
    constexpr double little = 0.5;   // strain that the last move may add
    constexpr double softest = 1e-3; // of Young's modulus times thickness
    constexpr int rounds = 8, steps = 20;
    const Sheet sheet = sheet_with(context, Curve::continued, 0.25);
    EnergyOptions energy;
    energy.most_steps = steps;
    energy.decrement = 1e-2;
    energy.held = context.external.held;
    energy.spring = softest * sheet.thickness.mean() * sheet.law.front().young();
    for (int round = 0;; ++round) {
        Eigen::Matrix2Xd there = snapped(X, context.external.held);
        const bool possible = one_to_one_around_vertices(context.part, there);
        if (possible && (round == rounds || largest_strain(context, there) <= largest_strain(context, X) + little))
            return {std::move(there), "", 0};
        if (round == rounds)
            return {std::nullopt, "its triangles would turn over before it lies along the fixed faces",
                    first_flipped(context.part.triangle, there)};
        X = minimise_energy(context.part.triangle, context.element, sheet, X, context.matrix, context.cholesky, energy,
                            progress.part(double(round) / rounds, double(round + 1) / rounds))
                .position;
        energy.spring *= 10;
    }
}

/// The first guess of a mesh that begins with the piece, for the piece alone.
InitialGuess guess(const TriMesh& mesh, int vertices, const Progress& progress)
{
    const std::vector<Element> element = elements(mesh);
    BlockMatrix matrix(mesh.triangle, mesh.vertices());
    Cholesky cholesky(matrix);
    const Eigen::Vector3d up = area_vectors(mesh).rowwise().sum();
    StampingDirection unseen; // whatever the direction, it shall not be looked along
    unseen.direction = up.norm() > 0 ? Eigen::Vector3d(up.normalized()) : Eigen::Vector3d::UnitZ();
    unseen.height_field = false;
    InitialGuess out = initial_guess(mesh, element, unseen, matrix, cholesky, progress);
    out.position =
        more_rigid(mesh, RigidSteps(mesh, element, matrix, cholesky), std::move(out.position), progress.part(1, 1));
    out.position.conservativeResize(2, vertices);
    return out;
}

} // namespace

PieceStart piece_start(const TriMesh& part, const Eigen::Matrix3Xd& state, const std::vector<int>& fixed,
                       const FreedPiece& piece, SolveContext& context,
                       const std::function<void(const Eigen::Matrix2Xd&)>& measure, const Progress& progress)
{
    constexpr double far_off = 0.7; // of the held vertices' spread: turned inside out
    const std::vector<std::vector<int>> choice = choices(fixed_rings(part, fixed, piece), piece);
    Attempt best{std::nullopt, "", -1};
    for (size_t k = 0; k < choice.size(); ++k) {
        const Progress mine = progress.part(double(k) / double(choice.size()), double(k + 1) / double(choice.size()));
        const TriMesh mesh = with_beside(part, state, piece, choice[k]);
        if (!choice[k].empty() && !is_sheet(mesh))
            continue;
        InitialGuess start = guess(mesh, piece.mesh.vertices(), mine.part(0, 0.5));
        const double off = place_on(context.external.held, start.position);
        if (off > far_off && k + 1 < choice.size())
            continue;
        measure(start.position);
        Attempt attempt = drawn_to_places(context, std::move(start.position), mine.part(0.5, 1));
        if (attempt.position)
            return {std::move(*attempt.position), start.method};
        best = std::move(attempt);
    }
    throw SolveError(fmt::format("the freed piece around face {} finds no place on the target: {} (first at face {}); "
                                 "free fewer faces, or move a part of them in a step of their own",
                                 piece.face[0], best.why, piece.face[size_t(best.in_the_way)]));
}

} // namespace spia

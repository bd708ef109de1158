#include "engine/layout/simplify/relax.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace spia {

namespace {

/// What the faces around a vertex cost together, and the least of their qualities.
struct Around {
    double energy = 0, least = 1;

    /// Cheaper, and no face below the guard is worse than one was.
    bool better_than(const Around& other, double guard) const
    {
        constexpr double least_gain = 1e-4; // for which a vertex is moved
        return energy < other.energy - least_gain && least >= std::min(guard, other.least);
    }
};

Around around(LayoutMesh& mesh, int v, bool judge)
{
    Around result;
    for (const int f : mesh.vertex(v).faces) {
        if (judge)
            mesh.judge(f);
        result.energy += mesh.face(f).energy;
        result.least = std::min(result.least, mesh.face(f).quality);
    }
    return result;
}

/// mm: how far to go at first, a share of the mean side at the vertex.
double first_step(const LayoutMesh& mesh, int v)
{
    constexpr double share = 0.2;
    double sum = 0;
    for (const int f : mesh.vertex(v).faces) {
        const auto& corners = mesh.face(f).vertex;
        const size_t k = size_t(std::find(corners.begin(), corners.end(), v) - corners.begin());
        sum += (mesh.vertex(corners[(k + 1) % 4]).position - mesh.vertex(v).position).norm();
    }
    return share * sum / double(std::max<size_t>(1, mesh.vertex(v).faces.size()));
}

/// Where a sliding vertex may be: not on its neighbours.
struct Room {
    double from = 0, to = 0;
};

Room room_of(const LayoutMesh& mesh, int v)
{
    constexpr double margin = 0.05; // of the way between the neighbours
    const MeshVertex& own = mesh.vertex(v);
    const double from = own.s - std::abs(mesh.side(own.before, v).to - mesh.side(own.before, v).from),
                 to = own.s + std::abs(mesh.side(v, own.after).to - mesh.side(v, own.after).from);
    return {from + margin * (to - from), to - margin * (to - from)};
}

constexpr int halvings = 3; // of the step

/// Six directions, and the step halved where none of them helps.
void relax_free(LayoutMesh& mesh, int v, double guard)
{
    Around now = around(mesh, v, false);
    double step = first_step(mesh, v);
    constexpr int directions = 6, most_moves = 12;
    int moves = 0;
    for (int k = 0; k < halvings; step /= 2) {
        bool moved = false;
        for (int i = 0; i < directions && moves < most_moves; ++i) {
            const double angle = 2 * std::numbers::pi * i / directions;
            const Eigen::Vector2d at = mesh.vertex(v).position;
            mesh.move(v, at + step * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
            const Around there = around(mesh, v, true);
            if (there.better_than(now, guard)) {
                now = there;
                moved = true;
                ++moves;
            } else
                mesh.move(v, at);
        }
        if (moved && moves < most_moves)
            step *= 2; // undone by the loop's halving: the same step again
        else
            ++k;
    }
    around(mesh, v, true); // of the place it has in the end
}

void relax_sliding(LayoutMesh& mesh, int v, double guard)
{
    const Room room = room_of(mesh, v);
    Around now = around(mesh, v, false);
    double step = 0.25 * (room.to - room.from), s = mesh.vertex(v).s;
    constexpr int most_moves = 6;
    int moves = 0;
    for (int k = 0; k <= halvings; step /= 2) {
        bool moved = false;
        for (const double way : {step, -step}) {
            if (s + way < room.from || s + way > room.to || moves == most_moves)
                continue;
            mesh.slide(v, s + way);
            const Around there = around(mesh, v, true);
            if (there.better_than(now, guard)) {
                now = there;
                s += way;
                moved = true;
                ++moves;
                break;
            }
        }
        mesh.slide(v, s);
        if (moved)
            step *= 2;
        else
            ++k;
    }
    around(mesh, v, true);
}

int crossed_around(LayoutMesh& mesh, int v)
{
    int count = 0;
    for (const int f : mesh.vertex(v).faces)
        count += mesh.look_for_crossing(f);
    return count;
}

/// Moves one vertex, unless sides come to cross.
void relax_vertex(LayoutMesh& mesh, int v, double guard)
{
    const MeshVertex& own = mesh.vertex(v);
    if (own.faces.empty() || own.freedom == Freedom::fixed)
        return;
    const Eigen::Vector2d position = own.position;
    const double s = own.s;
    int before = 0;
    for (const int f : own.faces)
        before += mesh.face(f).crossed;
    own.freedom == Freedom::free ? relax_free(mesh, v, guard) : relax_sliding(mesh, v, guard);
    if (mesh.vertex(v).position == position || crossed_around(mesh, v) <= before)
        return;
    own.freedom == Freedom::free ? mesh.move(v, position) : mesh.slide(v, s);
    around(mesh, v, true);
    crossed_around(mesh, v);
}

} // namespace

void relax(LayoutMesh& mesh, const std::vector<int>& vertices, int sweeps, double guard)
{
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (const int v : vertices)
            relax_vertex(mesh, v, guard);
}

void relax_all(LayoutMesh& mesh, int sweeps, double guard)
{
    std::vector<int> all(size_t(mesh.vertices()));
    std::iota(all.begin(), all.end(), 0);
    relax(mesh, all, sweeps, guard);
}

} // namespace spia

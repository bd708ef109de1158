#include "engine/unfold/step/freed_piece.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"

namespace spia {
namespace {

enum class Role : char { other, fixed, freed };

std::vector<Role> roles(int faces, const std::vector<int>& fixed, const std::vector<int>& freed)
{
    std::vector<Role> role(size_t(faces), Role::other);
    for (const int f : fixed)
        role[size_t(f)] = Role::fixed;
    for (const int f : freed)
        role[size_t(f)] = Role::freed;
    return role;
}

/// Per vertex a face of each role around it; -1: none.
struct RolesAround {
    std::array<int, 3> face{-1, -1, -1};
    int of(Role role) const { return face[size_t(role)]; }
};

std::vector<RolesAround> around_vertices(const TriMesh& part, const std::vector<Role>& role)
{
    std::vector<RolesAround> around(size_t(part.vertices()));
    for (int f = part.triangles() - 1; f >= 0; --f) // the first face of a role is the one that is
                                                    // named
        for (const int v : part.triangle.col(f))
            around[size_t(v)].face[size_t(role[size_t(f)])] = f;
    return around;
}

[[noreturn]] void refuse_joint(int freed, int other)
{
    throw InputError(fmt::format("the freed face {} is joined to face {}, which is neither freed nor fixed and would "
                                 "be torn off; free it, too, or fix it",
                                 freed, other));
}

void require_free_borders(const TriMesh& part, const std::vector<int>& freed, const std::vector<RolesAround>& around)
{
    for (const int f : freed)
        for (const int v : part.triangle.col(f))
            if (const RolesAround& a = around[size_t(v)]; a.of(Role::other) >= 0 && a.of(Role::fixed) < 0)
                refuse_joint(f, a.of(Role::other));
}

/// Names the face of the part in place of the piece's.
void require_sheet(const FreedPiece& piece)
{
    const SurfaceType type = surface_type(piece.mesh);
    if (type.loops == 0)
        throw InputError(fmt::format("the freed faces around face {} are closed: they have no edge from which they "
                                     "could be unfolded; cut the part open",
                                     piece.face[0]));
    if (type.genus > 0)
        throw InputError(fmt::format("the freed faces around face {} have {} (genus {}); cut the part open",
                                     piece.face[0], type.genus == 1 ? "a handle" : "handles", type.genus));
}

void number_vertices(const TriMesh& part, const std::vector<RolesAround>& around, FreedPiece& piece)
{
    const Eigen::Matrix3Xi triangles = part.triangle(Eigen::all, piece.face);
    piece.vertex.assign(triangles.data(), triangles.data() + triangles.size());
    std::sort(piece.vertex.begin(), piece.vertex.end());
    piece.vertex.erase(std::unique(piece.vertex.begin(), piece.vertex.end()), piece.vertex.end());
    piece.mesh.position = part.position(Eigen::all, piece.vertex);
    piece.mesh.triangle = triangles;
    for (int& v : piece.mesh.triangle.reshaped())
        v = int(std::lower_bound(piece.vertex.begin(), piece.vertex.end(), v) - piece.vertex.begin());
    for (size_t v = 0; v < piece.vertex.size(); ++v)
        if (around[size_t(piece.vertex[v])].of(Role::fixed) >= 0)
            piece.held.push_back(int(v));
}

} // namespace

std::vector<FreedPiece> freed_pieces(const TriMesh& part, const std::vector<int>& fixed, const std::vector<int>& freed)
{
    const std::vector<Role> role = roles(part.triangles(), fixed, freed);
    const std::vector<RolesAround> around = around_vertices(part, role);
    require_free_borders(part, freed, around);

    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    DisjointSets connected(size_t(part.triangles()));
    struct Hinge {
        int freed, low, high;
    };
    std::vector<Hinge> hinges;
    for_each_edge(uses, [&](size_t begin, size_t end) {
        std::array<int, 3> face{-1, -1, -1};
        for (size_t k = begin; k < end; ++k) {
            int& first = face[size_t(role[size_t(uses[k].face)])];
            if (role[size_t(uses[k].face)] == Role::freed && first >= 0)
                connected.join(first, uses[k].face);
            first = uses[k].face;
        }
        const int moving = face[size_t(Role::freed)];
        if (moving >= 0 && face[size_t(Role::other)] >= 0)
            refuse_joint(moving, face[size_t(Role::other)]);
        if (moving >= 0 && face[size_t(Role::fixed)] >= 0)
            hinges.push_back({moving, uses[begin].low, uses[begin].high});
    });

    std::vector<FreedPiece> pieces;
    std::vector<int> number(size_t(part.triangles()), -1), owner(size_t(part.vertices()), -1);
    for (const int f : freed) {
        int& piece = number[size_t(connected.root(f))];
        if (piece < 0) {
            piece = int(pieces.size());
            pieces.emplace_back();
        }
        pieces[size_t(piece)].face.push_back(f);
        for (const int v : part.triangle.col(f)) {
            int& first = owner[size_t(v)];
            if (first >= 0 && number[size_t(connected.root(first))] != piece && around[size_t(v)].of(Role::fixed) < 0)
                throw InputError(fmt::format("the freed faces {} and {} touch in one vertex only; free the faces "
                                             "between them, too, or unfold them one after the other",
                                             first, f));
            first = f;
        }
    }
    for (FreedPiece& piece : pieces) {
        number_vertices(part, around, piece);
        require_sheet(piece);
    }
    for (const Hinge& h : hinges) {
        FreedPiece& piece = pieces[size_t(number[size_t(connected.root(h.freed))])];
        const auto local = [&](int v) {
            return int(std::lower_bound(piece.vertex.begin(), piece.vertex.end(), v) - piece.vertex.begin());
        };
        piece.hinge.push_back({local(h.low), local(h.high)});
    }
    return pieces;
}

} // namespace spia

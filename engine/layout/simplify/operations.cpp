#include "engine/layout/simplify/operations.h"

#include <algorithm>
#include <set>

namespace spia {

namespace {

/// Two vertices become one: the one that may move less stays; free ones meet half-way.
/// @pre not both on arcs, or both ends of a side that runs on an arc
bool join(LayoutMesh& mesh, int a, int b)
{
    if (a == b)
        return false;
    if (mesh.vertex(a).freedom > mesh.vertex(b).freedom)
        std::swap(a, b); // a goes
    const MeshVertex from = mesh.vertex(a), into = mesh.vertex(b);
    if (from.freedom == Freedom::fixed)
        return false;
    const QuadSide side = mesh.side(b, a);
    mesh.merge(a, b);
    if (into.freedom == Freedom::free)
        mesh.move(b, (from.position + into.position) / 2);
    else if (into.freedom == Freedom::slides && side.arc)
        mesh.slide(b, (side.from + side.to) / 2);
    return true;
}

/// Doublets that an operation left behind.
bool remove_doublets(LayoutMesh& mesh, const std::vector<int>& vertices)
{
    for (const int v : vertices)
        if (mesh.vertex(v).freedom == Freedom::free && mesh.vertex(v).faces.size() == 2 && !remove_doublet(mesh, v))
            return false;
    return true;
}

/// The side of the face from a to b.
int side_from(const LayoutMesh& mesh, int face, int a)
{
    const auto& corners = mesh.face(face).vertex;
    return int(std::find(corners.begin(), corners.end(), a) - corners.begin());
}

} // namespace

bool collapse_diagonal(LayoutMesh& mesh, int face, int k)
{
    const auto corners = mesh.face(face).vertex;
    const int a = corners[size_t(k) % 4], b = corners[size_t(k + 2) % 4];
    if (mesh.vertex(a).freedom != Freedom::free && mesh.vertex(b).freedom != Freedom::free)
        return false;
    mesh.remove(face);
    return join(mesh, a, b) && remove_doublets(mesh, {corners[size_t(k + 1) % 4], corners[size_t(k + 3) % 4]});
}

bool remove_doublet(LayoutMesh& mesh, int v)
{
    const MeshVertex& own = mesh.vertex(v);
    if (own.freedom != Freedom::free || own.faces.size() != 2)
        return false;
    const int f = own.faces[0], g = own.faces[1];
    const size_t i = size_t(side_from(mesh, f, v)), j = size_t(side_from(mesh, g, v));
    const auto first = mesh.face(f).vertex, second = mesh.face(g).vertex;
    if (first[(i + 1) % 4] != second[(j + 3) % 4] || first[(i + 3) % 4] != second[(j + 1) % 4])
        return false;
    mesh.remove(g);
    mesh.turn(f, {first[(i + 1) % 4], first[(i + 2) % 4], first[(i + 3) % 4], second[(j + 2) % 4]});
    return remove_doublets(mesh, {first[(i + 1) % 4], first[(i + 3) % 4]});
}

QuadStrip strip_of(const LayoutMesh& mesh, int face, int k)
{
    QuadStrip strip;
    const auto& corners = mesh.face(face).vertex;
    strip.rung = {{corners[size_t(k) % 4], corners[size_t(k + 1) % 4]}};
    // forwards through the face
    for (int f = face, side = k; f >= 0 && int(strip.face.size()) <= mesh.faces();) {
        const auto& own = mesh.face(f).vertex;
        const int x = own[size_t(side + 3) % 4], y = own[size_t(side + 2) % 4];
        strip.face.push_back(f);
        strip.rung.push_back({x, y});
        f = mesh.face_from(x, y);
        if (f >= 0)
            side = side_from(mesh, f, x);
        if (f == face && side == k)
            return strip; // around: the first rung is the last as well
    }
    // backwards from its first rung
    for (int x = strip.rung[0][0], y = strip.rung[0][1], f = mesh.face_from(y, x);
         f >= 0 && int(strip.face.size()) <= mesh.faces(); f = mesh.face_from(y, x)) {
        const auto& own = mesh.face(f).vertex;
        const size_t j = size_t(side_from(mesh, f, y));
        x = own[(j + 2) % 4];
        y = own[(j + 3) % 4];
        strip.face.insert(strip.face.begin(), f);
        strip.rung.insert(strip.rung.begin(), {x, y});
    }
    return strip;
}

std::vector<QuadStrip> strips_of(const LayoutMesh& mesh)
{
    std::vector<QuadStrip> result;
    std::set<std::pair<int, int>> seen; // the two sides of each pair of opposite ones, by the lower
    for (int f = 0; f < mesh.faces(); ++f)
        for (int k = 0; k < 2 && !mesh.face(f).gone; ++k) {
            if (seen.contains({f, k}))
                continue;
            QuadStrip strip = strip_of(mesh, f, k);
            for (size_t i = 0; i < strip.face.size(); ++i)
                seen.insert({strip.face[i], side_from(mesh, strip.face[i], strip.rung[i][0]) % 2});
            result.push_back(std::move(strip));
        }
    std::stable_sort(result.begin(), result.end(),
                     [](const QuadStrip& a, const QuadStrip& b) { return a.face.size() > b.face.size(); });
    return result;
}

bool collapse_strip(LayoutMesh& mesh, const QuadStrip& strip)
{
    const bool around = strip.rung.front() == strip.rung.back();
    const size_t rungs = strip.rung.size() - (around ? 1 : 0);
    std::vector<int> all;
    for (size_t i = 0; i < rungs; ++i) {
        const auto [x, y] = strip.rung[i];
        all.insert(all.end(), {x, y});
        if (mesh.vertex(x).freedom != Freedom::free && mesh.vertex(y).freedom != Freedom::free &&
            (!mesh.on_arc(x, y) ||
             (mesh.vertex(x).freedom == Freedom::fixed && mesh.vertex(y).freedom == Freedom::fixed)))
            return false;
    }
    for (size_t i = 0; i + 1 < strip.rung.size(); ++i)
        if (mesh.on_arc(strip.rung[i][0], strip.rung[i + 1][0]) && mesh.on_arc(strip.rung[i][1], strip.rung[i + 1][1]))
            return false;
    std::sort(all.begin(), all.end());
    if (std::adjacent_find(all.begin(), all.end()) != all.end()) // it crosses or touches itself
        return false;
    for (const int f : strip.face)
        mesh.remove(f);
    for (size_t i = 0; i < rungs; ++i)
        if (!join(mesh, strip.rung[i][0], strip.rung[i][1]))
            return false;
    const std::vector<int> edited = mesh.edited_vertices();
    return remove_doublets(mesh, edited);
}

bool rotate_side(LayoutMesh& mesh, int f, int k, bool forward)
{
    const auto first = mesh.face(f).vertex;
    const int a = first[size_t(k) % 4], b = first[size_t(k + 1) % 4], c = first[size_t(k + 2) % 4],
              d = first[size_t(k + 3) % 4], g = mesh.face_from(b, a);
    if (g < 0 || g == f || mesh.on_arc(a, b))
        return false;
    const auto second = mesh.face(g).vertex;
    const size_t j = size_t(side_from(mesh, g, b));
    const int e = second[(j + 2) % 4], h = second[(j + 3) % 4]; // around both: b, c, d, a, e, h
    if (forward) {
        mesh.turn(f, {c, d, a, e});
        mesh.turn(g, {e, h, b, c});
    } else {
        mesh.turn(f, {d, a, e, h});
        mesh.turn(g, {h, b, c, d});
    }
    return remove_doublets(mesh, {a, b});
}

} // namespace spia

#include "app/viewer/model/stored_picks.h"

#include <algorithm>
#include <cstdint>
#include <fmt/core.h>
#include <map>
#include <set>

#include "app/viewer/model/vertex_picking.h"
#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

constexpr double reach_of_diagonal = 0.01; ///< how far a surface may have moved and still be the same place
constexpr double beside_of_edge = 0.05;    ///< of its mean edge, how far a face's middle may lie beside a patch
constexpr double least_cosine = 0.5; ///< 60 degrees between the normals of one place: coarse faces cut across a bend

const PartFile& part_of(const Document& document)
{
    if (!document.session.part)
        throw InputError("picks belong to a part, and none is open; open a part first");
    return *document.session.part;
}

/// Faces of a file and their triangles. Triangles of one face follow each other.
class FaceNumbers {
public:
    explicit FaceNumbers(const PartFile& part) : source_(part.source_face) {}

    int face(int triangle) const { return source_[size_t(triangle)]; }
    int piece(int triangle) const { return triangle - first(face(triangle)); }
    /// -1 if there is none.
    int triangle(int face, int piece) const
    {
        const long found = long(first(face)) + piece;
        return piece >= 0 && found < long(source_.size()) && source_[size_t(found)] == face ? int(found) : -1;
    }

private:
    int first(int face) const { return int(std::lower_bound(source_.begin(), source_.end(), face) - source_.begin()); }

    const std::vector<int>& source_;
};

void require_triangle(const TriMesh& mesh, int triangle)
{
    if (triangle < 0 || triangle >= mesh.triangles())
        throw InputError(fmt::format("face {} was picked, but the part has faces 0 to {}; pick again", triangle,
                                     mesh.triangles() - 1));
}

Eigen::Matrix3d corners_of(const TriMesh& mesh, int triangle)
{
    return mesh.position(Eigen::all, mesh.triangle.col(triangle));
}

Eigen::Vector3d unit_normal(const Eigen::Matrix3d& corners)
{
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
}

StoredPatch store_patch(const PartFile& part, const std::vector<int>& triangles)
{
    const FaceNumbers numbers(part);
    StoredPatch patch;
    std::map<int, int> point; // of the part, to the patch
    patch.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i) {
        require_triangle(part.mesh, triangles[i]);
        patch.face.push_back(numbers.face(triangles[i]));
        patch.piece.push_back(numbers.piece(triangles[i]));
        for (int k = 0; k < 3; ++k)
            patch.triangle(k, Eigen::Index(i)) =
                point.try_emplace(part.mesh.triangle(k, triangles[i]), int(point.size())).first->second;
    }
    if (std::all_of(patch.piece.begin(), patch.piece.end(), [](int piece) { return piece == 0; }))
        patch.piece.clear();
    patch.point.resize(3, Eigen::Index(point.size()));
    for (const auto& [vertex, i] : point)
        patch.point.col(i) = part.mesh.position.col(vertex);
    return patch;
}

std::vector<StoredVertex> store_vertices(const PartFile& part, const std::vector<int>& vertices)
{
    if (vertices.empty())
        return {};
    const TriMesh& mesh = part.mesh;
    const std::vector<int> boundary = boundary_vertices(mesh).vertex;
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    std::vector<StoredVertex> stored;
    for (const int v : vertices) {
        if (v < 0 || v >= mesh.vertices())
            throw InputError(fmt::format("vertex {} was picked, but the part has vertices 0 to {}; pick again", v,
                                         mesh.vertices() - 1));
        stored.push_back({part.source_vertex[size_t(v)], std::binary_search(boundary.begin(), boundary.end(), v),
                          mesh.position.col(v), normal.col(v)});
    }
    return stored;
}

void require_sound(const StoredPatch& patch, const std::string& what)
{
    const auto fail = [&](const char* why) {
        throw InputError(fmt::format("the faces of {} are damaged: {}; pick them again", what, why));
    };
    if (patch.triangle.cols() != Eigen::Index(patch.face.size()))
        fail("each needs one triangle");
    if (!patch.piece.empty() && patch.piece.size() != patch.face.size())
        fail("each needs one piece, or none has any");
    if (patch.triangle.size() > 0 && (patch.triangle.minCoeff() < 0 || patch.triangle.maxCoeff() >= patch.point.cols()))
        fail("a triangle names a point that is not there");
}

/// Picks by number; nothing if a number is not the part's.
std::optional<std::vector<int>> by_number(const PartFile& part, const StoredPatch& patch)
{
    const FaceNumbers numbers(part);
    std::set<int> found;
    for (size_t i = 0; i < patch.face.size(); ++i) {
        const int triangle = numbers.triangle(patch.face[i], patch.piece.empty() ? 0 : patch.piece[i]);
        if (triangle < 0)
            return {};
        found.insert(triangle);
    }
    return std::vector<int>(found.begin(), found.end());
}

/// A changed part, prepared for finding old places on it.
class ChangedPart {
public:
    explicit ChangedPart(const TriMesh& mesh)
        : mesh_(mesh), search_(mesh), reach_(reach_of_diagonal * bounding_diagonal(mesh))
    {
    }

    /// The place on the new part that an old one has become. Face -1 if there is none.
    ClosestPoint find(const Eigen::Vector3d& at, const Eigen::Vector3d& normal) const
    {
        ClosestPoint found = search_.nearest(at, reach_);
        if (found.face >= 0 && !(unit_normal(corners_of(mesh_, found.face)).dot(normal) >= least_cosine))
            found.face = -1;
        return found;
    }

    /// The new faces of an old patch. @param lost how many of its triangles have no counterpart, and where the first was
    std::vector<int> find(const StoredPatch& patch, int& lost, Eigen::Vector3d& where) const
    {
        lost = 0;
        const TriMesh old{patch.point, patch.triangle};
        std::set<int> found, next; // faces in the patch; nearest to the triangles of the patch
        for (int t = 0; t < old.triangles(); ++t) {
            const Eigen::Matrix3d corners = corners_of(old, t);
            const Eigen::Vector3d middle = corners.rowwise().mean();
            const ClosestPoint place = find(middle, unit_normal(corners));
            if (place.face >= 0)
                next.insert(place.face);
            else if (lost++ == 0)
                where = middle;
        }
        if (old.triangles() == 0)
            return {};
        const ClosestPointSearch patch_search(old);
        for (int f = 0; f < mesh_.triangles(); ++f)
            if (lies_on(old, patch_search, corners_of(mesh_, f)))
                found.insert(f);
        if (found.empty()) // the new faces are larger than the whole patch
            found = std::move(next);
        return {found.begin(), found.end()};
    }

    /// The vertex of the outer boundary that an old corner has become; -1 if there is none.
    int find_corner(const Eigen::Vector3d& at) const { return find_on(boundary_loops(mesh_)[0], at); }

    /// The vertex that an old one has become; -1 if there is none.
    int find_vertex(const StoredVertex& old) const
    {
        int found = -1;
        const auto take = [&](int v) {
            if (v >= 0 &&
                (found < 0 || (mesh_.position.col(v) - old.at).norm() < (mesh_.position.col(found) - old.at).norm()))
                found = v;
        };
        if (old.boundary)
            for (const std::vector<int>& loop : loops())
                take(find_on(loop, old.at));
        else if (const int face = find(old.at, old.normal).face; face >= 0)
            for (const int v : mesh_.triangle.col(face))
                take(v);
        return found;
    }

private:
    const std::vector<std::vector<int>>& loops() const
    {
        if (!loops_)
            loops_ = boundary_loops(mesh_);
        return *loops_;
    }

    /// The vertex of a boundary that is nearest to an old one; -1 if it is too far.
    int find_on(const std::vector<int>& loop, const Eigen::Vector3d& at) const
    {
        const auto distance = [&](int v) { return (mesh_.position.col(v) - at).norm(); };
        const auto nearest =
            std::min_element(loop.begin(), loop.end(), [&](int a, int b) { return distance(a) < distance(b); });
        const int next = nearest + 1 == loop.end() ? loop.front() : *(nearest + 1);
        const double edge = (mesh_.position.col(next) - mesh_.position.col(*nearest)).norm();
        return distance(*nearest) <= std::max(reach_, edge) ? *nearest : -1;
    }

    /// Whether the middle of a face lies over an old patch, not beside it.
    bool lies_on(const TriMesh& old, const ClosestPointSearch& search, const Eigen::Matrix3d& corners) const
    {
        const Eigen::Vector3d middle = corners.rowwise().mean();
        const ClosestPoint place = search.nearest(middle, reach_);
        if (place.face < 0)
            return false;
        const Eigen::Vector3d normal = unit_normal(corners);
        if (!(normal.dot(unit_normal(corners_of(old, place.face))) >= least_cosine))
            return false;
        const Eigen::Vector3d off = middle - place.position;
        const double beside = (off - off.dot(normal) * normal).norm();
        const double edge = ((corners.col(1) - corners.col(0)).norm() + (corners.col(2) - corners.col(1)).norm() +
                             (corners.col(0) - corners.col(2)).norm()) /
                            3;
        return beside <= beside_of_edge * edge;
    }

    const TriMesh& mesh_;
    ClosestPointSearch search_;
    double reach_; ///< mm
    mutable std::optional<std::vector<std::vector<int>>> loops_;
};

std::string near(const Eigen::Vector3d& at) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", at[0], at[1], at[2]); }

/// Finds picks again, on the same part by number, and says what is lost.
class Restorer {
public:
    Restorer(const PartFile& part, bool same) : part_(part)
    {
        if (!same)
            changed_.emplace(part.mesh);
    }

    std::vector<int> faces(const StoredPatch& patch, const std::string& what)
    {
        require_sound(patch, what);
        if (!changed_)
            if (auto found = by_number(part_, patch))
                return *found;
        int lost;
        Eigen::Vector3d where;
        std::vector<int> found = changed().find(patch, lost, where);
        if (lost > 0)
            missing.push_back(
                fmt::format("{} of the {} faces of {} are not on the changed part any more, the first one "
                            "near {}; check {}",
                            lost, patch.face.size(), what, near(where), what));
        return found;
    }

    std::optional<Probe> probe(const StoredProbe& stored, size_t number)
    {
        if (!changed_)
            if (const int triangle = FaceNumbers(part_).triangle(stored.face, stored.piece); triangle >= 0)
                return Probe{triangle, stored.barycentric};
        const ClosestPoint found = changed().find(stored.at, stored.normal);
        if (found.face >= 0)
            return Probe{found.face, found.barycentric};
        missing.push_back(fmt::format("probe {} near {} is not on the changed part any more; it was removed",
                                      number + 1, near(stored.at)));
        return {};
    }

    std::vector<int> vertices(const std::vector<StoredVertex>& stored)
    {
        std::set<int> found;
        std::vector<Eigen::Vector3d> lost;
        for (const StoredVertex& each : stored) {
            const int vertex = changed_ ? -1 : numbered(each.vertex);
            if (const int now = vertex >= 0 ? vertex : changed().find_vertex(each); now >= 0)
                found.insert(now);
            else
                lost.push_back(each.at);
        }
        if (!lost.empty())
            missing.push_back(
                fmt::format("{} of the {} picked vertices are not on the changed part any more, the first "
                            "one near {}; they were removed",
                            lost.size(), stored.size(), near(lost.front())));
        if (const size_t merged = stored.size() - lost.size() - found.size(); merged > 0)
            missing.push_back(
                fmt::format("{} of the {} picked vertices have become one with another on the changed part", merged,
                            stored.size()));
        return {found.begin(), found.end()};
    }

    std::optional<std::array<int, 4>> corners(const std::array<StoredCorner, 4>& stored)
    {
        std::array<int, 4> result;
        for (size_t k = 0; k < 4; ++k) {
            const bool known =
                std::binary_search(part_.source_vertex.begin(), part_.source_vertex.end(), stored[k].vertex);
            if (!changed_ && known) {
                result[k] = stored[k].vertex;
                continue;
            }
            const int vertex = changed().find_corner(stored[k].at);
            if (vertex < 0) {
                missing.push_back(
                    fmt::format("corner {} of the grid, near {}, is not on the outline of the changed part "
                                "any more; all four are chosen automatically, drag them if need be",
                                k + 1, near(stored[k].at)));
                return {};
            }
            result[k] = part_.source_vertex[size_t(vertex)];
        }
        if (std::set(result.begin(), result.end()).size() < 4) {
            missing.push_back("two corners of the grid have become one on the changed part; all four are chosen "
                              "automatically, drag them if need be");
            return {};
        }
        return result;
    }

    std::vector<std::string> missing;

private:
    /// The vertex with this number in the file; -1 if there is none.
    int numbered(int in_file) const
    {
        const std::vector<int>& numbers = part_.source_vertex;
        const auto found = std::lower_bound(numbers.begin(), numbers.end(), in_file);
        return found != numbers.end() && *found == in_file ? int(found - numbers.begin()) : -1;
    }

    const ChangedPart& changed()
    {
        if (!changed_)
            changed_.emplace(part_.mesh);
        return *changed_;
    }

    const PartFile& part_;
    std::optional<ChangedPart> changed_;
};

} // namespace

std::string fingerprint(const PartFile& part)
{
    std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
    const auto add = [&](const void* bytes, size_t count) {
        for (size_t i = 0; i < count; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3;
    };
    add(part.mesh.position.data(), sizeof(double) * size_t(part.mesh.position.size()));
    add(part.mesh.triangle.data(), sizeof(int) * size_t(part.mesh.triangle.size()));
    add(part.source_vertex.data(), sizeof(int) * part.source_vertex.size());
    add(part.source_face.data(), sizeof(int) * part.source_face.size());
    return fmt::format("{:016x}", hash);
}

StoredPicks store_picks(const Document& document)
{
    const PartFile& part = part_of(document);
    const FaceNumbers numbers(part);
    StoredPicks picks;
    picks.fingerprint = fingerprint(part);
    picks.selected = store_patch(part, document.selected);
    picks.vertices = store_vertices(part, document.vertices);
    for (const FaceRegion& region : document.regions)
        picks.regions.push_back({region.name, region.kind, region.colour, store_patch(part, region.faces)});
    for (const Probe& probe : document.probes) {
        require_triangle(part.mesh, probe.face);
        const Eigen::Matrix3d corners = corners_of(part.mesh, probe.face);
        picks.probes.push_back({numbers.face(probe.face), numbers.piece(probe.face), probe.barycentric,
                                corners * probe.barycentric, unit_normal(corners)});
    }
    if (document.session.options.corners) {
        auto& corners = picks.corners.emplace();
        for (size_t k = 0; k < 4; ++k) {
            const int number = (*document.session.options.corners)[k];
            const auto found = std::lower_bound(part.source_vertex.begin(), part.source_vertex.end(), number);
            if (found == part.source_vertex.end() || *found != number)
                throw InputError(fmt::format("corner {} is vertex {}, which the part does not have; choose it again",
                                             k + 1, number));
            corners[k] = {number, part.mesh.position.col(found - part.source_vertex.begin())};
        }
    }
    return picks;
}

std::vector<std::string> restore_picks(Document& document, const StoredPicks& picks)
{
    const PartFile& part = part_of(document);
    Restorer restorer(part, picks.fingerprint == fingerprint(part));
    Document restored = document; // all or nothing
    restored.selected = restorer.faces(picks.selected, "the selection");
    restored.vertices = restorer.vertices(picks.vertices);
    restored.regions.clear();
    for (const StoredRegion& region : picks.regions)
        restored.regions.push_back({region.name, region.kind, region.colour,
                                    restorer.faces(region.patch, fmt::format("the region \"{}\"", region.name))});
    restored.probes.clear();
    for (size_t i = 0; i < picks.probes.size(); ++i)
        if (const auto probe = restorer.probe(picks.probes[i], i))
            restored.probes.push_back(*probe);
    restored.session.options.corners = picks.corners ? restorer.corners(*picks.corners) : std::nullopt;
    document = std::move(restored);
    return restorer.missing;
}

} // namespace spia::viewer

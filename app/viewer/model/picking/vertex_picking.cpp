#include "app/viewer/model/picking/vertex_picking.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <tuple>

#include "app/viewer/model/picking/picking.h"
#include "app/viewer/model/picking/sight.h"
#include "engine/core/error.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {
namespace {

constexpr double behind_each_other = 0.01; ///< pixels between two vertices on one line of sight

/// Places of a closed row, measured by its length.
class ClosedRow {
public:
    explicit ClosedRow(Eigen::Matrix3Xd place) : place_(std::move(place)), start_(1, 0)
    {
        for (Eigen::Index i = 0; i < place_.cols(); ++i)
            start_.push_back(start_.back() + (place_.col((i + 1) % place_.cols()) - place_.col(i)).norm());
    }

    const Eigen::Matrix3Xd& place() const { return place_; }
    double perimeter() const { return start_.back(); }

    /// By how much it turns at place i, 0 to pi: between the chords of this length of it to either
    /// side.
    double turning(int i, double reach) const
    {
        const Eigen::Vector3d here = place_.col(i), before = here - at(start_[size_t(i)] - reach),
                              after = at(start_[size_t(i)] + reach) - here;
        return std::atan2(before.cross(after).norm(), before.dot(after));
    }

private:
    Eigen::Vector3d at(double length) const
    {
        length -= perimeter() * std::floor(length / perimeter());
        const auto next = std::upper_bound(start_.begin() + 1, start_.end() - 1, length);
        const Eigen::Index i = std::distance(start_.begin(), next) - 1;
        const double edge = *next - start_[size_t(i)], share = edge > 0 ? (length - start_[size_t(i)]) / edge : 0;
        return (1 - share) * place_.col(i) + share * place_.col((i + 1) % place_.cols());
    }

    Eigen::Matrix3Xd place_;
    std::vector<double> start_; ///< length up to each place; one more than places
};

std::vector<std::vector<int>> loops_of(const TriMesh& mesh)
{
    try {
        return boundary_loops(mesh);
    } catch (const InputError&) {
        return {};
    }
}

struct Candidate {
    bool plain;  ///< no sharp turn
    double away; ///< pixels
    int vertex, face;

    friend bool operator<(const Candidate& a, const Candidate& b)
    {
        return std::tie(a.plain, a.away, a.vertex, a.face) < std::tie(b.plain, b.away, b.vertex, b.face);
    }
};

/// Finds out which candidates a view shows.
class Candidates {
public:
    Candidates(const PickVertex& pick, const Sight& sight, const TriMesh& mesh, const RayPicker& picker,
               const std::optional<HalfSpace>& kept)
        : pick_(pick), sight_(sight), mesh_(mesh), picker_(picker), kept_(kept)
    {
    }

    void add_within(double reach, int vertex, int face, bool plain = true)
    {
        if (kept_ && kept_->height(mesh_.position.col(vertex)) < 0)
            return;
        const glm::dvec2 pixel = sight_.pixel(mesh_.position.col(vertex));
        const double away = glm::length(pixel - pick_.pixel);
        if (away <= reach && PixelBox{glm::dvec2(0), pick_.size}.holds(pixel))
            all_.push_back({plain, away, vertex, face});
    }

    std::optional<int> first_in_sight()
    {
        std::sort(all_.begin(), all_.end());
        const Candidate* first = nullptr;
        double depth = 0;
        for (size_t i = 0; i < all_.size(); ++i) {
            const Candidate& each = all_[i];
            if (first && (each.plain != first->plain || each.away > first->away + behind_each_other))
                break;
            if (i > 0 && each.vertex == all_[i - 1].vertex)
                continue;
            const Eigen::Vector3d place = mesh_.position.col(each.vertex), viewer = sight_.viewer_of(place);
            const double far = (place - viewer).norm();
            if ((!first || far < depth) && !picker_.hidden(each.face, place, kept_eye(kept_, viewer, place))) {
                first = &each;
                depth = far;
            }
        }
        return first ? std::optional(first->vertex) : std::nullopt;
    }

private:
    const PickVertex& pick_;
    const Sight& sight_;
    const TriMesh& mesh_;
    const RayPicker& picker_;
    const std::optional<HalfSpace>& kept_;
    std::vector<Candidate> all_;
};

} // namespace

BoundaryVertices boundary_vertices(const TriMesh& mesh)
{
    std::vector<int> face(size_t(mesh.vertices()), -1);
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin == 1)
            face[size_t(uses[begin].low)] = face[size_t(uses[begin].high)] = uses[begin].face;
    });
    std::vector<char> sharp(size_t(mesh.vertices()), 0);
    for (const std::vector<int>& loop : loops_of(mesh)) {
        const ClosedRow row(mesh.position(Eigen::all, loop));
        std::vector<double> turn(loop.size(), 0);
        if (!(row.perimeter() > 0))
            continue;
        for (size_t i = 0; i < loop.size(); ++i)
            for (const double reach : turn_reaches)
                turn[i] += row.turning(int(i), reach * row.perimeter()) / std::size(turn_reaches);
        for (const int i : sharp_turns(turn, row.place(), row.perimeter()))
            sharp[size_t(loop[size_t(i)])] = 1;
    }
    BoundaryVertices boundary;
    for (int v = 0; v < mesh.vertices(); ++v)
        if (face[size_t(v)] >= 0) {
            boundary.vertex.push_back(v);
            boundary.face.push_back(face[size_t(v)]);
            boundary.sharp.push_back(sharp[size_t(v)]);
        }
    return boundary;
}

std::optional<int> vertex_at(const PickVertex& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                             const std::optional<HalfSpace>& kept)
{
    const Sight sight(camera, picker.box(), pick.size);
    // From a small circle outwards: of a fine mesh the whole reach may hold thousands of vertices.
    for (double part = 1. / 8; part <= 1; part *= 2) {
        const double reach = part * pick.reach;
        Candidates candidates(pick, sight, mesh, picker, kept);
        for (const int f : picker.near(sight.half_spaces({pick.pixel - reach, pick.pixel + reach})))
            for (int k = 0; k < 3; ++k)
                candidates.add_within(reach, mesh.triangle(k, f), f);
        if (const auto found = candidates.first_in_sight())
            return found;
    }
    return {};
}

std::optional<int> boundary_vertex_at(const PickVertex& pick, const Camera& camera, const TriMesh& mesh,
                                      const BoundaryVertices& boundary, const RayPicker& picker,
                                      const std::optional<HalfSpace>& kept)
{
    const Sight sight(camera, picker.box(), pick.size);
    Candidates candidates(pick, sight, mesh, picker, kept);
    for (size_t i = 0; i < boundary.vertex.size(); ++i)
        candidates.add_within(pick.reach, boundary.vertex[i], boundary.face[i], !boundary.sharp[i]);
    return candidates.first_in_sight();
}

std::array<int, 4> corners_of(const std::vector<int>& vertices, const std::vector<int>& outline,
                              const std::vector<int>& file_number)
{
    if (vertices.size() != 4)
        throw InputError(fmt::format("A grid has four corners, but {} {} picked; pick four vertices of the outline.",
                                     vertices.size(), vertices.size() == 1 ? "vertex is" : "vertices are"));
    std::array<std::pair<long, int>, 4> along;
    for (size_t k = 0; k < 4; ++k) {
        const auto found = std::find(outline.begin(), outline.end(), vertices[k]);
        if (found == outline.end())
            throw InputError(fmt::format(
                "Vertex {} is not on the outer outline; corners of the grid must lie there, pick another vertex.",
                file_number[size_t(vertices[k])]));
        along[k] = {found - outline.begin(), vertices[k]};
    }
    std::sort(along.begin(), along.end());
    return {along[0].second, along[1].second, along[2].second, along[3].second};
}

std::optional<VertexDistance> distance_of_picked(const Document& document)
{
    const Session& session = document.session;
    const std::vector<int>& vertices = document.vertices;
    if (!session.part || vertices.size() != 2)
        return {};
    const auto length = [&](const auto& position) {
        return (position.col(vertices[0]) - position.col(vertices[1])).norm();
    };
    VertexDistance distance{length(session.part->mesh.position), {}};
    if (session.blank)
        distance.on_blank = length(session.blank->blank.position);
    return distance;
}

std::optional<std::array<int, 4>> corners_called(const PartFile& part, const std::array<int, 4>& number)
{
    std::array<int, 4> result;
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int> found = vertices_called(part, number[k]);
        if (found.empty())
            return std::nullopt;
        result[k] = found[0];
    }
    return result;
}

} // namespace spia::viewer

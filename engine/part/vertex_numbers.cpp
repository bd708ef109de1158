#include "engine/part/vertex_numbers.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "engine/part/part_file.h"

namespace spia {
namespace {

/// The numbers of a remeshed part's own vertices begin here: behind all of the file.
int first_own(const PartFile& part)
{
    const std::vector<int>& names = part.remeshed->original_vertex; // ascending
    return std::max(part.file_vertices, names.empty() ? 0 : names.back() + 1);
}

std::vector<int> range_of(const std::vector<int>& ascending, int number)
{
    const auto [from, to] = std::equal_range(ascending.begin(), ascending.end(), number);
    std::vector<int> result;
    for (auto each = from; each != to; ++each)
        result.push_back(int(each - ascending.begin()));
    return result;
}

/// Per vertex where its faces lie from it: it tells the banks of a seam apart.
Eigen::Matrix3Xd inward(const TriMesh& mesh)
{
    Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Matrix3d corners = mesh.position(Eigen::all, mesh.triangle.col(f));
        const Eigen::Vector3d middle = corners.rowwise().mean();
        for (int k = 0; k < 3; ++k)
            result.col(mesh.triangle(k, f)) += middle - corners.col(k);
    }
    return result.colwise().normalized();
}

/// The vertex of a remeshed part that stands for one of the part as it was.
class Successor {
public:
    explicit Successor(const PartFile& part)
        : part_(part), original_(*part.remeshed->original), on_rim_(edge_graph(original_).on_rim),
          on_new_rim_(edge_graph(part.mesh).on_rim)
    {
    }

    /// @param one_of_several  there are others at this place
    int of(int vertex, bool one_of_several)
    {
        if (one_of_several && !inward_)
            inward_ = std::pair(inward(original_), inward(part_.mesh));
        const auto likeness = [&](int v) {
            return one_of_several ? inward_->first.col(vertex).dot(inward_->second.col(v)) : 1.;
        };
        const Eigen::Vector3d place = original_.position.col(vertex);
        const double rounding = 1e-9 * bounding_diagonal(original_);
        double least = std::numeric_limits<double>::infinity(), best_likeness = -1;
        int best = -1;
        for (int v = 0; v < part_.mesh.vertices(); ++v) {
            if (on_rim_[size_t(vertex)] && !on_new_rim_[size_t(v)])
                continue;
            const double distance = (part_.mesh.position.col(v) - place).norm();
            if (distance > least + rounding)
                continue;
            const double like = likeness(v);
            if (!(like > 0)) // on the other bank
                continue;
            if (distance < least - rounding || like > best_likeness) {
                least = std::min(least, distance);
                best_likeness = like;
                best = v;
            }
        }
        return best;
    }

private:
    const PartFile& part_;
    const TriMesh& original_;
    std::vector<char> on_rim_, on_new_rim_;
    std::optional<std::pair<Eigen::Matrix3Xd, Eigen::Matrix3Xd>> inward_;
};

} // namespace

bool numbered_as_read(const PartFile& part) { return part.remeshed && !part.cad; }

std::vector<int> vertices_called(const PartFile& part, int number)
{
    if (!numbered_as_read(part))
        return range_of(part.source_vertex, number);
    if (const int own = number - first_own(part); own >= 0)
        return own < part.mesh.vertices() ? std::vector{own} : std::vector<int>();
    const std::vector<int> copies = range_of(part.remeshed->original_vertex, number);
    if (copies.empty())
        return {};
    Successor successor(part);
    std::vector<int> result;
    for (const int vertex : copies)
        if (const int v = successor.of(vertex, copies.size() > 1); v >= 0)
            result.push_back(v);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

int number_of(const PartFile& part, int vertex)
{
    const int in_file = part.source_vertex[size_t(vertex)];
    if (!numbered_as_read(part))
        return in_file;
    const std::vector<int> called = vertices_called(part, in_file);
    return std::find(called.begin(), called.end(), vertex) != called.end() ? in_file : first_own(part) + vertex;
}

int number_as_read(const PartFile& part, int vertex)
{
    if (!part.remeshed || !part.cad)
        return part.source_vertex[size_t(vertex)];
    Eigen::Index nearest = 0;
    const Eigen::Vector3d place = part.mesh.position.col(vertex);
    (part.remeshed->original->position.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
    return part.remeshed->original_vertex[size_t(nearest)];
}

} // namespace spia

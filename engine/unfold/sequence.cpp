#include "engine/unfold/sequence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/unfold/fit_binder.h"
#include "engine/unfold/pick_border.h"

namespace spia {
namespace {

/// Which labels touch, by edges and by vertices.
struct LabelGraph {
    std::vector<std::map<int, double>> edge; ///< per label: its neighbours and the length of the common border, mm
    std::vector<std::set<int>> vertex;       ///< per label: those with a vertex in common
};

std::vector<std::vector<int>> labels_of_vertices(const TriMesh& part, const BendMap& map)
{
    std::vector<std::vector<int>> labels(size_t(part.vertices()));
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            labels[size_t(v)].push_back(map.label[f]);
    for (auto& each : labels) {
        std::sort(each.begin(), each.end());
        each.erase(std::unique(each.begin(), each.end()), each.end());
    }
    return labels;
}

LabelGraph label_graph(const TriMesh& part, const BendMap& map, const std::vector<std::vector<int>>& of_vertex)
{
    const auto count = size_t(map.label.maxCoeff() + 1);
    LabelGraph graph{std::vector<std::map<int, double>>(count), std::vector<std::set<int>>(count)};
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const int a = map.label[uses[begin].face], b = map.label[uses[end - 1].face];
        if (a == b)
            return;
        const double length = (part.position.col(uses[begin].low) - part.position.col(uses[begin].high)).norm();
        graph.edge[size_t(a)][b] += length;
        graph.edge[size_t(b)][a] += length;
    });
    for (const auto& labels : of_vertex)
        for (const int a : labels)
            for (const int b : labels)
                if (a != b)
                    graph.vertex[size_t(a)].insert(b);
    return graph;
}

double diagonal_of(const TriMesh& part, const std::vector<int>& faces)
{
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : part.triangle.col(f))
            box.extend(part.position.col(v));
    return box.diagonal().norm();
}

/// The faces that regions can carry.
class Carriers {
public:
    Carriers(const TriMesh& part, const BendMap& map, double distance) : fit_(map.regions.size())
    {
        for (size_t r = 0; r < map.regions.size(); ++r) {
            const FaceSet faces = map.faces_of(int(r));
            const double size = diagonal_of(part, faces);
            fit_[r] = fit_binder(part, faces, std::max(exact, distance / size));
            loose_.push_back(fit_[r] && fit_[r]->distance_mm > exact * size);
        }
    }
    const BinderFit* of(int region) const { return fit_[size_t(region)] ? &*fit_[size_t(region)] : nullptr; }
    /// Found only by allowing more than unfold_step() does for itself: the step has to say so.
    bool loose(int region) const { return loose_[size_t(region)]; }

private:
    static constexpr double exact = 1e-4; // of fit_binder()
    std::vector<std::optional<BinderFit>> fit_;
    std::vector<char> loose_;
};

/// Per region from 1, where what it is joined to lies outside of it, to -1, where it lies around that, as the flange around a cup.
std::vector<double> outwards(const TriMesh& part, const BendMap& map)
{
    std::vector<double> out(map.regions.size(), 0), most(map.regions.size(), 0);
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        for (const auto& [in, beside] : {std::pair(uses[begin], uses[begin + 1]), {uses[begin + 1], uses[begin]}}) {
            const int r = map.label[in.face];
            if (r >= int(map.regions.size()) || map.label[beside.face] == r)
                continue;
            const Eigen::Matrix3d x = part.position(Eigen::all, part.triangle.col(in.face));
            const Eigen::Vector3d a = x.col(in.corner), b = x.col((in.corner + 1) % 3), c = x.col((in.corner + 2) % 3),
                                  along = (b - a).normalized(), up = c - a,
                                  away = -(up - along.dot(up) * along).normalized(),
                                  arm = (a + b) / 2 - map.regions[size_t(r)].place;
            out[size_t(r)] += (b - a).norm() * away.dot(arm);
            most[size_t(r)] += (b - a).norm() * arm.norm();
        }
    });
    for (size_t r = 0; r < out.size(); ++r)
        out[r] = most[r] > 0 ? out[r] / most[r] : 1;
    return out;
}

int chosen_root(const TriMesh& part, const BendMap& map, const Carriers& carriers)
{
    constexpr double around =
        0.1; // what the area of a region counts that lies around the others: all would be stretched into it
    const std::vector<double> out = outwards(part, map);
    constexpr double comparable = 0.25; // a face to lay on is worth a smaller region, but not a tiny one
    const auto score = [&](int r) {
        return map.regions[size_t(r)].area * std::pow(map.regions[size_t(r)].flatness, 2) *
               (out[size_t(r)] < 0 ? around : 1);
    };
    int best = 0, best_carrier = -1;
    for (int r = 0; r < int(map.regions.size()); ++r) {
        if (score(r) > score(best) * (1 + 1e-9))
            best = r;
        if (carriers.of(r) && (best_carrier < 0 || score(r) > score(best_carrier) * (1 + 1e-9)))
            best_carrier = r;
    }
    return best_carrier >= 0 && score(best_carrier) > comparable * score(best) ? best_carrier : best;
}

/// Regions: by breadth first, bends cost nothing. Bends: as the outer region beside them; a curled rim is one further out.
std::vector<int> depths(const BendMap& map, const LabelGraph& graph, int root)
{
    constexpr double curl = 0.5;
    const int none = std::numeric_limits<int>::max(), regions = int(map.regions.size());
    std::vector<int> way(graph.edge.size(), none);
    std::deque<int> queue = {root};
    way[size_t(root)] = 0;
    while (!queue.empty()) {
        const int a = queue.front();
        queue.pop_front();
        for (const auto& [b, length] : graph.edge[size_t(a)]) {
            const int cost = way[size_t(a)] + (b < regions ? 1 : 0);
            if (cost >= way[size_t(b)])
                continue;
            way[size_t(b)] = cost;
            b < regions ? queue.push_back(b) : queue.push_front(b);
        }
    }
    if (std::find(way.begin(), way.end(), none) != way.end())
        throw InputError("the part is in several pieces; keep one of them");
    std::vector<int> depth = way;
    for (int label = regions; label < int(depth.size()); ++label) {
        const Bend& bend = map.bends[size_t(label - regions)];
        depth[size_t(label)] = bend.b >= 0 ? std::max(way[size_t(bend.a)], way[size_t(bend.b)])
                                           : way[size_t(bend.a)] + (std::abs(bend.angle) >= curl ? 1 : 0);
    }
    return depth;
}

/// Labels of at least this depth that touch each other, each group ascending.
std::vector<std::vector<int>> clusters(const LabelGraph& graph, const std::vector<int>& depth, int least)
{
    DisjointSets sets(depth.size());
    for (size_t a = 0; a < depth.size(); ++a)
        for (const int b : graph.vertex[a])
            if (depth[a] >= least && depth[size_t(b)] >= least)
                sets.join(int(a), b);
    std::map<int, std::vector<int>> found;
    for (size_t a = 0; a < depth.size(); ++a)
        if (depth[a] >= least)
            found[sets.root(int(a))].push_back(int(a));
    std::vector<std::vector<int>> result;
    for (auto& [first, labels] : found)
        result.push_back(std::move(labels));
    return result;
}

/// Whether places go around a cylinder or cone so far that no line is left along which it could be cut.
bool wraps(const BinderFace& face, const TriMesh& part, const std::set<int>& vertices)
{
    constexpr double gap = 0.5; // radians
    const auto around = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& x) {
        const Eigen::Vector3d y = axis.cross(x);
        std::vector<double> angle;
        for (const int v : vertices) {
            const Eigen::Vector3d arm = part.position.col(v) - origin;
            angle.push_back(std::atan2(y.dot(arm), x.dot(arm)));
        }
        std::sort(angle.begin(), angle.end());
        double widest = angle.front() + 2 * std::numbers::pi - angle.back();
        for (size_t k = 1; k < angle.size(); ++k)
            widest = std::max(widest, angle[k] - angle[k - 1]);
        return widest < gap;
    };
    if (const auto* c = std::get_if<CylinderFace>(&face))
        return around(c->origin, c->axis, c->towards);
    if (const auto* c = std::get_if<ConeFace>(&face))
        return around(c->apex, c->axis, c->towards);
    return false;
}

std::string names(const BendMap& map, const std::vector<int>& labels)
{
    std::vector<std::string> words;
    for (const int label : labels)
        if (label < int(map.regions.size()))
            words.push_back(map.name(label));
    if (words.empty())
        for (const int label : labels)
            words.push_back(map.name(label));
    constexpr size_t most = 6;
    if (words.size() > most)
        words = {words[0], words[1], words[2], fmt::format("{} more", words.size() - 3)};
    return fmt::format("{}", fmt::join(words, ", "));
}

class Planner {
public:
    Planner(const TriMesh& part, const BendMap& map, const SequenceOptions& options)
        : part_(part), map_(map), distance_(options.distance * diagonal_of(part, all_faces())),
          of_vertex_(labels_of_vertices(part, map)), graph_(label_graph(part, map, of_vertex_)),
          carriers_(part, map, distance_)
    {
        result_.root = options.root >= 0 ? options.root : chosen_root(part, map, carriers_);
        result_.depth = depths(map, graph_, result_.root);
    }

    UnfoldSequence planned(bool unite)
    {
        const int deepest = *std::max_element(result_.depth.begin(), result_.depth.end());
        for (int depth = deepest; depth > 0; --depth)
            for (const std::vector<int>& cluster : clusters(graph_, result_.depth, depth))
                if (result_.depth[size_t(*std::min_element(cluster.begin(), cluster.end(), [&](int a, int b) {
                        return result_.depth[size_t(a)] < result_.depth[size_t(b)];
                    }))] == depth)
                    lay(cluster, depth, unite);
        finish();
        for (PlannedStep& step : result_.steps)
            if (step.kind == UnfoldKind::lay)
                step.name = fmt::format("{} onto {}", names(map_, step.freed), map_.name(step.carrier));
        return std::move(result_);
    }

private:
    FaceSet all_faces() const
    {
        FaceSet faces(size_t(part_.triangles()));
        std::iota(faces.begin(), faces.end(), 0);
        return faces;
    }

    /// The region inside of a cluster with the longest border to it, over bends of the cluster or directly.
    int carrier_of(const std::vector<int>& cluster, int depth) const
    {
        std::map<int, double> border;
        for (const int label : cluster)
            for (const auto& [other, length] : graph_.edge[size_t(label)])
                if (other < int(map_.regions.size()) && result_.depth[size_t(other)] < depth)
                    border[other] += length;
        int best = -1;
        for (const auto& [region, length] : border)
            if (best < 0 || length > border[best] * (1 + 1e-9))
                best = region;
        return best;
    }

    /// Makes the step that lays a cluster on its carrier, or notes why there is none.
    void lay(const std::vector<int>& cluster, int depth, bool unite)
    {
        const auto cannot = [&](const std::string& why) {
            result_.notes.push_back(fmt::format("{} cannot be laid flat for itself: {}", names(map_, cluster), why));
        };
        const int carrier = carrier_of(cluster, depth);
        if (carrier < 0)
            return cannot("it touches its inner neighbours in bends or points only");
        const BinderFit* fit = carriers_.of(carrier);
        if (!fit)
            return cannot(fmt::format("{} is no plane, cylinder or cone", map_.name(carrier)));
        std::vector<char> freed(graph_.edge.size(), 0);
        for (const int label : cluster)
            freed[size_t(label)] = 1;
        std::set<int> held;
        for (int v = 0; v < part_.vertices(); ++v) {
            const auto& labels = of_vertex_[size_t(v)];
            const auto moves = std::count_if(labels.begin(), labels.end(), [&](int l) { return freed[size_t(l)]; });
            if (moves > 0 && moves < std::ptrdiff_t(labels.size()))
                held.insert(v);
        }
        for (const int v : held) {
            const Eigen::Vector3d x = part_.position.col(v);
            if ((x - placed(fit->face, developed(fit->face, x))).norm() > distance_)
                return cannot(fmt::format("it is joined to more than {}", map_.name(carrier)));
        }
        if (wraps(fit->face, part_, held))
            return cannot(fmt::format("it goes all around {}", map_.name(carrier)));
        add(cluster, carrier, held, unite);
    }

    void add(const std::vector<int>& cluster, int carrier, const std::set<int>& held, bool unite)
    {
        std::vector<PlannedStep>& steps = result_.steps;
        const auto same = std::find_if(steps.begin(), steps.end(), [&](const PlannedStep& step) {
            return unite && step.carrier == carrier && depth_of(step.freed) == depth_of(cluster);
        });
        PlannedStep& step = same == steps.end() ? steps.emplace_back() : *same;
        step.carrier = carrier;
        step.freed = united(step.freed, cluster);
        if (step.fixed.empty())
            step.fixed = {carrier};
        std::vector<char> carries(size_t(part_.vertices()), 0);
        const FaceSet carrying = map_.faces_of(carrier);
        for (const int f : carrying)
            for (const int v : part_.triangle.col(f))
                carries[size_t(v)] = 1;
        for (const int v : held)
            if (!carries[size_t(v)])
                for (const int label : of_vertex_[size_t(v)])
                    if (!std::binary_search(step.freed.begin(), step.freed.end(), label) &&
                        std::find(step.fixed.begin(), step.fixed.end(), label) == step.fixed.end())
                        step.fixed.push_back(label);
        FaceSet fixed;
        step.pick.freed.clear();
        for (int f = 0; f < part_.triangles(); ++f)
            if (std::binary_search(step.freed.begin(), step.freed.end(), map_.label[f]))
                step.pick.freed.push_back(f);
            else if (std::find(step.fixed.begin(), step.fixed.end(), map_.label[f]) != step.fixed.end())
                fixed.push_back(f);
        step.pick.fixed = united(fixed, pick_border(part_, fixed, step.pick.freed).held);
        step.pick.carrying = carrying;
        step.within_mm = carriers_.loose(carrier) ? distance_ : 0;
    }

    int depth_of(const std::vector<int>& labels) const
    {
        int least = result_.depth[size_t(labels.front())];
        for (const int label : labels)
            least = std::min(least, result_.depth[size_t(label)]);
        return least;
    }

    /// What has to be done when all that can be is on the face of the root.
    void finish()
    {
        std::vector<char> laid(graph_.edge.size(), 0);
        laid[size_t(result_.root)] = 1;
        for (const PlannedStep& step : result_.steps)
            if (step.carrier == result_.root)
                for (const int label : step.freed)
                    laid[size_t(label)] = 1;
        const bool together = std::all_of(laid.begin(), laid.end(), [](char l) { return l; });
        const BinderFit* fit = carriers_.of(result_.root);
        const bool rolls = together && fit;
        if (rolls && std::holds_alternative<PlaneFace>(fit->face) && !carriers_.loose(result_.root))
            return;
        PlannedStep step;
        step.kind = rolls ? UnfoldKind::unroll : UnfoldKind::flatten;
        step.name = rolls ? fmt::format("unroll the {} of {}", name(fit->face), map_.name(result_.root))
                          : "flatten the whole part";
        step.pick.freed = all_faces();
        step.freed.resize(graph_.edge.size());
        std::iota(step.freed.begin(), step.freed.end(), 0);
        if (rolls) {
            step.pick.carrying = map_.faces_of(result_.root);
            step.within_mm = carriers_.loose(result_.root) ? distance_ : 0;
        }
        result_.steps.push_back(std::move(step));
    }

    const TriMesh& part_;
    const BendMap& map_;
    double distance_; ///< mm
    std::vector<std::vector<int>> of_vertex_;
    LabelGraph graph_;
    Carriers carriers_;
    UnfoldSequence result_{};
};

} // namespace

std::string_view name(UnfoldKind kind)
{
    switch (kind) {
    case UnfoldKind::lay: return "lay";
    case UnfoldKind::unroll: return "unroll";
    case UnfoldKind::flatten: return "flatten";
    }
    return "";
}

UnfoldSequence propose_sequence(const TriMesh& part, const BendMap& map, const SequenceOptions& options)
{
    if (map.label.size() != part.triangles() || map.regions.empty())
        throw InputError(fmt::format("the map of bends has {} faces, the part {}; find the bends of this part",
                                     map.label.size(), part.triangles()));
    if (options.root >= int(map.regions.size()))
        throw InputError(fmt::format("there is no region {}; the part has {}", options.root + 1, map.regions.size()));
    return Planner(part, map, options).planned(options.unite);
}

} // namespace spia

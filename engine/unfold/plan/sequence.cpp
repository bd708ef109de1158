#include "engine/unfold/plan/sequence.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <map>
#include <numeric>
#include <set>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/plan/carriers.h"
#include "engine/unfold/plan/label_graph.h"
#include "engine/unfold/plan/pick_border.h"

namespace spia {
namespace {

std::string names(const BendMap& map, const std::vector<int>& labels)
{
    std::vector<std::string> words;
    int rims = 0;
    for (const int label : labels)
        if (label < int(map.regions.size()))
            words.push_back(map.name(label));
        else
            // no way to another region that is named
            rims += map.bends[size_t(label) - map.regions.size()].b < 0;
    constexpr size_t most = 6;
    if (words.size() > most)
        words = {words[0], words[1], words[2], fmt::format("{} more", words.size() - 3)};
    if (words.empty() && labels.size() <= most)
        for (const int label : labels)
            words.push_back(map.name(label));
    else if (rims > 0)
        words.push_back(fmt::format("{} {}", rims, rims == 1 ? "bent edge" : "bent edges"));
    return fmt::format("{}", fmt::join(words, ", "));
}

class Planner {
public:
    Planner(const TriMesh& part, const BendMap& map, const SequenceOptions& options)
        : part_(part), map_(map), unroll_(options.unroll), distance_(options.distance * diagonal_of(part, all_faces())),
          of_vertex_(labels_of_vertices(part, map)), graph_(label_graph(part, map, of_vertex_)),
          carriers_(part, map, distance_, options.carries_nothing)
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

    std::set<int> vertices_of(int region) const
    {
        std::set<int> vertices;
        for (const int f : map_.faces_of(region))
            for (const int v : part_.triangle.col(f))
                vertices.insert(v);
        return vertices;
    }

    /// The region inside of a cluster with the longest border to it, over bends of the cluster or
    /// directly.
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
            result_.notes.push_back(fmt::format("{} cannot be unfolded separately: {}", names(map_, cluster), why));
        };
        const int carrier = carrier_of(cluster, depth);
        if (carrier < 0)
            return cannot("it touches its inner neighbours at bends or points only");
        const TargetFit* fit = carriers_.of(carrier);
        if (!fit)
            return cannot(carriers_.why_not(carrier));
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
            return cannot(fmt::format("it surrounds {}", map_.name(carrier)));
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
        const TargetFit* fit = carriers_.plain(result_.root);
        bool rolls = together && fit && !wraps(fit->face, part_, vertices_of(result_.root));
        constexpr double in_one_plane = 1e-7; // of the part; what lies farther off is put into the
                                              // plane by a step
        const bool plane = rolls && std::holds_alternative<PlaneFace>(fit->face) &&
                           fit->distance_mm <= in_one_plane * bounding_diagonal(part_);
        if (plane && !result_.steps.empty())
            return;
        rolls &= unroll_;
        PlannedStep step;
        step.kind = rolls ? UnfoldKind::unroll : UnfoldKind::flatten;
        step.name = rolls && plane ? "take the flat part as it is"
                    : rolls        ? fmt::format("unroll the {} of {}", name(fit->face), map_.name(result_.root))
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
    bool unroll_;
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

bool same_work(const PlannedStep& a, const PlannedStep& b)
{
    const auto work = [](const PlannedStep& s) {
        return std::tie(s.kind, s.pick, s.carrying_lost, s.within_mm, s.offset_mm, s.extent_mm, s.tolerance,
                        s.most_energy_steps, s.most_newton_steps);
    };
    return &a == &b || work(a) == work(b);
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

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <set>
#include <utility>

#include "app/viewer/model/document/changed_part.h"
#include "app/viewer/model/document/file_numbers.h"
#include "app/viewer/model/picking/measuring.h"
#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {
namespace {

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

std::string near(const Eigen::Vector3d& at) { return fmt::format("{:.4g}, {:.4g}, {:.4g} mm", at[0], at[1], at[2]); }

/// Finds picks again, on the same part by number, and says what is lost.
class Restorer {
public:
    Restorer(const PartFile& part, bool same, std::shared_ptr<const ClosestPointSearch> search)
        : part_(part), same_(same), search_(std::move(search))
    {
    }

    std::vector<int> faces(const StoredPatch& patch, const std::string& what)
    {
        require_sound(patch, what);
        if (same_)
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

    std::optional<Probe> place(const StoredProbe& stored)
    {
        if (same_)
            if (const int triangle = FaceNumbers(part_).triangle(stored.face, stored.piece); triangle >= 0)
                return Probe{triangle, stored.barycentric};
        const ClosestPoint found = changed().find(stored.at, stored.normal);
        return found.face >= 0 ? std::optional(Probe{found.face, found.barycentric}) : std::nullopt;
    }

    std::optional<Probe> probe(const StoredProbe& stored, size_t number)
    {
        if (const auto found = place(stored))
            return found;
        missing.push_back(fmt::format("probe {} near {} is not on the changed part any more; it was removed",
                                      number + 1, near(stored.at)));
        return {};
    }

    /// Measured anew: on a changed part there may be another radius at the place, or none.
    std::optional<Measurement> measurement(const StoredMeasurement& stored, size_t number)
    {
        Measurement made{stored.kind, {}};
        for (const StoredProbe& each : stored.at)
            if (const auto found = place(each))
                made.at.push_back(*found);
        try {
            made.found = std::make_shared<const Measured>(measured(part_.mesh, made));
            return made;
        } catch (const InputError&) {
            missing.push_back(
                fmt::format("measurement {} is not possible on the changed part any more; it was removed", number + 1));
            return {};
        }
    }

    std::vector<int> vertices(const std::vector<StoredVertex>& stored)
    {
        std::set<int> found;
        std::vector<Eigen::Vector3d> lost;
        for (const StoredVertex& each : stored) {
            const int vertex = same_ ? numbered(each.vertex, each.at) : -1;
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
            missing.push_back(fmt::format("{} of the {} picked vertices coincide with another one on the changed part",
                                          merged, stored.size()));
        return {found.begin(), found.end()};
    }

    std::vector<ProcessLine> lines(const std::vector<ProcessLine>& stored)
    {
        if (same_ || stored.empty())
            return stored;
        std::vector<ProcessLine> result;
        for (ProcessLine line : stored) {
            const auto off = std::find_if(line.point.begin(), line.point.end(), [&](Eigen::Vector3d& point) {
                const ClosestPoint found = changed().search().nearest(point, changed().reach());
                if (found.face >= 0)
                    point = found.position;
                return found.face < 0;
            });
            if (off == line.point.end())
                result.push_back(std::move(line));
            else
                missing.push_back(
                    fmt::format("the line \"{}\" leaves the changed part near {}; it was removed, draw it anew",
                                line.name, near(*off)));
        }
        return result;
    }

    StepList steps(const StoredSteps& stored)
    {
        std::vector<std::vector<int>> patch;
        // a face of a changed part may lie over two patches
        std::vector<char> taken(size_t(part_.mesh.triangles()), 0);
        for (const StoredPatch& each : stored.patch) {
            patch.emplace_back();
            for (const int f : faces(each, "the steps of unfolding"))
                if (!std::exchange(taken[size_t(f)], 1))
                    patch.back().push_back(f);
        }
        const auto all_of = [&](const std::vector<int>& patches, const std::string& name) {
            std::vector<int> result;
            for (const int k : patches) {
                if (k < 0 || size_t(k) >= patch.size())
                    throw InputError(fmt::format("the step \"{}\" names patch {}, which is not there", name, k));
                result.insert(result.end(), patch[size_t(k)].begin(), patch[size_t(k)].end());
            }
            std::sort(result.begin(), result.end());
            return result;
        };
        StepList result;
        for (const StoredStep& each : stored.step) {
            PlannedStep step;
            step.kind = each.kind;
            step.name = each.name;
            step.pick.fixed = all_of(each.fixed, each.name);
            step.pick.freed = all_of(each.freed, each.name);
            step.pick.carrying = all_of(each.carrying, each.name);
            step.within_mm = each.within_mm;
            step.offset_mm = each.offset_mm;
            step.extent_mm = each.extent_mm;
            step.tolerance = each.tolerance;
            step.most_energy_steps = each.most_energy_steps;
            step.most_newton_steps = each.most_newton_steps;
            const auto lost = [](const std::vector<int>& patches, const std::vector<int>& now) {
                return !patches.empty() && now.empty();
            };
            step.carrying_lost =
                each.carrying_lost || lost(each.carrying.empty() ? each.fixed : each.carrying,
                                           each.carrying.empty() ? step.pick.fixed : step.pick.carrying);
            step.pick.target = face_of(each.target, part_.mesh, step.pick);
            if (each.friction) {
                std::vector<int> faces = all_of(each.rubbing, each.name);
                if (lost(each.rubbing, faces)) // without faces it would rub on all
                    missing.push_back(fmt::format(
                        "the friction faces of the step \"{}\" are not on the changed part any more; its friction was removed",
                        each.name));
                else
                    step.pick.friction = friction_of(*each.friction, std::move(faces));
            }
            if (step.pick.freed.empty())
                missing.push_back(fmt::format(
                    "the moving faces of the step \"{}\" are not on the changed part any more; it was removed",
                    each.name));
            else {
                if (needs_pick(step) && !each.carrying_lost)
                    missing.push_back(fmt::format(
                        "the fixed faces of the step \"{}\" are not on the changed part any more; pick others before running it",
                        each.name));
                result.push_back(std::make_shared<PlannedStep>(std::move(step)));
            }
        }
        return result;
    }

    std::optional<std::array<int, 4>> corners(const std::array<StoredCorner, 4>& stored)
    {
        std::array<int, 4> result;
        for (size_t k = 0; k < 4; ++k) {
            if (same_ && !vertices_called(part_, stored[k].vertex).empty()) {
                result[k] = stored[k].vertex;
                continue;
            }
            const int vertex = changed().find_corner(stored[k].at);
            if (vertex < 0) {
                missing.push_back(fmt::format(
                    "corner {} of the grid, near {}, is not on the outline of the changed part any more; all four are chosen automatically, drag them if necessary",
                    k + 1, near(stored[k].at)));
                return {};
            }
            result[k] = number_of(part_, vertex);
        }
        if (std::set(result.begin(), result.end()).size() < 4) {
            missing.push_back(
                "two corners of the grid coincide on the changed part; all four are chosen automatically, drag them if necessary");
            return {};
        }
        return result;
    }

    std::vector<std::string> missing;

private:
    /// The vertex with this number in the file, of several the one nearest to the place: those that
    /// divide a rim's chords are called like its end. -1 if there is none.
    int numbered(int in_file, const Eigen::Vector3d& at) const
    {
        const std::vector<int>& numbers = part_.source_vertex;
        const auto [from, to] = std::equal_range(numbers.begin(), numbers.end(), in_file);
        int nearest = -1;
        double least = std::numeric_limits<double>::infinity();
        for (int v = int(from - numbers.begin()); v < int(to - numbers.begin()); ++v)
            if (const double distance = (part_.mesh.position.col(v) - at).norm(); distance < least) {
                least = distance;
                nearest = v;
            }
        return nearest;
    }

    const ChangedPart& changed()
    {
        if (!search_)
            search_ = std::make_shared<ClosestPointSearch>(part_.mesh);
        if (!changed_)
            changed_.emplace(part_.mesh, *search_);
        return *changed_;
    }

    const PartFile& part_;
    bool same_;
    std::shared_ptr<const ClosestPointSearch> search_;
    std::optional<ChangedPart> changed_;
};

} // namespace

std::vector<std::string> restore_picks(Document& document, const StoredPicks& picks,
                                       std::shared_ptr<const ClosestPointSearch> search)
{
    const PartFile& part = picked_part(document);
    const bool same = picks.fingerprint == fingerprint(part);
    Restorer restorer(part, same, std::move(search));
    Document restored = document; // all or nothing
    restored.selected = restorer.faces(picks.selected, "the selection");
    restored.vertices = restorer.vertices(picks.vertices);
    restored.regions.clear();
    for (const StoredRegion& region : picks.regions)
        restored.regions.push_back({region.name, region.kind, region.colour,
                                    restorer.faces(region.patch, fmt::format("the region \"{}\"", region.name)),
                                    region.contact, region.sheet});
    restored.lines = restorer.lines(picks.lines);
    restored.steps = restorer.steps(picks.steps);
    restored.proposal = nullptr;
    // another part would be planned otherwise
    if (same && picks.steps.proposed && !restored.steps.empty())
        restored.proposal =
            std::make_shared<Proposal>(Proposal{document.session.part, picks.steps.root.value_or(-1), restored.steps});
    restored.probes.clear();
    for (size_t i = 0; i < picks.probes.size(); ++i)
        if (const auto probe = restorer.probe(picks.probes[i], i))
            restored.probes.push_back(*probe);
    restored.measurements.clear();
    for (size_t i = 0; i < picks.measurements.size(); ++i)
        if (auto measurement = restorer.measurement(picks.measurements[i], i))
            restored.measurements.push_back(std::move(*measurement));
    restored.session.options.corners = picks.corners ? restorer.corners(*picks.corners) : std::nullopt;
    document = std::move(restored);
    return restorer.missing;
}

} // namespace spia::viewer

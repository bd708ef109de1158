#include "engine/nurbs/fit_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

FitJudge::FitJudge(const TriMesh& part, const FitOptions& options, const Progress& progress)
    : mesh(part), search(part, progress), face_normal(area_vectors(part)), options_(options)
{
    face_normal.colwise().normalize();
}

Judgement FitJudge::judge(const NurbsSurface& surface, bool at_once, const Progress& progress) const
{
    Judgement result;
    DeviationOptions one_way;
    one_way.part_faces = options_.part_faces;
    one_way.tolerance = options_.tolerance;
    one_way.mesh_to_surface = false;
    if (!at_once) { // while it is too far away there is no need for more
        result.deviation = deviation(surface, mesh, one_way, progress.part(0, 0.3));
        result.missing = result.deviation.beyond;
        if (!result.missing.empty())
            return result;
    }
    DeviationOptions both = one_way;
    both.mesh_to_surface = true;
    both.samples_per_span = 7; // between the data
    both.listed_from = 0.7;
    result.deviation = deviation(surface, mesh, both, progress.part(0.3, 0.9));
    const std::vector<BeyondTolerance> suspects = std::move(result.deviation.beyond);
    result.deviation.beyond.clear();
    for (const BeyondTolerance& sample : suspects)
        if (sample.distance > options_.tolerance)
            result.deviation.beyond.push_back(sample);
    result.missing = result.deviation.beyond;
    if (result.missing.empty())
        result.missing = look_closely(surface, suspects, progress.part(0.9, 1));
    result.within = result.missing.empty();
    if (result.within)
        for (BeyondTolerance sample : result.deviation.turned) {
            sample.distance = std::numeric_limits<double>::max(); // no matter how near: it folds
            result.missing.push_back(sample);
        }
    return result;
}

std::vector<BeyondTolerance> FitJudge::look_closely(const NurbsSurface& surface,
                                                    const std::vector<BeyondTolerance>& suspects,
                                                    const Progress& progress) const
{
    constexpr int each = 16;
    const auto borders_u = span_borders(surface.knots_u, surface.degree_u);
    const auto borders_v = span_borders(surface.knots_v, surface.degree_v);
    std::vector<std::pair<int, int>> cells;
    for (const BeyondTolerance& sample : suspects)
        cells.emplace_back(span_of(borders_v, sample.v), span_of(borders_u, sample.u));
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::vector<BeyondTolerance> found(cells.size(), {0, 0, 0});
    const int part_faces = options_.part_faces < 0 ? mesh.triangles() : options_.part_faces;
    constexpr int cells_at_a_time = 1024; // 300 000 places
    for (int from = 0; from < int(cells.size()); from += cells_at_a_time) {
        progress.checkpoint(double(from) / double(cells.size()), "looking closely where the tolerance is near");
        parallel_for(std::min(cells_at_a_time, int(cells.size()) - from), [&](int k) {
            const size_t c = size_t(from + k);
            const auto [b, a] = cells[c];
            for (int j = 0; j <= each; ++j)
                for (int i = 0; i <= each; ++i) {
                    const double u = std::lerp(borders_u[size_t(a)], borders_u[size_t(a) + 1], double(i) / each);
                    const double v = std::lerp(borders_v[size_t(b)], borders_v[size_t(b) + 1], double(j) / each);
                    const ClosestPoint foot = search.nearest(evaluate(surface, u, v).position);
                    if (foot.face < part_faces && foot.distance > found[c].distance)
                        found[c] = {u, v, foot.distance};
                }
        });
    }
    std::erase_if(found, [&](const BeyondTolerance& worst) { return worst.distance <= options_.tolerance; });
    return found;
}

} // namespace spia

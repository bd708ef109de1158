#include "engine/pipeline/corner_cut.h"

#include <array>
#include <fmt/core.h>
#include <map>
#include <set>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

StrainFigures figures(const TriMesh& part, const SheetFields& face)
{
    const Eigen::VectorXd twice_area = area_vectors(part).colwise().norm();
    return {face.strain_equivalent.maxCoeff(), face.strain_equivalent.dot(twice_area) / twice_area.sum()};
}

/// The part with both sides of its seam joined again. @param number per vertex of `cut` that in the
/// file
TriMesh joined(const TriMesh& cut, const std::vector<int>& number, const std::vector<std::vector<int>>& seam)
{
    std::set<int> on_seam;
    for (const std::vector<int>& row : seam)
        on_seam.insert(row.begin(), row.end());
    std::map<std::array<double, 3>, int> first; // both sides of a seam are copies, to the last bit
    std::vector<int> stands_for(size_t(cut.vertices()));
    TriMesh result;
    result.position.resize(3, cut.vertices());
    int count = 0;
    for (int v = 0; v < cut.vertices(); ++v) {
        const Eigen::Vector3d p = cut.position.col(v);
        if (on_seam.contains(number[size_t(v)])) {
            const auto [known, is_new] = first.try_emplace({p[0], p[1], p[2]}, count);
            if (!is_new) {
                stands_for[size_t(v)] = known->second;
                continue;
            }
        }
        stands_for[size_t(v)] = count;
        result.position.col(count++) = p;
    }
    result.position.conservativeResize(3, count);
    result.triangle = cut.triangle.unaryExpr([&](int v) { return stands_for[size_t(v)]; });
    return result;
}

} // namespace

std::shared_ptr<const CornerCut> corner_cut(const PartFile& part, const FlattenResult& cut,
                                            const FlattenOptions& options, const Progress& progress)
{
    if (part.seam.empty())
        return nullptr;
    // A remesh may part the two sides of the seam otherwise.
    const TriMesh before = part.remeshed ? joined(*part.remeshed->original, part.remeshed->original_vertex, part.seam)
                                         : joined(part.mesh, part.source_vertex, part.seam);
    if (!surface_type(before).sheet())
        return nullptr;
    auto result = std::make_shared<CornerCut>();
    result->after = figures(part.mesh, cut.face);
    FlattenOptions free = options;
    free.process = {};
    free.process.rolling = options.process.rolling;
    free.skins = false;
    try {
        result->before = figures(before, flatten(before, free, progress).face);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        result->why_not = error.what();
    }
    return result;
}

std::string describe(const CornerCut& cut)
{
    const auto words = [](const StrainFigures& strain) {
        return fmt::format("up to {:.3f} (mean {:.3f})", strain.most, strain.mean);
    };
    return fmt::format("with the corners cut the equivalent strain is {}; joined {}", words(cut.after),
                       cut.before ? "it is " + words(*cut.before) : "there is no blank: " + cut.why_not);
}

} // namespace spia

#include "engine/coons/lift.h"

#include <fmt/core.h>

#include "engine/coons/blank_search.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace spia {

namespace {

LiftResult carry_over(const QuadGrid& planar, std::vector<MeshPoint> place, const FilledMesh& filled)
{
    LiftResult result;
    result.lifted = planar;
    result.on_fill.resize(place.size());
    for (size_t n = 0; n < place.size(); ++n) {
        const MeshPoint& here = place[n];
        if (here.face < 0)
            throw InputError(fmt::format("grid node {} at {:.6g}, {:.6g} mm has no unique place on the blank; "
                                         "use the automatic or the harmonic grid",
                                         n, planar.position(0, Eigen::Index(n)), planar.position(1, Eigen::Index(n))));
        Eigen::Vector3d position = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            if (here.barycentric[k] != 0) // a border node is exactly on its edge, whatever the
                                          // third vertex
                position += here.barycentric[k] * filled.mesh.position.col(filled.mesh.triangle(k, here.face));
        result.lifted.position.col(Eigen::Index(n)) = position;
        result.on_fill[n] = filled.is_fill(here.face);
    }
    result.place = std::move(place);
    return result;
}

} // namespace

LiftResult lift(const GridResult& grid) { return carry_over(grid.planar, grid.place, *grid.filled); }

LiftResult lift(const QuadGrid& planar, const Blank& blank, const TriMesh& part, const Progress& progress)
{
    const FilledMesh filled = fill_holes(part, blank.position, progress.part(0, 0.5));
    const BlankSearch search(filled);
    progress.checkpoint(0.7, "lifting the grid");
    std::vector<MeshPoint> place(size_t(planar.nodes()));
    parallel_for(planar.nodes(),
                 [&](int n) { place[size_t(n)] = search.unique_place(planar.position.col(n).head<2>()); });
    return carry_over(planar, std::move(place), filled);
}

} // namespace spia

#include "engine/nurbs/fit_patch.h"

#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/point_rows.h"

namespace spia {

namespace {

/// The nodes (i, j), i fastest, of one border of a count_u x count_v grid.
std::vector<Eigen::Index> border_nodes(int side, int count_u, int count_v)
{
    std::vector<Eigen::Index> nodes;
    const int count = side % 2 == 0 ? count_u : count_v;
    for (Eigen::Index k = 0; k < count; ++k)
        nodes.push_back(side == 0   ? k
                        : side == 1 ? count_u - 1 + k * count_u
                        : side == 2 ? k + Eigen::Index(count_v - 1) * count_u
                                    : k * count_u);
    return nodes;
}

const char* name_of_side(int side)
{
    constexpr const char* names[] = {"v = 0", "u = 1", "v = 1", "u = 0"};
    return names[side];
}

void require_usable(const Eigen::Matrix3Xd& points, const CurveFit& u, const CurveFit& v, const PatchBorders& borders)
{
    const size_t expected = u.parameters().size() * v.parameters().size();
    if (size_t(points.cols()) != expected || !points.allFinite())
        throw InputError(
            fmt::format("{} points were given for a fit at {} x {} parameters, or some are not numbers; lift "
                        "the grid again",
                        points.cols(), u.parameters().size(), v.parameters().size()));
    for (int side = 0; side < 4; ++side) {
        const int count = side % 2 == 0 ? u.count() : v.count();
        if (borders[size_t(side)].cols() != count || !borders[size_t(side)].allFinite())
            throw InputError(fmt::format("the border {} has {} control points where the patch has {}, or some are not "
                                         "numbers; fit it over the knots of the patch",
                                         name_of_side(side), borders[size_t(side)].cols(), count));
    }
    const auto meet = [&](size_t a, bool a_end, size_t b, bool b_end) {
        const Eigen::Matrix3Xd &p = borders[a], &q = borders[b];
        if (p.col(a_end ? p.cols() - 1 : 0) != q.col(b_end ? q.cols() - 1 : 0))
            throw InputError(
                fmt::format("the borders {} and {} of a patch do not meet in their corner; fit them to the "
                            "same corner point",
                            name_of_side(int(a)), name_of_side(int(b))));
    };
    meet(0, false, 3, false);
    meet(0, true, 1, false);
    meet(2, true, 1, true);
    meet(2, false, 3, true);
}

} // namespace

PatchBorders fit_borders(const Eigen::Matrix3Xd& points, const CurveFit& along_u, const CurveFit& along_v)
{
    const int count_u = int(along_u.parameters().size()), count_v = int(along_v.parameters().size());
    PatchBorders borders;
    for (int side = 0; side < 4; ++side)
        borders[size_t(side)] =
            (side % 2 == 0 ? along_u : along_v).control(points(Eigen::all, border_nodes(side, count_u, count_v)), 1);
    return borders;
}

NurbsSurface fit_patch(Eigen::Matrix3Xd points, const CurveFit& along_u, const CurveFit& along_v,
                       const PatchBorders& borders, const Progress& progress)
{
    require_usable(points, along_u, along_v, borders);
    const int count_u = int(along_u.parameters().size()), count_v = int(along_v.parameters().size());
    // Points on the given borders give these borders back, and the inner rows see no others.
    for (int side = 0; side < 4; ++side)
        points(Eigen::all, border_nodes(side, count_u, count_v)) =
            (side % 2 == 0 ? along_u : along_v).at_parameters(borders[size_t(side)], 1);
    constexpr const char* sweep = "fitting the surface";
    progress.checkpoint(0, sweep);
    const Eigen::Matrix3Xd columns = along_v.control(points, count_u);
    progress.checkpoint(0.5, sweep);
    const Eigen::Matrix3Xd control = along_u.control(transposed(columns, count_u), along_v.count());

    NurbsSurface surface;
    surface.degree_u = along_u.degree();
    surface.degree_v = along_v.degree();
    surface.count_u = along_u.count();
    surface.count_v = along_v.count();
    surface.knots_u = along_u.knots();
    surface.knots_v = along_v.knots();
    surface.control = transposed(control, surface.count_v);
    surface.weight = Eigen::VectorXd::Ones(surface.control.cols());
    for (int side = 0; side < 4; ++side) // rounding away
        surface.control(Eigen::all, border_nodes(side, surface.count_u, surface.count_v)) = borders[size_t(side)];
    return surface;
}

DirectionResiduals direction_residuals(const Eigen::Matrix3Xd& points, const CurveFit& along_u, const CurveFit& along_v)
{
    const int count_u = int(along_u.parameters().size()), count_v = int(along_v.parameters().size());
    const Eigen::Matrix3Xd turned = transposed(points, count_u);
    const Eigen::Matrix3Xd by_u = along_u.at_parameters(along_u.control(turned, count_v), count_v);
    return {points - transposed(by_u, count_v),
            points - along_v.at_parameters(along_v.control(points, count_u), count_u)};
}

} // namespace spia

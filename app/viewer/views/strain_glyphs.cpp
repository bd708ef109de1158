#include "app/viewer/views/strain_glyphs.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "app/viewer/views/palette.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

/// One face in each occupied cube of a grid, the first one.
std::vector<int> spread_faces(const TriMesh& part, double spacing)
{
    std::unordered_set<uint64_t> occupied;
    std::vector<int> faces;
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3d middle = part.position(Eigen::all, part.triangle.col(f)).rowwise().mean() / spacing;
        uint64_t cube = 0;
        for (int k = 0; k < 3; ++k)
            cube = cube << 21 | (uint64_t(int64_t(std::floor(middle[k]))) & 0x1fffff);
        if (occupied.insert(cube).second)
            faces.push_back(f);
    }
    return faces;
}

/// The direction in a triangle (columns: corners) that a direction in another one becomes, if the
/// one is laid upon the other. Principal directions stay such.
Eigen::Vector3d carried(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to, const Eigen::Vector3d& direction)
{
    const auto sides = [](const Eigen::Matrix3d& t) {
        Eigen::Matrix<double, 3, 2> result;
        result << t.col(1) - t.col(0), t.col(2) - t.col(0);
        return result;
    };
    const Eigen::Matrix<double, 3, 2> a = sides(from);
    return (sides(to) * (a.transpose() * a).inverse() * (a.transpose() * direction)).normalized();
}

std::shared_ptr<SceneLines> lines_of(const std::vector<Eigen::Vector3d>& ends, const Eigen::Vector3d& origin)
{
    auto lines = std::make_shared<SceneLines>();
    lines->origin = origin;
    lines->point.resize(3, Eigen::Index(ends.size()));
    for (size_t i = 0; i < ends.size(); ++i)
        lines->point.col(Eigen::Index(i)) = (ends[i] - origin).cast<float>();
    return lines;
}

} // namespace

double glyph_spacing(double mm_per_pixel, double diagonal)
{
    constexpr double pixels = 30, most_across = 250;
    return std::exp2(
        std::max(std::round(std::log2(pixels * mm_per_pixel)), std::ceil(std::log2(diagonal / most_across))));
}

LineList strain_glyphs(const TriMesh& part, const FlattenResult& blank, const Eigen::Matrix3Xd& position,
                       double spacing)
{
    if (part.triangles() == 0)
        return {};
    const SheetFields& strain = blank.face;
    const std::vector<int> faces = spread_faces(part, spacing);

    // Nearly all crosses fit between their neighbours; the few largest strains may not.
    std::vector<double> sizes;
    for (const int f : faces)
        sizes.push_back(std::max(std::abs(strain.strain_major[f]), std::abs(strain.strain_minor[f])));
    const auto large = sizes.begin() + ptrdiff_t(0.95 * double(sizes.size() - 1));
    std::nth_element(sizes.begin(), large, sizes.end());
    const double longest = 0.5 * spacing, per_strain = *large > 0 ? longest / *large : 0;

    std::vector<Eigen::Vector3d> stretched, squeezed;
    for (const int f : faces) {
        const Eigen::Matrix3d from = part.position(Eigen::all, part.triangle.col(f)),
                              to = position(Eigen::all, part.triangle.col(f));
        const Eigen::Vector3d middle = to.rowwise().mean();
        const Eigen::Vector3d normal = (to.col(1) - to.col(0)).cross(to.col(2) - to.col(0)).normalized();
        const Eigen::Vector3d major = carried(from, to, strain.direction_major.col(f)), minor = normal.cross(major);
        for (const auto& [value, direction] :
             {std::pair(strain.strain_major[f], major), std::pair(strain.strain_minor[f], minor)}) {
            const double half = std::min(std::abs(value) * per_strain, 1.5 * longest);
            std::vector<Eigen::Vector3d>& ends = value > 0 ? stretched : squeezed;
            if (half > 0.03 * spacing) { // else a dot that says nothing
                ends.push_back(middle - half * direction);
                ends.push_back(middle + half * direction);
            }
        }
    }

    const Eigen::Vector3d origin = position.col(0);
    LineList result;
    for (const auto& [ends, colour] :
         {std::pair(&stretched, palette::stretched), std::pair(&squeezed, palette::squeezed)}) {
        if (ends->empty())
            continue;
        auto casing = lines_of(*ends, origin);
        casing->colour = {1, 1, 1, 0.8f};
        casing->width = 3.6f;
        auto core = std::make_shared<SceneLines>(*casing);
        core->colour = colour;
        core->width = 1.8f;
        result.insert(result.end(), {casing, core});
    }
    return result;
}

} // namespace spia::viewer

#include "engine/pipeline/blank/flat_zones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double of_part = 1e-6; // as write_dxf() has it for what is exact: places of CAD files and
                                 // their blanks are as good

std::uint64_t key(int from, int to) { return std::uint64_t(from) << 32 | std::uint32_t(to); }

/// Where the places of some triangles of a plane lie in the blank, by least squares; none where one
/// is not as it was.
std::optional<FlatZone> zone_of(const TriMesh& mesh, const Blank& blank, const std::vector<int>& faces,
                                const Eigen::Vector3d& normal, double within)
{
    FlatZone zone;
    zone.normal = normal;
    // Seen from the side from which the triangles of the blank are counter-clockwise.
    const auto corners = mesh.triangle.col(faces.front());
    const Eigen::Matrix3d space = mesh.position(Eigen::all, corners);
    const Eigen::Matrix<double, 2, 3> plane = blank.position(Eigen::all, corners);
    const Eigen::Vector3d up = (space.col(1) - space.col(0)).cross(space.col(2) - space.col(0));
    const Eigen::Vector2d u = plane.col(1) - plane.col(0), v = plane.col(2) - plane.col(0);
    const double side = (up.dot(normal) > 0 ? 1 : -1) * (u[0] * v[1] - u[1] * v[0] > 0 ? 1 : -1);
    Eigen::Matrix<double, 2, 3> axes;
    axes.row(0) = normal.unitOrthogonal().transpose();
    axes.row(1) = side * normal.cross(axes.row(0).transpose()).transpose();

    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    Eigen::Vector2d in_blank = Eigen::Vector2d::Zero();
    const double count = 3 * double(faces.size());
    for (const int f : faces)
        for (const int c : mesh.triangle.col(f)) {
            middle += mesh.position.col(c) / count;
            in_blank += blank.position.col(c) / count;
        }
    double cosine = 0, sine = 0;
    for (const int f : faces)
        for (const int c : mesh.triangle.col(f)) {
            const Eigen::Vector2d from = axes * (mesh.position.col(c) - middle), to = blank.position.col(c) - in_blank;
            cosine += from.dot(to);
            sine += from[0] * to[1] - from[1] * to[0];
        }
    const double angle = std::atan2(sine, cosine);
    zone.turn = Eigen::Rotation2Dd(angle).toRotationMatrix() * axes;
    zone.shift = in_blank - zone.turn * middle;
    zone.offset = normal.dot(middle);
    for (const int f : faces)
        for (const int c : mesh.triangle.col(f))
            if (!((zone.in_blank(mesh.position.col(c)) - blank.position.col(c)).norm() <= within))
                return std::nullopt;
    return zone;
}

} // namespace

FlatZones::FlatZones(const PartFile& part, const Blank& blank)
    : within(of_part * bounding_diagonal(part.mesh)), zone_(size_t(part.mesh.triangles()), -1)
{
    const TriMesh& mesh = part.mesh;
    const Eigen::Matrix3Xd area = area_vectors(mesh);
    std::map<int, std::vector<int>> faces; // by CAD face, the largest triangle first
    for (int f = 0; f < mesh.triangles(); ++f) {
        const int cad = part.cad->face[size_t(part.source_face[size_t(f)])];
        if (part.cad->surface[size_t(cad)].kind != StatedSurface::Kind::plane)
            continue;
        std::vector<int>& row = faces[cad];
        row.push_back(f);
        if (area.col(f).squaredNorm() > area.col(row.front()).squaredNorm())
            std::swap(row.front(), row.back());
    }
    for (auto& [cad, row] : faces) {
        const Eigen::Vector3d normal = part.cad->surface[size_t(cad)].direction;
        const double level = normal.dot(mesh.position.col(mesh.triangle(0, row.front())));
        std::erase_if(row, [&](int f) { // remeshed ones may reach into a bend
            const Eigen::RowVector3d off =
                (normal.transpose() * mesh.position(Eigen::all, mesh.triangle.col(f))).array() - level;
            return off.cwiseAbs().maxCoeff() > within;
        });
        if (row.empty())
            continue;
        if (const auto zone = zone_of(mesh, blank, row, normal, within)) {
            of_face_[cad] = *zone;
            for (const int f : row)
                zone_[size_t(f)] = cad;
        }
    }
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const EdgeUse& use = uses[begin];
        if (end == begin + 1)
            beside_[use.forward ? key(use.low, use.high) : key(use.high, use.low)] = use.face;
    });
}

const FlatZone* FlatZones::at(int face) const
{
    return face >= 0 && zone_[size_t(face)] >= 0 ? &of_face_.at(zone_[size_t(face)]) : nullptr;
}

int FlatZones::face_beside(int a, int b) const
{
    const auto found = beside_.find(key(a, b));
    return found == beside_.end() ? -1 : found->second;
}

} // namespace spia

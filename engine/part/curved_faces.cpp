#include "engine/part/curved_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/smooth/curved_triangle.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

Eigen::Matrix3d corners_of(const TriMesh& mesh, int f) { return mesh.position(Eigen::all, mesh.triangle.col(f)); }

Eigen::Vector3d normal_of(const Eigen::Matrix3d& corner)
{
    return (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).normalized();
}

double longest_edge(const Eigen::Matrix3d& corner)
{
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (corner.col((k + 1) % 3) - corner.col(k)).norm());
    return longest;
}

/// Where a vertex lies on the triangles that were given, seen from one of the faces around it: at a
/// sharp edge it is on that side.
struct GivenPlace {
    CurvedTriangle triangle;
    Eigen::Vector3d barycentric;
    const StatedSurface* surface; ///< of the triangle's CAD face; null: none is stated
    bool known;

    Eigen::Vector3d normal() const { return (triangle.normal * barycentric).normalized(); }
    Eigen::Vector3d way() const
    {
        const Eigen::Vector3d place = triangle.corner * barycentric;
        if (!surface || surface->kind == StatedSurface::Kind::other)
            return triangle.on_surface(barycentric) - place;
        if (surface->kind == StatedSurface::Kind::plane) // exactly: bends are looked for between such faces
            return Eigen::Vector3d::Zero();
        const auto off_axis = [&](const Eigen::Vector3d& p) {
            const Eigen::Vector3d from = p - surface->point;
            return Eigen::Vector3d(from - from.dot(surface->direction) * surface->direction);
        };
        const Eigen::Vector3d out = off_axis(place);
        return (off_axis(triangle.corner.col(0)).norm() / out.norm() - 1) * out;
    }
};

class GivenFaces {
public:
    /// @param part  remeshed, with the normals of the triangles that it had
    explicit GivenFaces(const PartFile& part)
        : part_(part), mesh_(*part.remeshed->original), normal_(part.corner_normal), search_(mesh_)
    {
    }
    GivenPlace at(const Eigen::Matrix3d& corner, int k) const
    {
        constexpr double inside = 0.01; // of the way to the middle
        const Eigen::Vector3d place = corner.col(k), middle = corner.rowwise().mean();
        const int face = search_.nearest(place + inside * (middle - place)).face;
        const CurvedTriangle triangle{corners_of(mesh_, face), normal_[size_t(face)].cast<double>()};
        return {triangle, closest_on_triangle(triangle.corner, place), surface_of(face), !triangle.normal.isZero()};
    }

private:
    const PartFile& part_;
    const TriMesh& mesh_;
    const std::vector<Eigen::Matrix3f>& normal_;
    ClosestPointSearch search_;

    const StatedSurface* surface_of(int face) const
    {
        if (!part_.cad || part_.cad->surface.empty())
            return nullptr;
        const int in_file = part_.remeshed->original_face[size_t(face)];
        return &part_.cad->surface[size_t(part_.cad->face[size_t(in_file)])];
    }
};

/// mm, per vertex, to the surface; zero where it is not known, or faces around the vertex have it
/// otherwise.
Eigen::Matrix3Xd ways(const TriMesh& mesh, const std::vector<std::array<GivenPlace, 3>>& place)
{
    Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, mesh.vertices());
    Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.vertices());
    const auto for_each = [&](const auto& visit) {
        for (int f = 0; f < mesh.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                if (place[size_t(f)][size_t(k)].known)
                    visit(mesh.triangle(k, f), place[size_t(f)][size_t(k)].way());
    };
    for_each([&](int v, const Eigen::Vector3d& way) {
        sum.col(v) += way;
        ++count[v];
    });
    for (int v = 0; v < mesh.vertices(); ++v)
        sum.col(v) /= std::max(1., count[v]);
    constexpr double alike = 0.1; // of the way
    std::vector<char> differs(size_t(mesh.vertices()), 0);
    for_each([&](int v, const Eigen::Vector3d& way) {
        differs[size_t(v)] |= (way - sum.col(v)).norm() > alike * sum.col(v).norm();
    });
    for (int v = 0; v < mesh.vertices(); ++v)
        if (differs[size_t(v)])
            sum.col(v).setZero();
    return sum;
}

/// Triangles that would lean over by it keep their vertices.
void move(TriMesh& mesh, Eigen::Matrix3Xd way)
{
    constexpr double upright = 0.9; // cosine of 26 degrees
    const TriMesh before = mesh;
    for (bool again = true; again;) {
        again = false;
        mesh.position = before.position + way;
        for (int f = 0; f < mesh.triangles(); ++f) {
            if (normal_of(corners_of(mesh, f)).dot(normal_of(corners_of(before, f))) >= upright)
                continue;
            for (const int v : mesh.triangle.col(f)) {
                again |= !way.col(v).isZero();
                way.col(v).setZero();
            }
        }
    }
}

} // namespace

std::vector<Eigen::Matrix3f> corner_normals(const PartFile& part, const PolygonSoup& soup, const CornerNormals& normals)
{
    constexpr double beside = 0.05; // of the longest edge: a tenth of what a chord's ends lean
    std::vector<Eigen::Matrix3f> result(size_t(part.mesh.triangles()), Eigen::Matrix3f::Zero());
    const auto stands_for = [&](int vertex) { return part.same_as.empty() ? vertex : part.same_as[size_t(vertex)]; };
    parallel_for(part.mesh.triangles(), [&](int f) {
        const Eigen::Matrix3d corner = corners_of(part.mesh, f);
        const Eigen::Vector3d own = normal_of(corner);
        const double near = beside * longest_edge(corner);
        const int face = part.source_face[size_t(f)];
        const auto in_file = soup.polygon(face);
        Eigen::Matrix3f normal;
        for (int k = 0; k < 3; ++k) {
            const int wanted = stands_for(part.source_vertex[size_t(part.mesh.triangle(k, f))]);
            const auto same = std::ranges::find_if(in_file, [&](int v) { return stands_for(v) == wanted; });
            if (same == in_file.end())
                return;
            const auto at = normals.at_corner(face, int(same - in_file.begin()), own);
            if (!at)
                return;
            const Eigen::Vector3d off = corner.col(k) - soup.position[size_t(*same)];
            if ((off - off.dot(*at) * *at).norm() > near)
                return;
            normal.col(k) = at->cast<float>();
        }
        result[size_t(f)] = normal;
    });
    return result;
}

void onto_faces(PartFile& part)
{
    const GivenFaces given(part);
    std::vector<std::array<GivenPlace, 3>> place(size_t(part.mesh.triangles()));
    std::vector<Eigen::Matrix3f> normal(place.size(), Eigen::Matrix3f::Zero());
    parallel_for(part.mesh.triangles(), [&](int f) {
        const Eigen::Matrix3d corner = corners_of(part.mesh, f);
        auto& of = place[size_t(f)];
        for (int k = 0; k < 3; ++k)
            of[size_t(k)] = given.at(corner, k);
        if (std::ranges::all_of(of, &GivenPlace::known))
            for (int k = 0; k < 3; ++k)
                normal[size_t(f)].col(k) = of[size_t(k)].normal().cast<float>();
    });
    move(part.mesh, ways(part.mesh, place));
    part.corner_normal = std::move(normal);
}

LaidLengths lengths_on_faces(const PartFile& part)
{
    LaidLengths laid;
    for (size_t f = 0; f < part.corner_normal.size(); ++f) {
        const CurvedTriangle triangle{corners_of(part.mesh, int(f)), part.corner_normal[f].cast<double>()};
        if (const auto flat = triangle.normal.isZero() ? std::nullopt : triangle.laid()) {
            laid.face.push_back(int(f));
            laid.corner.push_back(*flat);
        }
    }
    return laid;
}

double sheet_area(const PartFile& part)
{
    Eigen::VectorXd area = area_vectors(part.mesh).colwise().norm().transpose();
    const LaidLengths laid = lengths_on_faces(part);
    for (size_t i = 0; i < laid.face.size(); ++i)
        area[laid.face[i]] = laid.corner[i](0, 1) * laid.corner[i](1, 2) / 2;
    return area.sum();
}

} // namespace spia

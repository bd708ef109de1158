#include "engine/exchange/deck/original_results.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/small_dense.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_graph.h"

namespace spia {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Matrix3d corners_of(const TriMesh& mesh, int face) { return mesh.position(Eigen::all, mesh.triangle.col(face)); }

/// Barycentric coordinates of the foot of the point on the plane of the triangle; outside of it
/// some are negative.
Vector3d on_plane_of(const Matrix3d& triangle, const Vector3d& point)
{
    Eigen::Matrix<double, 3, 2> edge;
    edge << triangle.col(1) - triangle.col(0), triangle.col(2) - triangle.col(0);
    const Matrix2d gram = edge.transpose() * edge;
    const Vector2d share = gram.inverse() * (edge.transpose() * (point - triangle.col(0)));
    return {1 - share.sum(), share[0], share[1]};
}

/// Per vertex of the boundary a place inside, no farther away than `reach`; elsewhere the vertex
/// itself.
Eigen::Matrix3Xd a_little_inside(const TriMesh& mesh, double reach)
{
    Eigen::Matrix3Xd middle = Eigen::Matrix3Xd::Zero(3, mesh.vertices());
    Eigen::VectorXd faces = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (const int v : mesh.triangle.col(f)) {
            middle.col(v) += corners_of(mesh, f).rowwise().mean();
            faces[v] += 1;
        }
    Eigen::Matrix3Xd result = mesh.position;
    const std::vector<char> on_rim = edge_graph(mesh).on_rim;
    for (int v = 0; v < mesh.vertices(); ++v) {
        if (!on_rim[size_t(v)])
            continue;
        const Vector3d way = middle.col(v) / faces[v] - mesh.position.col(v);
        const double length = way.norm();
        if (length > 0)
            result.col(v) += std::min(0.5, reach / length) * way;
    }
    return result;
}

Blank carry_blank(const TriMesh& original, const TriMesh& mesh, const ClosestPointSearch& search, double edge,
                  const Blank& blank)
{
    const Eigen::Matrix3Xd asked = a_little_inside(original, edge / 4);
    Blank result{Eigen::Matrix2Xd(2, original.vertices())};
    parallel_for(original.vertices(), [&](int v) {
        const ClosestPoint found = search.nearest(asked.col(v));
        const bool inside = asked.col(v) == original.position.col(v);
        const Vector3d weight =
            inside ? found.barycentric : on_plane_of(corners_of(mesh, found.face), original.position.col(v));
        result.position.col(v) = blank.position(Eigen::all, mesh.triangle.col(found.face)) * weight;
    });
    return result;
}

/// Calls take(place) at the middles of n^2 equal parts of the triangle.
template <class Take> void spread(const Matrix3d& t, int n, const Take& take)
{
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            for (const int up : {0, 1}) {
                if (up && i + j + 1 >= n)
                    continue;
                const double a = (i + (up ? 2 : 1) / 3.0) / n, b = (j + (up ? 2 : 1) / 3.0) / n;
                take(Vector3d((1 - a - b) * t.col(0) + a * t.col(1) + b * t.col(2)));
            }
}

/// The sum of both principal values as a tensor in the plane of u and w.
Matrix2d tensor(double major, double minor, const Vector2d& direction)
{
    return minor * Matrix2d::Identity() + (major - minor) * direction * direction.transpose();
}

void carry_to_face(const Matrix3d& triangle, int f, int n, const ClosestPointSearch& search, const SheetFields& from,
                   SheetFields& to)
{
    const Vector3d u = (triangle.col(1) - triangle.col(0)).normalized();
    const Vector3d normal = u.cross(triangle.col(2) - triangle.col(0)).normalized(), w = normal.cross(u);
    Matrix2d strain = Matrix2d::Zero(), stress = Matrix2d::Zero();
    double thickness = 0, thinning = 0, strain_equivalent = 0, stress_equivalent = 0;
    int necking = 0;
    spread(triangle, n, [&](const Vector3d& place) {
        const int g = search.nearest(place).face;
        Vector2d along(u.dot(from.direction_major.col(g)), w.dot(from.direction_major.col(g)));
        along.normalize();
        strain += tensor(from.strain_major[g], from.strain_minor[g], along);
        stress += tensor(from.stress_major[g], from.stress_minor[g], along);
        thickness += from.thickness[g];
        thinning += from.thinning[g];
        strain_equivalent += from.strain_equivalent[g];
        stress_equivalent += from.stress_equivalent[g];
        necking = std::max(necking, from.necking[g]);
    });
    const double places = double(n) * n;
    const EigenPairs<2> principal = eigen_pairs(strain / places);
    const Vector2d major = principal.vector.col(1), minor = principal.vector.col(0);
    to.thickness[f] = thickness / places;
    to.thinning[f] = thinning / places;
    to.strain_major[f] = principal.value[1];
    to.strain_minor[f] = principal.value[0];
    to.strain_equivalent[f] = strain_equivalent / places;
    to.stress_major[f] = major.dot(stress * major) / places;
    to.stress_minor[f] = minor.dot(stress * minor) / places;
    to.stress_equivalent[f] = stress_equivalent / places;
    to.direction_major.col(f) = major[0] * u + major[1] * w;
    to.necking[f] = necking;
}

SheetFields carry_fields(const TriMesh& original, const ClosestPointSearch& search, double edge,
                         const SheetFields& face)
{
    const int count = original.triangles();
    SheetFields result;
    for (Eigen::VectorXd* field :
         {&result.thickness, &result.thinning, &result.strain_major, &result.strain_minor, &result.strain_equivalent,
          &result.stress_major, &result.stress_minor, &result.stress_equivalent})
        field->resize(count);
    result.direction_major.resize(3, count);
    result.necking.resize(count);
    parallel_for(count, [&](int f) {
        const Matrix3d t = corners_of(original, f);
        const double longest =
            std::max({(t.col(1) - t.col(0)).norm(), (t.col(2) - t.col(1)).norm(), (t.col(0) - t.col(2)).norm()});
        constexpr double most = 64; // per side of a triangle: a plate of two of them has 8192
                                    // places
        carry_to_face(t, f, int(std::clamp(std::ceil(longest / (0.5 * edge)), 1.0, most)), search, face, result);
    });
    return result;
}

} // namespace

OriginalResults on_original(const PartFile& part, const Blank& blank, const SheetFields& face)
{
    if (!part.remeshed || !part.deck)
        throw InputError("results are carried back to the elements of a deck that was remeshed; this part has none");
    require_blank_of(part.mesh, blank);
    require_fields(face, part.mesh.triangles(), "face");
    const Remeshed& remeshed = *part.remeshed;
    const TriMesh& original = *remeshed.original;
    const ClosestPointSearch search(part.mesh);
    const double edge = remeshed.after.median_edge;
    return {as_read(part), carry_blank(original, part.mesh, search, edge, blank),
            carry_fields(original, search, edge, face)};
}

} // namespace spia

// Our LSCM, ARAP and one-step inverse forming (with plasticity) beside the LSCM and ARAP of CGAL's
// Surface_mesh_parameterization [Saboret, Alliez, Levy, Rouxel-Labbe, Fabri] on the same mesh in
// the same run, judged by the same ruler; times are those of the processor, all threads together.
// CGAL has no ABF++ (5.5). Usage: spia-peers [PART] [LARGEST]; without a part the inner panel at
// several sizes up to LARGEST triangles.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <fmt/core.h>

#include <complex>
#include <cstdlib>
#include <ctime>

#include "engine/compare/arap.h"
#include "engine/compare/lscm.h"
#include "engine/compare/map_quality.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/flatten.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "tests/support/inner_panel.h"

namespace {

using namespace spia;
namespace smp = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using UvMap = Mesh::Property_map<Vertex, Kernel::Point_2>;

Mesh cgal_mesh(const TriMesh& part)
{
    Mesh mesh;
    for (int v = 0; v < part.vertices(); ++v)
        mesh.add_vertex({part.position(0, v), part.position(1, v), part.position(2, v)});
    for (int f = 0; f < part.triangles(); ++f)
        mesh.add_face(Vertex(unsigned(part.triangle(0, f))), Vertex(unsigned(part.triangle(1, f))),
                      Vertex(unsigned(part.triangle(2, f))));
    return mesh;
}

/// Runs a parameterizer over the longest border.
template <class Parameterizer>
Eigen::Matrix2Xd parameterized(const TriMesh& part, Mesh& mesh, Parameterizer parameterizer)
{
    const std::vector<int> outer = boundary_loops(part).at(0);
    // The border halfedge along the first edge of the loop has no face on its side.
    auto border = mesh.halfedge(Vertex(unsigned(outer[0])), Vertex(unsigned(outer[1])));
    if (!mesh.is_border(border))
        border = mesh.opposite(border);
    UvMap uv = mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
    const auto error = smp::parameterize(mesh, parameterizer, border, uv);
    if (error != smp::OK)
        fmt::print("  CGAL: {}\n", smp::get_error_message(error));
    Eigen::Matrix2Xd flat(2, part.vertices());
    for (int v = 0; v < part.vertices(); ++v)
        flat.col(v) << uv[Vertex(unsigned(v))].x(), uv[Vertex(unsigned(v))].y();
    if (flat_area(part, flat) < 0)
        flat.row(0) *= -1;
    return flat;
}

/// Root mean square distance after the best similarity, as a share of the root of the area.
double difference(const TriMesh& part, const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    const std::complex<double> i(0, 1);
    Eigen::VectorXcd z = a.row(0).transpose() + i * a.row(1).transpose();
    Eigen::VectorXcd w = b.row(0).transpose() + i * b.row(1).transpose();
    z.array() -= z.mean();
    w.array() -= w.mean();
    const std::complex<double> factor = z.dot(w) / z.squaredNorm();
    return (factor * z - w).norm() / std::sqrt(double(part.vertices()) * flat_area(part, b));
}

double arap_energy(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    double sum = 0, total = 0;
    const auto element = elements(part);
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = element[size_t(f)];
        sum += e.area * arap_density(inverse_gradient(e, corners(flat, part.triangle.col(f))));
        total += e.area;
    }
    return sum / total;
}

template <class Run> void row(const TriMesh& part, const char* title, const Run& run, Eigen::Matrix2Xd& flat)
{
    const std::clock_t start = std::clock();
    flat = run();
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    const MapQuality q = map_quality(part, flat);
    fmt::print("| {} | {} | {:.2f} | {:.5f} | {:.5f} | {:.4f} | {:.4f} | {:.6f} | {} | {} |\n", part.triangles(), title,
               seconds, q.angular_rms, q.area_rms, q.l2_stretch, q.symmetric_dirichlet, arap_energy(part, flat),
               q.flips, q.crossings);
    std::fflush(stdout);
}

void beside_each_other(const TriMesh& part)
{
    Eigen::Matrix2Xd ours, theirs;
    Mesh mesh = cgal_mesh(part); // not counted
    const std::array<int, 2> pins = far_pins(part);
    row(
        part, "LSCM, ours", [&] { return lscm(part, {.pins = pins}).position; }, ours);
    row(
        part, "LSCM, CGAL",
        [&] {
            using Border = smp::Two_vertices_parameterizer_3<Mesh>;
            const Border border{Vertex{unsigned(pins[0])}, Vertex{unsigned(pins[1])}};
            // Its rows lack the 1 / sqrt(2 A) of the paper's eq. 4: large triangles weigh more than
            // in ours.
            Eigen::Matrix2Xd flat = parameterized(part, mesh, smp::LSCM_parameterizer_3<Mesh, Border>(border));
            scale_to_area_of(part, flat);
            return flat;
        },
        theirs);
    const double conformal = difference(part, theirs, ours);
    row(
        part, "ARAP, ours", [&] { return arap(part).position; }, ours);
    FlattenOptions sheet;
    sheet.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    sheet.thickness = 0.8;
    Eigen::Matrix2Xd blank;
    row(
        part, "one-step inverse forming, ours", [&] { return flatten(part, sheet).blank.position; }, blank);
    row(
        part, "ARAP, CGAL", [&] { return parameterized(part, mesh, smp::ARAP_parameterizer_3<Mesh>()); }, theirs);
    fmt::print("differences after the best similarity: LSCM {:.1e}, ARAP {:.1e}\n", conformal,
               difference(part, theirs, ours));
}

} // namespace

int main(int count, char** values)
{
    fmt::print("| triangles | method | CPU s | angular | area | L2 | sd | ARAP energy / area | flips | overlaps |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n");
    if (count > 1 && !std::isdigit(values[1][0])) {
        beside_each_other(read_part(values[1]).mesh);
        return 0;
    }
    const int largest = count > 1 ? std::atoi(values[1]) : 105000;
    for (int triangles : {2000, 20000, 50000, 105000, 207000, 500000}) {
        shapes::InnerPanel shape;
        shape.triangles = triangles;
        if (triangles <= largest)
            beside_each_other(shapes::inner_panel(shape).mesh);
    }
    return 0;
}

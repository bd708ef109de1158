#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/flatten.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_patches.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_panel_test {
namespace {

constexpr double gap = 0.2; // mm

FlattenResult flattened(const TriMesh& part)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
    options.thickness = 0.8;
    return flatten(part, options);
}

double area_of(const TriMesh& part, const Blank& blank)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        Eigen::Matrix2d sides;
        sides << blank.position.col(part.triangle(1, f)) - blank.position.col(part.triangle(0, f)),
            blank.position.col(part.triangle(2, f)) - blank.position.col(part.triangle(0, f));
        sum += sides.determinant() / 2;
    }
    return std::abs(sum);
}

/// The distances in the blank between places of the border whose x, y on the panel are given: every
/// two of the corners and of the middles of the sides.
std::vector<double> extents(const TriMesh& part, const Blank& blank)
{
    const std::array<Eigen::Vector2d, 8> places = {
        {{0, 0}, {300, 0}, {600, 0}, {600, 225}, {600, 450}, {300, 450}, {0, 450}, {0, 225}}};
    std::vector<Eigen::Vector2d> found;
    for (const Eigen::Vector2d& place :
         places) { // between the two nearest vertices of the border, where the place lies
        Eigen::Vector2d best = Eigen::Vector2d::Zero();
        double nearest = 1e9;
        for (int f = 0; f < part.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = part.triangle(k, f), b = part.triangle((k + 1) % 3, f);
                const Eigen::Vector2d p = part.position.col(a).head<2>(), side = part.position.col(b).head<2>() - p;
                const double t = std::clamp((place - p).dot(side) / side.squaredNorm(), 0.0, 1.0);
                if (const double distance = (p + t * side - place).norm(); distance < nearest) {
                    nearest = distance;
                    best = (1 - t) * blank.position.col(a) + t * blank.position.col(b);
                }
            }
        found.push_back(best);
    }
    std::vector<double> result;
    for (size_t i = 0; i < found.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            result.push_back((found[i] - found[j]).norm());
    return result;
}

void expect_panel(const TriMesh& part, double deflection)
{
    double on_border = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d p = part.position.col(part.triangle(k, f)),
                                  q = part.position.col(part.triangle((k + 1) % 3, f));
            EXPECT_NEAR(p.z(), panel_height(p.x(), p.y()), gap);
            middle += p / 3;
            const bool west = p.x() < gap && q.x()<gap, east = p.x()> 600 - gap && q.x() > 600 - gap,
                       south = p.y() < gap && q.y()<gap, north = p.y()> 450 - gap && q.y() > 450 - gap;
            on_border += west || east || south || north ? (p - q).head<2>().norm() : 0;
        }
        EXPECT_NEAR(middle.z(), panel_height(middle.x(), middle.y()), gap + deflection);
    }
    EXPECT_NEAR(on_border, 2 * (600 + 450), 2) << "all of the border is there";
}

} // namespace

TEST(CadPanel, NineHundredPatchesWithGapsAndOverlapsGiveTheBlankOfTheCleanPanel)
{
    const ScratchFolder folder;
    ReadOptions options;
    options.cad.deflection = 0.05;
    write_panel(folder / "clean.igs", 1, 0);
    write_panel(folder / "patches.igs", 30, gap);
    const TriMesh clean = read_part(folder / "clean.igs", options).mesh;
    const PartFile part = read_part(folder / "patches.igs", options);
    EXPECT_EQ(part.cad->faces, 915);
    EXPECT_EQ(part.doctor.components, 1);
    EXPECT_EQ(part.doctor.boundary_loops, 1) << "no free edge inside";
    EXPECT_EQ(part.doctor.genus, 0);
    ASSERT_TRUE(part.doctor.find(Fault::gap));
    EXPECT_GT(part.doctor.find(Fault::gap)->count, 1700);
    expect_panel(part.mesh, 0.05);

    const FlattenResult expected = flattened(clean), found = flattened(part.mesh);
    EXPECT_TRUE(found.report.converged) << found.report.reason;
    EXPECT_NEAR(area_of(part.mesh, found.blank) / area_of(clean, expected.blank), 1, 1e-3);
    const std::vector<double> exact = extents(clean, expected.blank), got = extents(part.mesh, found.blank);
    double worst = 0;
    for (size_t i = 0; i < exact.size(); ++i)
        worst = std::max(worst, std::abs(got[i] / exact[i] - 1));
    EXPECT_LT(worst, 1e-3);
    RecordProperty("triangles", part.mesh.triangles());
    RecordProperty("worst_extent_ppm", int(worst * 1e6));
}

TEST(CadPanel, StepOfAHundredPatchesIsOneSheetToo)
{
    const ScratchFolder folder;
    write_panel(folder / "patches.step", 10, gap);
    const PartFile part = read_part(folder / "patches.step");
    EXPECT_EQ(part.doctor.boundary_loops, 1);
    EXPECT_EQ(part.doctor.genus, 0);
    expect_panel(part.mesh, part.cad->deflection);
}

} // namespace spia::cad_panel_test

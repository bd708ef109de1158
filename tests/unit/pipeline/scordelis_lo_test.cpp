// A real analysis stands on what the program writes: the Scordelis-Lo roof [Belytschko et al. 1985,
// shell obstacle course; Kiendl et al. 2009: 0.3006 for shells that are rigid in shear] from a mesh
// through the chain and a file to a shell solver.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/exchange/iga/write_geopdes.h"
#include "engine/exchange/iga/write_gismo.h"
#include "engine/exchange/iga/write_mfem.h"
#include "engine/forming/material/material_library.h"
#include "engine/nurbs/evaluate.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "tests/support/grid_surface.h"
#include "tests/support/iga_readers.h"
#include "tests/support/kirchhoff_love.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::scordelis_lo_test {
namespace {

constexpr double radius = 25, span = 50, half_angle = 40 * std::numbers::pi / 180, reference = 0.3006;

Eigen::Vector3d on_roof(double angle, double y) { return {radius * std::sin(angle), y, radius * std::cos(angle)}; }

/// How far the middle of a free edge sinks.
double sinking(const MultiPatch& patches)
{
    analysis::Shell shell{patches, 0.25, 4.32e8, 0, {0, 0, -90}, {}};
    shell.held = [&](int number,
                     const Eigen::Vector3d& x) { // diaphragms at both ends; free along them but for
                                                 // one point
        const bool end = x.y() < 1e-3 || x.y() > span - 1e-3;
        return std::array{end, number == 0, end};
    };
    const analysis::Solution solution = analysis::solve(shell);
    const Eigen::Vector3d wanted = on_roof(half_angle, span / 2);
    double nearest = 1e300, sunk = 0;
    for (int p = 0; p < int(patches.patch.size()); ++p)
        for (const Eigen::Vector2d& uv :
             {Eigen::Vector2d(0.5, 0), Eigen::Vector2d(0.5, 1), Eigen::Vector2d(0, 0.5), Eigen::Vector2d(1, 0.5)}) {
            const double off = (evaluate(patches.patch[size_t(p)], uv[0], uv[1]).position - wanted).norm();
            if (off < nearest) {
                nearest = off;
                sunk = -analysis::displacement_at(shell, solution, p, uv[0], uv[1]).z();
            }
        }
    EXPECT_LT(nearest, 0.05) << "the middle of the free edge";
    return sunk;
}

constexpr int columns = 128, rows = 32;
int vertex(int i, int j) { return i + (columns + 1) * j; }

/// The roof as a mesh, through the chain.
Session finished(const std::optional<LayoutOptions>& patches, std::optional<double> tolerance)
{
    Session session;
    PartFile part;
    part.mesh = shapes::grid_surface({columns, rows},
                                     [](double u, double v) { return on_roof((2 * u - 1) * half_angle, span * v); });
    part.source_vertex.resize(size_t(part.mesh.vertices()));
    std::iota(part.source_vertex.begin(), part.source_vertex.end(), 0);
    session.part = std::make_shared<PartFile>(std::move(part));
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.flatten.thickness = 0.25;
    session.options.corners = {vertex(0, 0), vertex(columns, 0), vertex(columns, rows), vertex(0, rows)};
    session.options.grid.columns = session.options.grid.rows = 20;
    session.options.patches = patches;
    session.options.tolerance = tolerance;
    return completed(run_chain(std::move(session), Stage::solve));
}

/// Through each format and back.
std::vector<std::pair<std::string, MultiPatch>> read_back(const MultiPatch& patches)
{
    const ScratchFolder folder;
    write_gismo(folder / "roof.xml", patches);
    write_geopdes(folder / "roof.txt", patches);
    write_mfem(folder / "roof.mesh", patches);
    return {{"gismo", iga::read_gismo(folder / "roof.xml").patches},
            {"geopdes", iga::read_geopdes(folder / "roof.txt").patches},
            {"mfem", iga::read_mfem(folder / "roof.mesh").patches}};
}

} // namespace

TEST(ScordelisLo, OfTheExactRationalRoofConvergesToTheReference)
{
    NurbsSurface roof;
    roof.degree_u = roof.degree_v = 2;
    roof.count_u = roof.count_v = 3;
    roof.knots_u = roof.knots_v = {0, 0, 0, 1, 1, 1};
    roof.control.resize(3, 9);
    roof.weight.resize(9);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            const double cosine = i == 1 ? std::cos(half_angle) : 1;
            roof.control.col(roof.index(i, j)) = on_roof((i - 1) * half_angle, span * j / 2);
            for (const int e : {0, 2})
                roof.control(e, roof.index(i, j)) /= cosine;
            roof.weight[roof.index(i, j)] = cosine;
        }
    double last = 0;
    for (const int times : {4, 5, 6}) {
        const double error = std::abs(sinking(analysis::refined({{roof}, {}}, times)) / reference - 1);
        if (last > 0) {
            EXPECT_LT(error, last / 4) << times;
        }
        last = error;
    }
    EXPECT_LT(last, 3e-4);
}

TEST(ScordelisLo, OfTheMeshedRoofThroughEveryFile)
{
    const Session session = finished(std::nullopt, std::nullopt);
    for (const auto& [name, patches] : read_back(surface_patches(session)))
        EXPECT_NEAR(sinking(patches) / reference, 1, 1e-3) << name;
}

TEST(ScordelisLo, OfTheMeshedRoofWithinAToleranceRefinedForTheAnalysis)
{
    for (const auto& [tolerance, error] : {std::pair(1e-3, 1e-3), {5e-4, 5e-4}}) {
        const Session session = finished(std::nullopt, tolerance);
        EXPECT_TRUE(session.surface->fit->reached);
        const MultiPatch read = read_back(surface_patches(session)).front().second;
        EXPECT_NEAR(sinking(analysis::refined(read, 2)) / reference, 1, error);
    }
}

TEST(ScordelisLo, OfTheSameRoofAsTwoPatchesThroughEveryFile)
{
    LayoutOptions layout;
    layout.cuts = {{vertex(columns / 2, 0), vertex(columns / 2, rows)}};
    layout.corners = {vertex(0, 0), vertex(columns, 0), vertex(columns, rows), vertex(0, rows)};
    const Session session = finished(layout, 0.002);
    ASSERT_EQ(session.surface->patches->patches.patch.size(), 2u);
    for (const auto& [name, patches] : read_back(surface_patches(session))) {
        ASSERT_EQ(patches.interfaces.size(), 1u) << name << ": from the file";
        EXPECT_NEAR(sinking(analysis::refined(patches, 3)) / reference, 1, 1e-3) << name;
    }
}

} // namespace spia::scordelis_lo_test

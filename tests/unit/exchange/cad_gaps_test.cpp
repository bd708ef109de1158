#include <BRepBuilderAPI_MakeEdge.hxx>
#include <chrono>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gtest/gtest.h>
#include <vector>

#include "engine/exchange/cad/cad_gaps.h"
#include "engine/exchange/cad/occt_session.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "tests/unit/exchange/sample_faces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

FreeEdge line(int owner, const gp_Pnt& from, const gp_Pnt& to)
{
    return {BRepBuilderAPI_MakeEdge(from, to).Edge(), owner};
}

} // namespace

TEST(CadGaps, AreTheFarthestOfSevenPlacesFromTheEdgesOfOthers)
{
    const OcctSession session;
    for (const double x : {0.0, 1e9}) { // far off: rounded to 1e-7
        const double rounding = 1e-12 + 1e-15 * x;
        const std::vector<FreeEdge> edges = {
            line(0, {x, 0, 0}, {x + 10, 0, 0}), line(1, {x, 0.1, 0}, {x + 10, 0.3, 0}), // widens
            line(1, {x, 0.1, 5}, {x + 10, 0.1, 5}), line(1, {x, 0.2, 5}, {x + 10, 0.2, 5})};
        const std::vector<double> gaps = gaps_to_others(edges, 0.5, {});
        ASSERT_EQ(gaps.size(), 2u) << "the last two are borders of one face";
        EXPECT_NEAR(gaps[0], 0.275 / std::sqrt(1 + 0.02 * 0.02), rounding);
        EXPECT_NEAR(gaps[1], 0.275, rounding);
        EXPECT_EQ(gaps_to_others(edges, 0.27, {}).size(), 0u);
    }
}

TEST(CadGaps, AnEdgeOfMetresAmongTinyOnesTakesNoLonger)
{
    const OcctSession session;
    std::vector<FreeEdge> edges;
    for (int k = 0; k < 2000; ++k) {
        // a hundredth beside each other, at their ends
        const double x = 0.04 * (k % 50), y = 0.04 * (k / 50);
        edges.push_back(line(k, {x, y, 0}, {x + 0.03, y, 0}));
    }
    edges.push_back(line(2000, {10, 10, 10}, {2000, 2000, 2000}));
    edges.push_back(line(2001, {10, -10, 0}, {10, -10, 1e8}));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(gaps_to_others(edges, 0.01, {}).size(), 0u);
    EXPECT_EQ(gaps_to_others(edges, 0.041, {}).size(), 2000u);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(CadSewing, ClosesAGapBesideAnyNumberOfHoles)
{
    const ScratchFolder folder;
    for (const int holes : {0, 10, 30}) {
        write_perforated_halves(folder / "plate.brep", holes, Between::gap, 0.02);
        const PartFile part = examine_part(folder / "plate.brep");
        EXPECT_GT(part.cad->sewing_tolerance, 0.02) << holes;
        EXPECT_LT(part.cad->sewing_tolerance, 0.1) << holes;
        EXPECT_EQ(part.doctor.components, 1) << holes;
        EXPECT_EQ(part.doctor.boundary_loops, 1 + 2 * holes);
    }
}

TEST(CadSewing, LeavesASlitBesideManyHolesOpen)
{
    const ScratchFolder folder;
    write_perforated_halves(folder / "plate.brep", 30, Between::slit, 0.02);
    const CadContent cad = read_cad(folder / "plate.brep");
    EXPECT_EQ(cad.sewing_tolerance, 0) << "the plate hangs together";
    EXPECT_EQ(cad.free_after, 3 + 1 + 3 + 2 + 60);
    write_perforated_halves(folder / "plate.brep", 30, Between::slit, 0.0005); // a flaw
    EXPECT_EQ(read_cad(folder / "plate.brep").sewing_tolerance, 0.001);
}

} // namespace spia

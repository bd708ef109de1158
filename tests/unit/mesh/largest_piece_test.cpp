#include <algorithm>
#include <gtest/gtest.h>

#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

/// Adds columns x rows quads of unit length spanned from a place; corners at equal places are one
/// vertex.
void add_sheet(PolygonSoup& soup, const Eigen::Vector3d& from, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
               int columns, int rows)
{
    const auto vertex = [&](int i, int j) {
        const Eigen::Vector3d p = from + i * u + j * v;
        const auto found = std::find(soup.position.begin(), soup.position.end(), p);
        const int number = int(found - soup.position.begin());
        if (found == soup.position.end())
            soup.position.push_back(p);
        return number;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            soup.add_polygon(
                std::array<int, 4>{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
}

const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

Examination kept_largest(const PolygonSoup& soup)
{
    DoctorOptions options;
    options.keep_largest = true;
    return examine(soup, options);
}

TEST(LargestPiece, OfASheetWithARibRightAcrossItIsTheWholeSheet)
{
    PolygonSoup soup;
    add_sheet(soup, {3, 0, 0}, y, z, 4, 2); // the rib comes first in the file
    add_sheet(soup, {0, 0, 0}, x, y, 6, 4);
    EXPECT_FALSE(examine(soup).report.healthy());

    const Examination kept = kept_largest(soup);
    EXPECT_TRUE(kept.report.healthy());
    EXPECT_EQ(kept.mesh.triangles(), 2 * 6 * 4);
    EXPECT_EQ(kept.mesh.position.row(2).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(kept.report.components, 1);
    EXPECT_EQ(kept.report.boundary_loops, 1);
    const Finding* left_out = kept.report.find(Fault::several_components);
    ASSERT_TRUE(left_out);
    EXPECT_EQ(left_out->severity, Severity::repaired);
    EXPECT_EQ(left_out->count, 2 * 4 * 2);
    EXPECT_EQ(left_out->first, 0);
}

TEST(LargestPiece, IsTheOneOfTheGreatestAreaNotOfTheMostFaces)
{
    PolygonSoup soup;
    add_sheet(soup, {0, 0, 5}, 0.1 * x, 0.1 * y, 9, 9);
    add_sheet(soup, {0, 0, 0}, x, y, 2, 2);
    const Examination kept = kept_largest(soup);
    EXPECT_TRUE(kept.report.healthy());
    EXPECT_EQ(kept.mesh.triangles(), 2 * 2 * 2);
    EXPECT_EQ(kept.source_face.front(), 81);
}

TEST(LargestPiece, OfOnePieceIsAllOfIt)
{
    PolygonSoup soup;
    add_sheet(soup, {0, 0, 0}, x, y, 3, 3);
    const Examination kept = kept_largest(soup);
    EXPECT_EQ(kept.mesh.triangles(), 18);
    EXPECT_TRUE(kept.report.findings.empty() || !kept.report.find(Fault::several_components));
}

TEST(FaultPlaces, AreThoseOfTheFileAlsoForWhatWasTakenOut)
{
    PolygonSoup soup;
    add_sheet(soup, {0, 0, 0}, x, y, 3, 1);
    add_sheet(soup, {0, 0, 9}, x, y, 1, 1);              // another piece
    soup.position.emplace_back(7, 8, 9);                 // stray
    soup.add_polygon(std::array<int, 4>{0, 1, 2, 3});    // again the first one
    soup.add_polygon(std::array<int, 3>{0, 1, 100'000}); // fatal, so nothing else is looked at
    const Examination broken = examine(soup);
    const Finding* index = broken.report.find(Fault::bad_index);
    ASSERT_TRUE(index);
    EXPECT_EQ(index->where, std::vector<int>{5});
    EXPECT_TRUE(index->place[0].isApprox(Eigen::Vector3d(0.5, 0, 0)));

    soup.corner.resize(soup.corner.size() - 3);
    soup.first.pop_back();
    const Examination found = examine(soup);
    const Finding* stray = found.report.find(Fault::stray_vertex);
    ASSERT_TRUE(stray && stray->place.size() == 1);
    EXPECT_EQ(stray->place[0], Eigen::Vector3d(7, 8, 9));
    const Finding* twice = found.report.find(Fault::duplicate_face);
    ASSERT_TRUE(twice && twice->place.size() == 1);
    EXPECT_TRUE(twice->place[0].isApprox(Eigen::Vector3d(0.5, 0.5, 0)));
    const Finding* pieces = found.report.find(Fault::several_components);
    ASSERT_TRUE(pieces && pieces->place.size() == 1);
    EXPECT_TRUE(pieces->place[0].isApprox(Eigen::Vector3d(0.5, 0.5, 9)));
    for (const Finding& finding : found.report.findings)
        EXPECT_EQ(finding.where.size(), finding.place.size());
}

} // namespace
} // namespace spia

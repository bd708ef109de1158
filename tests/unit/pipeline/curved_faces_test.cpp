// Parts whose CAD faces are curved: what is laid flat has the lengths of these, not of their
// chords.
#include <Eigen/Dense>
#include <cmath>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/exchange/read_part.h"
#include "engine/part/curved_faces.h"
#include "tests/support/cad/drawn_solid.h"
#include "tests/support/family.h"
#include "tests/support/flat_area.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::CadForm;

/// mm, in a plane, of vertices on the middle of a conical sheet.
Eigen::Matrix2Xd unrolled(const TriMesh& part, const shapes::ConicalSheet& sheet)
{
    const double c = std::cos(sheet.slope), s = std::sin(sheet.slope);
    Eigen::Matrix2Xd flat(2, part.vertices());
    for (int v = 0; v < part.vertices(); ++v) {
        const Eigen::Vector3d p = part.position.col(v);
        const double along = (p.head<2>().norm() - sheet.from) * c + p.z() * s;
        double turn = std::atan2(p.y(), p.x());
        if (turn < (sheet.turn - 2 * std::numbers::pi) / 2) // the gap is between
            turn += 2 * std::numbers::pi;
        flat.col(v) = (sheet.from / c + along) * Eigen::Vector2d(std::cos(c * turn), std::sin(c * turn));
    }
    return flat;
}

/// mm, once they lie on each other as well as they can, either side up. [Kabsch 1976]
double farthest_from(Eigen::Matrix2Xd expected, Eigen::Matrix2Xd X)
{
    expected.colwise() -= expected.rowwise().mean().eval();
    X.colwise() -= X.rowwise().mean().eval();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(expected * X.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    return (svd.matrixU() * svd.matrixV().transpose() * X - expected).colwise().norm().maxCoeff();
}

} // namespace

TEST(CurvedFaces, OfDrawnSolidsHaveTheAreaOfTheMiddleSurface)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= shapes::family_size(16); ++seed)
        for (const CadForm form : {CadForm::step, CadForm::iges}) {
            const auto file = folder / (std::string("part") + extension(form));
            const shapes::DrawnSolid solid = shapes::write_drawn_solid(file, seed, form);
            if (!solid.middle_area)
                continue;
            SCOPED_TRACE(solid.kind + extension(form));
            const PartFile part = read_part(file);
            ASSERT_TRUE(part.solid);
            // needles at the pole of a dome's surface of revolution are not remeshed, which is told
            EXPECT_NEAR(sheet_area(part) / *solid.middle_area, 1, part.remeshed ? 2e-4 : 1e-3);
            if (!part.remeshed)
                EXPECT_THAT(part.notes, testing::Contains(testing::HasSubstr("they were not remeshed")));
        }
}

TEST(CurvedFaces, OfRolledConesAreLaidAsLongAsTheyAre)
{
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= shapes::family_size(12); ++seed) {
        shapes::SeededRandom random(seed + 61000);
        shapes::ConicalSheet sheet;
        sheet.thickness = random.between(0.5, 4);
        sheet.from = sheet.thickness * random.between(4, 60);
        sheet.length = sheet.thickness * random.between(15, 60);
        sheet.slope = random.between(0.2, 1.5);
        sheet.turn = random.between(0.8, 6.1);
        for (const CadForm form : {CadForm::step, CadForm::iges}) {
            const auto file = folder / (std::string("part") + extension(form));
            SCOPED_TRACE(fmt::format("{}: t {:.3g}, from {:.3g}, {:.3g} long, slope {:.3g}, turn {:.3g}{}", seed,
                                     sheet.thickness, sheet.from, sheet.length, sheet.slope, sheet.turn,
                                     extension(form)));
            shapes::write_conical_sheet(file, sheet, form);
            const Session session = solved_part(file);
            ASSERT_TRUE(session.part->solid);
            const Eigen::Matrix2Xd& X = session.blank->blank.position;
            EXPECT_NEAR(shapes::flat_area(X, session.part->mesh.triangle) / sheet.middle_area(), 1, 1e-4);
            EXPECT_LT(session.blank->face.strain_equivalent.maxCoeff(), 2e-3);
            EXPECT_LT(farthest_from(unrolled(session.part->mesh, sheet), X), 1e-4 * (sheet.to() + sheet.length));
        }
    }
}

TEST(CurvedFaces, OfAClosedConeAreSaidToNeedACutAndUnrollOnceItIsMade)
{
    const ScratchFolder folder;
    for (const double slope : {0.5, 1., 1.4})
        for (const double length : {15., 60.}) {
            SCOPED_TRACE(fmt::format("slope {}, {} long", slope, length));
            const shapes::ConicalSheet sheet{1.5, 40, length, slope, 2 * std::numbers::pi};
            shapes::write_conical_sheet(folder / "part.step", sheet);
            const PartFile closed = read_part(folder / "part.step");
            EXPECT_TRUE(closed.doctor.find(Fault::closed_corner) || closed.seam_length > 0);
            ReadOptions corners;
            corners.seam.mode = SeamOptions::Mode::corners;
            const PartFile part = read_part(folder / "part.step", corners);
            EXPECT_NEAR(part.seam_length, length, 1e-6 * length) << "along a ruling";
            EXPECT_FALSE(part.doctor.find(Fault::closed_corner));
        }
}

} // namespace spia

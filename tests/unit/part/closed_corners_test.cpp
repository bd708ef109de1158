#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/curvature.h"
#include "engine/options/part_options.h"
#include "tests/support/bent_parts.h"
#include "tests/unit/exchange/sample_meshes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using testing::HasSubstr;

struct ClosedCorners : testing::Test {
    ScratchFolder folder;
    PartFile read(const TriMesh& mesh, SeamOptions::Mode mode)
    {
        std::ofstream(folder / "part.obj") << sample::obj_text(mesh);
        return examine_part(folder / "part.obj", {.seam = {mode, {}}});
    }
};

} // namespace

TEST_F(ClosedCorners, AreSaidWithTheWayOut)
{
    const PartFile part = read(shapes::lipped_box(), SeamOptions::Mode::automatic);
    const Finding* corners = part.doctor.find(Fault::closed_corner);
    ASSERT_TRUE(corners);
    EXPECT_EQ(corners->severity, Severity::note);
    EXPECT_EQ(corners->count, 4);
    EXPECT_EQ(corners->place.size(), 4u);
    EXPECT_THAT(corners->text, HasSubstr("at 4 corners, up to 90 degrees away from flat"));
    EXPECT_THAT(corners->advice, HasSubstr(mention(option::seam, "corners")));
    EXPECT_TRUE(part.seam.empty()) << "nothing is cut unasked";
}

TEST_F(ClosedCorners, AreCutWhenThatIsAskedFor)
{
    const PartFile part = read(shapes::lipped_box(), SeamOptions::Mode::corners);
    EXPECT_TRUE(part.doctor.healthy());
    EXPECT_FALSE(part.doctor.find(Fault::closed_corner));
    EXPECT_LT(angle_defects(part.mesh).cwiseAbs().sum(), 1e-6);
    EXPECT_EQ(part.seam.size(), 4u);
    EXPECT_NEAR(part.seam_length, 120, 1e-9);
    ASSERT_TRUE(part.doctor.find(Fault::seam));
    EXPECT_THAT(part.doctor.find(Fault::seam)->text, HasSubstr("it unrolls without strain now"));
    EXPECT_TRUE(part.doubts.empty());
}

TEST_F(ClosedCorners, WithoutAnyTheWishIsADoubt)
{
    const PartFile part = read(shapes::round_cup(), SeamOptions::Mode::corners);
    EXPECT_TRUE(part.seam.empty());
    ASSERT_EQ(part.doubts.size(), 1u);
    EXPECT_THAT(part.doubts[0], HasSubstr("no corners to cut"));
}

} // namespace spia

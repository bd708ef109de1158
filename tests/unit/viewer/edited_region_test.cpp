#include "app/viewer/panels/steps/edited_region.h"

#include <gtest/gtest.h>

namespace spia::viewer {

TEST(EditedRegion, EndsWithItsRegionItsPartAndWhereAnotherTookItsPlace)
{
    Document document;
    document.session.part = std::make_shared<PartFile>();
    document.regions = {{"a", RegionKind::pad, {}, {1, 2}}, {"b", RegionKind::fixed, {}, {5}}};
    const EditedRegion edited = edit_of(document, 1);
    EXPECT_EQ(edited.name, "b");
    EXPECT_TRUE(still_there(edited, document));

    Document renamed = document;
    renamed.regions[1].name += " two";
    renamed.regions[1].kind = RegionKind::other;
    EXPECT_TRUE(still_there(edited, renamed)) << "that is what editing does";

    Document undone = document;
    undone.regions.pop_back();
    EXPECT_FALSE(still_there(edited, undone));

    Document removed = document;
    removed.regions[1].faces = {7};
    EXPECT_FALSE(still_there(edited, removed)) << "another region with this number";

    Document other = document;
    other.session.part = std::make_shared<PartFile>();
    EXPECT_FALSE(still_there(edited, other)) << "on another part";
}

} // namespace spia::viewer

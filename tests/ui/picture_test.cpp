#include "app/viewer/pictures.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "engine/core/error.h"
#include "tests/ui/hidden_window.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

/// The smallest rectangle of pixels around what differs.
struct Difference {
    int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
    bool any() const { return right >= 0; }
    int height() const { return bottom - top + 1; }
    int width() const { return right - left + 1; }
};
Difference difference(const Picture& a, const Picture& b)
{
    Difference found;
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const size_t at = (size_t(y) * size_t(a.width) + size_t(x)) * 4;
            if (!std::equal(&a.rgba[at], &a.rgba[at] + 4, &b.rgba[at])) {
                found.left = std::min(found.left, x);
                found.right = std::max(found.right, x);
                found.top = std::min(found.top, y);
                found.bottom = std::max(found.bottom, y);
            }
        }
    return found;
}

/// The blank of the dome with its legend and the labels of its least and greatest value, from so
/// far away that it is not in their way.
class ViewPicture : public testing::Test {
protected:
    ViewPicture()
    {
        state.document = document_of(dome, Stage::solve);
        Camera& camera = state.view.camera[size_t(View::blank)];
        camera.target = {100, 100, 0}; // mm, the middle of the blank or near it
        camera.height = 1000;
    }
    Picture draw(int width, int height, const PictureContent& content)
    {
        return picture_of_view(renderer, model, state, cache, View::blank, width, height, content);
    }
    HiddenWindow window;
    Renderer renderer;
    ViewerModel model{SPIA_SOURCE_DIR "/assets", [] {}};
    ViewerState state;
    SceneCache cache;
};

} // namespace

TEST_F(ViewPicture, LegendAndLabelsStandWhereTheyDoOnTheScreenAndOnlyIfWanted)
{
    const Picture plain = draw(960, 640, {false, false});
    const Difference legend = difference(plain, draw(960, 640, {true, false}));
    ASSERT_TRUE(legend.any());
    EXPECT_LT(legend.right, 150); // in the lower left corner
    EXPECT_GT(legend.bottom, 600);
    EXPECT_GT(legend.height(), 190); // a bar of 200 pixels
    const Difference labels = difference(plain, draw(960, 640, {false, true}));
    ASSERT_TRUE(labels.any());
    EXPECT_GT(labels.left, 240); // beside the blank of 190 mm in the middle of 1500 mm, on either
                                 // side of it
    EXPECT_LT(labels.right, 720);
    const Difference both = difference(plain, draw(960, 640, {true, true}));
    EXPECT_EQ(both.left, legend.left);
    EXPECT_EQ(both.right, labels.right);
}

TEST_F(ViewPicture, InALargerPictureTheWordsAreAsMuchLarger)
{
    const Difference small = difference(draw(960, 640, {false, false}), draw(960, 640, {true, false}));
    const Difference large = difference(draw(2880, 1920, {false, false}), draw(2880, 1920, {true, false}));
    EXPECT_NEAR(large.height(), 3 * small.height(), 12);
    EXPECT_NEAR(large.width(), 3 * small.width(), 12);
    EXPECT_NEAR(large.left, 3 * small.left, 6);
}

TEST_F(ViewPicture, ATransparentGroundKeepsTheWordsOpaque)
{
    const Picture picture = draw(960, 640, {true, true, false});
    size_t clear = 0, opaque = 0;
    for (size_t k = 3; k < picture.rgba.size(); k += 4) {
        clear += picture.rgba[k] == 0;
        opaque += picture.rgba[k] == 255;
    }
    EXPECT_GT(clear, size_t(900 * 600));
    EXPECT_GT(opaque, size_t(12 * 190)); // the bar of the legend
}

TEST_F(ViewPicture, TheWindowsOwnContextOfImGuiComesBack)
{
    EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
    draw(300, 200, {});
    EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
    ImGuiContext* const own = ImGui::CreateContext();
    draw(300, 200, {});
    EXPECT_EQ(ImGui::GetCurrentContext(), own);
    ImGui::DestroyContext(own);
}

TEST_F(ViewPicture, TheContextComesBackAlsoWhenThereIsNoMemoryForTheLetters)
{
    struct Letters { // as large as a file of them
        static void* get(size_t bytes, void*)
        {
            if (bytes > 100000)
                throw std::bad_alloc();
            return std::malloc(bytes);
        }
        static void drop(void* memory, void*) { std::free(memory); }
    };
    ImGuiContext* const own = ImGui::CreateContext();
    ImGuiMemAllocFunc get = nullptr;
    ImGuiMemFreeFunc drop = nullptr;
    void* user = nullptr;
    ImGui::GetAllocatorFunctions(&get, &drop, &user);
    ImGui::SetAllocatorFunctions(Letters::get, Letters::drop);
    EXPECT_THROW(draw(300, 200, {}), std::bad_alloc);
    ImGui::SetAllocatorFunctions(get, drop, user);
    EXPECT_EQ(ImGui::GetCurrentContext(), own);
    EXPECT_NO_THROW(draw(300, 200, {}));
    EXPECT_EQ(ImGui::GetCurrentContext(), own);
    ImGui::DestroyContext(own);
}

} // namespace spia::viewer

#include "app/viewer/panels/gui_frame.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <stdexcept>

namespace spia::viewer {
namespace {

/// ImGui without a screen.
class GuiFrame : public testing::Test {
protected:
    GuiFrame()
    {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {800, 600};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~GuiFrame() override { ImGui::DestroyContext(); }

    template <class Draw> static void frame(const Draw& draw)
    {
        ImGui::NewFrame();
        ImGui::Begin("window");
        draw();
        ImGui::End();
        ImGui::Render();
    }
    static int triangles() { return ImGui::GetDrawData()->TotalIdxCount / 3; }
};

} // namespace

TEST_F(GuiFrame, AfterABrokenOneTheNextIsAsIfItHadNeverBeen)
{
    const auto draw = [] {
        ImGui::TextUnformatted("text");
        ImGui::Button("button");
    };
    for (int k = 0; k < 3; ++k)
        frame(draw);
    const int before = triangles();
    EXPECT_GT(before, 0);
    for (int k = 0; k < 3; ++k)
        try {
            frame([] {
                ImGui::PushFont(ImGui::GetFont());
                ImGui::PushStyleColor(ImGuiCol_Text, {1, 0, 0, 1});
                ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.5f);
                ImGui::BeginDisabled();
                ImGui::BeginChild("child");
                ImGui::PushID(7);
                ImGui::GetWindowDrawList()->PushClipRect({1, 1}, {2, 2});
                if (ImGui::BeginTable("table", 2))
                    ImGui::TableNextColumn();
                ImGui::Begin("another");
                throw std::runtime_error("no picture");
            });
            FAIL();
        } catch (const std::runtime_error&) {
            end_broken_frame();
        }
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    EXPECT_FALSE(context.WithinFrameScope);
    EXPECT_EQ(context.FontStack.Size, 0);
    EXPECT_EQ(context.ColorStack.Size, 0);
    EXPECT_EQ(context.StyleVarStack.Size, 0);
    for (int k = 0; k < 3; ++k)
        frame(draw);
    EXPECT_EQ(triangles(), before);
    EXPECT_EQ(ImGui::GetStyle().Alpha, 1);
}

TEST_F(GuiFrame, BetweenTwoFramesThereIsNothingToEnd)
{
    frame([] {});
    end_broken_frame();
    frame([] {});
}

TEST_F(GuiFrame, MenusCloseButTheDialogBelowThemStays)
{
    const auto draw = [](bool open) {
        frame([&] {
            if (open)
                ImGui::OpenPopup("dialog");
            if (ImGui::BeginPopupModal("dialog")) {
                if (open)
                    ImGui::OpenPopup("list");
                if (ImGui::BeginPopup("list")) {
                    ImGui::TextUnformatted("entry");
                    ImGui::EndPopup();
                }
                ImGui::EndPopup();
            }
        });
    };
    const auto open = [] { return ImGui::GetCurrentContext()->OpenPopupStack.Size; };
    draw(true);
    draw(false);
    ASSERT_EQ(open(), 2);
    EXPECT_TRUE(close_menus());
    EXPECT_EQ(open(), 1);
    draw(false);
    EXPECT_FALSE(close_menus());
    EXPECT_EQ(open(), 1);
}

} // namespace spia::viewer

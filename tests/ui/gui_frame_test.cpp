#include "app/viewer/panels/gui_frame.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <stdexcept>

#include "app/viewer/panels/dialogs/export_dialog.h"
#include "app/viewer/panels/screen_text.h"
#include "app/viewer/panels/widgets.h"

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
        ImGui::SetNextWindowSize({700, 500});
        ImGui::Begin("window");
        draw();
        ImGui::End();
        ImGui::Render();
    }
    static int triangles() { return ImGui::GetDrawData()->TotalIdxCount / 3; }
};

/// Those of a window in which no part is open.
class Panels : public GuiFrame {
protected:
    Panels() { ui.fonts.bold = ui.fonts.small = ImGui::GetIO().Fonts->Fonts[0]; }

    ViewerModel model{SPIA_SOURCE_DIR "/assets"};
    ActionQueue actions;
    Ui ui;
    SceneCache cache;
    Frame now{model, ViewEvents(model), model.pickers(), model.state(), actions, ui, cache, {}, {}, {}};
};

/// A number field into which somebody types.
class TypedNumber : public Panels {
protected:
    /// Draws one frame. @returns whether the number has changed
    bool draw(const std::vector<int>& keys = {})
    {
        ui.keys.clear();
        for (const int key : keys)
            ui.keys.push_back({key, 0});
        bool changed = false;
        frame([&] {
            if (std::exchange(focus, false))
                ImGui::SetKeyboardFocusHere();
            changed = typed_number(now, "number", value, format, step);
            ImGui::InputText("other", other, sizeof other);
        });
        return changed;
    }
    void type(const char* text)
    {
        focus = true;
        for (int k = 0; k < 3; ++k)
            ASSERT_FALSE(draw());
        for (; *text; ++text) {
            ImGui::GetIO().AddInputCharacter(unsigned(*text));
            ASSERT_FALSE(draw()) << "it counts when typing ends";
        }
        ASSERT_EQ(value, 1);
    }

    double value = 1, step = 0;
    const char* format = "%.4g";
    bool focus = false;
    char other[8] = "";
};

} // namespace

TEST_F(TypedNumber, CountsWhateverEndsTyping)
{
    for (const double buttons : {0., 0.5})
        for (const int key : {GLFW_KEY_TAB, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER, 0}) {
            step = buttons;
            value = 1;
            type("25");
            if (key == 0) // a click elsewhere, or a shortcut
                ImGui::ClearActiveID();
            EXPECT_TRUE(key == 0 ? draw() : draw({key})) << key << " with step " << step;
            EXPECT_EQ(value, 25);
            EXPECT_FALSE(draw()) << "once";
            EXPECT_FALSE(draw());
        }
}

TEST_F(TypedNumber, HasAnExponent)
{
    for (const double buttons : {0., 0.5}) {
        step = buttons;
        value = 1;
        type("2e-7");
        EXPECT_TRUE(draw({GLFW_KEY_ENTER}));
        EXPECT_EQ(value, 2e-7) << "with step " << step;
        EXPECT_FALSE(draw());
    }
}

TEST_F(TypedNumber, IsTakenBackByEscape)
{
    type("25");
    EXPECT_FALSE(draw({GLFW_KEY_ESCAPE}));
    EXPECT_FALSE(draw());
    EXPECT_EQ(value, 1);
}

TEST_F(TypedNumber, MayHaveACommaBeforeItsDecimals)
{
    for (const double buttons : {0., 0.5}) {
        step = buttons;
        value = 1;
        type("0,8");
        EXPECT_TRUE(draw({GLFW_KEY_ENTER}));
        EXPECT_EQ(value, 0.8);
    }
}

TEST_F(TypedNumber, IsRefusedWithWhatWasTypedWhereItIsNone)
{
    for (const double buttons : {0., 0.5})
        for (const std::string text : {"0,8,1", "0.8x", "1,000.5"}) {
            step = buttons;
            type(text.c_str());
            EXPECT_FALSE(draw({GLFW_KEY_ENTER}));
            EXPECT_FALSE(draw());
            EXPECT_EQ(value, 1);
            EXPECT_TRUE(ui.number_refused);
            EXPECT_EQ(model.state().messages.back().text, "\"" + text + "\" is not a number. number stays 1.");
        }
}

TEST_F(TypedNumber, KeepsAllDigits)
{
    for (const auto& [text, number] : {std::pair{"0.42137", 0.42137}, {"1e-7", 1e-7}, {"0.123456789", 0.123456789}}) {
        value = 1;
        format = nullptr;
        step = 0.01;
        type(text);
        EXPECT_TRUE(draw({GLFW_KEY_ENTER}));
        EXPECT_EQ(value, number);
        EXPECT_FALSE(draw());
        bool shown = false;
        std::string all;
        for (const ScreenText& each : texts_on_screen(*ImGui::GetDrawData())) {
            shown |= each.text.find(fmt::format("{}", number)) != std::string::npos;
            all += each.text + " | ";
        }
        EXPECT_TRUE(shown) << text << " in " << all;
    }
}

TEST_F(GuiFrame, ASliderTakesACommaForAPoint)
{
    float value = 0;
    ImVec2 at;
    const auto draw = [&] {
        frame([&] {
            points_for_commas();
            ImGui::SliderFloat("share", &value, 0, 1, "%.2f");
            at = ImGui::GetItemRectMin();
        });
    };
    ImGuiIO& io = ImGui::GetIO();
    draw();
    draw();
    io.MousePos = {at.x + 5, at.y + 5};
    draw();
    io.KeyCtrl = io.MouseDown[0] = true;
    draw();
    io.KeyCtrl = io.MouseDown[0] = false;
    draw();
    for (const char* letter = "0,25"; *letter; ++letter) {
        io.AddInputCharacter(unsigned(*letter));
        draw();
    }
    EXPECT_FLOAT_EQ(value, 0.25f);
}

TEST_F(Panels, TheExportDialogStaysWhereItOpens)
{
    ImGui::GetIO().DisplaySize = {1600, 1200};
    ui.show_export = true;
    std::vector<ImRect> seen;
    for (int k = 0; k < 6; ++k) {
        frame([&] { export_dialog(now); });
        if (const ImGuiWindow* dialog = ImGui::FindWindowByName("Export"); dialog && dialog->Active && !dialog->Hidden)
            seen.push_back(dialog->Rect());
    }
    ASSERT_GE(seen.size(), 4u);
    for (const ImRect& each : seen) {
        EXPECT_EQ(each.Min.y, seen.back().Min.y);
        EXPECT_EQ(each.Max.y, seen.back().Max.y);
    }
}

TEST_F(GuiFrame, ItsTextsAreReadOffWhatIsDrawn)
{
    ImVec2 at, button;
    for (int k = 0; k < 3; ++k)
        frame([&] {
            at = ImGui::GetCursorScreenPos();
            ImGui::TextUnformatted("two words, 12.5 %");
            ImGui::SameLine(300);
            ImGui::TextUnformatted("next column");
            ImGui::Button("Press me");
            button = ImGui::GetItemRectMin();
            ImGui::ProgressBar(0.4f); // shapes are no letters
            ImGui::PushClipRect({0, 0}, {1, 1}, false);
            ImGui::GetWindowDrawList()->AddText({20, 200}, IM_COL32_WHITE, "out of sight");
            ImGui::PopClipRect();
        });
    const auto texts = texts_on_screen(*ImGui::GetDrawData());
    std::vector<std::string> lines;
    lines.reserve(texts.size());
    for (const ScreenText& text : texts)
        lines.push_back(text.text);
    EXPECT_EQ(lines, (std::vector<std::string>{"window", "two words, 12.5 %", "next column", "Press me", "40%"}));
    ASSERT_EQ(texts.size(), 5);
    EXPECT_NEAR(texts[1].at.x, at.x, 1);
    EXPECT_NEAR(texts[1].at.y, at.y, 1);
    EXPECT_NEAR(texts[1].size.x, ImGui::CalcTextSize("two words, 12.5 %").x, 1);
    EXPECT_NEAR(texts[1].size.y, ImGui::GetFontSize(), 1);
    EXPECT_GT(texts[3].at.x, button.x);
}

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

// Whether what is written can be read: contrasts of the theme's own colours.
#include "app/viewer/panels/theme.h"

#include <gtest/gtest.h>

namespace spia::viewer {
namespace {

const ImVec4 white{1, 1, 1, 1}, black{0, 0, 0, 1};

TEST(Theme, ContrastIsThatOfTheRecommendation)
{
    EXPECT_NEAR(contrast(white, black), 21, 1e-6);
    EXPECT_NEAR(contrast(white, white), 1, 1e-12);
    // The grey #767676 is known as the lightest that is legible on white: 4.54 [WCAG 2.1, technique
    // G18].
    EXPECT_NEAR(contrast(ImVec4(0x76 / 255.f, 0x76 / 255.f, 0x76 / 255.f, 1), white), 4.54, 0.01);
}

TEST(Theme, TextAndItsColoursAreLegibleOnEveryGround)
{
    ImGui::CreateContext();
    for (const bool dark : {true, false}) {
        apply_theme(dark, 1);
        const ImVec4* of = ImGui::GetStyle().Colors;
        const Palette p = palette_of(dark);
        for (const ImGuiCol ground :
             {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_ButtonHovered,
              ImGuiCol_ButtonActive, ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive, ImGuiCol_TitleBg})
            EXPECT_GE(contrast(of[ImGuiCol_Text], of[ground]), readable) << ImGui::GetStyleColorName(ground);
        for (const ImGuiCol ground : {ImGuiCol_WindowBg, ImGuiCol_PopupBg})
            for (const auto& [name, colour] : {std::pair("accent", p.accent),
                                               {"good", p.good},
                                               {"warning", p.warning},
                                               {"error", p.error},
                                               {"muted", p.muted}})
                EXPECT_GE(contrast(colour, of[ground]), readable)
                    << name << " on " << ImGui::GetStyleColorName(ground) << (dark ? ", dark" : ", light");
        EXPECT_GE(contrast(p.warning, of[ImGuiCol_Button]), readable) << "the count at the foot of the window";
    }
    ImGui::DestroyContext();
}

TEST(Theme, WhiteLettersAreLegibleOnBannersAndColouredButtons)
{
    for (const bool dark : {true, false}) {
        const Palette p = palette_of(dark);
        for (const ImVec4& colour : {p.accent, p.good, p.warning, p.error}) {
            const ImVec4 ground = under_white(colour);
            EXPECT_GE(contrast(ground, white), readable);
            if (contrast(colour, white) >= readable) {
                EXPECT_EQ(ground.x, colour.x) << "no darker than it must be";
            }
        }
    }
}

} // namespace
} // namespace spia::viewer

#include "app/viewer/panels/theme.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace spia::viewer {
namespace {

constexpr const char* inter = "/usr/share/fonts/opentype/inter/"; // Debian's fonts-inter

ImFont* load(const char* file, float size, Fonts& fonts, bool few_glyphs = false)
{
    // In large pictures only those that labels and legends have, or the texture of all letters
    // would be too large.
    static const ImWchar few[] = {0x20, 0xff, 0x2010, 0x2027, 0x2212, 0x2212, 0x2264, 0x2265, 0};
    constexpr float large = 80; // pixels
    static const ImWchar glyphs[] = {0x20,   0x17f,  0x2010, 0x2027, 0x2190, 0x2199, 0x2200,
                                     0x22ff, 0x25a0, 0x25ff, 0x2713, 0x2717, 0};
    ImGuiIO& io = ImGui::GetIO();
    const std::string path = std::string(inter) + file;
    if (!std::filesystem::exists(path)) {
        fonts.missing = path;
        ImFontConfig config;
        config.SizePixels = std::round(size);
        return io.Fonts->AddFontDefault(&config);
    }
    return io.Fonts->AddFontFromFileTTF(path.c_str(), std::round(size), nullptr,
                                        few_glyphs || size > large ? few : glyphs);
}

ImVec4 rgb(unsigned hex, float alpha = 1)
{
    return {float(hex >> 16 & 255) / 255, float(hex >> 8 & 255) / 255, float(hex & 255) / 255, alpha};
}

} // namespace

Fonts load_fonts(float scale)
{
    Fonts fonts;
    fonts.text = load("Inter-Regular.otf", 15 * scale, fonts);
    fonts.bold = load("Inter-SemiBold.otf", 15 * scale, fonts);
    fonts.small = load("Inter-Regular.otf", 13 * scale, fonts);
    fonts.heading = load("Inter-SemiBold.otf", 22 * scale, fonts, true);
    return fonts;
}

double contrast(const ImVec4& a, const ImVec4& b)
{
    const auto linear = [](float c) { return c <= 0.03928f ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    const auto luminance = [&](const ImVec4& c) {
        return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
    };
    const double first = luminance(a) + 0.05, second = luminance(b) + 0.05;
    return std::max(first, second) / std::min(first, second);
}

ImVec4 under_white(const ImVec4& colour)
{
    ImVec4 ground(colour.x, colour.y, colour.z, 1);
    while (contrast(ground, {1, 1, 1, 1}) < readable)
        ground.x *= 0.98f, ground.y *= 0.98f, ground.z *= 0.98f;
    return ground;
}

Palette palette_of(bool dark)
{
    if (dark)
        return {rgb(0x5c98ff), rgb(0x5cb977), rgb(0xe0a53c), rgb(0xf0695f),
                rgb(0x8e97a6), rgb(0x1d2127), rgb(0x343b46)};
    return {rgb(0x1f63d8), rgb(0x20803f), rgb(0x966000), rgb(0xc4342a), rgb(0x667080), rgb(0xf4f5f7), rgb(0xd3d8e0)};
}

void apply_theme(bool dark, float scale)
{
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle{};
    dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
    style.WindowRounding = style.ChildRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = style.ScrollbarRounding = 4;
    style.WindowBorderSize = 0;
    style.FrameBorderSize = dark ? 0.f : 1.f;
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 5};
    style.ItemSpacing = {8, 7};
    style.ItemInnerSpacing = {6, 5};
    style.ScrollbarSize = 11;
    style.GrabMinSize = 11;
    style.ScaleAllSizes(scale);

    const Palette p = palette_of(dark);
    ImVec4* c = style.Colors;
    const ImVec4 ink = dark ? rgb(0xe4e8ee) : rgb(0x1b2129);
    const ImVec4 field = dark ? rgb(0x2a3039) : rgb(0xffffff), hover = dark ? rgb(0x353d49) : rgb(0xe3e9f4);
    c[ImGuiCol_Text] = ink;
    c[ImGuiCol_TextDisabled] = p.muted;
    c[ImGuiCol_WindowBg] = c[ImGuiCol_MenuBarBg] = p.panel;
    c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    c[ImGuiCol_PopupBg] = dark ? rgb(0x262c34) : rgb(0xffffff);
    c[ImGuiCol_Border] = c[ImGuiCol_Separator] = p.line;
    c[ImGuiCol_FrameBg] = field;
    c[ImGuiCol_FrameBgHovered] = hover;
    c[ImGuiCol_FrameBgActive] = hover;
    c[ImGuiCol_Button] = dark ? rgb(0x323945) : rgb(0xffffff);
    c[ImGuiCol_ButtonHovered] = dark ? rgb(0x3f4957) : rgb(0xe3e9f4);
    c[ImGuiCol_ButtonActive] = dark ? rgb(0x4a5666) : rgb(0xd2dcee);
    c[ImGuiCol_Header] = dark ? rgb(0x2c3644) : rgb(0xdfe8f8);
    c[ImGuiCol_HeaderHovered] = hover;
    c[ImGuiCol_HeaderActive] = dark ? rgb(0x3b4859) : rgb(0xcfdcf3);
    c[ImGuiCol_CheckMark] = c[ImGuiCol_PlotHistogram] = p.accent;
    // text is read on it
    c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = dark ? rgb(0x2c57a3) : rgb(0xa8c5f5);
    c[ImGuiCol_TextSelectedBg] = ImVec4(p.accent.x, p.accent.y, p.accent.z, 0.35f);
    c[ImGuiCol_NavHighlight] = p.accent;
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = dark ? rgb(0x262c34) : rgb(0xe9ecf1);
    c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45f);
}

} // namespace spia::viewer

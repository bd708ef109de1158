#include "app/viewer/panels/screen_text.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace spia::viewer {
namespace {

struct Letter {
    const ImFont* font;
    const ImFontGlyph* glyph;
};

/// Letters by the place of their pictures in the texture of all fonts.
std::map<std::pair<float, float>, Letter> letters()
{
    std::map<std::pair<float, float>, Letter> known;
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (glyph.Visible)
                known.try_emplace({glyph.U0, glyph.V0}, Letter{font, &glyph});
    return known;
}

void append(std::string& text, unsigned code)
{
    char utf8[5] = {};
    if (code < 0x80)
        utf8[0] = char(code);
    else if (code < 0x800) {
        utf8[0] = char(0xc0 | (code >> 6));
        utf8[1] = char(0x80 | (code & 0x3f));
    } else {
        utf8[0] = char(0xe0 | (code >> 12));
        utf8[1] = char(0x80 | ((code >> 6) & 0x3f));
        utf8[2] = char(0x80 | (code & 0x3f));
    }
    text += utf8;
}

/// The line that is being read: letters of one size on one baseline, each after the one before.
class Line {
public:
    explicit Line(std::vector<ScreenText>& texts) : texts_(texts) {}
    ~Line() { end(); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    /// @param shown  of the height of its picture, less than 1 where the end of its stem is cut off
    void read(const Letter& letter, ImVec2 least, ImVec2 greatest, float shown)
    {
        const float height = shown * (letter.glyph->Y1 - letter.glyph->Y0), scale = (greatest.y - least.y) / height;
        const float size = letter.font->FontSize * scale, top = least.y - letter.glyph->Y0 * scale;
        const float from = least.x - letter.glyph->X0 * scale, to = from + letter.glyph->AdvanceX * scale;
        const float space = letter.font->GetCharAdvance(' ') * scale, gap = from - end_;
        // Between two words there is a space; letters are moved by less than a pixel, columns are
        // farther apart.
        const bool goes_on = text_ && std::abs(top - text_->at.y) < 1 && std::abs(size - text_->size.y) < 0.5f &&
                             gap > -0.5f * space && gap < 2.6f * space;
        if (!goes_on) {
            end();
            text_ = ScreenText{"", {from, top}, {0, size}};
        } else if (gap > 0.5f * space)
            text_->text += ' ';
        append(text_->text, letter.glyph->Codepoint);
        end_ = to;
        text_->size.x = to - text_->at.x;
    }
    void end()
    {
        if (text_)
            texts_.push_back(std::move(*text_));
        text_.reset();
    }

private:
    std::vector<ScreenText>& texts_;
    std::optional<ScreenText> text_;
    float end_ = 0; ///< where the next letter would begin
};

} // namespace

std::vector<ScreenText> texts_on_screen(const ImDrawData& drawn)
{
    std::vector<ScreenText> texts;
    const auto known = letters();
    const ImTextureID of_fonts = ImGui::GetIO().Fonts->TexID;
    constexpr unsigned quad = 6; // indices of a letter
    for (int k = 0; k < drawn.CmdListsCount; ++k) {
        const ImDrawList& list = *drawn.CmdLists[k];
        Line line(texts);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback || command.GetTexID() != of_fonts)
                continue;
            const ImVec4& clip = command.ClipRect;
            for (unsigned i = 0; i + quad <= command.ElemCount;) {
                const ImDrawIdx* index = &list.IdxBuffer[int(command.IdxOffset + i)];
                const auto vertex = [&](int n) -> const ImDrawVert& {
                    return list.VtxBuffer[int(command.VtxOffset) + int(index[n])];
                };
                const ImDrawVert &a = vertex(0), &c = vertex(2);
                const auto letter = known.find({a.uv.x, a.uv.y});
                // A letter is two triangles, a b c and a c d; other shapes have one place of the
                // texture for all corners.
                const bool is_letter = letter != known.end() && index[3] == index[0] && index[4] == index[2] &&
                                       a.uv.x != c.uv.x && a.uv.y != c.uv.y;
                if (!is_letter) {
                    i += 3;
                    continue;
                }
                i += quad;
                const ImVec2 middle{(a.pos.x + c.pos.x) / 2, (a.pos.y + c.pos.y) / 2};
                if (middle.x >= clip.x && middle.x <= clip.z && middle.y >= clip.y && middle.y <= clip.w)
                    line.read(letter->second, a.pos, c.pos,
                              (c.uv.y - a.uv.y) / (letter->second.glyph->V1 - letter->second.glyph->V0));
            }
        }
    }
    return texts;
}

} // namespace spia::viewer

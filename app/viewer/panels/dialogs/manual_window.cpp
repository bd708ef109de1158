#include "app/viewer/panels/dialogs/manual_window.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/text_input.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

/// Lines of words in several looks, broken where there is no room. @returns the file of a link that
/// was clicked, else empty
class Flow {
public:
    Flow(Frame& frame, float width, ImFont* regular) : frame_(frame), regular_(regular), width_(width)
    {
        from_ = at_ = ImGui::GetCursorScreenPos();
        line_ = regular->FontSize * 1.35f;
    }

    void text(const ManualText& spans)
    {
        for (const ManualSpan& span : spans)
            for (size_t at = 0; at < span.text.size();) {
                size_t end = span.text.find_first_of(" \n", at);
                end = end == std::string::npos ? span.text.size() : end;
                if (end > at)
                    word(span, span.text.substr(at, end - at));
                if (end < span.text.size())
                    span.text[end] == '\n' ? next_line() : space();
                at = end + 1;
            }
    }
    /// Takes the room that the words have; call once. @returns their height
    float end()
    {
        const float height = at_.y + line_ - from_.y;
        ImGui::SetCursorScreenPos(from_);
        ImGui::Dummy({width_, height});
        return height;
    }
    const std::string& clicked() const { return clicked_; }

private:
    void space() { at_.x += at_.x > from_.x ? regular_->CalcTextSizeA(regular_->FontSize, 1e6f, 0, " ").x : 0; }
    void next_line() { at_ = {from_.x, at_.y + line_}; }
    void word(const ManualSpan& span, const std::string& text)
    {
        ImFont* font = span.bold ? frame_.ui.fonts.bold : regular_;
        const float size = regular_->FontSize, wide = font->CalcTextSizeA(size, 1e6f, 0, text.c_str()).x;
        if (at_.x + wide > from_.x + width_ && at_.x > from_.x)
            next_line();
        const Palette p = palette_of(frame_.state.view.dark);
        ImDrawList* draw = ImGui::GetWindowDrawList();
        const ImVec2 low{at_.x + wide, at_.y + size};
        ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
        if (span.code)
            draw->AddRectFilled({at_.x - 1, at_.y - 1}, {low.x + 1, low.y + 2}, ink(p.line), 2);
        if (!span.link.empty()) {
            colour = ink(p.accent);
            draw->AddLine({at_.x, low.y + 1}, {low.x, low.y + 1}, colour);
            if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(at_, low)) {
                ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
                if (ImGui::IsMouseClicked(0))
                    clicked_ = span.link;
            }
        }
        draw->AddText(font, size, at_, colour, text.c_str());
        at_.x += wide;
    }

    Frame& frame_;
    ImFont* regular_;
    float width_, line_ = 0;
    ImVec2 from_, at_;
    std::string clicked_;
};

std::string flow(Frame& frame, const ManualText& text, float width, ImFont* font)
{
    Flow words(frame, width, font);
    words.text(text);
    words.end();
    return words.clicked();
}

std::string table(Frame& frame, const ManualBlock& block, int number)
{
    std::string clicked;
    const size_t columns = block.rows.empty() ? 0 : block.rows.front().size();
    if (columns == 0 || !ImGui::BeginTable(fmt::format("table{}", number).c_str(), int(columns),
                                           ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchProp))
        return clicked;
    std::vector<float> share(columns, 1); // as long as the words in it, within reason
    for (const auto& row : block.rows)
        for (size_t k = 0; k < std::min(columns, row.size()); ++k) {
            float letters = 0;
            for (const ManualSpan& span : row[k])
                letters += float(span.text.size());
            share[k] = std::max(share[k], std::clamp(letters, 8.f, 60.f));
        }
    for (size_t k = 0; k < columns; ++k)
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, share[k]);
    for (size_t r = 0; r < block.rows.size(); ++r) {
        ImGui::TableNextRow();
        for (size_t k = 0; k < std::min(columns, block.rows[r].size()); ++k) {
            ImGui::TableNextColumn();
            ManualText cell = block.rows[r][k];
            for (ManualSpan& span : cell)
                span.bold |= r == 0;
            if (std::string link = flow(frame, cell, ImGui::GetContentRegionAvail().x, frame.ui.fonts.text);
                !link.empty())
                clicked = std::move(link);
        }
    }
    ImGui::EndTable();
    return clicked;
}

void picture(Frame& frame, const ManualBlock& block, float width)
{
    const PictureOnScreen shown = frame.picture ? frame.picture(block.picture) : PictureOnScreen{};
    if (shown.texture) {
        const float wide = std::min(width, float(shown.width) * frame.ui.scale),
                    high = wide * float(shown.height) / float(std::max(1, shown.width));
        ImGui::Image(shown.texture, {wide, high});
    }
    ImGui::PushFont(frame.ui.fonts.small);
    muted(frame, block.plain());
    ImGui::PopFont();
}

/// @returns the file of a link that was clicked, else empty
std::string block_on_screen(Frame& frame, const ManualBlock& block, int number, float width)
{
    const float s = frame.ui.scale, step = 20 * s;
    const Fonts& fonts = frame.ui.fonts;
    switch (block.kind) {
    case ManualBlock::Kind::heading: {
        if (number > 0)
            ImGui::Dummy({0, 8 * s});
        ManualText words = block.text;
        for (ManualSpan& span : words)
            span.bold = block.level > 1;
        return flow(frame, words, width, block.level == 1 ? fonts.heading : fonts.text);
    }
    case ManualBlock::Kind::paragraph:
    case ManualBlock::Kind::item: {
        const float in = step * float(block.level);
        if (in > 0)
            ImGui::Indent(in);
        if (!block.mark.empty()) {
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float wide = ImGui::CalcTextSize(block.mark.c_str()).x;
            ImGui::GetWindowDrawList()->AddText({at.x - wide - 6 * s, at.y}, ImGui::GetColorU32(ImGuiCol_Text),
                                                block.mark.c_str());
        }
        std::string clicked = flow(frame, block.text, width - in, fonts.text);
        if (in > 0)
            ImGui::Unindent(in);
        return clicked;
    }
    case ManualBlock::Kind::table: return table(frame, block, number);
    case ManualBlock::Kind::picture: picture(frame, block, width); break;
    case ManualBlock::Kind::verbatim: muted(frame, block.plain()); break;
    }
    return "";
}

void go_to(ManualWindow& manual, size_t chapter, int block)
{
    manual.chapter = chapter;
    manual.block = block;
    manual.marked = block;
    manual.to_top = block < 0;
}

/// Chapters, or where the words stand that are looked for.
void contents(Frame& frame, ManualWindow& window)
{
    const Manual& manual = *window.manual;
    ImGui::SetNextItemWidth(-1);
    ImGui::PushID(window.openings); // what was typed the last time is gone
    if (window.appears)
        ImGui::SetKeyboardFocusHere();
    text_input("##search", window.searched, false, "Search the manual");
    ImGui::PopID();
    ImGui::BeginChild("contents", {0, 0}, false, ImGuiWindowFlags_NoNavInputs);
    const std::vector<ManualPlace> places = places_of(manual, window.searched);
    if (places.empty()) {
        if (window.searched.size() > 1)
            muted(frame, "Nothing was found.");
        for (size_t k = 0; k < manual.chapters.size(); ++k)
            if (ImGui::Selectable(manual.chapters[k].title.c_str(), k == window.chapter))
                go_to(window, k, -1);
    }
    constexpr size_t most = 60;
    for (size_t k = 0; k < std::min(most, places.size()); ++k) {
        const ManualPlace& place = places[k];
        ImGui::PushID(int(k));
        const bool here = place.chapter == window.chapter && place.block == window.marked;
        // The chapter's name and the words below it are one thing to click on.
        ImFont* const font = frame.ui.fonts.small;
        const float wide = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
        const ImVec2 words = font->CalcTextSizeA(font->FontSize, FLT_MAX, wide, place.excerpt.c_str());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (ImGui::Selectable("##place", here, 0, {0, line + words.y + 3 * frame.ui.scale}))
            go_to(window, place.chapter, place.block);
        ImDrawList* draw = ImGui::GetWindowDrawList();
        draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), manual.chapters[place.chapter].title.c_str());
        draw->AddText(font, font->FontSize, {at.x, at.y + line + frame.ui.scale},
                      ink(palette_of(frame.state.view.dark).muted), place.excerpt.c_str(), nullptr, wide);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

/// By the keys, as far as they are not typed: the text moves up and down, left and right go to the
/// chapter before and after.
void move_by_keys(ManualWindow& window, float line)
{
    if (ImGui::GetIO().WantTextInput || !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows))
        return;
    const float page = ImGui::GetWindowHeight() - 2 * line, now = ImGui::GetScrollY();
    const std::pair<int, float> moves[] = {{GLFW_KEY_DOWN, 3 * line},  {GLFW_KEY_UP, -3 * line},
                                           {GLFW_KEY_PAGE_DOWN, page}, {GLFW_KEY_PAGE_UP, -page},
                                           {GLFW_KEY_HOME, -now},      {GLFW_KEY_END, ImGui::GetScrollMaxY()}};
    for (const auto& [key, by] : moves)
        if (ImGui::IsKeyPressed(key))
            ImGui::SetScrollY(std::clamp(now + by, 0.f, ImGui::GetScrollMaxY()));
    if (ImGui::IsKeyPressed(GLFW_KEY_LEFT) && window.chapter > 0)
        go_to(window, window.chapter - 1, -1);
    if (ImGui::IsKeyPressed(GLFW_KEY_RIGHT) && window.chapter + 1 < window.manual->chapters.size())
        go_to(window, window.chapter + 1, -1);
}

void chapter_on_screen(Frame& frame, ManualWindow& window)
{
    const ManualChapter& chapter = window.manual->chapters[window.chapter];
    const float s = frame.ui.scale;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18 * s, 12 * s});
    ImGui::BeginChild(("chapter " + chapter.file).c_str(), {0, 0}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNavInputs);
    ImGui::PopStyleVar();
    move_by_keys(window, ImGui::GetTextLineHeightWithSpacing());
    if (std::exchange(window.to_top, false))
        ImGui::SetScrollY(0);
    // longer lines are hard to read
    const float width = std::min(ImGui::GetContentRegionAvail().x, 680 * s);
    std::string clicked;
    for (size_t k = 0; k < chapter.blocks.size(); ++k) {
        const ImVec2 from = ImGui::GetCursorScreenPos();
        if (int(k) == window.block) {
            ImGui::SetScrollHereY(0.1f);
            window.block = -1;
        }
        std::string link = block_on_screen(frame, chapter.blocks[k], int(k), width);
        if (!link.empty())
            clicked = std::move(link);
        if (int(k) == window.marked)
            ImGui::GetWindowDrawList()->AddLine({from.x - 8 * s, from.y},
                                                {from.x - 8 * s, ImGui::GetCursorScreenPos().y - 4 * s},
                                                ink(palette_of(frame.state.view.dark).accent), 3 * s);
        ImGui::Dummy({0, 1 * s});
    }
    ImGui::EndChild();
    if (const int to = window.manual->chapter(clicked); to >= 0)
        go_to(window, size_t(to), -1);
}

} // namespace

void open_manual(ManualWindow& window)
{
    window.shown = window.appears = true;
    window.searched.clear();
    window.marked = -1;
    ++window.openings;
}

void manual_window(Frame& frame)
{
    ManualWindow& window = frame.ui.manual;
    if (!window.shown)
        return;
    if (!window.manual && window.problem.empty())
        try {
            window.manual = std::make_shared<const Manual>(read_manual(frame.model.assets() / "manual"));
        } catch (const std::exception& error) {
            window.problem = error.what();
        }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float s = frame.ui.scale;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(960 * s, screen.x - 40), std::min(720 * s, screen.y - 60)}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSizeConstraints({std::min(560 * s, screen.x), std::min(300 * s, screen.y)}, screen);
    if (window.appears)
        ImGui::SetNextWindowFocus();
    if (ImGui::Begin("Manual", &window.shown,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoScrollbar |
                         ImGuiWindowFlags_NoScrollWithMouse)) {
        if (!window.manual || window.manual->chapters.empty())
            coloured(palette_of(frame.state.view.dark).error,
                     window.problem.empty() ? "The manual is empty." : window.problem);
        else if (ImGui::BeginTable("manual", 2, ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable)) {
            ImGui::TableSetupColumn("contents", ImGuiTableColumnFlags_WidthFixed, 240 * s);
            ImGui::TableSetupColumn("chapter", ImGuiTableColumnFlags_WidthStretch);
            ImGui::TableNextColumn();
            contents(frame, window);
            ImGui::TableNextColumn();
            chapter_on_screen(frame, window);
            ImGui::EndTable();
        }
    }
    ImGui::End();
    window.appears = false;
}

} // namespace spia::viewer

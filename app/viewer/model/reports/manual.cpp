#include "app/viewer/model/reports/manual.h"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <md4c.h>
#include <sstream>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

std::string plain_text(const ManualText& text)
{
    std::string all;
    for (const ManualSpan& span : text)
        all += span.text;
    return all;
}

/// What MD4C tells of a chapter, block by block.
class Reader {
public:
    Reader(ManualChapter& chapter, fs::path folder) : chapter_(chapter), folder_(std::move(folder)) {}

    void enter(MD_BLOCKTYPE type, const void* detail)
    {
        switch (type) {
        case MD_BLOCK_H:
            begin(ManualBlock::Kind::heading).level = int(static_cast<const MD_BLOCK_H_DETAIL*>(detail)->level);
            break;
        case MD_BLOCK_P:
            if (!std::exchange(fresh_item_, false)) {
                ManualBlock& block = begin(ManualBlock::Kind::paragraph);
                block.level = int(lists_.size()); // further paragraphs of an item stand as far in
                                                  // as it
            }
            break;
        case MD_BLOCK_UL: lists_.push_back(bullets); break;
        case MD_BLOCK_OL: lists_.push_back(int(static_cast<const MD_BLOCK_OL_DETAIL*>(detail)->start)); break;
        case MD_BLOCK_LI: {
            ManualBlock& block = begin(ManualBlock::Kind::item);
            block.level = int(lists_.size());
            block.mark = lists_.back() == bullets ? "\u2022" : fmt::format("{}.", lists_.back()++);
            fresh_item_ = true;
            break;
        }
        case MD_BLOCK_TABLE: begin(ManualBlock::Kind::table); break;
        case MD_BLOCK_TR: chapter_.blocks.back().rows.emplace_back(); break;
        case MD_BLOCK_TH:
        case MD_BLOCK_TD: text_ = &chapter_.blocks.back().rows.back().emplace_back(); break;
        case MD_BLOCK_CODE: begin(ManualBlock::Kind::verbatim); break;
        default: break;
        }
    }
    void leave(MD_BLOCKTYPE type)
    {
        if (type == MD_BLOCK_UL || type == MD_BLOCK_OL)
            lists_.pop_back();
        if (type == MD_BLOCK_LI)
            fresh_item_ = false;
    }
    void enter(MD_SPANTYPE type, const void* detail)
    {
        if (type == MD_SPAN_STRONG)
            look_.bold = true;
        else if (type == MD_SPAN_CODE)
            look_.code = true;
        else if (type == MD_SPAN_A) {
            const MD_ATTRIBUTE& to = static_cast<const MD_SPAN_A_DETAIL*>(detail)->href;
            look_.link.assign(to.text, to.size);
        } else if (type == MD_SPAN_IMG) {
            const MD_ATTRIBUTE& from = static_cast<const MD_SPAN_IMG_DETAIL*>(detail)->src;
            ManualBlock& block = chapter_.blocks.back();
            block.kind = ManualBlock::Kind::picture;
            block.picture = folder_ / std::string(from.text, from.size);
        }
    }
    void leave(MD_SPANTYPE type)
    {
        if (type == MD_SPAN_STRONG)
            look_.bold = false;
        else if (type == MD_SPAN_CODE)
            look_.code = false;
        else if (type == MD_SPAN_A)
            look_.link.clear();
    }
    void say(MD_TEXTTYPE type, std::string_view text)
    {
        if (!text_)
            return;
        if (type == MD_TEXT_SOFTBR)
            text = " ";
        else if (type == MD_TEXT_BR)
            text = "\n";
        else if (type == MD_TEXT_ENTITY)
            text = text == "&lt;" ? "<" : text == "&gt;" ? ">" : text == "&amp;" ? "&" : text;
        ManualSpan look = look_;
        if (!text_->empty()) {
            look.text = text_->back().text;
            if (text_->back() == look) {
                text_->back().text += text;
                return;
            }
        }
        look.text = text;
        text_->push_back(std::move(look));
    }

private:
    static constexpr int bullets = -1;

    ManualBlock& begin(ManualBlock::Kind kind)
    {
        ManualBlock& block = chapter_.blocks.emplace_back();
        block.kind = kind;
        text_ = &block.text;
        return block;
    }

    ManualChapter& chapter_;
    fs::path folder_;
    std::vector<int> lists_; ///< the next number of each that is open
    ManualText* text_ = nullptr;
    ManualSpan look_;
    bool fresh_item_ = false; ///< its first paragraph is its own text
};

std::string content(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(fmt::format("{} of the manual cannot be read", file.string()));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Some words to either side of a place in a text, whole ones.
std::string around(const std::string& text, size_t at)
{
    constexpr size_t before = 30, behind = 60;
    size_t from = at > before ? at - before : 0, to = std::min(text.size(), at + behind);
    while (from > 0 && text[from - 1] != ' ')
        --from;
    while (to < text.size() && text[to] != ' ')
        ++to;
    return (from > 0 ? "... " : "") + text.substr(from, to - from) + (to < text.size() ? " ..." : "");
}

} // namespace

std::string ManualBlock::plain() const
{
    std::string all = plain_text(text);
    for (const auto& row : rows)
        for (const ManualText& cell : row)
            all += (all.empty() ? "" : " ") + plain_text(cell);
    return all;
}

int Manual::chapter(std::string_view file) const
{
    for (size_t k = 0; k < chapters.size(); ++k)
        if (chapters[k].file == file)
            return int(k);
    return -1;
}

ManualChapter manual_chapter(std::string_view markdown, const std::string& file, const fs::path& folder)
{
    ManualChapter chapter;
    chapter.file = file;
    Reader reader(chapter, folder);
    MD_PARSER parser{};
    parser.flags = MD_FLAG_TABLES | MD_FLAG_NOHTML;
    parser.enter_block = [](MD_BLOCKTYPE type, void* detail, void* to) {
        static_cast<Reader*>(to)->enter(type, detail);
        return 0;
    };
    parser.leave_block = [](MD_BLOCKTYPE type, void*, void* to) {
        static_cast<Reader*>(to)->leave(type);
        return 0;
    };
    parser.enter_span = [](MD_SPANTYPE type, void* detail, void* to) {
        static_cast<Reader*>(to)->enter(type, detail);
        return 0;
    };
    parser.leave_span = [](MD_SPANTYPE type, void*, void* to) {
        static_cast<Reader*>(to)->leave(type);
        return 0;
    };
    parser.text = [](MD_TEXTTYPE type, const MD_CHAR* text, MD_SIZE size, void* to) {
        static_cast<Reader*>(to)->say(type, {text, size});
        return 0;
    };
    if (md_parse(markdown.data(), MD_SIZE(markdown.size()), &parser, &reader) != 0)
        throw InputError(fmt::format("{} of the manual is no Markdown", file));
    if (chapter.blocks.empty() || chapter.blocks.front().kind != ManualBlock::Kind::heading)
        throw InputError(fmt::format("{} of the manual does not begin with a heading", file));
    chapter.title = chapter.blocks.front().plain();
    return chapter;
}

Manual read_manual(const fs::path& folder)
{
    Manual manual;
    std::istringstream contents(content(folder / "contents.txt"));
    for (std::string file; std::getline(contents, file);)
        if (!file.empty())
            manual.chapters.push_back(manual_chapter(content(folder / file), file, folder));
    return manual;
}

std::vector<ManualPlace> places_of(const Manual& manual, std::string_view words)
{
    std::vector<std::string> wanted;
    std::istringstream each(lower_case(words));
    for (std::string word; each >> word;)
        wanted.push_back(word);
    constexpr size_t least = 2;
    if (std::none_of(wanted.begin(), wanted.end(), [](const std::string& word) { return word.size() >= least; }))
        return {};
    std::vector<ManualPlace> headings, others;
    for (size_t c = 0; c < manual.chapters.size(); ++c)
        for (size_t b = 0; b < manual.chapters[c].blocks.size(); ++b) {
            const ManualBlock& block = manual.chapters[c].blocks[b];
            const std::string text = block.plain(), searched = lower_case(text);
            if (!std::all_of(wanted.begin(), wanted.end(),
                             [&](const std::string& word) { return searched.find(word) != std::string::npos; }))
                continue;
            auto& places = block.kind == ManualBlock::Kind::heading ? headings : others;
            places.push_back({c, int(b), around(text, searched.find(wanted.front()))});
        }
    headings.insert(headings.end(), others.begin(), others.end());
    return headings;
}

} // namespace spia::viewer

#include "engine/part/cad_tree.h"

#include <algorithm>
#include <charconv>
#include <fmt/core.h>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/read_number.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

/// "7" or "10-19"; nothing if the text is something else.
std::optional<std::pair<int, int>> range_of(std::string_view text)
{
    int from = -1, to = -1;
    const char* end = text.data() + text.size();
    auto read = std::from_chars(text.data(), end, from);
    if (read.ec != std::errc() || from < 0)
        return {};
    to = from;
    if (read.ptr != end && *read.ptr == '-')
        read = std::from_chars(read.ptr + 1, end, to);
    if (read.ptr != end || read.ec != std::errc() || to < from)
        return {};
    return std::pair(from, to);
}

std::string choices(const CadTree& tree)
{
    const int faces = int(tree.body_of.size());
    return fmt::format("choose faces by numbers from 0 to {}{}{}", faces - 1,
                       faces > 1 ? fmt::format(" or a range like 0-{}", faces - 1) : "",
                       tree.item.empty() ? "" : ", or what the file holds, by its name too:\n" + item_list(tree));
}

/// The item that is meant.
/// @throws InputError  none is, or several are
int find_item(const CadTree& tree, std::string_view wanted)
{
    const auto at = [&](const auto& meant) {
        std::vector<int> found;
        for (size_t i = 0; i < tree.item.size(); ++i)
            if (meant(tree.item[i]))
                found.push_back(int(i));
        return found;
    };
    std::vector<int> found = at([&](const CadItem& item) { return same_letters(choice(item), wanted); });
    if (found.empty())
        found = at([&](const CadItem& item) { return !item.name.empty() && item.name == wanted; });
    if (found.empty())
        found = at([&](const CadItem& item) { return !item.name.empty() && same_letters(item.name, wanted); });
    if (found.empty())
        throw InputError(fmt::format("'{}' is not in the file; {}", wanted, choices(tree)));
    if (found.size() > 1)
        throw InputError(fmt::format("'{}' is the name of {} things in the file, of {} and {} among them; {}", wanted,
                                     found.size(), choice(tree.item[size_t(found[0])]),
                                     choice(tree.item[size_t(found[1])]), choices(tree)));
    return found.front();
}

} // namespace

std::string_view name(CadItem::Kind kind)
{
    switch (kind) {
    case CadItem::Kind::assembly: return "assembly";
    case CadItem::Kind::solid: return "solid";
    case CadItem::Kind::sheet_body: return "sheet body";
    case CadItem::Kind::loose_faces: return "loose faces";
    }
    return "";
}

bool CadTree::within(int i, int holder) const
{
    while (i >= 0 && i != holder)
        i = item[size_t(i)].parent;
    return i >= 0;
}

int CadTree::bodies() const
{
    return int(std::count_if(item.begin(), item.end(),
                             [](const CadItem& each) { return each.kind != CadItem::Kind::assembly; }));
}

std::string choice(const CadItem& item)
{
    return fmt::format("{}:{}", item.kind == CadItem::Kind::assembly ? "assembly" : "body", item.number);
}

std::vector<int> chosen_faces(const CadTree& tree, std::span<const std::string> wanted)
{
    std::vector<char> chosen(tree.body_of.size(), wanted.empty());
    for (const std::string& each : wanted) {
        const std::string_view text = trimmed(each);
        if (const auto range = range_of(text)) {
            if (size_t(range->second) >= chosen.size())
                throw InputError(fmt::format("the file has no face {}; {}", range->second, choices(tree)));
            std::fill(chosen.begin() + range->first, chosen.begin() + range->second + 1, 1);
            continue;
        }
        const int item = find_item(tree, text);
        for (size_t f = 0; f < chosen.size(); ++f)
            chosen[f] |= tree.within(tree.body_of[f], item);
    }
    std::vector<int> faces;
    for (size_t f = 0; f < chosen.size(); ++f)
        if (chosen[f])
            faces.push_back(int(f));
    return faces;
}

std::string describe(const CadTree& tree, int item)
{
    const CadItem& each = tree.item[size_t(item)];
    int depth = 0;
    for (int holder = each.parent; holder >= 0; holder = tree.item[size_t(holder)].parent)
        ++depth;
    return fmt::format("{:<12} {:<28} {:>6} {}, {}", choice(each), std::string(2 * size_t(depth), ' ') + each.name,
                       each.faces, each.faces == 1 ? "face" : "faces", name(each.kind));
}

std::string item_list(const CadTree& tree)
{
    constexpr size_t most = 40;
    std::string text;
    for (size_t i = 0; i < std::min(most, tree.item.size()); ++i)
        text += (i > 0 ? "\n  " : "  ") + describe(tree, int(i));
    if (tree.item.size() > most)
        text += fmt::format("\n  and {} more (`spia info` lists them all)", tree.item.size() - most);
    return text;
}

} // namespace spia

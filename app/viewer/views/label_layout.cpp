#include "app/viewer/views/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace spia::viewer {
namespace {

bool in_view(glm::dvec2 place, glm::dvec2 view)
{
    // false where it is no number
    return place.x >= 0 && place.y >= 0 && place.x <= view.x && place.y <= view.y;
}

/// The middles a label may have, the best first; those from `pushed` on need a line to their place.
struct Middles {
    std::vector<glm::dvec2> middle;
    size_t pushed;
};

Middles middles_for(const LabelWish& wish, double scale)
{
    Middles result;
    const double gap = 8 * scale, x = gap + wish.size.x / 2, y = gap + wish.size.y / 2;
    if (wish.kind == LabelKind::region)
        result.middle.push_back(wish.place);
    else
        for (const glm::dvec2 way : {glm::dvec2(x, -gap), {-x, -gap}, {x, gap}, {-x, gap}, {0, -y}, {0, y}})
            result.middle.push_back(wish.place + way);
    result.pushed = result.middle.size();
    constexpr int ways = 16, circles = 7;
    for (int circle = 1; circle <= circles; ++circle)
        for (int way = 0; way < ways; ++way) { // from the upper right, to both sides
            const double turn = (way % 2 ? -1 : 1) * ((way + 1) / 2) * 2 * std::numbers::pi / ways;
            const double angle = std::numbers::pi / 4 + turn, out = 20 * scale * circle;
            result.middle.push_back(wish.place + glm::dvec2((x + out) * std::cos(angle), -(y + out) * std::sin(angle)));
        }
    return result;
}

} // namespace

PixelBox around(glm::dvec2 middle, glm::dvec2 size) { return {middle - 0.5 * size, middle + 0.5 * size}; }
PixelBox grown(PixelBox box, double by) { return {box.least - by, box.greatest + by}; }

bool inside(const PixelBox& box, glm::dvec2 view)
{
    return box.least.x >= 0 && box.least.y >= 0 && box.greatest.x <= view.x && box.greatest.y <= view.y;
}

bool meet(const PixelBox& a, const PixelBox& b)
{
    return a.least.x < b.greatest.x && b.least.x < a.greatest.x && a.least.y < b.greatest.y && b.least.y < a.greatest.y;
}

bool meets_any(const PixelBox& box, const std::vector<PixelBox>& others)
{
    return std::any_of(others.begin(), others.end(), [&](const PixelBox& other) { return meet(box, other); });
}

std::vector<PlacedLabel> place_labels(const std::vector<LabelWish>& wishes, glm::dvec2 view,
                                      const std::vector<PixelBox>& taken, double scale)
{
    constexpr double edge = 5; // pixels that stay free at the border of the view, for the outline
                               // of the letters too
    std::vector<PixelBox> full = taken;
    for (const LabelWish& wish : wishes)
        if (wish.kind != LabelKind::region && in_view(wish.place, view))
            full.push_back(around(wish.place, glm::dvec2(13 * scale))); // the dots stay in sight
    std::vector<size_t> order(wishes.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return wishes[a].kind < wishes[b].kind; });
    std::vector<PlacedLabel> placed;
    for (const size_t i : order) {
        if (!in_view(wishes[i].place, view))
            continue;
        const Middles choice = middles_for(wishes[i], scale);
        for (size_t k = 0; k < choice.middle.size(); ++k) {
            const PixelBox box = around(choice.middle[k], wishes[i].size);
            if (!inside(grown(box, edge * scale), view) || meets_any(grown(box, scale), full))
                continue;
            placed.push_back({i, box, k >= choice.pushed});
            full.push_back(box);
            break;
        }
    }
    std::sort(placed.begin(), placed.end(), [](const PlacedLabel& a, const PlacedLabel& b) { return a.wish < b.wish; });
    return placed;
}

} // namespace spia::viewer

#include "engine/layout/chords.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace spia {

Chords chords_of(const Layout& layout)
{
    const size_t n = layout.curve.size();
    std::vector<int> parent(n);
    std::vector<char> flip(n, 0), twisted(n, 0);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int c) { // and whether c runs against it
        char against = 0;
        while (parent[size_t(c)] != c) {
            against = char(against ^ flip[size_t(c)]);
            c = parent[size_t(c)];
        }
        return std::pair(c, against);
    };
    for (const LayoutPatch& patch : layout.patch)
        for (const size_t k : {size_t(0), size_t(1)}) {
            // Sides k and k + 2 run against each other around the patch.
            const CurveUse a = patch[k], b = patch[k + 2];
            const char against = char(!(a.reversed ^ b.reversed));
            const auto [p, p_against] = root(a.curve);
            const auto [q, q_against] = root(b.curve);
            const char total = char(against ^ p_against ^ q_against);
            if (p == q)
                twisted[size_t(p)] = char(twisted[size_t(p)] | total);
            else {
                const int low = std::min(p, q), high = std::max(p, q);
                parent[size_t(high)] = low;
                flip[size_t(high)] = total;
                twisted[size_t(low)] = char(twisted[size_t(low)] | twisted[size_t(high)]);
            }
        }
    Chords chords;
    std::map<int, int> number;
    for (size_t c = 0; c < n; ++c) {
        const auto [r, against] = root(int(c));
        const auto [place, fresh] = number.emplace(r, chords.strips);
        if (fresh) {
            ++chords.strips;
            chords.symmetrical.push_back(twisted[size_t(r)]);
        }
        chords.strip.push_back(place->second);
        chords.against.push_back(against);
    }
    return chords;
}

} // namespace spia

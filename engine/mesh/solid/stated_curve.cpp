#include "engine/mesh/solid/stated_curve.h"

#include <algorithm>

namespace spia {

int StatedCurves::of(int a, int b) const
{
    const std::array<int, 3> wanted{std::min(a, b), std::max(a, b), 0};
    const auto found = std::lower_bound(chord.begin(), chord.end(), wanted);
    return found != chord.end() && (*found)[0] == wanted[0] && (*found)[1] == wanted[1] ? (*found)[2] : -1;
}

void StatedCurves::renumber(const std::vector<int>& number)
{
    for (auto& [a, b, c] : chord) {
        const int one = number[size_t(a)], other = number[size_t(b)];
        a = std::min(one, other);
        b = std::max(one, other);
    }
    std::sort(chord.begin(), chord.end());
}

} // namespace spia

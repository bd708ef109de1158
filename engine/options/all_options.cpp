#include "engine/options/all_options.h"

#include <vector>

#include "engine/options/advice.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"

namespace spia {

std::span<const Option* const> all_options()
{
    static const std::vector<const Option*> all = [] {
        std::vector<const Option*> together;
        for (const std::span<const Option* const> some :
             {std::span<const Option* const>(option::of_parts), std::span<const Option* const>(option::of_sheets),
              std::span<const Option* const>(option::of_surfaces)})
            together.insert(together.end(), some.begin(), some.end());
        return together;
    }();
    return all;
}

std::span<const Advice* const> all_advice() { return advice::of_targets; }

} // namespace spia

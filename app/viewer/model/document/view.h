#pragma once
#include <string_view>

namespace spia::viewer {

/// The four pictures of the window.
enum class View { part, blank, quads, surface };
inline constexpr View all_views[] = {View::part, View::blank, View::quads, View::surface};
std::string_view name(View view); ///< "part", ...

} // namespace spia::viewer

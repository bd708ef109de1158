#pragma once
#include "engine/options/option.h"

/// For the target of a step of unfolding.
namespace spia::advice {

inline constexpr Advice other_carriers{.name = "other-carriers",
                                       .on_command_line = "pick others that stay, or give it a target",
                                       .in_window =
                                           "select fixed faces and press \"Fit to selection\", or choose a target"};
inline constexpr Advice closer_carriers{.name = "closer-carriers",
                                        .on_command_line = "pick others, allow more or give a target",
                                        .in_window = "pick others, or allow more with \"Within\""};
inline constexpr Advice smooth_carriers{.name = "smooth-carriers",
                                        .on_command_line = "pick those that carry the target, or give one",
                                        .in_window = "choose another fixed region"};
inline constexpr Advice common_edge{
    .name = "common-edge",
    .on_command_line = "give a target that goes through their common edge",
    .in_window = "remove its offset, or choose a fixed region whose surface goes through their common edge"};

/// All of this file.
inline constexpr const Advice* of_targets[] = {&other_carriers, &closer_carriers, &smooth_carriers, &common_edge};

} // namespace spia::advice

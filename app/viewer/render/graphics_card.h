#pragma once
#include <string>

namespace spia::viewer {

/// What draws, as the driver calls it. Needs the context of OpenGL.
struct GraphicsCard {
    std::string renderer; ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string opengl;   ///< version
};
GraphicsCard graphics_card();

} // namespace spia::viewer

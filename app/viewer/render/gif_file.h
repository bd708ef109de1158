#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/viewer/render/renderer.h"

struct GifFileType;

namespace spia::viewer {

/// At most 256 colours for pictures that have more, by median cut.
/// [P. Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982]
class GifColours {
public:
    /// @param samples  pictures whose colours are to be met, one at least
    explicit GifColours(const std::vector<Picture>& samples);

    const std::vector<std::array<uint8_t, 3>>& colours() const { return colours_; }
    /// The nearest colour of every pixel, row by row from the top.
    std::vector<uint8_t> raster(const Picture& picture);

private:
    std::vector<std::array<uint8_t, 3>> colours_;
    std::vector<int16_t> nearest_; ///< by the upper six bits of red, green and blue; -1: not looked
                                   ///< for yet
};

/// An animation in memory that repeats for ever.
class GifWriter {
public:
    /// @throws ExchangeError
    GifWriter(int width, int height, const GifColours& colours);
    ~GifWriter();
    GifWriter(const GifWriter&) = delete;
    GifWriter& operator=(const GifWriter&) = delete;

    /// The next picture; only what differs from the one before is stored.
    /// @param hundredths  of a second, until the next one. @throws ExchangeError
    void add(const std::vector<uint8_t>& raster, int hundredths);
    /// The bytes of the file; nothing can be added then. @throws ExchangeError
    std::string end();

private:
    int width_, height_;
    std::string bytes_;
    std::vector<uint8_t> before_; ///< the last raster
    GifFileType* file_ = nullptr;
};

/// How long each of so many pictures is shown, in hundredths of a second, so that all together take
/// the time; 2 at least, which is the shortest that programs keep to.
std::vector<int> gif_delays(int pictures, double seconds);

} // namespace spia::viewer

#include "app/viewer/render/gif_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gif_lib.h>
#include <memory>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace spia::viewer {
namespace {

constexpr int bits = 6, levels = 1 << bits; // of each of the three colours while they are counted
constexpr size_t most_colours = 256;

int bin_of(const uint8_t* rgb)
{
    constexpr int drop = 8 - bits;
    return (rgb[0] >> drop << (2 * bits)) | (rgb[1] >> drop << bits) | (rgb[2] >> drop);
}

/// Colours of the samples that are alike, and how many pixels have them.
struct Counted {
    std::array<double, 3> mean{};
    double pixels = 0;
};

/// Part of them; it is cut in two where it is longest.
struct Box {
    std::vector<Counted> all;
    int axis = 0;
    double badness = 0; ///< what cutting it gains

    explicit Box(std::vector<Counted> colours) : all(std::move(colours))
    {
        double pixels = 0;
        for (const Counted& each : all)
            pixels += each.pixels;
        for (int c = 0; c < 3; ++c) {
            const auto [low, high] =
                std::minmax_element(all.begin(), all.end(), [&](const Counted& a, const Counted& b) {
                    return a.mean[size_t(c)] < b.mean[size_t(c)];
                });
            const double length = high->mean[size_t(c)] - low->mean[size_t(c)];
            // The root of the pixels: a small thing in a colour of its own is to be seen, too.
            if (const double gain = length * std::sqrt(pixels); gain > badness)
                badness = gain, axis = c;
        }
    }
    std::array<uint8_t, 3> mean() const
    {
        double pixels = 0;
        std::array<double, 3> sum{};
        for (const Counted& each : all) {
            pixels += each.pixels;
            for (size_t c = 0; c < 3; ++c)
                sum[c] += each.pixels * each.mean[c];
        }
        std::array<uint8_t, 3> result{};
        for (size_t c = 0; c < 3; ++c)
            result[c] = uint8_t(std::lround(sum[c] / pixels));
        return result;
    }
    std::pair<Box, Box> cut()
    {
        const size_t c = size_t(axis);
        std::sort(all.begin(), all.end(), [&](const Counted& a, const Counted& b) { return a.mean[c] < b.mean[c]; });
        double whole = 0, below = 0;
        for (const Counted& each : all)
            whole += each.pixels;
        size_t at = 0;
        while (at + 1 < all.size() && (at == 0 || below + all[at].pixels < whole / 2))
            below += all[at++].pixels;
        return {Box({all.begin(), all.begin() + long(at)}), Box({all.begin() + long(at), all.end()})};
    }
};

std::vector<Counted> counted(const std::vector<Picture>& samples)
{
    std::vector<Counted> bins(size_t(levels) * levels * levels);
    for (const Picture& picture : samples)
        for (size_t k = 0; k + 3 < picture.rgba.size(); k += 4) {
            Counted& bin = bins[size_t(bin_of(&picture.rgba[k]))];
            for (size_t c = 0; c < 3; ++c)
                bin.mean[c] += picture.rgba[k + c];
            ++bin.pixels;
        }
    std::erase_if(bins, [](const Counted& bin) { return bin.pixels == 0; });
    for (Counted& bin : bins)
        for (double& sum : bin.mean)
            sum /= bin.pixels;
    return bins;
}

[[noreturn]] void fail(int error)
{
    const char* why = GifErrorString(error);
    throw ExchangeError(fmt::format("the animation could not be made: {}", why ? why : "unknown reason"));
}

} // namespace

GifColours::GifColours(const std::vector<Picture>& samples) : nearest_(size_t(levels) * levels * levels, -1)
{
    std::vector<Box> boxes{Box(counted(samples))};
    while (boxes.size() < most_colours) {
        const auto worst = std::max_element(boxes.begin(), boxes.end(),
                                            [](const Box& a, const Box& b) { return a.badness < b.badness; });
        if (!(worst->badness > 0) || worst->all.size() < 2)
            break;
        auto [low, high] = worst->cut();
        *worst = std::move(low);
        boxes.push_back(std::move(high));
    }
    for (const Box& box : boxes)
        colours_.push_back(box.mean());
}

std::vector<uint8_t> GifColours::raster(const Picture& picture)
{
    std::vector<uint8_t> result(size_t(picture.width) * size_t(picture.height));
    for (size_t k = 0; k < result.size(); ++k) {
        const uint8_t* rgb = &picture.rgba[4 * k];
        int16_t& near = nearest_[size_t(bin_of(rgb))];
        if (near < 0) {
            int least = 1 << 30;
            for (size_t i = 0; i < colours_.size(); ++i) {
                int away = 0;
                for (size_t c = 0; c < 3; ++c) {
                    const int d = int(rgb[c]) - int(colours_[i][c]);
                    away += d * d;
                }
                if (away < least)
                    least = away, near = int16_t(i);
            }
        }
        result[k] = uint8_t(near);
    }
    return result;
}

GifWriter::GifWriter(int width, int height, const GifColours& colours) : width_(width), height_(height)
{
    int error = 0;
    file_ = EGifOpen(
        &bytes_,
        [](GifFileType* gif, const GifByteType* from, int size) {
            static_cast<std::string*>(gif->UserData)->append(reinterpret_cast<const char*>(from), size_t(size));
            return size;
        },
        &error);
    if (!file_)
        fail(error);
    int size = 2; // a power of two, as the format has it
    while (size_t(size) < colours.colours().size())
        size *= 2;
    std::vector<GifColorType> table(size_t(size), GifColorType{0, 0, 0});
    for (size_t k = 0; k < colours.colours().size(); ++k)
        table[k] = {colours.colours()[k][0], colours.colours()[k][1], colours.colours()[k][2]};
    const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> map(GifMakeMapObject(size, table.data()),
                                                                           GifFreeMapObject);
    EGifSetGifVersion(file_, true);
    constexpr unsigned char for_ever[] = {1, 0, 0};
    if (EGifPutScreenDesc(file_, width, height, 8, 0, map.get()) == GIF_ERROR ||
        EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE) == GIF_ERROR ||
        EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0") == GIF_ERROR ||
        EGifPutExtensionBlock(file_, 3, for_ever) == GIF_ERROR || EGifPutExtensionTrailer(file_) == GIF_ERROR)
        fail(file_->Error);
}

GifWriter::~GifWriter()
{
    if (file_)
        EGifCloseFile(file_, nullptr);
}

void GifWriter::add(const std::vector<uint8_t>& raster, int hundredths)
{
    int left = 0, top = 0, right = width_, bottom = height_; // of what differs
    if (!before_.empty()) {
        const auto row_differs = [&](int y) {
            const auto from = long(y) * width_;
            return !std::equal(raster.begin() + from, raster.begin() + from + width_, before_.begin() + from);
        };
        const auto column_differs = [&](int x) {
            for (int y = top; y < bottom; ++y)
                if (raster[size_t(y) * size_t(width_) + size_t(x)] != before_[size_t(y) * size_t(width_) + size_t(x)])
                    return true;
            return false;
        };
        while (top + 1 < bottom && !row_differs(top))
            ++top;
        while (bottom - 1 > top && !row_differs(bottom - 1))
            --bottom;
        while (left + 1 < right && !column_differs(left))
            ++left;
        while (right - 1 > left && !column_differs(right - 1))
            --right;
    }
    const GraphicsControlBlock control{.DisposalMode = DISPOSE_DO_NOT,
                                       .UserInputFlag = false,
                                       .DelayTime = hundredths,
                                       .TransparentColor = NO_TRANSPARENT_COLOR};
    GifByteType extension[4];
    EGifGCBToExtension(&control, extension);
    if (EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, sizeof extension, extension) == GIF_ERROR ||
        EGifPutImageDesc(file_, left, top, right - left, bottom - top, false, nullptr) == GIF_ERROR)
        fail(file_->Error);
    std::vector<GifPixelType> line(size_t(right - left));
    for (int y = top; y < bottom; ++y) {
        const auto from = raster.begin() + long(y) * width_;
        std::copy(from + left, from + right, line.begin());
        if (EGifPutLine(file_, line.data(), int(line.size())) == GIF_ERROR)
            fail(file_->Error);
    }
    before_ = raster;
}

std::string GifWriter::end()
{
    int error = 0;
    if (EGifCloseFile(std::exchange(file_, nullptr), &error) == GIF_ERROR)
        fail(error);
    return std::move(bytes_);
}

std::vector<int> gif_delays(int pictures, double seconds)
{
    constexpr int shortest = 2;
    std::vector<int> delays;
    double shown = 0; // hundredths so far
    for (int k = 0; k < pictures; ++k) {
        const int delay = std::max(shortest, int(std::lround(100 * seconds * (k + 1) / pictures - shown)));
        delays.push_back(delay);
        shown += delay;
    }
    return delays;
}

} // namespace spia::viewer

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

/// Compares a picture of the window with a reference of half its size:
///
///     compare_pictures PICTURE REFERENCE DIFFERENCE LIMIT [X Y WIDTH HEIGHT]
///     compare_pictures PICTURE REFERENCE
///
/// The first ends with code 1 if more than LIMIT (a share) of the pixels differ, but for those of a
/// rectangle; the second makes the reference.
///
/// Each pixel of a reference is the mean of 2 x 2: smooth edges that fall a little otherwise are no
/// difference, and the file is small. A pixel differs if one of its channels is off by more than 24
/// of 255.
namespace {

struct Rgb {
    int width = 0, height = 0;
    std::vector<uint8_t> value; ///< 3 per pixel, row by row from above
};

std::optional<Rgb> read(const char* file)
{
    Rgb picture;
    int channels = 0;
    const std::unique_ptr<uint8_t, decltype(&free)> pixels(
        stbi_load(file, &picture.width, &picture.height, &channels, 3), free);
    if (!pixels) {
        fmt::print(stderr, "{} cannot be read: {}\n", file, stbi_failure_reason());
        return std::nullopt;
    }
    picture.value.assign(pixels.get(), pixels.get() + size_t(picture.width) * size_t(picture.height) * 3);
    return picture;
}

bool write(const char* file, const Rgb& picture)
{
    stbi_write_png_compression_level = 12;
    if (stbi_write_png(file, picture.width, picture.height, 3, picture.value.data(), 3 * picture.width))
        return true;
    fmt::print(stderr, "{} cannot be written\n", file);
    return false;
}

/// Of the picture; its pixels are not looked at.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
    bool holds(int px, int py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

/// The mean of 2 x 2 pixels each; an odd last row or column is left out.
Rgb halved(const Rgb& picture)
{
    Rgb half{picture.width / 2, picture.height / 2, {}};
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int dx, int dy) {
                    return int(picture.value[size_t(((2 * y + dy) * picture.width + 2 * x + dx) * 3 + c)]);
                };
                half.value.push_back(uint8_t((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4));
            }
    return half;
}

/// Where they differ is red over a pale copy of the reference; says how much and where most.
double share_of_difference(const Rgb& is, const Rgb& reference, const Rectangle& except, Rgb& shown, std::string& where)
{
    constexpr int tolerance = 24, tiles = 6;
    std::array<int, tiles * tiles> in_tile{};
    size_t count = 0;
    shown = reference;
    for (int y = 0; y < is.height; ++y)
        for (int x = 0; x < is.width; ++x) {
            const size_t at = size_t(y * is.width + x) * 3;
            int most = 0;
            for (size_t c = at; c < at + 3; ++c) {
                most = std::max(most, std::abs(is.value[c] - reference.value[c]));
                shown.value[c] = uint8_t(170 + reference.value[c] / 3);
            }
            if (most <= tolerance || except.holds(2 * x, 2 * y))
                continue;
            shown.value[at] = 220;
            shown.value[at + 1] = shown.value[at + 2] = 0;
            ++in_tile[size_t(y * tiles / is.height * tiles + x * tiles / is.width)];
            ++count;
        }
    const int worst = int(std::max_element(in_tile.begin(), in_tile.end()) - in_tile.begin());
    where = fmt::format("most of it around x = {}, y = {} of {} x {}", (2 * (worst % tiles) + 1) * is.width / tiles,
                        (2 * (worst / tiles) + 1) * is.height / tiles, 2 * is.width, 2 * is.height);
    return double(count) / double(is.width * is.height);
}

} // namespace

int main(int count, char** values)
{
    if (count != 3 && count != 5 && count != 9) {
        fmt::print(stderr, "compare_pictures PICTURE REFERENCE [DIFFERENCE LIMIT [X Y WIDTH HEIGHT]]\n");
        return 2;
    }
    const auto picture = read(values[1]);
    if (!picture)
        return 2;
    const Rgb is = halved(*picture);
    if (count == 3)
        return write(values[2], is) ? 0 : 2;
    const auto reference = read(values[2]);
    if (!reference)
        return 2;
    if (is.width != reference->width || is.height != reference->height) {
        fmt::print(stderr, "{} has another size than {}\n", values[1], values[2]);
        return 1;
    }
    Rectangle except;
    if (count == 9)
        except = {std::atoi(values[5]), std::atoi(values[6]), std::atoi(values[7]), std::atoi(values[8])};
    Rgb shown;
    std::string where;
    const double limit = std::atof(values[4]), share = share_of_difference(is, *reference, except, shown, where);
    fmt::print("{}: {:.3f} % of the pixels differ, {:.3f} % may\n", values[1], 100 * share, 100 * limit);
    if (share <= limit)
        return 0;
    write(values[3], shown);
    fmt::print("{}; see {}\n", where, values[3]);
    return 1;
}

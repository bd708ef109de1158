#include "engine/picture/canvas.h"

#include <cmath>
#include <limits>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "engine/core/error.h"
#include "engine/picture/stroke_font.h"

namespace spia {

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), colour_(size_t(width * height * fine * fine), Eigen::Vector3f::Ones()),
      depth_(colour_.size(), -std::numeric_limits<float>::infinity())
{
}

void Canvas::blend(size_t at, const Eigen::Vector3d& colour, double opacity)
{
    colour_[at] += float(opacity) * (colour.cast<float>() - colour_[at]);
}

void Canvas::line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Pen& pen)
{
    const Eigen::Vector2d p = a.head<2>() * fine, along = (b - a).head<2>() * fine;
    const double half = pen.width * fine / 2, length_2 = along.squaredNorm();
    const Eigen::Vector2d low = p.cwiseMin(p + along).array() - half - 1,
                          high = p.cwiseMax(p + along).array() + half + 1;
    const int left = std::max(0, int(low.x())), right = std::min(width_ * fine - 1, int(high.x()));
    const int top = std::max(0, int(low.y())), bottom = std::min(height_ * fine - 1, int(high.y()));
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const Eigen::Vector2d q = Eigen::Vector2d(x + 0.5, y + 0.5) - p;
            const double t = length_2 > 0 ? std::clamp(q.dot(along) / length_2, 0.0, 1.0) : 0;
            const double covered = std::clamp(half + 0.5 - (q - t * along).norm(), 0.0, 1.0);
            const double depth = a.z() + t * (b.z() - a.z()) + pen.lift;
            if (covered > 0 && !(pen.hidden && depth < depth_[sample(x, y)]))
                blend(sample(x, y), pen.colour, covered * pen.opacity);
        }
}

void Canvas::rectangle(double left, double top, double right, double bottom, const Eigen::Vector3d& colour)
{
    for (int y = int(top * fine); y < int(bottom * fine); ++y)
        for (int x = int(left * fine); x < int(right * fine); ++x)
            blend(sample(x, y), colour, 1);
}

void Canvas::text(std::string_view words, double x, double y, double height, const Eigen::Vector3d& colour, Align align)
{
    const double unit = height / stroke_font::capital_height, width = unit * stroke_font::width(words);
    const double start = align == Align::left ? x : align == Align::centre ? x - width / 2 : x - width;
    const Pen pen{.colour = colour, .width = 0.14 * height, .hidden = false};
    for (const auto& [from, to] : stroke_font::segments(words))
        line({start + unit * from.x(), y - unit * from.y(), 0}, {start + unit * to.x(), y - unit * to.y(), 0}, pen);
}

std::string Canvas::png() const
{
    std::vector<unsigned char> bytes;
    bytes.reserve(size_t(width_ * height_ * 3));
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            for (int dy = 0; dy < fine; ++dy)
                for (int dx = 0; dx < fine; ++dx)
                    sum += colour_[sample(x * fine + dx, y * fine + dy)];
            for (int k = 0; k < 3; ++k)
                bytes.push_back(
                    static_cast<unsigned char>(std::lround(255 * std::clamp(sum[k] / (fine * fine), 0.f, 1.f))));
        }
    std::string result;
    const auto append = [](void* to, void* from, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(from), size_t(size));
    };
    if (!stbi_write_png_to_func(append, &result, width_, height_, 3, bytes.data(), 3 * width_))
        throw ExchangeError("the picture could not be compressed; memory may be short");
    return result;
}

} // namespace spia

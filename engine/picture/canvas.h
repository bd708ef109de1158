#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace spia {

/// A white picture with a depth per pixel. x runs right, y down, both in pixels from the upper left
/// corner; of two points on a pixel the one of greater depth is seen. Colours are sRGB, 0..1. Drawn
/// twice as fine as it is shown.
class Canvas {
public:
    Canvas(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// @param corner columns x, y, depth; @param colour of the barycentric coordinates of a pixel
    /// in the triangle
    template <class Colour> void triangle(const Eigen::Matrix3d& corner, const Colour& colour);

    struct Pen {
        Eigen::Vector3d colour{0, 0, 0};
        double width = 1; ///< pixels
        double opacity = 1;
        bool hidden = true; ///< nearer triangles cover it
        double lift = 0;    ///< towards the viewer, so that a line on a surface is not half covered
                            ///< by it
    };
    /// With round ends; from a to a it is a dot. a, b: x, y, depth
    void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Pen& pen);

    void rectangle(double left, double top, double right, double bottom, const Eigen::Vector3d& colour);

    enum class Align { left, centre, right };
    /// @param height of a capital in pixels; x, y: where the base line is, at the side named by
    /// align. Characters that the stroke font does not have are left blank.
    void text(std::string_view words, double x, double y, double height, const Eigen::Vector3d& colour,
              Align align = Align::left);

    /// @throws ExchangeError if it cannot be compressed
    std::string png() const;

private:
    static constexpr int fine = 2; ///< samples per pixel in each direction
    size_t sample(int x, int y) const { return size_t(y) * size_t(width_ * fine) + size_t(x); }
    void blend(size_t at, const Eigen::Vector3d& colour, double opacity);

    int width_, height_;
    std::vector<Eigen::Vector3f> colour_;
    std::vector<float> depth_;
};

template <class Colour> void Canvas::triangle(const Eigen::Matrix3d& corner, const Colour& colour)
{
    const Eigen::Matrix<double, 2, 3> p = corner.topRows<2>() * fine;
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double area = cross(p.col(1) - p.col(0), p.col(2) - p.col(0));
    if (area == 0)
        return;
    const Eigen::Vector2d low = p.rowwise().minCoeff(), high = p.rowwise().maxCoeff();
    const int left = std::max(0, int(low.x())), right = std::min(width_ * fine - 1, int(high.x()));
    const int top = std::max(0, int(low.y())), bottom = std::min(height_ * fine - 1, int(high.y()));
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const Eigen::Vector2d q(x + 0.5, y + 0.5);
            Eigen::Vector3d share;
            for (int k = 0; k < 3; ++k)
                share[k] = cross(p.col((k + 1) % 3) - q, p.col((k + 2) % 3) - q) / area;
            const float depth = float(corner.row(2).dot(share));
            if (share.minCoeff() < 0 || depth < depth_[sample(x, y)])
                continue;
            depth_[sample(x, y)] = depth;
            colour_[sample(x, y)] = Eigen::Vector3d(colour(share)).template cast<float>();
        }
}

} // namespace spia

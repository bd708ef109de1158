#include "app/viewer/views/best_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {
namespace {

constexpr int cells_along = 64;        ///< of the coarse picture along its longer side
constexpr int most_triangles = 30'000; ///< that are looked at: of a finer sheet every so many

struct Candidate {
    glm::dquat turn;
    double usual; ///< 1: as good as any; less: has to show so much more
};

/// From a corner of a cube, z upwards.
glm::dquat from_corner(double x, double y, double z)
{
    const glm::dvec3 viewer = glm::normalize(glm::dvec3(x, y, z));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), viewer));
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(viewer, right), viewer)));
}

std::vector<Candidate> candidates()
{
    // Face on, a face looks 1.7 times as large as from a corner, and tells less of how the part
    // lies in space.
    constexpr double corner_above = 0.95, corner_below = 0.85, face_on = 0.5;
    std::vector<Candidate> list;
    for (const double z : {1., -1.})
        for (const auto& [x, y] : {std::pair(1., -1.), {-1., -1.}, {1., 1.}, {-1., 1.}})
            list.push_back({from_corner(x, y, z), list.empty() ? 1 : z > 0 ? corner_above : corner_below});
    for (const StandardView view : {StandardView::front, StandardView::right, StandardView::left, StandardView::back,
                                    StandardView::top, StandardView::bottom})
        list.push_back({look(Camera{}, view).turn, face_on});
    return list;
}

/// A coarse picture: what is nearest to the viewer in each of its cells.
class Picture {
public:
    explicit Picture(const Eigen::AlignedBox2d& box)
        : cell_(box.sizes().maxCoeff() / cells_along), corner_(box.min()),
          columns_(std::max(1, int(std::ceil(box.sizes().x() / cell_)))),
          rows_(std::max(1, int(std::ceil(box.sizes().y() / cell_)))),
          depth_(size_t(columns_ * rows_), -std::numeric_limits<double>::infinity()), marked_(depth_.size(), 0)
    {
    }
    /// @param x per corner: right, up, towards the viewer. mm
    void draw(const Eigen::Matrix3d& x, bool mark)
    {
        Eigen::Matrix<double, 2, 3> p = (x.topRows<2>().colwise() - corner_) / cell_;
        const Eigen::Vector2d u = p.col(1) - p.col(0), v = p.col(2) - p.col(0);
        const double twice = u.x() * v.y() - u.y() * v.x();
        const Eigen::Vector2d low = p.rowwise().minCoeff(), high = p.rowwise().maxCoeff();
        bool met = false;
        for (int j = std::max(0, int(std::ceil(low.y() - 0.5))); j < rows_ && j + 0.5 <= high.y(); ++j)
            for (int i = std::max(0, int(std::ceil(low.x() - 0.5))); i < columns_ && i + 0.5 <= high.x(); ++i) {
                const Eigen::Vector2d w = Eigen::Vector2d(i + 0.5, j + 0.5) - p.col(0);
                const double b = (w.x() * v.y() - w.y() * v.x()) / twice, c = (u.x() * w.y() - u.y() * w.x()) / twice;
                if (!(b >= 0 && c >= 0 && b + c <= 1)) // also where it is seen edge on
                    continue;
                met = true;
                put(i, j, x(2, 0) + b * (x(2, 1) - x(2, 0)) + c * (x(2, 2) - x(2, 0)), mark);
            }
        if (met || high.x() - low.x() > 2 || high.y() - low.y() > 2)
            return;
        const Eigen::Vector2d middle = p.rowwise().mean(); // smaller than a cell
        put(std::clamp(int(middle.x()), 0, columns_ - 1), std::clamp(int(middle.y()), 0, rows_ - 1), x.row(2).mean(),
            mark);
    }
    /// mm2 of what is marked and in sight
    double marked_area() const { return double(std::count(marked_.begin(), marked_.end(), 1)) * cell_ * cell_; }

private:
    void put(int i, int j, double depth, bool mark)
    {
        const auto at = size_t(i + j * columns_);
        if (depth > depth_[at]) {
            depth_[at] = depth;
            marked_[at] = mark;
        }
    }
    double cell_; ///< mm
    Eigen::Vector2d corner_;
    int columns_, rows_;
    std::vector<double> depth_;
    std::vector<char> marked_;
};

} // namespace

double share_seen(const Eigen::Matrix3Xi& triangle, const std::vector<Eigen::Matrix3Xd>& states,
                  const std::vector<int>& faces, const glm::dquat& turn)
{
    const glm::dmat3 axes = glm::mat3_cast(turn);
    Eigen::Matrix3d seen;
    for (int k = 0; k < 3; ++k)
        seen.row(k) << axes[k].x, axes[k].y, axes[k].z;
    std::vector<Eigen::Matrix3Xd> places;
    Eigen::AlignedBox2d box;
    for (const Eigen::Matrix3Xd& state : states) {
        places.push_back(seen * state);
        box.extend(Eigen::Vector2d(places.back().topRows<2>().rowwise().minCoeff()));
        box.extend(Eigen::Vector2d(places.back().topRows<2>().rowwise().maxCoeff()));
    }
    if (!(box.sizes().maxCoeff() > 0))
        return 0;
    std::vector<char> marked(size_t(triangle.cols()), 0);
    for (const int f : faces)
        marked[size_t(f)] = 1;
    const auto stride = std::max<Eigen::Index>(1, triangle.cols() / most_triangles);
    double sum = 0;
    for (const Eigen::Matrix3Xd& place : places) {
        Picture picture(box);
        for (Eigen::Index f = 0; f < triangle.cols(); f += stride)
            picture.draw(place(Eigen::all, triangle.col(f)), marked[size_t(f)]);
        double whole = 0;
        for (const int f : faces) {
            const Eigen::Matrix3d x = place(Eigen::all, triangle.col(f));
            whole += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
        }
        sum += whole > 0 ? picture.marked_area() / whole : 0;
    }
    return sum / double(states.size());
}

glm::dquat best_turn(const Eigen::Matrix3Xi& triangle, const std::vector<Eigen::Matrix3Xd>& states,
                     const std::vector<int>& faces)
{
    const std::vector<Candidate> list = candidates();
    size_t best = 0;
    double most = -1;
    for (size_t k = 0; k < list.size(); ++k)
        if (const double shown = list[k].usual * share_seen(triangle, states, faces, list[k].turn); shown > most) {
            best = k;
            most = shown;
        }
    return list[best].turn;
}

} // namespace spia::viewer

#include "engine/pipeline/blank/blank_marks.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Lays lines on a part into its blank.
class Projection {
public:
    Projection(const TriMesh& part, const Blank& blank)
        : part_(part), blank_(blank), search_(part), tolerance_(1e-5 * bounding_diagonal(part))
    {
    }

    void lay(const MarkLine& mark)
    {
        label_ = mark.label;
        const Eigen::Matrix3Xd& line = mark.point;
        Eigen::Vector2d from = in_blank(line.col(0));
        row_ = {from};
        for (Eigen::Index k = 0; k + 1 < line.cols(); ++k) {
            const Eigen::Vector2d to = in_blank(line.col(k + 1));
            add(line.col(k), line.col(k + 1), from, to, 0);
            from = to;
        }
        end_row();
    }
    std::vector<DrawnMark> marks;

private:
    Eigen::Vector2d in_blank(const Eigen::Vector3d& place) const
    {
        const ClosestPoint near = search_.nearest(place);
        return blank_.position(Eigen::all, part_.triangle.col(near.face)) * near.barycentric;
    }

    /// The way from a to b, without a: halved until it is straight.
    void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
             int depth)
    {
        constexpr int most = 10;   // halvings
        constexpr double torn = 2; // no sheet that is formed is pulled as far
        const Eigen::Vector3d middle = (a + b) / 2;
        const Eigen::Vector2d half = in_blank(middle);
        const bool whole = (to - from).norm() <= torn * (b - a).norm() + tolerance_;
        if (whole && straight(in_blank((a + middle) / 2), half, in_blank((middle + b) / 2), from, to)) {
            row_.push_back(to);
            return;
        }
        if (depth < most) {
            add(a, middle, from, half, depth + 1);
            add(middle, b, half, to, depth + 1);
            return;
        }
        if (!whole)
            end_row();
        row_.push_back(to);
    }

    bool straight(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& r,
                  const Eigen::Vector2d& from, const Eigen::Vector2d& to) const
    {
        const auto off = [&](const Eigen::Vector2d& place) {
            const Eigen::Vector2d way = to - from, arm = place - from;
            const double share = way.squaredNorm() > 0 ? std::clamp(arm.dot(way) / way.squaredNorm(), 0., 1.) : 0;
            return (arm - share * way).norm();
        };
        return std::max({off(p), off(q), off(r)}) <= tolerance_;
    }

    void end_row()
    {
        if (row_.size() > 1) {
            marks.push_back({Eigen::Matrix2Xd(2, Eigen::Index(row_.size())), label_});
            Eigen::Matrix2Xd& row = marks.back().line;
            for (size_t k = 0; k < row_.size(); ++k)
                row.col(Eigen::Index(k)) = row_[k];
        }
        row_.clear();
    }

    const TriMesh& part_;
    const Blank& blank_;
    ClosestPointSearch search_;
    double tolerance_; ///< mm
    std::vector<Eigen::Vector2d> row_;
    MarkLabel label_;
};

} // namespace

std::vector<DrawnMark> marks_on_blank(const PartFile& part, const Blank& blank)
{
    if (!part.solid || part.solid->marks.empty())
        return {};
    Projection projection(part.mesh, blank);
    for (const MarkLine& mark : part.solid->marks)
        projection.lay(mark);
    return std::move(projection.marks);
}

} // namespace spia

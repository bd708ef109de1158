#include "engine/unfold/map_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/place_text.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/locate.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

Eigen::Index segments_of(const SheetLine& line)
{
    if (line.point.cols() < 2 || !line.point.allFinite())
        throw InputError(fmt::format("the line \"{}\" needs two finite points or more", line.name));
    return line.point.cols() - (line.closed ? 0 : 1);
}

SheetLine line_through(const std::vector<Eigen::Vector3d>& points, const SheetLine& drawn)
{
    SheetLine line{drawn.name, Eigen::Matrix3Xd(3, Eigen::Index(points.size())), drawn.closed};
    for (size_t k = 0; k < points.size(); ++k)
        line.point.col(Eigen::Index(k)) = points[k];
    return line;
}

class Lift {
public:
    Lift(const TriMesh& part, const Eigen::Matrix2Xd& flat)
        : part_(part), flat_(flat), locator_(flat, part.triangle), tree_(in_space(part, flat))
    {
    }

    SheetLine operator()(const SheetLine& line) const
    {
        std::vector<Eigen::Vector3d> points;
        const Eigen::Index segments = segments_of(line);
        for (const auto& p : line.point.colwise()) // a point that lies off the sheet tells more
                                                   // than a place before it
            on_part(line, p.head<2>());
        for (Eigen::Index k = 0; k < segments; ++k) {
            const Eigen::Vector2d p = line.point.col(k).head<2>(),
                                  q = line.point.col((k + 1) % line.point.cols()).head<2>();
            std::vector<double> at = crossings(p, q - p);
            for (size_t i = 0; i < at.size(); ++i) {
                points.push_back(on_part(line, p + at[i] * (q - p)));
                // between edges it is in one face, or off the sheet
                const double next = i + 1 < at.size() ? at[i + 1] : 1;
                on_part(line, p + (at[i] + next) / 2 * (q - p));
            }
        }
        if (!line.closed)
            points.push_back(on_part(line, line.point.rightCols<1>().head<2>()));
        return line_through(points, line);
    }

private:
    Eigen::Vector3d on_part(const SheetLine& line, const Eigen::Vector2d& p) const
    {
        const MeshPoint place = locator_.nearest(p);
        if (place.distance > 10 * locator_.tolerance())
            throw InputError(fmt::format("the line \"{}\" leaves the blank at {:.6g}, {:.6g}, {:.3g} mm off it",
                                         line.name, p[0], p[1], place.distance));
        return part_.position(Eigen::all, part_.triangle.col(place.face)) * place.barycentric;
    }

    /// Where a segment crosses edges of the mesh, from its begin (0) on; what is nearer to each
    /// other than rounding counts once.
    std::vector<double> crossings(const Eigen::Vector2d& p, const Eigen::Vector2d& d) const
    {
        constexpr double same = 1e-9; // of the segment
        std::vector<double> at = {0};
        const Eigen::AlignedBox2d box(p.cwiseMin(p + d), p.cwiseMax(p + d));
        for_each_face_near(box, [&](int face) {
            for (int k = 0; k < 3; ++k) { // an edge between two faces is met twice
                const auto [low, high] = std::minmax({part_.triangle(k, face), part_.triangle((k + 1) % 3, face)});
                const Eigen::Vector2d a = flat_.col(low), b = flat_.col(high), e = b - a;
                const double turn = d.x() * e.y() - d.y() * e.x();
                if (turn == 0)
                    continue;
                const double t = ((a - p).x() * e.y() - (a - p).y() * e.x()) / turn,
                             s = ((a - p).x() * d.y() - (a - p).y() * d.x()) / turn;
                if (t > same && t < 1 - same && s >= 0 && s <= 1)
                    at.push_back(t);
            }
        });
        std::sort(at.begin(), at.end());
        at.erase(std::unique(at.begin(), at.end(), [](double x, double y) { return y - x < same; }), at.end());
        return at;
    }

    static TriMesh in_space(const TriMesh& part, const Eigen::Matrix2Xd& flat)
    {
        TriMesh mesh{Eigen::Matrix3Xd::Zero(3, flat.cols()), part.triangle};
        mesh.position.topRows<2>() = flat;
        return mesh;
    }

    template <class Visit> void for_each_face_near(const Eigen::AlignedBox2d& box, const Visit& visit) const
    {
        std::vector<int> open = {0};
        while (!open.empty()) {
            const int k = open.back();
            open.pop_back();
            const BoxTree::Node& node = tree_.node[size_t(k)];
            const auto low = node.box.min().head<2>().array(), high = node.box.max().head<2>().array();
            if ((low > box.max().array()).any() || (high < box.min().array()).any())
                continue;
            for (int f = 0; f < node.count; ++f)
                visit(tree_.face[size_t(node.first + f)]);
            if (node.count == 0) {
                open.push_back(node.second);
                open.push_back(k + 1);
            }
        }
    }

    const TriMesh& part_;
    const Eigen::Matrix2Xd& flat_;
    PlanarLocator locator_;
    BoxTree tree_;
};

class Laying {
public:
    Laying(const TriMesh& part, const Eigen::Matrix2Xd& flat)
        : part_(part), flat_(flat), search_(part), within_(reach * bounding_diagonal(part)),
          spacing_(std::sqrt(area(part) / part.triangles()))
    {
    }

    SheetLine operator()(const SheetLine& line) const
    {
        std::vector<Eigen::Vector3d> points;
        const Eigen::Index segments = segments_of(line);
        for (Eigen::Index k = 0; k < segments; ++k) {
            const Eigen::Vector3d a = line.point.col(k), b = line.point.col((k + 1) % line.point.cols());
            const int pieces = std::max(1, int(std::ceil((b - a).norm() / spacing_)));
            for (int i = 0; i < pieces; ++i)
                points.push_back(on_blank(line, a + (b - a) * i / pieces));
        }
        if (!line.closed)
            points.push_back(on_blank(line, line.point.rightCols<1>()));
        SheetLine laid = line_through(points, line);
        require_no_jump(line, laid);
        return laid;
    }

private:
    static constexpr double reach = 0.005; // of the part's diagonal

    Eigen::Vector3d on_blank(const SheetLine& line, const Eigen::Vector3d& p) const
    {
        const ClosestPoint place = search_.nearest(p);
        if (place.distance > within_)
            throw InputError(fmt::format("the line \"{}\" is {:.3g} mm off the part at {}", line.name, place.distance,
                                         place_text(p)));
        const Eigen::Vector2d q = flat_(Eigen::all, part_.triangle.col(place.face)) * place.barycentric;
        return {q[0], q[1], 0};
    }

    /// From one layer of the sheet to another, or across a gap between flanges.
    void require_no_jump(const SheetLine& drawn, const SheetLine& laid) const
    {
        constexpr double stretch = 4; // what forming may do to a length, by far
        for (Eigen::Index k = 0; k < laid.point.cols() - (laid.closed ? 0 : 1); ++k) {
            const Eigen::Vector3d a = laid.point.col(k), b = laid.point.col((k + 1) % laid.point.cols());
            if ((b - a).norm() > stretch * (spacing_ + within_))
                throw InputError(
                    fmt::format("the line \"{}\" jumps on the blank from {:.6g}, {:.6g} to {:.6g}, {:.6g} mm: it "
                                "crosses a gap of the part, or the sheet overlaps itself there",
                                drawn.name, a[0], a[1], b[0], b[1]));
        }
    }

    const TriMesh& part_;
    const Eigen::Matrix2Xd& flat_;
    ClosestPointSearch search_;
    double within_, spacing_; ///< mm; the spacing is about half an edge
};

template <class Carry> MappedLines all_of(std::span<const SheetLine> lines, const Carry& carry)
{
    MappedLines mapped;
    for (const SheetLine& line : lines)
        try {
            mapped.lines.push_back(carry(line));
        } catch (const InputError& error) {
            mapped.left_out.emplace_back(error.what());
        }
    return mapped;
}

} // namespace

MappedLines to_part(const TriMesh& part, const Eigen::Matrix2Xd& flat, std::span<const SheetLine> lines)
{
    require_flat(part, flat);
    return all_of(lines, Lift(part, flat));
}

MappedLines to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, std::span<const SheetLine> lines)
{
    require_flat(part, flat);
    return all_of(lines, Laying(part, flat));
}

SheetLine to_part(const TriMesh& part, const Eigen::Matrix2Xd& flat, const SheetLine& line)
{
    require_flat(part, flat);
    return Lift(part, flat)(line);
}

SheetLine to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const SheetLine& line)
{
    require_flat(part, flat);
    return Laying(part, flat)(line);
}

} // namespace spia

#include "engine/mesh/solid/border/onto_surfaces.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/small_dense.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/solid/flip_folds.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

/// What is around a vertex of a skin.
struct Around {
    const StatedSurface* cylinder = nullptr;       ///< one of them
    bool alone = true;                             ///< there is no other surface
    bool smooth = true;                            ///< the skin has one normal there
    bool hollow = false;                           ///< the normals of the cylinder's faces look to
                                                   ///< its axis
    Eigen::Vector3d out = Eigen::Vector3d::Zero(); ///< unit, the normal of the cylinder's faces at
                                                   ///< the vertex
    /// each once, with its normal at the vertex, outwards
    std::vector<std::pair<const StatedSurface*, Eigen::Vector3d>> surface = {};
};

class Placing {
public:
    Placing(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet, const ThinSolidOptions& options)
        : middle_(middle), solid_(solid), sheet_(sheet), options_(options),
          around_(size_t(middle.mesh.vertices())), outer_{solid.position(Eigen::all, middle.source_vertex),
                                                          middle.mesh.triangle},
          wall_(Eigen::Matrix3Xd::Zero(3, solid.vertices()))
    {
        look_around();
        find_walls();
    }

    void place()
    {
        const Eigen::Matrix3Xd was = middle_.mesh.position;
        std::vector<char> at_end(around_.size(), 0);
        for (size_t v = 0; v < around_.size(); ++v) {
            const Around& here = around_[v];
            if (!here.cylinder || !lies_on_it(v))
                continue;
            if (here.alone)
                onto_cylinder(v);
            else if (here.smooth)
                at_end[v] = onto_end(v);
            else
                onto_mitre(v);
        }
        // Of a rim that is very slanted vertices of the bend's side go beyond its end; those of the
        // end have to go before them.
        for (const int f : turned())
            for (const int v : middle_.mesh.triangle.col(f))
                if (std::exchange(at_end[size_t(v)], char(0)))
                    middle_.mesh.position.col(v) = was.col(v);
        flip_folds(outer_, middle_, options_);
        even_out();
    }

private:
    SkinMesh& middle_;
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    const ThinSolidOptions& options_;
    std::vector<Around> around_;
    TriMesh outer_;                        ///< the outer skin, with the vertices and triangles of
                                           ///< the middle one
    std::vector<std::vector<int>> beside_; ///< per vertex: those next to it along the border;
                                           ///< empty: not asked for yet
    /// per vertex of the solid: area vectors of the faces across the thickness there, outwards; 0
    /// without
    Eigen::Matrix3Xd wall_;

    Eigen::Vector3d start(size_t v) const { return solid_.position.col(middle_.source_vertex[v]); }
    static Eigen::Vector3d across(const StatedSurface& cylinder, const Eigen::Vector3d& way)
    {
        return way - way.dot(cylinder.direction) * cylinder.direction;
    }

    void look_around()
    {
        const Eigen::Matrix3Xd normal = area_vectors(middle_.mesh);
        const auto surface = [&](int f) -> const StatedSurface& {
            return options_.surface[size_t(middle_.source_face[size_t(f)])];
        };
        for (int f = 0; f < middle_.mesh.triangles(); ++f)
            for (const int v : middle_.mesh.triangle.col(f))
                if (const StatedSurface& s = surface(f); s.kind == Kind::cylinder) {
                    Around& here = around_[size_t(v)];
                    here.cylinder = &s;
                    here.out = normal_at(s, start(size_t(v)), normal.col(f));
                    here.hollow = here.out.dot(start(size_t(v)) - s.point) < 0;
                }
        constexpr double one_normal = 0.9998; // 1 degree
        for (int f = 0; f < middle_.mesh.triangles(); ++f)
            for (const int v : middle_.mesh.triangle.col(f)) {
                Around& here = around_[size_t(v)];
                if (!here.cylinder)
                    continue;
                const StatedSurface& s = surface(f);
                here.alone &= s.kind == Kind::cylinder && same_cylinder(s, *here.cylinder);
                const Eigen::Vector3d own = normal.col(f).normalized();
                const Eigen::Vector3d out = normal_at(s, start(size_t(v)), own);
                here.smooth &= out.dot(here.out) > one_normal;
                if (std::ranges::none_of(here.surface, [&](const auto& known) {
                        return known.first->kind == s.kind && known.second.dot(out) > one_normal &&
                               (s.kind != Kind::cylinder || same_cylinder(*known.first, s));
                    }))
                    here.surface.emplace_back(&s, out);
            }
    }

    void find_walls()
    {
        const Eigen::Matrix3Xd normal = sheet_.flipped * area_vectors(solid_);
        for (int f = 0; f < solid_.triangles(); ++f)
            if (sheet_.side[size_t(f)] == SheetSide::rim)
                for (const int v : solid_.triangle.col(f))
                    wall_.col(v) +=
                        normal_at(options_.surface[size_t(f)], solid_.position.col(v), normal.col(f).normalized()) *
                        normal.col(f).norm();
    }

    /// A shallow mark in a bend was put back to another radius.
    bool lies_on_it(size_t v) const
    {
        const StatedSurface& cylinder = *around_[v].cylinder;
        constexpr double on_it = 1e-4; // of the thickness
        return std::abs(across(cylinder, start(v) - cylinder.point).norm() - cylinder.radius) <=
               on_it * sheet_.thickness + cylinder.off;
    }

    std::vector<int> turned() const { return turned_over(outer_, middle_, options_); }

    /// Beside the corner of a notch a vertex may go past it along its wall. Where triangles still
    /// turn over vertices of a slanted rim go the way of those beside them, as their own wall lets
    /// them.
    void even_out()
    {
        constexpr int rounds = 20; // as far as a vertex can be pushed along the border
        for (int round = 0; round < rounds; ++round) {
            const std::vector<int> faces = turned();
            if (faces.empty())
                return;
            if (beside_.empty())
                find_border();
            std::vector<char> done(around_.size(), 0);
            for (const int f : faces)
                for (const int v : middle_.mesh.triangle.col(f))
                    if (!std::exchange(done[size_t(v)], char(1)))
                        as_beside(size_t(v));
            flip_folds(outer_, middle_, options_);
        }
    }

    void find_border()
    {
        beside_.resize(around_.size());
        const std::vector<EdgeUse> uses = edge_uses(middle_.mesh.triangle);
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end != begin + 1)
                return;
            beside_[size_t(uses[begin].low)].push_back(uses[begin].high);
            beside_[size_t(uses[begin].high)].push_back(uses[begin].low);
        });
    }

    void as_beside(size_t v)
    {
        const Eigen::Vector3d wall = wall_.col(middle_.source_vertex[v]).normalized();
        const Around& here = around_[v];
        if (!here.cylinder || !here.alone || beside_[v].empty() || !(wall.norm() > 0) || !lies_on_it(v))
            return;
        Eigen::Vector3d way = Eigen::Vector3d::Zero();
        for (const int w : beside_[v])
            way += (middle_.mesh.position.col(w) - start(size_t(w))) / double(beside_[v].size());
        middle_.mesh.position.col(Eigen::Index(v)) = start(v) + way - way.dot(wall) * wall;
        onto_cylinder(v);
    }

    void onto_cylinder(size_t v)
    {
        const StatedSurface& cylinder = *around_[v].cylinder;
        auto place = middle_.mesh.position.col(Eigen::Index(v));
        const Eigen::Vector3d from = across(cylinder, start(v) - cylinder.point),
                              way = across(cylinder, place - start(v));
        const double radius = cylinder.radius + (around_[v].hollow ? 1 : -1) * sheet_.thickness / 2;
        // |from + x way| = radius, the solution that is nearest to the move as it was, x = 1.
        const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - radius * radius;
        if (!(radius > 0) || !(a > 0) || !(b * b > a * c))
            return;
        const double root = std::sqrt(b * b - a * c), x = (-b + root) / a, y = (-b - root) / a;
        const double nearest = std::abs(x - 1) < std::abs(y - 1) ? x : y;
        constexpr double most = 1; // farther it is another place of the cylinder
        if (std::abs(nearest - 1) < most)
            place = start(v) + nearest * (place - start(v));
    }

    /// Where bends of walls that are joined meet, inside of the sheet: half a thickness from both,
    /// as near as can be to where their tangent planes have it.
    void onto_mitre(size_t v)
    {
        const auto& surface = around_[v].surface;
        if (surface.size() < 2 || surface.size() > 3 || !wall_.col(middle_.source_vertex[v]).isZero() ||
            std::ranges::any_of(surface, [](const auto& each) { return each.first->kind == Kind::other; }))
            return;
        const double half = sheet_.thickness / 2;
        const Eigen::Vector3d from = middle_.mesh.position.col(Eigen::Index(v));
        Eigen::Vector3d place = from;
        Eigen::MatrixXd slope(Eigen::Index(surface.size()), 3);
        Eigen::VectorXd off(slope.rows());
        constexpr int steps = 20;
        constexpr double exact = 1e-12; // of the thickness
        for (int step = 0; step < steps; ++step) {
            for (Eigen::Index i = 0; i < off.size(); ++i) {
                const auto& [s, out] = surface[size_t(i)];
                const bool plane = s->kind == Kind::plane;
                const Eigen::Vector3d arm = across(*s, place - s->point);
                const double side = plane || across(*s, start(v) - s->point).dot(out) > 0 ? 1 : -1;
                slope.row(i) = plane ? Eigen::RowVector3d(out.transpose())
                                     : Eigen::RowVector3d(side * arm.normalized().transpose());
                off[i] = plane ? out.dot(place - start(v)) + half : side * (arm.norm() - s->radius) + half;
            }
            if (off.cwiseAbs().maxCoeff() <= exact * sheet_.thickness) {
                if ((place - from).norm() <= half)
                    middle_.mesh.position.col(Eigen::Index(v)) = place;
                return;
            }
            place -= shortest_least_squares(slope, off);
        }
    }

    /// mm, where the faces at a vertex have it, also if it went straight in.
    Eigen::Vector3d wanted(size_t v) const
    {
        const auto straight =
            std::ranges::find(middle_.straightened, middle_.source_vertex[v], &StraightVertex::source_vertex);
        return straight == middle_.straightened.end() ? Eigen::Vector3d(middle_.mesh.position.col(Eigen::Index(v)))
                                                      : straight->wanted;
    }

    /// Where the middle surface ends at a wall that begins behind a chamfer.
    /// @returns the way out of the sheet, unit, and how far that is, mm; nothing where it ends at
    /// the wall that the vertex is at
    std::optional<std::pair<Eigen::RowVector3d, double>> beyond_chamfer(size_t v) const
    {
        // sine of 1 degree; of the thickness; of the way along the chamfer
        constexpr double square = 0.02, least = 1e-3, most = 0.9;
        const Eigen::Vector3d wall = wall_.col(middle_.source_vertex[v]).normalized(), &out = around_[v].out;
        const double lean = wall.dot(out), flat = std::sqrt(1 - lean * lean);
        if (lean < square || flat < square)
            return std::nullopt;
        const Eigen::Vector3d way = (wall - lean * out) / flat;
        const double far = way.dot(wanted(v) - start(v));
        if (far < least * sheet_.thickness || far > most * sheet_.thickness / 2 * lean / flat)
            return std::nullopt;
        return std::pair(Eigen::RowVector3d(way.transpose()), far);
    }

    /// Half a thickness inwards, along the wall, and in the plane through the axis.
    /// @returns whether it was put there
    bool onto_end(size_t v)
    {
        const Eigen::Vector3d wall = wall_.col(middle_.source_vertex[v]);
        if (!(wall.norm() > 0))
            return false; // not at the rim: it went straight inwards
        const Around& here = around_[v];
        Eigen::Matrix3d planes;
        planes << here.out.transpose(), wall.normalized().transpose(),
            here.out.cross(here.cylinder->direction).transpose();
        constexpr double alike = 0.2; // as nearly parallel planes are for skin_of(): the rim runs
                                      // along the end
        if (std::abs(planes.determinant()) < alike)
            return false;
        Eigen::Vector3d across = Eigen::Vector3d(-sheet_.thickness / 2, 0, 0);
        if (const auto beyond = beyond_chamfer(v)) {
            planes.row(1) = beyond->first;
            across[1] = beyond->second;
        }
        const Eigen::Vector3d move = planes.inverse() * across;
        constexpr double most = 1.5; // thicknesses, as there
        if (move.norm() > most * sheet_.thickness)
            return false;
        middle_.mesh.position.col(Eigen::Index(v)) = start(v) + move;
        return true;
    }
};

} // namespace

void onto_surfaces(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet, const ThinSolidOptions& options)
{
    Placing(middle, solid, sheet, options).place();
}

} // namespace spia

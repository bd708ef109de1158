#pragma once
#include <fmt/core.h>
#include <string>
#include <vector>

#include "engine/mesh/solid/sides/opposite.h"
#include "engine/mesh/solid/sides/sheet_sides.h"
#include "engine/mesh/solid/sides/surface_pieces.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// A solid while its two sides are looked for: thin_solid() fills it, sheet_conditions.h says why
/// it is no sheet, sheet_thickness.h measures it.
struct SolidInPieces {
    const TriMesh& mesh;
    const ThinSolidOptions& options;
    Eigen::Matrix3Xd normal = {}; ///< area vectors, outwards
    SurfacePieces pieces = {};
    std::vector<Opposite> places = {};
    SheetSides sides = {};
    bool closed = false;

    int piece(int face) const { return pieces.piece[size_t(face)]; }
    PieceSide side(int face) const { return sides.side[size_t(piece(face))]; }
    Eigen::Vector3d middle(int face) const
    {
        const auto t = mesh.triangle.col(face);
        return (mesh.position.col(t[0]) + mesh.position.col(t[1]) + mesh.position.col(t[2])) / 3;
    }
    /// "CAD face 7 at 1, 2, 3 mm"
    std::string at(int face, const Eigen::Vector3d& place) const
    {
        return fmt::format("{} at {:.6g}, {:.6g}, {:.6g} mm",
                           options.face_name ? options.face_name(face) : fmt::format("face {}", face), place.x(),
                           place.y(), place.z());
    }
    [[noreturn]] void refuse(const std::string& what, int face, bool sheet_but_for_it = false) const
    {
        throw NotASheet(fmt::format("{} ({})", what, at(face, middle(face))), face, middle(face), sheet_but_for_it);
    }
    /// The largest triangle of the pieces for which `counts`.
    template <class Counts> int largest(const Counts& counts) const
    {
        int best = -1;
        for (int f = 0; f < mesh.triangles(); ++f)
            if (counts(piece(f)) && (best < 0 || normal.col(f).norm() > normal.col(best).norm()))
                best = f;
        return best;
    }
};

} // namespace spia

#pragma once
#include <string>
#include <vector>

#include "engine/nurbs/surface.h"

namespace spia {

/// A side of a patch's parameter square, counter-clockwise as in BlankBoundary: v = 0, u = 1, v =
/// 1, u = 0. The curve of a side always runs with the rising parameter (u on v0 and v1, v on u0 and
/// u1).
enum class Side { v0, u1, v1, u0 };
inline constexpr Side sides[] = {Side::v0, Side::u1, Side::v1, Side::u0};

struct PatchSide {
    int patch = 0;
    Side side = Side::v0;
    friend bool operator==(const PatchSide&, const PatchSide&) = default;
};

/// Two sides of patches (or of one) that are the same curve: the same degree, knots, control points
/// and weights, bit for bit.
struct PatchInterface {
    PatchSide first, second;
    bool reversed = false; ///< the parameters of the two sides run against each other; knots k and
                           ///< 1 - k then agree
    friend bool operator==(const PatchInterface&, const PatchInterface&) = default;
};

/// Patches that are joined along whole sides.
struct MultiPatch {
    std::vector<NurbsSurface> patch;
    std::vector<PatchInterface> interfaces;
};

/// Patches with the interfaces that their sides have: every two sides that are the same curve to
/// the last bit. A side that is collapsed to a point joins nothing.
/// @throws InputError if three sides are the same curve, or a side is not clear how it joins: a
/// closed curve, the same both ways
MultiPatch joined(std::vector<NurbsSurface> patches);

/// Control points of a side, in the order of its rising parameter: indices into
/// NurbsSurface::control.
std::vector<int> side_controls(const NurbsSurface& surface, Side side);
std::vector<int> side_controls(const MultiPatch& patches, PatchSide side, bool reversed = false);

/// Degree and knots of the curve of a side.
int side_degree(const NurbsSurface& surface, Side side);
const std::vector<double>& side_knots(const NurbsSurface& surface, Side side);

/// For messages: "side v = 0 of patch 2", patches counted from 1.
std::string name(PatchSide side);

/// The sides that no interface names: the border of the whole, in the order of patches and sides.
std::vector<PatchSide> outer_sides(const MultiPatch& patches);

/// @throws InputError if an interface names a patch that is not there, a side is in two interfaces,
///         or the two sides of an interface are not the same curve to the last bit; the message
///         names both sides and what differs
void require_watertight(const MultiPatch& patches);

/// The control points of all patches, where those of shared sides and corners count once.
struct SharedControls {
    std::vector<int> offset; ///< per patch the place of its first control point in `number`
    std::vector<int> number; ///< per control point of every patch its number, rising in the order
                             ///< of first appearance
    int count = 0;           ///< different numbers

    int of(int patch, int control) const { return number[size_t(offset[size_t(patch)] + control)]; }
};

/// @pre each interface joins sides with as many control points, see require_watertight()
SharedControls shared_controls(const MultiPatch& patches);

/// Inner corners at which other than four patches meet: their lines u and v cannot run on there. A
/// layout has as many as the angles of its border ask for, at least.
/// @pre as of shared_controls()
int singular_nodes(const MultiPatch& patches);

} // namespace spia

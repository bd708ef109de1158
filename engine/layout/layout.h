#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/core/progress.h"
#include "engine/forming/blank.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A curve that patches share or that is their outer side: a polyline on the blank between two
/// vertices of the layout.
struct LayoutCurve {
    std::array<int, 2> vertex = {-1, -1}; ///< of the layout: where it begins and ends
    Eigen::Matrix2Xd plane;               ///< 2 by #points, mm, on the blank; both ends included
    Eigen::Matrix3Xd part;                ///< 3 by #points, mm, the same on the part where the
                                          ///< curve is a piece of its border; else empty
    bool kept = false;                    ///< within the sheet: a cut or an edge of the part, on
                                          ///< which patches have to end

    bool on_border() const { return part.cols() > 0; }
};

/// A curve as it is run through along a face: from its beginning, or from its end.
struct CurveUse {
    int curve = -1;
    bool reversed = false;

    friend bool operator==(const CurveUse&, const CurveUse&) = default;
};

/// A four-sided region of the blank. Its sides v = 0, u = 1, v = 1, u = 0 in counter-clockwise
/// order.
using LayoutPatch = std::array<CurveUse, 4>;

/// Four-sided regions that fill the blank up to its holes. They share whole sides: no vertex lies
/// within a side of another.
struct Layout {
    Eigen::Matrix2Xd vertex; ///< 2 by #vertices, mm, on the blank
    std::vector<LayoutCurve> curve;
    std::vector<LayoutPatch> patch;
    bool split = false; ///< faces were divided at the middles of their sides, for not all triangles
                        ///< paired
    int edges = 0;      ///< #lines along sharp edges of the part that are sides of patches: see
                        ///< add_edges()
};

/// A line along which the user wants the sheet to be divided: vertices of the part, the first and
/// the last on its border, in their order; between two neighbours it runs straight on the blank.
using LayoutCut = std::vector<int>;

struct LayoutOptions {
    std::vector<LayoutCut> cuts = {};
    /// Vertices of the part on its border that are corners of patches, beside the ends of cuts:
    /// then no others are. Empty: chosen.
    std::vector<int> corners = {};
    double corner_deg = 50;            ///< turn of the border from which on a vertex is a corner of
                                       ///< patches
    double worst_angle_deg = 15;       ///< corners of two triangles that become one patch are
                                       ///< between this and its complement to 180; half of it and a
                                       ///< quarter are tried, too
    double spacing = 1.2;              ///< of vertices along the outline, over the mean distance of
                                       ///< holes
    bool split = false;                ///< divide every face, even where triangles pair
    bool layers = false;               ///< rows of patches along all arcs that bulge into the
                                       ///< sheet: see add_layers()
    double corner_radius = 0;          ///< mm: corners of the border that are rounded by less are
                                       ///< vertices, also those beside greater ones; 0: only those
                                       ///< that are seen over 1/50 of a loop
    double edge_deg = 45;              ///< turn of the sheet over a line on which patches end; 180:
                                       ///< none do. blank_patches() takes flatter ones as well
                                       ///< where the tolerance is missed
    bool smooth_joins = false;         ///< of the fit: take the angles out of the joins of the
                                       ///< patches, see smooth_joins()
    std::vector<int> file_number = {}; ///< per vertex of the part its number in messages; empty: as
                                       ///< in the mesh

    friend bool operator==(const LayoutOptions&, const LayoutOptions&) = default;
};

/// Divides the blank into four-sided patches around its holes and along the sharp edges of the
/// part. Corners of outline and holes, vertices between them where an arc turns far or is long, and
/// the ends of edges (where there are neither cuts nor corners) are joined by straight lines, short
/// and steep ones first, until none is left that neither crosses another nor leaves the blank
/// (exact predicates): the faces are triangles with the border's arcs and the edges as sides. Pairs
/// of them become patches [matching: Edmonds 1965]; those left over are divided from their middles,
/// and the strips beside them along (divide_faces()). Deterministic.
/// @throws InputError if the blank lies on itself, a cut is none (its ends are not on the border,
/// it leaves the sheet, crosses another) or
///         a face cannot be divided; the message says which
Layout make_layout(const TriMesh& part, const Blank& blank, const LayoutOptions& options = {},
                   const Progress& progress = {});

/// How many lines along sharp edges of the part there are on which patches would end: none where
/// there are cuts or corners.
int edge_count(const TriMesh& part, const LayoutOptions& options);

/// Points of a curve at shares of its length that rise from 0 to 1: the ends are those of the curve
/// to the last bit.
Eigen::Matrix2Xd points_on(const LayoutCurve& curve, const std::vector<double>& t);
/// The same on the part. @pre curve.on_border()
Eigen::Matrix3Xd part_points_on(const LayoutCurve& curve, const std::vector<double>& t);

/// Length on the blank, mm.
double length(const LayoutCurve& curve);

/// The border of a patch as a closed polygon, counter-clockwise, and where in it each side begins.
/// A side has the points of its curve and so many more that no edge is longer than 1 / pieces of
/// it.
struct PatchPolygon {
    Eigen::Matrix2Xd point;
    std::array<int, 4> corner;
};
PatchPolygon polygon_of(const Layout& layout, const LayoutPatch& patch, int pieces = 1);

/// Area between the sides, mm2.
double area(const Layout& layout, const LayoutPatch& patch);

} // namespace spia

#pragma once
#include <optional>
#include <vector>

#include "engine/core/progress.h"
#include "engine/layout/layout.h"

namespace spia {

/// Where the border of the sheet passes a vertex: the points next to it, with the sheet on the
/// left.
struct BorderTurn {
    Eigen::Vector2d before, after;
};

/// Vertices and curves between them that divide the blank into faces: first the border's arcs
/// alone, then lines across the sheet.
struct PlaneGraph {
    std::vector<Eigen::Vector2d> vertex;
    std::vector<std::optional<BorderTurn>> border; ///< per vertex; nothing within the sheet
    std::vector<char> closed = {};                 ///< per vertex, where given: 1 where no more
                                                   ///< lines may begin
    std::vector<LayoutCurve> curve = {};           ///< those on the border have the sheet on their
                                                   ///< left
};

/// A closed row of curves with a piece of the sheet on its left.
using Face = std::vector<CurveUse>;

/// The border with its vertices: corners, ends of cuts, and more where an arc turns far or is long
/// beside the spacing of the holes. Cuts divide it already.
/// @param forced         vertices of the part that become vertices of the layout; if not empty and
///         `only_forced`, no others do
/// @param close_corners  two corners side by side are two vertices
PlaneGraph border_graph(const TriMesh& part, const Blank& blank, const LayoutOptions& options,
                        const std::vector<int>& forced, bool only_forced, bool close_corners);

/// mm: the distance of vertices along the border that are there for nothing but its length.
double vertex_spacing(const TriMesh& part, const Blank& blank, const LayoutOptions& options);

/// Rows of vertices of the part along its sharp edges, from where they end, meet or turn to the
/// next such place; a closed one begins and ends at the same vertex. Loose ends shorter than 1/50
/// of the diagonal are noise. If there are more than 200 lines, only sharper ones count, up to 45
/// degrees; if there are as many then, nothing: the part is rough.
/// @param angle  radians between the normals of two faces
std::vector<std::vector<int>> sharp_edges(const TriMesh& part, double angle);

/// Divides a curve at one of its inner points, which becomes a vertex; the second half comes last.
void split_curve(PlaneGraph& graph, int c, Eigen::Index at);

/// The inner point of a curve next to half its length. @pre it has one
Eigen::Index next_to_middle(const LayoutCurve& curve);

/// Draws the edges of the part, in pieces, as curves on which patches end. Arcs of the border that
/// join the ends of such a curve are divided.
/// @pre where an edge ends on the border there is a vertex
/// @param longest  mm, of a piece
void add_edges(PlaneGraph& graph, const Blank& blank, const std::vector<std::vector<int>>& edges, double longest);

/// Draws a ring of four-sided faces around every hole that is small beside the distance to the rest
/// of the border, so that patches grow from hole to hole step by step.
void add_rings(PlaneGraph& graph);

/// Lays a row of four-sided faces along every arc of the border that bulges into the sheet, as thin
/// as its surroundings ask for; the arc is divided where it is bent too much for that. What is left
/// of the sheet has straight sides there. Arcs at which a cut or an edge of the part ends get none;
/// cuts and edges that are long beside their distance from the rest are divided.
/// @pre the graph has the border, cuts and edges of the part, no other lines
void add_layers(PlaneGraph& graph, const Progress& progress = {});

/// Joins vertices by straight lines until no more is possible.
/// @param complete  even by lines that leave the border at next to no angle
void triangulate(PlaneGraph& graph, bool complete, const Progress& progress = {});

/// Turns lines between two triangles to the other diagonal where that makes their least angle
/// greater [Lawson 1977].
/// @param first_line  curve from which on lines may be turned
void flip_lines(PlaneGraph& graph, int first_line, const Progress& progress = {});

/// The faces on the sheet. @throws InputError if a part of the border is joined to the rest by no
/// line
std::vector<Face> faces_of(const PlaneGraph& graph);

CurveUse turned(CurveUse use);

inline constexpr double corner_share = 0.1; ///< of a curve's length over which corners look at its
                                            ///< direction

/// The direction in which a curve leaves its beginning as it is used, taken at once or over a share
/// of its length.
Eigen::Vector2d leaving(const PlaneGraph& graph, CurveUse use, double share);

/// The points of the border of a face, counter-clockwise.
std::vector<Eigen::Vector2d> polygon(const PlaneGraph& graph, const Face& face);

/// The vertex at the beginning of a curve as it is used.
int start_of(const PlaneGraph& graph, CurveUse use);

/// Radians, the inner angle of a face between its curves k - 1 and k: 0 to 2 pi. Curves are looked
/// at over a tenth of their length.
double corner_angle(const PlaneGraph& graph, const Face& face, size_t k);

/// Makes one of the two arcs of the border at every vertex from which no line goes and at which the
/// border turns by less than a right angle's third: cells have no corner there.
void join_arcs(PlaneGraph& graph, std::vector<Face>& faces);

/// Pairs of triangles to faces of four sides; four-sided ones stay. False if a face is left over.
bool pair_triangles(PlaneGraph& graph, std::vector<Face>& faces, double worst_angle);

/// Divides faces until all have four sides: those of other counts from a place in their middle to
/// the middles of their sides, by straight lines where these see it, else by bent ones (spokes());
/// what is divided at a side so is divided on to the side across, strip by strip, until the border
/// or another such face.
/// @param all  every face is divided from its middle
/// @throws InputError if a face is too narrow for that
void divide_faces(PlaneGraph& graph, std::vector<Face>& faces, bool all);

} // namespace spia

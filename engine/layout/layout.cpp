#include "engine/layout/layout.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>
#include <set>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/layout/simplify/arc.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

/// Vertices at which cuts are divided: their ends, those on the border and those of two cuts.
std::set<int> breaks_of(const std::vector<LayoutCut>& cuts, const std::vector<char>& on_border)
{
    std::set<int> breaks, seen;
    for (const LayoutCut& cut : cuts) {
        if (cut.size() < 2)
            throw InputError("a cut needs two vertices or more");
        for (const int v : cut) {
            if (v < 0 || size_t(v) >= on_border.size())
                throw InputError(fmt::format("a cut names vertex {}, which the part does not have", v));
            if (!seen.insert(v).second || on_border[size_t(v)])
                breaks.insert(v);
        }
        breaks.insert({cut.front(), cut.back()});
    }
    return breaks;
}

/// The cuts as curves of the graph, divided where they meet.
void add_cuts(PlaneGraph& graph, const Blank& blank, const LayoutOptions& options, const std::set<int>& breaks)
{
    const auto number = [&](int v) { return options.file_number.empty() ? v : options.file_number[size_t(v)]; };
    const auto vertex_of = [&](int v, bool may_add) {
        const Eigen::Vector2d place = blank.position.col(v);
        const auto found = std::find(graph.vertex.begin(), graph.vertex.end(), place);
        if (found != graph.vertex.end())
            return int(found - graph.vertex.begin());
        if (!may_add)
            throw InputError(
                fmt::format("a cut ends at vertex {}, which is neither on the border nor on another cut; take it "
                            "on to one of these",
                            number(v)));
        graph.vertex.push_back(place);
        graph.border.push_back(std::nullopt);
        return int(graph.vertex.size()) - 1;
    };
    for (const LayoutCut& cut : options.cuts) // inner vertices of cuts that are others' as well
        for (size_t i = 1; i + 1 < cut.size(); ++i)
            if (breaks.contains(cut[i]))
                vertex_of(cut[i], true);
    for (const LayoutCut& cut : options.cuts) {
        std::vector<int> run = {cut.front()};
        for (size_t i = 1; i < cut.size(); ++i) {
            run.push_back(cut[i]);
            if (i + 1 < cut.size() && !breaks.contains(cut[i]))
                continue;
            LayoutCurve curve;
            curve.vertex = {vertex_of(run.front(), false), vertex_of(run.back(), false)};
            curve.plane = blank.position(Eigen::all, run);
            curve.kept = true;
            for (const LayoutCurve& other : graph.curve)
                for (Eigen::Index a = 0; a + 1 < curve.plane.cols(); ++a)
                    for (Eigen::Index b = 0; b + 1 < other.plane.cols(); ++b) {
                        const Eigen::Vector2d p = curve.plane.col(a), q = curve.plane.col(a + 1),
                                              r = other.plane.col(b), s = other.plane.col(b + 1);
                        if (p != r && p != s && q != r && q != s && segments_meet(p, q, r, s))
                            throw InputError(
                                fmt::format("the cut between the vertices {} and {} crosses the border or another cut; "
                                            "end it there, or give more vertices of a path around it",
                                            number(run[size_t(a)]), number(run[size_t(a) + 1])));
                    }
            for (const bool at_end : {false, true}) {
                const int v = curve.vertex[at_end ? 1 : 0];
                const Eigen::Vector2d next = at_end ? curve.plane.col(curve.plane.cols() - 2) : curve.plane.col(1);
                if (const auto& border = graph.border[size_t(v)];
                    border && !leads_inside(border->before, graph.vertex[size_t(v)], border->after, next))
                    throw InputError(fmt::format(
                        "the cut between the vertices {} and {} leaves the sheet; give more vertices of a path within "
                        "it",
                        number(run.front()), number(run.back())));
            }
            graph.curve.push_back(std::move(curve));
            run = {cut[i]};
        }
    }
}

Layout layout_of(const PlaneGraph& graph, const std::vector<Face>& faces)
{
    Layout layout;
    layout.vertex.resize(2, Eigen::Index(graph.vertex.size()));
    for (size_t v = 0; v < graph.vertex.size(); ++v)
        layout.vertex.col(Eigen::Index(v)) = graph.vertex[v];
    layout.curve = graph.curve;
    for (const Face& face : faces)
        layout.patch.push_back({face[0], face[1], face[2], face[3]});
    return layout;
}

std::vector<std::vector<int>> edges_of(const TriMesh& part, const LayoutOptions& options)
{
    if (!options.cuts.empty() || !options.corners.empty() || options.edge_deg >= 180)
        return {};
    return sharp_edges(part, options.edge_deg * std::numbers::pi / 180);
}

bool all_four_sided(const std::vector<Face>& faces)
{
    return std::all_of(faces.begin(), faces.end(), [](const Face& face) { return face.size() == 4; });
}

} // namespace

int edge_count(const TriMesh& part, const LayoutOptions& options) { return int(edges_of(part, options).size()); }

Layout make_layout(const TriMesh& part, const Blank& blank, const LayoutOptions& options, const Progress& progress)
{
    const auto loops = boundary_loops(part);
    std::vector<char> on_border(size_t(part.vertices()), 0);
    for (const auto& loop : loops)
        for (const int v : loop)
            on_border[size_t(v)] = 1;
    const std::set<int> breaks = breaks_of(options.cuts, on_border);
    std::vector<int> forced = options.corners;
    forced.insert(forced.end(), breaks.begin(), breaks.end());
    const std::vector<std::vector<int>> edges = edges_of(part, options);
    for (const std::vector<int>& edge : edges)
        for (const int v : {edge.front(), edge.back()})
            if (on_border[size_t(v)])
                forced.push_back(v);
    const bool whole = forced.empty() && edges.empty() && !options.split && !options.layers && loops.size() == 1;
    if (whole) {
        const auto corner = propose_corners(blank, part);
        forced.assign(corner.begin(), corner.end());
    }
    if (options.corner_radius > 0 && !whole) {
        const std::vector<int> corners =
            border_corners(part, blank, {options.corner_deg * std::numbers::pi / 180, options.corner_radius});
        forced.insert(forced.end(), corners.begin(), corners.end());
    }
    PlaneGraph graph =
        border_graph(part, blank, options, forced, whole || !options.corners.empty(), options.layers || !edges.empty());
    add_cuts(graph, blank, options, breaks);
    add_edges(graph, blank, edges, vertex_spacing(part, blank, options));
    std::vector<Face> faces;
    if ((loops.size() == 1 && edges.empty() && !options.layers) || !options.corners.empty())
        faces = faces_of(graph);
    const bool ready = !faces.empty() && all_four_sided(faces);
    if (!ready) {
        if (options.corners.empty())
            options.layers ? add_layers(graph, progress.part(0, 0.3)) : add_rings(graph);
        const int first_line = int(graph.curve.size());
        triangulate(graph, options.layers, progress.part(0.3, 0.6));
        if (options.layers || !edges.empty())
            flip_lines(graph, first_line, progress.part(0.6, 1));
        faces = faces_of(graph);
        join_arcs(graph, faces);
    }
    bool paired = ready;
    for (double angle = options.worst_angle_deg; !options.split && !paired && angle > 3; angle /= 2) {
        PlaneGraph pairs = graph; // flatter corners rather than four times as many patches
        std::vector<Face> of_pairs = faces;
        paired = pair_triangles(pairs, of_pairs, angle * std::numbers::pi / 180);
        if (paired) {
            graph = std::move(pairs);
            faces = std::move(of_pairs);
        }
    }
    const bool split = options.split || !paired;
    if (split && !paired) // as far as they go: one patch of a pair instead of six
        pair_triangles(graph, faces, options.worst_angle_deg * std::numbers::pi / 180);
    if (split)
        divide_faces(graph, faces, options.split);
    Layout layout = layout_of(graph, faces);
    layout.split = split;
    layout.edges = int(edges.size());
    return layout;
}

} // namespace spia

#include "engine/layout/simplify/layout_mesh.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace spia {

namespace {

/// The vertices of a patch, counter-clockwise.
std::array<int, 4> vertices_of(const Layout& layout, const LayoutPatch& patch)
{
    std::array<int, 4> result;
    for (size_t k = 0; k < 4; ++k)
        result[k] = layout.curve[size_t(patch[k].curve)].vertex[patch[k].reversed ? 1 : 0];
    return result;
}

// Cells of a grid that are judged in the same time as it takes to
constexpr long judging_work = 8;   // come to them
constexpr long crossing_work = 20; // look whether sides cross

QuadSide turned(QuadSide side)
{
    std::swap(side.from, side.to);
    return side;
}

} // namespace

bool LayoutMesh::represents(const Layout& layout)
{
    std::set<std::pair<int, int>> pairs;
    for (const LayoutCurve& curve : layout.curve)
        if (curve.vertex[0] == curve.vertex[1] || !pairs.insert(std::minmax(curve.vertex[0], curve.vertex[1])).second)
            return false;
    return !layout.patch.empty();
}

LayoutMesh::LayoutMesh(const Layout& layout, const CornerOptions& corners) : arcs_(arcs_of(layout, corners))
{
    vertex_.resize(size_t(layout.vertex.cols()));
    arcs_from_.resize(vertex_.size());
    for (size_t v = 0; v < vertex_.size(); ++v) {
        const OnArcs& on = arcs_.vertex[v];
        vertex_[v].position = on.position;
        if (on.fixed)
            vertex_[v].freedom = Freedom::fixed;
        else if (on.arc >= 0) {
            vertex_[v].freedom = Freedom::slides;
            vertex_[v].arc = on.arc;
            vertex_[v].s = on.s;
        }
    }
    line_.resize(size_t(arcs_.lines));
    for (int a = 0; a < int(arcs_.arc.size()); ++a) {
        const Arc& arc = arcs_.arc[size_t(a)];
        std::vector<int> row;
        for (size_t v = 0; v < vertex_.size(); ++v)
            if (vertex_[v].arc == a)
                row.push_back(int(v));
        std::sort(row.begin(), row.end(), [&](int v, int w) { return vertex_[size_t(v)].s < vertex_[size_t(w)].s; });
        const size_t n = row.size();
        state_.push_back(n == 0 ? ArcState{} : ArcState{int(n), row.front(), row.back()});
        for (size_t k = 0; k < n; ++k) {
            MeshVertex& v = vertex_[size_t(row[k])];
            v.before = k > 0 ? row[k - 1] : arc.closed() ? row.back() : arc.end[0];
            v.after = k + 1 < n ? row[k + 1] : arc.closed() ? row.front() : arc.end[1];
            v.border = arc.border();
        }
        for (const int end : arc.end)
            if (end >= 0) {
                arcs_from_[size_t(end)].push_back(a);
                vertex_[size_t(end)].border = vertex_[size_t(end)].border || arc.border();
            }
        if (arc.line >= 0)
            line_[size_t(arc.line)].push_back(a);
    }
    vertex_trial_.assign(vertex_.size(), 0);
    arc_trial_.assign(state_.size(), 0);
    for (const LayoutPatch& patch : layout.patch)
        add_face(vertices_of(layout, patch));
    judge_all(price_);
}

double LayoutMesh::energy() const
{
    double sum = 0;
    for (const MeshFace& face : face_)
        sum += face.gone ? 0 : face.energy;
    return sum;
}

double LayoutMesh::least_quality() const
{
    double least = 1;
    for (const MeshFace& face : face_)
        least = face.gone ? least : std::min(least, face.quality);
    return least;
}

void LayoutMesh::begin()
{
    ++trial_;
    trying_ = true;
    old_vertices_ = vertices();
    old_faces_ = faces();
    old_alive_ = alive_;
    edited_vertices_.clear();
    edited_faces_.clear();
    edited_arcs_.clear();
    old_vertex_.clear();
    old_face_.clear();
    old_arc_.clear();
}

void LayoutMesh::undo()
{
    for (size_t i = 0; i < edited_vertices_.size(); ++i)
        vertex_[size_t(edited_vertices_[i])] = std::move(old_vertex_[i]);
    for (size_t i = 0; i < edited_faces_.size(); ++i)
        face_[size_t(edited_faces_[i])] = old_face_[i];
    for (size_t i = 0; i < edited_arcs_.size(); ++i)
        state_[size_t(edited_arcs_[i])] = old_arc_[i];
    vertex_.resize(size_t(old_vertices_));
    vertex_trial_.resize(vertex_.size());
    arcs_from_.resize(vertex_.size());
    face_.resize(size_t(old_faces_));
    face_trial_.resize(face_.size());
    alive_ = old_alive_;
    trying_ = false;
}

void LayoutMesh::keep() { trying_ = false; }

template <class Item>
Item& LayoutMesh::edited(int i, std::vector<Item>& items, std::vector<long>& trial, std::vector<int>& edited,
                         std::vector<Item>& old)
{
    if (trying_ && trial[size_t(i)] != trial_) {
        trial[size_t(i)] = trial_;
        edited.push_back(i);
        old.push_back(items[size_t(i)]);
    }
    return items[size_t(i)];
}

MeshVertex& LayoutMesh::edit_vertex(int v) { return edited(v, vertex_, vertex_trial_, edited_vertices_, old_vertex_); }

MeshFace& LayoutMesh::edit_face(int f) { return edited(f, face_, face_trial_, edited_faces_, old_face_); }

ArcState& LayoutMesh::edit_arc(int a) { return edited(a, state_, arc_trial_, edited_arcs_, old_arc_); }

int LayoutMesh::add_vertex(const MeshVertex& vertex)
{
    vertex_.emplace_back();
    vertex_trial_.push_back(0);
    arcs_from_.emplace_back();
    edit_vertex(vertices() - 1) = vertex;
    return vertices() - 1;
}

int LayoutMesh::add_face(const std::array<int, 4>& vertex)
{
    face_.emplace_back();
    face_.back().gone = true;
    face_trial_.push_back(0);
    const int f = faces() - 1;
    MeshFace& face = edit_face(f);
    face.gone = false;
    face.vertex = vertex;
    for (const int v : vertex)
        edit_vertex(v).faces.push_back(f);
    ++alive_;
    return f;
}

void LayoutMesh::merge(int from, int into)
{
    for (const int f : vertex(from).faces) {
        auto& corners = edit_face(f).vertex;
        std::replace(corners.begin(), corners.end(), from, into);
        edit_vertex(into).faces.push_back(f);
    }
    edit_vertex(from).faces.clear();
    if (vertex(from).freedom == Freedom::slides)
        unthread(from);
}

void LayoutMesh::remove(int f)
{
    MeshFace& face = edit_face(f);
    face.gone = true;
    for (const int v : face.vertex)
        std::erase(edit_vertex(v).faces, f);
    --alive_;
}

void LayoutMesh::turn(int f, const std::array<int, 4>& vertex)
{
    MeshFace& face = edit_face(f);
    for (const int v : face.vertex)
        std::erase(edit_vertex(v).faces, f);
    face.vertex = vertex;
    for (const int v : vertex)
        edit_vertex(v).faces.push_back(f);
}

void LayoutMesh::move(int v, const Eigen::Vector2d& position) { edit_vertex(v).position = position; }

void LayoutMesh::slide(int v, double s)
{
    MeshVertex& moved = edit_vertex(v);
    const Arc& own = arc(moved.arc);
    if (own.closed())
        s = s < 0 ? s + own.whole() : s >= own.whole() ? s - own.whole() : s;
    moved.s = s;
    moved.position = own.at(s);
}

void LayoutMesh::thread(int v, int a, double s, int before, int after)
{
    MeshVertex& own = edit_vertex(v);
    own.freedom = Freedom::slides;
    own.arc = a;
    own.before = before;
    own.after = after;
    own.border = arc(a).border();
    slide(v, s);
    ArcState& state = edit_arc(a);
    const auto slides_here = [&](int w) { return vertex(w).freedom == Freedom::slides && vertex(w).arc == a; };
    if (slides_here(before))
        edit_vertex(before).after = v;
    if (slides_here(after))
        edit_vertex(after).before = v;
    if (!slides_here(before) || state.count == 0)
        state.first = v;
    if (!slides_here(after) || state.count == 0)
        state.last = v;
    ++state.count;
}

void LayoutMesh::unthread(int v)
{
    MeshVertex& own = edit_vertex(v);
    ArcState& state = edit_arc(own.arc);
    const auto slides_here = [&](int w) { return vertex(w).freedom == Freedom::slides && vertex(w).arc == own.arc; };
    if (slides_here(own.before))
        edit_vertex(own.before).after = own.after;
    if (slides_here(own.after))
        edit_vertex(own.after).before = own.before;
    if (state.first == v)
        state.first = own.after;
    if (state.last == v)
        state.last = own.before;
    if (--state.count == 0)
        state.first = state.last = -1;
    own.freedom = Freedom::free;
    own.arc = own.before = own.after = -1;
    own.border = false;
}

QuadSide LayoutMesh::side(int a, int b) const
{
    const MeshVertex &from = vertex(a), &to = vertex(b);
    if (from.freedom == Freedom::slides) {
        const Arc& own = arc(from.arc);
        const bool to_fixed = to.freedom == Freedom::fixed;
        if (from.after == b)
            return {&own, from.s, to_fixed ? own.whole() : to.s > from.s ? to.s : to.s + own.whole()};
        if (from.before == b)
            return to_fixed        ? QuadSide{&own, from.s, 0}
                   : to.s < from.s ? QuadSide{&own, from.s, to.s}
                                   : QuadSide{&own, from.s + own.whole(), to.s};
        return {};
    }
    if (from.freedom == Freedom::fixed && to.freedom == Freedom::slides)
        return turned(side(b, a));
    if (from.freedom == Freedom::fixed && to.freedom == Freedom::fixed)
        for (const int c : arcs_from_[size_t(a)]) {
            const Arc& own = arc(c);
            if (state_[size_t(c)].count > 0)
                continue;
            if (own.end[0] == a && own.end[1] == b)
                return {&own, 0, own.whole()};
            if (own.end[0] == b && own.end[1] == a)
                return {&own, own.whole(), 0};
        }
    return {};
}

int LayoutMesh::face_from(int a, int b) const
{
    for (const int f : vertex(a).faces) {
        const auto& corners = face(f).vertex;
        for (size_t k = 0; k < 4; ++k)
            if (corners[k] == a && corners[(k + 1) % 4] == b)
                return f;
    }
    return -1;
}

Quad LayoutMesh::quad(int f) const
{
    Quad result;
    const auto& corners = face(f).vertex;
    for (size_t k = 0; k < 4; ++k) {
        result.corner[k] = vertex(corners[k]).position;
        result.side[k] = side(corners[k], corners[(k + 1) % 4]);
    }
    return result;
}

bool LayoutMesh::ring_or_fan(int v) const
{
    const auto& around = vertex(v).faces;
    const size_t n = around.size();
    std::vector<std::pair<int, int>> spoke; // of each face: that it begins and ends with,
                                            // counter-clockwise
    for (const int f : around) {
        const auto& corners = face(f).vertex;
        const size_t k = size_t(std::find(corners.begin(), corners.end(), v) - corners.begin());
        if (std::count(corners.begin(), corners.end(), v) != 1)
            return false;
        spoke.emplace_back(corners[(k + 1) % 4], corners[(k + 3) % 4]);
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 1; j < n; ++j)
            if (spoke[i].first == spoke[j].first || spoke[i].second == spoke[j].second)
                return false;
    const auto begins_with = [&](int w) {
        return std::find_if(spoke.begin(), spoke.end(), [&](const auto& s) { return s.first == w; }) - spoke.begin();
    };
    size_t at = 0;
    if (vertex(v).border) { // the fan begins where no other face ends
        for (at = 0; at < n; ++at)
            if (std::none_of(spoke.begin(), spoke.end(), [&](const auto& s) { return s.second == spoke[at].first; }))
                break;
        if (at == n)
            return false;
    }
    const size_t first = at;
    for (size_t seen = 1;; ++seen) {
        const size_t next = size_t(begins_with(spoke[at].second));
        if (next == n)
            return vertex(v).border && seen == n;
        if (next == first)
            return !vertex(v).border && seen == n;
        if (seen == n)
            return false;
        at = next;
    }
}

int LayoutMesh::shared_sides(int f, int g) const
{
    int result = 0;
    for (size_t k = 0; k < 4; ++k)
        for (size_t l = 0; l < 4; ++l)
            result +=
                face(f).vertex[k] == face(g).vertex[(l + 1) % 4] && face(f).vertex[(k + 1) % 4] == face(g).vertex[l];
    return result;
}

int LayoutMesh::vertices_on_line(int line) const
{
    int result = 0;
    for (const int a : line_[size_t(line)])
        result += state_[size_t(a)].count + (arc(a).closed() ? 0 : 1);
    return result;
}

bool LayoutMesh::sound() const
{
    constexpr int least_on_line = 3;
    for (size_t i = 0; i < edited_vertices_.size(); ++i) {
        const int v = edited_vertices_[i];
        const MeshVertex &own = vertex(v), &old = old_vertex_[i];
        if (own.faces.empty()) {
            if (own.freedom != Freedom::free)
                return false;
            continue;
        }
        if (!ring_or_fan(v))
            return false;
        // A face by itself at a vertex where the border runs on has a corner of 180 degrees.
        if (own.border && own.freedom == Freedom::slides && own.faces.size() == 1 && old.faces.size() != 1)
            return false;
        if (own.freedom == Freedom::slides && (face_from(own.before, v) < 0 && face_from(v, own.before) < 0))
            return false;
        if (own.freedom == Freedom::slides && face_from(v, own.after) < 0)
            return false;
    }
    for (const int f : edited_faces_) {
        if (face(f).gone)
            continue;
        for (size_t k = 0; k < 4; ++k) {
            const int a = face(f).vertex[k], b = face(f).vertex[(k + 1) % 4], g = face_from(b, a);
            if (g == f || (g < 0 && !on_arc(a, b)))
                return false;
            if (g >= 0 && shared_sides(f, g) > 1) {
                const bool held = (vertex(a).faces.size() == 2 && vertex(a).freedom != Freedom::free) ||
                                  (vertex(b).faces.size() == 2 && vertex(b).freedom != Freedom::free);
                if (!held || shared_sides(f, g) > 2)
                    return false;
            }
        }
    }
    for (const int a : edited_arcs_)
        if (arc(a).line >= 0 && vertices_on_line(arc(a).line) < least_on_line)
            return false;
    return true;
}

void LayoutMesh::judge(int f)
{
    MeshFace& own = edit_face(f);
    const Quad shape = quad(f);
    const QuadQuality quality = quad_quality(shape, price_.cells);
    own.quality = quality.least;
    own.energy = quad_energy(own.quality, quad_aspect(shape), price_.good);
    work_ += quality.cells + judging_work;
}

bool LayoutMesh::look_for_crossing(int f)
{
    work_ += crossing_work;
    return edit_face(f).crossed = sides_cross(quad(f));
}

void LayoutMesh::judge_edited()
{
    for (size_t i = 0; i < edited_faces_.size(); ++i)
        if (!face(edited_faces_[i]).gone)
            judge(edited_faces_[i]);
}

void LayoutMesh::judge_all(const FacePrice& price)
{
    price_ = price;
    for (int f = 0; f < faces(); ++f)
        if (!face(f).gone) {
            judge(f);
            look_for_crossing(f);
        }
}

double LayoutMesh::energy_change() const
{
    double result = 0;
    for (size_t i = 0; i < edited_faces_.size(); ++i) {
        const MeshFace& now = face(edited_faces_[i]);
        result += (now.gone ? 0 : now.energy) - (old_face_[i].gone ? 0 : old_face_[i].energy);
    }
    return result;
}

double LayoutMesh::least_before() const
{
    double least = 1;
    for (const MeshFace& face : old_face_)
        least = face.gone ? least : std::min(least, face.quality);
    return least;
}

int LayoutMesh::worse_before(double quality) const
{
    return int(std::count_if(old_face_.begin(), old_face_.end(),
                             [&](const MeshFace& face) { return !face.gone && face.quality < quality; }));
}

int LayoutMesh::worse_than(double quality) const
{
    return int(std::count_if(edited_faces_.begin(), edited_faces_.end(),
                             [&](int f) { return !face(f).gone && face(f).quality < quality; }));
}

int LayoutMesh::crossed_before() const
{
    return int(std::count_if(old_face_.begin(), old_face_.end(),
                             [](const MeshFace& face) { return !face.gone && face.crossed; }));
}

double LayoutMesh::least_after() const
{
    double least = 1;
    for (const int f : edited_faces_)
        least = face(f).gone ? least : std::min(least, face(f).quality);
    return least;
}

void LayoutMesh::refine()
{
    const int count = faces();
    std::map<std::pair<int, int>, int> middle;
    std::vector<std::array<int, 4>> corner(static_cast<size_t>(count)), halves(corner.size());
    std::vector<std::array<QuadSide, 4>> sides(corner.size()); // before any of them is divided
    for (int f = 0; f < count; ++f) {
        corner[size_t(f)] = face(f).vertex;
        sides[size_t(f)] = quad(f).side;
    }
    const auto middle_of = [&](int a, int b, const QuadSide& own) {
        const auto [place, fresh] = middle.emplace(std::minmax(a, b), -1);
        if (!fresh)
            return place->second;
        MeshVertex vertex_here;
        vertex_here.position = (vertex(a).position + vertex(b).position) / 2;
        const int v = place->second = add_vertex(vertex_here);
        if (own.arc) {
            const bool forward = own.from < own.to;
            thread(v, int(own.arc - arcs_.arc.data()), (own.from + own.to) / 2, forward ? a : b, forward ? b : a);
        }
        return v;
    };
    for (int f = 0; f < count; ++f)
        for (size_t k = 0; k < 4; ++k)
            halves[size_t(f)][k] = middle_of(corner[size_t(f)][k], corner[size_t(f)][(k + 1) % 4], sides[size_t(f)][k]);
    for (int f = 0; f < count; ++f) {
        MeshVertex vertex_here;
        vertex_here.position.setZero();
        for (size_t k = 0; k < 4; ++k) // of the Coons patch
            vertex_here.position +=
                vertex(halves[size_t(f)][k]).position / 2 - vertex(corner[size_t(f)][k]).position / 4;
        const int c = add_vertex(vertex_here);
        remove(f);
        for (size_t k = 0; k < 4; ++k)
            add_face({corner[size_t(f)][k], halves[size_t(f)][k], c, halves[size_t(f)][(k + 3) % 4]});
    }
    judge_all(price_);
}

Layout LayoutMesh::layout(const Layout& start) const
{
    Layout result;
    result.split = start.split;
    result.edges = start.edges;
    std::vector<int> number(vertex_.size(), -1);
    std::vector<Eigen::Vector2d> place;
    const auto numbered = [&](int v) {
        if (number[size_t(v)] < 0) {
            number[size_t(v)] = int(place.size());
            place.push_back(vertex(v).position);
        }
        return number[size_t(v)];
    };
    std::map<std::pair<int, int>, int> curve;
    const auto use_of = [&](int a, int b) -> CurveUse {
        const auto [known, fresh] = curve.emplace(std::minmax(a, b), int(result.curve.size()));
        const QuadSide own = side(a, b);
        const bool reversed = own.arc && own.from > own.to;
        if (!fresh)
            return {known->second, result.curve[size_t(known->second)].vertex[0] != numbered(a)};
        LayoutCurve& line = result.curve.emplace_back();
        const int from = reversed ? b : a, to = reversed ? a : b;
        line.vertex = {numbered(from), numbered(to)};
        if (own.arc) {
            std::tie(line.plane, line.part) = own.arc->piece(std::min(own.from, own.to), std::max(own.from, own.to));
            line.kept = !own.arc->border();
            place[size_t(line.vertex[0])] = line.plane.col(0); // beside a point of the arc: this point
            place[size_t(line.vertex[1])] = line.plane.col(line.plane.cols() - 1);
        }
        return {known->second, reversed};
    };
    for (const MeshFace& face : face_) {
        if (face.gone)
            continue;
        LayoutPatch& patch = result.patch.emplace_back();
        for (size_t k = 0; k < 4; ++k)
            patch[k] = use_of(face.vertex[k], face.vertex[(k + 1) % 4]);
    }
    result.vertex.resize(2, Eigen::Index(place.size()));
    for (size_t v = 0; v < place.size(); ++v)
        result.vertex.col(Eigen::Index(v)) = place[v];
    for (LayoutCurve& line : result.curve)
        if (line.plane.cols() == 0) {
            line.plane.resize(2, 2);
            line.plane << place[size_t(line.vertex[0])], place[size_t(line.vertex[1])];
        }
    return result;
}

} // namespace spia

#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/layout/simplify/arc.h"
#include "engine/layout/simplify/quad_quality.h"

namespace spia {

/// What can move a vertex of a LayoutMesh.
enum class Freedom {
    free,   ///< in the plane
    slides, ///< along an arc
    fixed
};

struct MeshVertex {
    Eigen::Vector2d position; ///< mm
    Freedom freedom = Freedom::free;
    int arc = -1;                ///< of one that slides
    double s = 0;                ///< mm along it
    int before = -1, after = -1; ///< of one that slides: the vertices next to it along the arc
    bool border = false;
    std::vector<int> faces; ///< around it, in no order; empty: it is gone
};

struct MeshFace {
    std::array<int, 4> vertex = {-1, -1, -1, -1}; ///< counter-clockwise
    bool gone = false;
    double quality = 0, energy = 0;
    bool crossed = false; ///< its sides cross
};

/// How many vertices slide along an arc, and the first and last of them. Of a closed arc `first` is
/// any.
struct ArcState {
    int count = 0, first = -1, last = -1;
};

/// What faces are judged by.
struct FacePrice {
    int cells = 6;     ///< of the grid along each side
    double good = 0.5; ///< quality from which on a face is not dearer for its worst corner
};

/// A layout as faces and vertices only: sides run straight, or along the arcs where both their ends
/// follow each other on one. Changes are made on trial: between begin() and undo() or keep() old
/// copies of all that is edited are held, so that undo() restores it to the bit.
class LayoutMesh {
public:
    /// @pre all-quad and conforming, no two curves between the same two vertices
    LayoutMesh(const Layout& layout, const CornerOptions& corners);
    /// Whether a layout can be such a mesh.
    static bool represents(const Layout& layout);

    const MeshVertex& vertex(int v) const { return vertex_[size_t(v)]; }
    const MeshFace& face(int f) const { return face_[size_t(f)]; }
    const Arc& arc(int a) const { return arcs_.arc[size_t(a)]; }
    int vertices() const { return int(vertex_.size()); }
    int faces() const { return int(face_.size()); }
    int alive() const { return alive_; }
    double energy() const;
    double least_quality() const;
    /// How many cells' corners were looked at so far: a measure of time that is the same on every
    /// machine.
    long work() const { return work_; }

    void begin();
    void undo();
    void keep();

    MeshVertex& edit_vertex(int v); ///< @pre begin()
    MeshFace& edit_face(int f);     ///< @pre begin()
    int add_vertex(const MeshVertex& vertex);
    int add_face(const std::array<int, 4>& vertex);

    /// One vertex takes the faces of another one, which goes. An end of one that slides is taken
    /// out of its arc.
    void merge(int from, int into);
    /// Takes a face away.
    void remove(int f);
    /// Gives a face other vertices.
    void turn(int f, const std::array<int, 4>& vertex);
    /// To a place in the plane, or along its arc.
    void move(int v, const Eigen::Vector2d& position);
    void slide(int v, double s);
    /// Puts a vertex on an arc between two that follow each other there.
    void thread(int v, int arc, double s, int before, int after);

    /// The side from a to b, which follow each other around a face.
    QuadSide side(int a, int b) const;
    bool on_arc(int a, int b) const { return side(a, b).arc != nullptr; }
    /// The face that runs from a to b; -1: none.
    int face_from(int a, int b) const;
    Quad quad(int f) const;

    /// Whether all that was edited since begin() is a sheet still: faces around every vertex in one
    /// ring or fan, no two faces with two sides in common but at a vertex that has to stay, three
    /// vertices and more on every closed line.
    bool sound() const;
    /// Judges the faces that were edited since begin().
    void judge_edited();
    void judge(int f);
    /// Looks whether the sides of a face cross. @returns it
    bool look_for_crossing(int f);
    void judge_all(const FacePrice& price);
    const FacePrice& price() const { return price_; }

    /// Since begin(): by how much the energy grew, and the least quality of what was edited.
    double energy_change() const;
    double least_before() const;
    double least_after() const;
    int worse_before(double quality) const; ///< how many of these faces were and are of less
    int worse_than(double quality) const;
    int crossed_before() const; ///< how many of these faces
    const std::vector<int>& edited_faces() const { return edited_faces_; }
    const std::vector<int>& edited_vertices() const { return edited_vertices_; }

    /// Every face in four: at the middles of its sides and of its Coons patch.
    void refine();
    Layout layout(const Layout& start) const;

private:
    /// One of such items, of which a copy is kept if this trial has none yet.
    template <class Item>
    Item& edited(int i, std::vector<Item>& items, std::vector<long>& trial, std::vector<int>& edited,
                 std::vector<Item>& old);
    ArcState& edit_arc(int a);
    void unthread(int v);
    bool ring_or_fan(int v) const;
    int shared_sides(int f, int g) const;
    int vertices_on_line(int line) const;

    Arcs arcs_;
    std::vector<ArcState> state_;
    std::vector<std::vector<int>> arcs_from_; ///< per vertex the arcs that begin or end at it
    std::vector<std::vector<int>> line_;      ///< per closed line its arcs
    std::vector<MeshVertex> vertex_;
    std::vector<MeshFace> face_;
    FacePrice price_;
    int alive_ = 0;
    mutable long work_ = 0;

    long trial_ = 0; ///< number of the trial that is under way
    bool trying_ = false;
    std::vector<long> vertex_trial_, face_trial_, arc_trial_; ///< the last trial that edited each
    std::vector<int> edited_vertices_, edited_faces_, edited_arcs_;
    std::vector<MeshVertex> old_vertex_;
    std::vector<MeshFace> old_face_;
    std::vector<ArcState> old_arc_;
    int old_vertices_ = 0, old_faces_ = 0, old_alive_ = 0;
};

} // namespace spia

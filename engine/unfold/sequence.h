#pragma once
#include <string>
#include <vector>

#include "engine/unfold/bends.h"
#include "engine/unfold/unfold_pick.h"

namespace spia {

/// What a step does.
enum class UnfoldKind {
    lay,     ///< lays the freed faces on the face that the carrying ones lie on
    unroll,  ///< all lies on one cylinder or cone, or nearly on a plane: its development, in which no length changes
    flatten, ///< all faces at once onto a plane, by the one-step solver
};
std::string_view name(UnfoldKind kind);

/// One step of a proposal; plain, to be edited.
struct PlannedStep {
    UnfoldKind kind = UnfoldKind::lay;
    std::string name;       ///< e.g. "region 4 and bend 2 onto region 1"
    UnfoldPick pick;        ///< of an unroll or a flatten: nothing is fixed, all is freed
    std::vector<int> freed; ///< labels of the map, ascending
    int carrier = -1;       ///< region; -1 where nothing stays
};

struct SequenceOptions {
    int root = -1;          ///< the region that stays; -1: the largest flat one
    bool unite = true;      ///< pieces laid on the same region at the same distance from the root make one step
    double distance = 5e-4; ///< of the part's diagonal: how far a carrying face may be from its plane, cylinder or cone
};

struct UnfoldSequence {
    int root;
    std::vector<int> depth; ///< per label: how many regions away from the root it is; a bend as the outer of its two
    std::vector<PlannedStep> steps; ///< in order: the outermost first; after the last the part is flat
    std::vector<std::string> notes; ///< what could not be a step of its own, and why
};

/// Proposes the order in which a part is unfolded region by region: the outermost regions are laid on the faces of their
/// neighbours, then these with what lies on them on theirs, until all lies on the face of the root; if that is a cylinder or
/// cone it is unrolled, and if it is no such face all is flattened at once. Walls that touch (also in a vertex) move together;
/// what touches more than the region that carries it moves with the next ring. In every pick a freed face touches only freed and
/// fixed ones.
/// @param map of this part
/// @throws InputError if the part is not in one piece, the map is not of this part or there is no such root
UnfoldSequence propose_sequence(const TriMesh& part, const BendMap& map, const SequenceOptions& options = {});

} // namespace spia

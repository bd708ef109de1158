#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/unfold/plan/bends.h"
#include "engine/unfold/target/unfold_pick.h"

namespace spia {

/// What a step does.
enum class UnfoldKind {
    lay,     ///< lays the freed faces on the face that the carrying ones lie on
    unroll,  ///< all lies on one cylinder or cone, or nearly on a plane: its development, in which
             ///< no length changes
    flatten, ///< all faces at once onto a plane, by the one-step solver
};
std::string_view name(UnfoldKind kind);

/// One step; plain, to be edited.
struct PlannedStep {
    UnfoldKind kind = UnfoldKind::lay;
    std::string name; ///< e.g. "region 4 onto region 1"
    /// of an unroll or a flatten: nothing is fixed, all is freed; an unroll has carrying faces all
    /// the same
    UnfoldPick pick;
    /// how far the carrying faces may be from the plane, cylinder or cone that is looked for; 0: as
    /// unfold_step()
    double within_mm = 0;
    double offset_mm = 0;                 ///< the target is moved so far to its outer side
    std::optional<double> extent_mm = {}; ///< how far it goes on beyond the carrying faces; none:
                                          ///< as far as the sheet does
    std::vector<int> freed;               ///< labels of the map, ascending
    std::vector<int> fixed;               ///< labels, the carrier first
    int carrier = -1;                     ///< region; -1 where nothing stays
    /// of the solver, in place of FlattenOptions
    std::optional<double> tolerance = {};
    std::optional<int> most_energy_steps = {}, most_newton_steps = {}; ///< likewise
    /// The faces that carried the target are gone from a changed part: without others, or a target,
    /// it has no result.
    bool carrying_lost = false;
};

struct SequenceOptions {
    int root = -1;                         ///< the region that stays; -1: the largest flat one
    bool unite = true;                     ///< pieces laid on the same region at the same distance
                                           ///< from the root make one step
    double distance = 9e-4;                ///< of the part's diagonal: how far a carrying face may
                                           ///< be from its plane, cylinder or cone
    bool unroll = true;                    ///< a cylinder or cone at last; else all is flattened
    std::vector<int> carries_nothing = {}; ///< regions on which nothing shall be laid, ascending
};

struct UnfoldSequence {
    int root;
    std::vector<int> depth;         ///< per label: how many regions away from the root it is; a
                                    ///< bend as the outer of its two
    std::vector<PlannedStep> steps; ///< in order: the outermost first; after the last the part is
                                    ///< flat
    std::vector<std::string> notes; ///< what could not be a step of its own, and why
};

/// Whether two steps do the same to the last digit, whatever they are called.
bool same_work(const PlannedStep& a, const PlannedStep& b);

/// The faces that carry the target of a step: those named, else all that stay.
inline const std::vector<int>& carrying_faces(const PlannedStep& step)
{
    return step.pick.carrying.empty() && !step.carrying_lost ? step.pick.fixed : step.pick.carrying;
}

/// Proposes the order in which a part is unfolded region by region: the outermost regions are laid
/// on the faces of their neighbours (planes, cylinders, cones, else smooth faces through gently
/// curved ones), then these with what lies on them on theirs, until all lies on the face of the
/// root; if that is a cylinder or cone it is unrolled, and if it is no such face or goes all around
/// all is flattened at once. A part that is flat already is taken as it is, in one step that
/// unrolls its plane. Walls that touch (also in a vertex) move together; what touches more than the
/// region that carries it moves with the next ring. In every pick a freed face touches only freed
/// and fixed ones.
/// @param map of this part
/// @throws InputError if the part is not in one piece, the map is not of this part or there is no
/// such root
UnfoldSequence propose_sequence(const TriMesh& part, const BendMap& map, const SequenceOptions& options = {});

} // namespace spia

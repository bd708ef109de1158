#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/unfold/plan/bends.h"
#include "engine/unfold/target/fit_target.h"

namespace spia {

/// The faces that regions can carry, each found when it is first asked for.
class Carriers {
public:
    /// Keeps references to part and map. @param distance mm: how far a region may be from its face
    /// @param none regions that shall carry nothing, ascending
    Carriers(const TriMesh& part, const BendMap& map, double distance, std::vector<int> none = {});

    /// The plane, cylinder or cone of a region.
    const TargetFit* plain(int region);
    /// That, or else the smooth face through it, if it is gently curved and lies on it nearly.
    const TargetFit* of(int region);
    /// Why there is none.
    std::string why_not(int region);
    /// Found only by allowing more than unfold_step() does for itself: the step has to say so.
    bool loose(int region);

private:
    struct Found {
        bool asked = false, asked_smooth = false, loose = false;
        std::optional<TargetFit> plain, smooth;
    };
    Found& found(int region);

    const TriMesh& part_;
    const BendMap& map_;
    double distance_;
    std::vector<int> none_;
    std::vector<Found> found_;
};

/// The largest flat region, one with a plane, cylinder or cone if it is not much smaller than the
/// best; not one that lies around the others.
int chosen_root(const TriMesh& part, const BendMap& map, Carriers& carriers);

/// Whether places go around a cylinder or cone so far that no line is left along which it could be
/// cut.
bool wraps(const TargetSurface& face, const TriMesh& part, const std::set<int>& vertices);

/// mm, of the box around some faces
double diagonal_of(const TriMesh& part, const std::vector<int>& faces);

} // namespace spia

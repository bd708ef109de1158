#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/picking/picking.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "engine/core/worker.h"

namespace spia::viewer {

/// Search structures of the part and its blank, made in the background as soon as these are there
/// and kept as long as they are the same. A million triangles take seconds; what asks for one
/// before waits, but the `ready_` ones never do.
class Pickers {
public:
    /// @param wake  called on another thread when one is ready
    explicit Pickers(std::function<void()> wake = [] {}) : worker_(std::move(wake)) {}

    /// Begins to make those of this session.
    void follow(const Session& session);
    /// The view of the part shows it as unfolded by its steps: what is picked there is that.
    void follow_steps(const ViewerState& state);
    /// Whether the view of the part shows it on the way from one state to the next: nothing can be
    /// picked there.
    bool on_the_way() const { return on_the_way_; }

    /// That of a view: the blank's, or the part's for the others. Null if there is nothing to pick,
    /// as in views that show nothing yet.
    const RayPicker* picker(const Session& session, View view);
    /// Null also while it is being made.
    const RayPicker* ready_picker(const Session& session, View view);
    /// The faces as the view shows them. Null likewise.
    const TriMesh* mesh(const Session& session, View view);
    /// Of what is measured on in a view, see measured_mesh(). Null if it shows nothing.
    const RayPicker* measuring_picker(const ViewerState& state, View view);
    const TriMesh* measuring_mesh(const ViewerState& state, View view);
    const RegionSearch& regions(const Session& session); ///< the part must be there
    const CornerTrack& track(const Session& session);    ///< the blank must be there
    /// The corners that are wanted, vertices of the mesh: the chosen ones, else those of the grid.
    /// Nothing if there are neither, or a chosen one is of another part.
    std::optional<std::array<int, 4>> corners(const Session& session);
    /// The part must be there.
    const BoundaryVertices& boundary(const Session& session, View view);
    /// Vertices of the outer boundary in their order; before there is a blank the longest one
    /// counts as that.
    /// @throws InputError if there is none
    const std::vector<int>& outline(const Session& session);
    /// Null while it is being made. @throws likewise
    const std::vector<int>* ready_outline(const Session& session);
    /// What a click would pick. Nothing likewise where the view shows none of the part.
    std::optional<int> vertex_at(const Session& session, const PickVertex& pick, const Camera& camera,
                                 const std::optional<HalfSpace>& kept);

private:
    /// What is searched on the part, or on its blank.
    struct Search {
        Eventually<RayPicker> picker;
        Eventually<BoundaryVertices> boundary;
    };
    Search& search(View view)
    {
        return view == View::blank ? on_blank_ : view == View::part && unfolded_ ? on_unfolded_ : on_part_;
    }

    std::shared_ptr<const PartFile> part_;
    std::shared_ptr<const FlattenResult> blank_;
    std::shared_ptr<const TriMesh> flat_; ///< the blank as a mesh in space
    Search on_part_, on_blank_, on_unfolded_;
    /// Made when it is first measured on.
    struct MeasuredOn {
        LaterResults of;
        std::shared_ptr<const DeformedSurface> deformed;
        std::shared_ptr<const TriMesh> mesh;
        std::shared_ptr<const RayPicker> picker;
    };
    std::array<MeasuredOn, 2> measured_; ///< of quad mesh and surface
    std::shared_ptr<const StepsRun> run_;
    size_t steps_ = 0;                        ///< of the run, after which the part is shown
    std::shared_ptr<const TriMesh> unfolded_; ///< the part then; null: it is shown as it is
    bool on_the_way_ = false;
    Eventually<RegionSearch> regions_;
    Eventually<std::vector<int>> longest_;
    Eventually<CornerTrack> track_;
    struct ChosenCorners {
        std::shared_ptr<const PartFile> of;
        std::array<int, 4> number;
        std::optional<std::array<int, 4>> vertex;
    };
    ChosenCorners chosen_;
    Worker worker_;
};

} // namespace spia::viewer

#pragma once
#include <memory>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/kept_lines.h"
#include "engine/remesh/size_field.h"

namespace spia {

struct IncrementalOptions {
    double sagitta;          ///< mm, that a new edge may be off the given mesh in its middle
    double most_edges = 1e9; ///< made in all; those that went again count
    int rounds = 8;          ///< of splits, collapses, flips and smoothing; then the worst
                             ///< triangles are seen to
};

/// Isotropic remeshing by splits, collapses, flips and tangential smoothing, vertices projected on
/// the given mesh. [Botsch, Kobbelt, A remeshing approach to multiresolution modeling, 2004; with a
/// size per place: Dunyach et al., Adaptive remeshing for real-time mesh deformation, 2013]. Kept
/// lines are divided once (divide_line()); where edges are asked to be shorter later they are
/// halved there.
class IncrementalRemesh {
public:
    /// @param size    it, the mesh and the lines have to stay
    /// @param search  of `mesh`
    IncrementalRemesh(const TriMesh& mesh, const KeptLines& lines, const SizeField& size,
                      const ClosestPointSearch& search, const IncrementalOptions& options,
                      const Progress& progress = {});
    ~IncrementalRemesh();

    /// All rounds.
    /// @throws InputError if more edges would have to be made: names the place where the last one
    /// was
    void run(const Progress& progress = {});
    /// A few rounds around those vertices of the mesh given last where edges have to be shorter;
    /// nothing is touched elsewhere.
    /// @param share   #V of that mesh, of their length now: 1 where they are good
    /// @param least   mm, of edges
    /// @param growth  of the length per mm of way
    /// @throws InputError  as run() does
    void refine(const Eigen::VectorXd& share, double least, double growth, const Progress& progress = {});

    struct Snapshot {
        TriMesh mesh;
        std::vector<int> was; ///< per face its number in the mesh given before if it is still the
                              ///< same, else -1
    };
    Snapshot snapshot();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Its run().
TriMesh remesh_incrementally(const TriMesh& mesh, const KeptLines& lines, const SizeField& size,
                             const ClosestPointSearch& search, const IncrementalOptions& options,
                             const Progress& progress = {});

} // namespace spia

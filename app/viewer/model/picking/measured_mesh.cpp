#include <algorithm>
#include <vector>

#include "app/viewer/model/picking/measuring.h"
#include "engine/exchange/export_scene.h"
#include "engine/forming/flat_mesh.h"
#include "engine/nurbs/tessellate.h"

namespace spia::viewer {
namespace {

/// All patches as triangles, about as fine as they are drawn.
TriMesh triangles_of(const MultiPatch& surface)
{
    constexpr double most_cells = 2e5;
    double spans = 0;
    for (const NurbsSurface& patch : surface.patch)
        spans += double(patch.count_u) * patch.count_v;
    const int samples = std::clamp(int(std::sqrt(most_cells / std::max(1., spans))), 1, 8);
    TriMesh all;
    for (const NurbsSurface& patch : surface.patch) {
        const TriMesh piece = tessellate(patch, samples).mesh;
        const int vertices = all.vertices(), faces = all.triangles();
        all.position.conservativeResize(3, vertices + piece.vertices());
        all.triangle.conservativeResize(3, faces + piece.triangles());
        all.position.rightCols(piece.vertices()) = piece.position;
        all.triangle.rightCols(piece.triangles()) = piece.triangle.array() + vertices;
    }
    return all;
}

} // namespace

std::shared_ptr<const TriMesh> measured_mesh(const ViewerState& state, View on)
{
    const Session& session = state.document.session;
    if (!session.part)
        return nullptr;
    switch (on) {
    case View::part: return {session.part, &session.part->mesh};
    case View::blank:
        return session.blank ? std::make_shared<TriMesh>(flat_mesh(session.part->mesh, session.blank->blank)) : nullptr;
    case View::quads: {
        const LaterResults made = quads_shown(state);
        if (made.surface && made.surface->patches) // their quads join at the patches' nodes
            return nullptr;
        return made.lifted ? std::make_shared<TriMesh>(spia::triangles_of(made.lifted->lifted)) : nullptr;
    }
    case View::surface: {
        const LaterResults made = surface_shown(state);
        if (!made.surface)
            return nullptr;
        return std::make_shared<TriMesh>(
            triangles_of(made.surface == session.surface ? surface_patches(session) : fitted_patches(*made.surface)));
    }
    }
    return nullptr;
}

} // namespace spia::viewer

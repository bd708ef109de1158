#include "engine/pipeline/outputs/session_scene.h"

namespace spia {
namespace {

/// All patches in triangles.
Tessellation tessellation_of(const MultiPatch& patches, const Progress& progress)
{
    Tessellation whole;
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        const double all = double(patches.patch.size());
        const Tessellation piece = tessellate(patches.patch[p], 3, progress.part(double(p) / all, double(p + 1) / all));
        const Eigen::Index vertices = whole.mesh.position.cols(), faces = whole.mesh.triangle.cols();
        whole.mesh.position.conservativeResize(3, vertices + piece.mesh.position.cols());
        whole.mesh.position.rightCols(piece.mesh.position.cols()) = piece.mesh.position;
        whole.normal.conservativeResize(3, vertices + piece.normal.cols());
        whole.normal.rightCols(piece.normal.cols()) = piece.normal;
        whole.mesh.triangle.conservativeResize(3, faces + piece.mesh.triangle.cols());
        whole.mesh.triangle.rightCols(piece.mesh.triangle.cols()) = piece.mesh.triangle.array() + int(vertices);
    }
    return whole;
}

} // namespace

SessionScene::SessionScene(const Session& session, std::string name, const Progress& progress)
{
    scene_.name = std::move(name);
    scene_.part = &session.part->mesh;
    scene_.blank = &session.blank->blank;
    scene_.fields = &session.blank->node;
    scene_.zones = session.limits ? &session.limits->zones : nullptr;
    if (session.lifted)
        scene_.quad_mesh = &session.lifted->lifted;
    if (!session.surface)
        return;
    surface_ = surface_patches(session);
    triangles_ = tessellation_of(surface_, progress);
    scene_.surface = &triangles_.mesh;
    scene_.surface_normal = &triangles_.normal;
    scene_.control_nets = surface_.patch;
}

} // namespace spia

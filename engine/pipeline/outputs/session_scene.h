#pragma once
#include <string>

#include "engine/core/progress.h"
#include "engine/exchange/export_scene.h"
#include "engine/nurbs/tessellate.h"
#include "engine/pipeline/session.h"

namespace spia {

/// What a scene file or a picture of a session shows: as far as its stages have run, solved at
/// least. The session must outlive it.
class SessionScene {
public:
    /// @param name  of the part
    SessionScene(const Session& session, std::string name, const Progress& progress = {});
    SessionScene(const SessionScene&) = delete; // the scene borrows from it
    SessionScene& operator=(const SessionScene&) = delete;

    const ExportScene& scene() const { return scene_; }

private:
    MultiPatch surface_;
    Tessellation triangles_;
    ExportScene scene_;
};

} // namespace spia

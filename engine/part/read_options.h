#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/solid/skin.h"
#include "engine/part/cad_options.h"
#include "engine/part/mesh_targets.h"
#include "engine/remesh/remesh.h"

namespace spia {

/// How a part is read and prepared.
struct ReadOptions {
    std::optional<LengthUnit> unit = {}; ///< of the file; not given: m for glTF (its
                                         ///< specification), what a Radioss deck says, else mm
    std::optional<bool> weld = {};       ///< join vertices at one place; not given: for STL and
                                         ///< glTF, which repeat them
    DoctorOptions doctor = {};           ///< its `weld` is ignored
    std::vector<std::string> parts = {}; ///< of a solver deck, by id or name; of a CAD file, faces
                                         ///< ("7", "10-19"), bodies and assemblies ("body:2",
                                         ///< "assembly:0", names: chosen_faces()); empty: all
    CadOptions cad = {};                 ///< of a CAD file
    SeamOptions seam = {};               ///< where a part is cut open that is no sheet; vertices of
                                         ///< the file
    std::optional<Skin> skin = {};       ///< of a solid of sheet; not given: the middle one, and
                                         ///< closed surfaces that are not flat enough
                                         ///< (has_both_skins()) are taken as hollow bodies, not as
                                         ///< solids
    /// Not given: the triangles stay as they are, but for cad.keep_triangles; a part that is
    /// refused has none.
    std::optional<RemeshOptions> remesh = {};
    MeshTargets targets = {}; ///< checked after that; not given: none

    friend bool operator==(const ReadOptions&, const ReadOptions&) = default;
};

} // namespace spia

#pragma once
#include <optional>

namespace spia {

/// How faces of CAD files become one triangle mesh.
struct CadOptions {
    std::optional<double> sewing_tolerance = {}; ///< mm, gaps up to this are closed; not given:
                                                 ///< found from the gaps; 0: the faces are not sewn
    /// mm between triangle and face; not given: 1/2000 of the diagonal of a box around faces and
    /// control points, less where the faces ask for it (usual_chords())
    std::optional<double> deflection = {};
    /// radians between the tangents at both ends of a chord; not given: as the faces ask
    /// (usual_chords())
    std::optional<double> angle = {};
    /// faces that cannot be read or meshed are left out, and the report names them; else the part
    /// is refused for them
    bool leave_out_unmeshed = false;
    /// those of the CAD faces stay; else slivers on a part that does not unroll are remeshed
    bool keep_triangles = false;

    friend bool operator==(const CadOptions&, const CadOptions&) = default;
};

} // namespace spia

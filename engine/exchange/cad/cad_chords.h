#pragma once
#include <TopoDS_Face.hxx>
#include <span>

namespace spia {

/// How far chords may be from the faces that they stand for.
struct Chords {
    double deflection; ///< mm
    double angle;      ///< radians between the tangents at both ends
};

/// Where nothing else is asked for. Bends and round borders are laid exactly whatever their chords
/// are, and drawn sheet is meshed anew: there 1/2000 of the diagonal and 20 degrees do. Of conical
/// sheet and of what has a long border that is no line and no circle the outline is that of the
/// chords, which take a sixth of the square of the angle of the area of a disc: they are finer. For
/// .cpp files of engine/exchange that hold an OcctSession.
Chords usual_chords(std::span<const TopoDS_Face> faces, double diagonal);

} // namespace spia

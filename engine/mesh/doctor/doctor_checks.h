#pragma once
#include "engine/mesh/doctor/mended_surface.h"

/// What the doctor only looks at: each check reports the faults it finds and changes nothing.
namespace spia {

/// Whether the soup makes sense at all: it has faces, its coordinates are numbers, its faces name
/// vertices that exist.
bool readable(const PolygonSoup& soup, DoctorReport& report);

/// Edges of three and more faces; notes in the surface whether there are any.
/// @param kept_largest  what hung on such edges has been left out already
void check_edges(MendedSurface& s, bool kept_largest, DoctorReport& report);

/// Vertices of the soup that no face names.
void report_strays(const MendedSurface& s, DoctorReport& report);

/// Pieces, boundary loops and handles of the oriented surface with separated fans. @param vertices
/// how many it has
void check_topology(const MendedSurface& s, int vertices, DoctorReport& report);

/// Triangles with an angle below this one.
void note_slivers(const MendedSurface& s, double angle_deg, DoctorReport& report);

} // namespace spia

#pragma once
#include <Eigen/Core>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/profile.h"

/// Parts that are flat sheets, only bent. All vertices lie on the straight generators of the
/// surface, so the strips between generators are flat and the polyhedron itself, not just the
/// smooth surface, unrolls without strain.
namespace spia::shapes {

struct DevelopablePart {
    TriMesh mesh;
    Eigen::Matrix2Xd flat; ///< 2 by #V, mm: the same vertices unrolled, faces counter-clockwise
};

/// A profile in the xz plane, extruded along y from 0 to length. The outer side is to the left of
/// the profile.
DevelopablePart extruded(const Profile& profile, double length, int triangles);

/// A quarter of a cylinder around y, convex upwards.
struct QuarterCylinder {
    double radius = 50; ///< mm
    double length = 80; ///< mm
    int triangles = 5000;
};
DevelopablePart quarter_cylinder(const QuarterCylinder& shape = {});

/// A sector of a cone with its apex (not part of it) in the origin and its axis along -z. Triangles
/// grow with the distance to the apex, in the ratio of `far` to `near`.
struct ConeSector {
    double near = 60;           ///< mm from the apex along a generator
    double far = 140;           ///< mm
    double half_angle_deg = 30; ///< between axis and generators
    double sector_deg = 180;    ///< around the axis, below 360
    int triangles = 5000;
};
DevelopablePart cone_sector(const ConeSector& shape = {});

/// A hat profile: flange, wall, top, wall, flange, bent with one radius. Bends up to 90 degrees; a
/// height field below.
struct HatChannel {
    double top = 60;    ///< mm, flat
    double wall = 35;   ///< mm, flat
    double flange = 30; ///< mm, flat
    double radius = 8;  ///< mm, of all bends
    double angle_deg = 90;
    double length = 200; ///< mm
    int triangles = 10000;
};
DevelopablePart hat_channel(const HatChannel& shape = {});

/// A base in the plane z = 0 that ends at x = `base`, and a flange bent up along that line over a
/// radius.
struct BentFlange {
    double base = 60;      ///< mm, flat
    double flange = 30;    ///< mm, flat
    double radius = 5;     ///< mm
    double angle_deg = 90; ///< of the bend, also beyond 180
    double length = 80;    ///< mm, of the bend line
    int triangles = 3000;
};
DevelopablePart bent_flange(const BentFlange& shape = {}); ///< its base lies in `flat` where it
                                                           ///< does in space

/// The same with an upright flange whose edge is folded back flat onto it.
struct HemmedFlange {
    double base = 60;        ///< mm, flat
    double wall = 30;        ///< mm, flat
    double lip = 12;         ///< mm, flat
    double radius = 5;       ///< mm, between base and wall
    double hem_radius = 0.6; ///< mm
    double length = 80;      ///< mm
    int triangles = 3000;
};
DevelopablePart hemmed_flange(const HemmedFlange& shape = {});

/// An upside-down U whose walls end in flanges turned inwards, with lips turned up behind them: six
/// bends of 90 degrees in the same sense. Seen from above it hides parts of itself, so no
/// projection can flatten it.
struct LippedChannel {
    double top = 60;     ///< mm, flat
    double wall = 40;    ///< mm, flat
    double flange = 12;  ///< mm, flat
    double lip = 8;      ///< mm, flat
    double radius = 6;   ///< mm, of all bends
    double length = 200; ///< mm
    int triangles = 10000;
};
DevelopablePart lipped_channel(const LippedChannel& shape = {});

/// A hat channel with a row of round holes in its top, in one wall and across one of its upper
/// bends. The triangles were laid out flat around the holes and then rolled up, so edges cross the
/// generators: unlike the parts above it is isometric to `flat` only up to the error of a chord, of
/// second order in the edge length.
struct PerforatedChannel {
    HatChannel channel;     ///< its `triangles` is the number here, too
    double hole_radius = 7; ///< mm, in the flat sheet
    int holes_per_row = 3;  ///< rows: top, right wall, left upper bend
};
DevelopablePart perforated_channel(const PerforatedChannel& shape = {});

} // namespace spia::shapes

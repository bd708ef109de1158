#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/profile.h"

/// Solids of bent sheet as a CAD system makes them, and their developed lengths in closed form.
/// They need OpenCASCADE: a library of their own, spia_cad_support.
namespace spia::shapes {

struct SolidBend {
    double inner_radius; ///< mm
    double angle;        ///< radians, positive to the left of the section
};

/// A rectangle with rounded corners that is cut through a leg, or into its left side. Slots and
/// circles are some of them.
struct Cutout {
    int leg = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< mm, from where the leg begins along it,
                                                      ///< and along y
    double length = 10, width = 10, radius = 5;       ///< mm; the radius half the width at most
    double turn = 0;                                  ///< radians, of its length against the leg
    double depth = 0;                                 ///< mm, of an engraving; 0: all through
    bool halves = false;                              ///< a circle in two edges
    Eigen::Vector2d lean = Eigen::Vector2d::Zero();   ///< of its walls: mm along the leg and along y
                                                      ///< per mm through the sheet, about its middle
};

/// A round hole through a leg that is wider at one side: a countersink or a counterbore.
struct Sink {
    int leg = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< mm, as of a cutout
    double hole = 3, wide = 6;                        ///< mm, radii; no hole of radius 0
    double depth = 1;                                 ///< mm, from that side to where the hole has
                                                      ///< its radius
    bool counterbore = false;
    bool left = true;  ///< the side at which it is wider
    double above = 0;  ///< mm, how far outside that side the tool begins; 0: by the thickness
    bool seam = false; ///< the wall of a counterbore is of two faces, one beyond the side's plane
};

/// A mark of even depth on the outer side of a bend and of the legs beside it.
struct Stamp {
    int bend = 0;
    /// Loops of corners, mm, the first one around the others, which are islands: from the middle of
    /// the bend across it and along y from y = 0, seen along the half of its angle.
    std::vector<std::vector<Eigen::Vector2d>> outline = {};
    double depth = 0.2; ///< mm; below zero: raised
};

/// A round or long emboss in a leg, of sheet that is as thick there: a flat, two radii and a slope
/// between them.
struct Emboss {
    int leg = 0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< mm, as of a cutout
    double flat = 5;                                  ///< mm, from the middle of the emboss to
                                                      ///< where the flat ends
    double radius = 3, slope = 0.6, ramp = 1;         ///< mm, of the middle of the sheet; radians;
                                                      ///< mm
    double length = 0;                                ///< mm, between the middles of its round
                                                      ///< ends; 0: round
    double turn = 0;                                  ///< radians, of its length against the leg
    bool left = true;                                 ///< rises to that side
};

/// What is milled through a bend once it is bent: a straight prism whose outline is a Cutout's.
struct BendCut {
    int bend = 0;
    double share = 0.5;  ///< of the bend's arc: where the middle of the prism crosses the middle of
                         ///< the sheet; outside 0 to 1 on a leg
    double y = 0;        ///< mm
    Cutout outline = {}; ///< its length, width, radius and turn; its length across the bend
    double lean = 0;     ///< radians, of the prism against the sheet's normal there, along the bend
    double pitch = 0;    ///< radians, likewise, across the bend
    double reach = 0;    ///< mm, of the prism both ways, if that is more than through the bend
};

/// Edges of the border at one side of the sheet or both, all around it, chamfered or rounded.
struct BrokenEdges {
    double size = 0;     ///< mm, of the chamfer's legs, or the radius; 0: they are sharp
    bool round = false;  ///< else a chamfer of 45 degrees
    bool left = true;    ///< at that side
    bool both = false;   ///< at the other side as well
    int edges = 0;       ///< only so many of them; 0: all
    bool cut = false;    ///< after cutouts, and their edges as well
    bool across = false; ///< with both: those across the thickness as well, all in one
};

/// A level step along a border, all along it.
struct Rebate {
    double depth = 0.2, breadth = 5; ///< mm
    bool left = true;                ///< at that side
    bool across = false;             ///< at the first leg's free end; else along y = 0, through bends
};

/// A section of straight legs and bends between them, the same all along y.
struct BentSolid {
    std::string kind;            ///< bracket, Z, channel, hat, hem, knuckle
    double thickness = 2;        ///< mm
    double width = 30;           ///< mm, along the bends
    std::vector<double> leg;     ///< mm, flat: one more than bends
    std::vector<SolidBend> bend; ///< in their order
    bool hole = false;           ///< a round hole through the middle of the first bend, seen along
                                 ///< the half of its angle
    double hole_radius = 0;      ///< mm, of it; 0: somewhat broader than the bend

    std::vector<Cutout> cutout = {};
    std::vector<Sink> sink = {};
    std::vector<Stamp> stamp = {}; ///< of brackets, which have one bend
    std::vector<BendCut> bend_cut = {};
    std::vector<Emboss> emboss = {};
    double corner = 0;                        ///< mm, radius of the four corners; 0: sharp
    BrokenEdges broken = {}, broken_too = {}; ///< one after the other
    std::vector<Rebate> rebate = {};          ///< after the edges are broken
    bool splines = false;                     ///< all faces are (rational) B-splines
    std::uint64_t pose = 0;                   ///< turned and moved by this seed; 0: as said
    double away = 200;                        ///< mm, how far it is moved at most along each axis

    /// mm: legs, and arcs at K times the thickness from the inner side
    double developed(double k) const;
};

/// The middle line of its section, from the origin on.
Profile middle_line(const BentSolid& solid);

/// The solid's surface as a mesher makes it, in binary STL. @param chord radians, at most, of bends
/// and holes
void write_bent_stl(const std::filesystem::path& file, const BentSolid& solid, double chord);

/// iges: its faces only, as most programs write them; stl: chords of 0.2 radians at most, within
/// 0.05 mm
enum class CadForm { step, brep, iges, stl };
const char* extension(CadForm form); ///< ".step"
void write_bent_solid(const std::filesystem::path& file, const BentSolid& solid, CadForm form = CadForm::step);

/// Whether IGES files written from now on have the borders of surfaces in their parameters as well,
/// not in space alone.
void write_iges_parameters(bool as_well);

} // namespace spia::shapes

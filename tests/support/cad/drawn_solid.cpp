#include "tests/support/cad/drawn_solid.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/angle.h"
#include "engine/exchange/cad/occt_session.h"
#include "tests/support/cad/section_face.h"
#include "tests/support/cad/write_solid.h"
#include "tests/support/profile.h"
#include "tests/support/seeded_random.h"

namespace spia::shapes {
namespace {

TopoDS_Shape turned(const Profile& profile, double t, double turn = 2 * std::numbers::pi)
{
    return BRepPrimAPI_MakeRevol(section_face(profile, t / 2, -t / 2), gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), turn)
        .Shape();
}

/// mm2, of what a profile sweeps in a full turn. [Pappus]
double swept_area(const Profile& profile)
{
    constexpr int steps = 200'000;
    const double step = profile.length() / steps;
    double sum = 0;
    for (int k = 0; k < steps; ++k)
        sum += profile.at((k + 0.5) * step).x();
    return 2 * std::numbers::pi * sum * step;
}

/// mm2, of the middle of a sheet that is open where its walls are upright and has no hole: its
/// curvature in sum is a full turn. [Steiner]
double area_from_volume(const TopoDS_Shape& shape, double t)
{
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    return properties.Mass() / t - t * t / 12 * 2 * std::numbers::pi;
}

/// From the middle of the bottom outwards and up.
Profile round_section(SeededRandom& random, int kind, double t)
{
    const auto radius = [&] { return t * random.between(2, 7); };
    const double bottom = t * random.between(8, 25);
    Profile profile({0, 0}, 0);
    switch (kind) {
    case 0: return profile.straight(bottom).bend(radius(), 90 * radians_per_degree).straight(t * random.between(4, 14));
    case 1:
        return profile.straight(bottom)
            .bend(radius(), 90 * radians_per_degree)
            .straight(t * random.between(1, 10))
            .bend(radius(), -90 * radians_per_degree)
            .straight(t * random.between(3, 12));
    case 2:
        return profile.straight(bottom)
            .bend(radius(), 90 * radians_per_degree)
            .straight(t * random.between(1, 6))
            .bend(radius(), -90 * radians_per_degree)
            .straight(t * random.between(2, 8))
            .bend(radius(), 90 * radians_per_degree)
            .straight(t * random.between(2, 8));
    case 3: {
        const double slope = radians_per_degree * random.between(25, 75);
        return profile.straight(bottom)
            .bend(radius(), slope)
            .straight(t * random.between(4, 15))
            .bend(radius(), -slope)
            .straight(t * random.between(3, 12));
    }
    default: {
        const double slope = radians_per_degree * random.between(25, 70);
        return profile.bend(t * random.between(15, 40), slope)
            .bend(radius(), -slope)
            .straight(t * random.between(3, 12));
    }
    }
}

/// A rectangle with round corners at a height, counter-clockwise.
TopoDS_Wire rounded(double length, double width, double r, double z)
{
    BRepBuilderAPI_MakeWire wire;
    const double x = length / 2 - r, y = width / 2 - r, sign[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int k = 0; k < 4; ++k) {
        const auto corner = [&](int at, double angle) {
            return gp_Pnt(sign[at % 4][0] * x + r * std::cos(angle), sign[at % 4][1] * y + r * std::sin(angle), z);
        };
        const double from = (k - 1) * 90 * radians_per_degree, to = from + 90 * radians_per_degree;
        wire.Add(
            BRepBuilderAPI_MakeEdge(
                GC_MakeArcOfCircle(corner(k, from), corner(k, from + 45 * radians_per_degree), corner(k, to)).Value())
                .Edge());
        wire.Add(BRepBuilderAPI_MakeEdge(corner(k, to), corner(k + 1, to)).Edge());
    }
    return wire.Wire();
}

/// A block with round corners whose bottom edges are rounded; its walls lean outwards.
TopoDS_Shape block(double length, double width, double corner, double bottom, double height, double z, double lean)
{
    const double out = 2 * height * std::tan(lean);
    TopoDS_Shape shape;
    if (lean > 0) {
        BRepOffsetAPI_ThruSections loft(true, true);
        loft.AddWire(rounded(length, width, corner, z));
        loft.AddWire(rounded(length + out, width + out, corner + out / 2, z + height));
        shape = loft.Shape();
    } else
        shape = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(rounded(length, width, corner, z), true).Face(),
                                      gp_Vec(0, 0, height))
                    .Shape();
    BRepFilletAPI_MakeFillet fillet(shape);
    for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(at.Current());
        const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)), b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
        if (std::abs(a.Z() - z) < 1e-9 && std::abs(b.Z() - z) < 1e-9)
            fillet.Add(bottom, edge);
    }
    return fillet.Shape();
}

struct Box {
    double length, width, corner, bottom, height, lean; ///< outside; mm, radians
    double brim;                                        ///< mm; 0: none
};

TopoDS_Shape made(const Box& box, double t)
{
    // The walls are as thick as the bottom: the inner block begins at height t, where the leaning
    // wall is farther out.
    const double in = t / std::cos(box.lean) - t * std::tan(box.lean);
    const TopoDS_Shape outer = block(box.length, box.width, box.corner, box.bottom, box.height, 0, box.lean),
                       inner = block(box.length - 2 * in, box.width - 2 * in, box.corner - in, box.bottom - t,
                                     box.height, t, box.lean);
    TopoDS_Shape shape = BRepAlgoAPI_Cut(outer, inner).Shape();
    if (box.brim > 0) {
        const auto plate = [&](double by, double from, double high) {
            return BRepPrimAPI_MakePrism(
                       BRepBuilderAPI_MakeFace(rounded(box.length + 2 * by, box.width + 2 * by, box.corner + by, from),
                                               true)
                           .Face(),
                       gp_Vec(0, 0, high))
                .Shape();
        };
        const TopoDS_Shape brim =
            BRepAlgoAPI_Cut(plate(box.brim, box.height - t, t), plate(-t, box.height - 2 * t, 4 * t));
        shape = BRepAlgoAPI_Fuse(shape, brim).Shape();
    }
    for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More();)
        return at.Current();
    return shape;
}

Box random_box(SeededRandom& random, int kind, double t)
{
    Box box{};
    box.corner = t * random.between(6, 15);
    box.length = 2 * box.corner + t * random.between(10, 50);
    box.width = 2 * box.corner + t * random.between(10, 40);
    box.bottom = random.between(2.5 * t, 0.7 * box.corner);
    box.height = box.bottom + t * random.between(3, 10);
    box.lean = kind == 6 ? radians_per_degree * random.between(3, 20) : 0;
    box.brim = kind == 7 ? t * random.between(4, 12) : 0;
    return box;
}

} // namespace

double ConicalSheet::to() const { return from + length * std::cos(slope); }
double ConicalSheet::middle_area() const { return turn * (from + to()) / 2 * length; }

void write_conical_sheet(const std::filesystem::path& file, const ConicalSheet& sheet, CadForm form)
{
    const OcctSession session;
    write_solid(file, turned(Profile({sheet.from, 0}, sheet.slope).straight(sheet.length), sheet.thickness, sheet.turn),
                form);
}

void write_waved_sheet(const std::filesystem::path& file, std::uint64_t seed)
{
    const OcctSession session;
    SeededRandom random(seed);
    const double t = random.between(0.5, 2), wave = t * random.between(30, 80),
                 high = wave * random.between(0.05, 0.15), length = wave * random.between(0.6, 3),
                 k = 2 * std::numbers::pi / wave, phase = random.between(0, 6);
    constexpr int places = 120;
    const auto side = [&](double off) { // mm, from the middle
        Handle(TColgp_HArray1OfPnt) place = new TColgp_HArray1OfPnt(1, places + 1);
        for (int i = 0; i <= places; ++i) {
            const double x = length * i / places, slope = high * k * std::cos(k * x + phase),
                         n = std::sqrt(1 + slope * slope);
            place->SetValue(i + 1, gp_Pnt(x - off * slope / n, 0, high * std::sin(k * x + phase) + off / n));
        }
        GeomAPI_Interpolate through(place, false, 1e-9);
        through.Perform();
        return through.Curve();
    };
    const Handle(Geom_BSplineCurve) low = side(-t / 2), top = side(t / 2);
    BRepBuilderAPI_MakeWire wire(
        BRepBuilderAPI_MakeEdge(low).Edge(), BRepBuilderAPI_MakeEdge(low->EndPoint(), top->EndPoint()).Edge(),
        BRepBuilderAPI_MakeEdge(top).Edge(), BRepBuilderAPI_MakeEdge(top->StartPoint(), low->StartPoint()).Edge());
    write_solid(file,
                BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face(),
                                      gp_Vec(0, wave * random.between(0.5, 2), 0))
                    .Shape(),
                CadForm::step);
}

DrawnSolid write_drawn_solid(const std::filesystem::path& file, std::uint64_t seed, CadForm form)
{
    static const char* const kinds[] = {"cup",  "flanged cup", "stepped cup",    "cone",
                                        "dome", "box",         "box with draft", "box with a brim"};
    SeededRandom random(seed);
    const OcctSession session;
    const int kind = int(seed % 8);
    DrawnSolid solid;
    const double t = solid.thickness = 0.6 * std::pow(4., random.between(0, 1));
    solid.kind = fmt::format("{} {}, {:.3g} mm thick", kinds[kind], seed, t);
    if (kind < 5) {
        const Profile profile = round_section(random, kind, t);
        solid.middle_area = swept_area(profile);
        write_solid(file, turned(profile, t), form);
    } else {
        const TopoDS_Shape shape = made(random_box(random, kind, t), t);
        if (kind == 5)
            solid.middle_area = area_from_volume(shape, t);
        write_solid(file, shape, form);
    }
    return solid;
}

} // namespace spia::shapes

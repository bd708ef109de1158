// Sinks that a border, another hole or a bend cuts, at either skin: what is cut is the hole below.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <initializer_list>
#include <map>
#include <numbers>
#include <string>

#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/profile.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {
namespace {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Cutout;
using shapes::Sink;
using std::numbers::pi;

constexpr double k = 0.42;

/// What of a sink is in the sheet.
enum class Cut { none, sink_only, half, on_border, less_than_half, sink_alone, another_hole, bend };

const char* name(Cut cut)
{
    constexpr const char* names[] = {"whole",
                                     "a border cuts the sink alone",
                                     "a border cuts both",
                                     "on a border",
                                     "less than half is there",
                                     "the sink alone is there",
                                     "a hole cuts both",
                                     "a bend cuts the sink"};
    return names[size_t(cut)];
}

/// A bracket with a row of round holes or slots through its bend, along the sheet's normal or
/// askew.
BentSolid drilled_bend(std::uint64_t seed)
{
    shapes::SeededRandom random(seed + 800);
    BentSolid solid;
    const double t = solid.thickness = random.between(1, 5), inner = t * random.between(0.8, 4);
    solid.kind = fmt::format("drilled bend {}", seed);
    solid.pose = seed;
    solid.leg = {60, 50};
    solid.bend = {{inner, random.between(0.7, 1.7) * (random.coin() ? 1 : -1)}};
    const double arc = (inner + t / 2) * std::abs(solid.bend[0].angle);
    const bool slots = random.coin(), askew = random.coin();
    const int count = random.whole(1, 4);
    const double across = arc * random.between(0.15, 0.5), along = slots ? across * random.between(1.2, 2) : across;
    solid.width = count * (along + 3 * t);
    for (int i = 0; i < count; ++i) {
        shapes::BendCut cut;
        cut.y = (i + 0.5) * solid.width / count;
        cut.outline.length = across;
        cut.outline.width = along;
        cut.outline.radius = across / 2;
        cut.lean = askew ? random.between(-0.4, 0.4) : 0;
        cut.pitch = askew ? random.between(-0.2, 0.2) : 0;
        solid.bend_cut.push_back(cut);
    }
    return solid;
}

/// One in a flat plate, an L or the web of a U, at a given skin.
BentSolid cut_sink(std::uint64_t seed, int bends, bool left, bool counterbore, Cut cut)
{
    shapes::SeededRandom random(seed + 7000);
    BentSolid solid;
    solid.kind = fmt::format("seed {}, {} bends, {} side, {}, {}", seed, bends, left ? "left" : "right",
                             counterbore ? "counterbore" : "countersink", name(cut));
    const double t = solid.thickness = random.between(1.5, 4);
    Sink sink;
    sink.left = left;
    sink.counterbore = counterbore;
    sink.hole = t * random.between(1, 2);
    sink.depth = t * random.between(0.3, 0.8);
    sink.wide = sink.hole + (counterbore ? t * random.between(0.6, 1.5)
                                         : sink.depth * std::tan(random.between(0.6, cut == Cut::bend ? 0.7 : 1.05)));
    const double leg = 6 * sink.wide, ring = sink.wide - sink.hole, share = random.between(0.3, 0.7);
    solid.width = 5 * sink.wide;
    solid.leg = {leg, 3 * sink.wide, 3 * sink.wide};
    solid.leg.resize(size_t(bends) + 1);
    if (bends == 2)
        std::swap(solid.leg[0], solid.leg[1]);
    sink.leg = bends == 2 ? 1 : 0;
    for (int b = 0; b < bends; ++b)
        // Over the hollow side of a sharp bend a sink would be cut into the other leg.
        solid.bend.push_back({t * (cut == Cut::bend ? random.between(2, 3) : random.between(0.5, 2)),
                              random.between(0.6, cut == Cut::bend ? 1 : 1.6)});
    const std::map<Cut, double> y = {{Cut::sink_only, sink.hole + share * ring},
                                     {Cut::half, share * sink.hole},
                                     {Cut::on_border, 0},
                                     {Cut::less_than_half, -share * sink.hole},
                                     {Cut::sink_alone, -sink.hole - share * ring}};
    sink.centre = {leg * random.between(0.48, 0.52), y.contains(cut) ? y.at(cut) : solid.width / 2};
    if (cut == Cut::bend)
        sink.centre.x() = leg - sink.hole - share * ring;
    if (cut == Cut::another_hole) {
        Cutout hole;
        hole.leg = sink.leg;
        hole.radius = 0.8 * sink.hole;
        hole.length = hole.width = 2 * hole.radius;
        hole.centre = sink.centre + Eigen::Vector2d(1.3 * sink.hole, 0);
        solid.cutout = {hole};
    }
    solid.sink = {sink};
    return solid;
}

/// mm2, what of a circle is on one side of a line. @param from  mm, its centre from the line
double segment(double radius, double from)
{
    const double h = std::clamp(from / radius, -1., 1.);
    return radius * radius * (pi - std::acos(h) + h * std::sqrt(1 - h * h));
}

/// mm2, of the holes in closed form.
double holes_of(const BentSolid& solid)
{
    const Sink& sink = solid.sink.front();
    double area = segment(sink.hole, sink.centre.y());
    if (!solid.cutout.empty()) {
        const double r = sink.hole, s = solid.cutout[0].radius, d = solid.cutout[0].centre.x() - sink.centre.x(),
                     x = (d * d + r * r - s * s) / (2 * d); // both circles meet there
        area += pi * s * s - (pi * r * r - segment(r, x)) - (pi * s * s - segment(s, d - x));
    }
    return area;
}

/// mm, how far within the circle of the sink the border of the part is off the hole.
double off_hole(const BentSolid& solid, const TriMesh& part)
{
    const Sink& sink = solid.sink.front();
    shapes::Profile profile({0, 0}, 0);
    profile.straight(solid.leg[0]);
    for (size_t b = 0; b < solid.bend.size(); ++b)
        profile.bend(solid.bend[b].inner_radius + solid.thickness / 2, solid.bend[b].angle).straight(solid.leg[b + 1]);
    const auto& leg = profile.pieces()[2 * size_t(sink.leg)];
    const Eigen::Vector2d centre = profile.at(leg.from + sink.centre.x()),
                          along(std::cos(leg.heading), std::sin(leg.heading));
    const double r = sink.hole, c = sink.centre.y(), shortest = std::abs(c) < r ? std::sqrt(r * r - c * c) : 0;
    double off = 0;
    for (const std::vector<int>& loop : boundary_loops(part))
        for (const int v : loop) {
            const Eigen::Vector3d p = part.position.col(v);
            const Eigen::Vector2d from = Eigen::Vector2d(p.x(), p.z()) - centre;
            const double s = along.dot(from), y = p.y() - c, distance = std::hypot(s, y);
            if (std::abs(from.x() * along.y() - from.y() * along.x()) > solid.thickness / 4 ||
                distance > 1.01 * sink.wide)
                continue; // of another leg, or far away
            double own = std::abs(distance - r);
            if (std::abs(p.y()) < 1e-6)
                own = std::max(0., shortest - std::abs(s));
            if (!solid.cutout.empty())
                own = std::min(own, std::abs(std::hypot(s - (solid.cutout[0].centre.x() - sink.centre.x()), y) -
                                             solid.cutout[0].radius));
            off = std::max(off, own);
        }
    return off;
}

void expect_hole(const ScratchFolder& folder, const BentSolid& solid, CadForm form)
{
    SCOPED_TRACE(solid.kind + (form == CadForm::step ? ", STEP" : ", STL"));
    const auto file = folder / (std::string("part") + extension(form));
    shapes::write_bent_solid(file, solid, form);
    const Session session = solved_part(file, {}, constant_k(k));
    const PartFile& part = *session.part;
    ASSERT_TRUE(part.solid);
    EXPECT_TRUE(part.doubts.empty()) << part.doubts.front();
    // Of a mesh, where chords of two holes meet, less than they are off their arcs.
    EXPECT_LT(off_hole(solid, part.mesh), form == CadForm::step ? 1e-5 : 0.02);
    ASSERT_EQ(session.bends->bends.size(), solid.bend.size());
    for (const SheetBend& bend : session.bends->bends) {
        EXPECT_TRUE(bend.laid) << bend.why_not;
        EXPECT_TRUE(std::ranges::any_of(solid.bend, [&](const shapes::SolidBend& own) {
            return std::abs(own.inner_radius - bend.inner_radius) < 2e-3 && std::abs(own.angle - bend.angle) < 1e-3;
        })) << bend.inner_radius;
    }
    const Blank& blank = session.blank->blank;
    const Eigen::Vector2d size = blank.position.rowwise().maxCoeff() - blank.position.rowwise().minCoeff();
    const double length = solid.developed(k), width = solid.width;
    EXPECT_NEAR(size.maxCoeff(), std::max(length, width), form == CadForm::step ? 1e-4 : 1e-2);
    EXPECT_NEAR(size.minCoeff(), std::min(length, width), form == CadForm::step ? 1e-4 : 1e-2);
    if (form == CadForm::step) { // chords of 3 degrees, of a whole circle those of the sink
        const Sink& sink = solid.sink.front();
        const double chords = sink.centre.y() > sink.wide ? 0.01 : 1e-3;
        const double holes = holes_of(solid);
        EXPECT_NEAR(area(TriMesh{blank.position.colwise().homogeneous(), part.mesh.triangle}), length * width - holes,
                    chords * holes + 1e-3);
    }
}

/// Of a single one that something cuts off: measured, and nothing else said of it.
void expect_told(const ScratchFolder& folder, const BentSolid& solid)
{
    SCOPED_TRACE(solid.kind);
    shapes::write_bent_solid(folder / "part.step", solid);
    const PartFile part = read_part(folder / "part.step");
    const Finding* told = part.doctor.find(Fault::mark);
    ASSERT_TRUE(told);
    ASSERT_EQ(told->what.size(), 1u);
    const Sink& sink = solid.sink.front();
    EXPECT_TRUE(told->what[0].starts_with(sink.counterbore ? "counterbore" : "countersink")) << told->what[0];
    double wide = 0, depth = 0, hole = 0;
    ASSERT_EQ(
        std::sscanf(told->what[0].c_str(), "%*s %lf mm wide, %lf mm deep, of a hole of %lf", &wide, &depth, &hole), 3)
        << told->what[0];
    EXPECT_NEAR(wide, 2 * sink.wide, 1e-3 * sink.wide);
    EXPECT_NEAR(depth, sink.depth, 2e-3 * solid.thickness);
    EXPECT_NEAR(hole, 2 * sink.hole, 1e-3 * sink.hole);
    EXPECT_TRUE(told->what[0].ends_with("cuts it off")) << told->what[0];
    EXPECT_NE(told->text.find("has the least diameter of each"), std::string::npos) << told->text;
    for (const std::string& note : part.notes)
        EXPECT_TRUE(note.find(" open at ") == std::string::npos) << note;
    EXPECT_FALSE(part.solid->marks.empty());
}

/// A sink that ends the given length, mm, beyond the beginning of the bend of an L.
BentSolid into_bend(std::uint64_t seed, double thickness, const shapes::SolidBend& bend, double within, Sink sink)
{
    BentSolid solid;
    solid.kind = fmt::format("seed {}", seed);
    solid.thickness = thickness;
    solid.leg = {6 * sink.wide, 4 * sink.wide};
    solid.width = 5 * sink.wide;
    solid.bend = {bend};
    sink.centre = {solid.leg[0] + within - sink.wide, solid.width / 2};
    solid.sink = {sink};
    return solid;
}

void expect_measured(const ScratchFolder& folder, const BentSolid& solid)
{
    expect_hole(folder, solid, CadForm::step);
    expect_told(folder, solid);
}

/// At either skin of a plate, an L and a U, cut in each of these ways.
void expect_holes(std::uint64_t seed, bool counterbore, CadForm form, std::initializer_list<Cut> cuts)
{
    const ScratchFolder folder;
    for (const int bends : {0, 1, 2})
        for (const bool left : {true, false})
            for (const Cut cut : cuts)
                if (cut != Cut::bend || bends > 0)
                    expect_hole(folder, cut_sink(++seed, bends, left, counterbore, cut), form);
}

} // namespace

TEST(SunkHoles, ThatAreCutLeaveTheHoleBelowThemWhicheverSkinTheyAreAt)
{
    expect_holes(0, false, CadForm::step,
                 {Cut::none, Cut::sink_only, Cut::half, Cut::on_border, Cut::less_than_half, Cut::sink_alone,
                  Cut::another_hole, Cut::bend});
}

TEST(SunkHoles, ThatAreCutLeaveTheHoleBelowThemInMeshesAsWell)
{
    expect_holes(100, false, CadForm::stl, {Cut::sink_only, Cut::half, Cut::on_border, Cut::another_hole});
}

TEST(SunkHoles, ThatAreCounterboresAndCutLeaveTheHoleBelowThem)
{
    expect_holes(200, true, CadForm::step, {Cut::none, Cut::sink_only, Cut::half, Cut::on_border, Cut::less_than_half});
}

TEST(SunkHoles, ThatAreCounterboresAndRunIntoABendAreMeasuredAndToldOnce)
{
    // Of their wall, in the hollow of the bend, low chords are left beyond the plane of the skin.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        shapes::SeededRandom random(seed + 400);
        const double t = random.between(2, 4), inner = t * random.between(1, 2);
        Sink sink;
        sink.counterbore = sink.seam = true;
        sink.left = random.whole(0, 3) > 0;
        sink.hole = t * random.between(0.7, 1.2);
        sink.depth = t * random.between(0.35, 0.6);
        sink.wide = sink.hole + t * random.between(0.7, 1.5);
        const double within = std::min(0.6 * inner, 0.8 * (sink.wide - sink.hole)) * random.between(0.2, 1);
        expect_measured(folder, into_bend(seed, t, {inner, random.between(1.2, 1.6)}, within, sink));
    }
}

TEST(SunkHoles, ThatAreCountersinksAndEndUnderTheHollowOfABendAreTold)
{
    // The tool is no higher than that: its end, not the bend's skin, is over the cone.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        shapes::SeededRandom random(seed + 500);
        const double t = random.between(2, 4), inner = t * random.between(1, 2);
        Sink sink;
        sink.hole = t * random.between(0.7, 1.2);
        sink.depth = t * random.between(0.6, 0.9);
        sink.wide = sink.hole + sink.depth * std::tan(random.between(0.6, 0.8));
        sink.above = inner * random.between(0.06, 0.12);
        if (sink.hole + 0.4 * inner > sink.wide)
            continue; // the hole is in the bend
        expect_measured(folder, into_bend(seed, t, {inner, random.between(1.2, 1.6)}, 0.4 * inner, sink));
    }
}

TEST(SunkHoles, AreNoPlainHolesThroughBends)
{
    // The skin leans against their walls all around them, which are straight nevertheless.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const BentSolid solid = drilled_bend(seed);
        for (const CadForm form : {CadForm::step, CadForm::stl}) {
            SCOPED_TRACE(fmt::format("{}, {}", solid.kind, form == CadForm::stl ? "STL" : "STEP"));
            const auto file = folder / (std::string("part") + extension(form));
            shapes::write_bent_solid(file, solid, form);
            const PartFile part = read_part(file);
            ASSERT_TRUE(part.solid);
            EXPECT_EQ(part.doctor.boundary_loops, 1 + int(solid.bend_cut.size()));
            for (const std::vector<std::string>& texts : {part.doubts, part.notes})
                for (const std::string& text : texts)
                    EXPECT_EQ(text.find("sink"), std::string::npos) << text;
        }
    }
}

TEST(SunkHoles, ThatAreCutAtBothSkinsAreDoubted)
{
    const ScratchFolder folder;
    for (const int bends : {0, 1})
        for (const bool counterbore : {false, true}) {
            BentSolid solid = cut_sink(300, bends, true, counterbore, Cut::on_border);
            solid.sink.push_back(solid.sink.front());
            solid.sink.back().left = false;
            solid.sink.back().centre.y() = solid.width;
            SCOPED_TRACE(solid.kind);
            shapes::write_bent_solid(folder / "part.step", solid);
            const PartFile part = read_part(folder / "part.step");
            ASSERT_TRUE(part.solid);
            EXPECT_TRUE(std::ranges::any_of(part.doubts, [](const std::string& text) {
                return text.find("wider than the hole below") != std::string::npos;
            }));
        }
}

TEST(SunkHoles, ThatAreOpenToABorderAtBothSkinsLeaveItWhereItIs)
{
    // Both circles are open to it, the hole is not: what is laid is open as well, and doubted.
    const ScratchFolder folder;
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        for (const bool land : {true, false}) {
            shapes::SeededRandom random(seed + 600);
            BentSolid solid;
            const double t = solid.thickness = land ? random.between(2, 4) : 3;
            Sink sink;
            sink.hole = t * (land ? random.between(0.8, 1.2) : 1);
            sink.depth = t * (land ? random.between(0.38, 0.46) : 0.5);
            sink.wide = sink.hole + sink.depth * (land ? std::tan(random.between(0.7, 0.9)) : 1);
            solid.leg = {16 * sink.wide, 60};
            solid.bend = {{2 * t, 1.2}};
            solid.width = 12 * sink.wide;
            sink.centre = {8 * sink.wide, sink.hole + random.between(0.3, 0.8) * (sink.wide - sink.hole)};
            solid.sink = {sink, sink};
            solid.sink[1].left = false;
            SCOPED_TRACE(fmt::format("seed {}, {}", seed, land ? "a straight wall" : "none"));
            shapes::write_bent_solid(folder / "part.step", solid);
            const Session session = solved_part(folder / "part.step", {}, constant_k(k));
            const PartFile& part = *session.part;
            ASSERT_TRUE(part.solid);
            const auto said = [&](const char* words) {
                return std::ranges::any_of(
                    part.doubts, [&](const std::string& text) { return text.find(words) != std::string::npos; });
            };
            EXPECT_TRUE(said("open at a border")) << fmt::format("{}", fmt::join(part.doubts, "; "));
            EXPECT_FALSE(said("sunk in"));
            for (const auto& [mark, label] : part.solid->marks)
                EXPECT_LT((mark.rowwise().maxCoeff() - mark.rowwise().minCoeff()).norm(), 4 * sink.wide);
            const double open = std::sqrt(sink.wide * sink.wide - sink.centre.y() * sink.centre.y());
            const TriMesh& mesh = part.mesh;
            for (const std::vector<int>& loop : boundary_loops(mesh))
                for (size_t i = 0; i < loop.size(); ++i) {
                    const Eigen::Vector3d p = mesh.position.col(loop[i]);
                    const double x = p.x() - sink.centre.x(); // the leg is along x
                    const bool of_hole =
                        std::abs(p.z()) < t / 4 && std::hypot(x, p.y() - sink.centre.y()) < 0.999 * sink.wide;
                    if (p.y() > sink.centre.y() + sink.wide || of_hole)
                        continue;
                    EXPECT_NEAR(p.y(), 0, 1e-6);
                    EXPECT_GT(std::abs(x), 0.999 * open);
                }
        }
}

} // namespace spia

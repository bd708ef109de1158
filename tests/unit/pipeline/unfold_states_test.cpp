#include "engine/pipeline/unfold_states.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <random>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/unfold/plan/sequence.h"
#include "tests/support/bent_parts.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

class UnfoldStates : public testing::Test {
protected:
    UnfoldStates() : part(shapes::lipped_box()), steps(propose_sequence(part, find_bends(part)).steps)
    {
        options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        run = run_unfolding(part, steps, options);
    }
    void write() { write_unfold_states(file, part, options, steps, run); }
    KeptStates read(const UnfoldScript& script) { return read_unfold_states(file, part, options, script); }

    std::string content()
    {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    void put(const std::string& bytes)
    {
        std::ofstream stream(file, std::ios::binary);
        stream.write(bytes.data(), std::streamsize(bytes.size()));
    }

    ScratchFolder scratch;
    std::filesystem::path file = scratch / "states.cbor";
    TriMesh part;
    UnfoldScript steps;
    FlattenOptions options;
    UnfoldRun run;
};

void expect_same(const UnfoldState& a, const UnfoldState& b)
{
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.face.strain_equivalent, b.face.strain_equivalent);
    EXPECT_EQ(a.face.thickness, b.face.thickness);
    EXPECT_EQ(a.face.stress_minor, b.face.stress_minor);
    EXPECT_EQ(a.face.direction_major, b.face.direction_major);
    EXPECT_EQ(a.face.necking, b.face.necking);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.plain, b.plain);
    EXPECT_EQ(a.converged, b.converged);
    EXPECT_EQ(a.reason, b.reason);
    EXPECT_EQ(a.friction_share, b.friction_share);
    EXPECT_EQ(a.system, b.system);
    EXPECT_EQ(a.trusted_strain, b.trusted_strain);
    EXPECT_EQ(a.necking, b.necking);
    EXPECT_EQ(a.overlap.places, b.overlap.places);
    EXPECT_EQ(a.overlap.landed, b.overlap.landed);
    EXPECT_EQ(a.overlap.first, b.overlap.first);
    EXPECT_EQ(a.reach.farthest_mm, b.reach.farthest_mm);
    EXPECT_EQ(a.reach.without_room, b.reach.without_room);
    EXPECT_EQ(a.seconds, b.seconds);
    ASSERT_EQ(a.on.has_value(), b.on.has_value());
    if (!a.on)
        return;
    EXPECT_EQ(a.on->distance_mm, b.on->distance_mm);
    EXPECT_EQ(a.on->angle, b.on->angle);
    EXPECT_EQ(name(a.on->face), name(b.on->face));
    for (const Eigen::Vector3d& x : {Eigen::Vector3d(3, 2, 1), Eigen::Vector3d(-1, 4, 2)}) {
        EXPECT_EQ(developed(a.on->face, x), developed(b.on->face, x));
        EXPECT_EQ(placed(a.on->face, x.head<2>()), placed(b.on->face, x.head<2>()));
        EXPECT_EQ(outer_normal(a.on->face, x), outer_normal(b.on->face, x));
    }
}

} // namespace

TEST_F(UnfoldStates, AreReadBackToTheLastBit)
{
    ASSERT_GE(run.states.size(), 3U);
    run.states[0].converged = false;
    run.states[0].reason = "because";
    run.states[0].necking = 7;
    run.states[0].friction_share = 0.75;
    run.states[0].system = SolvedSystem::relaxed;
    run.states[0].trusted_strain = 0.25;
    run.states[0].overlap = {3, {1, 2, 3}, 2};
    run.states[0].reach = {4.5, 6};
    write();
    const KeptStates kept = read(steps);
    ASSERT_EQ(kept.keep, steps.size());
    EXPECT_EQ(kept.why, "");
    ASSERT_EQ(kept.run.states.size(), run.states.size());
    for (size_t k = 0; k < steps.size(); ++k)
        expect_same(run.states[k], kept.run.states[k]);
}

TEST_F(UnfoldStates, KeepEveryKindOfTarget)
{
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX();
    Eigen::Matrix<double, 3, 2> axes;
    axes << z, x;
    const TargetSurface faces[] = {PlaneFace{{1, 2, 3}, axes}, CylinderFace{{1, 0, 2}, z, x, 7, false},
                                   ConeFace{{0, 1, 2}, z, x, 0.4, true},
                                   HeightFace{{1, 1, 1}, axes, {-4, -5}, 3, Eigen::MatrixXd::Random(6, 5)}};
    for (const TargetSurface& face : faces) {
        run.states[0].on = TargetFit{face, 0.25, 0.125};
        steps[0].pick.target = face;
        write();
        const KeptStates kept = read(steps);
        ASSERT_EQ(kept.keep, steps.size()) << name(face) << kept.why;
        expect_same(run.states[0], kept.run.states[0]);
    }
    auto height = std::get<HeightFace>(faces[3]);
    height.coefficient(2, 2) += 1e-9;
    steps[0].pick.target = height;
    EXPECT_EQ(read(steps).keep, 0U) << "a target moved by a hair";
}

TEST_F(UnfoldStates, HoldUpToTheFirstStepThatIsAnotherOne)
{
    write();
    UnfoldScript script = steps;
    script[0].name = "called otherwise";
    script[2].tolerance = 1e-7;
    const KeptStates kept = read(script);
    EXPECT_EQ(kept.keep, 2U);
    EXPECT_EQ(kept.why, "step 3 has changed");
    const UnfoldRun again = run_unfolding(part, script, options, {}, &kept.run, kept.keep),
                    whole = run_unfolding(part, script, options);
    ASSERT_EQ(again.states.size(), whole.states.size());
    for (size_t k = 0; k < whole.states.size(); ++k) {
        EXPECT_EQ(again.states[k].position, whole.states[k].position) << k;
        EXPECT_EQ(again.states[k].face.strain_major, whole.states[k].face.strain_major) << k;
        EXPECT_EQ(again.states[k].step, whole.states[k].step) << k;
    }
    script = steps;
    script[1].pick.freed.pop_back();
    EXPECT_EQ(read(script).keep, 1U);
    script = steps;
    script[1].pick.friction = ContactRegion{"", {}, 2., {}, 0.1};
    EXPECT_EQ(read(script).keep, 1U);
    script = steps;
    script[0].offset_mm = 1;
    EXPECT_EQ(read(script).keep, 0U);
    script = steps;
    script[1].extent_mm = 20;
    EXPECT_EQ(read(script).keep, 1U);
    script = steps;
    script.push_back(script.back());
    EXPECT_EQ(read(script).why, fmt::format("step {} was not done", script.size()));
}

TEST_F(UnfoldStates, DoNotHoldForAnotherPartOrSheet)
{
    write();
    TriMesh moved = part;
    moved.position(0, 5) = std::nextafter(moved.position(0, 5), 1e9);
    EXPECT_EQ(read_unfold_states(file, moved, options, steps).why, "the part has changed");
    FlattenOptions other = options;
    other.thickness = 1.1;
    EXPECT_EQ(read_unfold_states(file, part, other, steps).why, "the sheet or the options have changed");
    other = options;
    other.process.rolling = Eigen::Vector3d::UnitX();
    EXPECT_EQ(read_unfold_states(file, part, other, steps).keep, 0U);
    other = options;
    other.material.r90 += 0.1;
    EXPECT_EQ(read_unfold_states(file, part, other, steps).keep, 0U);
}

TEST_F(UnfoldStates, AMissingOrDamagedFileIsSaid)
{
    EXPECT_THROW(read(steps), InputError);
    put("no cbor");
    EXPECT_THROW(read(steps), InputError);
    put(std::string(3'000'000, '\x81')); // lists in lists in lists
    EXPECT_THROW(read(steps), InputError);
    UnfoldRun no_number = run;
    no_number.states[1].position(0, 0) = std::numeric_limits<double>::quiet_NaN();
    write_unfold_states(file, part, options, steps, no_number);
    EXPECT_THROW(read(steps), InputError);
    write();
    const std::string good = content();
    std::mt19937 draw(7);
    for (int k = 0; k < 200; ++k) {
        put(good.substr(0, draw() % good.size()));
        EXPECT_THROW(read(steps), InputError) << k;
    }
    for (int k = 0; k < 300; ++k) {
        std::string bad = good;
        const size_t at = draw() % (k % 2 ? bad.size() : 4000);
        bad[at] = char(bad[at] ^ char(1 << (k % 8))); // one bit: most are numbers, and another
                                                      // number is no fault of form
        put(bad);
        EXPECT_THROW(read(steps), InputError) << at;
    }
}

} // namespace spia

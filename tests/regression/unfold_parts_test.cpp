// Bent and flanged real parts, unfolded step by step without help: what came out when it was last
// looked at. A change of these figures needs a reason in the commit.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>

#include "engine/exchange/read_part.h"
#include "engine/forming/material/material_library.h"
#include "engine/unfold/automatic_unfolding.h"

namespace spia::unfold_parts_test {
namespace {

const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/data";

struct BentPart {
    const char* file;
    LengthUnit unit;
    size_t steps;
    double strain;       ///< greatest equivalent one
    double within;       ///< of it
    Eigen::Vector2d box; ///< mm, of the blank
};

std::ostream& operator<<(std::ostream& out, const BentPart& part) { return out << part.file; }

class BentParts : public testing::TestWithParam<BentPart> {};

} // namespace

TEST_P(BentParts, UnfoldByThemselvesWithoutAFlip)
{
    const BentPart& expected = GetParam();
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the real parts are not here: " << folder;
    ReadOptions read;
    read.unit = expected.unit;
    const PartFile part = read_part(folder / expected.file, read);
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    const AutomaticUnfolding unfolded = automatic_unfolding(part.mesh, find_bends(part.mesh), {}, options);
    EXPECT_EQ(unfolded.run.failure, "");
    EXPECT_EQ(unfolded.run.states.size(), expected.steps);
    for (const UnfoldState& state : unfolded.run.states)
        EXPECT_TRUE(state.converged) << state.name << ": " << state.reason;
    ASSERT_TRUE(unfolded.run.blank);
    EXPECT_EQ(unfolded.run.flipped, 0);
    EXPECT_EQ(unfolded.run.states.back().overlap.places, 0);
    EXPECT_NEAR(unfolded.run.states.back().face.strain_equivalent.maxCoeff(), expected.strain, expected.within);
    const Eigen::Matrix2Xd& flat = unfolded.run.blank->position;
    const Eigen::Vector2d box = flat.rowwise().maxCoeff() - flat.rowwise().minCoeff();
    EXPECT_LT((box - expected.box).cwiseAbs().maxCoeff(), 1e-3 * expected.box[0]) << box.transpose();
}

using enum LengthUnit;
INSTANTIATE_TEST_SUITE_P(SharedData, BentParts,
                         testing::Values(BentPart{"fe/crash_box_upper.k", mm, 4, 0.0232, 0.001, {274.4, 248.2}},
                                         BentPart{"fe/support_panel.bdf", mm, 2, 0.0853, 0.002, {620.9, 259.2}},
                                         BentPart{"fe/support_trough.bdf", mm, 4, 1e-4, 1e-4, {658.5, 158.5}},
                                         BentPart{"fe/aileron_skin.inp", mm, 1, 1e-5, 1e-5, {2661, 1025.7}},
                                         BentPart{"fe/recliner_bracket.k", mm, 2, 0.638, 0.02, {248.7, 226.2}},
                                         BentPart{"fe/drawn_cone_28k.k", mm, 3, 0.541, 0.02, {339.9, 161.1}},
                                         BentPart{"fe/mudguard_front.stl", m, 1, 0.282, 0.005, {619.4, 567.6}}),
                         [](const auto& param) {
                             std::string name = param.param.file;
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                             return name;
                         });

} // namespace spia::unfold_parts_test

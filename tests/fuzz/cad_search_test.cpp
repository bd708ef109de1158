#include "tests/fuzz/cad_search.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <string_view>
#include <unistd.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "tests/fuzz/cad_target.h"

namespace spia::fuzz {
namespace {

class Cad : public testing::TestWithParam<const char*> {};

TEST_P(Cad, DamagedFilesAreReadOrRefusedOrEndInTheirOwnProcess)
{
    constexpr int files = 2000;
    const CadSearch found = search_cad(GetParam(), 0, files);
    EXPECT_EQ(found.files, files);
    EXPECT_GT(found.accepted, files / 100) << "small changes often hurt nothing";
    EXPECT_GT(found.refused, files / 20) << "and often do";
    // OpenCASCADE's BREP reader crashes on every fiftieth, the others on one in four hundred; so
    // must ours not.
    EXPECT_LT(found.crashed, files / (std::string_view(GetParam()) == "brep" ? 25 : 150));
    EXPECT_LE(found.endless, files / 500);
}

TEST_P(Cad, SeedsAreGood)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("spia-seed-" + std::to_string(::getpid()) + "." + GetParam());
    for (const std::string& seed : cad_target(GetParam()).seeds) {
        std::ofstream(file, std::ios::binary) << seed;
        EXPECT_TRUE(read_and_examine(file)) << seed;
    }
    std::filesystem::remove(file);
}

/// Files that once kept the program busy without end, or broke it: tests/fuzz/found/NAME, with the
/// ending of its format.
TEST_P(Cad, WhatOnceBrokeItIsAnsweredAtOnce)
{
    const std::string ending = std::string(".") + GetParam();
    for (const auto& entry : std::filesystem::directory_iterator(SPIA_SOURCE_DIR "/tests/fuzz/found"))
        if (entry.path().extension() == ending) {
            SCOPED_TRACE(entry.path());
            const auto stop = std::make_shared<std::atomic<bool>>(false);
            const auto start = std::chrono::steady_clock::now();
            const Progress time_limit(
                [&](double, std::string_view) {
                    *stop = std::chrono::steady_clock::now() - start > std::chrono::seconds(20);
                },
                stop);
            try {
                for (const Eigen::Vector3d& place : read_cad(entry.path(), {}, {}, {}, time_limit).soup.position)
                    ASSERT_TRUE(place.allFinite());
            } catch (const InputError& error) { // in words, not by the end of the process that
                                                // reads it
                for (const char* bad : {"crashed", "ended from outside", "given up after"})
                    EXPECT_EQ(std::string(error.what()).find(bad), std::string::npos) << error.what();
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Every, Cad, testing::Values("step", "igs", "brep"),
                         [](const auto& each) { return each.param; });

} // namespace
} // namespace spia::fuzz

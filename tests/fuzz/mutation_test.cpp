#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/mutate.h"

namespace spia::fuzz {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void expect_bounded_memory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 2'000'000) << "kilobytes: some damage led to a huge allocation";
}

class Format : public testing::TestWithParam<std::string> {};

TEST_P(Format, DamagedFilesAreReadOrRefusedWithAWord)
{
    const FuzzTarget& target = fuzz_target(GetParam());
    const char* wanted = std::getenv("SPIA_FUZZ_ROUNDS"); // for a longer search, e.g. with the
                                                          // sanitizers
    const int rounds = wanted ? std::atoi(wanted) : 20000;
    std::mt19937 random(20250117);
    int accepted = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::string content = damaged(target.seeds[size_t(round) % target.seeds.size()], target.spice, random);
        try {
            accepted += target.read(content);
        } catch (const std::exception& other) {
            FAIL() << "round " << round << ": " << other.what() << "\n" << content;
        }
    }
    EXPECT_GT(accepted, rounds / 200) << "small changes often hurt nothing";
    EXPECT_LT(accepted, rounds - rounds / 20) << "and often do";
    expect_bounded_memory();
}

TEST_P(Format, SeedsAreGood)
{
    for (const std::string& seed : fuzz_target(GetParam()).seeds)
        EXPECT_TRUE(fuzz_target(GetParam()).read(seed)) << seed;
}

/// Files that once broke a reader: tests/fuzz/found/NAME, with the ending of its format.
TEST_P(Format, WhatOnceBrokeItIsReadOrRefused)
{
    for (const auto& entry : fs::directory_iterator(SPIA_SOURCE_DIR "/tests/fuzz/found"))
        if (entry.path().filename().string().ends_with("." + GetParam())) {
            SCOPED_TRACE(entry.path());
            EXPECT_NO_THROW(fuzz_target(GetParam()).read(content_of(entry.path())));
        }
    expect_bounded_memory();
}

TEST_P(Format, NoiseAndEndlessLinesAreRefused)
{
    std::mt19937 random(7);
    std::string noise(1 << 18, ' '), blanks = noise;
    for (char& c : noise)
        c = char(random());
    for (const std::string& text : {noise, blanks, std::string(1 << 18, ','), std::string(1 << 16, '\n'),
                                    std::string(1 << 16, '['), std::string("\n")})
        EXPECT_FALSE(fuzz_target(GetParam()).read(text)) << text.substr(0, 10);
}

std::vector<std::string> names()
{
    std::vector<std::string> result;
    for (const FuzzTarget& target : fuzz_targets())
        result.push_back(target.name);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Every, Format, testing::ValuesIn(names()), [](const auto& parameter) {
    std::string name = parameter.param;
    for (char& c : name)
        c = std::isalnum(c) ? c : '_';
    return name;
});

} // namespace
} // namespace spia::fuzz

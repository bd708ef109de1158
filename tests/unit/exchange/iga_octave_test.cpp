#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>

#include "engine/exchange/iga/write_geopdes.h"
#include "engine/exchange/iga/write_gismo.h"
#include "engine/exchange/iga/write_mfem.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/joined_patches.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

struct Answer {
    int exit = -1;
    std::string text;
};

Answer run(const std::string& command)
{
    Answer answer;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe)
        return answer;
    char part[4096];
    for (size_t n; (n = fread(part, 1, sizeof part, pipe)) > 0;)
        answer.text.append(part, n);
    const int status = pclose(pipe);
    answer.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return answer;
}

const std::string octave = "octave-cli --no-history --quiet --no-window-system ";

/// Why octave-nurbs cannot be asked; empty if it can.
const std::string& without_octave()
{
    static const std::string why =
        run(octave + "--eval 'pkg load nurbs' 2>&1").exit == 0
            ? ""
            : "octave with the package nurbs is not installed (Debian: octave, octave-nurbs)";
    return why;
}

/// Every sample in the three formats that octave reads.
std::vector<std::string> write_all(const ScratchFolder& folder, const patches::Sample& sample)
{
    std::string stem = sample.name;
    for (char& c : stem)
        c = c == ' ' ? '-' : c;
    const std::vector<std::string> files = {(folder / (stem + ".txt")).string(), (folder / (stem + ".xml")).string(),
                                            (folder / (stem + ".mesh")).string()};
    write_geopdes(files[0], sample.patches);
    write_gismo(files[1], sample.patches);
    write_mfem(files[2], sample.patches);
    return files;
}

TEST(IgaInOctave, HasTheSamePoints)
{
    if (!without_octave().empty())
        GTEST_SKIP() << without_octave();
    constexpr int n = 7;
    const ScratchFolder folder;
    std::string command = octave + SPIA_SOURCE_DIR "/tests/support/octave/evaluate_patches.m " + std::to_string(n);
    std::vector<Eigen::Vector3d> wanted;
    for (const patches::Sample& sample : patches::samples())
        for (const std::string& file : write_all(folder, sample)) {
            command += " " + file;
            for (const NurbsSurface& patch : sample.patches.patch)
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        wanted.push_back(evaluate(patch, i / (n - 1.), j / (n - 1.)).position);
        }
    const Answer answer = run(command);
    ASSERT_EQ(answer.exit, 0) << answer.text;
    std::istringstream text(answer.text);
    double worst = 0;
    for (const Eigen::Vector3d& point : wanted) {
        Eigen::Vector3d found;
        ASSERT_TRUE(text >> found.x() >> found.y() >> found.z());
        worst = std::max(worst, (found - point).norm());
    }
    EXPECT_LT(worst, 1e-12 * 400) << "mm, on surfaces of some 400 mm";
    RecordProperty("worst_mm", std::to_string(worst));
}

class CheckedInOctave : public testing::TestWithParam<patches::Sample> {};

TEST_P(CheckedInOctave, IsReadableWithoutAGap)
{
    const std::string check = SPIA_SOURCE_DIR "/../shared/tools/check_nurbs_octave.m";
    if (!std::filesystem::exists(check))
        GTEST_SKIP() << "no " << check;
    if (!without_octave().empty())
        GTEST_SKIP() << without_octave();
    const ScratchFolder folder;
    const size_t joints = GetParam().patches.interfaces.size();
    for (const std::string& file : write_all(folder, GetParam())) {
        // Rational control points of GeoPDEs are products; divided again they differ by rounding.
        const Answer answer = run(octave + check + " " + file + " 1e-12 2>&1");
        EXPECT_EQ(answer.exit, 0) << answer.text;
        EXPECT_NE(answer.text.find("result: READABLE"), std::string::npos) << answer.text;
        if (GetParam().patches.patch.size() > 1) {
            EXPECT_NE(answer.text.find("found by nrbmultipatch: " + std::to_string(joints) + "\n"), std::string::npos)
                << answer.text;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Every, CheckedInOctave, testing::ValuesIn(patches::samples()), [](const auto& parameter) {
    std::string name = parameter.param.name;
    for (char& c : name)
        c = c == ' ' ? '_' : c;
    return name;
});

} // namespace
} // namespace spia

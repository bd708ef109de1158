#include "app/viewer/animation.h"

#include <GLFW/glfw3.h>
#include <cstdlib>
#include <fstream>
#include <gif_lib.h>
#include <gtest/gtest.h>
#include <numeric>
#include <sstream>
#include <thread>

#include "app/viewer/render/gif_file.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/ui/hidden_window.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

/// As giflib's reader finds it: the pictures, each laid over the one before.
struct ReadGif {
    int width = 0, height = 0;
    std::vector<std::vector<std::array<uint8_t, 3>>> picture;
    std::vector<int> delay; ///< hundredths of a second
    bool repeats = false;
};
ReadGif read_gif(const fs::path& file)
{
    ReadGif result;
    int error = 0;
    GifFileType* gif = DGifOpenFileName(file.c_str(), &error);
    if (!gif || DGifSlurp(gif) == GIF_ERROR)
        throw Error("giflib cannot read " + file.string());
    result.width = gif->SWidth;
    result.height = gif->SHeight;
    std::vector<std::array<uint8_t, 3>> shown(size_t(gif->SWidth) * size_t(gif->SHeight));
    for (int k = 0; k < gif->ImageCount; ++k) {
        const SavedImage& image = gif->SavedImages[k];
        const GifImageDesc& at = image.ImageDesc;
        for (int y = 0; y < at.Height; ++y)
            for (int x = 0; x < at.Width; ++x) {
                const GifColorType& c = gif->SColorMap->Colors[image.RasterBits[y * at.Width + x]];
                shown[size_t(at.Top + y) * size_t(gif->SWidth) + size_t(at.Left + x)] = {c.Red, c.Green, c.Blue};
            }
        result.picture.push_back(shown);
        GraphicsControlBlock control{};
        DGifSavedExtensionToGCB(gif, k, &control);
        result.delay.push_back(control.DelayTime);
        for (int e = 0; e < image.ExtensionBlockCount; ++e)
            result.repeats |= image.ExtensionBlocks[e].Function == APPLICATION_EXT_FUNC_CODE;
    }
    DGifCloseFile(gif, nullptr);
    return result;
}

/// So many bands of colour, from left to right, shifted.
Picture bands(int width, int height, int shift)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int band = (x + shift) / 4;
            for (const int c : {40 * (band % 7), 10 * (band % 25), 255 - 20 * (band % 12), 255})
                picture.rgba.push_back(uint8_t(c));
        }
    return picture;
}

TEST(GifFile, HoldsThePicturesAsTheyAreWhereColoursAreFew)
{
    const ScratchFolder folder;
    constexpr int width = 61, height = 37, frames = 5;
    std::vector<Picture> pictures;
    for (int k = 0; k < frames; ++k)
        pictures.push_back(bands(width, height, k));
    pictures[3] = pictures[2]; // nothing has changed
    GifColours colours(pictures);
    EXPECT_LE(colours.colours().size(), 256u);
    GifWriter writer(width, height, colours);
    for (const Picture& picture : pictures)
        writer.add(colours.raster(picture), 7);
    std::ofstream(folder / "bands.gif", std::ios::binary) << writer.end();
    const ReadGif read = read_gif(folder / "bands.gif");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_TRUE(read.repeats);
    EXPECT_EQ(read.delay, std::vector<int>(frames, 7));
    ASSERT_EQ(read.picture.size(), size_t(frames));
    int worst = 0;
    for (size_t k = 0; k < frames; ++k)
        for (size_t p = 0; p < read.picture[k].size(); ++p)
            for (size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(int(read.picture[k][p][c]) - int(pictures[k].rgba[4 * p + c])));
    EXPECT_EQ(worst, 0) << "84 colours have room";
}

TEST(GifFile, ManyColoursAreMetNearly)
{
    Picture all{256, 256, {}};
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            for (const int c : {x, y, 128, 255})
                all.rgba.push_back(uint8_t(c));
    GifColours colours({all});
    EXPECT_EQ(colours.colours().size(), 256u);
    const std::vector<uint8_t> raster = colours.raster(all);
    double sum = 0;
    for (size_t p = 0; p < raster.size(); ++p)
        for (size_t c = 0; c < 3; ++c) {
            const double d = double(all.rgba[4 * p + c]) - double(colours.colours()[raster[p]][c]);
            sum += d * d;
        }
    // 16 x 16 squares of 16 x 16 colours would be off by sqrt(2 * 16^2 / 12) = 6.5 in the mean.
    EXPECT_LT(std::sqrt(sum / double(raster.size())), 10);
}

TEST(GifFile, DelaysAddUpToTheTime)
{
    for (const auto& [pictures, seconds] : {std::pair{48, 4.}, {7, 1.}, {95, 7.92}, {3, 0.5}}) {
        const std::vector<int> delays = gif_delays(pictures, seconds);
        EXPECT_EQ(int(delays.size()), pictures);
        EXPECT_NEAR(std::accumulate(delays.begin(), delays.end(), 0), 100 * seconds, 1);
    }
    for (const int delay : gif_delays(100, 0.1))
        EXPECT_EQ(delay, 2) << "no program shows them faster";
}

class AnimationFile : public testing::Test {
protected:
    AnimationFile() { state.document = document_of(dome, Stage::solve); }
    std::vector<fs::path> make(const SaveAnimation& wanted, double cancel_at = 2)
    {
        Animation animation(wanted, state, [] {});
        double before = -1;
        while (!animation.ended()) {
            animation.draw_next(renderer, model);
            EXPECT_GE(animation.fraction(), before);
            before = animation.fraction();
            if (before >= cancel_at)
                animation.cancel();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return animation.take();
    }
    HiddenWindow window;
    Renderer renderer;
    ViewerModel model{SPIA_SOURCE_DIR "/assets", [] {}};
    ViewerState state;
    ScratchFolder folder;
};

TEST_F(AnimationFile, ShowsThePartBecomeTheBlankAndComeBack)
{
    const SaveAnimation wanted{folder / "dome.gif", 6, 1, 160, 120, false, true};
    const auto files = make(wanted);
    ASSERT_EQ(files, std::vector<fs::path>{folder / "dome.gif"});
    const ReadGif gif = read_gif(files[0]);
    EXPECT_EQ(gif.width, 160);
    EXPECT_EQ(gif.height, 120);
    ASSERT_EQ(gif.picture.size(), 10u) << "six there, four back";
    EXPECT_NE(gif.picture[0], gif.picture[5]);
    for (int k = 1; k < 5; ++k)
        EXPECT_EQ(gif.picture[size_t(5 - k)], gif.picture[size_t(5 + k)]) << "the same way back";
    const auto succeeds = [](const std::string& command) {
        return std::system((command + " > /dev/null").c_str()) == 0;
    };
    if (succeeds("command -v identify")) {
        EXPECT_TRUE(succeeds("identify " + files[0].string())) << "ImageMagick reads it";
    }
    if (succeeds("command -v file")) {
        EXPECT_TRUE(succeeds("file " + files[0].string() + " | grep 'GIF image data, version 89a, 160 x 120'"));
    }
}

TEST_F(AnimationFile, OrNumberedPictures)
{
    const auto files = make({folder / "dome.png", 4, 1, 80, 60, true, false});
    ASSERT_EQ(files.size(), 4u);
    EXPECT_EQ(files[0], folder / "dome-001.png");
    EXPECT_EQ(files[3], folder / "dome-004.png");
    for (const fs::path& file : files)
        EXPECT_GT(fs::file_size(file), 100u);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), fs::directory_iterator()), 4) << "and nothing else";
}

TEST_F(AnimationFile, CancelledItLeavesNothing)
{
    for (const char* name : {"dome.gif", "dome.png"}) {
        EXPECT_TRUE(make({folder / name, 20, 1, 80, 60, false, false}, 0.2).empty());
        EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), fs::directory_iterator()), 0) << name;
    }
}

TEST_F(AnimationFile, RefusesWhatCannotBe)
{
    EXPECT_THROW(Animation({folder / "x.gif", 500, 4, 4096, 4096}, state, [] {}), InputError) << "too large";
    EXPECT_THROW(Animation({folder / "no" / "x.gif"}, state, [] {}), ExchangeError) << "no such folder";
    state.document.session.blank = nullptr;
    EXPECT_THROW(Animation({folder / "x.gif"}, state, [] {}), InputError) << "nothing to show";
}

/// Turned and moved as a whole nothing is nearer to the part: its middle is that of the part, and
/// it is still the blank.
TEST_F(AnimationFile, TheBlankIsLaidBesideThePartUnchanged)
{
    const Document shown = blank_as_state(state.document);
    ASSERT_EQ(steps_done(shown), 1u);
    const Eigen::Matrix3Xd flat = unfolded_places(shown, 1), part = unfolded_places(shown, 0);
    const Eigen::Matrix2Xd& blank = state.document.session.blank->blank.position;
    const double size = bounding_diagonal(state.document.session.part->mesh);
    EXPECT_LT((flat.rowwise().mean() - part.rowwise().mean()).norm(), 1e-9 * size);
    for (Eigen::Index v = 1; v < blank.cols(); v += 7)
        EXPECT_NEAR((flat.col(v) - flat.col(0)).norm(), (blank.col(v) - blank.col(0)).norm(), 1e-9 * size);
    const auto off = [&](const Eigen::Matrix3Xd& places) { return (places - part).squaredNorm(); };
    const Eigen::Vector3d middle = flat.rowwise().mean();
    for (int axis = 0; axis < 3; ++axis)
        for (const double angle : {-0.01, 0.01}) {
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
            Eigen::Matrix3Xd turned = turn * (flat.colwise() - middle);
            turned.colwise() += middle;
            EXPECT_GT(off(turned), off(flat));
        }
}

} // namespace
} // namespace spia::viewer

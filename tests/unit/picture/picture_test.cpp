#include "engine/picture/picture.h"

#include <gtest/gtest.h>
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "engine/core/colour_map.h"
#include "engine/core/error.h"
#include "engine/picture/canvas.h"
#include "engine/picture/stroke_font.h"
#include "tests/support/known_surfaces.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/sample_chain.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

struct Image {
    int width = 0, height = 0;
    std::vector<unsigned char> bytes;

    Eigen::Vector3d colour(int x, int y) const
    {
        const unsigned char* p = &bytes[size_t(3 * (x + y * width))];
        return Eigen::Vector3d(p[0], p[1], p[2]) / 255;
    }
    bool white(int x, int y) const { return colour(x, y).minCoeff() == 1; }
    int drawn(int left, int top, int right, int bottom) const
    {
        int count = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                count += !white(x, y);
        return count;
    }
};

Image decoded(const std::string& png)
{
    Image image;
    int channels = 0;
    unsigned char* bytes = stbi_load_from_memory(reinterpret_cast<const unsigned char*>(png.data()), int(png.size()),
                                                 &image.width, &image.height, &channels, 3);
    EXPECT_NE(bytes, nullptr);
    if (bytes)
        image.bytes.assign(bytes, bytes + 3 * image.width * image.height);
    stbi_image_free(bytes);
    return image;
}

Eigen::Matrix3d corners(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
    Eigen::Matrix3d corner;
    corner << a, b, c;
    return corner;
}

struct PixelBox {
    int left, right, top, bottom;
};

/// Of what is drawn in the second panel, below the titles and above the legend.
PixelBox box_of_blank(const Image& image)
{
    PixelBox box{image.width, 0, image.height, 0};
    for (int y = 80; y < 440; ++y)
        for (int x = 510; x < 990; ++x)
            if (!image.white(x, y)) {
                box.left = std::min(box.left, x), box.right = std::max(box.right, x + 1);
                box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y + 1);
            }
    return box;
}

const auto red = [](const Eigen::Vector3d&) { return Eigen::Vector3d(1, 0, 0); };
const auto blue = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 1); };

} // namespace

TEST(Canvas, TwoTrianglesFillTheirRectangleWithoutGap)
{
    for (const bool clockwise : {false, true}) {
        Canvas canvas(100, 80);
        const Eigen::Vector3d a(10, 20, 0), b(73, 20, 0), c(73, 61, 0), d(10, 61, 0);
        canvas.triangle(clockwise ? corners(a, c, b) : corners(a, b, c), red);
        canvas.triangle(clockwise ? corners(a, d, c) : corners(a, c, d), red);
        const Image image = decoded(canvas.png());
        ASSERT_EQ(image.width, 100);
        ASSERT_EQ(image.height, 80);
        EXPECT_EQ(image.drawn(0, 0, 100, 80), 63 * 41);
        for (int y = 20; y < 61; ++y)
            for (int x = 10; x < 73; ++x)
                ASSERT_EQ(image.colour(x, y), Eigen::Vector3d(1, 0, 0)) << x << " " << y;
    }
}

TEST(Canvas, WhatIsNearerIsSeenInWhateverOrderItIsDrawn)
{
    const Eigen::Vector3d a(0, 0, 0), b(60, 0, 0), c(0, 60, 0), z(0, 0, 5);
    for (const bool near_first : {false, true}) {
        Canvas canvas(40, 40);
        if (near_first)
            canvas.triangle(corners(a + z, b + z, c + z), red);
        canvas.triangle(corners(a, b, c), blue);
        if (!near_first)
            canvas.triangle(corners(a + z, b + z, c + z), red);
        canvas.line({5, 5, 2}, {15, 5, 2}, {.width = 3});              // behind: not seen
        canvas.line({5, 15, 2}, {15, 15, 2}, {.width = 3, .lift = 4}); // lifted in front
        canvas.line({5, 22, 2}, {15, 22, 2}, {.width = 3, .hidden = false});
        const Image image = decoded(canvas.png());
        EXPECT_EQ(image.colour(10, 5), Eigen::Vector3d(1, 0, 0));
        EXPECT_EQ(image.colour(10, 15), Eigen::Vector3d(0, 0, 0));
        EXPECT_EQ(image.colour(10, 22), Eigen::Vector3d(0, 0, 0));
    }
}

TEST(Canvas, WhatLiesOutsideIsCutOff)
{
    Canvas canvas(20, 20);
    canvas.triangle(corners({-100, -100, 0}, {100, -100, 0}, {10, 100, 0}), red);
    canvas.line({-50, 10, 1}, {70, 10, 1}, {.width = 4});
    canvas.text("outside", -30, 500, 12, {0, 0, 0});
    EXPECT_EQ(decoded(canvas.png()).drawn(0, 0, 20, 20), 400);
}

TEST(StrokeFont, EveryLetterOfOurTitlesHasStrokesOfItsOwn)
{
    std::vector<std::string> shapes;
    for (const char letter : std::string("abcdefghijklmnopqrstuvwxyz0123456789ABINPRSU%-+.,:/")) {
        const std::string_view word(&letter, 1);
        const auto segments = stroke_font::segments(word);
        ASSERT_FALSE(segments.empty()) << letter;
        std::ostringstream shape;
        for (const auto& [from, to] : segments) {
            shape << from.transpose() << " " << to.transpose() << ";";
            EXPECT_LE(std::max(from.x(), to.x()), stroke_font::width(word)) << letter;
            EXPECT_LE(std::max(from.y(), to.y()), stroke_font::capital_height) << letter;
        }
        EXPECT_EQ(std::count(shapes.begin(), shapes.end(), shape.str()), 0) << letter;
        shapes.push_back(shape.str());
    }
    EXPECT_GT(stroke_font::width("mm"), 2 * stroke_font::width("m"));
}

TEST(Picture, BlankHasItsAreaAndTheColoursOfItsThinning)
{
    // A flat rectangle of 400 x 200 mm whose thinning rises along x from 0 to 20 %.
    const ScratchFolder folder;
    const TriMesh part = shapes::rectangle(400, 200, 40, 20);
    Blank blank{part.position.topRows(2)};
    SheetFields fields = samples::smooth_fields(part.vertices());
    fields.thinning = 0.2 * part.position.row(0) / 400;
    write_picture(folder / "x.png", {"rectangle", &part, &blank, &fields});
    const Image image = decoded(content_of(folder / "x.png"));

    ASSERT_EQ(image.width, 2 * 500);
    const auto [left, right, top, bottom] = box_of_blank(image);
    EXPECT_NEAR(right - left, 452, 3); // panel less margins, and half a boundary line
    EXPECT_NEAR(bottom - top, 226, 3);
    EXPECT_EQ(image.drawn(510, 80, 990, 440), (right - left) * (bottom - top));
    // Contours every 2 % (levels k / 50 of the value): look half way between them. Colours run from
    // the second to the last but one column of vertices, since each of the 41 holds more than a
    // hundredth of them: over the whole range.
    for (const double thinning : {0.03, 0.07, 0.11, 0.15}) {
        const int x = 524 + int(452 * thinning / 0.2);
        const Eigen::Vector3d expected = viridis(thinning / 0.2);
        EXPECT_LT((image.colour(x, (top + bottom) / 2) - expected).cwiseAbs().maxCoeff(), 0.02) << thinning;
    }
    int darker = 0; // contour lines on a row across the blank
    for (int x = left + 4; x < right - 4; ++x) {
        const double sum = image.colour(x, top + 60).sum();
        darker += sum < image.colour(x - 3, top + 60).sum() - 0.1 && sum < image.colour(x + 3, top + 60).sum() - 0.1;
    }
    EXPECT_GE(darker, 9);
}

TEST(Picture, BlankLiesAsItsCoordinatesSay)
{
    // An L, whose points spread widest along a slanting line.
    TriMesh part;
    part.position.resize(3, 6);
    part.position << 0, 400, 400, 80, 80, 0, 0, 0, 80, 80, 200, 200, 0, 0, 0, 0, 0, 0;
    part.triangle.resize(3, 4);
    part.triangle << 0, 0, 0, 0, 1, 2, 3, 4, 2, 3, 4, 5;
    const Blank blank{part.position.topRows(2)};
    const SheetFields fields = samples::smooth_fields(part.vertices());
    const Image image = decoded(picture_png({"L", &part, &blank, &fields}));
    const auto [left, right, top, bottom] = box_of_blank(image);
    EXPECT_NEAR(right - left, 452, 3);
    EXPECT_NEAR(bottom - top, 226, 3);
    EXPECT_EQ(image.drawn(left, top, left + 2, bottom), 2 * (bottom - top)) << "its left edge is upright";
}

TEST(Picture, RoundingErrorsHaveNoContours)
{
    const TriMesh part = shapes::rectangle(400, 200, 40, 20);
    const Blank blank{part.position.topRows(2)};
    SheetFields fields = samples::smooth_fields(part.vertices());
    fields.thinning.setZero();
    const std::string even = picture_png({"rectangle", &part, &blank, &fields});
    fields.thinning = 1e-12 * part.position.row(0).array().sin();
    EXPECT_EQ(picture_png({"rectangle", &part, &blank, &fields}), even);
}

TEST(Picture, HasAPanelForEachShapeAndTheSameBytesTwice)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    ExportScene scene = chain.scene();
    testing::internal::CaptureStdout();
    write_picture(folder / "x.png", scene);
    const std::string first = content_of(folder / "x.png");
    write_picture(folder / "x.png", scene);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(content_of(folder / "x.png"), first);
    const Image image = decoded(first);
    EXPECT_EQ(image.width, 4 * 500);
    for (int panel = 0; panel < 4; ++panel) {
        // of 185 000 pixels
        EXPECT_GT(image.drawn(500 * panel, 80, 500 * (panel + 1), 450), 30'000) << panel;
        EXPECT_GT(image.drawn(500 * panel, 10, 500 * (panel + 1), 70), 500) << panel; // title
        EXPECT_EQ(image.drawn(500 * panel, 80, 500 * panel + 12, 450), 0) << panel;   // margin
    }
    scene.quad_mesh = nullptr;
    write_picture(folder / "x.png", scene);
    EXPECT_EQ(decoded(content_of(folder / "x.png")).width, 3 * 500);
}

TEST(Picture, OfSomePanelsIsThatPartOfTheWhole)
{
    const samples::Chain chain = samples::chain();
    ExportScene scene = chain.scene();
    const Image all = decoded(picture_png(scene)), sheet = decoded(picture_png(scene, Panels::sheet)),
                shape = decoded(picture_png(scene, Panels::shape));
    ASSERT_EQ(sheet.width, 2 * 500);
    ASSERT_EQ(sheet.height, all.height);
    ASSERT_EQ(shape.width, 2 * 500);
    ASSERT_EQ(shape.height, all.height - 100) << "no legend, for nothing has its colours";
    int sheet_differs = 0, shape_differs = 0; // by rounding, at the edges of what is drawn
    for (int y = 0; y < shape.height; ++y)
        for (int x = 0; x < 2 * 500; ++x) {
            sheet_differs += (sheet.colour(x, y) - all.colour(x, y)).norm() > 0.1;
            shape_differs += (shape.colour(x, y) - all.colour(1000 + x, y)).norm() > 0.1;
        }
    EXPECT_EQ(sheet_differs, 0);
    EXPECT_LT(shape_differs, 100) << "of 460 000 pixels";
    EXPECT_NE(picture_png(scene, Panels::sheet, LengthUnit::inch), picture_png(scene, Panels::sheet));
    scene.quad_mesh = nullptr;
    scene.surface = nullptr;
    scene.control_nets = {};
    EXPECT_EQ(picture_png(scene, Panels::shape), "") << "there is nothing to draw";
}

TEST(Picture, ShowsWherePatchesMeet)
{
    const ScratchFolder folder;
    const TriMesh part = shapes::rectangle(400, 200, 40, 20);
    Blank blank{part.position.topRows(2)};
    const SheetFields fields = samples::smooth_fields(part.vertices());
    const auto patch = [](double from, double to) {
        return surfaces::bilinear({from, 0, 0}, {to, 0, 0}, {from, 200, 0}, {to, 200, 0});
    };
    ExportScene scene{"rectangle", &part, &blank, &fields, nullptr, &part};
    const auto divided_at = [&](double x) {
        const std::vector<NurbsSurface> patches = {patch(0, x), patch(x, 400)};
        scene.control_nets = patches;
        write_picture(folder / "x.png", scene);
        return decoded(content_of(folder / "x.png"));
    };
    const Image left = divided_at(150), right = divided_at(250);
    struct Line { // what is red
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        int pixels = 0;
        Eigen::Vector2d middle() const { return sum / pixels; }
    };
    std::array<Line, 4> line; // in neither, in one, in the other, in both
    const auto red = [](const Image& image, int x, int y) {
        return image.colour(x, y)[0] - image.colour(x, y)[1] > 0.3;
    };
    for (int y = 80; y < 450; ++y)
        for (int x = 2 * 500; x < 3 * 500; ++x) {
            Line& here = line[size_t(red(left, x, y)) + 2 * size_t(red(right, x, y))];
            here.sum += Eigen::Vector2d(x, y);
            ++here.pixels;
        }
    EXPECT_GT(line[1].pixels, 80);
    EXPECT_NEAR(line[2].pixels, line[1].pixels, 0.1 * line[1].pixels);
    EXPECT_GT(line[3].pixels, 4 * line[1].pixels) << "the border is six times as long";
    EXPECT_LT(((line[1].middle() + line[2].middle()) / 2 - line[3].middle()).norm(), 3)
        << "about the middle of the sheet";
    EXPECT_GT((line[2].middle() - line[1].middle()).norm(), 40);
}

TEST(Picture, DoesNotDependOnWhereThePartLies)
{
    const ScratchFolder folder;
    samples::Chain chain = samples::chain();
    write_picture(folder / "here.png", chain.scene());
    const Image here = decoded(content_of(folder / "here.png"));
    const Eigen::Vector3d shift(-1024, 4096, 512); // exact in binary, so that only rounding differs
    chain.part.position.colwise() += shift;
    chain.quads.position.colwise() += shift;
    chain.surface.position.colwise() += shift;
    chain.net.control.colwise() += shift;
    write_picture(folder / "there.png", chain.scene());
    const Image there = decoded(content_of(folder / "there.png"));
    size_t different = 0;
    for (size_t i = 0; i < here.bytes.size(); ++i)
        different += std::abs(here.bytes[i] - there.bytes[i]) > 8;
    EXPECT_LT(different, here.bytes.size() / 1000);
}

TEST(Picture, AConstantFieldAndAFailureAreNoTrouble)
{
    const ScratchFolder folder;
    samples::Chain chain = samples::chain();
    chain.node.thinning.setConstant(0.05);
    write_picture(folder / "x.png", chain.scene());
    std::filesystem::remove(folder / "x.png");
    EXPECT_THROW(write_picture(folder / "no/such/x.png", chain.scene()), ExchangeError);
    chain.quads.position(0, 0) = INFINITY;
    EXPECT_THROW(write_picture(folder / "x.png", chain.scene()), InputError);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace spia

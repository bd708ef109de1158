#include <gtest/gtest.h>
#include <numbers>
#include <regex>

#include "engine/core/error.h"
#include "engine/exchange/lines/read_dxf.h"
#include "engine/exchange/lines/write_lines.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::line_files_test {
namespace {

using std::numbers::pi;

std::vector<SheetLine> two_lines(bool flat)
{
    Eigen::Matrix3Xd open(3, 4), closed(3, 3);
    open << 0.1, 100 / 3., 70, -8, 0, 5, 1e-3, 77, 1, 2, 3, 1 / 7.;
    closed << 0, 50, 25, 0, 0, 30, 9, 9, 9;
    if (flat) {
        open.row(2).setZero();
        closed.row(2).setZero();
    }
    return {{"bend 1, region 2", open, false}, {"hole", closed, true}};
}

std::string dxf_of(const std::string& entities, const std::string& header = "")
{
    return "  0\nSECTION\n  2\nHEADER\n" + header + "  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" + entities +
           "  0\nENDSEC\n  0\nEOF\n";
}

/// Group codes and values with blanks between.
std::string entity(const std::string& pairs)
{
    std::istringstream words(pairs);
    std::string text;
    for (std::string word; words >> word;)
        text += word + "\n";
    return text;
}

DxfLines read_text(const ScratchFolder& folder, const std::string& text)
{
    put(folder / "in.dxf", text);
    return read_dxf(folder / "in.dxf");
}

std::string fault_of(const ScratchFolder& folder, const std::string& text)
{
    try {
        read_text(folder, text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

/// The data of the entities of an IGES file, without the lines' back pointers.
std::string iges_parameters(const std::string& file)
{
    std::istringstream lines(file);
    std::string text;
    for (std::string line; std::getline(lines, line);)
        if (line.size() >= 73 && line[72] == 'P')
            text += line.substr(0, 64);
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
}

} // namespace

TEST(LineFiles, DxfLinesComeBackBitForBitInTheirLayers)
{
    const ScratchFolder folder;
    for (const bool flat : {true, false}) {
        const std::vector<SheetLine> lines = two_lines(flat);
        write_lines_dxf(folder / "x.dxf", lines);
        const std::string text = content_of(folder / "x.dxf");
        EXPECT_EQ(text.find("LWPOLYLINE") != std::string::npos, flat);
        const DxfLines read = read_dxf(folder / "x.dxf");
        EXPECT_TRUE(read.left_out.empty());
        ASSERT_EQ(read.lines.size(), 2u);
        EXPECT_EQ(read.lines[0].name.substr(0, 16), "bend 1_ region 2");
        for (size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(read.lines[k].closed, lines[k].closed);
            ASSERT_EQ(read.lines[k].point.cols(), lines[k].point.cols());
            EXPECT_EQ((read.lines[k].point - lines[k].point).cwiseAbs().maxCoeff(), 0) << "flat: " << flat;
        }
        std::vector<std::string> handles;
        const std::regex handle("\n  5\n([0-9A-F]+)\n");
        for (std::sregex_iterator it(text.begin(), text.end(), handle), end; it != end; ++it)
            handles.push_back((*it)[1]);
        std::sort(handles.begin(), handles.end());
        EXPECT_GT(handles.size(), 10u);
        const auto twice = std::adjacent_find(handles.begin(), handles.end());
        EXPECT_EQ(twice, handles.end()) << "handle " << *twice;
        write_lines_dxf(folder / "inch.dxf", lines, LengthUnit::inch);
        const DxfLines inch = read_dxf(folder / "inch.dxf");
        for (size_t k = 0; k < 2; ++k)
            EXPECT_LT((inch.lines[k].point - lines[k].point).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(LineFiles, LinesOfALayerAreToldApartByNumbers)
{
    const ScratchFolder folder;
    const DxfLines read =
        read_text(folder, dxf_of(entity("0 CIRCLE 8 holes 10 7 20 8 40 5") + entity("0 LINE 8 0 10 1 20 2 11 4 21 6") +
                                 entity("0 LINE 8 slot 10 1 20 2 11 4 21 6") +
                                 entity("0 CIRCLE 8 holes 10 1 20 8 40 5") + entity("0 LINE 8 0 10 1 20 2 11 5 21 6")));
    std::vector<std::string> names;
    for (const SheetLine& line : read.lines)
        names.push_back(line.name);
    EXPECT_EQ(names, (std::vector<std::string>{"holes line 1", "line 1", "slot", "holes line 2", "line 2"}));
}

TEST(LineFiles, CirclesArcsAndBulgesAreRound)
{
    const ScratchFolder folder;
    const DxfLines read = read_text(
        folder, dxf_of(entity("0 CIRCLE 8 holes 10 7 20 8 40 5") + entity("0 ARC 10 0 20 0 40 10 50 350 51 80") +
                       entity("0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 30 20 0 42 1 10 30 20 10 10 0 20 10 42 1") +
                       entity("0 LINE 8 cut 10 1 20 2 30 3 11 4 21 6 31 3") + entity("0 SPLINE 8 0 0 SPLINE")));
    ASSERT_EQ(read.lines.size(), 4u);
    EXPECT_EQ(read.left_out, std::vector<std::string>{"2 SPLINE"});
    EXPECT_TRUE(read.lines[0].closed);
    EXPECT_EQ(read.lines[0].name, "holes");
    EXPECT_NEAR(length(read.lines[0]), 10 * pi, 2e-5 * 10 * pi);
    for (const auto p : read.lines[0].point.colwise())
        EXPECT_NEAR((p - Eigen::Vector3d(7, 8, 0)).norm(), 5, 1e-12);
    EXPECT_FALSE(read.lines[1].closed);
    EXPECT_NEAR(length(read.lines[1]), 10 * pi / 2, 2e-5 * 10 * pi) << "across zero degrees";
    EXPECT_NEAR(
        (read.lines[1].point.rightCols<1>() - 10 * Eigen::Vector3d(std::cos(80 * pi / 180), std::sin(80 * pi / 180), 0))
            .norm(),
        0, 1e-12);
    EXPECT_TRUE(read.lines[2].closed) << "a slot: two sides, two half circles to the right of the way";
    EXPECT_NEAR(length(read.lines[2]), 60 + 10 * pi, 2e-5 * 10 * pi);
    EXPECT_NEAR(read.lines[2].point.row(0).maxCoeff(), 35, 1e-3);
    EXPECT_NEAR(read.lines[2].point.row(0).minCoeff(), -5, 1e-3);
    EXPECT_NEAR(length(read.lines[3]), 5, 1e-15);
}

TEST(LineFiles, EllipsesAreReadWithTheirEnds)
{
    const ScratchFolder folder;
    const DxfLines read =
        read_text(folder, dxf_of(entity("0 ELLIPSE 8 a 10 5 20 6 30 1 11 0 21 4 31 0 40 0.5 41 0 42 6.283185 "
                                        "0 ELLIPSE 8 b 10 0 20 0 30 0 11 3 21 0 31 0 40 0.5 41 4.712388980384690 "
                                        "42 1.570796326794897")));
    ASSERT_EQ(read.lines.size(), 2u);
    EXPECT_TRUE(read.lines[0].closed);
    for (const auto& x : read.lines[0].point.colwise()) {
        EXPECT_NEAR(std::pow((x[0] - 5) / 2, 2) + std::pow((x[1] - 6) / 4, 2), 1, 1e-12);
        EXPECT_EQ(x[2], 1);
    }
    const Eigen::Matrix3Xd& half = read.lines[1].point;
    EXPECT_FALSE(read.lines[1].closed);
    EXPECT_LT((half.col(0) - Eigen::Vector3d(0, -1.5, 0)).norm(), 1e-12);
    EXPECT_LT((half.rightCols<1>() - Eigen::Vector3d(0, 1.5, 0)).norm(), 1e-12);
    EXPECT_GT(half.row(0).minCoeff(), -1e-12) << "over the right side";
    EXPECT_NEAR(half.row(0).maxCoeff(), 3, 1e-3);
}

TEST(LineFiles, SplinesAreReadByTheirPoles)
{
    const ScratchFolder folder;
    // A quarter circle as a rational spline, a cubic that is x^3 over [0, 2], a closed quadratic
    // with knots that are not clamped.
    const std::string
        quarter = "0 SPLINE 8 q 70 4 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.7071067811865476 41 1 "
                  "10 5 20 0 30 2 10 5 20 5 30 2 10 0 20 5 30 2 ",
        cubic = "0 SPLINE 8 c 210 0 220 0 230 -1 71 3 40 0 40 0 40 0 40 0 40 2 40 2 40 2 40 2 "
                "10 0 20 0 30 0 10 0.66666666666666663 20 0 30 0 10 1.3333333333333333 20 0 30 0 10 2 20 8 30 0 ",
        ring = "0 SPLINE 8 r 70 3 71 2 40 -2 40 -1 40 0 40 1 40 2 40 3 40 4 40 5 40 6 "
               "10 1 20 0 10 0 20 1 10 -1 20 0 10 0 20 -1 10 1 20 0 10 0 20 1 ";
    const DxfLines read = read_text(folder, dxf_of(entity(quarter + cubic + ring)));
    ASSERT_EQ(read.lines.size(), 3u) << (read.left_out.empty() ? "" : read.left_out[0]);
    const Eigen::Matrix3Xd &q = read.lines[0].point, &c = read.lines[1].point, &r = read.lines[2].point;
    EXPECT_EQ(q.col(0), Eigen::Vector3d(5, 0, 2));
    EXPECT_LT((q.rightCols<1>() - Eigen::Vector3d(0, 5, 2)).norm(), 1e-14);
    for (Eigen::Index k = 0; k < q.cols(); ++k) {
        EXPECT_NEAR(q.col(k).head<2>().norm(), 5, 1e-13);
        if (k > 0) {
            EXPECT_GT(((q.col(k) + q.col(k - 1)) / 2).head<2>().norm(), 5 - 2e-4) << "the chord";
        }
    }
    for (const auto& x : c.colwise())
        EXPECT_NEAR(x[1], std::pow(x[0], 3), 1e-13);
    EXPECT_EQ(c(0, c.cols() - 1), 2);
    EXPECT_GT(c.cols(), 20);
    EXPECT_TRUE(read.lines[2].closed);
    EXPECT_LT((r.col(0) - Eigen::Vector3d(0.5, 0.5, 0)).norm(), 1e-14) << "between its first poles";
    EXPECT_LT(std::abs(r.rowwise().sum()[0]) / double(r.cols()), 0.05) << "all around";
    EXPECT_GT(r.row(0).maxCoeff() - r.row(0).minCoeff(), 1.4);
}

TEST(LineFiles, ASplineThatIsNoneIsLeftOut)
{
    const ScratchFolder folder;
    const std::string poles = "10 0 20 0 10 1 20 0 10 1 20 1 ";
    for (const std::string& numbers :
         {std::string("71 2 40 0 40 0 40 0 40 1 40 1 "), std::string("71 2 40 0 40 1 40 0 40 1 40 1 40 1 "),
          std::string("71 2 40 0 40 0 40 0 40 0 40 0 40 0 "), std::string("71 99 40 0 40 1 "),
          std::string("71 0 40 0 40 0 40 1 40 1 "), std::string("71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0 41 1 "),
          std::string("71 2 11 0 21 0 11 1 21 1 ")}) {
        const DxfLines read = read_text(folder, dxf_of(entity("0 SPLINE 8 s " + numbers + poles)));
        EXPECT_TRUE(read.lines.empty()) << numbers;
        EXPECT_EQ(read.left_out, std::vector<std::string>{"1 SPLINE"}) << numbers;
    }
}

TEST(LineFiles, UnitsOfTheHeaderCount)
{
    const ScratchFolder folder;
    const std::string line = entity("0 LINE 10 0 20 0 11 1 21 0");
    for (const auto& [number, mm] : {std::pair{"1", 25.4}, {"4", 1.0}, {"5", 10.0}, {"6", 1000.0}, {"0", 1.0}})
        EXPECT_NEAR(
            length(read_text(folder, dxf_of(line, std::string("  9\n$INSUNITS\n 70\n") + number + "\n")).lines[0]), mm,
            1e-12);
    EXPECT_NE(fault_of(folder, dxf_of(line, "  9\n$INSUNITS\n 70\n2\n")).find("$INSUNITS 2"), std::string::npos);
}

TEST(LineFiles, WhatIsNoDxfIsRefusedWithItsLine)
{
    const ScratchFolder folder;
    EXPECT_NE(fault_of(folder, "solid x\nfacet\n").find("line 1 is no group code"), std::string::npos);
    EXPECT_NE(fault_of(folder, "  0\nEOF\n").find("no section ENTITIES"), std::string::npos);
    EXPECT_NE(fault_of(folder, dxf_of(entity("0 LINE 10 0 20 zero 11 1 21 0"))).find("line 16 is \"zero\""),
              std::string::npos)
        << fault_of(folder, dxf_of(entity("0 LINE 10 0 20 zero 11 1 21 0")));
    const std::string whole = dxf_of(entity("0 LINE 10 0 20 0 11 1 21 0"));
    EXPECT_NE(fault_of(folder, whole.substr(0, whole.find("11\n1"))).find("cut off"), std::string::npos);
    EXPECT_THROW(read_dxf(folder / "none.dxf"), InputError);
}

TEST(LineFiles, IgesHoldsPolesKnotsAndNamesOfEveryLine)
{
    const ScratchFolder folder;
    const std::vector<SheetLine> lines = two_lines(false);
    write_lines_iges(folder / "x.iges", lines, "rail");
    const std::string text = content_of(folder / "x.iges"), data = iges_parameters(text);
    std::istringstream rows(text);
    for (std::string row; std::getline(rows, row);)
        EXPECT_EQ(row.size(), 80u);
    const std::regex entity("126,([0-9]+),1,([01]),([01]),1,0,([^;]*);");
    std::vector<std::smatch> found;
    for (std::sregex_iterator it(data.begin(), data.end(), entity), end; it != end; ++it)
        found.push_back(*it);
    ASSERT_EQ(found.size(), 2u) << data;
    for (size_t k = 0; k < 2; ++k) {
        const int last = std::stoi(found[k][1]), points = int(lines[k].point.cols()) + lines[k].closed;
        ASSERT_EQ(last, points - 1);
        EXPECT_EQ(found[k][3], lines[k].closed ? "1" : "0");
        std::vector<double> numbers;
        std::istringstream list(found[k][4]);
        for (std::string number; std::getline(list, number, ',');)
            numbers.push_back(std::stod(std::regex_replace(number, std::regex("D"), "E")));
        const auto poles = size_t(points + 2 + points); // knots, then weights
        for (int i = 0; i < points; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(numbers[poles + size_t(3 * i + c)], lines[k].point(c, i % lines[k].point.cols()));
        EXPECT_NEAR(numbers[size_t(points)], length(lines[k]), 1e-12) << "the last knot";
    }
    EXPECT_NE(data.find("16Hbend1,region2"), std::string::npos) << "the name (its blanks were taken out here)";
    EXPECT_NE(data.find("4Hhole"), std::string::npos);
}

TEST(LineFiles, StepHoldsPolesAndNamesOfEveryLine)
{
    const ScratchFolder folder;
    const std::vector<SheetLine> lines = two_lines(false);
    write_lines_step(folder / "x.step", lines, "rail");
    std::string text = content_of(folder / "x.step");
    text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
    for (const SheetLine& line : lines) {
        std::smatch curve;
        ASSERT_TRUE(std::regex_search(text, curve,
                                      std::regex("B_SPLINE_CURVE_WITH_KNOTS\\('" + line.name + "',1,\\(([^)]*)\\)")))
            << line.name;
        std::string list = curve[1];
        Eigen::Index i = 0;
        const std::regex reference("#[0-9]+");
        for (std::sregex_iterator it(list.begin(), list.end(), reference), end; it != end; ++it, ++i) {
            std::smatch point;
            ASSERT_TRUE(std::regex_search(
                text, point, std::regex(it->str() + " = CARTESIAN_POINT\\('',\\(([^,]*),([^,]*),([^)]*)\\)")));
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(std::stod(point[size_t(c + 1)]), line.point(c, i % line.point.cols()));
        }
        EXPECT_EQ(i, line.point.cols() + line.closed);
    }
    EXPECT_NE(text.find("GEOMETRIC_CURVE_SET"), std::string::npos);
}

TEST(LineFiles, LinesThatAreNoneAreRefusedBeforeAFileAppears)
{
    const ScratchFolder folder;
    std::vector<SheetLine> bad = {{"twice", Eigen::Matrix3Xd::Zero(3, 2), false}};
    EXPECT_THROW(write_lines_step(folder / "x.step", bad), InputError);
    EXPECT_THROW(write_lines_iges(folder / "x.iges", {}), InputError);
    bad[0].point(0, 0) = std::nan("");
    EXPECT_THROW(write_lines_dxf(folder / "x.dxf", bad), InputError);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace spia::line_files_test

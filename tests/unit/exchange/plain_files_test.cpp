#include <algorithm>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <regex>

#include "engine/core/error.h"
#include "engine/exchange/lines/write_dxf.h"
#include "engine/exchange/mesh/write_vtu.h"
#include "engine/exchange/text/write_csv.h"
#include "tests/unit/exchange/sample_chain.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        parts.push_back(part);
    return parts;
}

/// A reader of its own: base64, then an 8-byte length, then the numbers.
template <class Number> std::vector<Number> decoded(const std::string& base64)
{
    std::string bytes;
    unsigned bits = 0, held = 0;
    for (const char c : base64) {
        if (c == '=')
            break;
        const auto digit = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
        EXPECT_NE(digit, std::string::npos);
        bits = bits << 6 | unsigned(digit);
        if ((held += 6) >= 8)
            bytes += char(bits >> (held -= 8) & 255);
    }
    uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);
    EXPECT_EQ(length, bytes.size() - 8);
    std::vector<Number> numbers(length / sizeof(Number));
    std::memcpy(numbers.data(), bytes.data() + 8, length);
    return numbers;
}

struct VtuArray {
    std::string type, base64;
    int components;
};

/// The arrays of one element of the file by name; checks that tags close in order.
std::map<std::string, VtuArray> arrays_of(const std::string& file, const std::string& element)
{
    std::vector<std::string> open;
    std::map<std::string, VtuArray> result;
    const std::regex tag("<(/?)([A-Za-z]+)([^>]*)>([^<]*)");
    for (std::sregex_iterator it(file.begin(), file.end(), tag), end; it != end; ++it) {
        if ((*it)[1] == "/") {
            EXPECT_EQ(open.back(), (*it)[2]);
            open.pop_back();
            continue;
        }
        if ((*it)[2] == "DataArray" && open.back() == element) {
            std::map<std::string, std::string> attribute;
            const std::string attributes = (*it)[3];
            const std::regex pair("(\\w+)=\"([^\"]*)\"");
            for (std::sregex_iterator a(attributes.begin(), attributes.end(), pair); a != end; ++a)
                attribute[(*a)[1]] = (*a)[2];
            EXPECT_EQ(attribute["format"], "binary");
            result[attribute["Name"]] = {attribute["type"], (*it)[4], std::stoi(attribute["NumberOfComponents"])};
        }
        open.push_back((*it)[2]);
    }
    EXPECT_TRUE(open.empty());
    return result;
}

template <class Matrix>
void expect_array(const std::map<std::string, VtuArray>& arrays, const std::string& name, const Matrix& expected,
                  int components = 1)
{
    ASSERT_TRUE(arrays.count(name)) << name;
    EXPECT_EQ(arrays.at(name).components, components) << name;
    EXPECT_EQ(arrays.at(name).type, (std::is_same_v<typename Matrix::Scalar, double> ? "Float64" : "Int32")) << name;
    const auto read = decoded<typename Matrix::Scalar>(arrays.at(name).base64);
    ASSERT_EQ(Eigen::Index(read.size()), expected.size()) << name;
    EXPECT_TRUE(std::equal(read.begin(), read.end(), expected.data())) << name;
}

void expect_sheet_fields(const std::map<std::string, VtuArray>& arrays, const SheetFields& fields)
{
    expect_array(arrays, "thickness", fields.thickness);
    expect_array(arrays, "thinning", fields.thinning);
    expect_array(arrays, "strain_major", fields.strain_major);
    expect_array(arrays, "strain_minor", fields.strain_minor);
    expect_array(arrays, "strain_equivalent", fields.strain_equivalent);
    expect_array(arrays, "stress_major", fields.stress_major);
    expect_array(arrays, "stress_minor", fields.stress_minor);
    expect_array(arrays, "stress_equivalent", fields.stress_equivalent);
    expect_array(arrays, "direction_major", fields.direction_major, 3);
    expect_array(arrays, "necking", fields.necking);
}

/// Group code and value.
using DxfPair = std::pair<int, std::string>;

std::vector<DxfPair> dxf_pairs(const std::string& file)
{
    const auto lines = split(file, '\n');
    EXPECT_EQ(lines.size() % 2, 0u);
    std::vector<DxfPair> pairs;
    for (size_t i = 0; i + 1 < lines.size(); i += 2)
        pairs.emplace_back(std::stoi(lines[i]), lines[i + 1]);
    return pairs;
}

struct Polyline {
    std::string layer;
    bool closed = false;
    size_t announced = 0;
    std::vector<double> x, y;
};

std::vector<Polyline> polylines(const std::vector<DxfPair>& pairs)
{
    std::vector<Polyline> result;
    bool inside = false;
    for (const auto& [code, value] : pairs) {
        if (code == 0 && (inside = value == "LWPOLYLINE"))
            result.emplace_back();
        if (!inside)
            continue;
        Polyline& line = result.back();
        if (code == 8)
            line.layer = value;
        else if (code == 70)
            line.closed = std::stoi(value) & 1;
        else if (code == 90)
            line.announced = std::stoul(value);
        else if (code == 10)
            line.x.push_back(std::stod(value));
        else if (code == 20)
            line.y.push_back(std::stod(value));
    }
    return result;
}

/// The zones of the sample by a flat curve through its strains, so that several occur.
Zones zones_of(const samples::Chain& chain)
{
    const FormingLimitCurve curve = curve_through({-0.5, 0.1}, {0.15, 0.15}, false, "sample");
    return zones(chain.part, chain.face, &curve, {.margin = 0.05, .max_thickening = 0.01});
}

/// Each writer of this file on the sample, by name.
std::vector<std::pair<std::string, std::function<void(const std::filesystem::path&)>>> all_writers(
    const samples::Chain& chain)
{
    return {{"part.vtu", [&](const auto& path) { write_vtu(path, chain.part, chain.blank, chain.face, chain.node); }},
            {"outline.dxf",
             [&](const auto& path) {
                 write_dxf(path, {blank_outline(chain.part, chain.blank), {}, {}});
             }},
            {"outline.csv", [&](const auto& path) { write_outline_csv(path, blank_outline(chain.part, chain.blank)); }},
            {"fields.csv", [&](const auto& path) { write_fields_csv(path, chain.part, chain.blank, chain.node); }}};
}

} // namespace

TEST(Vtu, EveryNumberComesBackBitForBit)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const Eigen::VectorXd deviation = Eigen::VectorXd::LinSpaced(chain.part.vertices(), 1e-12, 1.0 / 3);
    const std::vector<NamedField> extra{{"a<b & \"c\"", &deviation}};
    write_vtu(folder / "x.vtu", chain.part, chain.blank, chain.face, chain.node, extra);
    const std::string file = content_of(folder / "x.vtu");

    const auto point = arrays_of(file, "PointData"), cell = arrays_of(file, "CellData");
    expect_sheet_fields(point, chain.node);
    expect_sheet_fields(cell, chain.face);
    expect_array(point, "blank_x", Eigen::VectorXd(chain.blank.position.row(0)));
    expect_array(point, "blank_y", Eigen::VectorXd(chain.blank.position.row(1)));
    expect_array(point, "a&lt;b &amp; &quot;c&quot;", deviation);
    expect_array(arrays_of(file, "Points"), "Points", chain.part.position, 3);
    expect_array(arrays_of(file, "Cells"), "connectivity", chain.part.triangle);
    const auto cells = arrays_of(file, "Cells");
    const auto offsets = decoded<int64_t>(cells.at("offsets").base64);
    const auto types = decoded<uint8_t>(cells.at("types").base64);
    ASSERT_EQ(offsets.size(), size_t(chain.part.triangles()));
    for (size_t f = 0; f < offsets.size(); ++f)
        EXPECT_EQ(offsets[f], int64_t(3 * (f + 1)));
    EXPECT_EQ(types, std::vector<uint8_t>(offsets.size(), 5)); // 5 is VTK's triangle
    EXPECT_NE(file.find("NumberOfPoints=\"" + std::to_string(chain.part.vertices()) + "\""), std::string::npos);
    EXPECT_NE(file.find("NumberOfCells=\"" + std::to_string(chain.part.triangles()) + "\""), std::string::npos);
}

TEST(Vtu, EveryFaceHasItsZoneAndItsDistanceToTheCurve)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    Zones judged = zones_of(chain);
    write_vtu(folder / "x.vtu", chain.part, chain.blank, chain.face, chain.node, {}, LengthUnit::inch, &judged);
    const std::string file = content_of(folder / "x.vtu");
    const auto cell = arrays_of(file, "CellData");
    Eigen::VectorXi number(chain.part.triangles());
    for (int f = 0; f < number.size(); ++f)
        number[f] = int(judged.zone[size_t(f)]);
    EXPECT_LT(number.minCoeff(), number.maxCoeff());
    expect_array(cell, "zone", number);
    expect_array(cell, "limit_distance", judged.distance); // a strain, whatever the unit
    std::string codes;
    for (const char c : std::string("7 crack, 6 risk, 5 marginal"))
        codes += std::to_string(int(c)) + " ";
    EXPECT_NE(file.find("Name=\"zone_names\" NumberOfTuples=\"1\" format=\"ascii\">" + codes), std::string::npos);
    judged.distance.resize(0); // without a curve
    write_vtu(folder / "y.vtu", chain.part, chain.blank, chain.face, chain.node, {}, LengthUnit::mm, &judged);
    EXPECT_EQ(arrays_of(content_of(folder / "y.vtu"), "CellData").count("limit_distance"), 0u);
    judged.zone.pop_back();
    EXPECT_THROW(
        write_vtu(folder / "z.vtu", chain.part, chain.blank, chain.face, chain.node, {}, LengthUnit::mm, &judged),
        InputError);
}

TEST(FacesCsv, RowsFollowTheFacesWithTheirZones)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    Zones judged = zones_of(chain);
    std::vector<int> number;
    for (int f = 0; f < chain.part.triangles(); ++f)
        number.push_back(2 * f + 5);
    write_faces_csv(folder / "x.csv", chain.part, chain.face, &judged, number);
    auto rows = split(content_of(folder / "x.csv"), '\n');
    EXPECT_EQ(rows[0], "face,x,y,z,thickness,thinning,strain_major,strain_minor,strain_equivalent,zone,limit_distance");
    ASSERT_EQ(rows.size(), size_t(chain.part.triangles()) + 1);
    for (int f = 0; f < chain.part.triangles(); ++f) {
        const auto cell = split(rows[size_t(f) + 1], ',');
        ASSERT_EQ(cell.size(), 11u);
        EXPECT_EQ(std::stoi(cell[0]), 2 * f + 5);
        const Eigen::Vector3d middle = chain.part.position(Eigen::all, chain.part.triangle.col(f)).rowwise().mean();
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(std::stod(cell[size_t(1 + k)]), middle[k], 1e-9);
        EXPECT_EQ(std::stod(cell[4]), chain.face.thickness[f]);
        EXPECT_EQ(std::stod(cell[7]), chain.face.strain_minor[f]);
        EXPECT_EQ(cell[9], name(judged.zone[size_t(f)]));
        EXPECT_EQ(std::stod(cell[10]), judged.distance[f]);
    }
    write_faces_csv(folder / "y.csv", chain.part, chain.face, nullptr, {}, LengthUnit::inch);
    rows = split(content_of(folder / "y.csv"), '\n');
    EXPECT_EQ(rows[0], "face,x_inch,y_inch,z_inch,thickness_inch,thinning,strain_major,strain_minor,strain_equivalent");
    EXPECT_NEAR(std::stod(split(rows[1], ',')[4]), chain.face.thickness[0] / 25.4, 1e-12);
    judged.distance.resize(0);
    write_faces_csv(folder / "z.csv", chain.part, chain.face, &judged);
    EXPECT_TRUE(split(content_of(folder / "z.csv"), '\n')[0].ends_with(",zone"));
    EXPECT_THROW(write_faces_csv(folder / "w.csv", chain.part, chain.node, &judged), InputError);
    EXPECT_THROW(write_faces_csv(folder / "w.csv", chain.part, chain.face, &judged, {1, 2}), InputError);
    judged.zone.pop_back();
    EXPECT_THROW(write_faces_csv(folder / "w.csv", chain.part, chain.face, &judged), InputError);
}

TEST(SkinsInFiles, AreSixColumnsMoreAndCellDataAndHaveToFit)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const Zones judged = zones_of(chain);
    SkinStrains skins;
    double next = 0.01;
    for (SkinFields* skin : {&skins.outer, &skins.inner})
        for (Eigen::VectorXd* field : {&skin->strain_major, &skin->strain_minor, &skin->strain_equivalent})
            *field = Eigen::VectorXd::LinSpaced(chain.part.triangles(), next, next + 0.005), next += 0.01;
    write_faces_csv(folder / "x.csv", chain.part, chain.face, &judged, {}, LengthUnit::inch, &skins);
    const auto rows = split(content_of(folder / "x.csv"), '\n');
    EXPECT_TRUE(rows[0].ends_with(",limit_distance,outer_strain_major,outer_strain_minor,outer_strain_equivalent,"
                                  "inner_strain_major,inner_strain_minor,inner_strain_equivalent"));
    const auto cell = split(rows.back(), ',');
    ASSERT_EQ(cell.size(), 17u);
    EXPECT_EQ(std::stod(cell[11]), skins.outer.strain_major[chain.part.triangles() - 1]);
    EXPECT_EQ(std::stod(cell[15]), skins.inner.strain_minor[chain.part.triangles() - 1]);
    write_vtu(folder / "x.vtu", chain.part, chain.blank, chain.face, chain.node, {}, LengthUnit::inch, nullptr, &skins);
    const auto data = arrays_of(content_of(folder / "x.vtu"), "CellData");
    expect_array(data, "outer_strain_minor", skins.outer.strain_minor);
    expect_array(data, "inner_strain_equivalent", skins.inner.strain_equivalent);
    skins.inner.strain_minor[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(write_faces_csv(folder / "y.csv", chain.part, chain.face, nullptr, {}, LengthUnit::mm, &skins),
                 InputError);
    EXPECT_THROW(write_vtu(folder / "y.vtu", chain.part, chain.blank, chain.face, chain.node, {}, LengthUnit::mm,
                           nullptr, &skins),
                 InputError);
}

TEST(Vtu, WarpingByTheDisplacementGivesTheBlank)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_vtu(folder / "x.vtu", chain.part, chain.blank, chain.face, chain.node);
    const auto warp =
        decoded<double>(arrays_of(content_of(folder / "x.vtu"), "PointData").at("displacement_to_blank").base64);
    for (int v = 0; v < chain.part.vertices(); ++v) {
        const Eigen::Vector3d warped =
            chain.part.position.col(v) + Eigen::Map<const Eigen::Vector3d>(&warp[size_t(3 * v)]);
        EXPECT_LT((warped - Eigen::Vector3d(chain.blank.position(0, v), chain.blank.position(1, v), 0)).norm(), 1e-11);
    }
}

TEST(Vtu, AStateHasItsPlacesItsNumbersAndTheWayToThePart)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const Eigen::Matrix3Xd state = 2 * chain.part.position.colwise().reverse();
    const Eigen::VectorXi step = Eigen::VectorXi::LinSpaced(chain.part.triangles(), 0, chain.part.triangles() - 1);
    const std::pair<std::string, const Eigen::VectorXi*> numbers[] = {{"step", &step}};
    write_state_vtu(folder / "x.vtu", chain.part, state, chain.face, numbers);
    const std::string text = content_of(folder / "x.vtu");
    expect_array(arrays_of(text, "Points"), "Points", state, 3);
    expect_array(arrays_of(text, "PointData"), "displacement_to_part", Eigen::Matrix3Xd(chain.part.position - state),
                 3);
    expect_array(arrays_of(text, "CellData"), "step", step);
    expect_array(arrays_of(text, "CellData"), "thinning", chain.face.thinning);
    EXPECT_THROW(write_state_vtu(folder / "y.vtu", chain.part, state.leftCols(3), chain.face), InputError);
    const Eigen::VectorXi few = step.head(2);
    const std::pair<std::string, const Eigen::VectorXi*> wrong[] = {{"step", &few}};
    EXPECT_THROW(write_state_vtu(folder / "y.vtu", chain.part, state, chain.face, wrong), InputError);
}

TEST(Dxf, LoopsAreClosedOnTheirLayersAndEncloseTheBlanksArea)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const auto loops = blank_outline(chain.part, chain.blank);
    ASSERT_EQ(loops.size(), 2u);
    write_dxf(folder / "x.dxf", {loops, {}, {}}, {.curves = DxfCurves::polylines});
    const auto lines = polylines(dxf_pairs(content_of(folder / "x.dxf")));
    ASSERT_EQ(lines.size(), loops.size());
    double enclosed = 0;
    for (size_t l = 0; l < lines.size(); ++l) {
        EXPECT_TRUE(lines[l].closed);
        EXPECT_EQ(lines[l].layer, l == 0 ? "OUTLINE" : "HOLES");
        ASSERT_EQ(lines[l].x.size(), size_t(loops[l].cols()));
        EXPECT_EQ(lines[l].announced, lines[l].x.size());
        for (size_t i = 0; i < lines[l].x.size(); ++i) {
            EXPECT_EQ(lines[l].x[i], loops[l](0, Eigen::Index(i)));
            EXPECT_EQ(lines[l].y[i], loops[l](1, Eigen::Index(i)));
            const size_t next = (i + 1) % lines[l].x.size();
            enclosed += (lines[l].x[i] * lines[l].y[next] - lines[l].x[next] * lines[l].y[i]) / 2;
        }
    }
    // 400 x 300 mm less a hole of a third of each side, stretched by 1.07 and 1.04; holes run
    // clockwise
    EXPECT_NEAR(enclosed, 1.07 * 1.04 * 400 * 300 * (1 - 1.0 / 9), 1e-6);
    EXPECT_GT(signed_area(loops[0]), 0);
    EXPECT_LT(signed_area(loops[1]), 0);
}

TEST(Dxf, BendLinesHaveTheirLayersAndStayOpen)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    BlankDrawing drawing{blank_outline(chain.part, chain.blank), {}, {}};
    DrawnBend bend{"bend 1", 1.5, 3, 0.44, true, {}, {}};
    bend.middle = {(Eigen::Matrix2Xd(2, 2) << 0, 25.4, 1, 2).finished()};
    bend.zone = {(Eigen::Matrix2Xd(2, 3) << 0, 25.4, 30, 1, 2, 50).finished()};
    drawing.bends = {bend};
    bend.up = false;
    bend.zone.clear();
    drawing.bends.push_back(bend);
    drawing.marks = {{Eigen::Matrix2Xd::Random(2, 5)}};
    write_dxf(folder / "x.dxf", drawing, {.unit = LengthUnit::inch, .curves = DxfCurves::polylines});
    const auto pairs = dxf_pairs(content_of(folder / "x.dxf"));
    const auto lines = polylines(pairs);
    ASSERT_EQ(lines.size(), 4u) << "outline, hole, a bent line of the zone, the mark";
    EXPECT_EQ(lines[2].layer, "BEND_ZONE");
    EXPECT_FALSE(lines[2].closed);
    EXPECT_EQ(lines[3].layer, "MARKS");
    EXPECT_EQ(lines[3].announced, 5u);
    const auto named = [&](const DxfPair& wanted) { return std::count(pairs.begin(), pairs.end(), wanted); };
    for (const char* layer : {"OUTLINE", "HOLES", "BEND_UP", "BEND_DOWN", "BEND_ZONE", "MARKS"})
        EXPECT_EQ(named({2, layer}), 1) << layer << " is declared once";
    EXPECT_EQ(named({0, "LINE"}), 2);
    EXPECT_EQ(named({0, "TEXT"}), 2);
    EXPECT_EQ(named({1, "UP 85.94%%d R0.1181 K0.44"}), 1) << "inch";
    EXPECT_EQ(named({1001, "SPIA"}), 5) << "of each line and its text, and of the mark";
    EXPECT_EQ(named({2, "SPIA"}), 1) << "the application is declared";
    EXPECT_EQ(named({6, "DASHED"}), 2);
    for (size_t i = 0; i + 4 < pairs.size(); ++i)
        if (pairs[i] == DxfPair(2, "LAYER") && pairs[i - 1] == DxfPair(0, "TABLE")) {
            EXPECT_EQ(pairs[i + 4], DxfPair(70, "7"));
        }
    std::vector<long> handles;
    for (const auto& [code, value] : pairs)
        if (code == 5 || code == 105)
            handles.push_back(std::stol(value, nullptr, 16));
    std::sort(handles.begin(), handles.end());
    EXPECT_EQ(std::adjacent_find(handles.begin() + 1, handles.end()), handles.end())
        << "after the seed, a handle is one's own";
    drawing.bends[0].middle = {Eigen::Matrix2Xd::Zero(2, 1)};
    EXPECT_THROW(write_dxf(folder / "y.dxf", drawing), InputError);
}

TEST(Dxf, UnitsAreMillimetresAndEveryHandleIsUniqueAndBelowTheSeed)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_dxf(folder / "x.dxf", {blank_outline(chain.part, chain.blank), {}, {}});
    const auto pairs = dxf_pairs(content_of(folder / "x.dxf"));
    EXPECT_EQ(pairs.back(), DxfPair(0, "EOF"));
    std::vector<long> handles, owners;
    long seed = 0;
    for (size_t i = 1; i < pairs.size(); ++i) {
        const auto& [code, value] = pairs[i];
        if (pairs[i - 1] == DxfPair(9, "$INSUNITS")) {
            EXPECT_EQ(pairs[i], DxfPair(70, "4"));
        }
        if (pairs[i - 1] == DxfPair(9, "$ACADVER")) {
            EXPECT_EQ(pairs[i], DxfPair(1, "AC1015"));
        }
        if (pairs[i - 1] == DxfPair(9, "$HANDSEED"))
            seed = std::stol(value, nullptr, 16);
        else if (code == 5 || code == 105)
            handles.push_back(std::stol(value, nullptr, 16));
        if (code == 330 || code == 350)
            owners.push_back(std::stol(value, nullptr, 16));
    }
    std::sort(handles.begin(), handles.end());
    EXPECT_EQ(std::adjacent_find(handles.begin(), handles.end()), handles.end());
    EXPECT_GT(seed, handles.back());
    for (const long owner : owners)
        EXPECT_TRUE(owner == 0 || std::binary_search(handles.begin(), handles.end(), owner)) << owner;
}

TEST(OutlineCsv, PointsComeBackAsTheSameDoubles)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const auto loops = blank_outline(chain.part, chain.blank);
    write_outline_csv(folder / "x.csv", loops);
    const auto rows = split(content_of(folder / "x.csv"), '\n');
    EXPECT_EQ(rows[0], "loop,index,x,y");
    size_t row = 1;
    for (size_t l = 0; l < loops.size(); ++l)
        for (Eigen::Index i = 0; i < loops[l].cols(); ++i) {
            const auto cell = split(rows.at(row++), ',');
            EXPECT_EQ(std::stoul(cell.at(0)), l);
            EXPECT_EQ(std::stol(cell.at(1)), i);
            EXPECT_EQ(std::stod(cell.at(2)), loops[l](0, i));
            EXPECT_EQ(std::stod(cell.at(3)), loops[l](1, i));
        }
    EXPECT_EQ(rows.size(), row);
}

TEST(FieldsCsv, RowsFollowTheVerticesAndReadAsTheSameDoubles)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    std::vector<int> number; // as if the file had had two vertices before each of the part
    for (int v = 0; v < chain.part.vertices(); ++v)
        number.push_back(3 * v + 2);
    write_fields_csv(folder / "x.csv", chain.part, chain.blank, chain.node, number);
    const auto rows = split(content_of(folder / "x.csv"), '\n');
    EXPECT_EQ(rows[0], "vertex,x,y,z,blank_x,blank_y,thickness,thinning,strain_major,strain_minor,strain_equivalent");
    ASSERT_EQ(rows.size(), size_t(chain.part.vertices()) + 1);
    for (int v = 0; v < chain.part.vertices(); ++v) {
        const auto cell = split(rows[size_t(v) + 1], ',');
        ASSERT_EQ(cell.size(), 11u);
        EXPECT_EQ(std::stoi(cell[0]), 3 * v + 2);
        const double expected[] = {chain.part.position(0, v),  chain.part.position(1, v),
                                   chain.part.position(2, v),  chain.blank.position(0, v),
                                   chain.blank.position(1, v), chain.node.thickness[v],
                                   chain.node.thinning[v],     chain.node.strain_major[v],
                                   chain.node.strain_minor[v], chain.node.strain_equivalent[v]};
        for (size_t i = 0; i < std::size(expected); ++i)
            EXPECT_EQ(std::stod(cell[i + 1]), expected[i]) << "row " << v << " column " << i + 1;
    }
}

TEST(BlankOutline, TheLoopAroundTheLargestAreaComesFirst)
{
    // On the part the hole's border is longer than the outer one: by length it would come first.
    const ScratchFolder folder;
    samples::Chain chain = samples::chain();
    const auto before = blank_outline(chain.part, chain.blank);
    for (int v = 0; v < chain.part.vertices(); ++v)
        for (Eigen::Index i = 0; i < before[1].cols(); i += 2)
            if (chain.blank.position.col(v) == before[1].col(i))
                chain.part.position(2, v) += 5000; // the hole's border zigzags on the part, not in
                                                   // the blank
    const auto loops = blank_outline(chain.part, chain.blank);
    EXPECT_EQ(loops[0], before[0]);
    EXPECT_EQ(loops[1], before[1]);
}

TEST(PlainFiles, LengthsAreInTheUnitAskedForAndNothingElseChanges)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const auto loops = blank_outline(chain.part, chain.blank);
    const Eigen::VectorXd deviation = Eigen::VectorXd::LinSpaced(chain.part.vertices(), 0, 2);
    const std::vector<NamedField> extra{{"deviation", &deviation}};
    constexpr double inch = 25.4; // mm

    write_dxf(folder / "x.dxf", {loops, {}, {}}, {.unit = LengthUnit::inch, .curves = DxfCurves::polylines});
    const auto pairs = dxf_pairs(content_of(folder / "x.dxf"));
    const auto after = [&](const char* variable) {
        return *(std::find(pairs.begin(), pairs.end(), DxfPair(9, variable)) + 1);
    };
    EXPECT_EQ(after("$INSUNITS"), DxfPair(70, "1"));
    EXPECT_EQ(after("$MEASUREMENT"), DxfPair(70, "0"));
    const auto lines = polylines(pairs);
    for (size_t l = 0; l < loops.size(); ++l)
        for (size_t i = 0; i < lines.at(l).x.size(); ++i)
            EXPECT_NEAR(inch * lines[l].x[i], loops[l](0, Eigen::Index(i)), 1e-11);

    write_outline_csv(folder / "o.csv", loops, LengthUnit::inch);
    auto rows = split(content_of(folder / "o.csv"), '\n');
    EXPECT_EQ(rows[0], "loop,index,x_inch,y_inch");
    EXPECT_NEAR(inch * std::stod(split(rows[2], ',').at(3)), loops[0](1, 1), 1e-11);
    write_fields_csv(folder / "f.csv", chain.part, chain.blank, chain.node, {}, LengthUnit::inch);
    rows = split(content_of(folder / "f.csv"), '\n');
    EXPECT_EQ(rows[0], "vertex,x_inch,y_inch,z_inch,blank_x_inch,blank_y_inch,thickness_inch,thinning,strain_major,"
                       "strain_minor,strain_equivalent");
    const auto cell = split(rows[6], ',');
    EXPECT_NEAR(inch * std::stod(cell[3]), chain.part.position(2, 5), 1e-11);
    EXPECT_NEAR(inch * std::stod(cell[4]), chain.blank.position(0, 5), 1e-11);
    EXPECT_NEAR(inch * std::stod(cell[6]), chain.node.thickness[5], 1e-11);
    EXPECT_EQ(std::stod(cell[7]), chain.node.thinning[5]);

    write_vtu(folder / "x.vtu", chain.part, chain.blank, chain.face, chain.node, extra, LengthUnit::inch);
    const std::string file = content_of(folder / "x.vtu");
    EXPECT_NE(file.find("Name=\"length_unit\" NumberOfTuples=\"1\" format=\"ascii\">105 110 99 104 0<"),
              std::string::npos); // "inch"
    const auto point = arrays_of(file, "PointData"), faces = arrays_of(file, "CellData");
    const auto near = [&](const auto& arrays, const char* name, const double* mm, Eigen::Index count) {
        const auto read = decoded<double>(arrays.at(name).base64);
        ASSERT_EQ(read.size(), size_t(count)) << name;
        for (Eigen::Index k = 0; k < count; ++k)
            EXPECT_NEAR(inch * read[size_t(k)], mm[k], 1e-11) << name;
    };
    const Eigen::VectorXd blank_y = chain.blank.position.row(1);
    Eigen::Matrix3Xd displacement = -chain.part.position;
    displacement.topRows(2) += chain.blank.position;
    near(arrays_of(file, "Points"), "Points", chain.part.position.data(), chain.part.position.size());
    near(point, "blank_y", blank_y.data(), blank_y.size());
    near(point, "displacement_to_blank", displacement.data(), displacement.size());
    near(point, "deviation", deviation.data(), deviation.size());
    near(point, "thickness", chain.node.thickness.data(), chain.node.thickness.size());
    near(faces, "thickness", chain.face.thickness.data(), chain.face.thickness.size());
    expect_array(point, "stress_major", chain.node.stress_major);
    expect_array(point, "thinning", chain.node.thinning);
}

TEST(PlainFiles, SameInputGivesTheSameBytes)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    for (const auto& [name, write] : all_writers(chain)) {
        write(folder / name);
        const std::string first = content_of(folder / name);
        write(folder / name);
        EXPECT_EQ(content_of(folder / name), first) << name;
    }
}

TEST(PlainFiles, FailureLeavesNoFile)
{
    const ScratchFolder folder;
    samples::Chain chain = samples::chain();
    for (const auto& [name, write] : all_writers(chain))
        EXPECT_THROW(write(folder / ("missing/" + name)), ExchangeError) << name;
    chain.blank.position(0, 3) = std::nan("");
    for (const auto& [name, write] : all_writers(chain))
        EXPECT_THROW(write(folder / name), InputError) << name;
    chain = samples::chain();
    chain.node.thinning.conservativeResize(5);
    EXPECT_THROW(write_vtu(folder / "x", chain.part, chain.blank, chain.face, chain.node), InputError);
    EXPECT_THROW(write_fields_csv(folder / "x", chain.part, chain.blank, chain.node), InputError);
    EXPECT_THROW(write_fields_csv(folder / "x", chain.part, chain.blank, samples::chain().node, {1, 2}), InputError);
    EXPECT_THROW(write_dxf(folder / "x", BlankDrawing{}), InputError);
    EXPECT_THROW(write_outline_csv(folder / "x", {OutlineLoop::Zero(2, 2)}), InputError);
    EXPECT_TRUE(folder.names().empty());
}

} // namespace spia

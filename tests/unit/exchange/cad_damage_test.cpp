// STEP files with a fault in an entity: it refuses the file only where a shape or its size needs
// it.
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <numbers>
#include <regex>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_solids.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_damage_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct CadDamageTest : testing::Test {
    ScratchFolder folder;
    const fs::path file = folder / "part.step";

    std::string cone()
    {
        write_cone(file, 30, 10, 40);
        return file_content(file);
    }
    std::string box()
    {
        write_box(file, 30, 30, 30); // no sheet
        return file_content(file);
    }

    PartFile read(const std::string& content)
    {
        std::ofstream(file) << content;
        ReadOptions options;
        options.cad.deflection = 0.001;
        return examine_part(file, options);
    }
    std::string refusal(const std::string& content)
    {
        try {
            read(content);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

std::string replaced(const std::string& text, const std::string& pattern, const std::string& by)
{
    const std::string result = std::regex_replace(text, std::regex(pattern), by);
    EXPECT_NE(result, text) << pattern << " is not in the file";
    return result;
}

/// Angles in degrees, by a unit whose dimensions are "*", as Creo writes it, or are there.
std::string in_degrees(std::string text, const std::string& dimensions, const std::string& factor = "#90001")
{
    std::smatch cone;
    if (std::regex_search(text, cone, std::regex("(CONICAL_SURFACE\\('',#\\d+,[^,]+,)([-0-9.E+]+)\\)"))) {
        const double degrees = std::stod(cone[2]) * 180 / std::numbers::pi;
        text.replace(size_t(cone.position(0)), cone[0].length(), fmt::format("{}{:.15g})", cone[1].str(), degrees));
    }
    return replaced(text,
                    "(#\\d+) = \\( *NAMED_UNIT\\(\\*\\) PLANE_ANGLE_UNIT\\(\\) *SI_UNIT\\(\\$,\\.RADIAN\\.\\) *\\);",
                    "#90000 = ( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($$,.RADIAN.) );\n"
                    "#90001 = PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.0174532925199433),#90000);\n"
                    "#90002 = DIMENSIONAL_EXPONENTS(0.,0.,0.,0.,0.,0.,0.);\n"
                    "$1 = ( CONVERSION_BASED_UNIT('DEGREE'," +
                        factor + ") NAMED_UNIT(" + dimensions + ") PLANE_ANGLE_UNIT() );");
}

double cone_area() { return std::numbers::pi * ((30 + 10) * std::hypot(20, 40) + 30 * 30 + 10 * 10); }

} // namespace

TEST_F(CadDamageTest, TheDegreeOfCreoIsTakenWithANote)
{
    const PartFile whole = read(in_degrees(cone(), "#90002"));
    EXPECT_FALSE(whole.doctor.find(Fault::damaged_entity));
    const PartFile part = read(in_degrees(cone(), "*"));
    EXPECT_NEAR(area(part.mesh) / cone_area(), 1, 1e-3) << "its half angle is in degrees";
    EXPECT_NEAR(area(part.mesh), area(whole.mesh), 1e-9);
    const Finding* note = part.doctor.find(Fault::damaged_entity);
    ASSERT_TRUE(note);
    EXPECT_EQ(note->severity, Severity::note);
    EXPECT_THAT(note->text, HasSubstr("1 entity of the file is damaged and was passed over: #"));
}

TEST_F(CadDamageTest, AnUnitOfAnglesWithoutItsSizeCountsWhereThereAreAngles)
{
    EXPECT_NEAR(area(read(in_degrees(box(), "*", "$")).mesh), 6 * 900, 1e-9);
    EXPECT_THAT(refusal(in_degrees(cone(), "*", "$")), HasSubstr("damaged"));
}

TEST_F(CadDamageTest, AFaultInAColourIsPassedOver)
{
    const std::string whole = box();
    std::smatch face;
    ASSERT_TRUE(std::regex_search(whole, face, std::regex("(#\\d+) = ADVANCED_FACE")));
    const std::string style = fmt::format("#90010 = STYLED_ITEM('',(#90011),{});\n"
                                          "#90011 = PRESENTATION_STYLE_ASSIGNMENT((#90012));\n"
                                          "#90012 = SURFACE_STYLE_USAGE(.BOTH.,#90013);\n"
                                          "#90013 = SURFACE_SIDE_STYLE('',(#90014));\n"
                                          "#90014 = SURFACE_STYLE_FILL_AREA(#90015);\n"
                                          "#90015 = FILL_AREA_STYLE('',(#90016));\n"
                                          "#90016 = FILL_AREA_STYLE_COLOUR('',#90017);\n"
                                          "#90017 = COLOUR_RGB('',*,0.5,$);\n",
                                          face[1].str());
    const PartFile part = read(replaced(whole, "ENDSEC;\\s*END-ISO", style + "ENDSEC;\nEND-ISO"));
    EXPECT_NEAR(area(part.mesh), 6 * 900, 1e-9);
    EXPECT_TRUE(part.doctor.find(Fault::damaged_entity));
}

TEST_F(CadDamageTest, AFaultInAPointOrInTheUnitOfLengthsRefusesTheFile)
{
    EXPECT_THAT(refusal(replaced(box(), "(VERTEX_POINT\\('',#\\d+\\);\\s*#\\d+ = CARTESIAN_POINT\\('',)\\(", "$1*,(")),
                HasSubstr("damaged"));
    EXPECT_THAT(refusal(replaced(box(), "SI_UNIT\\(\\.MILLI\\.,\\.METRE\\.\\)", "SI_UNIT(.MILLI.,.FOOT.)")),
                HasSubstr("damaged"));
}

TEST_F(CadDamageTest, PlacesBeyondAllPartsAreSaidAndMakeNoPart)
{
    std::ofstream(file) << replaced(box(), "\\(30\\.,", "(1.E12,");
    const PartFile part = examine_part(file);
    EXPECT_EQ(part.mesh.triangles(), 0);
    EXPECT_EQ(int(part.same_as.size()), part.file_vertices);
    EXPECT_THAT(spia::refusal(part.doctor).value_or(""), HasSubstr("beyond 1000000000 mm"));
}

TEST_F(CadDamageTest, AFaultInWhatAUnitOfLengthsRefersToRefusesTheFile)
{
    const auto in_doubles = [&](const std::string& exponents) {
        return replaced(
            box(), "(#\\d+) = \\( *LENGTH_UNIT\\(\\) *NAMED_UNIT\\(\\*\\) *SI_UNIT\\(\\.MILLI\\.,\\.METRE\\.\\) *\\);",
            "#90000 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"
            "#90001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#90000);\n"
            "#90002 = DIMENSIONAL_EXPONENTS(" +
                exponents +
                ",0.,0.,0.,0.,0.,0.);\n"
                "$1 = ( CONVERSION_BASED_UNIT('DOUBLE',#90001) LENGTH_UNIT() NAMED_UNIT(#90002) );");
    };
    EXPECT_NEAR(area(read(in_doubles("1.")).mesh), 6 * 900 * 4, 1e-6);
    EXPECT_THAT(refusal(in_doubles("'one'")), HasSubstr("damaged"));
}

TEST_F(CadDamageTest, ASolidWithSuchAUnitIsThatWithAWholeOne)
{
    const fs::path cases = fs::path(SPIA_SOURCE_DIR) / "../shared/cases";
    if (!fs::exists(cases / "02-degree-star.step"))
        GTEST_SKIP() << cases << " is not there";
    const PartFile star = read_part(cases / "02-degree-star.step"), right = read_part(cases / "02-degree-right.step");
    EXPECT_EQ(star.mesh.position, right.mesh.position);
    EXPECT_EQ(star.thickness_mm, right.thickness_mm);
    EXPECT_NEAR(star.solid.value().volume / 4276.99, 1, 5e-4) << "chords of the default deflection";
    EXPECT_NEAR(star.thickness_mm.value(), 2, 1e-3);
}

} // namespace spia::cad_damage_test

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_cad.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/unit/exchange/sample_assembly.h"
#include "tests/unit/exchange/sample_faces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_faults_test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& file, const CadOptions& options = {})
{
    try {
        read_cad(file, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(CadFaults, AFaceThatCannotBeMeshedIsNamedAndLeftOutWhenAsked)
{
    const ScratchFolder folder;
    write_two_squares(folder / "torn.brep", ThirdFace::torn);
    ReadOptions options;
    const PartFile refused = examine_part(folder / "torn.brep", options);
    const Finding* named = refused.doctor.find(Fault::unmeshed_face);
    ASSERT_TRUE(named);
    EXPECT_EQ(named->severity, Severity::fatal);
    EXPECT_NE(named->text.find("1 CAD face could not be meshed: 1"), std::string::npos) << named->text;
    EXPECT_THROW(read_part(folder / "torn.brep", options), InputError);
    options.cad.leave_out_unmeshed = true;
    const PartFile rest = read_part(folder / "torn.brep", options);
    EXPECT_NEAR(area(rest.mesh), 800, 1e-6);
    ASSERT_TRUE(rest.doctor.find(Fault::unmeshed_face));
    EXPECT_EQ(rest.doctor.find(Fault::unmeshed_face)->severity, Severity::repaired);
}

TEST(CadFaults, ASliverIsClosedAndToldWithItsWidthAndPlace)
{
    const ScratchFolder folder;
    write_two_squares(folder / "sliver.brep", ThirdFace::sliver);
    const CadContent cad = read_cad(folder / "sliver.brep");
    EXPECT_TRUE(cad.unmeshed.empty());
    ASSERT_EQ(cad.slivers.size(), 1u);
    EXPECT_EQ(cad.slivers[0].face, 1);
    EXPECT_NEAR(cad.slivers[0].width, sliver_width, sliver_width / 10);
    EXPECT_NEAR(cad.slivers[0].place.x(), 20, 1e-6);
    EXPECT_NEAR(cad.slivers[0].place.y(), 10, 1e-6);
    const PartFile part = read_part(folder / "sliver.brep");
    EXPECT_EQ(part.doctor.components, 1);
    EXPECT_NEAR(area(part.mesh), 800, 1e-6);
    ASSERT_TRUE(part.doctor.find(Fault::gap));
    EXPECT_NE(part.doctor.find(Fault::gap)->text.find("sliver"), std::string::npos);
}

TEST(CadFaults, AFaceThatOpenCascadeCannotMakeIsNotLostSilently)
{
    const ScratchFolder folder;
    write_sample_assembly(folder / "car.step");
    ReadOptions options;
    options.parts = {"Cover"};
    EXPECT_NO_THROW(read_part(folder / "car.step", options));
    std::string text = content_of(folder / "car.step");
    const size_t plane = text.rfind("= PLANE(");
    ASSERT_NE(plane, std::string::npos);
    text.replace(plane, 8, "= CYLINDRICAL_SURFACE(");
    text.insert(text.find(')', plane), ",-1.");
    std::ofstream(folder / "car.step") << text;
    const CadContent cad = read_cad(folder / "car.step");
    EXPECT_EQ(cad.faces, 19);
    ASSERT_EQ(cad.lost.size(), 1u);
    EXPECT_EQ(text.find("\n" + cad.lost[0] + " = ADVANCED_FACE"),
              text.rfind("ADVANCED_FACE", plane) - cad.lost[0].size() - 4);
    options.parts = {};
    const PartFile whole = examine_part(folder / "car.step", options);
    ASSERT_TRUE(whole.doctor.find(Fault::unmeshed_face));
    EXPECT_EQ(whole.doctor.find(Fault::unmeshed_face)->severity, Severity::fatal);
    EXPECT_NE(whole.doctor.find(Fault::unmeshed_face)->text.find(cad.lost[0]), std::string::npos);
    options.parts = {"Cover"};
    const PartFile other = read_part(folder / "car.step", options);
    EXPECT_EQ(other.doctor.find(Fault::unmeshed_face)->severity, Severity::note);
    options.parts = {"Roof"};
    const PartFile holed = examine_part(folder / "car.step", options);
    ASSERT_TRUE(holed.doctor.find(Fault::unmeshed_face));
    EXPECT_EQ(holed.doctor.find(Fault::unmeshed_face)->severity, Severity::fatal) << "it is a face of this body";
    options.cad.leave_out_unmeshed = true;
    EXPECT_EQ(examine_part(folder / "car.step", options).doctor.find(Fault::unmeshed_face)->severity,
              Severity::repaired);
}

TEST(CadFaults, ASweptCylinderIsMeshedAlongItsStraightLines)
{
    const ScratchFolder folder;
    for (const Swept swept : {Swept::line_up, Swept::line_down, Swept::circle_up, Swept::circle_down}) {
        write_swept_cylinder(folder / "swept.brep", swept);
        const CadContent cad = read_cad(folder / "swept.brep", {.deflection = 0.1});
        ASSERT_GT(cad.soup.polygons(), 10);
        double angle = 0;
        for (const Eigen::Vector3d& p : cad.soup.position) {
            EXPECT_NEAR(p.head<2>().norm(), 10, 1e-5);
            EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 30)), 1e-6)
                << "a vertex between the ends of a straight line";
            angle = std::max(angle, std::abs(std::atan2(p.y(), p.x())));
        }
        EXPECT_NEAR(angle, 1, 1e-6) << "the same part of the circle";
    }
}

TEST(CadFaults, OptionsWithoutSenseAreRefusedInWords)
{
    const ScratchFolder folder;
    write_two_squares(folder / "plate.brep", ThirdFace::none);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    for (const double wrong : {nan, infinite, -1.0, 5.0, 1e300})
        EXPECT_NE(refusal(folder / "plate.brep", {.sewing_tolerance = wrong}).find("sewing"), std::string::npos)
            << wrong;
    for (const double wrong : {nan, infinite, -1.0, 0.0, 1e-6, 1e-300})
        EXPECT_NE(refusal(folder / "plate.brep", {.deflection = wrong}).find("deflection"), std::string::npos) << wrong;
    for (const double wrong : {nan, infinite, -1.0, 0.0, 3.2})
        EXPECT_NE(refusal(folder / "plate.brep", {.angle = wrong}).find("angle"), std::string::npos) << wrong;
    EXPECT_EQ(refusal(folder / "plate.brep", {.sewing_tolerance = 2, .deflection = 1e-3, .angle = 0.02}), "");
}

} // namespace spia::cad_faults_test

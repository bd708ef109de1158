#include <gtest/gtest.h>
#include <regex>
#include <string>

#include "engine/core/error.h"
#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "tests/support/known_surfaces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_unit_test {
namespace {

namespace fs = std::filesystem;

constexpr double side = 50.8; // mm, 2 inches

std::vector<NurbsSurface> square()
{
    return {surfaces::bilinear({0, 0, 0}, {side, 0, 0}, {0, side, 0}, {side, side, 0})};
}

/// The square in inches, with another flag and name of the unit in lines of the same length.
void write_with_unit(const fs::path& iges, const std::string& flag, const std::string& name)
{
    write_iges(iges, square(), "s", LengthUnit::inch);
    std::string text = content_of(iges);
    std::string head; // in lines of 72 characters, without what stands behind them
    const size_t begin = text.find("G0000001") - 72, end = text.find("D0000001") - 72;
    for (size_t at = begin; at < end; at += 81)
        head += text.substr(at, 72);
    const std::regex own(",1\\., *1, *4HINCH,");
    ASSERT_TRUE(std::regex_search(head, own)) << head;
    head = std::regex_replace(head, own, ",1.," + flag + "," + name + ",");
    head.resize(72 * ((end - begin) / 81), ' ');
    for (size_t at = begin, k = 0; at < end; at += 81, k += 72)
        text.replace(at, 72, head.substr(k, 72));
    put(iges, text);
}

double area_of(const fs::path& file, std::optional<LengthUnit> unit = {})
{
    ReadOptions options;
    options.unit = unit;
    return area(read_part(file, options).mesh);
}

} // namespace

TEST(CadUnit, OfIgesIsThatOfTheFlagAndNeverAnother)
{
    struct Head {
        const char *flag, *name;
        double unit; ///< mm
    };
    const ScratchFolder folder;
    const fs::path file = folder / "s.igs";
    for (const Head& head :
         {Head{"1", "", 25.4}, Head{"", "", 25.4}, Head{"2", "", 1}, Head{"3", "2HMM", 1}, Head{"10", "", 10}}) {
        write_with_unit(file, head.flag, head.name);
        EXPECT_NEAR(area_of(file), 4 * head.unit * head.unit, 1e-9 * head.unit * head.unit) << head.flag << head.name;
        EXPECT_THROW(area_of(file, LengthUnit::inch), InputError) << head.flag << head.name;
    }
    for (const Head& head : {Head{"3", "3HFOO", 0}, Head{"12", "2HMM", 0}, Head{"2", "4HINCH", 0}}) {
        write_with_unit(file, head.flag, head.name);
        try {
            area_of(file);
            FAIL() << head.flag << head.name;
        } catch (const InputError& error) {
            EXPECT_TRUE(std::regex_search(error.what(), std::regex("[Uu]nit"))) << error.what();
        }
    }
}

TEST(CadUnit, OfStepIsTheMillimetreWhereNoneIsStated)
{
    const ScratchFolder folder;
    const fs::path file = folder / "s.step";
    write_step(file, square(), "s");
    const std::string text = content_of(file);
    const std::regex lengths("GLOBAL_UNIT_ASSIGNED_CONTEXT\\(\\s*\\(#[0-9]+,"); // the first one
    ASSERT_TRUE(std::regex_search(text, lengths));
    put(file, std::regex_replace(text, lengths, "GLOBAL_UNIT_ASSIGNED_CONTEXT(("));
    EXPECT_NEAR(area_of(file), side * side, 1e-6);
    EXPECT_THROW(area_of(file, LengthUnit::inch), InputError);
}

} // namespace spia::cad_unit_test

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <thread>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_surfaces.h"
#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "tests/unit/exchange/sample_surface.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::cad_files_test {
namespace {

/// Equal bit for bit, not just nearly.
void expect_same(const NurbsSurface& read, const NurbsSurface& written)
{
    EXPECT_EQ(read.degree_u, written.degree_u);
    EXPECT_EQ(read.degree_v, written.degree_v);
    EXPECT_EQ(read.knots_u, written.knots_u);
    EXPECT_EQ(read.knots_v, written.knots_v);
    ASSERT_EQ(read.count_u, written.count_u);
    ASSERT_EQ(read.count_v, written.count_v);
    EXPECT_EQ((read.control - written.control).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((read.weight - written.weight).cwiseAbs().maxCoeff(), 0);
}

/// A half cylinder closed to a full one: its first and last control rows are the same points.
NurbsSurface closed_surface()
{
    NurbsSurface s = samples::curved_surface(300, false, 9, 7);
    for (int j = 0; j < s.count_v; ++j)
        for (int i = 0; i < s.count_u; ++i) {
            const double angle = 2 * 3.14159265358979 * (i % (s.count_u - 1)) / (s.count_u - 1);
            s.control.col(s.index(i, j)) << 70 * std::cos(angle), 70 * std::sin(angle), 33.3 * j;
        }
    return s;
}

NurbsSurface with_double_and_triple_knots()
{
    NurbsSurface s = samples::curved_surface(500, true, 9, 7);
    s.knots_u = {0, 0, 0, 0, 0.3, 0.3, 0.7, 0.7, 0.7, 1, 1, 1, 1};
    return s;
}

std::vector<NurbsSurface> every_kind()
{
    return {samples::curved_surface(500, false),
            samples::curved_surface(500, true),
            samples::curved_surface(5000, false),
            samples::curved_surface(5000, true),
            samples::curved_surface(0.5, false),
            samples::curved_surface(500, false, 40, 31),
            closed_surface(),
            with_double_and_triple_knots()};
}

/// A fixed date in the files' headers for as long as it lives.
struct FixedDate {
    FixedDate() { ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1); }
    ~FixedDate() { ::unsetenv("SOURCE_DATE_EPOCH"); }
};

/// Every number after `begin` in a text, up to `end`.
std::vector<double> numbers_between(const std::string& text, size_t begin, size_t end)
{
    std::vector<double> numbers;
    for (const char* at = text.c_str() + begin; at < text.c_str() + end;) {
        char* after = nullptr;
        const double number = std::strtod(at, &after);
        if (after == at)
            ++at;
        else {
            numbers.push_back(number);
            at = after;
        }
    }
    return numbers;
}

/// Coordinates as they stand in the file, without any reader: of the CARTESIAN_POINTs, or of the
/// one entity 128.
std::vector<double> raw_coordinates(const std::string& file)
{
    std::vector<double> result;
    if (file.starts_with("ISO-10303-21")) {
        for (size_t at = 0; (at = file.find("CARTESIAN_POINT('',(", at)) != std::string::npos;) {
            at += 20;
            for (const double number : numbers_between(file, at, file.find(')', at)))
                result.push_back(number);
        }
        return result;
    }
    std::string parameters;
    for (size_t line = 0; line + 80 <= file.size(); line += 81)
        if (file[line + 72] == 'P')
            parameters += file.substr(line, 64);
    const std::vector<double> all = numbers_between(parameters, 0, parameters.size());
    const size_t count_u = size_t(all.at(1)) + 1, count_v = size_t(all.at(2)) + 1;
    const size_t knots = count_u + size_t(all.at(3)) + 1 + count_v + size_t(all.at(4)) + 1;
    const size_t first = 10 + knots + count_u * count_v;
    result.assign(all.begin() + long(first), all.begin() + long(first + 3 * count_u * count_v));
    return result;
}

struct Format {
    const char* name;
    std::function<void(const std::filesystem::path&, const NurbsSurface&, const std::string&, LengthUnit)> write_in;
    std::vector<NurbsSurface> (*read)(const std::filesystem::path&);

    void write(const std::filesystem::path& path, const NurbsSurface& surface, const std::string& title) const
    {
        write_in(path, surface, title, LengthUnit::mm);
    }
};

class CadFile : public ::testing::TestWithParam<Format> {};

INSTANTIATE_TEST_SUITE_P(Formats, CadFile,
                         ::testing::Values(Format{"iges",
                                                  [](const auto& path, const NurbsSurface& surface, const auto& name,
                                                     LengthUnit unit) { write_iges(path, surface, name, unit); },
                                                  read_iges_surfaces},
                                           Format{"step",
                                                  [](const auto& path, const NurbsSurface& surface, const auto& name,
                                                     LengthUnit unit) { write_step(path, surface, name, unit); },
                                                  read_step_surfaces}),
                         [](const auto& format) { return format.param.name; });

} // namespace

TEST_P(CadFile, KnotsPolesAndWeightsComeBackBitForBit)
{
    const ScratchFolder folder;
    for (const NurbsSurface& surface : every_kind()) {
        GetParam().write(folder / "s", surface, "sheet");
        const auto read = GetParam().read(folder / "s");
        ASSERT_EQ(read.size(), 1u);
        expect_same(read[0], surface);
    }
}

TEST_P(CadFile, SameInputGivesTheSameBytesAndNothingOnStdout)
{
    const ScratchFolder folder;
    const FixedDate date;
    const NurbsSurface surface = samples::curved_surface(500, true);
    testing::internal::CaptureStdout();
    GetParam().write(folder / "s", surface, "sheet");
    const std::string first = content_of(folder / "s");
    GetParam().write(folder / "s", surface, "sheet");
    GetParam().read(folder / "s");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(content_of(folder / "s"), first);
}

TEST_P(CadFile, HeaderNamesTheProgramAndNotTheUser)
{
    const ScratchFolder folder;
    const FixedDate date;
    ::setenv("USER", "jane-doe", 1);
    ::setenv("LOGNAME", "jane-doe", 1);
    GetParam().write(folder / "door.file", samples::curved_surface(500, false), "left door");
    const std::string file = content_of(folder / "door.file");
    EXPECT_EQ(file.find("jane-doe"), std::string::npos);
    EXPECT_NE(file.find("SPIA 0.2.0"), std::string::npos);
    EXPECT_NE(file.find("left door"), std::string::npos);
    EXPECT_NE(file.find("door.file"), std::string::npos);
    EXPECT_TRUE(file.find("15H20231114.221320,") != std::string::npos ||
                file.find("'2023-11-14T22:13:20Z'") != std::string::npos);
}

TEST_P(CadFile, CutAnywhereOrFilledWithAnythingElseItIsRefused)
{
    const ScratchFolder folder;
    GetParam().write(folder / "s", samples::curved_surface(500, false), "sheet");
    const std::string whole = content_of(folder / "s");
    for (int tenth = 0; tenth < 10; ++tenth) {
        put(folder / "cut", whole.substr(0, whole.size() * size_t(tenth) / 10));
        EXPECT_THROW(GetParam().read(folder / "cut"), ExchangeError) << "cut after " << tenth << " tenths";
    }
    put(folder / "cut", whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1));
    EXPECT_THROW(GetParam().read(folder / "cut"), ExchangeError) << "without its last line";
    std::string spoilt = whole;
    for (size_t i = whole.size() / 3; i < whole.size() / 2; ++i)
        if (spoilt[i] != '\n')
            spoilt[i] = '?';
    for (const std::string& content : {spoilt, std::string("hello\n"), std::string(5000, '\0')}) {
        put(folder / "other", content);
        EXPECT_THROW(GetParam().read(folder / "other"), Error);
    }
    EXPECT_THROW(GetParam().read(folder / "missing"), ExchangeError);
}

TEST_P(CadFile, ImpossibleSurfacesAreRefusedBeforeAFileAppears)
{
    const ScratchFolder folder;
    const NurbsSurface good = samples::curved_surface(500, false);
    std::vector<NurbsSurface> bad(6, good);
    bad[0].knots_u[5] = 2;
    bad[1].knots_v.front() = -0.5;
    bad[2].weight[3] = 0;
    bad[3].control(1, 7) = std::nan("");
    bad[4].control.conservativeResize(3, 5);
    bad[5].knots_u.pop_back();
    for (const NurbsSurface& surface : bad)
        EXPECT_THROW(GetParam().write(folder / "s", surface, "sheet"), InputError);
    EXPECT_THROW(GetParam().write(folder / "no/such/folder", good, "sheet"), ExchangeError);
    EXPECT_TRUE(folder.names().empty());
}

TEST_P(CadFile, NamesWithQuotesAndAccentsKeepTheFileReadable)
{
    const ScratchFolder folder;
    const NurbsSurface surface = samples::curved_surface(500, false);
    for (const std::string name : {"o'clock; \"part\"", "T\xc3\xbcr links", "", "a\\b,c;d", "two\nlines"}) {
        GetParam().write(folder / "s", surface, name);
        const auto read = GetParam().read(folder / "s");
        ASSERT_EQ(read.size(), 1u) << name;
        expect_same(read[0], surface);
    }
}

TEST_P(CadFile, LengthsInAnotherUnitAreTheSameSizeAndTheHeaderNamesIt)
{
    const ScratchFolder folder;
    const NurbsSurface surface = samples::curved_surface(500, true);
    GetParam().write(folder / "mm", surface, "sheet");
    const std::vector<double> in_mm = raw_coordinates(content_of(folder / "mm"));
    ASSERT_GE(in_mm.size(), size_t(surface.control.size()));
    struct Unit {
        LengthUnit unit;
        double mm;
        const char *iges, *step; // in the header
    };
    for (const Unit& unit : {Unit{LengthUnit::inch, 25.4, ",1,4HINCH,", "CONVERSION_BASED_UNIT('INCH'"},
                             Unit{LengthUnit::cm, 10, ",10,2HCM,", "SI_UNIT(.CENTI.,.METRE.)"},
                             Unit{LengthUnit::m, 1000, ",6,1HM,", "SI_UNIT($,.METRE.)"}}) {
        GetParam().write_in(folder / "other", surface, "sheet", unit.unit);
        const std::string file = content_of(folder / "other");
        std::string header = file; // IGES breaks its lines anywhere
        if (std::string(GetParam().name) == "iges") {
            header.clear();
            for (size_t line = 0; line + 80 <= file.size(); line += 81)
                if (file[line + 72] == 'G')
                    header += file.substr(line, 72);
        }
        EXPECT_NE(header.find(std::string(GetParam().name) == "iges" ? unit.iges : unit.step), std::string::npos)
            << header.substr(0, 3000);
        const std::vector<double> raw = raw_coordinates(file);
        ASSERT_EQ(raw.size(), in_mm.size());
        for (size_t k = 0; k < raw.size(); ++k)
            EXPECT_NEAR(raw[k] * unit.mm, in_mm[k], 1e-10) << k;
        const auto read = GetParam().read(folder / "other"); // by OpenCASCADE, in mm
        ASSERT_EQ(read.size(), 1u);
        EXPECT_LT((read[0].control - surface.control).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_LT((read[0].weight - surface.weight).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(CadFiles, FourThreadsThatWriteAndReadBothFormatsDoNotDisturbEachOther)
{
    constexpr int runs = 15; // without the lock, four of six such tests crashed
    const ScratchFolder folder;
    std::vector<std::thread> threads;
    std::vector<int> good(4, 0);
    for (size_t t = 0; t < good.size(); ++t)
        threads.emplace_back([&, t] {
            const NurbsSurface surface = samples::curved_surface(100.0 * double(t + 1), t % 2);
            for (int run = 0; run < runs; ++run) {
                const auto iges = folder / (std::to_string(t) + ".igs"), step = folder / (std::to_string(t) + ".step");
                write_iges(iges, surface);
                write_step(step, surface);
                good[t] += read_iges_surfaces(iges).at(0).control == surface.control &&
                           read_step_surfaces(step).at(0).control == surface.control;
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(good, std::vector<int>(4, runs));
}

TEST(Iges, LinesHave80ColumnsAndTheEntitiesAreUntrimmed128)
{
    const ScratchFolder folder;
    const NurbsSurface left = samples::curved_surface(500, false);
    const std::vector<NurbsSurface> patches{left, samples::beside(left)};
    write_iges(folder / "s.igs", patches);
    std::ifstream file(folder / "s.igs");
    int entities = 0;
    for (std::string line; std::getline(file, line);) {
        EXPECT_EQ(line.size(), 80u) << line;
        if (line.size() == 80 && line[72] == 'D' && std::stoi(line.substr(73)) % 2 == 1) {
            EXPECT_EQ(std::stoi(line.substr(0, 8)), 128);
            ++entities;
        }
    }
    EXPECT_EQ(entities, 2);
    const auto read = read_iges_surfaces(folder / "s.igs");
    ASSERT_EQ(read.size(), 2u);
    expect_same(read[0], patches[0]);
    expect_same(read[1], patches[1]);
}

TEST(Step, NamesBeyondAsciiAreEncodedAsTheStandardSays)
{
    const ScratchFolder folder;
    write_step(folder / "s.step", samples::curved_surface(500, false), "T\xc3\xbcr \xf0\x9f\x9a\x97 o'clock");
    const std::string file = content_of(folder / "s.step");
    EXPECT_NE(file.find(R"(PRODUCT('T\X2\00FC\X0\r \X4\0001F697\X0\ o''clock')"), std::string::npos)
        << file.substr(0, 2000);
    EXPECT_TRUE(std::all_of(file.begin(), file.end(), [](unsigned char c) { return c < 128; }));
}

TEST(Step, PatchesThatMeetShareTheirEdgeInOneOpenShell)
{
    const ScratchFolder folder;
    const NurbsSurface left = samples::curved_surface(500, true);
    const std::vector<NurbsSurface> patches{left, samples::beside(left)};
    write_step(folder / "s.step", patches);
    const std::string file = content_of(folder / "s.step");
    const auto count = [&](const std::string& entity) {
        int n = 0;
        for (size_t at = file.find(entity); at != std::string::npos; at = file.find(entity, at + 1))
            ++n;
        return n;
    };
    EXPECT_EQ(count("OPEN_SHELL("), 1);
    EXPECT_EQ(count("SHELL_BASED_SURFACE_MODEL("), 1);
    EXPECT_EQ(count("ADVANCED_FACE("), 2);
    EXPECT_EQ(count("EDGE_CURVE("), 7); // 4 + 4, one of them shared
    EXPECT_EQ(count("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF"), 1);
    EXPECT_EQ(read_step_surfaces(folder / "s.step").size(), 2u);
}

} // namespace spia::cad_files_test

#include "engine/forming/material/material_library.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::material_library_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

const fs::path shipped = fs::path(SPIA_SOURCE_DIR) / "assets/materials";

std::vector<std::string> stems()
{
    std::vector<std::string> result;
    for (const fs::path& file : material_files(shipped))
        result.push_back(file.stem().string());
    return result;
}

Json json_of(const std::string& stem) { return Json::parse(content_of(shipped / (stem + ".json"))); }

/// The message of the InputError that an action ends with; a failed expectation and "" if it does
/// not.
std::string complaint(const std::function<void()>& action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    } catch (const std::exception& error) {
        ADD_FAILURE() << "not an InputError: " << error.what();
        return "";
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

/// What a tensile test would show: necking begins where the slope of the true curve has fallen to
/// the stress (Considere), the tensile strength is the load there over the first area, the proof
/// stress has left a strain of 0.002.
struct TensileTest {
    double uniform_strain; ///< logarithmic
    double strength_MPa;
    double proof_MPa;
};

double root(double low, double high, const std::function<double(double)>& falling)
{
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (falling(middle) > 0 ? low : high) = middle;
    }
    return low;
}

TensileTest pull(const Material& material)
{
    // Trusted up to a strain beyond every necking, since the continuation never necks.
    StressCurve::Options options;
    options.trusted_strain = 0.9;
    const StressCurve curve(material.hardening, material.young_MPa, options);
    TensileTest test;
    test.uniform_strain =
        root(2 * curve.yield_strain(), 0.9, [&](double e) { return curve(e).slope - curve(e).stress; });
    test.strength_MPa = curve(test.uniform_strain).stress * std::exp(-test.uniform_strain);
    test.proof_MPa = flow_stress(material.hardening, 0.002).stress;
    return test;
}

const char* const good = R"({"name": "own", "young_MPa": 206000, "poisson": 0.3, "density_kg_m3": 7850,
    "hardening": {"law": "swift", "K_MPa": 565.32, "e0": 0.007117, "n": 0.2589}, "r0": 1.7, "r45": 1.5, "r90": 2.2})";

} // namespace

TEST(MaterialLibrary, ReadsEveryShippedGradeSortedByFileName)
{
    const std::vector<std::string> names = stems();
    EXPECT_GE(names.size(), 8u);
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    size_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(shipped))
        count += entry.path().extension() == ".json";
    const std::vector<Material> materials = read_materials(shipped);
    ASSERT_EQ(materials.size(), count);
    ASSERT_EQ(materials.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i)
        EXPECT_EQ(materials[i].name, json_of(names[i])["name"]);
}

TEST(MaterialLibrary, OrdersFilesByNameWhateverTheOrderOfTheirMaking)
{
    const ScratchFolder folder;
    for (const char* stem : {"m", "b", "z", "a", "k"}) {
        Json grade = Json::parse(good);
        grade["name"] = std::string("grade ") + stem;
        put(folder / (std::string(stem) + ".json"), grade.dump());
    }
    put(folder / "README.md", "no grade");
    fs::create_directory(folder / "folder.json");
    std::string order;
    for (const Material& material : read_materials(folder / ""))
        order += material.name.back();
    EXPECT_EQ(order, "abkmz");
}

TEST(MaterialLibrary, TheDefaultGradeIsTheMildSteelOfNumisheet93)
{
    const Material steel = find_material("mild_steel", shipped);
    const Swift law = std::get<Swift>(steel.hardening);
    EXPECT_EQ(law.K_MPa, 565.32);
    EXPECT_EQ(law.e0, 0.007117);
    EXPECT_EQ(law.n, 0.2589);
    EXPECT_EQ(steel.young_MPa, 206000);
    EXPECT_EQ(steel.r0, 1.79);
    EXPECT_EQ(steel.r45, 1.51);
    EXPECT_EQ(steel.r90, 2.27);
    EXPECT_NEAR(steel.normal_anisotropy(), 1.77, 1e-12); // the mean the benchmark is quoted with
}

TEST(MaterialLibrary, EveryShippedGradeSaysWhereItsValuesComeFrom)
{
    for (const std::string& stem : stems()) {
        SCOPED_TRACE(stem);
        const Json json = json_of(stem);
        EXPECT_GT(find_material(stem, shipped).source.size(), 30u);
        for (const char* part : {"hardening", "r", "elastic"})
            EXPECT_FALSE(json.at("sources").at(part).get<std::string>().empty()) << part;
        EXPECT_TRUE(json.at("verified").is_boolean());
        // where it was seen, or why it could not be
        EXPECT_FALSE(json.at("note").get<std::string>().empty());
    }
}

TEST(MaterialLibrary, EveryShippedGradeLiesInPhysicalRanges)
{
    for (const std::string& stem : stems()) {
        SCOPED_TRACE(stem);
        const Material m = find_material(stem, shipped);
        // Steels, aluminium alloys and copper, told apart by their density.
        const bool iron = m.density_kg_m3 > 7700 && m.density_kg_m3 < 8100;
        const bool aluminium = m.density_kg_m3 > 2600 && m.density_kg_m3 < 2800;
        const bool copper = m.density_kg_m3 > 8300 && m.density_kg_m3 < 9000;
        EXPECT_EQ(iron + aluminium + copper, 1) << m.density_kg_m3;
        const double young = iron ? 203000 : aluminium ? 70000 : 117000;
        EXPECT_NEAR(m.young_MPa, young, 0.07 * young);
        EXPECT_NEAR(m.poisson, 0.32, 0.031);
        for (const double r : {m.r0, m.r45, m.r90}) {
            EXPECT_GT(r, aluminium ? 0.2 : 0.6);
            EXPECT_LT(r, iron ? 3.0 : 1.2);
        }
        if (const auto* swift = std::get_if<Swift>(&m.hardening)) {
            EXPECT_GT(swift->n, 0.1);
            EXPECT_LT(swift->n, 0.5);
            EXPECT_GT(swift->K_MPa, 400);
            EXPECT_LT(swift->K_MPa, 1600);
            EXPECT_LT(swift->e0, 0.03);
        } else if (const auto* voce = std::get_if<Voce>(&m.hardening)) {
            EXPECT_GT(voce->sigma_sat_MPa, 1.5 * voce->sigma0_MPa);
            EXPECT_GT(voce->c, 3);
            EXPECT_LT(voce->c, 25);
        }
        const StressCurve curve(m.hardening, m.young_MPa, {});
        EXPECT_GT(curve.yield_stress(), 60);
        EXPECT_LT(curve.yield_stress(), 450);
    }
}

TEST(MaterialLibrary, EveryShippedGradeBeginsToNeckWhereItsLawSays)
{
    for (const std::string& stem : stems()) {
        SCOPED_TRACE(stem);
        const Material m = find_material(stem, shipped);
        const double strain = pull(m).uniform_strain;
        EXPECT_GT(strain, 0.1);
        EXPECT_LT(strain, 0.45);
        // d sigma / d eps = sigma in closed form
        if (const auto* swift = std::get_if<Swift>(&m.hardening)) {
            EXPECT_NEAR(strain, swift->n - swift->e0, 1e-9);
        } else if (const auto* voce = std::get_if<Voce>(&m.hardening)) {
            const double rise = 1 - voce->sigma0_MPa / voce->sigma_sat_MPa;
            EXPECT_NEAR(strain, std::log((1 + voce->c) * rise) / voce->c, 1e-9);
        }
    }
}

/// The laws come from tests of single sheets, the standards bound what may be sold under the name:
/// an independent measure of each whole curve, by a tenth since laws are fitted for larger strains.
TEST(MaterialLibrary, AShippedGradeHasTheStrengthThatItsStandardDemands)
{
    struct Demand {
        double least_proof, most_proof, least_strength, most_strength; ///< MPa
    };
    const std::map<std::string, Demand> demands = {
        {"mild_steel", {140, 210, 270, 350}},     // EN 10130 DC04
        {"dq_steel", {140, 240, 270, 370}},       // EN 10130 DC03
        {"if_steel", {120, 180, 270, 330}},       // EN 10130 DC05/DC06
        {"sgcc", {205, 400, 270, 430}},           // JIS G 3302
        {"hsla340", {340, 420, 410, 510}},        // EN 10268 HC340LA
        {"dp600", {330, 430, 590, 700}},          // EN 10338 HCT590X
        {"stainless_304", {205, 310, 515, 750}},  // ASTM A240
        {"aa5182", {110, 160, 255, 315}},         // EN 485-2, O
        {"aa5754_o", {80, 130, 190, 240}},        // EN 485-2, O
        {"aa6016_t4", {80, 140, 170, 250}},       // EN 485-2, T4
        {"copper_annealed", {50, 100, 200, 250}}, // EN 1652, R200/R220
    };
    for (const std::string& stem : stems()) {
        SCOPED_TRACE(stem);
        ASSERT_TRUE(demands.count(stem)) << "no standard known for this grade; add one";
        const Demand& demand = demands.at(stem);
        const TensileTest test = pull(find_material(stem, shipped));
        EXPECT_GT(test.proof_MPa, 0.9 * demand.least_proof);
        EXPECT_LT(test.proof_MPa, 1.1 * demand.most_proof);
        EXPECT_GT(test.strength_MPa, 0.9 * demand.least_strength);
        EXPECT_LT(test.strength_MPa, 1.1 * demand.most_strength);
    }
}

TEST(MaterialLibrary, FindsAGradeByStemAndByNameInAnyCase)
{
    const std::vector<Material> materials = read_materials(shipped);
    const std::vector<std::string> names = stems();
    const auto upper = [](std::string text) {
        std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
        return text;
    };
    for (size_t i = 0; i < names.size(); ++i) {
        SCOPED_TRACE(names[i]);
        EXPECT_EQ(find_material(names[i], shipped).name, materials[i].name);
        EXPECT_EQ(find_material(upper(names[i]), shipped).name, materials[i].name);
        EXPECT_EQ(find_material(materials[i].name, shipped).name, materials[i].name);
        EXPECT_EQ(find_material(upper(materials[i].name), shipped).name, materials[i].name);
    }
}

TEST(MaterialLibrary, ReadsAUsersOwnFileFromItsPath)
{
    const ScratchFolder folder;
    for (const char* file : {"own.json", "dp600.json", "Own Sheet.txt", "own", "dp600"}) {
        put(folder / file, good);
        EXPECT_EQ(find_material((folder / file).string(), shipped).name, "own") << file;
    }
    const fs::path before = fs::current_path();
    fs::current_path(folder / "");
    EXPECT_EQ(find_material("own", shipped).name, "own");
    EXPECT_EQ(find_material("dp600.json", shipped).name, "own");
    EXPECT_NE(find_material("dp600", shipped).name,
              "own"); // the grade goes before a file without an extension
    fs::current_path(before);
    EXPECT_EQ(find_material((folder / "own.json").string(), folder / "no such folder").name, "own");
}

TEST(MaterialLibrary, AnUnknownNameIsMetWithTheKnownOnesAndTheClosest)
{
    const std::vector<std::pair<std::string, std::string>> meant = {{"dp60", "dp600"},
                                                                    {"DP 600", "dp600"},
                                                                    {"AA6016-T4", "aa6016_t4"},
                                                                    {"aa6016", "aa6016_t4"},
                                                                    {"mildsteel", "mild_steel"},
                                                                    {"5754", "aa5754_o"},
                                                                    {"copper", "copper_annealed"},
                                                                    {"SGCC.json", "sgcc"},
                                                                    {"hsla 340 steel", "hsla340"}};
    for (const auto& [typed, closest] : meant) {
        const std::string name = typed;
        const std::string message = complaint([&] { find_material(name, shipped); });
        EXPECT_THAT(message, AllOf(HasSubstr("\"" + typed + "\""), HasSubstr("did you mean " + closest + " (")));
        for (const std::string& stem : stems())
            EXPECT_THAT(message, HasSubstr(stem));
    }
    for (const char* hopeless : {"", " ", "/", "unobtainium", "../assets", "\xff"})
        EXPECT_THAT(complaint([&] { find_material(hopeless, shipped); }), HasSubstr("did you mean "));
}

TEST(MaterialLibrary, ASpoiltGradeDoesNotHideTheOthersAndIsNamed)
{
    const ScratchFolder folder;
    put(folder / "a.json", "{");
    put(folder / "b.json", good);
    EXPECT_EQ(find_material("b", folder / "").name, "own");
    EXPECT_THAT(complaint([&] { read_materials(folder / ""); }), HasSubstr("a.json"));
}

TEST(MaterialLibrary, AFolderWithoutGradesIsAnError)
{
    const ScratchFolder folder;
    EXPECT_THAT(complaint([&] { read_materials(folder / ""); }), HasSubstr("holds no"));
    EXPECT_THAT(complaint([&] { read_materials(folder / "none"); }), HasSubstr((folder / "none").string()));
    EXPECT_THAT(complaint([&] { find_material("dp600", folder / "none"); }), HasSubstr("cannot read the folder"));
}

TEST(MaterialLibrary, OneNameForTwoGradesIsAnError)
{
    const ScratchFolder folder;
    Json grade = Json::parse(good);
    put(folder / "a.json", grade.dump());
    grade["name"] = "OWN";
    put(folder / "b.json", grade.dump());
    EXPECT_THAT(complaint([&] { read_materials(folder / ""); }),
                AllOf(HasSubstr("OWN"), HasSubstr("a.json"), HasSubstr("b.json")));
    grade["name"] = "A"; // the stem of the other
    put(folder / "b.json", grade.dump());
    EXPECT_THAT(complaint([&] { read_materials(folder / ""); }), HasSubstr("means two materials"));
    grade["name"] = "B"; // its own stem
    put(folder / "b.json", grade.dump());
    EXPECT_EQ(read_materials(folder / "").size(), 2u);
}

/// Each flaw alone in an otherwise good file must be refused by the name of the file and of the
/// key.
TEST(MaterialLibrary, AMalformedFileIsRefusedByFileAndKey)
{
    const ScratchFolder folder;
    const fs::path file = folder / "flawed.json";
    const auto expect_refusal = [&](const Json& json, const std::string& key) {
        SCOPED_TRACE(json.dump());
        put(file, json.dump());
        EXPECT_THAT(complaint([&] { find_material(file.string(), shipped); }),
                    AllOf(HasSubstr(file.string()), HasSubstr("\"" + key + "\"")));
    };
    const Json swift = Json::parse(good);
    put(file, swift.dump());
    ASSERT_EQ(find_material(file.string(), shipped).name, "own");

    const auto expect_refusals_of_numbers = [&](const Json& whole, const std::string& group, const Json& bad_values) {
        for (const auto& item : (group.empty() ? whole : whole[group]).items()) {
            const std::string& key = item.key();
            if (!item.value().is_number())
                continue;
            const auto flawed = [&](const std::function<void(Json&)>& spoil) {
                Json json = whole;
                spoil(group.empty() ? json : json[group]);
                expect_refusal(json, key);
            };
            flawed([&](Json& at) { at.erase(key); });
            for (const Json& bad : bad_values)
                flawed([&](Json& at) { at[key] = bad; });
        }
    };
    const Json bad_values = {-1.5, 1e9, "0.3", nullptr, true, {{"value", 1}}, {0.3}};
    expect_refusals_of_numbers(swift, "", bad_values);
    expect_refusals_of_numbers(swift, "hardening", bad_values);
    Json other = swift;
    other["hardening"] = {{"law", "hollomon"}, {"K_MPa", 500}, {"n", 0.2}};
    expect_refusals_of_numbers(other, "hardening", bad_values);
    other["hardening"] = {{"law", "voce"}, {"sigma0_MPa", 100}, {"sigma_sat_MPa", 300}, {"c", 10}};
    expect_refusals_of_numbers(other, "hardening", bad_values);
    other["hardening"]["sigma_sat_MPa"] = 99;
    expect_refusal(other, "sigma_sat_MPa");
    other["hardening"] = {{"law", "ludwik"}, {"sigma0_MPa", 100}, {"K_MPa", 300}, {"n", 0.4}};
    expect_refusals_of_numbers(other, "hardening", bad_values);
    other["hardening"] = {{"law", "hockett_sherby"}, {"sigma0_MPa", 100}, {"sigma_sat_MPa", 300}, {"c", 5}, {"p", 0.7}};
    expect_refusals_of_numbers(other, "hardening", bad_values);
    other["hardening"]["p"] = 0.01;
    expect_refusal(other, "p");
    other["hardening"] = {{"law", "swift_voce"}, {"alpha", 0.5},         {"K_MPa", 500}, {"e0", 0.01}, {"n", 0.2},
                          {"sigma0_MPa", 100},   {"sigma_sat_MPa", 300}, {"c", 10}};
    expect_refusals_of_numbers(other, "hardening", bad_values);
    other["hardening"]["sigma_sat_MPa"] = 99;
    expect_refusal(other, "sigma_sat_MPa");

    for (const Json& bad : {Json(nullptr), Json(3), Json(""), Json(Json::array())}) {
        other = swift;
        other["name"] = bad;
        expect_refusal(other, "name");
        other = swift;
        other["hardening"]["law"] = bad;
        expect_refusal(other, "law");
        other = swift;
        other["hardening"] = bad;
        expect_refusal(other, "hardening");
    }
    for (const char* key : {"name", "hardening"}) {
        other = swift;
        other.erase(key);
        expect_refusal(other, key);
    }
    for (const char* law : {"Ludwik", "Swift", "swift "}) {
        other = swift;
        other["hardening"]["law"] = law;
        expect_refusal(other, "law");
    }
    other = swift;
    other["hardening"] = {{"law", "voce"}, {"sigma0_MPa", 9e4}, {"sigma_sat_MPa", 9.1e4}, {"c", 1}};
    other["young_MPa"] = 70; // GPa by mistake
    expect_refusal(other, "hardening");
}

TEST(MaterialLibrary, AMalformedTableIsRefusedByFileAndKey)
{
    const ScratchFolder folder;
    const fs::path file = folder / "flawed.json";
    Json json = Json::parse(good);
    const auto with_table = [&](const Json& strain, const Json& stress) {
        json["hardening"] = {{"law", "table"}, {"strain", strain}, {"stress_MPa", stress}};
        put(file, json.dump());
        return find_material(file.string(), shipped);
    };
    EXPECT_EQ(with_table({0, 0.1, 0.3}, {200, 300, 380}).name, "own");
    struct Flaw {
        Json strain, stress;
        std::string key;
    };
    const std::vector<Flaw> flaws = {
        {{0, 0.3, 0.1}, {200, 300, 380}, "strain"},     // falls
        {{0, 0.1, 0.1}, {200, 300, 380}, "strain"},     // stays
        {{-0.1, 0.1, 0.3}, {200, 300, 380}, "strain"},  // below zero
        {{0, 0.1}, {200, 300, 380}, "strain"},          // one stress too many
        {{0.1}, Json::array({200}), "strain"},          // a single point
        {Json::array(), Json::array(), "strain"},       // none
        {{0, "0.1", 0.3}, {200, 300, 380}, "strain"},   // a text
        {0.1, {200, 300, 380}, "strain"},               // no list
        {{0.2, 0.3, 0.5}, {200, 320, 380}, "strain"},   // its first slope says -40 MPa at strain 0
        {{0, 0.1, 0.3}, {200, 380, 300}, "stress_MPa"}, // softens
        {{0, 0.1, 0.3}, {0, 300, 380}, "stress_MPa"},   // no strength
        {{0, 0.1, 0.3}, {200, nullptr, 380}, "stress_MPa"},
        {{0, 0.1, 0.3}, nullptr, "stress_MPa"},
    };
    for (const Flaw& flaw : flaws)
        EXPECT_THAT(complaint([&] { with_table(flaw.strain, flaw.stress); }),
                    AllOf(HasSubstr(file.string()), HasSubstr("\"" + flaw.key + "\"")))
            << flaw.strain << flaw.stress;
}

TEST(MaterialLibrary, AFileThatIsNoJsonObjectIsRefusedByItsName)
{
    const ScratchFolder folder;
    const fs::path file = folder / "flawed.json";
    const std::string half(good, std::string(good).size() / 2);
    const std::vector<std::string> contents = {"",
                                               " \n",
                                               "null",
                                               "[]",
                                               "[1, 2]",
                                               "3",
                                               "\"text\"",
                                               "{",
                                               half,
                                               "<xml/>",
                                               std::string(good) + "}",
                                               std::string("\0\0\0", 3),
                                               "\xff\xfe{}"};
    for (const std::string& content : contents) {
        put(file, content);
        EXPECT_THAT(complaint([&] { find_material(file.string(), shipped); }),
                    AllOf(HasSubstr(file.string()), AnyOf(HasSubstr("is no JSON object"), HasSubstr("parse error"),
                                                          HasSubstr("was cut off"), HasSubstr("it is empty"))))
            << content;
    }
    std::string twice = good;
    twice.insert(twice.rfind('}'), ", \"name\": \"other\"");
    put(file, twice);
    EXPECT_EQ(complaint([&] { find_material(file.string(), shipped); }),
              file.string() + ": /name is there twice; leave one of them");
}

} // namespace spia::material_library_test

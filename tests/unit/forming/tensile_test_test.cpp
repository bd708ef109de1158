#include "engine/forming/material/tensile_test.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/forming/material/fit_hardening.h"
#include "engine/options/sheet_options.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::tensile_test_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double young = 206000;

/// A bar of a known law, pulled through its greatest force: total strain = plastic strain + sigma /
/// E.
struct Bar {
    std::vector<double> strain, stress; ///< engineering
};

Bar pulled(const Hardening& law, double noise_MPa, int rows = 600, unsigned seed = 7, double toe = 0)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, noise_MPa);
    Bar bar;
    const double first = 1e-4, yield = flow_stress(law, first).stress; // elastic up to there
    const auto add = [&](double total, double sigma) {
        bar.strain.push_back(std::expm1(total) + toe);
        bar.stress.push_back(sigma * std::exp(-total) + noise(random));
    };
    for (int i = 1; i <= 60; ++i)
        add(yield * i / 60 / young, yield * i / 60);
    const double end = 1.25 * uniform_strain(law, 0.6);
    for (int i = 1; i <= rows; ++i) {
        const double plastic = first + end * std::pow(double(i) / rows, 2), sigma = flow_stress(law, plastic).stress;
        add(plastic + sigma / young, sigma);
    }
    return bar;
}

std::string csv(const Bar& bar, const std::string& heading, char separator = ',', double unit = 1, char point = '.')
{
    std::string text = heading + "\n";
    for (size_t i = 0; i < bar.strain.size(); ++i) {
        std::string row =
            fmt::format("{:.9g}{}{:.9g}\n", unit * bar.strain[i], separator == ',' ? '|' : separator, bar.stress[i]);
        std::replace(row.begin(), row.end(), '.', point);
        std::replace(row.begin(), row.end(), '|', ',');
        text += row;
    }
    return text;
}

TensileTest read(const std::string& text, const TensileOptions& options = {})
{
    return tensile_test(parse_two_columns(text, "bar.csv"), "bar.csv", options);
}

const LawFit& fit_of(const std::vector<LawFit>& fits, const std::string& name)
{
    return *std::find_if(fits.begin(), fits.end(), [&](const LawFit& fit) { return fit.name == name; });
}

template <class Law> Law recovered(const Law& truth, double noise)
{
    const TensileTest test = read(csv(pulled(truth, noise), "engineering strain,engineering stress MPa"));
    const auto fits = fit_hardening(test.plastic_strain, test.stress_MPa);
    const LawFit& fit = fit_of(fits, std::string(law_name(truth)));
    EXPECT_TRUE(fit.law) << fit.reason;
    // what the law leaves is the noise alone
    EXPECT_NEAR(fit.rms_MPa, noise, 0.3 * noise + 0.1) << fit.name;
    EXPECT_LT(best_fit(fits).rms_MPa, 1.05 * fit.rms_MPa + 0.05);
    return std::get<Law>(*fit.law);
}

std::string complaint(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

const Bar steel = pulled(Swift{565.32, 0.007117, 0.2589}, 0);

} // namespace

TEST(TensileTest, KnownLawsAreRecoveredFromNoisyRows)
{
    for (const double noise : {0.0, 0.5}) {
        const Swift swift = recovered(Swift{565.32, 0.007117, 0.2589}, noise);
        EXPECT_NEAR(swift.K_MPa, 565.32, 4);
        EXPECT_NEAR(swift.e0, 0.007117, 6e-4);
        EXPECT_NEAR(swift.n, 0.2589, 4e-3);
        const Hollomon hollomon = recovered(Hollomon{530, 0.23}, noise);
        EXPECT_NEAR(hollomon.K_MPa, 530, 2);
        EXPECT_NEAR(hollomon.n, 0.23, 2e-3);
        const Voce voce = recovered(Voce{130, 290, 12}, noise);
        EXPECT_NEAR(voce.sigma0_MPa, 130, 1);
        EXPECT_NEAR(voce.sigma_sat_MPa, 290, 3);
        EXPECT_NEAR(voce.c, 12, 0.3);
        const Ludwik ludwik = recovered(Ludwik{150, 420, 0.45}, noise);
        EXPECT_NEAR(ludwik.sigma0_MPa, 150, 3);
        EXPECT_NEAR(ludwik.K_MPa, 420, 5);
        EXPECT_NEAR(ludwik.n, 0.45, 0.015);
        const HockettSherby hs = recovered(HockettSherby{140, 420, 4, 0.7}, noise);
        EXPECT_NEAR(hs.sigma0_MPa, 140, 3);
        EXPECT_NEAR(hs.sigma_sat_MPa, 420, 25); // far beyond the data: the least certain number
        EXPECT_NEAR(hs.p, 0.7, 0.04);
    }
}

TEST(TensileTest, TheLawTheRowsComeFromIsChosen)
{
    const std::vector<Hardening> truths = {Swift{565.32, 0.007117, 0.2589}, Hollomon{530, 0.23}, Voce{130, 290, 12},
                                           Ludwik{150, 420, 0.45}, HockettSherby{140, 420, 5, 0.75}};
    for (const Hardening& truth : truths)
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const TensileTest test = read(csv(pulled(truth, 0.3, 600, seed), "engineering strain,stress MPa"));
            EXPECT_EQ(best_fit(fit_hardening(test.plastic_strain, test.stress_MPa)).name, law_name(truth)) << seed;
        }
}

TEST(TensileTest, AMixtureIsNoWorseThanEitherOfItsLaws)
{
    const TensileTest test =
        read(csv(pulled(SwiftVoce{0.5, {565, 0.007, 0.26}, {150, 330, 15}}, 0), "engineering strain,stress MPa"));
    const auto fits = fit_hardening(test.plastic_strain, test.stress_MPa);
    const LawFit& mixed = fit_of(fits, "swift_voce");
    ASSERT_TRUE(mixed.law) << mixed.reason;
    EXPECT_LE(mixed.rms_MPa, std::min(fit_of(fits, "swift").rms_MPa, fit_of(fits, "voce").rms_MPa));
    // alpha is the least squares one: a little more or less of Swift is worse
    const SwiftVoce law = std::get<SwiftVoce>(*mixed.law);
    for (const double change : {-0.02, 0.02}) {
        double sum = 0;
        SwiftVoce other = law;
        other.alpha += change;
        for (Eigen::Index i = 0; i < test.plastic_strain.size(); ++i)
            sum += std::pow(flow_stress(other, test.plastic_strain[i]).stress - test.stress_MPa[i], 2);
        EXPECT_GT(std::sqrt(sum / double(test.plastic_strain.size())), mixed.rms_MPa);
    }
}

TEST(TensileTest, ElasticityStrengthAndNeckAreThoseOfTheBar)
{
    const TensileTest test = read(csv(pulled(Swift{565.32, 0.007117, 0.2589}, 0.4), "engineering strain,stress MPa"));
    EXPECT_TRUE(test.measured_young);
    EXPECT_NEAR(test.young_MPa, young, 0.02 * young);
    // Considere: n - e0 of plastic strain, and there s = K n^n exp(-eps)
    const double plastic = 0.2589 - 0.007117, sigma = 565.32 * std::pow(0.2589, 0.2589);
    EXPECT_NEAR(test.uniform_strain, plastic + sigma / young, 0.02); // the top is flat
    EXPECT_NEAR(test.tensile_strength_MPa, sigma * std::exp(-plastic - sigma / young), 0.5);
    EXPECT_LE(test.plastic_strain.maxCoeff(), test.uniform_strain);
    EXPECT_GE(test.plastic_strain.minCoeff(), 0.002);
    EXPECT_NEAR(test.proof_stress_MPa, 565.32 * std::pow(0.009117, 0.2589), 3);
    const TensileTest given = read(csv(steel, "engineering strain,stress MPa"), {.young_MPa = 200000});
    EXPECT_EQ(given.young_MPa, 200000);
    EXPECT_FALSE(given.measured_young);
}

TEST(TensileTest, AFootOfTheCurveIsTakenOff)
{
    const TensileTest plain = read(csv(steel, "engineering strain,stress MPa"));
    const Bar late = pulled(Swift{565.32, 0.007117, 0.2589}, 0, 600, 7, 0.001);
    const TensileTest shifted = read(csv(late, "engineering strain,stress MPa"));
    EXPECT_NEAR(shifted.uniform_strain, plain.uniform_strain, 1e-5);
    EXPECT_NEAR(shifted.proof_stress_MPa, plain.proof_stress_MPa, 1.5);
}

TEST(TensileTest, EveryWayToWriteTheSameRowsReadsTheSame)
{
    const std::string heading = "engineering strain,engineering stress MPa";
    const TensileTest plain = read(csv(steel, heading));
    const auto expect_same = [&](const std::string& text, const TensileOptions& options = {}) {
        const TensileTest other = read(text, options);
        ASSERT_EQ(other.stress_MPa.size(), plain.stress_MPa.size()) << text.substr(0, 60);
        EXPECT_LT((other.stress_MPa - plain.stress_MPa).cwiseAbs().maxCoeff(), 1e-4) << text.substr(0, 60);
        EXPECT_LT((other.plastic_strain - plain.plastic_strain).cwiseAbs().maxCoeff(), 1e-7) << text.substr(0, 60);
    };
    expect_same(csv(steel, "# a bar\n# engineering\nstrain;stress", ';'));
    expect_same(csv(steel, "engineering\nstrain;stress", ';', 1, ','));
    expect_same(csv(steel, "engineering\nstrain\tstress [N/mm2]", '\t', 1, ','));
    expect_same(csv(steel, "engineering\nstrain stress", ' ', 1, ','));
    expect_same(csv(steel, "\xef\xbb\xbf\"Engineering strain [%]\";\"Stress [MPa]\"", ';', 100));
    expect_same(csv(steel, "engineering", ';', 100)); // too large for a fraction
    expect_same(csv(steel, "strain;stress\n%;MPa", ';', 100), {.kind = TensileOptions::Kind::engineering});
    expect_same(csv(steel, "no word of it", ';', 100), {.kind = TensileOptions::Kind::engineering, .in_percent = true});
    std::string crlf = csv(steel, heading + "\n");
    for (size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2)
        crlf.insert(at, 1, '\r');
    expect_same(crlf);
    Bar swapped{steel.stress, steel.strain};
    expect_same(csv(swapped, "engineering stress MPa,engineering strain"));
    Bar truly = steel;
    for (size_t i = 0; i < truly.strain.size(); ++i) {
        truly.stress[i] *= 1 + steel.strain[i];
        truly.strain[i] = std::log1p(steel.strain[i]);
    }
    expect_same(csv(truly, "true strain,true stress MPa"));
}

TEST(TensileTest, WhatCannotBeATensileTestIsRefusedWithItsLine)
{
    const std::string good = csv(steel, "engineering strain;stress MPa", ';');
    const auto refused = [](const std::string& text, const TensileOptions& options = {}) {
        return complaint([&] { read(text, options); });
    };
    EXPECT_EQ(refused(good), "no InputError");
    const auto with_line_5 = [&](const std::string& line) {
        size_t at = 0;
        for (int i = 0; i < 4; ++i)
            at = good.find('\n', at) + 1;
        return refused(good.substr(0, at) + line + good.substr(good.find('\n', at)));
    };
    for (const char* bad : {"0.1;nan", "0.1;inf", "0.1;1e999", "0.1;", ";200", "0.1", "0.1;2;3", "0.1;2x", "x;200",
                            "0.1;1.234,5", "0.1;--3", "total 3;4", "900;200", "-0.5;200", "0.1;2e8"})
        EXPECT_THAT(with_line_5(bad), AllOf(HasSubstr("bar.csv"), HasSubstr("line 5"))) << bad;
    EXPECT_THAT(refused("engineering\n0,1,200,3\n"), AllOf(HasSubstr("line 2"), HasSubstr("';'")));
    EXPECT_THAT(refused(""), HasSubstr("no row"));
    EXPECT_THAT(refused("engineering\nstrain;stress\n"), HasSubstr("no row"));
    EXPECT_THAT(refused(std::string("engineering\n0.1;2\0\n", 19)), HasSubstr("not a text file"));
    EXPECT_THAT(refused(csv(steel, "strain;stress", ';')),
                HasSubstr(mention(option::stress_measure, "engineering|true")));
    EXPECT_THAT(refused(csv(steel, "true and engineering", ';')),
                HasSubstr(mention(option::stress_measure, "engineering|true")));
    EXPECT_THAT(refused(csv(steel, "engineering strain;stress [GPa]", ';')), HasSubstr("gpa"));
    EXPECT_THAT(refused(csv(steel, "engineering strain;force [kN]", ';')), HasSubstr("MPa"));
    EXPECT_EQ(refused(csv(steel, "# load cell 10 kN, epsilon of the thickness\nengineering strain;stress", ';')),
              "no InputError");
    Bar tiny = steel;
    for (double& stress : tiny.stress)
        stress /= 1000; // GPa that nobody named
    EXPECT_THAT(refused(csv(tiny, "engineering", ';')), HasSubstr("MPa"));
    Bar reversed = steel;
    std::reverse(reversed.strain.begin(), reversed.strain.end());
    EXPECT_THAT(refused(csv(reversed, "engineering", ';')), HasSubstr("line 3"));
    Bar plastic_only; // no elastic rows
    for (size_t i = 0; i < steel.strain.size(); ++i)
        if (steel.strain[i] > 0.01) {
            plastic_only.strain.push_back(steel.strain[i]);
            plastic_only.stress.push_back(steel.stress[i]);
        }
    EXPECT_THAT(refused(csv(plastic_only, "engineering", ';')), HasSubstr(mention(option::young)));
    EXPECT_EQ(refused(csv(plastic_only, "engineering", ';'), {.young_MPa = young}), "no InputError");
    Bar soft = steel; // the strain of the machine's crosshead
    for (size_t i = 0; i < soft.strain.size(); ++i)
        soft.strain[i] += soft.stress[i] / 10000;
    EXPECT_THAT(refused(csv(soft, "engineering", ';')), HasSubstr("machine"));
    Bar brittle{{steel.strain.begin(), steel.strain.begin() + 5}, {steel.stress.begin(), steel.stress.begin() + 5}};
    EXPECT_THAT(refused(csv(brittle, "engineering", ';')), HasSubstr("too few"));
}

TEST(TensileTest, TheStrainOfTheMachineGivesTheSameCurveWithAGivenModulus)
{
    const TensileTest plain = read(csv(steel, "engineering", ';'));
    Bar soft = steel;
    for (size_t i = 0; i < soft.strain.size(); ++i)
        soft.strain[i] += soft.stress[i] / 20000;
    const TensileTest test = read(csv(soft, "engineering", ';'), {.young_MPa = young});
    const auto law = [](const TensileTest& t) {
        return std::get<Swift>(*fit_of(fit_hardening(t.plastic_strain, t.stress_MPa), "swift").law);
    };
    EXPECT_NEAR(law(test).n, law(plain).n, 1e-4);
    EXPECT_NEAR(law(test).K_MPa, law(plain).K_MPa, 0.1);
    EXPECT_NEAR(test.uniform_strain, plain.uniform_strain, 1e-4);
}

TEST(FitHardening, PointsThatCannotBeFittedAreRefused)
{
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(20, 0.01, 0.2);
    Eigen::VectorXd y = 300 + 500 * x.array();
    EXPECT_THROW(fit_hardening(x.head(7), y.head(7)), InputError);
    EXPECT_THROW(fit_hardening(x, y.head(9)), InputError);
    y[3] = -1;
    EXPECT_THAT(complaint([&] { fit_hardening(x, y); }), HasSubstr("point 3"));
    y[3] = std::nan("");
    EXPECT_THROW(fit_hardening(x, y), InputError);
}

TEST(FitHardening, ALawThatDoesNotDescribeTheCurveSaysWhy)
{
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, 0.01, 0.2);
    const Eigen::VectorXd softening = 300 - 100 * x.array();
    for (const LawFit& fit : fit_hardening(x, softening))
        EXPECT_TRUE(fit.law || !fit.reason.empty()) << fit.name;
    EXPECT_FALSE(fit_of(fit_hardening(x, softening), "voce").law);
}

} // namespace spia::tensile_test_test

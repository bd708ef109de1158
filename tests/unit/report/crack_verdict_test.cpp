#include "engine/report/figures/crack_verdict.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <string>
#include <utility>
#include <vector>

using testing::HasSubstr;

namespace spia {
namespace {

/// Two triangles, each stretched in one direction by an engineering strain; the limit is the same
/// at every minor strain.
Session stretched(double first, double second, std::optional<double> limit)
{
    Session session;
    auto part = std::make_shared<PartFile>();
    part->mesh.position.resize(3, 4);
    part->mesh.position << 0, 30, 30, 0, 0, 0, 30, 30, 0, 0, 0, 0;
    part->mesh.triangle.resize(3, 2);
    part->mesh.triangle << 0, 0, 1, 2, 2, 3;
    session.part = part;
    auto blank = std::make_shared<FlattenResult>();
    blank->report.converged = true;
    blank->report.system = SolvedSystem::strict;
    SheetFields& face = blank->face;
    face.strain_major.resize(2);
    face.strain_major << std::log(1 + first), std::log(1 + second);
    face.strain_minor = Eigen::VectorXd::Zero(2);
    face.thinning = Eigen::VectorXd::Constant(2, 0.05);
    session.blank = blank;
    auto limits = std::make_shared<LimitsResult>();
    if (limit) {
        FormingLimitCurve& curve = limits->curve.emplace();
        curve.minor = {-0.5, 0.5};
        curve.major = {std::log(1 + *limit), std::log(1 + *limit)};
    }
    limits->zones = zones(part->mesh, face, limits->curve ? &*limits->curve : nullptr, limits->settings);
    session.limits = limits;
    return session;
}

TEST(CrackVerdict, ASafePartSaysHowMuchOfTheLimitItUses)
{
    const CrackVerdict verdict = crack_verdict(stretched(0.248, 0.10, 0.40)); // 0.248 / 0.40 = 62 %
    EXPECT_EQ(verdict.kind, CrackVerdict::Kind::safe);
    EXPECT_NEAR(verdict.share, 0.62, 1e-12);
    EXPECT_EQ(verdict.face, 0);
    EXPECT_THAT(verdict.text, HasSubstr("No cracks expected: the greatest strain is 62 % of the forming limit."));
    EXPECT_THAT(verdict.text, testing::EndsWith(" Bending strains at radii are not included."));
    EXPECT_TRUE(verdict.sure);
}

TEST(CrackVerdict, BelowTheLimitByLessThanTheMarginIsAtTheLimit)
{
    const CrackVerdict verdict = crack_verdict(stretched(0.10, 0.36, 0.40)); // the margin is 0.10
    EXPECT_EQ(verdict.kind, CrackVerdict::Kind::at_limit);
    EXPECT_EQ(verdict.face, 1);
    EXPECT_THAT(verdict.text, HasSubstr("At the limit in 1 face: the greatest strain is 90 % of the forming limit"));
}

TEST(CrackVerdict, AboveTheLimitItCracksAndSaysWhere)
{
    const CrackVerdict verdict = crack_verdict(stretched(0.5, 0.1, 0.40), LengthUnit::inch);
    EXPECT_EQ(verdict.kind, CrackVerdict::Kind::cracks);
    // The middle of the first triangle is 20, 10, 0 mm.
    EXPECT_THAT(verdict.text, HasSubstr("Cracks expected in 1 face, first at 0.7874, 0.3937, 0 in"));
    EXPECT_THAT(verdict.text, HasSubstr("125 % of the forming limit"));
}

TEST(CrackVerdict, FacesThatThickenMoreThanAllowedMayWrinkle)
{
    Session session = stretched(0.1, 0.1, 0.40);
    EXPECT_THAT(crack_verdict(session).text, testing::Not(HasSubstr("Wrinkles")));
    auto limits = std::make_shared<LimitsResult>(*session.limits);
    SheetFields face = session.blank->face;
    face.thinning[1] = -0.15; // 10 % are allowed
    limits->zones = zones(session.part->mesh, face, &*limits->curve, limits->settings);
    session.limits = limits;
    EXPECT_THAT(crack_verdict(session).text,
                HasSubstr("Wrinkles are likely: 1 face thickens by more than the allowed 10 %."));
    EXPECT_EQ(crack_verdict(session).kind, CrackVerdict::Kind::safe);
    EXPECT_FALSE(crack_verdict(session).sure);
}

TEST(CrackVerdict, WithoutACurveItSaysThatItCannotTell)
{
    const CrackVerdict verdict = crack_verdict(stretched(0.5, 0.1, {}));
    EXPECT_EQ(verdict.kind, CrackVerdict::Kind::unknown);
    EXPECT_THAT(verdict.text, HasSubstr("cannot be judged"));
    EXPECT_THAT(verdict.text, HasSubstr("5.0 %"));
    EXPECT_EQ(crack_verdict(Session{}).kind, CrackVerdict::Kind::none);
}

TEST(CrackVerdict, SaysWhatItDoesNotKnow)
{
    Session session = stretched(0.1, 0.1, 0.40);
    EXPECT_THAT(crack_verdict(session).text, testing::Not(HasSubstr("guess")));
    auto limits = std::make_shared<LimitsResult>(*session.limits);
    limits->zones.distance[1] = std::nan("");
    session.limits = limits;
    EXPECT_THAT(crack_verdict(session).text,
                HasSubstr("It cannot be judged for 1 face, whose sheet has no forming limit curve."));
    EXPECT_FALSE(crack_verdict(session).sure);
}

/// In words that the step of the solver does not contradict.
TEST(CrackVerdict, OfAResultThatIsNotOfAllThatWasAskedForIsAGuess)
{
    const auto verdict_of = [](const std::function<void(SolveReport&)>& change) {
        Session session = stretched(0.1, 0.1, 0.40);
        auto blank = std::make_shared<FlattenResult>(*session.blank);
        change(blank->report);
        session.blank = blank;
        return crack_verdict(session);
    };
    EXPECT_TRUE(verdict_of([](SolveReport&) {}).sure);
    const std::vector<std::pair<std::function<void(SolveReport&)>, std::string>> weak = {
        {[](SolveReport& report) { report.converged = false, report.system = SolvedSystem::energy; },
         "The result has not converged, so this is a guess."},
        {[](SolveReport& report) { report.process_share = 0.25; },
         "The sheet bears 25 % of the tools' forces, of which the result is, so this is a guess."},
        {[](SolveReport& report) { report.system = SolvedSystem::continued, report.trusted_strain = 0.2; },
         "The hardening curve was continued from the strain 0.20 on, so this is a guess."},
        {[](SolveReport& report) { report.system = SolvedSystem::relaxed, report.relaxed_vertices = 3; },
         "Equilibrium was relaxed at 3 vertices, so this is a guess."}};
    for (const auto& [change, words] : weak) {
        const CrackVerdict verdict = verdict_of(change);
        EXPECT_EQ(verdict.kind, CrackVerdict::Kind::safe);
        EXPECT_FALSE(verdict.sure) << words;
        EXPECT_THAT(verdict.text, HasSubstr(words));
    }
}

} // namespace
} // namespace spia

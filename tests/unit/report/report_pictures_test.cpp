#include "engine/report/html/report_pictures.h"

#include <gtest/gtest.h>

#include "engine/options/part_options.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/report/report_samples.h"

namespace spia {

TEST(ReportPictures, AreOfWhatThereIs)
{
    Session session = session_of(dome, Stage::fit);
    const auto whole = drawn_pictures(session);
    ASSERT_EQ(whole.size(), 2);
    for (const ReportPicture& picture : whole)
        EXPECT_TRUE(picture.png.starts_with("\x89PNG\r\n\x1a\n")) << picture.title;
    EXPECT_NE(whole[0].title.find("thinning"), std::string::npos);
    EXPECT_NE(whole[1].title.find("NURBS surface"), std::string::npos);
    EXPECT_NE(drawn_pictures(session, LengthUnit::inch)[0].png, whole[0].png) << "sizes are told in inch";
    session.surface.reset();
    const auto quads = drawn_pictures(session);
    ASSERT_EQ(quads.size(), 2);
    EXPECT_EQ(quads[0].png, whole[0].png);
    EXPECT_EQ(quads[1].title, "Quad mesh on the part");
    session.lifted.reset();
    EXPECT_EQ(drawn_pictures(session).size(), 1);
}

TEST(ReportPictures, StandInTheReportWithItsOwnWords)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
    const std::vector<std::string> doubts = {"there is a gap of 25.4 mm; close it with " + mention(option::weld)};
    ReportOptions options;
    options.reader.lengths = LengthUnit::inch;
    write_html_report(folder / "r.html", session, drawn_pictures(session), options, doubts);
    std::string html = content_of(folder / "r.html");
    EXPECT_NE(html.find("<figcaption>Part and flat blank: thinning</figcaption>"), std::string::npos);
    EXPECT_NE(html.find("There is a gap of 1 in; close it with --weld."), std::string::npos);
    options.reader.words = [](std::string_view text) { return std::string(text.substr(0, text.find(';'))); };
    write_html_report(folder / "r.html", session, {}, options, doubts);
    html = content_of(folder / "r.html");
    EXPECT_NE(html.find("There is a gap of 1 in.<"), std::string::npos);
    EXPECT_EQ(html.find("--weld"), std::string::npos);
}

} // namespace spia

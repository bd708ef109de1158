#include "app/viewer/model/html_report.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "app/viewer/model/svg_chart.h"
#include "engine/core/error.h"
#include "engine/pipeline/outputs.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

std::string report(const fs::path& file, const Session& session, const std::vector<ReportPicture>& pictures = {},
                   const std::vector<std::string>& notes = {})
{
    write_html_report(file, session, pictures, notes);
    return content_of(file);
}

/// Undoes base64, by the table of RFC 4648.
std::string decoded(const std::string& text)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0, held = 0;
    for (const char c : text) {
        if (c == '=')
            break;
        bits = bits << 6 | unsigned(digits.find(c));
        held += 6;
        if (held >= 8)
            bytes += char(bits >> (held -= 8) & 0xff);
    }
    return bytes;
}

/// Names of the elements in a stack: every end must belong to the last open beginning.
std::string unbalanced(const std::string& html)
{
    std::vector<std::string> open;
    for (size_t at = 0; (at = html.find('<', at)) != std::string::npos;) {
        const size_t end = html.find('>', at);
        const std::string tag = html.substr(at + 1, end - at - 1);
        at = end;
        const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
        if (tag[0] == '!' || name == "meta" || name == "img" || tag.back() == '/')
            continue;
        if (tag[0] != '/')
            open.push_back(name);
        else if (open.empty() || "/" + open.back() != tag)
            return tag;
        else
            open.pop_back();
    }
    return open.empty() ? "" : open.back();
}

} // namespace

TEST(HtmlReport, IsOneWholeFileWithTheFiguresOfTheSession)
{
    const ScratchFolder folder;
    const Session session = viewer::document_of(dome, Stage::fit).session;
    const std::string html = report(folder / "r.html", session);
    EXPECT_EQ(unbalanced(html), "");
    EXPECT_EQ(html.find("http"), std::string::npos); // nothing from outside
    EXPECT_NE(html.find("dome.obj"), std::string::npos);
    EXPECT_NE(html.find(session.options.flatten.material.name.substr(0, 10)), std::string::npos);
    EXPECT_NE(html.find(fmt::format("{:.1f} %", 100 * session.blank->face.thinning.maxCoeff())), std::string::npos);
    EXPECT_NE(html.find(fmt::format("{} \u00d7 {} cells", session.grid->result.planar.columns,
                                    session.grid->result.planar.rows)),
              std::string::npos);
    EXPECT_EQ(html.find("class=\"note\""), std::string::npos); // nothing to mind
}

TEST(HtmlReport, CarriesPicturesByteForByte)
{
    const ScratchFolder folder;
    Session session = viewer::document_of(dome, Stage::solve).session;
    for (size_t more = 0; more < 3; ++more) { // every remainder by three
        std::string png = "\x89PNG\r\n\x1a\n" + std::string(more, '\xff');
        for (int i = 0; i < 256; ++i)
            png += char(i);
        const std::string html = report(folder / "r.html", session, {{"Part", png}});
        const size_t begin = html.find("base64,") + 7;
        EXPECT_EQ(decoded(html.substr(begin, html.find('"', begin) - begin)), png);
    }
    EXPECT_THROW(write_html_report(folder / "r.html", session, {{"Part", "GIF89a"}}), InputError);
}

TEST(HtmlReport, EscapesWhateverComesFromOutside)
{
    const ScratchFolder folder;
    fs::copy_file(dome, folder / "<script>&\"x'.obj");
    Document document = viewer::document_of(folder / "<script>&\"x'.obj", Stage::solve);
    document.session.options.flatten.material.name = "<b>steel</b>";
    document.session.options.flatten.material.source = "a < b & c";
    const std::string html =
        report(folder / "r.html", document.session, {{"<i>\"view\"", "\x89PNG\r\n\x1a\n"}}, {"<u>note"});
    EXPECT_EQ(unbalanced(html), "");
    for (const char* raw : {"<script>", "<b>steel", "a < b", "<i>", "<u>", "alt=\"<"})
        EXPECT_EQ(html.find(raw), std::string::npos) << raw;
    EXPECT_NE(html.find("&lt;script&gt;&amp;&quot;x&#39;.obj"), std::string::npos);
}

TEST(HtmlReport, SaysWhatMakesTheResultPoorer)
{
    const ScratchFolder folder;
    Session session = viewer::document_of(dome, Stage::solve).session;
    auto worse = std::make_shared<FlattenResult>(*session.blank);
    worse->report.system = SolvedSystem::energy;
    worse->report.reason = "the steps became too short";
    worse->necking_triangles = 1234;
    session.blank = worse;
    const std::string html = report(folder / "r.html", session);
    EXPECT_NE(html.find("<p class=\"note\"><b>Mind:</b> the steps became too short"), std::string::npos);
    EXPECT_NE(html.find("1234 triangles are strained beyond"), std::string::npos);
    session.blank = nullptr;
    EXPECT_THROW(write_html_report(folder / "r.html", session, {}), InputError);
}

TEST(SvgChart, PutsADecadeOfALogarithmicAxisAtEqualHeights)
{
    const std::string text = svg({"i", "r", true, false, {{"", "red", {{0, 1}, {1, 0.1}, {2, 0.01}, {3, 0}}}}});
    const size_t begin = text.find("points=\"") + 8;
    double x[3], y[3];
    int read = 0;
    ASSERT_EQ(
        std::sscanf(text.c_str() + begin, "%lf,%lf %lf,%lf %lf,%lf \"%n", x, y, x + 1, y + 1, x + 2, y + 2, &read), 6);
    EXPECT_GT(read, 0); // three points: zero has no logarithm
    EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.02);
    EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.02);
    EXPECT_GT(y[1], y[0]); // down the page
    EXPECT_EQ(svg({"i", "r", true, false, {{"", "red", {{0, 0}}}}}), "");
}

} // namespace spia::viewer

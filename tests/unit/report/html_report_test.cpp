#include "engine/report/html/html_report.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/report/figures/crack_verdict.h"
#include "engine/report/figures/statistics.h"
#include "engine/report/html/html_text.h"
#include "engine/report/html/svg_chart.h"
#include "engine/report/text/zone_look.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/report/report_samples.h"

namespace spia {
namespace {

namespace fs = std::filesystem;

std::string report(const fs::path& file, const Session& session, const std::vector<ReportPicture>& pictures = {},
                   const std::vector<std::string>& notes = {})
{
    write_html_report(file, session, pictures, {}, notes);
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
        std::string tag = html.substr(at + 1, end - at - 1);
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
    const Session session = session_of(dome, Stage::fit);
    const std::string html = report(folder / "r.html", session);
    EXPECT_EQ(unbalanced(html), "");
    EXPECT_EQ(html.find("http"), std::string::npos); // nothing from outside
    EXPECT_NE(html.find("dome.obj"), std::string::npos);
    EXPECT_NE(html.find(session.options.flatten.material.name.substr(0, 10)), std::string::npos);
    EXPECT_NE(html.find(fmt::format("{:.1f} %", 100 * session.blank->face.thinning.maxCoeff())), std::string::npos);
    EXPECT_NE(html.find(fmt::format("<span>Maximum thinning</span><b>{:.1f} <small>%",
                                    100 * session.blank->face.thinning.maxCoeff())),
              std::string::npos);
    const Eigen::Matrix2Xd& flat = session.blank->blank.position;
    const Eigen::Vector2d size = flat.rowwise().maxCoeff() - flat.rowwise().minCoeff();
    EXPECT_NE(html.find(fmt::format("<span>Blank</span><b>{:.1f} \u00d7 {:.1f} <small>mm", size[0], size[1])),
              std::string::npos);
    EXPECT_NE(html.find(fmt::format("{} \u00d7 {} cells", session.grid->result.planar.columns,
                                    session.grid->result.planar.rows)),
              std::string::npos);
    const size_t caution = html.find("class=\"note\"");
    ASSERT_NE(caution, std::string::npos);
    EXPECT_NE(html.find("surface", caution), std::string::npos)
        << "by default it runs through the nodes of the grid alone";
    EXPECT_EQ(html.find("class=\"note\"", caution + 1), std::string::npos) << "nothing else to mind";
}

TEST(HtmlReport, TellsWhatWasTried)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::grid);
    GridStage grid = *session.grid;
    grid.result.attempts = {{"first <way>", "3 cells fold", 0.25},
                            {"second way", "sound", 1.5, true, {{"of its own", "0.5 mm are left", 1, true, {}}}}};
    session.grid = std::make_shared<GridStage>(grid);
    const std::string html = report(folder / "r.html", session);
    EXPECT_EQ(unbalanced(html), "");
    const size_t at = html.find("<h2>Attempts</h2>");
    ASSERT_NE(at, std::string::npos);
    EXPECT_NE(html.find("<td>Blank</td>", at), std::string::npos);
    const size_t first = html.find("<td>Grid</td>", at), second = html.find("<b>Second way</b>", at);
    EXPECT_LT(first, html.find("First &lt;way&gt;</td>", at));
    EXPECT_LT(html.find("3 cells fold</td><td>0.25</td>", at), second);
    EXPECT_LT(second, html.find("<b>Of its own</b>", at));
    EXPECT_EQ(html.find("<td>Surface</td>", at), std::string::npos);
    ReportOptions options;
    options.reader.lengths = LengthUnit::inch;
    write_html_report(folder / "r.html", session, {}, options, {});
    EXPECT_NE(content_of(folder / "r.html").find("0.0197 in are left"), std::string::npos);
    options.tables.solver = false;
    write_html_report(folder / "r.html", session, {}, options, {});
    EXPECT_EQ(content_of(folder / "r.html").find("Attempts"), std::string::npos);
}

TEST(HtmlReport, ShowsTheFormingLimitsWithTheStrainDiagram)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
    session.options.limits.margin = 0.12;
    session = judge_limits(session);
    ASSERT_TRUE(session.limits);
    std::string html = report(folder / "r.html", session);
    EXPECT_EQ(unbalanced(html), "");
    const size_t at = html.find("<h2>Forming limits</h2>");
    ASSERT_NE(at, std::string::npos);
    EXPECT_NE(html.find("Major strain, logarithmic", at), std::string::npos);
    EXPECT_NE(html.find("stroke-dasharray=\"4 3\"", at), std::string::npos); // the margin
    EXPECT_NE(html.find("</tspan> forming limit<", at), std::string::npos);
    EXPECT_LT(html.find("<circle", at), html.find("</svg>", at)) << "a dot a face";
    EXPECT_NE(html.find("Keeler-Brazier: FLC0", at), std::string::npos);
    EXPECT_NE(html.find(definition(Zone::risk, session.limits->settings), at), std::string::npos);
    const Zones& zones = session.limits->zones;
    const ZoneShare& safe = zones.share[size_t(Zone::safe)];
    EXPECT_NE(
        html.find(fmt::format("<td>{}</td><td>{}</td></tr>", grouped(safe.faces), fixed(100 * safe.share, 2)), at),
        std::string::npos);
    const WorstSpot& worst = zones.spots.at(0);
    EXPECT_NE(html.find(fmt::format("<td>{}</td><td>{}</td><td>{}</td>", zone_words(worst.zone),
                                    fixed(100 * zones.distance[worst.face], 1), fixed(worst.strain_major, 3)),
                        at),
              std::string::npos);
    EXPECT_NE(html.find(crack_verdict(session).text), std::string::npos);
    session.options.limits.source = LimitsOptions::Source::none;
    session = judge_limits(session);
    html = report(folder / "r.html", session);
    EXPECT_NE(html.find("No forming limit curve"), std::string::npos);
    EXPECT_EQ(html.find("stroke-dasharray=\"4 3\""), std::string::npos);
    session.limits = nullptr;
    EXPECT_EQ(report(folder / "r.html", session).find("Forming limits"), std::string::npos);
}

TEST(HtmlReport, CarriesPicturesByteForByte)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
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
    Session session = session_of(folder / "<script>&\"x'.obj", Stage::solve);
    session.options.flatten.material.name = "<b>steel</b>";
    session.options.flatten.material.source = "a < b & c";
    const std::string html = report(folder / "r.html", session, {{"<i>\"view\"", "\x89PNG\r\n\x1a\n"}}, {"<u>note"});
    EXPECT_EQ(unbalanced(html), "");
    for (const char* raw : {"<script>", "<b>steel", "a < b", "<i>", "<u>", "alt=\"<"})
        EXPECT_EQ(html.find(raw), std::string::npos) << raw;
    EXPECT_NE(html.find("&lt;script&gt;&amp;&quot;x&#39;.obj"), std::string::npos);
}

TEST(HtmlReport, HasTheTablesThatWereChosenAndTheUsersOwnWords)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::fit);
    auto part = std::make_shared<PartFile>(*session.part);
    part->notes.emplace_back("it is a dome");
    session.part = part;
    const auto has = [&](const std::string& html, const char* text) { return html.find(text) != std::string::npos; };
    const std::pair<const char*, bool ReportTables::*> tables[] = {
        {"<h2>Key figures", &ReportTables::key_figures},
        {"<h2>Largest thinning", &ReportTables::worst_spots},
        {"<h2>Assumptions", &ReportTables::assumptions},
        {"<h2>Convergence of the solver", &ReportTables::solver},
        {"<h2>Input part", &ReportTables::repairs}};
    for (const auto& [only, member] : tables) {
        ReportOptions options;
        options.tables = {false, false, false, false, false};
        options.tables.*member = true;
        write_html_report(folder / "r.html", session, {}, options);
        const std::string html = content_of(folder / "r.html");
        EXPECT_EQ(unbalanced(html), "");
        for (const auto& [heading, unused] : tables)
            EXPECT_EQ(has(html, heading), heading == only) << heading << " with " << only;
    }
    ReportOptions options;
    options.title = "Door <left>";
    options.remarks = "line 1 & <script>\nline 2";
    write_html_report(folder / "r.html", session, {}, options);
    const std::string html = content_of(folder / "r.html");
    EXPECT_EQ(unbalanced(html), "");
    EXPECT_TRUE(has(html, "<h1>Door &lt;left&gt;</h1><p>dome.obj, "));
    EXPECT_TRUE(has(html, "<title>Unfolding report: Door &lt;left&gt;</title>"));
    EXPECT_TRUE(has(html, "line 1 &amp; &lt;script&gt;\nline 2"));
    EXPECT_FALSE(has(html, "<script>"));
}

TEST(HtmlReport, TheThinnestPlacesAreThoseOfTheInspectPanel)
{
    const ScratchFolder folder;
    const Session session = session_of(dome, Stage::solve);
    const Eigen::VectorXd& thinning = session.blank->face.thinning;
    const std::string html = report(folder / "r.html", session);
    int rank = 0;
    for (const int f : worst_spots(session.part->mesh, thinning, 5, false))
        if (thinning[f] > 0) {
            const std::string begin = fmt::format("<tr><td>{}</td><td>{:.1f}</td>", ++rank, 100 * thinning[f]);
            const size_t at = html.find(begin);
            ASSERT_NE(at, std::string::npos) << begin;
            const std::string face = fmt::format("<td>{}</td></tr>", session.part->source_face[size_t(f)]);
            EXPECT_EQ(html.find("</tr>", at) + 5, html.find(face, at) + face.size()) << rank;
        }
    EXPECT_GT(rank, 1);
    EXPECT_EQ(html.find(fmt::format("<tr><td>{}</td><td>", rank + 1)), std::string::npos);
}

TEST(HtmlReport, TheAssumptionsNameWhatWasRelaxedAndRepaired)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
    const auto row_of = [&](const std::string& name) {
        const std::string html = report(folder / "r.html", session);
        const size_t at = html.find("<tr><td>" + name + "</td><td>");
        return at == std::string::npos ? "no row" : html.substr(at, html.find("</tr>", at) - at);
    };
    const auto says = [&](const char* row, const std::string& words) {
        EXPECT_NE(row_of(row).find(words), std::string::npos) << row_of(row);
    };
    says("Friction", "none");
    says("Sheet thickness", "1 mm");
    says("Method", "one step");
    says("Stamping direction", "found automatically");
    says("Equations", "nothing was relaxed");
    says("Repairs of the mesh", "none");
    auto relaxed = std::make_shared<FlattenResult>(*session.blank);
    relaxed->report.system = SolvedSystem::relaxed;
    relaxed->report.relaxed_vertices = 37;
    session.blank = relaxed;
    auto part = std::make_shared<PartFile>(*session.part);
    part->doctor.findings.push_back({{}, spia::Severity::repaired, 2, 0, "2 doubled faces were removed", ""});
    session.part = part;
    session.options.flatten.direction = Eigen::Vector3d(0, 0, -1);
    says("Equations", "equilibrium of 37 vertices");
    says("Repairs of the mesh", "2 doubled faces were removed");
    says("Stamping direction", "as given");
}

TEST(HtmlReport, TheAssumptionsNameAllThatActsOnTheSheet)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
    ProcessConditions& process = session.options.flatten.process;
    process.contact = {{"binder", {0, 1}, 2., {}, 0.12, 2}};
    process.drawbeads = {{"bead", {{0, 0, 0}, {30, 40, 0}}, 25}};
    process.edge_restraint = 0.25;
    process.pilots = {{"pin", {{0, 0, 0}}}};
    session.options.k_factor = constant_k(0.44);
    const AppliedProcess applied = applied_process(session);
    const auto has = [](const std::string& html, const std::string& name, const std::string& words) {
        const size_t at = html.find("<tr><td>" + name + "</td><td>");
        ASSERT_NE(at, std::string::npos) << name;
        const std::string row = html.substr(at, html.find("</tr>", at) - at);
        EXPECT_NE(row.find(words), std::string::npos) << row;
    };
    std::string html = report(folder / "r.html", session);
    has(html, "Contact: binder", "2 MPa on 2 faces of ");
    has(html, "Contact: binder", "friction 0.12 on both sides");
    has(html, "Drawbead: bead", "25 N/mm over 50 mm");
    has(html, "Outer edge", "held by 25 % of the lock force");
    has(html, "Outer edge", fmt::format("{:.3g}", 0.25 * applied.lock_force_N_mm));
    has(html, "Pilot: pin", "a point is held");
    has(html, "K factor of bends", "0.44");
    session.options.steps = BlankOfSteps{std::make_shared<UnfoldRun>(), false};
    html = report(folder / "r.html", session);
    has(html, "Tools, friction", "the steps leave them out");
    EXPECT_EQ(html.find("Contact: binder"), std::string::npos);
}

TEST(HtmlReport, SaysWhatMakesTheResultPoorer)
{
    const ScratchFolder folder;
    Session session = session_of(dome, Stage::solve);
    auto worse = std::make_shared<FlattenResult>(*session.blank);
    worse->report.system = SolvedSystem::energy;
    worse->report.reason = "the steps became too short";
    worse->necking_triangles = 1234;
    session.blank = worse;
    const std::string html = report(folder / "r.html", session);
    EXPECT_NE(html.find("<p class=\"note\"><b>Caution:</b> The steps became too short"), std::string::npos);
    EXPECT_NE(html.find("1234 triangles are strained beyond"), std::string::npos);
    const std::string judged = report(folder / "r.html", session, {}, {"the thickness 1 mm is assumed"});
    EXPECT_NE(judged.find("<b>Caution:</b> The thickness 1 mm is assumed.</p>"), std::string::npos)
        << "what the lights of the window say";
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

} // namespace spia

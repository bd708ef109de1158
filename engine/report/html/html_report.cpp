#include "engine/report/html/html_report.h"

#include <fmt/core.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/text/text_encoding.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/figures/crack_verdict.h"
#include "engine/report/html/html_text.h"
#include "engine/report/html/report_attempts.h"
#include "engine/report/html/report_limits.h"
#include "engine/report/html/report_tables.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/sentence.h"

namespace spia {
namespace {

std::string header(const Session& session, const std::string& title)
{
    const PartFile& part = *session.part;
    const std::string file = session.file.filename().string();
    return fmt::format("<header><div><p>Unfolding report</p><h1>{}</h1><p>{}{}, {} triangles</p></div>"
                       "<div class=\"right\"><p>{}</p><p>{}</p></div></header>\n",
                       escaped(title.empty() ? file : title), title.empty() ? "" : escaped(file) + ", ",
                       escaped(part.format), grouped(part.mesh.triangles()), escaped(time_stamp("%Y-%m-%d %H:%M UTC")),
                       escaped(program_name()));
}

/// The user's own words; the style keeps their lines.
std::string remarks_html(const std::string& remarks)
{
    return remarks.empty() ? "" : fmt::format("<p class=\"remarks\">{}</p>\n", escaped(remarks));
}

std::string all_doubts(const Session& session, const std::vector<std::string>& doubts, const ReportReader& reader)
{
    std::string text;
    for (const std::string& each : doubts.empty() ? shortcomings(session) : doubts)
        text += fmt::format("<p class=\"note\"><b>Caution:</b> {}</p>\n", escaped(sentence(reader.told(each))));
    return text.empty() ? "" : fmt::format("<section class=\"notes\">\n{}</section>\n", text);
}

std::string crack_words(const Session& session, LengthUnit lengths)
{
    const CrackVerdict verdict = crack_verdict(session, lengths);
    return verdict.text.empty() ? "" : fmt::format("<p class=\"note plain\">{}</p>\n", escaped(verdict.text));
}

std::string pictures_html(const std::vector<ReportPicture>& pictures)
{
    std::string text;
    for (const ReportPicture& picture : pictures) {
        if (!picture.png.starts_with("\x89PNG\r\n\x1a\n"))
            throw InputError(
                fmt::format("the picture \"{}\" is no PNG file; leave it out of the report", picture.title));
        text += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption>"
                            "</figure>\n",
                            escaped(picture.title), base64(picture.png));
    }
    return text.empty() ? "" : "<h2>Pictures</h2>\n" + text;
}

} // namespace

void write_html_report(const std::filesystem::path& file, const Session& session,
                       const std::vector<ReportPicture>& pictures, const ReportOptions& options,
                       const std::vector<std::string>& doubts)
{
    if (!session.part || !session.blank)
        throw InputError("a report needs a solved part; unfold the part first");
    const ResultFigures figures = result_figures(session);
    const std::string name = session.file.filename().string();
    const ReportTables& wanted = options.tables;
    const LengthUnit lengths = options.reader.lengths;
    std::string html = header(session, options.title) + remarks_html(options.remarks) +
                       tiles(session, figures, lengths) + all_doubts(session, doubts, options.reader) +
                       crack_words(session, lengths);
    if (wanted.key_figures)
        html += key_figures(session, figures, lengths) + bend_table(session, options.reader);
    if (wanted.worst_spots)
        html += thinnest_places(session, lengths) + limits_section(session, lengths);
    if (wanted.assumptions)
        html += assumptions(session, lengths);
    if (wanted.solver)
        html += solving(session, lengths) + attempts_section(session, options.reader);
    if (wanted.repairs)
        html += repairs(*session.part, options.reader);
    html += pictures_html(pictures);
    html += fmt::format("<footer>Made by {} from {}. Lengths in {}, stresses in MPa, strains logarithmic.</footer>\n",
                        escaped(program_name()), escaped(session.file.string()),
                        lengths == LengthUnit::inch ? "inch" : "mm");
    write_atomically(file, html_page("Unfolding report: " + (options.title.empty() ? name : options.title), html));
}

} // namespace spia

#include "engine/report/html/report_attempts.h"

#include <fmt/core.h>

#include "engine/exchange/text/text_encoding.h"
#include "engine/report/html/html_text.h"
#include "engine/report/text/sentence.h"

namespace spia {
namespace {

/// In their order, those within below theirs and set in; winners in bold.
std::string rows_of(const std::vector<AttemptReport>& attempts, const std::string& stage, const ReportReader& reader,
                    int depth = 0)
{
    std::string rows;
    for (const AttemptReport& each : attempts) {
        const std::string name = escaped(as_sentence(each.name));
        rows += fmt::format("<tr><td>{}</td><td style=\"text-align:left;padding-left:{}em\">{}</td>"
                            "<td style=\"text-align:left\">{}</td><td>{}</td></tr>\n",
                            depth == 0 && &each == &attempts.front() ? stage : "", 1 + depth,
                            each.won ? "<b>" + name + "</b>" : name, escaped(reader.told(each.reason)),
                            fixed(each.seconds, 2));
        rows += rows_of(each.within, stage, reader, depth + 1);
    }
    return rows;
}

} // namespace

std::string attempts_section(const Session& session, const ReportReader& reader)
{
    std::string rows;
    if (session.blank)
        rows += rows_of(session.blank->report.attempts, "Blank", reader);
    if (session.grid)
        rows += rows_of(session.grid->result.attempts, "Grid", reader);
    if (session.surface && session.surface->fit)
        rows += rows_of(session.surface->fit->attempts, "Surface", reader);
    if (rows.empty())
        return "";
    return fmt::format("<section class=\"whole\"><h2>Attempts</h2>\n<table class=\"spots\"><tr><th></th><th "
                       "style=\"text-align:left\">Tried in this order, the one taken in bold</th><th "
                       "style=\"text-align:left\">Result</th><th>s</th></tr>\n{}</table></section>\n",
                       rows);
}

} // namespace spia

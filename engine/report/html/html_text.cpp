#include "engine/report/html/html_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

constexpr const char* style = R"(
:root { --ink: #1f2933; --soft: #59636f; --line: #dfe3e8; --accent: #1f5f8b; }
* { box-sizing: border-box; }
body { margin: 0; background: #eef0f3; color: var(--ink); font: 10pt/1.45 Inter, "Helvetica Neue", Arial, sans-serif;
       font-variant-numeric: tabular-nums; }
main { width: 210mm; max-width: 100%; margin: 8mm auto; padding: 16mm 17mm; background: #fff; }
header { display: flex; justify-content: space-between; align-items: flex-end; gap: 8mm;
         padding-bottom: 4mm; border-bottom: 0.7mm solid var(--accent); }
header p { margin: 0; color: var(--soft); font-size: 9pt; }
header .right { text-align: right; white-space: nowrap; }
h1 { margin: 0 0 0.5mm; font-size: 20pt; line-height: 1.15; font-weight: 650; overflow-wrap: anywhere; }
h2 { margin: 8mm 0 2.5mm; font-size: 12pt; font-weight: 650; break-after: avoid; }
h3 { margin: 0 0 1mm; font-size: 9pt; font-weight: 600; color: var(--soft); }
section.whole { break-inside: avoid; }
.tiles { display: grid; grid-template-columns: repeat(4, 1fr); gap: 3mm; margin: 6mm 0 0; }
.tile { padding: 3mm 3.5mm; border: 0.25mm solid var(--line); border-radius: 1.5mm; break-inside: avoid; }
.tile b { display: block; margin: 0.5mm 0; font-size: 14pt; line-height: 1.2; font-weight: 650; white-space: nowrap; }
.tile small { font-size: 9pt; font-weight: 500; color: var(--soft); }
.tile span { font-size: 8.5pt; color: var(--soft); }
.note { margin: 3mm 0 0; padding: 2.5mm 4mm; border-left: 1mm solid #d97706; background: #fdf3e1; border-radius: 0 1mm 1mm 0;
        break-inside: avoid; overflow-wrap: anywhere; }
.note.plain { border-color: #8a93a0; background: #f3f5f7; }
.note b { color: #92400e; }
.notes { margin-top: 5mm; }
.remarks { margin: 5mm 0 0; white-space: pre-line; overflow-wrap: anywhere; }
table { width: 100%; border-collapse: collapse; }
td, th { padding: 1.15mm 2mm 1.15mm 0; border-bottom: 0.2mm solid var(--line); text-align: left; vertical-align: top; }
tr { break-inside: avoid; }
th { font-size: 8.5pt; font-weight: 600; color: var(--soft); }
.facts td:first-child { width: 52mm; color: var(--soft); }
.facts td { overflow-wrap: anywhere; }
.spots td, .spots th { text-align: right; }
.spots td:first-child, .spots th:first-child { text-align: left; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 7mm; }
.pair > div { break-inside: avoid; }
svg { display: block; width: 100%; height: auto; font-family: inherit; }
figure { margin: 0 0 5mm; break-inside: avoid; }
figure img { display: block; width: 100%; max-height: 120mm; object-fit: contain; border: 0.25mm solid var(--line);
             border-radius: 1mm; }
sup { line-height: 0; font-size: 75%; }
figcaption { margin-top: 1mm; font-size: 8.5pt; color: var(--soft); }
footer { margin-top: 8mm; padding-top: 2mm; border-top: 0.2mm solid var(--line); font-size: 8pt; color: var(--soft); }
@page { size: A4; margin: 14mm 15mm; }
@media print {
  body { background: #fff; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  main { width: auto; margin: 0; padding: 0; }
}
@media (max-width: 700px) { .tiles, .pair { grid-template-columns: 1fr 1fr; } .pair { grid-template-columns: 1fr; } main { padding: 6mm; } }
)";

/// A minus sign as printers set it.
std::string typeset(std::string text)
{
    for (size_t at = 0; (at = text.find('-', at)) != std::string::npos; at += 3)
        text.replace(at, 1, "\u2212");
    return text;
}

} // namespace

std::string fixed(double value, int digits)
{
    const std::string text = fmt::format("{:.{}f}", value, digits);
    return typeset(text.find_first_of("123456789") == std::string::npos && value < 0 ? text.substr(1)
                                                                                     // no -0.0
                                                                                     : text);
}
std::string significant(double value) { return typeset(fmt::format("{:.3g}", value)); }

std::string power_of_ten(double value)
{
    if (!(value > 0))
        return fixed(value, 0);
    const int exponent = int(std::floor(std::log10(value)));
    return fmt::format("{:.1f} \u00b7 10<sup>{}</sup>", value * std::pow(10, -exponent),
                       typeset(std::to_string(exponent)));
}

std::string grouped(double value, int digits)
{
    std::string text = fmt::format("{:.{}f}", value, digits);
    const size_t end = std::min(text.find('.'), text.size());
    for (size_t at = end; at > size_t(value < 0 ? 4 : 3); at -= 3)
        text.insert(at - 3, "\u202f");
    return typeset(text);
}

std::string row(const std::string& what, const std::string& value)
{
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(what), escaped(value));
}

std::string html_row(const std::string& what, const std::string& html)
{
    return fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(what), html);
}

std::string facts(const char* heading, const std::string& rows)
{
    return fmt::format("<section class=\"whole\"><h2>{}</h2>\n<table class=\"facts\">\n{}</table></section>\n", heading,
                       rows);
}

std::string vector_text(const Eigen::Vector3d& v)
{
    return fmt::format("({}, {}, {})", fixed(v[0], 3), fixed(v[1], 3), fixed(v[2], 3));
}

std::string tile(const std::string& what, const std::string& value, const std::string& unit, const std::string& more)
{
    return fmt::format("<div class=\"tile\"><span>{}</span><b>{} <small>{}</small></b><span>{}</span></div>\n",
                       escaped(what), escaped(value), escaped(unit), escaped(more));
}

std::string html_page(const std::string& title, const std::string& body)
{
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n</html>\n",
                       escaped(title), style, body);
}

} // namespace spia

#include "engine/report/html/report_limits.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/exchange/text/text_encoding.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/html/html_text.h"
#include "engine/report/html/svg_chart.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/shown_lengths.h"
#include "engine/report/text/zone_look.h"

namespace spia {
namespace {

/// The curve over the strains of the part, and a little further.
ChartCurve limit_curve(const FormingLimitCurve& curve, double from, double to, double margin)
{
    ChartCurve drawn{margin > 0 ? "margin" : "forming limit", "#c0261c", {}};
    drawn.dashed = margin > 0;
    constexpr int pieces = 120;
    for (int i = 0; i <= pieces; ++i) {
        const double minor = from + (to - from) * i / pieces;
        drawn.points.emplace_back(minor, logarithmic_strain(engineering_strain(curve(minor)) - margin));
    }
    return drawn;
}

/// One dot per face; of the many that lie over each other in safe zones a few thousand are enough.
std::vector<ChartCurve> dots(const LimitsResult& limits, const SheetFields& face)
{
    constexpr int most_per_zone = 1200;
    std::vector<ChartCurve> drawn;
    // the worst on top
    for (auto zone = std::rbegin(all_zones); zone != std::rend(all_zones); ++zone) {
        ChartCurve curve{"", hex(zone_colour(*zone)), {}, true, false};
        const int faces = limits.zones.share[size_t(*zone)].faces, stride = 1 + (faces - 1) / most_per_zone;
        int seen = 0;
        for (size_t f = 0; f < limits.zones.zone.size(); ++f)
            if (limits.zones.zone[f] == *zone && seen++ % stride == 0)
                curve.points.emplace_back(face.strain_minor[Eigen::Index(f)], face.strain_major[Eigen::Index(f)]);
        drawn.push_back(std::move(curve));
    }
    return drawn;
}

std::string strain_diagram(const LimitsResult& limits, const SheetFields& face)
{
    std::vector<ChartCurve> curves = dots(limits, face);
    if (limits.curve) {
        const double least = 0.1;
        const double from = std::min(face.strain_minor.minCoeff(), -least),
                     to = std::max(face.strain_minor.maxCoeff(), least);
        curves.push_back(limit_curve(*limits.curve, from, to, 0));
        if (limits.settings.margin > 0)
            curves.push_back(limit_curve(*limits.curve, from, to, limits.settings.margin));
    }
    return svg({"minor strain, logarithmic", "Major strain, logarithmic", false, true, curves});
}

std::string zone_table(const LimitsResult& limits)
{
    std::string rows;
    for (const Zone zone : all_zones) {
        const ZoneShare& share = limits.zones.share[size_t(zone)];
        rows += fmt::format("<tr><td><b style=\"color:{}\">\u25a0</b> {}</td>"
                            "<td style=\"text-align:left\">{}</td><td>{}</td><td>{}</td></tr>\n",
                            hex(zone_colour(zone)), zone_words(zone), escaped(definition(zone, limits.settings)),
                            grouped(share.faces), fixed(100 * share.share, 2));
    }
    return fmt::format("<table class=\"spots\"><tr><th>Zone</th>"
                       "<th style=\"text-align:left\">Definition</th><th>Faces</th><th>Area, %</th></tr>\n"
                       "{}</table>\n",
                       rows);
}

std::string spot_table(const LimitsResult& limits, const PartFile& part, LengthUnit lengths)
{
    constexpr size_t most = 10;
    const auto& spots = limits.zones.spots;
    std::string rows;
    for (size_t i = 0; i < std::min(spots.size(), most); ++i) {
        const WorstSpot& spot = spots[i];
        const auto margin = margin_of(limits, spot.face);
        const Eigen::Vector3d at = spot.position / millimetres(lengths);
        const int decimals = 1 + more_decimals(lengths);
        rows +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}, {}, {}</td>"
                        "<td>{}</td></tr>\n",
                        zone_words(spot.zone), margin ? fixed(100 * *margin, 1) : "\u2013", fixed(spot.strain_major, 3),
                        fixed(spot.strain_minor, 3), fixed(100 * spot.thinning, 1), fixed(at[0], decimals),
                        fixed(at[1], decimals), fixed(at[2], decimals), part.source_face[size_t(spot.face)]);
    }
    if (rows.empty())
        return "";
    return fmt::format(
        "<table class=\"spots\"><tr><th>Worst spot</th><th>Margin, points</th><th>Major strain</th><th>Minor "
        "strain</th><th>Thinning, %</th><th>At x, y, z, {}</th><th>Face of the file</th></tr>\n{}</table>\n<p>Margin: "
        "percentage points of engineering major strain below the forming limit curve; negative beyond it. Thinning: "
        "negative where the sheet became thicker.</p>\n",
        length_word(lengths), rows);
}

} // namespace

std::string limits_section(const Session& session, LengthUnit lengths)
{
    if (!session.limits)
        return "";
    const LimitsResult& limits = *session.limits;
    std::string text =
        "<section class=\"whole\"><h2>Forming limits</h2>\n" + strain_diagram(limits, session.blank->face);
    text += fmt::format("<p>{}.</p>\n", limits.curve ? escaped(in_shown_lengths(limits.curve->formula, lengths))
                                                     : "No forming limit curve");
    for (const std::string& note : limits.notes)
        text += fmt::format("<p class=\"note plain\">{}</p>\n", escaped(in_shown_lengths(note, lengths)));
    return text + zone_table(limits) + spot_table(limits, *session.part, lengths) + "</section>\n";
}

} // namespace spia

#include "engine/pipeline/blank/drawn_blank.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/small_dense.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/blank_marks.h"
#include "engine/pipeline/blank/parts_of_table.h"
#include "engine/pipeline/blank/sharp_folds.h"
#include "engine/pipeline/blank/stated_outline.h"
#include "engine/unfold/plan/free_ends.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {
namespace {

/// Thickness of the flat sheet, mm, where a bend is; a sharp one has no faces of its own.
double thickness_at(const BendMap& map, size_t bend, const SheetFields& face)
{
    const int label = map.label_of_bend(bend) >= 0 ? map.label_of_bend(bend) : map.bends[bend].a;
    for (Eigen::Index f = 0; f < map.label.size(); ++f)
        if (map.label[f] == label)
            return face.thickness[f] / (1 - face.thinning[f]);
    return 0;
}

/// Puts lines onto the straight one along all of them, which a hole or a notch parts, each from its
/// first point to its last: what a press brake makes is straight. On a mesh whose edges do not run
/// along a bend its lines waver by about one of them, as the band of its faces does.
/// @returns false, and leaves them, if they are not straight but for that
bool straighten(const Bend& bend, std::vector<Eigen::Matrix2Xd>& lines)
{
    constexpr double of_strip = 1. / 3, of_length = 0.03, rounding = 1e-3;
    Eigen::Index count = 0;
    for (const Eigen::Matrix2Xd& line : lines)
        count += line.cols();
    if (count == 0)
        return true;
    Eigen::Matrix2Xd all(2, count);
    count = 0;
    for (const Eigen::Matrix2Xd& line : lines) {
        all.middleCols(count, line.cols()) = line;
        count += line.cols();
    }
    const Eigen::Vector2d middle = all.rowwise().mean();
    const Eigen::Matrix2Xd arm = all.colwise() - middle;
    const Eigen::Vector2d way = longest_axis(arm);
    const Eigen::RowVectorXd off = way[0] * arm.row(1) - way[1] * arm.row(0), along = way.transpose() * arm;
    const double length = along.maxCoeff() - along.minCoeff(),
                 within = std::min(of_length * length,
                                   std::max(of_strip * bend.radius * std::abs(bend.angle), rounding * length));
    if (off.cwiseAbs().maxCoeff() > within)
        return false;
    for (Eigen::Matrix2Xd& line : lines) {
        Eigen::Matrix2Xd straight(2, 2);
        for (const Eigen::Index end : {Eigen::Index(0), line.cols() - 1})
            straight.col(end == 0 ? 0 : 1) = middle + way * way.dot(line.col(end) - middle);
        if (straight.col(0) == straight.col(1))
            return false;
        line = straight;
    }
    return true;
}

Eigen::Matrix2Xd flat_points(const SheetLine& line)
{
    Eigen::Matrix2Xd points = line.point.topRows<2>();
    if (line.closed) {
        points.conservativeResize(2, points.cols() + 1);
        points.rightCols<1>() = points.col(0);
    }
    return points;
}

/// The middle of its strip, and the tangent lines on both sides.
DrawnBend drawn_bend(const SheetBend& bend, std::string name)
{
    DrawnBend drawn;
    drawn.name = std::move(name);
    drawn.angle = bend.angle;
    drawn.inner_radius = bend.inner_radius;
    drawn.k = bend.sharp ? std::nullopt : std::optional(bend.k);
    drawn.allowance = bend.allowance;
    drawn.deduction = bend.deduction;
    drawn.up = bend.up;
    for (const BlankSegment& segment : bend.line) {
        const Eigen::Vector2d way = segment.to - segment.from;
        if (!(way.norm() > 0))
            continue;
        const Eigen::Vector2d aside = Eigen::Vector2d(-way.y(), way.x()).normalized() * bend.allowance / 2;
        Eigen::Matrix2Xd line(2, 2);
        line << segment.from, segment.to;
        drawn.middle.push_back(line);
        if (bend.laid && !bend.sharp) // else the strip is not as broad as that
            for (const double side : {1., -1.})
                drawn.zone.push_back(line.colwise() + side * aside);
    }
    return drawn;
}

} // namespace

BlankDrawing drawn_blank(const PartFile& part, const BendMap& map, const Blank& blank, const SheetFields& face,
                         bool straight_only, const BendTable* table)
{
    BlankDrawing drawing = stated_outline(part, blank);
    drawing.marks = marks_on_blank(part, blank);
    if (table) {
        drawing.lengths_of = table->surface;
        drawing.thickness = table->thickness;
    }
    const std::vector<SheetLine> lines = bend_lines(part.mesh, map, blank.position);
    std::vector<char> taken;
    const std::vector<int> known = table ? bends_in_table(map, *table, taken) : std::vector<int>(map.bends.size(), -1);
    const std::vector<char> part_of_known =
        table ? parts_of_table(part.mesh, map, *table) : std::vector<char>(map.bends.size(), 0);
    const FreeEnds ends(part.mesh);
    // A shop reads the drawing beside the table: bends have the numbers of its rows, others those
    // after them.
    const bool as_in_table = straight_only && table;
    size_t others = table ? table->bends.size() : 0;
    for (size_t k = 0; k < map.bends.size(); ++k) {
        const Bend& bend = map.bends[k];
        // triangles that the rim of a hole tilts turn by less
        constexpr double least = 0.5 * std::numbers::pi / 180;
        if (known[k] < 0 && (part_of_known[k] || (table && std::abs(bend.angle) < least)))
            continue;
        if (straight_only && known[k] < 0 &&
            ((table && bend.faces == 0) || !ends.of(map, k, blank.position) || is_within_a_face(part, map, k)))
            continue; // sharp ones are in the table
        const SheetBend* stated =
            known[k] >= 0 && !table->bends[size_t(known[k])].line.empty() ? &table->bends[size_t(known[k])] : nullptr;
        const std::string name = map.name(int(map.regions.size() + k));
        DrawnBend drawn;
        if (stated)
            drawn = drawn_bend(*stated, as_in_table ? fmt::format("bend {}", known[k] + 1) : name);
        else {
            drawn.name = name;
            drawn.angle = std::abs(bend.angle);
            const bool bulges = bend.angle > 0; // the outer side, from which the blank is seen: the
                                                // legs go down
            drawn.up = !bulges;
            drawn.k.reset();
            if (bend.faces > 0) {
                drawn.k = laid_fibre(part, bulges);
                drawn.inner_radius = std::max(bend.radius - *drawn.k * thickness_at(map, k, face), 0.);
            }
            for (const SheetLine& line : lines)
                if (line.name == name)
                    drawn.middle.push_back(flat_points(line));
        }
        const bool straight = stated || straighten(bend, drawn.middle);
        if (drawn.zone.empty())
            for (const SheetLine& line : lines)
                if (line.name.starts_with(name + ",")) {
                    std::vector<Eigen::Matrix2Xd> alone = {flat_points(line)};
                    if (straight)
                        straighten(bend, alone);
                    drawn.zone.push_back(alone.front());
                }
        if (straight_only && (!straight || drawn.middle.empty()))
            continue;
        if (drawn.middle.empty() && drawn.zone.empty())
            continue;
        if (as_in_table && !stated)
            drawn.name = fmt::format("bend {}", known[k] >= 0 ? size_t(known[k]) + 1 : ++others);
        drawing.bends.push_back(std::move(drawn));
    }
    for (size_t j = 0; j < taken.size(); ++j)
        if (!taken[j] && !table->bends[j].line.empty())
            drawing.bends.push_back(
                drawn_bend(table->bends[j], fmt::format("bend {}", as_in_table ? j + 1 : drawing.bends.size() + 1)));
    return drawing;
}

} // namespace spia

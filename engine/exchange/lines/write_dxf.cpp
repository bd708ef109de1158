#include "engine/exchange/lines/write_dxf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <span>

#include "engine/core/angle.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/lines/dxf_text.h"
#include "engine/exchange/lines/outline_curves.h"
#include "engine/exchange/lines/smooth_spline.h"
#include "engine/exchange/lines/write_lines.h"

namespace spia {
namespace {

using namespace dxf_handle;
using Kind = OutlinePiece::Kind;

std::string ascii(std::string text)
{
    for (char& c : text)
        if (c < ' ' || c > '~')
            c = '_';
    return text;
}

/// Of the blank as it is drawn.
const char* side(const MarkLabel& mark) { return mark.outer && mark.inner ? "both" : mark.outer ? "front" : "back"; }

/// A point of a polyline and the bulge of the way to the next.
struct Bulged {
    Eigen::Vector2d at;
    double bulge = 0;
};

/// Entities with their handles, lengths in the unit of the file.
class Entities {
public:
    /// @param mm of a unit of the file; @param thickness mm, 0: not told
    Entities(DxfText& dxf, double mm, double thickness) : dxf_(dxf), mm_(mm), thickness_(thickness) {}

    int next_handle() const { return handle_; }
    const Eigen::AlignedBox2d& box() const { return box_; } ///< mm, of all that was drawn but texts

    /// @param about  writes its extended data; none: it has none
    void polyline(const char* layer, std::span<const Bulged> points, bool closed,
                  const std::function<void()>& about = {})
    {
        begin(dxf_.r12() ? "POLYLINE" : "LWPOLYLINE", layer);
        if (dxf_.r12())
            dxf_(66, 1).point(10, {0, 0})(30, 0.0)(70, int(closed));
        else
            dxf_(100, "AcDbPolyline")(90, int(points.size()))(70, int(closed));
        if (dxf_.r12() && about) // before its vertices, which are entities of their own
            about();
        for (size_t i = 0; i < points.size(); ++i) {
            const Bulged& point = points[i];
            box_.extend(point.at);
            if (const Eigen::Vector2d& next = points[(i + 1) % points.size()].at; point.bulge != 0)
                extend_by_arc(point.at, next, point.bulge);
            if (dxf_.r12())
                dxf_(0, "VERTEX").handle(5, handle_++)(8, layer);
            dxf_.point(10, point.at / mm_);
            if (dxf_.r12())
                dxf_(30, 0.0);
            if (point.bulge != 0)
                dxf_(42, point.bulge);
        }
        if (dxf_.r12())
            dxf_(0, "SEQEND").handle(5, handle_++)(8, layer);
        else if (about)
            about();
    }

    void circle(const char* layer, const Eigen::Vector2d& centre, double radius)
    {
        const Eigen::Vector2d reach(radius, radius);
        box_.extend(centre - reach).extend(centre + reach);
        begin("CIRCLE", layer);
        dxf_(100, "AcDbCircle").point(10, centre / mm_)(30, 0.0)(40, radius / mm_);
    }

    void line(const char* layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
    {
        box_.extend(a).extend(b);
        begin("LINE", layer);
        dxf_(100, "AcDbLine").point(10, a / mm_)(30, 0.0).point(11, b / mm_)(31, 0.0);
    }

    /// Arcs of DXF files run counter-clockwise.
    void arc(const char* layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bulge)
    {
        const Eigen::Vector2d centre = arc_centre(from, to, bulge), a = (bulge > 0 ? from : to) - centre,
                              b = (bulge > 0 ? to : from) - centre;
        extend_by_arc(from, to, bulge);
        begin("ARC", layer);
        dxf_(100, "AcDbCircle").point(10, centre / mm_)(30, 0.0)(40, a.norm() / mm_);
        dxf_(100, "AcDbArc")(50, turn_deg(a))(51, turn_deg(b));
    }

    void spline(const char* layer, const SmoothSpline& spline)
    {
        constexpr int planar = 8;
        begin("SPLINE", layer);
        dxf_(100, "AcDbSpline").point(210, {0, 0})(230, 1.0)(70, planar)(71, 3)(72, int(spline.knots.size()));
        dxf_(73, int(spline.poles.size()))(74, 0);
        for (const double knot : spline.knots)
            dxf_(40, knot / mm_);
        for (const Eigen::Vector2d& pole : spline.poles) {
            box_.extend(pole); // which hold the curve between them
            dxf_.point(10, pole / mm_)(30, 0.0);
        }
    }

    /// @param at the middle of its lower edge @param turn degrees
    void text(const char* layer, const std::string& text, const Eigen::Vector2d& at, double height, double turn)
    {
        begin("TEXT", layer);
        dxf_(100, "AcDbText").point(10, at / mm_)(30, 0.0)(40, height / mm_)(1, text)(50, turn)(72, 1);
        dxf_.point(11, at / mm_)(31, 0.0)(100, "AcDbText");
    }

    /// Extended data of what was written last.
    void about(const DrawnBend& bend)
    {
        dxf_(1001, dxf_application)(1000, "bend")(1000, ascii(bend.name));
        dxf_(1000, "angle_deg")(1040, bend.angle / radians_per_degree)(1000, "inner_radius")(1040,
                                                                                             bend.inner_radius / mm_);
        if (bend.k)
            dxf_(1000, "k")(1040, *bend.k);
        if (bend.allowance > 0)
            dxf_(1000, "allowance")(1040, bend.allowance / mm_)(1000, "deduction")(1040, bend.deduction / mm_);
        if (thickness_ > 0)
            dxf_(1000, "thickness")(1040, thickness_ / mm_);
    }

    void about(const MarkLabel& mark)
    {
        dxf_(1001, dxf_application)(1000, "mark")(1000, name(mark.kind))(1000, side(mark));
        const auto tell = [&](const char* what, double value) {
            if (value > 0)
                dxf_(1000, what)(1040, value / mm_);
        };
        tell("diameter", mark.wide);
        tell("depth", mark.deep);
        tell("hole", mark.hole);
    }

private:
    /// Its ends, and where it is farthest along an axis.
    void extend_by_arc(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bulge)
    {
        box_.extend(from).extend(to);
        const Eigen::Vector2d centre = arc_centre(from, to, bulge), begin = (bulge > 0 ? from : to) - centre,
                              end = (bulge > 0 ? to : from) - centre;
        const double radius = begin.norm(), whole = std::fmod(turn_deg(end) - turn_deg(begin) + 360, 360);
        for (const double quarter : {0., 90., 180., 270.})
            if (std::fmod(quarter - turn_deg(begin) + 360, 360) < whole)
                box_.extend(centre + radius * Eigen::Vector2d(std::cos(quarter * radians_per_degree),
                                                              std::sin(quarter * radians_per_degree)));
    }
    static double turn_deg(const Eigen::Vector2d& arm)
    {
        const double angle = std::atan2(arm[1], arm[0]) / radians_per_degree;
        return angle < 0 ? angle + 360 : angle;
    }
    void begin(const char* type, const char* layer)
    {
        dxf_(0, type).handle(5, handle_).handle(330, model_space)(100, "AcDbEntity")(8, layer);
        ++handle_;
    }

    DxfText& dxf_;
    double mm_, thickness_;
    int handle_ = first_entity;
    Eigen::AlignedBox2d box_;
};

std::vector<Bulged> through(const Eigen::Matrix2Xd& points)
{
    std::vector<Bulged> result;
    for (const auto point : points.colwise())
        result.push_back({point});
    return result;
}

/// One closed polyline, its arcs as bulges.
std::vector<Bulged> with_bulges(const OutlineLoop& loop, const OutlineCurves& curves)
{
    std::vector<Bulged> points;
    for (const OutlinePiece& piece : curves.pieces)
        if (piece.kind == Kind::points)
            for (int k = 0; k < piece.edges; ++k)
                points.push_back({loop.col((piece.first + k) % loop.cols())});
        else
            points.push_back({loop.col(piece.first), piece.bulge});
    return points;
}

void draw_points(Entities& draw, const char* layer, const OutlineLoop& loop, const OutlinePiece& piece)
{
    const bool closed = piece.edges == loop.cols();
    Eigen::Matrix2Xd points(2, piece.edges + (closed ? 0 : 1));
    for (Eigen::Index k = 0; k < points.cols(); ++k)
        points.col(k) = loop.col((piece.first + k) % loop.cols());
    for (const SmoothSpline& spline : smooth_splines(points, closed))
        if (spline.poles.size() == 2)
            draw.line(layer, spline.poles.front(), spline.poles.back());
        else
            draw.spline(layer, spline);
}

void draw_loop(Entities& draw, const char* layer, const OutlineLoop& loop, std::span<const StatedPiece> stated,
               double size, const DxfOptions& options)
{
    constexpr double exact = 1e-6; // of the blank: places of CAD files and their blanks are as good
    if (options.curves == DxfCurves::polylines)
        return draw.polyline(layer, through(loop), true);
    const OutlineCurves curves =
        find_curves(loop, std::min(exact * size, options.tolerance), options.tolerance, stated);
    if (curves.circle)
        return draw.circle(layer, curves.centre, curves.radius);
    const bool bare = std::any_of(curves.pieces.begin(), curves.pieces.end(),
                                  [](const OutlinePiece& piece) { return piece.kind == Kind::points; });
    if (options.curves == DxfCurves::arcs || !bare)
        return draw.polyline(layer, with_bulges(loop, curves), true);
    for (const OutlinePiece& piece : curves.pieces) {
        const Eigen::Vector2d from = loop.col(piece.first), to = loop.col((piece.first + piece.edges) % loop.cols());
        if (piece.kind == Kind::line)
            draw.line(layer, from, to);
        else if (piece.kind == Kind::arc)
            draw.arc(layer, from, to, piece.bulge);
        else
            draw_points(draw, layer, loop, piece);
    }
}

/// What the drawing is of, as comments before all else.
void head(DxfText& dxf, const BlankDrawing& drawing, const DxfOptions& options)
{
    if (!drawing.lengths_of.empty())
        dxf(999, ascii("SPIA: blank, lengths are those of the " + drawing.lengths_of));
    if (drawing.thickness > 0)
        dxf(999, fmt::format("SPIA: sheet {:.6g} {} thick", drawing.thickness / millimetres(options.unit),
                             name(options.unit)));
}

/// A number as drawings have it: few digits, no zeros at the end.
std::string few_digits(double value, int decimals)
{
    std::string text = fmt::format("{:.{}f}", value, decimals);
    while (text.back() == '0')
        text.pop_back();
    if (text.back() == '.')
        text.pop_back();
    return text;
}

std::string label(const DrawnBend& bend, double mm)
{
    return fmt::format("{} {}%%d R{}{}", bend.up ? "UP" : "DOWN", few_digits(bend.angle / radians_per_degree, 2),
                       few_digits(bend.inner_radius / mm, mm > 1 ? 4 : 3), bend.k ? " K" + few_digits(*bend.k, 4) : "");
}

bool is_straight(const Eigen::Matrix2Xd& points, double tolerance)
{
    const Eigen::Vector2d a = points.col(0), way = points.rightCols<1>() - a;
    if (!(way.norm() > tolerance))
        return false;
    const Eigen::RowVectorXd off =
        (way[0] * (points.row(1).array() - a[1]) - way[1] * (points.row(0).array() - a[0])) / way.norm();
    return off.cwiseAbs().maxCoeff() <= tolerance;
}

double length_of(const Eigen::Matrix2Xd& line) { return (line.rightCols<1>() - line.col(0)).norm(); }

/// The longest of its middle lines, null without any.
const Eigen::Matrix2Xd* longest_line(const DrawnBend& bend)
{
    const auto longest = std::ranges::max_element(bend.middle, {}, length_of);
    return longest == bend.middle.end() ? nullptr : &*longest;
}

/// mm, of all texts of a drawing: what is no longer than the shortest bend, but to be read beside
/// the blank.
double text_height(const BlankDrawing& drawing, double size, double mm)
{
    double height = size / 60;
    for (const DrawnBend& bend : drawing.bends)
        if (const Eigen::Matrix2Xd* line = longest_line(bend)) {
            // %%d is one; about as wide as high
            const double letters = double(label(bend, mm).size()) - 2;
            height = std::min(height, 0.9 * length_of(*line) / letters);
        }
    return std::max(height, size / 120);
}

/// Middle line and text of a bend. The text stands over the line, to be read from below or from the
/// right.
void draw_bend(Entities& draw, const DrawnBend& bend, double height, const DxfOptions& options)
{
    const char* layer = bend.up ? "BEND_UP" : "BEND_DOWN";
    for (const Eigen::Matrix2Xd& line : bend.middle) {
        if (is_straight(line, options.tolerance)) {
            draw.line(layer, line.col(0), line.rightCols<1>());
            draw.about(bend);
        } else
            draw.polyline(layer, through(line), false, [&] { draw.about(bend); });
    }
    if (const Eigen::Matrix2Xd* longest = longest_line(bend)) {
        const std::string text = label(bend, millimetres(options.unit));
        Eigen::Vector2d way = longest->rightCols<1>() - longest->col(0);
        constexpr double upright = 1e-3; // of its length: a solved blank is not upright to the last
                                         // digit
        if (way[0] < -upright * way.norm() || (way[0] < upright * way.norm() && way[1] < 0))
            way = -way;
        const double turn = std::atan2(way[1], way[0]);
        const Eigen::Vector2d up(-std::sin(turn), std::cos(turn));
        const Eigen::Vector2d middle = (longest->col(0) + longest->rightCols<1>()) / 2;
        draw.text(layer, text, middle + 0.4 * height * up, height, turn / radians_per_degree);
        draw.about(bend);
    }
    for (const Eigen::Matrix2Xd& line : bend.zone)
        if (is_straight(line, options.tolerance))
            draw.line("BEND_ZONE", line.col(0), line.rightCols<1>());
        else
            draw.polyline("BEND_ZONE", through(line), false);
}

/// "countersink 12 x 3, back", in the unit of the file
std::string label(const MarkLabel& mark, double mm)
{
    const int decimals = mm > 1 ? 4 : 3;
    std::string text = name(mark.kind);
    if (mark.wide > 0)
        text += " " + few_digits(mark.wide / mm, decimals);
    if (mark.wide > 0 && mark.deep > 0)
        text += " x " + few_digits(mark.deep / mm, decimals);
    return text + ", " + side(mark);
}

/// A row of points, a circle where they lie on one: sunk holes are drilled there. The text stands
/// over it.
void draw_mark(Entities& draw, const DrawnMark& mark, double height, const DxfOptions& options)
{
    const Eigen::Matrix2Xd& line = mark.line;
    const bool closed = line.cols() > 3 && line.col(0) == line.rightCols<1>();
    const Eigen::Matrix2Xd points = closed ? line.leftCols(line.cols() - 1) : line;
    OutlineCurves curves;
    if (closed && options.curves != DxfCurves::polylines)
        curves = find_curves(points, options.tolerance, options.tolerance, {});
    if (curves.circle) {
        draw.circle("MARKS", curves.centre, curves.radius);
        draw.about(mark.label);
    } else
        draw.polyline("MARKS", through(points), closed, [&] { draw.about(mark.label); });
    if (mark.label.kind == MarkLabel::Kind::mark)
        return;
    const Eigen::Vector2d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
    draw.text("MARKS_TEXT", label(mark.label, millimetres(options.unit)),
              {(low[0] + high[0]) / 2, high[1] + 0.4 * height}, height, 0);
    draw.about(mark.label);
}

void require_drawn(std::span<const Eigen::Matrix2Xd> lines, const std::string& what)
{
    for (const Eigen::Matrix2Xd& line : lines)
        if (line.cols() < 2 || !line.allFinite())
            throw InputError(fmt::format("a line of {} needs two finite points or more", what));
}

void require_drawing(const BlankDrawing& drawing, const DxfOptions& options)
{
    require_outline(drawing.loops);
    for (const DrawnMark& mark : drawing.marks)
        require_drawn({&mark.line, 1}, "the marks");
    if (!drawing.stated.empty() && drawing.stated.size() != drawing.loops.size())
        throw InputError(fmt::format("there are {} loops of an outline, but curves for {}", drawing.loops.size(),
                                     drawing.stated.size()));
    for (const DrawnBend& bend : drawing.bends) {
        require_drawn(bend.middle, bend.name);
        require_drawn(bend.zone, bend.name);
        if (!std::isfinite(bend.angle) || !std::isfinite(bend.inner_radius) || (bend.k && !std::isfinite(*bend.k)))
            throw InputError(fmt::format("{}: its angle, radius or K factor is no number", bend.name));
    }
    if (options.version == DxfVersion::r12 && options.curves == DxfCurves::splines)
        throw InputError("DXF files of version 12 have no splines; ask for arcs or polylines, or for version r2000");
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
        throw InputError(
            fmt::format("the tolerance of a DXF file is {} mm; it must not be negative", options.tolerance));
}

std::vector<DxfLayer> layers_of(const BlankDrawing& drawing)
{
    std::vector<DxfLayer> layers = {{layer_outline, "OUTLINE", 7}, {layer_holes, "HOLES", 1}};
    const auto any = [&](const auto& has) { return std::any_of(drawing.bends.begin(), drawing.bends.end(), has); };
    if (any([](const DrawnBend& bend) { return bend.up && !bend.middle.empty(); }))
        layers.push_back({layer_bend_up, "BEND_UP", 5, "DASHED"});
    if (any([](const DrawnBend& bend) { return !bend.up && !bend.middle.empty(); }))
        layers.push_back({layer_bend_down, "BEND_DOWN", 3, "DASHED"});
    if (any([](const DrawnBend& bend) { return !bend.zone.empty(); }))
        layers.push_back({layer_bend_zone, "BEND_ZONE", 8, "DOT"});
    if (!drawing.marks.empty())
        layers.push_back({layer_marks, "MARKS", 6});
    if (std::ranges::any_of(drawing.marks,
                            [](const DrawnMark& mark) { return mark.label.kind != MarkLabel::Kind::mark; }))
        layers.push_back({layer_marks_text, "MARKS_TEXT", 6});
    return layers;
}

} // namespace

DxfVersion dxf_version(const std::string& name)
{
    if (name == "r12")
        return DxfVersion::r12;
    if (name == "r2000")
        return DxfVersion::r2000;
    throw InputError(fmt::format("there is no DXF version \"{}\" here; there are r12 and r2000", name));
}

DxfCurves dxf_curves(const std::string& name)
{
    if (name == "arcs")
        return DxfCurves::arcs;
    if (name == "polylines")
        return DxfCurves::polylines;
    if (name == "splines")
        return DxfCurves::splines;
    throw InputError(fmt::format("there are no DXF curves \"{}\"; there are arcs, polylines and splines", name));
}

void write_dxf(const std::filesystem::path& path, const BlankDrawing& drawing, const DxfOptions& options)
{
    require_drawing(drawing, options);
    const std::vector<OutlineLoop>& loops = drawing.loops;
    Eigen::Vector2d low = loops[0].rowwise().minCoeff(), high = loops[0].rowwise().maxCoeff();
    for (const OutlineLoop& loop : loops) {
        low = low.cwiseMin(loop.rowwise().minCoeff());
        high = high.cwiseMax(loop.rowwise().maxCoeff());
    }
    const double mm = millimetres(options.unit), size = (high - low).norm();
    DxfText entities(options.version);
    Entities draw(entities, mm, drawing.thickness);
    for (size_t i = 0; i < loops.size(); ++i)
        draw_loop(draw, i == 0 ? "OUTLINE" : "HOLES", loops[i],
                  drawing.stated.empty() ? std::span<const StatedPiece>() : drawing.stated[i], size, options);
    const double height = text_height(drawing, size, mm);
    for (const DrawnBend& bend : drawing.bends)
        draw_bend(draw, bend, height, options);
    for (const DrawnMark& mark : drawing.marks)
        draw_mark(draw, mark, height, options);
    DxfText dxf(options.version);
    head(dxf, drawing, options);
    begin_dxf(dxf,
              {draw.box().min() / mm, draw.box().max() / mm, options.unit, layers_of(drawing), draw.next_handle()});
    dxf.append(entities);
    end_dxf(dxf);
    write_atomically(path, dxf.text());
}

} // namespace spia

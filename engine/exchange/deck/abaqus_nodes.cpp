#include "engine/exchange/deck/abaqus_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <utility>

#include "engine/core/read_number.h"

namespace spia {
namespace {

constexpr std::int64_t greatest_number = 999'999'999; ///< of nodes and elements [Abaqus Analysis
                                                      ///< User's Guide]
constexpr double radians = std::numbers::pi / 180;

} // namespace

std::int64_t abaqus_number(const DeckLines& lines, std::string_view field)
{
    const std::int64_t value = lines.whole(field);
    if (value > greatest_number || value < -greatest_number)
        lines.fail(fmt::format("the number {} is beyond {}, the greatest that Abaqus takes", value, greatest_number));
    return value;
}

std::int64_t shifted_number(const DeckLines& lines, std::int64_t number, std::int64_t by)
{
    std::int64_t sum = 0;
    if (__builtin_add_overflow(number, by, &sum) || sum < 1 || sum > greatest_number)
        lines.fail(fmt::format("the number {} with {} added is not from 1 to {}", number, by, greatest_number));
    return sum;
}

// ---- moves ----

/// A line of more than three numbers is that of the turn: where there is no translation its line is
/// left blank.
void AbaqusShift::take(const DeckLines& lines, const DeckFields& fields)
{
    const auto vector = [&](size_t first) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (size_t k = 0; k < 3; ++k)
            if (!fields[first + k].empty())
                x[Eigen::Index(k)] = lines.coordinate(fields[first + k]);
        return x;
    };
    bool turn = false;
    for (size_t k = 3; k < fields.count(); ++k)
        turn = turn || !fields[k].empty();
    if (!turn) {
        by = vector(0);
        return;
    }
    from = vector(0);
    to = vector(3);
    degrees = fields[6].empty() ? 0 : lines.number(fields[6]);
}

Eigen::Affine3d AbaqusShift::move(const DeckLines& lines, double times) const
{
    const Eigen::Translation3d translation(by);
    if (degrees == 0)
        return Eigen::Affine3d(translation);
    const Eigen::Vector3d axis = to - from;
    if (!(axis.norm() > 0))
        lines.fail("the two points of the axis of rotation are the same");
    return Eigen::Translation3d(from) *
           Eigen::AngleAxisd(std::fmod(degrees * times, 360.) * radians, axis.normalized()) *
           Eigen::Translation3d(-from) * translation;
}

// ---- blocks ----

bool AbaqusNodes::begin(const AbaqusKeyword& keyword)
{
    card_ = nullptr;
    set_.clear();
    if (keyword.name == "NODE")
        begin_nodes(keyword);
    else if (keyword.name == "SYSTEM") {
        system_points_.clear();
        system_ = Eigen::Affine3d::Identity();
        card_ = &AbaqusNodes::system;
    } else if (keyword.name == "NSET")
        begin_set(keyword);
    else if (keyword.name == "NGEN")
        begin_generation(keyword);
    else if (keyword.name == "NFILL")
        begin_fill(keyword);
    else if (keyword.name == "NCOPY")
        begin_copy(keyword);
    return card_ != nullptr;
}

void AbaqusNodes::end()
{
    if (copy_)
        make_copy();
    copy_.reset();
    card_ = nullptr;
}

void AbaqusNodes::close_scope()
{
    end();
    sets_.clear();
    system_ = Eigen::Affine3d::Identity();
    system_points_.clear();
}

void AbaqusNodes::leave_unread(std::string_view what, std::string_view why)
{
    constexpr int most = 20;
    if (reported_++ < most)
        deck_.doubt(fmt::format("line {}: {} is not read: {}", lines_.place().line, what, why));
    else if (reported_ == most + 1)
        deck_.doubt("and so for more keywords that make nodes");
    card_ = &AbaqusNodes::unread;
}

// ---- *NODE, *SYSTEM, *NSET ----

AbaqusNodes::Kind AbaqusNodes::kind_of(std::string_view system) const
{
    const std::string name = upper_case(system);
    if (name.empty() || name == "R" || name == "RC")
        return Kind::rectangular;
    if (name != "C" && name != "S")
        lines_.fail(fmt::format("the coordinates SYSTEM={} are not known", system));
    return name == "C" ? Kind::cylindrical : Kind::spherical;
}

void AbaqusNodes::begin_nodes(const AbaqusKeyword& keyword)
{
    kind_ = kind_of(keyword["SYSTEM"]);
    if (kind_ == Kind::spherical && !std::exchange(reported_spherical_, true))
        deck_.doubt(
            "nodes of *NODE, SYSTEM=S are read with the third coordinate as the angle above the plane of the first "
            "two axes; look at the part");
    place_system();
    set_ = keyword["NSET"];
    if (!set_.empty())
        sets_.open(set_);
    card_ = &AbaqusNodes::node;
}

void AbaqusNodes::node(const DeckFields& fields)
{
    const std::int64_t id = lines_.whole(fields[0]);
    deck_.add_node(id, system_ * rectangular(kind_, point(fields, 1)));
    if (!set_.empty())
        sets_.add(id, id, 1);
}

Eigen::Vector3d AbaqusNodes::point(const DeckFields& fields, size_t first) const
{
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < 3; ++k)
        if (const std::string_view field = fields[first + k]; !field.empty())
            x[Eigen::Index(k)] = lines_.coordinate(field);
    return x;
}

/// Radius, degrees, height; or radius, degrees about the third axis, degrees towards it: the
/// directions of Abaqus are radial, circumferential and meridional, in this order right-handed
/// [Abaqus Analysis User's Guide, "Transformed coordinate systems"].
Eigen::Vector3d AbaqusNodes::rectangular(Kind kind, const Eigen::Vector3d& x)
{
    if (kind == Kind::rectangular)
        return x;
    const double angle = x.y() * radians;
    if (kind == Kind::cylindrical)
        return {x.x() * std::cos(angle), x.x() * std::sin(angle), x.z()};
    const double up = x.z() * radians;
    return {x.x() * std::cos(up) * std::cos(angle), x.x() * std::cos(up) * std::sin(angle), x.x() * std::sin(up)};
}

/// Points of that of the nodes that follow: its origin, a point on its first axis and one in the
/// plane of the first and second; without the last its third axis stays that of the space, without
/// both all do [Abaqus Keywords Reference, *SYSTEM].
void AbaqusNodes::system(const DeckFields& fields)
{
    system_points_.push_back(point(fields, 0));
    if (!fields[3].empty() || !fields[4].empty() || !fields[5].empty())
        system_points_.push_back(point(fields, 3));
    if (system_points_.size() > 3)
        lines_.fail("*SYSTEM has more than three points");
}

/// Of the points that were given.
void AbaqusNodes::place_system()
{
    if (system_points_.empty())
        return;
    system_ = Eigen::Translation3d(system_points_[0]);
    if (system_points_.size() == 1)
        return;
    Eigen::Vector3d first = system_points_[1] - system_points_[0], third = Eigen::Vector3d::UnitZ();
    if (system_points_.size() == 2)
        first.z() = 0;
    else
        third = first.cross(system_points_[2] - system_points_[0]);
    constexpr double on_a_line = 1e-12; // of the lengths
    if (!(first.norm() > 0) || !(third.norm() > on_a_line * first.norm()))
        lines_.fail("the points of *SYSTEM lie on a line");
    first.normalize();
    third.normalize();
    Eigen::Matrix3d axes;
    axes << first, third.cross(first), third;
    system_.linear() = axes;
}

void AbaqusNodes::begin_set(const AbaqusKeyword& keyword)
{
    card_ = &AbaqusNodes::unread;
    if (keyword.has("INSTANCE")) // its numbers are those of an instance
        return;
    if (keyword["NSET"].empty())
        lines_.fail("*NSET does not say which NSET");
    sets_.open(keyword["NSET"], keyword.has("UNSORTED"));
    if (keyword.has("ELSET")) // middle nodes of its elements are not kept
        return sets_.spoil();
    card_ = keyword.has("GENERATE") ? &AbaqusNodes::range : &AbaqusNodes::listed;
}

void AbaqusNodes::listed(const DeckFields& fields)
{
    for (size_t k = 0; k < fields.count(); ++k)
        if (const auto id = read_whole_number(fields[k]))
            sets_.add(*id, *id, 1);
        else if (!fields[k].empty())
            sets_.add_set(without_quotes(fields[k]));
}

void AbaqusNodes::range(const DeckFields& fields)
{
    const std::int64_t step = fields[2].empty() ? 1 : lines_.whole(fields[2]);
    if (step < 1)
        lines_.fail(fmt::format("the step is {}; it must be above 0", step));
    sets_.add(lines_.whole(fields[0]), lines_.whole(fields[1]), step);
}

// ---- *NGEN ----

void AbaqusNodes::begin_generation(const AbaqusKeyword& keyword)
{
    const std::string line = upper_case(keyword["LINE"]);
    if (!line.empty() && line != "C")
        return leave_unread("*NGEN, LINE=" + line, "only straight lines and arcs are");
    arcs_ = !line.empty();
    kind_ = kind_of(keyword["SYSTEM"]);
    set_ = keyword["NSET"];
    if (!set_.empty())
        sets_.open(set_);
    card_ = &AbaqusNodes::generate;
}

Eigen::Vector3d AbaqusNodes::place_of(std::int64_t node)
{
    const auto place = deck_.node(node);
    if (!place)
        lines_.fail(fmt::format("node {} is not there", node));
    return *place;
}

void AbaqusNodes::put(std::int64_t node, const Eigen::Vector3d& x)
{
    for (int k = 0; k < 3; ++k)
        lines_.checked_coordinate(x[k]);
    deck_.put_node(node, x);
}

/// Two ends, the increment of the numbers; of an arc its centre, as a node or by coordinates, and
/// its normal.
void AbaqusNodes::generate(const DeckFields& fields)
{
    const std::int64_t first = abaqus_number(lines_, fields[0]), last = abaqus_number(lines_, fields[1]);
    const std::int64_t step = fields[2].empty() ? 1 : abaqus_number(lines_, fields[2]);
    if (step == 0 || (last - first) % step != 0 || (last - first) / step < 1)
        lines_.fail(fmt::format("*NGEN: steps of {} do not lead from node {} to node {}", step, first, last));
    const std::int64_t intervals = (last - first) / step;
    const Eigen::Vector3d a = place_of(first), b = place_of(last);
    deck_.require_room(lines_, "*NGEN", std::uint64_t(intervals - 1));
    if (arcs_)
        generate_arc(fields, first, step, intervals);
    else
        for (std::int64_t k = 1; k < intervals; ++k)
            put(first + k * step, a + (double(k) / double(intervals)) * (b - a));
    if (!set_.empty())
        sets_.add(std::min(first, last), std::max(first, last), std::abs(step));
}

/// Nothing if the point cannot be placed.
std::optional<Eigen::Vector3d> AbaqusNodes::centre_of(const DeckFields& fields)
{
    if (!fields[3].empty() && lines_.whole(fields[3]) != 0)
        return place_of(lines_.whole(fields[3]));
    if (is_in_system() || !system_points_.empty()) {
        leave_unread("*NGEN, LINE=C", "its centre is given by coordinates where *SYSTEM holds");
        return std::nullopt;
    }
    return rectangular(kind_, point(fields, 4));
}

/// Turns right-handed about the normal; without one the short way from end to end.
void AbaqusNodes::generate_arc(const DeckFields& fields, std::int64_t first, std::int64_t step, std::int64_t intervals)
{
    const auto centre = centre_of(fields);
    if (!centre)
        return;
    constexpr double tolerance = 1e-3; // of the radius: coordinates are written with few digits
    const Eigen::Vector3d a = place_of(first) - *centre, b = place_of(first + step * intervals) - *centre;
    const double radius = a.norm();
    if (!(radius > 0) || !(std::abs(b.norm() - radius) <= tolerance * radius))
        lines_.fail(
            fmt::format("*NGEN: nodes {} and {} are at different distances from the centre of their arc, {} and {}",
                        first, first + step * intervals, radius, b.norm()));
    Eigen::Vector3d normal = point(fields, 7);
    const bool has_normal = !normal.isZero(0);
    if (!has_normal)
        normal = a.cross(b);
    if (!has_normal && !(normal.norm() > 1e-9 * radius * radius)) // sine of the angle
        lines_.fail("*NGEN: an arc of 180 degrees or more needs its normal");
    normal.normalize();
    if (!(std::abs(normal.dot(a)) <= tolerance * radius && std::abs(normal.dot(b)) <= tolerance * radius))
        lines_.fail("*NGEN: the ends of the arc do not lie in the plane of its normal");
    const Eigen::Vector3d across = normal.cross(a);
    double angle = std::atan2(across.normalized().dot(b), a.normalized().dot(b));
    if (angle <= 1e-9) // the same place: a whole turn
        angle += 2 * std::numbers::pi;
    for (std::int64_t k = 1; k < intervals; ++k) {
        const double t = double(k) / double(intervals), grown = 1 + t * (b.norm() / radius - 1);
        put(first + k * step, *centre + grown * (std::cos(t * angle) * a + std::sin(t * angle) * across));
    }
}

// ---- *NFILL ----

void AbaqusNodes::begin_fill(const AbaqusKeyword& keyword)
{
    if (keyword.has("SINGULAR"))
        return leave_unread("*NFILL, SINGULAR", "its spacing is not");
    fill_ = {};
    if (keyword.has("BIAS"))
        fill_.bias = lines_.number(keyword["BIAS"]);
    if (!(fill_.bias > 0))
        lines_.fail(fmt::format("*NFILL: the BIAS is {}; it must be above 0", fill_.bias));
    fill_.two_step = keyword.has("TWO STEP");
    set_ = keyword["NSET"];
    if (!set_.empty())
        sets_.open(set_);
    card_ = &AbaqusNodes::fill;
}

/// Nothing, and a doubt, if they are not known. @throws InputError if there is no such set, or
/// nothing in it
std::optional<NodeSets::Members> AbaqusNodes::members(std::string_view keyword, std::string_view set)
{
    if (!sets_.has(set))
        lines_.fail(fmt::format("{}: there is no node set {}", keyword, set));
    if (sets_.is_spoiled(set)) {
        leave_unread(keyword, fmt::format("what the node set {} holds is not", set));
        return std::nullopt;
    }
    NodeSets::Members found = sets_.members(set, deck_, steps_);
    if (found.ids.empty())
        lines_.fail(fmt::format("{}: there is no node of the node set {}", keyword, set));
    return found;
}

/// Where the nodes inside a line stand, as parts of it. Each interval is BIAS times the next one;
/// in two steps each pair of equal ones is.
std::vector<double> AbaqusNodes::parts_of_lines(std::int64_t intervals) const
{
    if (fill_.bias == 1) {
        std::vector<double> parts;
        for (std::int64_t k = 1; k < intervals; ++k)
            parts.push_back(double(k) / double(intervals));
        return parts;
    }
    if (fill_.two_step && intervals % 2 != 0)
        lines_.fail(fmt::format("*NFILL, TWO STEP: the number of intervals is {}; it must be even", intervals));
    std::vector<double> ends = {0};
    double length = 1;
    for (std::int64_t k = 0; k < intervals; ++k) {
        ends.push_back(ends.back() + length);
        if (!fill_.two_step || k % 2 == 1)
            length /= fill_.bias;
    }
    if (!std::isfinite(ends.back()))
        lines_.fail(fmt::format("*NFILL: the BIAS {} is too far from 1 for {} intervals", fill_.bias, intervals));
    std::vector<double> parts(ends.begin() + 1, ends.end() - 1);
    for (double& part : parts)
        part /= ends.back();
    return parts;
}

/// Two node sets, the number of intervals between their nodes and the increment of the numbers.
void AbaqusNodes::fill(const DeckFields& fields)
{
    const std::string_view names[] = {without_quotes(fields[0]), without_quotes(fields[1])};
    const auto one = members("*NFILL", names[0]);
    const auto other = one ? members("*NFILL", names[1]) : std::nullopt;
    if (!other)
        return;
    for (const auto* bound : {&*one, &*other}) // Abaqus would take the origin for it
        if (bound->missing)
            lines_.fail(fmt::format("*NFILL: node {} of the node set {} is not there", *bound->missing,
                                    names[bound == &*other]));
    const std::int64_t intervals = abaqus_number(lines_, fields[2]);
    const std::int64_t step = fields[3].empty() ? 1 : abaqus_number(lines_, fields[3]);
    if (intervals < 1 || step == 0)
        lines_.fail(fmt::format("*NFILL: {} intervals with numbers {} apart", intervals, step));
    const size_t count = std::min(one->ids.size(), other->ids.size());
    deck_.require_room(lines_, "*NFILL", std::uint64_t(count) * std::uint64_t(intervals - 1));
    const std::vector<double> parts = parts_of_lines(intervals);
    // of all first: numbers may be taken anew
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> ends;
    for (size_t line = 0; line < count; ++line)
        ends.emplace_back(place_of(one->ids[line]), place_of(other->ids[line]));
    for (size_t line = 0; line < count; ++line)
        fill_line(one->ids[line], other->ids[line], step, ends[line], parts);
}

void AbaqusNodes::fill_line(std::int64_t first, std::int64_t last, std::int64_t step,
                            const std::pair<Eigen::Vector3d, Eigen::Vector3d>& ends, const std::vector<double>& parts)
{
    if ((last - first) % step != 0)
        lines_.fail(fmt::format("*NFILL: steps of {} do not lead from node {} to node {}", step, first, last));
    const auto& [a, b] = ends;
    if (!set_.empty())
        sets_.add(first, first, 1);
    for (size_t k = 0; k < parts.size(); ++k) {
        const std::int64_t made = shifted_number(lines_, first, (std::int64_t(k) + 1) * step);
        put(made, a + parts[k] * (b - a));
        if (!set_.empty())
            sets_.add(made, made, 1);
    }
    if (!set_.empty())
        sets_.add(last, last, 1);
}

// ---- *NCOPY ----

void AbaqusNodes::begin_copy(const AbaqusKeyword& keyword)
{
    Copy copy;
    copy.set = keyword["OLD SET"];
    copy.new_set = keyword["NEW SET"];
    copy.change = abaqus_number(lines_, keyword["CHANGE NUMBER"]);
    copy.place = lines_.place();
    const std::string reflect = upper_case(keyword["REFLECT"]);
    if (keyword.has("POLE"))
        copy.how = Copy::How::pole;
    else if (reflect == "LINE" || reflect == "MIRROR" || reflect == "POINT")
        copy.how = reflect == "LINE" ? Copy::How::line : reflect == "MIRROR" ? Copy::How::mirror : Copy::How::point;
    else if (!keyword.has("SHIFT"))
        lines_.fail("*NCOPY says neither SHIFT nor POLE nor REFLECT=LINE, MIRROR or POINT");
    if (keyword.has("MULTIPLE"))
        copy.times = abaqus_number(lines_, keyword["MULTIPLE"]);
    if (is_in_system() || !system_points_.empty())
        return leave_unread("*NCOPY", "*SYSTEM holds, and it is not known for which of its points");
    copy_ = std::move(copy);
    card_ = &AbaqusNodes::copy_line;
}

void AbaqusNodes::copy_line(const DeckFields& fields)
{
    if (copy_->how == Copy::How::shift)
        return copy_->shift.take(lines_, fields);
    if (copy_->how == Copy::How::pole) {
        const bool by_node = !fields[0].empty() && lines_.whole(fields[0]) != 0;
        copy_->points.push_back(by_node ? place_of(lines_.whole(fields[0])) : point(fields, 1));
        return;
    }
    copy_->points.push_back(point(fields, 0));
    if (fields.count() > 3)
        copy_->points.push_back(point(fields, 3));
    constexpr size_t most = 4; // the last line may end with a comma
    if (copy_->points.size() > most)
        lines_.fail("*NCOPY has more points than it needs");
}

Eigen::Affine3d AbaqusNodes::move_of_copy() const
{
    const Copy& copy = *copy_;
    if (copy.how == Copy::How::shift)
        return copy.shift.move(lines_, double(copy.times));
    const size_t wanted = copy.how == Copy::How::line ? 2 : copy.how == Copy::How::mirror ? 3 : 1;
    if (copy.points.size() < wanted)
        lines_.fail(fmt::format("*NCOPY: {} points are needed, not {}", wanted, copy.points.size()));
    const Eigen::Vector3d a = copy.points[0];
    Eigen::Affine3d move = Eigen::Affine3d::Identity();
    if (copy.how == Copy::How::pole || copy.how == Copy::How::point) {
        // the old node is in the middle; the point is
        move.linear() *= copy.how == Copy::How::pole ? 2 : -1;
        move.translation() = copy.how == Copy::How::pole ? Eigen::Vector3d(-a) : Eigen::Vector3d(2 * a);
        return move;
    }
    Eigen::Vector3d along = copy.points[1] - a;
    if (copy.how == Copy::How::mirror)
        along = along.cross(copy.points[2] - a);
    if (!(along.norm() > 0))
        lines_.fail("*NCOPY: the points lie on a line, or are the same");
    along.normalize();
    move.linear() -= 2 * along * along.transpose();
    if (copy.how == Copy::How::line)
        move.linear() *= -1;
    move.translation() = a - move.linear() * a;
    return move;
}

void AbaqusNodes::make_copy()
{
    lines_.speak_of(copy_->place);
    if (const auto old = members("*NCOPY", copy_->set)) {
        const Eigen::Affine3d move = move_of_copy();
        deck_.require_room(lines_, "*NCOPY", old->ids.size());
        if (!copy_->new_set.empty())
            sets_.open(copy_->new_set, sets_.is_unsorted(copy_->set));
        std::vector<Eigen::Vector3d> places; // of all first: a copy may take the number of an
                                             // original
        for (const std::int64_t id : old->ids)
            places.push_back(move * place_of(id));
        for (size_t k = 0; k < places.size(); ++k) {
            const std::int64_t made = shifted_number(lines_, old->ids[k], copy_->change);
            put(made, places[k]);
            if (!copy_->new_set.empty())
                sets_.add(made, made, 1);
        }
        deck_.set_copies();
    }
    lines_.speak_of({});
}

} // namespace spia

#include "engine/exchange/lines/read_dxf.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>

#include "engine/core/error.h"
#include "engine/exchange/lines/dxf_curves.h"
#include "engine/exchange/lines/dxf_text.h"

namespace spia {
namespace {

using std::numbers::pi;

struct Pair {
    int code;
    std::string value;
    int row; ///< of the value in the file, from 1
};

std::string trimmed(const std::string& text)
{
    const size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

std::vector<Pair> pairs_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw InputError(fmt::format("{}: there is no such file", file.string()));
    std::vector<Pair> pairs;
    std::string code, value;
    for (int row = 2; std::getline(stream, code) && std::getline(stream, value); row += 2) {
        const std::string digits = trimmed(code);
        int number = 0;
        const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (fault != std::errc() || end != digits.data() + digits.size())
            throw InputError(fmt::format("{}: line {} is no group code of a text DXF file", file.string(), row - 1));
        pairs.push_back({number, trimmed(value), row});
    }
    return pairs;
}

/// One entity: its pairs in order.
struct Entity {
    const std::string* file = nullptr;
    std::string type;
    std::vector<Pair> pairs;

    double number(const Pair& pair) const
    {
        double value = 0;
        const auto [end, fault] = std::from_chars(pair.value.data(), pair.value.data() + pair.value.size(), value);
        if (fault != std::errc() || end != pair.value.data() + pair.value.size() || !std::isfinite(value))
            throw InputError(fmt::format("{}: line {} is \"{}\", not a number", *file, pair.row, pair.value));
        return value;
    }
    double number(int code, double otherwise) const
    {
        for (const Pair& pair : pairs)
            if (pair.code == code)
                return number(pair);
        return otherwise;
    }
    Eigen::Vector3d point(int code) const { return {number(code, 0), number(code + 10, 0), number(code + 20, 0)}; }
    std::string layer() const
    {
        for (const Pair& pair : pairs)
            if (pair.code == 8)
                return pair.value;
        return "0";
    }
    bool has_bit(int code, int bit) const
    {
        constexpr double most = 1e9; // flags are small; what is not is none
        return (int(std::clamp(number(code, 0), -most, most)) & bit) != 0;
    }
    /// Circles and flat polylines may be drawn in a plane of their own; only that of the drawing is
    /// read.
    bool in_plane() const { return number(210, 0) == 0 && number(220, 0) == 0 && number(230, 1) > 0; }
};

/// A chain of points, each with the bulge of the way to the next.
struct Chain {
    std::vector<Eigen::Vector3d> at;
    std::vector<double> bulge;
    bool closed = false;
};

Chain light_chain(const Entity& entity)
{
    Chain chain;
    const double height = entity.number(38, 0);
    for (const Pair& pair : entity.pairs)
        if (pair.code == 10) {
            chain.at.emplace_back(entity.number(pair), 0, height);
            chain.bulge.push_back(0);
        } else if (pair.code == 20 && !chain.at.empty())
            chain.at.back()[1] = entity.number(pair);
        else if (pair.code == 42 && !chain.at.empty())
            chain.bulge.back() = entity.number(pair);
    chain.closed = entity.has_bit(70, 1);
    return chain;
}

dxf::Points points_of(const Chain& chain)
{
    dxf::Points points;
    const size_t count = chain.at.size();
    for (size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k)
        dxf::add_way(chain.at[k], chain.at[(k + 1) % count], chain.bulge[k], points);
    if (!chain.closed && count > 0)
        points.push_back(chain.at.back());
    return points;
}

dxf::Spline spline_of(const Entity& entity)
{
    dxf::Spline spline;
    spline.degree = int(std::clamp(entity.number(71, 3), -1., 1e3));
    for (const Pair& pair : entity.pairs)
        if (pair.code == 40)
            spline.knots.push_back(entity.number(pair));
        else if (pair.code == 41)
            spline.weights.push_back(entity.number(pair));
        else if (pair.code == 10)
            spline.poles.emplace_back(entity.number(pair), 0, 0);
        else if ((pair.code == 20 || pair.code == 30) && !spline.poles.empty())
            spline.poles.back()[pair.code / 10 - 1] = entity.number(pair);
    return spline;
}

/// What write_dxf() writes beside a bend is said by the bend's line.
bool is_own_label(const Entity& entity)
{
    return entity.type == "TEXT" && std::any_of(entity.pairs.begin(), entity.pairs.end(), [](const Pair& pair) {
               return pair.code == 1001 && pair.value == dxf_application;
           });
}

class Reader {
public:
    explicit Reader(double mm) : mm_(mm) {}

    void take(const Entity& entity)
    {
        if (entity.type == "VERTEX" && chain_) {
            chain_->at.push_back(entity.point(10));
            chain_->bulge.push_back(entity.number(42, 0));
            return;
        }
        finish();
        if (entity.type == "SEQEND" || entity.type == "VERTEX" || is_own_label(entity))
            return;
        if (entity.type == "LINE")
            return add(entity, {entity.point(10), entity.point(11)}, false);
        // the points of a spline lie in space
        if (!(entity.in_plane() || entity.type == "SPLINE") || !read(entity))
            ++other_[entity.in_plane() || entity.type == "SPLINE" ? entity.type : entity.type + " in another plane"];
    }

    DxfLines done()
    {
        finish();
        number_lines();
        for (const auto& [type, count] : other_)
            result_.left_out.push_back(fmt::format("{} {}", count, type));
        return std::move(result_);
    }

private:
    bool read(const Entity& entity)
    {
        constexpr int closed = 1, curve_frame = 16 + 64; // nets of points
        if (entity.type == "LWPOLYLINE") {
            const Chain chain = light_chain(entity);
            add(entity, points_of(chain), chain.closed);
        } else if (entity.type == "POLYLINE" && !entity.has_bit(70, curve_frame)) {
            owner_ = entity;
            chain_ = Chain{{}, {}, entity.has_bit(70, closed)};
        } else if (entity.type == "CIRCLE" || entity.type == "ARC") {
            const bool whole = entity.type == "CIRCLE";
            const double from = whole ? 0 : entity.number(50, 0) * pi / 180,
                         to = whole ? 2 * pi : entity.number(51, 0) * pi / 180,
                         turn = whole ? 2 * pi : std::fmod(std::fmod(to - from, 2 * pi) + 2 * pi, 2 * pi);
            dxf::Points points;
            const double radius = entity.number(40, 0);
            dxf::add_arc(entity.point(10), radius, from, turn, points);
            if (!whole)
                points.emplace_back(entity.point(10) +
                                    radius * Eigen::Vector3d(std::cos(from + turn), std::sin(from + turn), 0));
            add(entity, points, whole);
        } else if (entity.type == "ELLIPSE") {
            const double from = entity.number(41, 0), to = entity.number(42, 2 * pi), turn = to - from;
            constexpr double rounding = 1e-6; // radians: files have few digits
            const bool whole = std::abs(std::abs(turn) - 2 * pi) < rounding;
            const double round = whole ? 2 * pi : std::fmod(std::fmod(turn, 2 * pi) + 2 * pi, 2 * pi);
            add_curve(entity,
                      dxf::ellipse(entity.point(10), entity.point(11), entity.number(40, 1), from, from + round),
                      whole);
        } else if (entity.type == "SPLINE") {
            const std::optional<dxf::Points> points = dxf::chords_of(spline_of(entity));
            if (!points)
                return false;
            add_curve(entity, *points, entity.has_bit(70, closed));
        } else
            return false;
        return true;
    }

    /// The ends of a closed curve are one point but for rounding.
    void add_curve(const Entity& entity, dxf::Points points, bool closed)
    {
        constexpr double rounding = 1e-6; // of the distance from the end to the middle
        const double size = (points[points.size() / 2] - points.front()).norm();
        if (closed && (points.front() - points.back()).norm() <= rounding * size)
            points.back() = points.front();
        add(entity, std::move(points), false);
    }

    /// A DXF file has no names for lines: several of a layer are told apart by their numbers on it,
    /// in the order of the file. "0" is the layer of what was put on none.
    void number_lines()
    {
        std::map<std::string, int> on_layer, number;
        for (const SheetLine& line : result_.lines)
            ++on_layer[line.name];
        for (SheetLine& line : result_.lines)
            if (const std::string layer = line.name; layer == "0")
                line.name = fmt::format("line {}", ++number[layer]);
            else if (on_layer[layer] > 1)
                line.name = fmt::format("{} line {}", layer, ++number[layer]);
    }

    /// The polyline whose vertices have come.
    void finish()
    {
        if (!chain_)
            return;
        add(owner_, points_of(*chain_), chain_->closed);
        chain_.reset();
    }

    /// Points that stand twice are one.
    void add(const Entity& entity, std::vector<Eigen::Vector3d> points, bool closed)
    {
        if (!std::all_of(points.begin(), points.end(), [](const Eigen::Vector3d& p) { return p.allFinite(); }))
            throw InputError(
                fmt::format("{}: the {} of layer {} bends too sharply or too little to be drawn; export it again",
                            *entity.file, entity.type, entity.layer()));
        points.erase(std::unique(points.begin(), points.end()), points.end());
        if (points.size() > 2 && points.front() == points.back()) {
            closed = true;
            points.pop_back();
        }
        if (points.size() < 2) {
            ++other_[entity.type + " of one point"];
            return;
        }
        SheetLine line{entity.layer(), Eigen::Matrix3Xd(3, Eigen::Index(points.size())), closed && points.size() > 2};
        for (size_t k = 0; k < points.size(); ++k)
            line.point.col(Eigen::Index(k)) = mm_ * points[k];
        result_.lines.push_back(std::move(line));
    }

    double mm_; ///< of a unit of the file
    Entity owner_{};
    std::optional<Chain> chain_;
    std::map<std::string, int> other_;
    DxfLines result_;
};

/// As $INSUNITS counts; 0: none is named.
double millimetres_of(const std::string& file, const std::vector<Pair>& pairs, LengthUnit otherwise)
{
    for (size_t k = 0; k + 1 < pairs.size(); ++k)
        if (pairs[k].code == 9 && pairs[k].value == "$INSUNITS") {
            const std::string& value = pairs[k + 1].value;
            for (const auto& [number, unit] :
                 {std::pair{"1", LengthUnit::inch}, {"4", LengthUnit::mm}, {"5", LengthUnit::cm}, {"6", LengthUnit::m}})
                if (value == number)
                    return millimetres(unit);
            if (value != "0")
                throw InputError(
                    fmt::format("{}: its unit ($INSUNITS {}) is not mm, cm, m or inch; export it in one of "
                                "these",
                                file, value));
        }
    return millimetres(otherwise);
}

} // namespace

DxfLines read_dxf(const std::filesystem::path& file, LengthUnit otherwise)
{
    const std::string name = file.string();
    const std::vector<Pair> pairs = pairs_of(file);
    Reader reader(millimetres_of(name, pairs, otherwise));
    Entity entity;
    bool inside = false, found = false;
    for (size_t k = 0; k < pairs.size(); ++k) {
        if (pairs[k].code != 0) {
            if (inside && !entity.type.empty())
                entity.pairs.push_back(pairs[k]);
            continue;
        }
        if (!entity.type.empty())
            reader.take(entity);
        entity = {&name, "", {}};
        if (pairs[k].value == "SECTION")
            found |= inside = k + 1 < pairs.size() && pairs[k + 1].value == "ENTITIES";
        else if (pairs[k].value == "ENDSEC")
            inside = false;
        else if (inside)
            entity.type = pairs[k].value;
    }
    if (!found || inside)
        throw InputError(fmt::format("{}: {}", name,
                                     found ? "its section ENTITIES is cut off; export it again"
                                           : "has no section ENTITIES; it is no text DXF file"));
    return reader.done();
}

} // namespace spia

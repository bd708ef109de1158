#include "engine/pipeline/files/line_file.h"

#include <algorithm>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/lines/write_lines.h"
#include "engine/pipeline/files/file_members.h"

namespace spia {
namespace {

using namespace members;
constexpr std::string_view lines_schema = "spia.lines/1";

/// Two numbers lie in the plane z = 0.
Eigen::Vector3d point(const Json& json, const Place& place)
{
    if (!json.is_array() || json.size() < 2 || json.size() > 3)
        place.fail("must be two or three numbers [x, y, z]");
    constexpr double most = 1e9;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < json.size(); ++k)
        p[Eigen::Index(k)] = number(json[k], place.entry(k), -most, most);
    return p;
}

std::vector<SheetLine> lines_of_json(const std::filesystem::path& file, LengthUnit otherwise)
{
    const Json json = read_json(file, true);
    const std::string name = file.string();
    const Place top(name);
    require_object(json, top, {"schema", "unit", "lines"});
    if (text_in(json, top, "schema", std::string(lines_schema)) != lines_schema)
        top.member("schema").fail(fmt::format("must be \"{}\"", lines_schema));
    const Json* unit = find(json, top, "unit", false);
    const double mm = millimetres(unit ? length_unit(text(*unit, top.member("unit"))) : otherwise);
    std::vector<SheetLine> lines;
    find(json, top, "lines", true);
    each_of(json, top, "lines", [&](const Json& each, const Place& place, const std::string& called) {
        require_object(each, place, {"name", "closed", "points"});
        const Json* closed = find(each, place, "closed", false);
        if (closed && !closed->is_boolean())
            place.member("closed").fail("must be true or false");
        find(each, place, "points", true);
        std::vector<Eigen::Vector3d> points;
        each_of(each, place, "points",
                [&](const Json& p, const Place& at, const std::string&) { points.push_back(mm * point(p, at)); });
        // points that stand twice are one
        points.erase(std::unique(points.begin(), points.end()), points.end());
        bool round = closed && closed->get<bool>();
        if (points.size() > 2 && points.front() == points.back()) {
            round = true;
            points.pop_back();
        }
        if (points.size() < 2)
            place.member("points").fail("needs two different points or more");
        SheetLine line{text_in(each, place, "name", called), Eigen::Matrix3Xd(3, Eigen::Index(points.size())),
                       round && points.size() > 2};
        for (size_t k = 0; k < points.size(); ++k)
            line.point.col(Eigen::Index(k)) = points[k];
        lines.push_back(std::move(line));
    });
    return lines;
}

} // namespace

DxfLines read_line_file(const std::filesystem::path& file, LengthUnit otherwise)
{
    const std::string ending = lower_case(file.extension().string());
    DxfLines read;
    if (ending == ".dxf")
        read = read_dxf(file, otherwise);
    else if (ending == ".json")
        read.lines = lines_of_json(file, otherwise);
    else
        throw InputError(fmt::format("{}: lines are read from DXF and JSON files", file.string()));
    if (read.lines.empty())
        throw InputError(fmt::format("{}: has no line{}", file.string(),
                                     read.left_out.empty()
                                         ? std::string()
                                         : fmt::format(", only {}; export them as polylines", read.left_out.front())));
    return read;
}

std::string lines_json(std::span<const SheetLine> lines)
{
    Json list = Json::array();
    for (const SheetLine& line : lines) {
        Json points = Json::array();
        for (const auto p : line.point.colwise())
            points.push_back({p[0], p[1], p[2]});
        list.push_back({{"name", line.name}, {"closed", line.closed}, {"points", points}});
    }
    return Json{{"schema", lines_schema}, {"unit", "mm"}, {"lines", list}}.dump(-1, ' ', false,
                                                                                Json::error_handler_t::replace) +
           "\n";
}

std::vector<std::filesystem::path> write_line_files(const std::filesystem::path& folder, const std::string& name,
                                                    std::span<const SheetLine> lines,
                                                    const std::vector<std::string>& formats)
{
    std::vector<std::filesystem::path> files;
    for (const std::string& format : formats) {
        const std::filesystem::path file = folder / (name + "." + format);
        if (format == "dxf")
            write_lines_dxf(file, lines);
        else if (format == "iges")
            write_lines_iges(file, lines, name);
        else if (format == "step")
            write_lines_step(file, lines, name);
        else if (format == "json")
            write_atomically(file, lines_json(lines));
        else
            continue;
        files.push_back(file);
    }
    return files;
}

} // namespace spia

#include "engine/exchange/text/write_csv.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/sheet_field_list.h"

namespace spia {
namespace {

/// What stands behind the name of a column of lengths.
std::string suffix(LengthUnit unit) { return unit == LengthUnit::mm ? "" : fmt::format("_{}", name(unit)); }

bool is_length(const NamedField& field) { return field.name == "thickness"; }

} // namespace

void write_fields_csv(const std::filesystem::path& path, const TriMesh& part, const Blank& blank,
                      const SheetFields& node_fields, const std::vector<int>& number, LengthUnit unit)
{
    require_blank_of(part, blank);
    if (!number.empty() && int(number.size()) != part.vertices())
        throw InputError(fmt::format("{} vertex numbers were given for {} vertices", number.size(), part.vertices()));
    const auto fields = forming_fields(node_fields);
    const std::string in = suffix(unit);
    const double mm = millimetres(unit);
    std::string content = fmt::format("vertex,x{0},y{0},z{0},blank_x{0},blank_y{0}", in);
    for (const NamedField& field : fields) {
        require_finite(field, part.vertices(), "vertex");
        content += "," + field.name + (is_length(field) ? in : "");
    }
    content += '\n';
    auto end = std::back_inserter(content);
    for (int v = 0; v < part.vertices(); ++v) {
        fmt::format_to(end, "{},{},{},{},{},{}", number.empty() ? v : number[size_t(v)], part.position(0, v) / mm,
                       part.position(1, v) / mm, part.position(2, v) / mm, blank.position(0, v) / mm,
                       blank.position(1, v) / mm);
        for (const NamedField& field : fields)
            fmt::format_to(end, ",{}", (*field.value)[v] / (is_length(field) ? mm : 1));
        content += '\n';
    }
    write_atomically(path, content);
}

void write_faces_csv(const std::filesystem::path& path, const TriMesh& part, const SheetFields& face_fields,
                     const Zones* zones, const std::vector<int>& number, LengthUnit unit, const SkinStrains* skins)
{
    if (!number.empty() && int(number.size()) != part.triangles())
        throw InputError(fmt::format("{} face numbers were given for {} faces", number.size(), part.triangles()));
    require_zones(zones, part);
    const bool distance = zones && zones->distance.size() > 0;
    const auto fields = forming_fields(face_fields);
    const std::string in = suffix(unit);
    const double mm = millimetres(unit);
    std::string content = fmt::format("face,x{0},y{0},z{0}", in);
    for (const NamedField& field : fields) {
        require_finite(field, part.triangles(), "face");
        content += "," + field.name + (is_length(field) ? in : "");
    }
    content += fmt::format("{}{}", zones ? ",zone" : "", distance ? ",limit_distance" : "");
    const auto bent = skins ? skin_fields(*skins) : std::vector<NamedField>{};
    for (const NamedField& field : bent) {
        require_finite(field, part.triangles(), "face");
        content += "," + field.name;
    }
    content += '\n';
    auto end = std::back_inserter(content);
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3d middle = part.position(Eigen::all, part.triangle.col(f)).rowwise().mean() / mm;
        fmt::format_to(end, "{},{},{},{}", number.empty() ? f : number[size_t(f)], middle[0], middle[1], middle[2]);
        for (const NamedField& field : fields)
            fmt::format_to(end, ",{}", (*field.value)[f] / (is_length(field) ? mm : 1));
        if (zones)
            fmt::format_to(end, ",{}", name(zones->zone[size_t(f)]));
        if (distance && std::isnan(zones->distance[f]))
            content += ','; // a sheet without a curve
        else if (distance)
            fmt::format_to(end, ",{}", zones->distance[f]);
        for (const NamedField& field : bent)
            fmt::format_to(end, ",{}", (*field.value)[f]);
        content += '\n';
    }
    write_atomically(path, content);
}

void write_outline_csv(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops, LengthUnit unit)
{
    require_outline(loops);
    const double mm = millimetres(unit);
    std::string content = fmt::format("loop,index,x{0},y{0}\n", suffix(unit));
    for (size_t loop = 0; loop < loops.size(); ++loop)
        for (Eigen::Index i = 0; i < loops[loop].cols(); ++i)
            fmt::format_to(std::back_inserter(content), "{},{},{},{}\n", loop, i, loops[loop](0, i) / mm,
                           loops[loop](1, i) / mm);
    write_atomically(path, content);
}

} // namespace spia

#include "engine/exchange/mesh/write_vtu.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

template <class Number> constexpr const char* vtk_type();
template <> constexpr const char* vtk_type<double>() { return "Float64"; }
template <> constexpr const char* vtk_type<int32_t>() { return "Int32"; }
template <> constexpr const char* vtk_type<int64_t>() { return "Int64"; }
template <> constexpr const char* vtk_type<uint8_t>() { return "UInt8"; }

/// Column after column, preceded by its length in bytes.
template <class Matrix> std::string array(const std::string& name, const Matrix& values, int components = 1)
{
    using Number = typename Matrix::Scalar;
    const uint64_t length = uint64_t(values.size()) * sizeof(Number);
    std::string bytes(sizeof length + length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    std::memcpy(bytes.data() + sizeof length, values.data(), length);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
        vtk_type<Number>(), escaped(name), components, base64(bytes));
}

std::string sheet_fields(const SheetFields& fields, double mm)
{
    std::string result = array("thickness", Eigen::VectorXd(fields.thickness / mm));
    for (const NamedField& field : forming_fields(fields))
        if (field.value != &fields.thickness)
            result += array(field.name, *field.value);
    for (const NamedField& field : stress_fields(fields))
        result += array(field.name, *field.value);
    return result + array("direction_major", fields.direction_major, 3) + array("necking", fields.necking);
}

std::string blank_fields(const TriMesh& part, const Blank& blank, double mm)
{
    const Eigen::VectorXd x = blank.position.row(0) / mm, y = blank.position.row(1) / mm;
    Eigen::Matrix3Xd displacement = -part.position;
    displacement.topRows(2) += blank.position;
    displacement /= mm;
    return array("blank_x", x) + array("blank_y", y) + array("displacement_to_blank", displacement, 3);
}

/// A text of VTK: the codes of its characters and a zero.
std::string text_array(const std::string& name, std::string_view text)
{
    std::string codes;
    for (const char c : text)
        codes += fmt::format("{} ", int(c));
    return fmt::format("<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}0</DataArray>\n",
                       name, codes);
}

std::string zone_fields(const Zones& zones)
{
    Eigen::VectorXi number(Eigen::Index(zones.zone.size()));
    for (Eigen::Index f = 0; f < number.size(); ++f)
        number[f] = int(zones.zone[size_t(f)]);
    return array("zone", number) + (zones.distance.size() ? array("limit_distance", zones.distance) : "");
}

std::string zone_names()
{
    std::string names;
    for (const Zone zone : all_zones)
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ", int(zone), name(zone));
    return text_array("zone_names", names);
}

std::string cells(const TriMesh& part)
{
    using Eigen::Dynamic;
    constexpr uint8_t vtk_triangle = 5;
    const int count = part.triangles();
    Eigen::Matrix<int64_t, Dynamic, 1> offset(count);
    for (int f = 0; f < count; ++f)
        offset[f] = 3 * int64_t(f + 1);
    const Eigen::Matrix<uint8_t, Dynamic, 1> type = Eigen::Matrix<uint8_t, Dynamic, 1>::Constant(count, vtk_triangle);
    return array("connectivity", part.triangle) + array("offsets", offset) + array("types", type);
}

/// @param scalars of the points that a viewer shows first; may be empty
std::string vtu_text(const Eigen::Matrix3Xd& position, const TriMesh& part, const std::string& point_data,
                     const std::string& face_data, const std::string& scalars, LengthUnit unit,
                     const std::string& field_data)
{
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- {} : lengths {}, stresses MPa, strains logarithmic -->\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "<UnstructuredGrid>\n<FieldData>\n{}</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
        "<PointData{}>\n{}</PointData>\n"
        "<CellData Scalars=\"thinning\">\n{}</CellData>\n"
        "<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
        program_name(), name(unit), text_array("length_unit", name(unit)) + field_data, part.vertices(),
        part.triangles(), scalars.empty() ? "" : fmt::format(" Scalars=\"{}\"", scalars), point_data, face_data,
        array("Points", Eigen::Matrix3Xd(position / millimetres(unit)), 3), cells(part));
}

} // namespace

void write_vtu(const std::filesystem::path& path, const TriMesh& part, const Blank& blank,
               const SheetFields& face_fields, const SheetFields& node_fields, std::span<const NamedField> extra,
               LengthUnit unit, const Zones* zones, const SkinStrains* skins, std::string_view blank_from)
{
    const double mm = millimetres(unit);
    require_blank_of(part, blank);
    require_fields(face_fields, part.triangles(), "face");
    require_fields(node_fields, part.vertices(), "vertex");
    require_zones(zones, part);
    std::string point_data = sheet_fields(node_fields, mm) + blank_fields(part, blank, mm);
    for (const NamedField& field : extra) {
        require_finite(field, part.vertices(), "vertex");
        point_data += array(field.name, Eigen::VectorXd(*field.value / mm));
    }
    std::string face_data = sheet_fields(face_fields, mm) + (zones ? zone_fields(*zones) : "");
    for (const NamedField& field : skins ? skin_fields(*skins) : std::vector<NamedField>{}) {
        require_finite(field, part.triangles(), "face");
        face_data += array(field.name, *field.value);
    }
    std::string field_data = zones ? zone_names() : std::string();
    if (!blank_from.empty())
        field_data += text_array("blank_from", blank_from);
    write_atomically(path, vtu_text(part.position, part, point_data, face_data, "thinning", unit, field_data));
}

void write_state_vtu(const std::filesystem::path& path, const TriMesh& part, const Eigen::Matrix3Xd& state,
                     const SheetFields& face_fields,
                     std::span<const std::pair<std::string, const Eigen::VectorXi*>> numbers, LengthUnit unit)
{
    const double mm = millimetres(unit);
    if (part.triangles() == 0 || state.cols() != part.position.cols() || !state.allFinite() ||
        !part.position.allFinite())
        throw InputError("the state has not a finite place for each vertex of the part; unfold this part again");
    require_fields(face_fields, part.triangles(), "face");
    std::string face_data = sheet_fields(face_fields, mm);
    for (const auto& [name, values] : numbers) {
        if (values->size() != part.triangles())
            throw InputError(
                fmt::format("{} has {} numbers, the part {} faces", name, values->size(), part.triangles()));
        face_data += array(name, *values);
    }
    write_atomically(path, vtu_text(state, part,
                                    array("displacement_to_part", Eigen::Matrix3Xd((part.position - state) / mm), 3),
                                    face_data, {}, unit, {}));
}

} // namespace spia

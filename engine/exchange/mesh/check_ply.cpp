#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/text/text_lines.h"

namespace spia {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

size_t bytes(Type type)
{
    constexpr std::array<size_t, 8> size = {1, 1, 2, 2, 4, 4, 4, 8};
    return size[size_t(type)];
}

Type type_of(const TextLines& lines, std::string_view word)
{
    constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
    for (size_t i = 0; i < names.size(); ++i)
        if (word == names[i][0] || word == names[i][1])
            return Type(i);
    lines.fail(fmt::format("'{}' is not a PLY type", word.substr(0, 40)));
}

struct Property {
    std::string name;
    Type type;
    bool list = false;
    Type length_type = Type::u8;
};

struct PlyElement {
    std::string name;
    int count = 0;
    std::vector<Property> properties;
};

struct Header {
    enum { text, little, big } encoding = text;
    std::vector<PlyElement> elements;
    std::string_view body;
};

Header read_header(std::string_view file)
{
    TextLines lines(file, 0);
    if (!lines.next() || lines.words()[0] != "ply")
        throw InputError("the file does not begin with 'ply'");
    Header header;
    bool encoding_known = false;
    while (lines.next()) {
        const auto& words = lines.words();
        const auto need = [&](size_t n) {
            if (words.size() < n)
                lines.fail(fmt::format("'{}' needs more words", words[0]));
        };
        if (words[0] == "format") {
            need(2);
            encoding_known = true;
            if (words[1] == "ascii")
                header.encoding = Header::text;
            else if (words[1] == "binary_little_endian")
                header.encoding = Header::little;
            else if (words[1] == "binary_big_endian")
                header.encoding = Header::big;
            else
                lines.fail(fmt::format("the format '{}' is not known", words[1].substr(0, 40)));
        } else if (words[0] == "element") {
            need(3);
            const int count = lines.integer(2);
            if (count < 0 || count > most_elements)
                lines.fail(fmt::format("{} elements are not read (at most {})", count, most_elements));
            header.elements.push_back({std::string(words[1]), count, {}});
        } else if (words[0] == "property") {
            need(3);
            if (header.elements.empty())
                lines.fail("a property stands before the first element");
            if (words[1] == "list") {
                need(5);
                header.elements.back().properties.push_back(
                    {std::string(words[4]), type_of(lines, words[3]), true, type_of(lines, words[2])});
            } else {
                header.elements.back().properties.push_back({std::string(words[2]), type_of(lines, words[1])});
            }
        } else if (words[0] == "end_header") {
            if (!encoding_known)
                lines.fail("the header does not name its format");
            header.body = lines.rest();
            return header;
        } else if (words[0] != "comment" && words[0] != "obj_info") {
            lines.fail(fmt::format("'{}' does not belong into a PLY header", words[0].substr(0, 40)));
        }
    }
    throw InputError("the file is cut off: its header does not end");
}

/// The values behind the header, one after the other.
class Values {
public:
    explicit Values(const Header& header)
        : encoding_(header.encoding), body_(header.body), lines_(header.body, encoding_ == Header::text ? '#' : '\0')
    {
    }

    double next(Type type)
    {
        if (encoding_ == Header::text)
            return next_word();
        if (body_.size() < bytes(type))
            throw InputError("the file is cut off");
        std::array<char, 8> raw{};
        std::copy_n(body_.begin(), bytes(type), raw.begin());
        body_.remove_prefix(bytes(type));
        if (encoding_ == Header::big)
            std::reverse(raw.begin(), raw.begin() + long(bytes(type)));
        switch (type) {
        case Type::i8: return as<int8_t>(raw);
        case Type::u8: return as<uint8_t>(raw);
        case Type::i16: return as<int16_t>(raw);
        case Type::u16: return as<uint16_t>(raw);
        case Type::i32: return as<int32_t>(raw);
        case Type::u32: return as<uint32_t>(raw);
        case Type::f32: return as<float>(raw);
        case Type::f64: return as<double>(raw);
        }
        return 0;
    }

private:
    static_assert(std::endian::native == std::endian::little);
    template <class T> static double as(const std::array<char, 8>& raw)
    {
        T value;
        std::memcpy(&value, raw.data(), sizeof value);
        return double(value);
    }
    double next_word()
    {
        if (word_ == lines_.words().size()) {
            if (!lines_.next())
                throw InputError("the file is cut off");
            word_ = 0;
        }
        return lines_.number_or_nan(word_++);
    }

    int encoding_;
    std::string_view body_;
    TextLines lines_;
    size_t word_ = 0;
};

/// A count or an index: whole, not negative, below the limit.
int whole(double value, double limit, const PlyElement& element, int i)
{
    if (!(value >= 0 && value < limit && value == std::floor(value)))
        throw InputError(
            fmt::format("{} {} holds the number {}, allowed are whole numbers below {:.0f}; the file is damaged",
                        element.name, i, value, limit));
    return int(value);
}

template <class T> void append(std::string& content, T value)
{
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    content.append(raw.data(), raw.size());
}

void require_room(const Header& header)
{
    double least = 0;
    for (const PlyElement& element : header.elements)
        for (const Property& p : element.properties) // a word and its blank, or the bytes of a
                                                     // value or of an empty list
            least += double(element.count) *
                     (header.encoding == Header::text ? 2 : double(bytes(p.list ? p.length_type : p.type)));
    if (least > double(header.body.size()) + 1)
        throw InputError(
            fmt::format("the header announces at least {:.0f} bytes, but {} follow; the file is cut off or damaged",
                        least, header.body.size()));
}

/// The only element of that name; null: there is none.
const PlyElement* only(const Header& header, std::string_view name)
{
    const auto is = [&](const PlyElement& e) { return e.name == name; };
    const auto count = std::count_if(header.elements.begin(), header.elements.end(), is);
    if (count > 1)
        throw InputError(fmt::format("the file has {} elements '{}', where one is read", count, name));
    return count == 0 ? nullptr : &*std::find_if(header.elements.begin(), header.elements.end(), is);
}

bool is_corners(const Property& property)
{
    return property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_vertex(Values& values, const PlyElement& element, int i, std::vector<Eigen::Vector3d>& position,
                 std::string& content)
{
    Eigen::Vector3d p = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    for (const Property& property : element.properties) {
        const double value = values.next(property.list ? property.length_type : property.type);
        if (property.list) {
            const int length = whole(value, most_elements, element, i);
            for (int k = 0; k < length; ++k)
                values.next(property.type);
        } else if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
            p[property.name[0] - 'x'] = value;
        }
    }
    if (!(p.cwiseAbs().maxCoeff() <= largest_coordinate) || !p.allFinite())
        throw InputError(fmt::format("vertex {} has no usable x, y, z: {}, {}, {}", i, p.x(), p.y(), p.z()));
    position.push_back(p);
    for (int k = 0; k < 3; ++k)
        append(content, float(p[k]));
}

/// Polygons as OpenMesh reads them.
struct Polygons {
    int vertices = 0; ///< that there are
    int count = 0;
    std::string content;

    void add(const std::vector<int>& corners)
    {
        if (++count > most_elements)
            throw InputError(fmt::format("the file has more than {} faces", most_elements));
        append(content, int32_t(corners.size()));
        for (const int corner : corners)
            append(content, int32_t(corner));
    }
};

void read_face(Values& values, const PlyElement& element, int i, Polygons& polygons)
{
    for (const Property& property : element.properties) {
        const double value = values.next(property.list ? property.length_type : property.type);
        if (!property.list)
            continue;
        const int length = whole(value, most_elements, element, i);
        std::vector<int> corners;
        for (int k = 0; k < length; ++k) {
            const double entry = values.next(property.type);
            if (is_corners(property))
                corners.push_back(whole(entry, polygons.vertices, element, i));
        }
        if (is_corners(property))
            polygons.add(corners);
    }
}

/// Strips of triangles in one list, each ended by -1: every second triangle runs through its
/// corners the other way about. A corner that is repeated only joins strips. [Turk, The PLY Polygon
/// File Format, 1994; vtkPLYReader]
void read_strips(Values& values, const PlyElement& element, int i, Polygons& polygons)
{
    for (const Property& property : element.properties) {
        const double value = values.next(property.list ? property.length_type : property.type);
        if (!property.list)
            continue;
        const int length = whole(value, most_elements, element, i);
        std::array<int, 2> last{};
        int there = 0; // corners of the strip so far
        for (int k = 0; k < length; ++k) {
            const double entry = values.next(property.type);
            if (!is_corners(property))
                continue;
            if (entry == -1) {
                there = 0;
                continue;
            }
            const int corner = whole(entry, polygons.vertices, element, i);
            if (there >= 2 && corner != last[0] && corner != last[1] && last[0] != last[1])
                polygons.add({last[size_t(there % 2)], last[size_t(1 - there % 2)], corner});
            last = {last[1], corner};
            ++there;
        }
    }
}

} // namespace

CheckedFile check_ply(std::string_view file)
{
    const Header header = read_header(file);
    require_room(header);
    const PlyElement *vertex = only(header, "vertex"), *face = only(header, "face"),
                     *strips = only(header, "tristrips");
    if (!vertex || (!face && !strips))
        throw InputError("the file must have the elements 'vertex' and 'face' or 'tristrips'; save it as a mesh");
    for (const PlyElement* shape : {face, strips}) {
        if (!shape)
            continue;
        if (std::count_if(shape->properties.begin(), shape->properties.end(), is_corners) != 1)
            throw InputError(fmt::format("the element '{}' must have one list 'vertex_indices'", shape->name));
        if (vertex > shape)
            throw InputError("the faces stand before the vertices; save the mesh anew");
    }
    for (const PlyElement& element : header.elements)
        if (element.properties.empty() && element.count > 0)
            throw InputError(fmt::format("the element '{}' has no properties", element.name.substr(0, 40)));

    CheckedFile result{
        .format = header.encoding == Header::text ? "PLY (text)" : "PLY (binary)", .extension = "ply", .binary = true};
    result.content =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                    "property float z\nelement face ",
                    vertex->count);
    std::string positions;
    Polygons polygons{.vertices = vertex->count, .content = {}};
    Values values(header);
    const PlyElement* const last = std::max(face, strips); // nothing behind it is of interest
    for (const PlyElement& element : header.elements) {
        for (int i = 0; i < element.count; ++i)
            if (&element == vertex)
                read_vertex(values, element, i, result.position, positions);
            else if (&element == face)
                read_face(values, element, i, polygons);
            else if (&element == strips)
                read_strips(values, element, i, polygons);
            else
                for (const Property& p : element.properties)
                    for (int rest = p.list ? whole(values.next(p.length_type), most_elements, element, i) : 1; rest > 0;
                         --rest)
                        values.next(p.type);
        if (&element == last)
            break;
    }
    result.faces = polygons.count;
    result.content += fmt::format("{}\nproperty list int int vertex_indices\nend_header\n", polygons.count) +
                      positions + polygons.content;
    return result;
}

} // namespace spia

#include "engine/exchange/mesh/read_gltf.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "engine/core/error.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/mesh/gltf_compression.h"

namespace spia {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// ---- before tinygltf sees the file ---- It copies nested values by recursion, holds a copy of the
// binary chunk for every buffer that names none, trusts the indices of images, and opens any file
// that a buffer names. So it gets the geometry alone, and reads files through us.

struct Parts {
    std::string_view json, binary;
};

uint32_t word_at(std::string_view file, size_t at)
{
    uint32_t value;
    std::memcpy(&value, file.data() + at, sizeof value);
    return value;
}

/// The text of a .gltf or the two chunks of a .glb.
Parts parts_of(std::string_view file)
{
    if (file.substr(0, 4) != "glTF")
        return {file, {}};
    constexpr size_t header = 12, chunk_header = 8;
    constexpr uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    const auto chunk_at = [&](size_t at, uint32_t type) -> std::string_view {
        if (at + chunk_header > file.size() || word_at(file, at + 4) != type ||
            word_at(file, at) > file.size() - at - chunk_header)
            throw InputError("the binary glTF file is cut off or damaged");
        return file.substr(at + chunk_header, word_at(file, at));
    };
    if (file.size() < header || word_at(file, 4) != 2 || word_at(file, 8) > file.size())
        throw InputError("the binary glTF file is cut off, damaged or not of version 2");
    Parts parts{chunk_at(header, json_chunk), {}};
    const size_t next = header + chunk_header + parts.json.size();
    if (next + chunk_header <= word_at(file, 8))
        parts.binary = chunk_at(next, binary_chunk);
    return parts;
}

void require_shallow(std::string_view text)
{
    constexpr int deepest = 64; // a scene's geometry needs 6
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > deepest)
            throw InputError("the glTF file is nested too deeply; it is damaged");
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
}

void require_known_extensions(const json& scene)
{
    for (const json& extension : scene.value("extensionsRequired", json::array())) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "";
        const bool harmless = name == "KHR_mesh_quantization" || name == "EXT_meshopt_compression" ||
                              name == "KHR_draco_mesh_compression" || name.rfind("KHR_materials", 0) == 0 ||
                              name.rfind("KHR_texture", 0) == 0 || name.rfind("KHR_lights", 0) == 0 ||
                              name.rfind("EXT_texture", 0) == 0;
        if (!harmless)
            throw InputError(
                fmt::format("the file needs the extension '{}', which is not known here", name.substr(0, 60)));
    }
}

/// Drops everything but geometry.
void keep_geometry(json& value)
{
    if (value.is_object()) {
        value.erase("extensions");
        value.erase("extras");
    }
    if (value.is_structured())
        for (json& inner : value)
            keep_geometry(inner);
}

/// The scene as tinygltf gets it.
json geometry_of(const Parts& parts, GltfCompression& compression)
{
    require_shallow(parts.json);
    json scene = json::parse(parts.json, nullptr, false);
    if (!scene.is_object())
        throw InputError("the glTF file is cut off or damaged: its JSON does not end well");
    require_known_extensions(scene);
    json kept = json::object();
    for (const char* key : {"asset", "scene", "scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"})
        if (scene.contains(key))
            kept[key] = std::move(scene[key]);
    compression = take_compression(kept);
    keep_geometry(kept);
    if (kept.contains("buffers")) {
        const auto& buffers = kept["buffers"];
        const auto in_chunk = std::count_if(buffers.begin(), buffers.end(),
                                            [](const json& b) { return b.is_object() && !b.contains("uri"); });
        if (in_chunk > 1 || buffers.size() > 100)
            throw InputError("the glTF file has too many buffers; it is damaged");
    }
    return kept;
}

// ---- files beside a .gltf ----

struct Folder {
    fs::path path;
    uintmax_t budget = uintmax_t(2) << 30; // bytes, of all buffers together
};

/// The file itself if it is a plain file in the folder (or below it), else nothing.
std::optional<fs::path> inside(const Folder& folder, const std::string& name)
{
    std::error_code problem;
    const fs::path file = fs::weakly_canonical(name, problem), root = fs::weakly_canonical(folder.path, problem);
    const fs::path relative = file.lexically_relative(root);
    if (problem || relative.empty() || *relative.begin() == ".." || !fs::is_regular_file(file, problem))
        return std::nullopt;
    return file;
}

bool file_exists(const std::string& name, void* folder)
{
    return inside(*static_cast<Folder*>(folder), name).has_value();
}

std::string same_name(const std::string& name, void*) { return name; }

bool read_whole_file(std::vector<unsigned char>* content, std::string* problem, const std::string& name, void* user)
{
    Folder& folder = *static_cast<Folder*>(user);
    const auto path = inside(folder, name);
    std::error_code unreadable;
    const uintmax_t size = path ? fs::file_size(*path, unreadable) : 0;
    if (!path || unreadable || size > folder.budget) {
        *problem = "not a readable file of a sensible size";
        return false;
    }
    folder.budget -= size;
    content->resize(size_t(size));
    std::ifstream stream(*path, std::ios::binary);
    return bool(stream.read(reinterpret_cast<char*>(content->data()), std::streamsize(size)));
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

std::string pack(const json& scene, std::string_view binary)
{
    std::string text = scene.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const size_t padded = (binary.size() + 3) / 4 * 4;
    std::string file = "glTF";
    const auto append = [&](uint32_t value) { file.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(2);
    append(uint32_t(12 + 8 + text.size() + (padded > 0 ? 8 + padded : 0)));
    append(uint32_t(text.size()));
    file += "JSON" + text;
    if (padded > 0) {
        append(uint32_t(padded));
        file.append("BIN\0", 4);
        file += binary;
        file.append(padded - binary.size(), '\0');
    }
    return file;
}

tinygltf::Model run_tinygltf(const fs::path& path, const Parts& parts, GltfCompression& compression)
{
    const std::string packed = pack(geometry_of(parts, compression), parts.binary);
    if (packed.size() > std::numeric_limits<uint32_t>::max())
        throw InputError("the file is too large");
    std::error_code problem;
    Folder folder{fs::absolute(path, problem).parent_path()};
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks({file_exists, same_name, read_whole_file, write_nothing, &folder});
    tinygltf::Model model;
    std::string error, warning;
    bool good = false;
    try {
        good =
            reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(packed.data()),
                                        unsigned(packed.size()), folder.path.string());
    } catch (const std::exception& other) { // tinygltf lets standard exceptions out, e.g. for an
                                            // empty buffer
        error = other.what();
    }
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!good || !error.empty())
        throw InputError(fmt::format("the glTF file is damaged: {}", error.substr(0, 200)));
    return model;
}

// ---- from tinygltf's model to polygons ----

template <class T> const T& at(const std::vector<T>& list, int i, const char* what)
{
    if (i < 0 || size_t(i) >= list.size())
        throw InputError(fmt::format("the glTF file names the {} {}, but has {}", what, i, list.size()));
    return list[size_t(i)];
}

/// Bytes of a buffer. @throws InputError if they do not lie in it
std::span<const unsigned char> bytes_of(const tinygltf::Model& model, int buffer, size_t offset, size_t length)
{
    const auto& data = at(model.buffers, buffer, "buffer").data;
    if (offset > data.size() || length > data.size() - offset)
        throw InputError(fmt::format("the glTF file has {} bytes in a buffer where {} from {} on are meant; it is cut "
                                     "off or damaged",
                                     data.size(), length, offset));
    return {data.data() + offset, length};
}

/// Puts what compressed buffer views hold into buffers of their own.
void decode_views(tinygltf::Model& model, const GltfCompression& compression)
{
    size_t left = size_t(2) << 30; // bytes, of all together
    for (const auto& [v, compressed] : compression.views) {
        if (size_t(v) >= model.bufferViews.size() || compressed.count * compressed.stride > left)
            throw InputError("the compressed mesh is too large, or damaged");
        left -= compressed.count * compressed.stride;
        tinygltf::Buffer buffer;
        buffer.data = decoded(compressed, bytes_of(model, compressed.buffer, compressed.offset, compressed.length));
        auto& view = model.bufferViews[size_t(v)];
        view.buffer = int(model.buffers.size());
        view.byteOffset = 0;
        view.byteLength = buffer.data.size();
        view.byteStride = compressed.mode == "ATTRIBUTES" ? compressed.stride : 0;
        model.buffers.push_back(std::move(buffer));
    }
}

/// Elements in a row, checked to lie inside their buffer.
class Row {
public:
    /// @param index  of the accessor, for messages
    Row(const tinygltf::Model& model, int index, int buffer_view, size_t offset, size_t count, int component_type,
        int components, bool normalized)
        : component_type_(component_type), normalized_(normalized)
    {
        const auto& view = at(model.bufferViews, buffer_view, "buffer view");
        const auto& buffer = at(model.buffers, view.buffer, "buffer");
        component_bytes_ = size_t(std::max(0, tinygltf::GetComponentSizeInBytes(uint32_t(component_type))));
        const size_t element = component_bytes_ * size_t(std::max(0, components)), size = buffer.data.size();
        stride_ = view.byteStride > 0 ? view.byteStride : element;
        // Each step is a division or subtraction of what is already known to fit: nothing can
        // overflow.
        const bool fits = element > 0 && count > 0 && count <= size_t(most_elements) && view.byteOffset <= size &&
                          view.byteLength <= size - view.byteOffset && offset <= view.byteLength &&
                          element <= view.byteLength - offset &&
                          count - 1 <= (view.byteLength - offset - element) / stride_;
        if (!fits)
            throw InputError(
                fmt::format("accessor {} ({} elements) is empty or does not fit into its buffer of {} bytes; the file "
                            "is cut off or damaged",
                            index, count, size));
        bytes_ = buffer.data.data() + view.byteOffset + offset;
    }

    double value(int i, int component) const
    {
        const unsigned char* from = bytes_ + size_t(i) * stride_ + size_t(component) * component_bytes_;
        switch (component_type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled<int8_t>(from);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled<uint8_t>(from);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled<int16_t>(from);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled<uint16_t>(from);
        case TINYGLTF_COMPONENT_TYPE_INT: return load<int32_t>(from);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return load<uint32_t>(from);
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return double(load<float>(from));
        case TINYGLTF_COMPONENT_TYPE_DOUBLE: return load<double>(from);
        default: return std::numeric_limits<double>::quiet_NaN();
        }
    }

private:
    template <class T> static T load(const unsigned char* from)
    {
        T value;
        std::memcpy(&value, from, sizeof value);
        return value;
    }
    template <class T> double scaled(const unsigned char* from) const // KHR_mesh_quantization
    {
        const double value = load<T>(from);
        return normalized_ ? std::max(value / double(std::numeric_limits<T>::max()), -1.0) : value;
    }

    int component_type_;
    bool normalized_;
    size_t component_bytes_ = 0, stride_ = 0;
    const unsigned char* bytes_ = nullptr;
};

/// Of the whole numbers of a type, which stands for 1 (KHR_mesh_quantization).
double greatest(int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return std::numeric_limits<int8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return std::numeric_limits<uint8_t>::max();
    case TINYGLTF_COMPONENT_TYPE_SHORT: return std::numeric_limits<int16_t>::max();
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return std::numeric_limits<uint16_t>::max();
    default: return 1;
    }
}

bool whole_numbers(int component_type)
{
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// What an accessor holds: its row, or zeros, and in their places the values of its sparse list.
class Elements {
public:
    Elements(const tinygltf::Model& model, int index) : accessor_(at(model.accessors, index, "accessor"))
    {
        const auto row = [&](int view, size_t offset, size_t count) {
            return Row(model, index, view, offset, count, accessor_.componentType,
                       tinygltf::GetNumComponentsInType(uint32_t(accessor_.type)), accessor_.normalized);
        };
        const auto& sparse = accessor_.sparse;
        if (accessor_.bufferView >= 0 || !sparse.isSparse)
            base_ = row(accessor_.bufferView, accessor_.byteOffset, accessor_.count);
        else if (accessor_.count < 1 || accessor_.count > size_t(most_elements))
            throw InputError(fmt::format("accessor {} has {} elements; the file is damaged", index, accessor_.count));
        if (!sparse.isSparse)
            return;
        const size_t count = sparse.count > 0 ? size_t(sparse.count) : 0;
        replaced_ = row(sparse.values.bufferView, size_t(std::max(0, sparse.values.byteOffset)), count);
        const Row places(model, index, sparse.indices.bufferView, size_t(std::max(0, sparse.indices.byteOffset)), count,
                         sparse.indices.componentType, 1, false);
        if (!whole_numbers(sparse.indices.componentType))
            throw InputError(fmt::format("accessor {} replaces elements by numbers that are not whole", index));
        for (size_t k = 0; k < count; ++k) {
            const double place = places.value(int(k), 0);
            if (!(place < double(accessor_.count)) || (k > 0 && !(place > place_.back())))
                throw InputError(
                    fmt::format("accessor {} replaces its element {}, but the numbers must rise and be below {}", index,
                                place, accessor_.count));
            place_.push_back(int(place));
        }
    }

    int count() const { return int(accessor_.count); }
    int type() const { return accessor_.type; }
    bool is_whole() const { return whole_numbers(accessor_.componentType); }

    double value(int i, int component) const
    {
        const auto found = std::lower_bound(place_.begin(), place_.end(), i);
        if (found != place_.end() && *found == i)
            return replaced_->value(int(found - place_.begin()), component);
        return base_ ? base_->value(i, component) : 0;
    }

private:
    const tinygltf::Accessor& accessor_;
    std::optional<Row> base_, replaced_;
    std::vector<int> place_; ///< of the elements that are replaced
};

Eigen::Affine3d transform_of(const tinygltf::Node& node)
{
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
        result.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
        return result;
    }
    if (node.translation.size() == 3)
        result.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    if (node.rotation.size() == 4)
        result.rotate(Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(node.rotation.data())).normalized());
    if (node.scale.size() == 3)
        result.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
    return result;
}

/// Collects the scene's triangles.
class Collector {
public:
    Collector(const tinygltf::Model& model, const GltfCompression& compression, const Progress& progress)
        : model_(model), compression_(compression), progress_(progress), visited_(model.nodes.size(), 0)
    {
    }

    GltfContent collect()
    {
        if (model_.nodes.empty()) {
            for (size_t m = 0; m < model_.meshes.size(); ++m)
                add_mesh(int(m), Eigen::Affine3d::Identity());
        } else {
            for (const int root : roots())
                walk(root);
        }
        if (skipped_ > 0)
            content_.notes.push_back(
                fmt::format("{} point or line sets were skipped: only triangles are read", skipped_));
        if (morphed_)
            content_.notes.push_back("morph targets were ignored: the base shape was read");
        return std::move(content_);
    }

private:
    std::vector<int> roots() const
    {
        if (!model_.scenes.empty())
            return at(model_.scenes, std::max(0, model_.defaultScene), "scene").nodes;
        std::vector<char> is_child(model_.nodes.size(), 0);
        for (const auto& node : model_.nodes)
            for (const int child : node.children)
                if (child >= 0 && size_t(child) < is_child.size())
                    is_child[size_t(child)] = 1;
        std::vector<int> result;
        for (size_t n = 0; n < is_child.size(); ++n)
            if (!is_child[n])
                result.push_back(int(n));
        return result;
    }

    void walk(int root)
    {
        std::vector<std::pair<int, Eigen::Affine3d>> open = {{root, Eigen::Affine3d::Identity()}};
        while (!open.empty()) {
            const auto [n, parent] = open.back();
            open.pop_back();
            const auto& node = at(model_.nodes, n, "node");
            if (visited_[size_t(n)]++)
                throw InputError(fmt::format("node {} hangs in two places of the scene; the glTF file is damaged", n));
            const Eigen::Affine3d here = parent * transform_of(node);
            if (node.mesh >= 0)
                add_mesh(node.mesh, here);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                open.emplace_back(*child, here);
        }
    }

    void add_mesh(int m, const Eigen::Affine3d& transform)
    {
        progress_.checkpoint(0.5, "reading glTF meshes");
        std::map<int, int> first_vertex; // of each position accessor: primitives may share one
        int p = -1;
        for (const auto& primitive : at(model_.meshes, m, "mesh").primitives) {
            ++p;
            morphed_ = morphed_ || !primitive.targets.empty();
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
                primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
                ++skipped_;
                continue;
            }
            const auto position = primitive.attributes.find("POSITION");
            if (position == primitive.attributes.end())
                throw InputError(fmt::format("mesh {} has a primitive without positions", m));
            if (const auto draco = compression_.primitives.find({m, p}); draco != compression_.primitives.end()) {
                add_draco(draco->second, position->second, transform);
                continue;
            }
            if (const auto [entry, is_new] = first_vertex.try_emplace(position->second, content_.soup.vertices());
                is_new)
                add_vertices(position->second, transform);
            const int vertices = Elements(model_, position->second).count();
            add_triangles(primitive, first_vertex.at(position->second), vertices, transform.linear().determinant() < 0);
        }
    }

    void add_vertices(int accessor, const Eigen::Affine3d& transform)
    {
        const Elements positions(model_, accessor);
        if (positions.type() != TINYGLTF_TYPE_VEC3)
            throw InputError(fmt::format("accessor {} holds positions that are not three numbers", accessor));
        if (positions.count() > most_elements - content_.soup.vertices())
            throw InputError(fmt::format("the scene has more than {} vertices", most_elements));
        for (int i = 0; i < positions.count(); ++i)
            content_.soup.position.push_back(
                transform * Eigen::Vector3d(positions.value(i, 0), positions.value(i, 1), positions.value(i, 2)));
    }

    void add_draco(const DracoPrimitive& primitive, int accessor, const Eigen::Affine3d& transform)
    {
        const auto& view = at(model_.bufferViews, primitive.view, "buffer view");
        const DracoMesh mesh =
            decoded_draco(bytes_of(model_, view.buffer, view.byteOffset, view.byteLength), primitive.position);
        const auto& said = at(model_.accessors, accessor, "accessor");
        const double scale = said.normalized && !mesh.scaled ? 1 / greatest(said.componentType) : 1;
        const int first = content_.soup.vertices();
        if (int(mesh.position.size()) > most_elements - first ||
            int(mesh.triangle.size()) > most_elements - content_.soup.polygons())
            throw InputError(fmt::format("the scene has more than {} vertices or triangles", most_elements));
        for (const Eigen::Vector3d& x : mesh.position)
            content_.soup.position.push_back(transform * (scale * x));
        const bool mirrored = transform.linear().determinant() < 0;
        for (std::array<int, 3> t : mesh.triangle) {
            if (mirrored)
                std::swap(t[1], t[2]);
            content_.soup.add_polygon(std::array{first + t[0], first + t[1], first + t[2]});
        }
    }

    void add_triangles(const tinygltf::Primitive& primitive, int first, int vertices, bool mirrored)
    {
        std::vector<int> index;
        if (primitive.indices < 0) {
            for (int i = 0; i < vertices; ++i)
                index.push_back(i);
        } else {
            const Elements numbers(model_, primitive.indices);
            if (numbers.type() != TINYGLTF_TYPE_SCALAR || !numbers.is_whole())
                throw InputError(fmt::format("accessor {} holds indices that are no whole numbers", primitive.indices));
            for (int i = 0; i < numbers.count(); ++i) {
                const double v = numbers.value(i, 0);
                if (!(v < vertices))
                    throw InputError(fmt::format("a triangle names vertex {} of accessor {}, which has {}", v,
                                                 primitive.attributes.at("POSITION"), vertices));
                index.push_back(int(v));
            }
        }
        const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES, fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const int n = int(index.size());
        if (list && n % 3 != 0)
            throw InputError(fmt::format("a triangle list has {} corners, which are not three each", n));
        const int count = list ? n / 3 : std::max(0, n - 2);
        if (count > most_elements - content_.soup.polygons())
            throw InputError(fmt::format("the scene has more than {} triangles", most_elements));
        for (int i = 0; i < count; ++i) {
            std::array<int, 3> t = list  ? std::array{3 * i, 3 * i + 1, 3 * i + 2}
                                   : fan ? std::array{i + 1, i + 2, 0}
                                         : std::array{i, i + 1 + i % 2, i + 2 - i % 2};
            for (int& corner : t)
                corner = first + index[size_t(corner)];
            if (mirrored)
                std::swap(t[1], t[2]);
            content_.soup.add_polygon(t);
        }
    }

    const tinygltf::Model& model_;
    const GltfCompression& compression_;
    const Progress& progress_;
    std::vector<char> visited_; // a node has one parent at most
    GltfContent content_;
    int skipped_ = 0;
    bool morphed_ = false;
};

} // namespace

GltfContent read_gltf(const std::filesystem::path& path, std::string_view file, const Progress& progress)
{
    GltfCompression compression;
    tinygltf::Model model = run_tinygltf(path, parts_of(file), compression);
    decode_views(model, compression);
    return Collector(model, compression, progress).collect();
}

} // namespace spia

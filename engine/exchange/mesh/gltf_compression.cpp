#include "engine/exchange/mesh/gltf_compression.h"

#include <draco/compression/decode.h>
#include <fmt/core.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/exchange/mesh/checked_file.h"

namespace spia {
namespace {

using nlohmann::json;

constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* draco_name = "KHR_draco_mesh_compression";

const json* extension(const json& value, const char* name)
{
    if (!value.is_object())
        return nullptr;
    const auto all = value.find("extensions");
    if (all == value.end() || !all->is_object())
        return nullptr;
    const auto found = all->find(name);
    return found == all->end() || !found->is_object() ? nullptr : &*found;
}

/// A count or index of an extension. @returns `missing` where there is none
size_t whole(const json& from, const char* key, size_t missing)
{
    const auto found = from.find(key);
    if (found == from.end())
        return missing;
    constexpr std::uint64_t most = std::uint64_t(1) << 31;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > most)
        throw InputError(fmt::format("the compressed mesh has no usable '{}'; the file is damaged", key));
    return size_t(found->get<std::uint64_t>());
}

std::string word(const json& from, const char* key, const char* missing)
{
    const auto found = from.find(key);
    return found != from.end() && found->is_string() ? found->get<std::string>() : missing;
}

/// Whether the decoder takes what is said, and as much as the bytes can hold.
void require_decodable(const MeshoptView& view)
{
    const bool indices = view.mode == "TRIANGLES" || view.mode == "INDICES";
    const bool known = view.filter == "NONE" || view.filter == "EXPONENTIAL" ||
                       (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                       (view.filter == "QUATERNION" && view.stride == 8);
    const bool sizes = indices
                           ? (view.stride == 2 || view.stride == 4) && view.filter == "NONE" &&
                                 (view.mode == "INDICES" || view.count % 3 == 0)
                           : view.mode == "ATTRIBUTES" && view.stride > 0 && view.stride % 4 == 0 && view.stride <= 256;
    // Of 16 vertices each byte takes two bits at least, and of a triangle there is a byte.
    constexpr size_t most_ratio = 64, tail = 4096;
    const bool fits = view.count > 0 && view.count <= 3 * size_t(most_elements) &&
                      view.count * view.stride <= most_ratio * view.length + tail;
    if (!known || !sizes || !fits)
        throw InputError(fmt::format("a compressed buffer view ({} elements of {} bytes in {}, {}, {}) is not one "
                                     "that can be decoded; the file is damaged",
                                     view.count, view.stride, view.length, view.mode.substr(0, 40),
                                     view.filter.substr(0, 40)));
}

MeshoptView view_of(const json& said)
{
    MeshoptView view{int(whole(said, "buffer", 0)), whole(said, "byteOffset", 0), whole(said, "byteLength", 0),
                     whole(said, "count", 0),       whole(said, "byteStride", 0), word(said, "mode", ""),
                     word(said, "filter", "NONE")};
    require_decodable(view);
    return view;
}

} // namespace

GltfCompression take_compression(json& scene)
{
    GltfCompression result;
    json none = json::array();
    const auto list = [&](const char* key) -> json& {
        const auto found = scene.find(key);
        return found != scene.end() && found->is_array() ? *found : none;
    };
    json& views = list("bufferViews");
    for (size_t v = 0; v < views.size(); ++v)
        if (const json* said = extension(views[v], meshopt))
            result.views.emplace(int(v), view_of(*said));
    for (json& buffer : list("buffers"))
        if (const json* said = extension(buffer, meshopt);
            said && said->value("fallback", json(false)) == json(true) && !buffer.contains("uri")) {
            buffer["uri"] = "data:application/octet-stream;base64,AA==";
            buffer["byteLength"] = 1;
        }
    json& meshes = list("meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        if (!meshes[m].is_object() || !meshes[m].contains("primitives"))
            continue;
        json& primitives = meshes[m]["primitives"];
        for (size_t p = 0; primitives.is_array() && p < primitives.size(); ++p) {
            const json* said = extension(primitives[p], draco_name);
            if (!said)
                continue;
            const auto attributes = said->find("attributes");
            if (attributes == said->end() || !attributes->is_object() || !attributes->contains("POSITION"))
                throw InputError(fmt::format("mesh {} is compressed without positions", m));
            constexpr size_t absent = (size_t(1) << 31) - 1;
            result.primitives[{int(m), int(p)}] = {int(whole(*said, "bufferView", absent)),
                                                   int(whole(*attributes, "POSITION", absent))};
            primitives[p].erase("indices"); // their accessor has no bytes, which tinygltf does not
                                            // accept
        }
    }
    return result;
}

std::vector<unsigned char> decoded(const MeshoptView& view, std::span<const unsigned char> bytes)
{
    std::vector<unsigned char> result(view.count * view.stride);
    const int failed =
        view.mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(result.data(), view.count, view.stride, bytes.data(), bytes.size())
        : view.mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(result.data(), view.count, view.stride, bytes.data(), bytes.size())
            : meshopt_decodeIndexSequence(result.data(), view.count, view.stride, bytes.data(), bytes.size());
    if (failed != 0)
        throw InputError(
            fmt::format("compressed bytes ({} of them) cannot be decoded; the file is damaged", bytes.size()));
    if (view.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(result.data(), view.count, view.stride);
    else if (view.filter == "QUATERNION")
        meshopt_decodeFilterQuat(result.data(), view.count, view.stride);
    else if (view.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(result.data(), view.count, view.stride);
    return result;
}

DracoMesh decoded_draco(std::span<const unsigned char> bytes, int position)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw InputError(fmt::format("the mesh compressed with Draco cannot be decoded ({}); the file is damaged",
                                     decoded.status().error_msg_string().substr(0, 100)));
    const draco::Mesh& mesh = *decoded.value();
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(std::uint32_t(position));
    if (!attribute || attribute->num_components() != 3)
        throw InputError(
            fmt::format("the mesh compressed with Draco has no positions of three numbers as attribute {}", position));
    if (mesh.num_points() > std::uint32_t(most_elements) || mesh.num_faces() > std::uint32_t(most_elements))
        throw InputError(fmt::format("the compressed mesh has more than {} vertices or triangles", most_elements));
    DracoMesh result;
    result.scaled = attribute->normalized();
    for (draco::PointIndex v(0); v < mesh.num_points(); ++v) {
        const draco::AttributeValueIndex at = attribute->mapped_index(v);
        Eigen::Vector3d x;
        if (at.value() >= attribute->size() || !attribute->ConvertValue<double>(at, 3, x.data()))
            throw InputError(fmt::format("vertex {} of the mesh compressed with Draco has no position", v.value()));
        result.position.push_back(x);
    }
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
        std::array<int, 3> triangle;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t corner = mesh.face(f)[k].value();
            if (corner >= mesh.num_points())
                throw InputError(fmt::format("triangle {} of the mesh compressed with Draco names vertex {}, which is "
                                             "not there",
                                             f.value(), corner));
            triangle[size_t(k)] = int(corner);
        }
        result.triangle.push_back(triangle);
    }
    return result;
}

} // namespace spia

#pragma once
#include <algorithm>
#include <cstdint>
#include <fmt/core.h>
#include <string>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/shapes.h"

/// A small sheet in every mesh format, written by other code than what reads it.
namespace spia::sample {

template <class T> void append(std::string& bytes, T value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A bent sheet with digits that single precision does not hold.
inline TriMesh bent_sheet()
{
    TriMesh mesh = shapes::rectangle(100. / 3, 70. / 3, 5, 4);
    for (int v = 0; v < mesh.vertices(); ++v)
        mesh.position(2, v) = 0.01 * mesh.position(0, v) * mesh.position(0, v);
    return mesh;
}

inline std::string obj_text(const TriMesh& mesh)
{
    std::string text = "# comment\nmtllib none.mtl\no part\n";
    for (int v = 0; v < mesh.vertices(); ++v)
        text += fmt::format("v {} {} {}\n", mesh.position(0, v), mesh.position(1, v), mesh.position(2, v));
    text += "vt 0 0\nvn 0 0 1\nusemtl steel\ns off\n";
    for (int f = 0; f < mesh.triangles(); ++f)
        text += fmt::format("f {}/1/1 {}//1 {}\n", mesh.triangle(0, f) + 1, mesh.triangle(1, f) + 1,
                            mesh.triangle(2, f) + 1);
    return text;
}

inline std::string off_text(const TriMesh& mesh)
{
    std::string text = fmt::format("COFF # with colours\n{} {} 0\n\n", mesh.vertices(), mesh.triangles());
    for (int v = 0; v < mesh.vertices(); ++v)
        text += fmt::format("{} {} {} 255 0 0 255\n", mesh.position(0, v), mesh.position(1, v), mesh.position(2, v));
    for (int f = 0; f < mesh.triangles(); ++f)
        text += fmt::format("3 {} {} {} 0.5 0.5 0.5\n", mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f));
    return text;
}

/// With normals, a quality, colours and texture lists around what is needed, as scanners and
/// modellers write them.
inline std::string ply_text(const TriMesh& mesh)
{
    std::string text =
        fmt::format("ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex {}\r\nproperty float nx\r\n"
                    "property double x\r\nproperty double y\r\nproperty double z\r\nproperty float quality\r\nelement "
                    "face {}\r\n"
                    "property uchar red\r\nproperty list uint8 int32 vertex_indices\r\nproperty list uchar float "
                    "texcoord\r\n"
                    "element edge 1\r\nproperty int a\r\nend_header\r\n",
                    mesh.vertices(), mesh.triangles());
    for (int v = 0; v < mesh.vertices(); ++v)
        text += fmt::format("1 {} {} {} nan\r\n", mesh.position(0, v), mesh.position(1, v), mesh.position(2, v));
    for (int f = 0; f < mesh.triangles(); ++f)
        text +=
            fmt::format("7 3 {} {} {} 2 0.5 0.25\r\n", mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f));
    return text + "5\r\n";
}

inline std::string ply_binary(const TriMesh& mesh, bool big)
{
    std::string bytes =
        fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                    "property double z\nproperty uchar red\nelement face {}\nproperty list ushort uint vertex_index\n"
                    "end_header\n",
                    big ? "big" : "little", mesh.vertices(), mesh.triangles());
    const auto put = [&](auto value) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (big)
            std::reverse(raw.begin(), raw.end());
        bytes += raw;
    };
    for (int v = 0; v < mesh.vertices(); ++v) {
        for (int k = 0; k < 3; ++k)
            put(mesh.position(k, v));
        put(uint8_t(200));
    }
    for (int f = 0; f < mesh.triangles(); ++f) {
        put(uint16_t(3));
        for (int k = 0; k < 3; ++k)
            put(uint32_t(mesh.triangle(k, f)));
    }
    return bytes;
}

inline std::string stl_text(const TriMesh& mesh)
{
    std::string text = "solid router cover\n"; // "outer" in a name is no loop
    for (int f = 0; f < mesh.triangles(); ++f) {
        text += " facet normal 0 0 1\n  outer loop\n";
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f p = mesh.position.col(mesh.triangle(k, f)).cast<float>();
            text += fmt::format("   vertex {} {} {}\n", p.x(), p.y(), p.z());
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid router cover\n";
}

inline std::string stl_binary(const TriMesh& mesh)
{
    std::string bytes = "solid, though it is binary";
    bytes.resize(80, ' ');
    append(bytes, uint32_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f) {
        bytes.append(12, '\0');
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
                append(bytes, float(mesh.position(i, mesh.triangle(k, f))));
        bytes.append(2, '\0');
    }
    return bytes;
}

inline std::string base64(const std::string& bytes)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string glb(std::string json, std::string binary)
{
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append(bytes, uint32_t(2));
    append(bytes, uint32_t(12 + 8 + json.size() + 8 + binary.size()));
    append(bytes, uint32_t(json.size()));
    bytes += "JSON" + json;
    append(bytes, uint32_t(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

/// A 2 x 1 strip in metres: a triangle list on the left (vertices 0 to 3), and a strip with
/// vertices of its own (4 to
/// 7) on the right, moved there by a node and mirrored in it.
struct GltfStrip {
    std::string binary, json;

    explicit GltfStrip(const std::string& buffer_uri = "", const std::string& extra = "")
    {
        // counter-clockwise
        for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
            append(binary, value);
        for (const uint16_t i : {0, 1, 2, 0, 2, 3})
            append(binary, i);
        for (const uint8_t i : {0, 1, 3, 2})
            append(binary, i);
        json = fmt::format(
            R"({{"asset":{{"version":"2.0"}},{}"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{{"children":[1,2]}},{{"mesh":0}},{{"mesh":1,"translation":[2,0,0],"scale":[-1,1,1]}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}},
                      {{"primitives":[{{"attributes":{{"POSITION":0}},"indices":2,"mode":5}}, {{"attributes":{{"POSITION":0}},"mode":1}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                         {{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}},
                         {{"bufferView":1,"byteOffset":12,"componentType":5121,"count":4,"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":16}}],
            "buffers":[{{"byteLength":64{}}}]}})",
            extra, buffer_uri.empty() ? "" : fmt::format(R"(,"uri":"{}")", buffer_uri));
    }
};

} // namespace spia::sample

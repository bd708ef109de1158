#include "tests/unit/exchange/sample_compressed.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <stdexcept>

#include "tests/unit/exchange/sample_meshes.h"

namespace spia::sample {
namespace {

template <class Bytes> std::string text_of(const Bytes& bytes)
{
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::string head(const std::string& extension, const std::string& node = "")
{
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["{0}"],"extensionsRequired":["{0}"],)"
                       R"("scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{1}}}],)",
                       extension, node);
}

} // namespace

std::string glb_by_meshopt(const TriMesh& mesh, bool fallback)
{
    const Eigen::Matrix3Xf position = mesh.position.cast<float>();
    const size_t vertices = size_t(mesh.vertices()), corners = 3 * size_t(mesh.triangles());
    std::vector<unsigned> index(corners);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            index[3 * size_t(f) + size_t(k)] = unsigned(mesh.triangle(k, f));
    std::vector<unsigned char> places(meshopt_encodeVertexBufferBound(vertices, 12));
    places.resize(meshopt_encodeVertexBuffer(places.data(), places.size(), position.data(), vertices, 12));
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(corners, vertices));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), index.data(), corners));
    std::string binary = text_of(places);
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const size_t second = binary.size();
    binary += text_of(triangles);

    const std::string name = "EXT_meshopt_compression";
    const auto view = [&](size_t offset, size_t length, size_t plain, size_t stride, size_t count, const char* mode) {
        return fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{},{}"extensions":{{"{}":{{"buffer":0,)"
                           R"("byteOffset":{},"byteLength":{},"byteStride":{},"count":{},"mode":"{}"}}}}}})",
                           fallback ? 1 : 0, 0, plain, stride == 12 ? R"("byteStride":12,)" : "", name, offset, length,
                           stride, count, mode);
    };
    const std::string stand_in = fallback
                                     ? fmt::format(R"(,{{"byteLength":{},"extensions":{{"{}":{{"fallback":true}}}}}})",
                                                   12 * vertices + 4 * corners, name)
                                     : "";
    return glb(head(name) +
                   fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
                               R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},)"
                               R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
                               R"("bufferViews":[{},{}],"buffers":[{{"byteLength":{}}}{}]}})",
                               vertices, corners, view(0, places.size(), 12 * vertices, 12, vertices, "ATTRIBUTES"),
                               view(second, triangles.size(), 4 * corners, 4, corners, "TRIANGLES"),
                               (binary.size() + 3) / 4 * 4, stand_in),
               binary);
}

std::string glb_by_draco(const TriMesh& mesh, int bits, bool mirrored)
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(mesh.triangles());
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Matrix3f corner = mesh.position(Eigen::all, mesh.triangle.col(f)).cast<float>();
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(std::uint32_t(f)), corner.col(0).data(),
                                          corner.col(1).data(), corner.col(2).data());
    }
    const auto built = builder.Finalize();
    draco::Encoder encoder;
    if (bits > 0)
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    const auto status = encoder.EncodeMeshToBuffer(*built, &buffer);
    if (!status.ok())
        throw std::runtime_error(status.error_msg_string());
    const std::string binary(buffer.data(), buffer.size()), name = "KHR_draco_mesh_compression";
    return glb(head(name, mirrored ? R"(,"scale":[-1,1,1])" : "") +
                   fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":)"
                               R"({{"{}":{{"bufferView":0,"attributes":{{"POSITION":{}}}}}}}}}]}}],)"
                               R"("accessors":[{{"componentType":5126,"count":{},"type":"VEC3"}},)"
                               R"({{"componentType":5125,"count":{},"type":"SCALAR"}}],)"
                               R"("bufferViews":[{{"buffer":0,"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}})",
                               name, built->attribute(position)->unique_id(), built->num_points(), 3 * mesh.triangles(),
                               binary.size(), (binary.size() + 3) / 4 * 4),
               binary);
}

} // namespace spia::sample

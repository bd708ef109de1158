#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace spia {

/// A buffer view that is compressed (EXT_meshopt_compression).
struct MeshoptView {
    int buffer = -1;                        ///< that holds the compressed bytes
    size_t offset = 0, length = 0;          ///< of them, bytes
    size_t count = 0, stride = 0;           ///< elements and bytes of each, as they are decoded
    std::string mode = {}, filter = "NONE"; ///< as the extension names them
};

/// A primitive that is compressed (KHR_draco_mesh_compression).
struct DracoPrimitive {
    int view = -1;     ///< the buffer view with all of it
    int position = -1; ///< the number of its attribute
};

/// What of a scene is compressed.
struct GltfCompression {
    std::map<int, MeshoptView> views;                         ///< by buffer view
    std::map<std::pair<int, int>, DracoPrimitive> primitives; ///< by mesh and primitive
};

/// Finds it. Buffers that only stand in for what is decoded get a byte of their own, so that they
/// need no file, and what is compressed with Draco loses its indices, whose accessor has no bytes.
/// @throws InputError for what cannot be decoded
GltfCompression take_compression(nlohmann::json& scene);

/// count x stride bytes. @throws InputError if the bytes are damaged
std::vector<unsigned char> decoded(const MeshoptView& view, std::span<const unsigned char> bytes);

struct DracoMesh {
    std::vector<Eigen::Vector3d> position;
    bool scaled = false; ///< whole numbers were divided by the greatest of their type
    std::vector<std::array<int, 3>> triangle;
};
/// @throws InputError if the bytes are damaged, or have no such attribute of three numbers
DracoMesh decoded_draco(std::span<const unsigned char> bytes, int position);

} // namespace spia

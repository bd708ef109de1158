#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// A bent or flanged part and, where there is one, its exact flat layout.
struct BentPart {
    TriMesh mesh;
    std::optional<Eigen::Matrix2Xd> flat = {}; ///< 2 by #V, mm: without strain; none: not
                                               ///< developable, or not known
    bool developable = false;                  ///< there is one, known or not
};

/// One of many parts that no single stroke would make, its measures drawn at random.
struct BentShape {
    std::string family;             ///< e.g. "hem"
    int number;                     ///< within the family, from 0
    std::function<BentPart()> make; ///< the same mesh at every call, turned at random

    std::string name() const { return family + " " + std::to_string(number); }
};

/// At least 30: hems, folded returns, spirals, boxes with lips, Z and hat sections, lipped
/// channels, double flanges with curved bend lines, hems on curved edges. @param triangles about
/// how many each has @param seed of all random numbers
std::vector<BentShape> bent_family(int triangles = 800, std::uint64_t seed = 1);

} // namespace spia::shapes

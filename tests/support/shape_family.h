#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// What has to come of a shape.
enum class Expected {
    blank,   ///< a flat blank without a flipped triangle
    refusal, ///< an InputError that says what to do
    either   ///< the one or the other, at random
};

/// One of many shapes that are awkward in one way, its measures drawn at random.
struct FamilyShape {
    std::string family; ///< e.g. "undercut"
    int number;         ///< within the family, from 0
    Expected expected;
    std::function<TriMesh()> make; ///< the same mesh at every call; not yet seen by the doctor
    bool keep_largest = false;     ///< the doctor is asked to

    std::string name() const { return family + " " + std::to_string(number); }
};

/// At least 200 shapes in about 25 families. @param triangles about how many each has @param seed
/// of all random numbers
std::vector<FamilyShape> shape_family(int triangles = 600, std::uint64_t seed = 1);

} // namespace spia::shapes

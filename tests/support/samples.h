#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// A part that `spia-samples` can write.
struct Sample {
    std::string name;
    std::string description;
    int small; ///< number of triangles that shows the part well in a small file
    std::function<TriMesh(int triangles)> make;
    bool is_sheet = true; ///< false: something that must be refused
};

/// Every sample, in the order of the list that the program shows.
const std::vector<Sample>& samples();

/// @throws InputError listing the names there are
const Sample& sample(const std::string& name);

} // namespace spia::shapes

#include "engine/forming/process/held_edges.h"

#include <array>
#include <map>
#include <set>
#include <utility>

#include "engine/mesh/topology.h"

namespace spia {

std::vector<HeldEdge> held_edges(const TriMesh& part)
{
    const std::vector<int> outline = boundary_loops(part).front();
    std::map<std::pair<int, int>, int> face_of; // of the outline's edges
    for (size_t k = 0; k < outline.size(); ++k)
        face_of[{outline[k], outline[(k + 1) % outline.size()]}] = -1;
    for (int f = 0; f < part.triangles(); ++f)
        for (int c = 0; c < 3; ++c)
            if (const auto edge = face_of.find({part.triangle(c, f), part.triangle((c + 1) % 3, f)});
                edge != face_of.end())
                edge->second = f;
    const auto key = [&](int a, int b) {
        std::array<double, 6> places;
        Eigen::Map<Eigen::Vector3d>(places.data()) = part.position.col(a);
        Eigen::Map<Eigen::Vector3d>(places.data() + 3) = part.position.col(b);
        return places;
    };
    std::set<std::array<double, 6>> sides;
    for (const auto& [ends, unused] : face_of)
        sides.insert(key(ends.first, ends.second));
    std::vector<HeldEdge> held;
    for (const auto& [ends, face] : face_of)
        if (!sides.contains(key(ends.second, ends.first)))
            held.push_back({ends.first, ends.second, face});
    return held;
}

} // namespace spia

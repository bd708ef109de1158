#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Distances over a surface from rows of vertices, by fronts that cross the triangles: the fast
/// marching method. [Kimmel and Sethian 1998] Its working arrays are kept between runs, so that a
/// run costs what it reaches.
class FrontMarch {
public:
    /// @param part must outlive it
    explicit FrontMarch(const TriMesh& part);

    /// Ends at the first vertex for which `stop` is 1. @param stop #V
    void run(const std::vector<int>& sources, const std::vector<char>& stop);

    /// mm; infinity where the last run did not get
    double distance(int v) const { return distance_[size_t(v)]; }
    const std::vector<int>& reached() const { return reached_; } ///< vertices with a distance
    /// mm, of the vertex that ended the run, or the last
    double end() const { return end_; }
    const TriMesh& part() const { return *part_; }

    /// Faces with a distance at each of their corners, each once.
    std::vector<int> crossed_faces() const;

private:
    const TriMesh* part_;
    std::vector<int> first_, face_; // faces around each vertex
    std::vector<double> distance_;
    std::vector<char> done_;
    std::vector<int> reached_;
    double end_ = 0;
};

} // namespace spia

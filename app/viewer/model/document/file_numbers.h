#pragma once
#include <algorithm>
#include <vector>

#include "engine/part/part_file.h"

namespace spia::viewer {

/// Faces of a part's file and their triangles. Triangles of one face follow each other.
class FaceNumbers {
public:
    explicit FaceNumbers(const PartFile& part) : source_(part.source_face) {}

    int face(int triangle) const { return source_[size_t(triangle)]; }
    int piece(int triangle) const { return triangle - first(face(triangle)); }
    /// -1 if there is none.
    int triangle(int face, int piece) const
    {
        const long found = long(first(face)) + piece;
        return piece >= 0 && found < long(source_.size()) && source_[size_t(found)] == face ? int(found) : -1;
    }

private:
    int first(int face) const { return int(std::lower_bound(source_.begin(), source_.end(), face) - source_.begin()); }

    const std::vector<int>& source_;
};

} // namespace spia::viewer

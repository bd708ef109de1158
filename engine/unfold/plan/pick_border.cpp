#include "engine/unfold/plan/pick_border.h"

namespace spia {

PickBorder pick_border(const TriMesh& part, const FaceSet& fixed, const FaceSet& freed)
{
    enum : char { nothing = 0, moves = 1, stays = 2 };
    std::vector<char> vertex(size_t(part.vertices()), nothing), picked(size_t(part.triangles()), nothing);
    for (const auto& [faces, role] : {std::pair(&fixed, stays), std::pair(&freed, moves)})
        for (const int f : *faces) {
            picked[size_t(f)] = 1;
            for (const int v : part.triangle.col(f))
                vertex[size_t(v)] |= role;
        }
    PickBorder border;
    for (int f = 0; f < part.triangles(); ++f) {
        if (picked[size_t(f)])
            continue;
        bool held = false, torn = false;
        for (const int v : part.triangle.col(f)) {
            held |= vertex[size_t(v)] == (moves | stays);
            torn |= vertex[size_t(v)] == moves;
        }
        if (torn)
            border.torn.push_back(f);
        else if (held)
            border.held.push_back(f);
    }
    return border;
}

} // namespace spia

#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <unordered_map>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/render/gl_objects.h"

namespace spia::viewer {

/// Ends of lines on the graphics card, ready to be drawn as quads.
struct LineBuffer {
    VertexArray array;
    Buffer ends;
    int lines = 0;
};

/// Its coarse picture, from the vertices of the mesh.
struct CoarseBuffer {
    VertexArray array;
    Buffer index, face;
    Texture face_of; ///< the face of the mesh, by number of the coarse triangle
    int indices = 0;
};

struct MeshBuffer {
    VertexArray array;
    Buffer position, normal, index;
    int indices = 0;
    Eigen::AlignedBox3d box;                 ///< mm, in space
    std::optional<LineBuffer> edge, feature; ///< made when they are first drawn
    std::optional<CoarseBuffer> coarse;      ///< likewise
};

/// A field or marks: a vertex attribute if there is one value per vertex, else a texture that is
/// read by number of face.
struct ValueBuffer {
    Buffer values;
    std::optional<Texture> by_face;
};

struct PointBuffer {
    VertexArray array;
    Buffer position;
    int points = 0;
    Eigen::AlignedBox3d box;
};

struct LooseLineBuffer {
    LineBuffer lines;
    Eigen::AlignedBox3d box;
};

/// What of the scenes lies on the graphics card. A thing is known by the object its shared pointer
/// holds, and forgotten when nobody holds it any more.
class Uploads {
public:
    /// Uploads what is not there yet. A field has one value per vertex or face of its mesh, marks
    /// one per face.
    /// @throws Error if these counts are wrong, or an index names a vertex that does not exist
    MeshBuffer& of(const std::shared_ptr<const SceneMesh>& mesh);
    ValueBuffer& of(const std::shared_ptr<const SceneField>& field, const SceneMesh& on);
    ValueBuffer& of(const std::shared_ptr<const FaceMarks>& marks, const SceneMesh& on);
    LooseLineBuffer& of(const std::shared_ptr<const SceneLines>& lines);
    PointBuffer& of(const std::shared_ptr<const ScenePoints>& points);

    void forget_unused();
    size_t count() const { return mesh_.size() + field_.size() + marks_.size() + lines_.size() + points_.size(); }

private:
    template <class Thing, class OnCard> struct Entry {
        std::weak_ptr<const Thing> thing; ///< keeps the address from being used again
        OnCard on_card;
    };
    template <class Thing, class OnCard> using Shelf = std::unordered_map<const Thing*, Entry<Thing, OnCard>>;

    Shelf<SceneMesh, MeshBuffer> mesh_;
    Shelf<SceneField, ValueBuffer> field_;
    Shelf<FaceMarks, ValueBuffer> marks_;
    Shelf<SceneLines, LooseLineBuffer> lines_;
    Shelf<ScenePoints, PointBuffer> points_;
};

/// @param about  so many triangles
CoarseBuffer upload_coarse(const SceneMesh& mesh, const MeshBuffer& fine, int about);

/// Pairs of positions, one instance per line. @param end 2 by #lines
LineBuffer upload_lines(const Eigen::Matrix3Xf& position, const Eigen::Matrix<uint32_t, 2, Eigen::Dynamic>& end);

} // namespace spia::viewer

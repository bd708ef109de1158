#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "app/viewer/render/renderer.h"
#include "tests/ui/hidden_window.h"

namespace spia::viewer {

inline constexpr int side = 200;   // pixels of the square pictures
inline constexpr double room = 10; // mm that they show: 20 pixels per mm, the origin in the middle
inline const Look plain{.dark = false, .gradient = false, .samples = 4};

inline Camera from_above()
{
    Camera camera;
    camera.height = room;
    return camera;
}

/// Triangles in a row of three corners each, facing +z where they are counter-clockwise.
inline std::shared_ptr<SceneMesh> triangles(const std::vector<Eigen::Vector3f>& corners)
{
    auto mesh = std::make_shared<SceneMesh>();
    const auto count = Eigen::Index(corners.size());
    mesh->position.resize(3, count);
    mesh->normal = Eigen::Matrix3Xf::Zero(3, count);
    mesh->triangle.resize(3, count / 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        mesh->position.col(i) = corners[size_t(i)];
        mesh->triangle(i % 3, i / 3) = uint32_t(i);
    }
    return mesh;
}

/// From left to right and bottom to top, mm; its lower left triangle first.
inline std::shared_ptr<SceneMesh> rectangle(float left, float bottom, float right, float top, float z = 0)
{
    return triangles(
        {{left, bottom, z}, {right, bottom, z}, {left, top, z}, {right, bottom, z}, {right, top, z}, {left, top, z}});
}

/// Not shaded, without lines: the picture has the colours that are asked for.
inline SceneLayer layer(std::shared_ptr<const SceneMesh> mesh, Colour colour = {1, 0, 0, 1})
{
    SceneLayer result;
    result.mesh = std::move(mesh);
    result.colour = colour;
    result.lit = false;
    result.features = false;
    return result;
}

inline Scene scene_of(std::vector<SceneLayer> layers)
{
    Scene scene;
    scene.layers = std::move(layers);
    return scene;
}

/// One value per vertex, a function of its place.
template <class Value> std::shared_ptr<SceneField> field_on(const SceneMesh& mesh, const Value& value)
{
    auto field = std::make_shared<SceneField>();
    field->value.resize(mesh.position.cols());
    for (Eigen::Index i = 0; i < mesh.position.cols(); ++i)
        field->value[i] = float(value(Eigen::Vector3f(mesh.position.col(i))));
    return field;
}

class Render : public testing::Test {
protected:
    Picture draw(const Scene& scene, const Camera& camera = from_above(), const Look& look = plain)
    {
        return renderer.picture(scene, camera, side, side, look);
    }
    HiddenWindow window;
    Renderer renderer;
};

} // namespace spia::viewer

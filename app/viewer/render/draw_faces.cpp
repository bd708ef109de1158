#include <algorithm>

#include "app/viewer/render/scene_drawer.h"
#include "app/viewer/views/colours.h"
#include "app/viewer/views/palette.h"

namespace spia::viewer {
namespace {

// Texture units. Samplers of different kinds must not share one, even unused.
constexpr int unit_map = 0, unit_values = 1, unit_marks = 2, unit_face = 3;

constexpr float ghost_push = 8; // of the lift of lines: a few pixels, or a hundredth of the part
} // namespace

bool SceneDrawer::is_coarse(const Pass& pass, const SceneLayer& layer)
{
    return pass.look.most_triangles > 0 && layer.mesh->triangle.cols() > pass.look.most_triangles;
}

void SceneDrawer::draw_faces(const Pass& pass, const SceneLayer& layer)
{
    MeshBuffer& mesh = uploads_.of(layer.mesh);
    const bool coarse = is_coarse(pass, layer);
    if (coarse && !mesh.coarse)
        mesh.coarse = upload_coarse(*layer.mesh, mesh, pass.look.most_triangles);
    ShaderProgram& shader = mesh_shader_;
    shader.use();
    place(shader, pass, layer.mesh->origin);
    // or it would show through what lies on it
    shader.set("push", transparent(layer) ? ghost_push * pass.lift : 0.f);
    shader.set("front", layer.colour);
    shader.set("back", Colour{layer.back[0], layer.back[1], layer.back[2], layer.colour[3]});
    shader.set("lit", layer.lit);
    shader.set("zebra", layer.zebra);
    shader.set("pixel", pass.look.content_scale);
    shader.set("corner", glm::vec2(pass.tile.corner));
    shader.set("map", unit_map);
    shader.set("face_value", unit_values);
    shader.set("face_mark", unit_marks);
    shader.set("face_of", unit_face);
    shader.set("coarse", coarse);
    if (coarse) {
        glActiveTexture(GL_TEXTURE0 + unit_face);
        glBindTexture(GL_TEXTURE_BUFFER, mesh.coarse->face_of);
    }
    shader.set("selected_colour", palette::selected);

    glBindVertexArray(coarse ? mesh.coarse->array : mesh.array);
    glDisableVertexAttribArray(2);
    shader.set("has_field", layer.field != nullptr);
    if (layer.field) {
        const ValueBuffer& field = uploads_.of(layer.field, *layer.mesh);
        shader.set("per_face", layer.field->per_face);
        shader.set("least", layer.scale.least);
        shader.set("greatest", layer.scale.greatest);
        shader.set("about_zero", layer.scale.map == ColourMap::diverging);
        shader.set("bands", layer.scale.bands);
        shader.set("ticks", std::max(1, layer.scale.ticks));
        shader.set("isolines", layer.scale.isolines);
        shader.set("no_value", no_value);
        glActiveTexture(GL_TEXTURE0 + unit_map);
        glBindTexture(GL_TEXTURE_1D, maps_[size_t(layer.scale.map)]);
        if (field.by_face) {
            glActiveTexture(GL_TEXTURE0 + unit_values);
            glBindTexture(GL_TEXTURE_BUFFER, *field.by_face);
        } else {
            glBindBuffer(GL_ARRAY_BUFFER, field.values);
            glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
            glEnableVertexAttribArray(2);
        }
    }
    shader.set("has_marks", layer.marks != nullptr);
    if (layer.marks) {
        std::vector<Colour> regions = pass.scene.region_colours;
        regions.resize(FaceMarks::region + 1, Colour{1, 1, 1, 1});
        shader.set("region_colour", regions);
        glActiveTexture(GL_TEXTURE0 + unit_marks);
        glBindTexture(GL_TEXTURE_BUFFER, *uploads_.of(layer.marks, *layer.mesh).by_face);
    }
    glDrawElements(GL_TRIANGLES, coarse ? mesh.coarse->indices : mesh.indices, GL_UNSIGNED_INT, nullptr);
}

} // namespace spia::viewer

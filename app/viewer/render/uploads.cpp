#include "app/viewer/render/uploads.h"

#include <fmt/core.h>

#include "app/viewer/render/coarse_mesh.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

template <class Matrix> void fill(const Buffer& buffer, GLenum target, const Matrix& values)
{
    glBindBuffer(target, buffer);
    glBufferData(target, GLsizeiptr(sizeof(*values.data())) * GLsizeiptr(values.size()), values.data(), GL_STATIC_DRAW);
}

Eigen::AlignedBox3d box_of(const Eigen::Matrix3Xf& position, const Eigen::Vector3d& origin)
{
    Eigen::AlignedBox3d box;
    if (position.cols() > 0)
        box = {position.rowwise().minCoeff().cast<double>() + origin,
               position.rowwise().maxCoeff().cast<double>() + origin};
    return box;
}

void require_indices(uint32_t greatest, Eigen::Index vertices, const char* what)
{
    if (greatest >= vertices)
        throw Error(fmt::format("the {} of a scene name vertex {} of {}; this is a fault of SPIA, please report it",
                                what, greatest, vertices));
}

void require_count(Eigen::Index count, Eigen::Index wanted, const char* what)
{
    if (count != wanted)
        throw Error(
            fmt::format("{} of a scene have {} values for a mesh that needs {}; this is a fault of SPIA, please "
                        "report it",
                        what, count, wanted));
}

/// Of the mesh, for the vertex array that is bound.
void take_vertices(const MeshBuffer& mesh)
{
    GLuint number = 0;
    for (const Buffer* const buffer : {&mesh.position, &mesh.normal}) {
        glBindBuffer(GL_ARRAY_BUFFER, *buffer);
        glVertexAttribPointer(number, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        glEnableVertexAttribArray(number++);
    }
}

MeshBuffer upload(const SceneMesh& mesh)
{
    if (mesh.triangle.size() > 0)
        require_indices(mesh.triangle.maxCoeff(), mesh.position.cols(), "triangles");
    require_count(mesh.normal.cols(), mesh.position.cols(), "the normals");
    MeshBuffer result;
    glBindVertexArray(result.array);
    fill(result.position, GL_ARRAY_BUFFER, mesh.position);
    fill(result.normal, GL_ARRAY_BUFFER, mesh.normal);
    take_vertices(result);
    fill(result.index, GL_ELEMENT_ARRAY_BUFFER, mesh.triangle);
    glBindVertexArray(0);
    result.indices = int(mesh.triangle.size());
    result.box = box_of(mesh.position, mesh.origin);
    return result;
}

/// @param point 3 by 2 #lines
LineBuffer upload_pairs(const Eigen::Matrix3Xf& point)
{
    LineBuffer result;
    glBindVertexArray(result.array);
    fill(result.ends, GL_ARRAY_BUFFER, point);
    for (GLuint end = 0; end < 2; ++end) {
        const size_t start = end * 3 * sizeof(float);
        glVertexAttribPointer(end, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float), reinterpret_cast<const void*>(start));
        glEnableVertexAttribArray(end);
        glVertexAttribDivisor(end, 1);
    }
    glBindVertexArray(0);
    result.lines = int(point.cols() / 2);
    return result;
}

PointBuffer upload(const ScenePoints& points)
{
    PointBuffer result;
    glBindVertexArray(result.array);
    fill(result.position, GL_ARRAY_BUFFER, points.point);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(0);
    glVertexAttribDivisor(0, 1);
    glBindVertexArray(0);
    result.points = int(points.point.cols());
    result.box = box_of(points.point, points.origin);
    return result;
}

/// A texture of as many texels as the buffer has values.
template <class Values> ValueBuffer upload_by_face(const Values& values, GLenum format)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (values.size() > decltype(values.size())(most))
        throw Error(
            fmt::format("this graphics card takes at most {} values per face, the part has {} faces; show the field "
                        "smooth instead, or draw in software with LIBGL_ALWAYS_SOFTWARE=1",
                        most, values.size()));
    ValueBuffer result;
    fill(result.values, GL_TEXTURE_BUFFER, values);
    result.by_face.emplace();
    glBindTexture(GL_TEXTURE_BUFFER, *result.by_face);
    glTexBuffer(GL_TEXTURE_BUFFER, format, result.values);
    return result;
}

ValueBuffer upload(const SceneField& field)
{
    if (field.per_face)
        return upload_by_face(field.value, GL_R32F);
    ValueBuffer result;
    fill(result.values, GL_ARRAY_BUFFER, field.value);
    return result;
}

/// What a shelf has for a thing; if it has nothing, what `make` makes of it.
template <class Shelf, class Thing, class Make>
auto& find_or(Shelf& shelf, const std::shared_ptr<Thing>& thing, const Make& make)
{
    auto found = shelf.find(thing.get());
    // another object at the address of a former one
    if (found != shelf.end() && found->second.thing.expired()) {
        shelf.erase(found);
        found = shelf.end();
    }
    if (found == shelf.end()) {
        found = shelf.emplace(thing.get(), typename Shelf::mapped_type{thing, make()}).first;
        check_gl("copying a scene to the graphics card");
    }
    return found->second.on_card;
}

} // namespace

LineBuffer upload_lines(const Eigen::Matrix3Xf& position, const Eigen::Matrix<uint32_t, 2, Eigen::Dynamic>& end)
{
    if (end.size() > 0)
        require_indices(end.maxCoeff(), position.cols(), "lines");
    Eigen::Matrix3Xf point(3, end.size());
    for (Eigen::Index i = 0; i < end.size(); ++i)
        point.col(i) = position.col(end.data()[i]);
    return upload_pairs(point);
}

CoarseBuffer upload_coarse(const SceneMesh& mesh, const MeshBuffer& fine, int about)
{
    const CoarseMesh coarse = coarse_mesh(mesh, about);
    CoarseBuffer result;
    glBindVertexArray(result.array);
    take_vertices(fine);
    fill(result.index, GL_ELEMENT_ARRAY_BUFFER, coarse.triangle);
    glBindVertexArray(0);
    fill(result.face, GL_TEXTURE_BUFFER, coarse.face);
    glBindTexture(GL_TEXTURE_BUFFER, result.face_of);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_R32UI, result.face);
    result.indices = int(coarse.triangle.size());
    return result;
}

MeshBuffer& Uploads::of(const std::shared_ptr<const SceneMesh>& mesh)
{
    return find_or(mesh_, mesh, [&] { return upload(*mesh); });
}

ValueBuffer& Uploads::of(const std::shared_ptr<const SceneField>& field, const SceneMesh& on)
{
    require_count(field->value.size(), field->per_face ? on.triangle.cols() : on.position.cols(), "the fields");
    return find_or(field_, field, [&] { return upload(*field); });
}

ValueBuffer& Uploads::of(const std::shared_ptr<const FaceMarks>& marks, const SceneMesh& on)
{
    require_count(Eigen::Index(marks->mark.size()), on.triangle.cols(), "the marks");
    return find_or(marks_, marks, [&] { return upload_by_face(marks->mark, GL_R8UI); });
}

LooseLineBuffer& Uploads::of(const std::shared_ptr<const SceneLines>& lines)
{
    return find_or(lines_, lines, [&] {
        return LooseLineBuffer{upload_pairs(lines->point), box_of(lines->point, lines->origin)};
    });
}

PointBuffer& Uploads::of(const std::shared_ptr<const ScenePoints>& points)
{
    return find_or(points_, points, [&] { return upload(*points); });
}

void Uploads::forget_unused()
{
    const auto unused = [](const auto& item) { return item.second.thing.expired(); };
    std::erase_if(mesh_, unused);
    std::erase_if(field_, unused);
    std::erase_if(marks_, unused);
    std::erase_if(lines_, unused);
    std::erase_if(points_, unused);
}

} // namespace spia::viewer

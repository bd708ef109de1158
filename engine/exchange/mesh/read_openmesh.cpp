#include "engine/exchange/mesh/read_openmesh.h"

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <cmath>
#include <fmt/core.h>
#include <mutex>
#include <sstream>

#include "engine/core/error.h"

namespace spia {
namespace {

using namespace OpenMesh;

/// Takes vertices and faces as they come. A half-edge mesh would lose faces here that the doctor
/// has to see.
class SoupImporter : public IO::BaseImporter {
public:
    PolygonSoup soup;

    VertexHandle add_vertex(const Vec3f& p) override
    {
        soup.position.emplace_back(p[0], p[1], p[2]);
        return VertexHandle(soup.vertices() - 1);
    }
    VertexHandle add_vertex(const Vec3d& p) override
    {
        soup.position.emplace_back(p[0], p[1], p[2]);
        return VertexHandle(soup.vertices() - 1);
    }
    VertexHandle add_vertex() override { return add_vertex(Vec3d(0, 0, 0)); }
    void set_point(VertexHandle v, const Vec3f& p) override { soup.position.at(size_t(v.idx())) = {p[0], p[1], p[2]}; }
    FaceHandle add_face(const VHandles& corners) override
    {
        for (const VertexHandle v : corners)
            soup.corner.push_back(v.idx());
        soup.first.push_back(int(soup.corner.size()));
        return FaceHandle(soup.polygons() - 1);
    }
    size_t n_vertices() const override { return size_t(soup.vertices()); }
    size_t n_faces() const override { return size_t(soup.polygons()); }
    size_t n_edges() const override { return 0; }

    // Half-edges, normals, colours and textures are of no use here.
    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>&) override {}
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_normal(VertexHandle, const Vec3f&) override {}
    void set_normal(VertexHandle, const Vec3d&) override {}
    void set_normal(FaceHandle, const Vec3f&) override {}
    void set_normal(FaceHandle, const Vec3d&) override {}
    void set_color(VertexHandle, const Vec3uc&) override {}
    void set_color(VertexHandle, const Vec4uc&) override {}
    void set_color(VertexHandle, const Vec3f&) override {}
    void set_color(VertexHandle, const Vec4f&) override {}
    void set_color(EdgeHandle, const Vec3uc&) override {}
    void set_color(EdgeHandle, const Vec4uc&) override {}
    void set_color(EdgeHandle, const Vec3f&) override {}
    void set_color(EdgeHandle, const Vec4f&) override {}
    void set_color(FaceHandle, const Vec3uc&) override {}
    void set_color(FaceHandle, const Vec4uc&) override {}
    void set_color(FaceHandle, const Vec3f&) override {}
    void set_color(FaceHandle, const Vec4f&) override {}
    void set_texcoord(VertexHandle, const Vec2f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
    void set_texcoord(VertexHandle, const Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
    void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
    void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}
};

PolygonSoup run_openmesh(const CheckedFile& file)
{
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    std::istringstream stream(file.content, std::ios::in | std::ios::binary);
    IO::Options options = file.binary ? IO::Options::Binary : IO::Options::Default;
    SoupImporter importer;
    if (!IO::IOManager().read(stream, file.extension, importer, options))
        throw InputError("OpenMesh cannot read it");
    return std::move(importer.soup);
}

/// Replaces coordinates that went through single precision by those of the file.
void restore_precision(const CheckedFile& file, PolygonSoup& soup)
{
    if (file.position.empty())
        return;
    if (file.position.size() != soup.position.size())
        throw InputError(fmt::format("OpenMesh reads {} of {} vertices", soup.vertices(), file.position.size()));
    constexpr double rounding = 1e-6, dust = 1e-37; // single precision, and where it ends
    for (size_t v = 0; v < soup.position.size(); ++v) {
        const Eigen::Vector3d &exact = file.position[v], &read = soup.position[v];
        if (((exact - read).cwiseAbs().array() > rounding * exact.cwiseAbs().array() + dust).any())
            throw InputError(fmt::format("OpenMesh reads vertex {} as {}, {}, {} instead of {}, {}, {}", v, read.x(),
                                         read.y(), read.z(), exact.x(), exact.y(), exact.z()));
    }
    soup.position = file.position;
}

PolygonSoup with_faces_set_aside(const CheckedFile& file, PolygonSoup&& read)
{
    if (read.polygons() + int(file.aside.size()) != file.faces)
        throw InputError(
            fmt::format("OpenMesh reads {} of {} faces", read.polygons(), file.faces - int(file.aside.size())));
    if (file.aside.empty())
        return std::move(read);
    PolygonSoup result;
    result.position = std::move(read.position);
    auto aside = file.aside.begin();
    for (int f = 0, next = 0; f < file.faces; ++f)
        if (aside != file.aside.end() && aside->first == f)
            result.add_polygon((aside++)->second);
        else
            result.add_polygon(read.polygon(next++));
    return result;
}

} // namespace

PolygonSoup read_openmesh(const CheckedFile& file)
{
    PolygonSoup soup = run_openmesh(file);
    restore_precision(file, soup);
    return with_faces_set_aside(file, std::move(soup));
}

} // namespace spia

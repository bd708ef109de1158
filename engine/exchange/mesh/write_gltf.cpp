#include "engine/exchange/mesh/write_gltf.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/core.h>
#include <sstream>
#include <tiny_gltf.h>

#include "engine/core/atomic_file.h"
#include "engine/core/colour_map.h"
#include "engine/core/error.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

using tinygltf::Value;

Value numbers(std::initializer_list<double> values)
{
    Value::Array array;
    for (const double value : values)
        array.emplace_back(value);
    return Value(array);
}

/// The one buffer and the accessors into it.
class GltfBuffer {
public:
    explicit GltfBuffer(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

    /// One column per vertex, rounded to float32; the bounds are those of the rounded numbers.
    int vertices(const Eigen::MatrixXf& columns)
    {
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = columns.rows() == 1 ? TINYGLTF_TYPE_SCALAR : TINYGLTF_TYPE_VEC3;
        for (int row = 0; row < columns.rows(); ++row) {
            accessor.minValues.push_back(columns.row(row).minCoeff());
            accessor.maxValues.push_back(columns.row(row).maxCoeff());
        }
        return add(accessor, columns.data(), size_t(columns.size()) * 4, size_t(columns.cols()),
                   TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    int indices(const Eigen::MatrixXi& columns)
    {
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        return add(accessor, columns.data(), size_t(columns.size()) * 4, size_t(columns.size()),
                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    }

private:
    int add(tinygltf::Accessor& accessor, const void* bytes, size_t size, size_t count, int target)
    {
        std::vector<unsigned char>& buffer = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.size(); // every element has 4 bytes, so offsets stay aligned
        view.byteLength = size;
        view.target = target;
        buffer.resize(buffer.size() + size);
        std::memcpy(buffer.data() + view.byteOffset, bytes, size);
        accessor.bufferView = int(model_.bufferViews.size());
        accessor.count = count;
        model_.bufferViews.push_back(view);
        model_.accessors.push_back(accessor);
        return int(model_.accessors.size()) - 1;
    }

    tinygltf::Model& model_;
};

/// Unit length in float32; where faces cancel there is no normal, and any direction shades as badly
/// as another.
Eigen::MatrixXf unit(const Eigen::Matrix3Xd& normals)
{
    Eigen::MatrixXf result(3, normals.cols());
    for (int v = 0; v < normals.cols(); ++v)
        result.col(v) =
            (normals.col(v).norm() > 0.5 ? normals.col(v).normalized() : Eigen::Vector3d(0, 0, 1)).cast<float>();
    return result;
}

Eigen::Vector3d whole_centre(const Eigen::Matrix3Xd& points)
{
    return (0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff())).array().round();
}

int material(tinygltf::Model& model, const std::string& name, const Eigen::Vector3d& srgb)
{
    const Eigen::Vector3d rgb = linear_rgb(srgb);
    tinygltf::Material result;
    result.name = name;
    result.doubleSided = true;
    result.pbrMetallicRoughness.baseColorFactor = {rgb.x(), rgb.y(), rgb.z(), 1};
    result.pbrMetallicRoughness.metallicFactor = 0;
    result.pbrMetallicRoughness.roughnessFactor = 0.7;
    model.materials.push_back(result);
    return int(model.materials.size()) - 1;
}

class SceneWriter {
public:
    SceneWriter(const ExportScene& scene, const GltfNodes& wanted)
        : scene_(scene), wanted_(wanted), range_(colour_range(scene.fields->thinning)),
          centre_(whole_centre(scene.part->position))
    {
    }

    tinygltf::Model model()
    {
        add_root();
        if (wanted_.part || wanted_.blank)
            add_part_and_blank();
        if (scene_.quad_mesh && wanted_.quad_mesh)
            add_quad_mesh(*scene_.quad_mesh);
        if (scene_.surface && wanted_.surface)
            add_surface(*scene_.surface);
        if (!scene_.control_nets.empty() && wanted_.control_net)
            add_control_nets(scene_.control_nets);
        return std::move(model_);
    }

private:
    Value::Object colour_extras() const
    {
        return {{"field", Value(std::string("thinning"))},
                {"colour_map", Value(std::string("viridis"))},
                {"range", numbers({range_.least, range_.greatest})}};
    }

    void add_root()
    {
        model_.asset.version = "2.0";
        model_.asset.generator = program_name();
        Value::Object extras = colour_extras();
        extras["part"] = Value(scene_.name);
        extras["units"] = Value(std::string("vertices and thickness in mm below the root node, which scales to metres; "
                                            "thinning and logarithmic strains without unit"));
        if (scene_.zones) {
            Value::Object names;
            for (const Zone zone : all_zones)
                names[std::to_string(int(zone))] = Value(std::string(name(zone)));
            extras["zones"] = Value(names);
        }
        model_.asset.extras = Value(extras);
        tinygltf::Node root;
        root.name = scene_.name.empty() ? "chain" : scene_.name;
        root.scale = {0.001, 0.001, 0.001};
        root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}; // Z up to Y up
        model_.nodes.push_back(root);
        tinygltf::Scene all;
        all.name = root.name;
        all.nodes = {0};
        model_.scenes.push_back(all);
        model_.defaultScene = 0;
    }

    void add_node(tinygltf::Mesh mesh, const Eigen::Vector3d& translation, const Value& extras = {})
    {
        tinygltf::Node node;
        node.name = mesh.name;
        node.mesh = int(model_.meshes.size());
        node.translation = {translation.x(), translation.y(), translation.z()};
        node.extras = extras;
        model_.nodes[0].children.push_back(int(model_.nodes.size()));
        model_.nodes.push_back(node);
        model_.meshes.push_back(std::move(mesh));
    }

    static tinygltf::Primitive primitive(int mode, int indices, std::map<std::string, int> attributes, int material)
    {
        tinygltf::Primitive result;
        result.mode = mode;
        result.indices = indices;
        result.attributes = std::move(attributes);
        result.material = material;
        return result;
    }

    int points(const Eigen::Matrix3Xd& position)
    {
        return buffer_.vertices((position.colwise() - centre_).cast<float>());
    }

    void add_part_and_blank()
    {
        const TriMesh& part = *scene_.part;
        const int count = part.vertices();
        std::map<std::string, int> shared; // both show the same values on the same triangles
        for (const NamedField& field : forming_fields(*scene_.fields)) {
            std::string name = "_" + field.name;
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return char(std::toupper(c)); });
            shared[name] = buffer_.vertices(field.value->transpose().cast<float>());
        }
        if (scene_.zones) {
            const auto zone = zones_at_vertices(part, scene_.zones->zone);
            Eigen::MatrixXf number(1, count);
            for (int v = 0; v < count; ++v)
                number(0, v) = float(zone[size_t(v)]);
            shared["_ZONE"] = buffer_.vertices(number);
        }
        Eigen::MatrixXf colour(3, count);
        for (int v = 0; v < count; ++v)
            colour.col(v) = linear_rgb(viridis(range_.position(scene_.fields->thinning[v]))).cast<float>();
        shared["COLOR_0"] = buffer_.vertices(colour);
        const int faces = buffer_.indices(part.triangle);
        // white: the vertex colours show as they are
        const int sheet = material(model_, "sheet", {1, 1, 1});

        if (wanted_.part)
            add_part(shared, faces, sheet);
        if (wanted_.blank)
            add_blank(shared, faces, sheet);
    }

    void add_part(std::map<std::string, int> attributes, int faces, int sheet)
    {
        const TriMesh& part = *scene_.part;
        attributes["POSITION"] = points(part.position);
        attributes["NORMAL"] = buffer_.vertices(unit(vertex_normals(part)));
        tinygltf::Mesh mesh;
        mesh.name = "part";
        mesh.extras = Value(colour_extras());
        mesh.primitives = {primitive(TINYGLTF_MODE_TRIANGLES, faces, attributes, sheet)};
        add_node(mesh, centre_);
    }

    void add_blank(std::map<std::string, int> attributes, int faces, int sheet)
    {
        const TriMesh& part = *scene_.part;
        const int count = part.vertices();
        Eigen::Matrix3Xd flat = Eigen::Matrix3Xd::Zero(3, count);
        flat.topRows(2) = scene_.blank->position;
        const Eigen::Vector3d origin = whole_centre(flat);
        attributes["POSITION"] = buffer_.vertices((flat.colwise() - origin).cast<float>());
        Eigen::MatrixXf up = Eigen::MatrixXf::Zero(3, count);
        up.row(2).setOnes();
        attributes["NORMAL"] = buffer_.vertices(up);
        tinygltf::Mesh mesh;
        mesh.name = "blank";
        mesh.extras = Value(colour_extras());
        mesh.primitives = {primitive(TINYGLTF_MODE_TRIANGLES, faces, attributes, sheet)};
        const Eigen::Vector3d low = part.position.rowwise().minCoeff(), high = part.position.rowwise().maxCoeff();
        const double gap = 0.1 * (high - low).norm();
        const Eigen::Vector3d place(high.x() + gap + (origin.x() - flat.row(0).minCoeff()), centre_.y(), low.z());
        add_node(mesh, place, Value(Value::Object{{"blank_origin_mm", numbers({origin.x(), origin.y()})}}));
    }

    void add_quad_mesh(const QuadGrid& grid)
    {
        const TriMesh mesh_of_cells = triangles_of(grid);
        const int position = points(grid.position);
        const int normal = buffer_.vertices(unit(vertex_normals(mesh_of_cells)));
        tinygltf::Mesh mesh;
        mesh.name = "quad_mesh";
        mesh.extras = Value(Value::Object{{"columns", Value(grid.columns)}, {"rows", Value(grid.rows)}});
        mesh.primitives = {primitive(TINYGLTF_MODE_TRIANGLES, buffer_.indices(mesh_of_cells.triangle),
                                     {{"POSITION", position}, {"NORMAL", normal}},
                                     material(model_, "quads", {0.86, 0.87, 0.88})),
                           primitive(TINYGLTF_MODE_LINE, buffer_.indices(net_lines(grid.columns + 1, grid.rows + 1)),
                                     {{"POSITION", position}}, material(model_, "quad edges", {0.12, 0.2, 0.32}))};
        add_node(mesh, centre_);
    }

    void add_surface(const TriMesh& surface)
    {
        const Eigen::Matrix3Xd normal = scene_.surface_normal ? *scene_.surface_normal : vertex_normals(surface);
        tinygltf::Mesh mesh;
        mesh.name = "surface";
        mesh.primitives = {
            primitive(TINYGLTF_MODE_TRIANGLES, buffer_.indices(surface.triangle),
                      {{"POSITION", points(surface.position)}, {"NORMAL", buffer_.vertices(unit(normal))}},
                      material(model_, "surface", {0.55, 0.69, 0.83}))};
        add_node(mesh, centre_);
    }

    void add_control_nets(std::span<const NurbsSurface> nets)
    {
        tinygltf::Mesh mesh;
        mesh.name = "control_net";
        const int red = material(model_, "control net", {0.78, 0.2, 0.12});
        for (const NurbsSurface& net : nets) {
            mesh.primitives.push_back(primitive(TINYGLTF_MODE_LINE,
                                                buffer_.indices(net_lines(net.count_u, net.count_v)),
                                                {{"POSITION", points(net.control)}}, red));
            mesh.primitives.back().extras = Value(Value::Object{{"count_u", Value(net.count_u)},
                                                                {"count_v", Value(net.count_v)},
                                                                {"degree_u", Value(net.degree_u)},
                                                                {"degree_v", Value(net.degree_v)}});
        }
        if (nets.size() == 1)
            mesh.extras = mesh.primitives.front().extras;
        add_node(mesh, centre_);
    }

    const ExportScene& scene_;
    const GltfNodes wanted_;
    const ColourRange range_;      // of thinning
    const Eigen::Vector3d centre_; // mm, of the part
    tinygltf::Model model_;
    GltfBuffer buffer_{model_};
};

} // namespace

void write_gltf(const std::filesystem::path& path, const ExportScene& scene, const GltfNodes& nodes)
{
    require_complete(scene);
    tinygltf::Model model = SceneWriter(scene, nodes).model();
    if (model.meshes.empty())
        throw InputError(
            fmt::format("there is nothing to write to {}: choose a node that the result has", path.string()));
    tinygltf::TinyGLTF writer;
    std::ostringstream stream;
    const bool binary = path.extension() != ".gltf";
    if (!writer.WriteGltfSceneToStream(&model, stream, !binary, binary))
        throw ExchangeError(fmt::format("cannot write {}: tinygltf makes no file of the scene", path.string()));
    write_atomically(path, stream.view());
}

} // namespace spia

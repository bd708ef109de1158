#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <map>
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include "engine/core/colour_map.h"
#include "engine/core/error.h"
#include "engine/exchange/mesh/write_gltf.h"
#include "tests/support/known_surfaces.h"
#include "tests/unit/exchange/sample_chain.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::gltf_test {
namespace {

tinygltf::Model read(const std::filesystem::path& path)
{
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    const bool good = path.extension() == ".gltf" ? reader.LoadASCIIFromFile(&model, &error, &warning, path)
                                                  : reader.LoadBinaryFromFile(&model, &error, &warning, path);
    EXPECT_TRUE(good) << error;
    EXPECT_EQ(error + warning, "");
    return model;
}

const tinygltf::Node& node(const tinygltf::Model& model, const std::string& name)
{
    for (const tinygltf::Node& candidate : model.nodes)
        if (candidate.name == name)
            return candidate;
    throw std::runtime_error("no node " + name);
}

const tinygltf::Mesh& mesh(const tinygltf::Model& model, const std::string& name)
{
    return model.meshes.at(size_t(node(model, name).mesh));
}

template <class Number> Eigen::Matrix<Number, -1, -1> values(const tinygltf::Model& model, int index)
{
    const tinygltf::Accessor& accessor = model.accessors.at(size_t(index));
    const tinygltf::BufferView& view = model.bufferViews.at(size_t(accessor.bufferView));
    const int rows = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    const auto* first =
        reinterpret_cast<const Number*>(model.buffers[0].data.data() + view.byteOffset + accessor.byteOffset);
    return Eigen::Map<const Eigen::Matrix<Number, -1, -1>>(first, rows, Eigen::Index(accessor.count));
}

Eigen::MatrixXf attribute(const tinygltf::Model& model, const std::string& mesh_name, const std::string& attribute)
{
    return values<float>(model, mesh(model, mesh_name).primitives.at(0).attributes.at(attribute));
}

/// Where a vertex of a node stands in the file's metres, Y up.
Eigen::Vector3d in_metres(const tinygltf::Model& model, const tinygltf::Node& child, const Eigen::Vector3f& vertex)
{
    const tinygltf::Node& root = model.nodes.at(size_t(model.scenes.at(0).nodes.at(0)));
    const Eigen::Quaterniond turn(root.rotation[3], root.rotation[0], root.rotation[1], root.rotation[2]);
    const Eigen::Vector3d shift(child.translation[0], child.translation[1], child.translation[2]);
    return turn * (root.scale[0] * (vertex.cast<double>() + shift));
}

} // namespace

class Gltf : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, Gltf, ::testing::Values("chain.glb", "chain.gltf"),
                         [](const auto& name) { return std::string(name.param).substr(6); });

TEST_P(Gltf, FieldsOnPartAndBlankAreTheNodeFieldsInFloat)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_gltf(folder / GetParam(), chain.scene());
    const tinygltf::Model model = read(folder / GetParam());
    const std::map<std::string, const Eigen::VectorXd*> expected{{"_THICKNESS", &chain.node.thickness},
                                                                 {"_THINNING", &chain.node.thinning},
                                                                 {"_STRAIN_MAJOR", &chain.node.strain_major},
                                                                 {"_STRAIN_MINOR", &chain.node.strain_minor},
                                                                 {"_STRAIN_EQUIVALENT", &chain.node.strain_equivalent}};
    for (const char* name : {"part", "blank"})
        for (const auto& [field, value] : expected)
            EXPECT_EQ(attribute(model, name, field), value->cast<float>().transpose()) << name << field;
    for (const char* name : {"part", "blank"}) {
        const auto& primitive = mesh(model, name).primitives.at(0);
        const auto faces = values<unsigned>(model, primitive.indices);
        ASSERT_EQ(faces.size(), chain.part.triangle.size());
        EXPECT_TRUE(std::equal(faces.data(), faces.data() + faces.size(), chain.part.triangle.data())) << name;
    }
}

TEST_P(Gltf, VerticesCarryTheWorstZoneAroundThem)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const FormingLimitCurve curve = curve_through({-0.5, 0.1}, {0.15, 0.15}, false, "sample");
    Zones judged = zones(chain.part, chain.face, &curve);
    ExportScene scene = chain.scene();
    scene.zones = &judged;
    write_gltf(folder / GetParam(), scene);
    const tinygltf::Model model = read(folder / GetParam());
    for (const char* name : {"part", "blank"}) {
        const Eigen::MatrixXf number = attribute(model, name, "_ZONE");
        Eigen::MatrixXf expected = Eigen::MatrixXf::Zero(1, chain.part.vertices());
        for (int f = 0; f < chain.part.triangles(); ++f)
            for (const int v : chain.part.triangle.col(f))
                expected(0, v) = std::max(expected(0, v), float(judged.zone[size_t(f)]));
        EXPECT_EQ(number, expected);
        EXPECT_LT(number.minCoeff(), number.maxCoeff());
    }
    EXPECT_EQ(model.asset.extras.Get("zones").Get("7").Get<std::string>(), "crack");
    judged.zone.pop_back();
    EXPECT_THROW(write_gltf(folder / GetParam(), scene), InputError);
}

TEST_P(Gltf, HoldsOnlyTheNodesThatAreWanted)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    const auto names = [&](const GltfNodes& wanted) {
        write_gltf(folder / GetParam(), chain.scene(), wanted);
        const tinygltf::Model model = read(folder / GetParam());
        std::vector<std::string> result;
        for (const int child : model.nodes.at(0).children)
            result.push_back(model.nodes.at(size_t(child)).name);
        EXPECT_EQ(model.meshes.size(), result.size());
        for (const tinygltf::Mesh& each : model.meshes) // nothing is in the file that no mesh needs
            EXPECT_LT(size_t(each.primitives.back().indices), model.accessors.size());
        return result;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names({}), (Names{"part", "blank", "quad_mesh", "surface", "control_net"}));
    EXPECT_EQ(names({true, false, false, false, false}), Names{"part"});
    EXPECT_EQ(names({false, true, false, false, false}), Names{"blank"});
    EXPECT_EQ(names({false, false, true, false, false}), Names{"quad_mesh"});
    EXPECT_EQ(names({false, false, false, true, false}), Names{"surface"});
    EXPECT_EQ(names({false, true, false, false, true}), (Names{"blank", "control_net"}));
    EXPECT_THROW(write_gltf(folder / "none.glb", chain.scene(), {false, false, false, false, false}), InputError);
}

TEST_P(Gltf, EveryShapeStandsWhereItIsInMetresWithYUp)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_gltf(folder / GetParam(), chain.scene());
    const tinygltf::Model model = read(folder / GetParam());
    const auto expect_at = [&](const char* name, const Eigen::Matrix3Xd& position) {
        const Eigen::MatrixXf vertices = attribute(model, name, "POSITION");
        ASSERT_EQ(vertices.cols(), position.cols()) << name;
        for (int v = 0; v < position.cols(); ++v) {
            const Eigen::Vector3d p = 0.001 * position.col(v), y_up(p.x(), p.z(), -p.y());
            // float32 about the centre: 24 bits of some 250 mm
            EXPECT_LT((in_metres(model, node(model, name), vertices.col(v)) - y_up).norm(), 250e-3 * 0x1p-23)
                << name << v;
        }
    };
    expect_at("part", chain.part.position);
    expect_at("quad_mesh", chain.quads.position);
    expect_at("surface", chain.surface.position);
    expect_at("control_net", chain.net.control);

    // The blank: flat, beside the part with a gap, its own coordinates recoverable.
    const Eigen::MatrixXf flat = attribute(model, "blank", "POSITION");
    EXPECT_EQ(flat.row(2).cwiseAbs().maxCoeff(), 0);
    const tinygltf::Node& blank = node(model, "blank");
    const auto origin = blank.extras.Get("blank_origin_mm");
    for (int v = 0; v < flat.cols(); ++v) {
        EXPECT_NEAR(flat(0, v) + origin.Get(0).GetNumberAsDouble(), chain.blank.position(0, v), 250 * 0x1p-23);
        EXPECT_NEAR(flat(1, v) + origin.Get(1).GetNumberAsDouble(), chain.blank.position(1, v), 250 * 0x1p-23);
    }
    EXPECT_GT(flat.row(0).minCoeff() + blank.translation[0], chain.part.position.row(0).maxCoeff() + 10);
    EXPECT_NEAR(blank.translation[2], chain.part.position.row(2).minCoeff(), 1e-9);
}

TEST_P(Gltf, LinesAndTrianglesJoinTheRightNeighbours)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_gltf(folder / GetParam(), chain.scene());
    const tinygltf::Model model = read(folder / GetParam());
    const auto& net = mesh(model, "control_net").primitives.at(0);
    EXPECT_EQ(net.mode, TINYGLTF_MODE_LINE);
    const auto ends = values<unsigned>(model, net.indices);
    ASSERT_EQ(ends.size(), 2 * (8 * 7 + 9 * 6));
    for (int l = 0; l < ends.size() / 2; ++l) {
        const int a = int(ends.data()[2 * l]), b = int(ends.data()[2 * l + 1]);
        // neighbours in a net of 9 x 7
        EXPECT_EQ(std::abs(a % 9 - b % 9) + std::abs(a / 9 - b / 9), 1);
    }
    EXPECT_EQ(mesh(model, "control_net").primitives.size(), 1u);
    EXPECT_EQ(mesh(model, "control_net").extras.Get("count_u").GetNumberAsInt(), 9);
    ASSERT_EQ(mesh(model, "quad_mesh").primitives.size(), 2u);
    EXPECT_EQ(model.accessors[size_t(mesh(model, "quad_mesh").primitives[0].indices)].count, size_t(3 * 2 * 8 * 6));
    EXPECT_EQ(mesh(model, "quad_mesh").extras.Get("columns").GetNumberAsInt(), 8);
}

TEST_P(Gltf, HasTheNetOfEveryPatch)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    ExportScene scene = chain.scene();
    std::vector<NurbsSurface> patches = {chain.net, surfaces::bilinear({0, 0, 0}, {9, 0, 0}, {0, 5, 1}, {9, 5, 2})};
    scene.control_nets = patches;
    write_gltf(folder / GetParam(), scene);
    const tinygltf::Model model = read(folder / GetParam());
    const auto& nets = mesh(model, "control_net").primitives;
    ASSERT_EQ(nets.size(), 2u);
    for (size_t p = 0; p < 2; ++p) {
        EXPECT_EQ(nets[p].mode, TINYGLTF_MODE_LINE);
        EXPECT_EQ(nets[p].extras.Get("count_u").GetNumberAsInt(), patches[p].count_u);
        EXPECT_EQ(nets[p].extras.Get("degree_v").GetNumberAsInt(), patches[p].degree_v);
        EXPECT_EQ(model.accessors[size_t(nets[p].attributes.at("POSITION"))].count, size_t(patches[p].control.cols()));
    }
    // the sides of the second one
    EXPECT_EQ(values<unsigned>(model, nets[1].indices).size(), 2 * 4);
    const auto place = values<float>(model, nets[1].attributes.at("POSITION"));
    const Eigen::Vector3d last = in_metres(model, node(model, "control_net"), Eigen::Vector3f(place.data() + 9));
    // float32, 2 m from the centre
    EXPECT_LT((last - Eigen::Vector3d(9e-3, 2e-3, -5e-3)).norm(), 5e-7);
    patches[1].control(0, 0) = std::nan("");
    EXPECT_THROW(write_gltf(folder / GetParam(), scene), InputError);
}

TEST_P(Gltf, ColoursAreThinningInTheMapAndRangeNamedInExtras)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    write_gltf(folder / GetParam(), chain.scene());
    const tinygltf::Model model = read(folder / GetParam());
    for (const tinygltf::Value& extras :
         {model.asset.extras, mesh(model, "part").extras, mesh(model, "blank").extras}) {
        EXPECT_EQ(extras.Get("field").Get<std::string>(), "thinning");
        EXPECT_EQ(extras.Get("colour_map").Get<std::string>(), "viridis");
        EXPECT_EQ(extras.Get("range").Get(0).GetNumberAsDouble(), chain.node.thinning.minCoeff());
        EXPECT_EQ(extras.Get("range").Get(1).GetNumberAsDouble(), chain.node.thinning.maxCoeff());
    }
    EXPECT_EQ(model.asset.extras.Get("part").Get<std::string>(), "left door");
    const Eigen::MatrixXf colour = attribute(model, "part", "COLOR_0");
    Eigen::Index least, greatest;
    chain.node.thinning.minCoeff(&least);
    chain.node.thinning.maxCoeff(&greatest);
    // the ends of viridis, #440154 and #FDE725, in linear light
    EXPECT_LT((colour.col(least) - Eigen::Vector3f(0.05781f, 0.000304f, 0.08866f)).norm(), 1e-4f);
    EXPECT_LT((colour.col(greatest) - Eigen::Vector3f(0.98225f, 0.79910f, 0.01850f)).norm(), 1e-4f);
}

TEST_P(Gltf, BoundsAreExactAndNormalsHaveUnitLength)
{
    const ScratchFolder folder;
    write_gltf(folder / GetParam(), samples::chain().scene());
    const tinygltf::Model model = read(folder / GetParam());
    for (size_t i = 0; i < model.accessors.size(); ++i) {
        if (model.accessors[i].componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            continue;
        const Eigen::MatrixXf all = values<float>(model, int(i));
        for (int row = 0; row < all.rows(); ++row) {
            EXPECT_EQ(model.accessors[i].minValues.at(size_t(row)), all.row(row).minCoeff());
            EXPECT_EQ(model.accessors[i].maxValues.at(size_t(row)), all.row(row).maxCoeff());
        }
    }
    for (const char* name : {"part", "blank", "quad_mesh", "surface"})
        EXPECT_LT((attribute(model, name, "NORMAL").colwise().norm().array() - 1).abs().maxCoeff(), 1e-6) << name;
}

TEST_P(Gltf, SameSceneGivesTheSameBytesAndNothingOnStdout)
{
    const ScratchFolder folder;
    const samples::Chain chain = samples::chain();
    testing::internal::CaptureStdout();
    write_gltf(folder / GetParam(), chain.scene());
    const std::string first = content_of(folder / GetParam());
    write_gltf(folder / GetParam(), chain.scene());
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(content_of(folder / GetParam()), first);
}

TEST_P(Gltf, WhatIsMissingIsLeftOutAndWhatIsWrongIsRefused)
{
    const ScratchFolder folder;
    samples::Chain chain = samples::chain();
    ExportScene scene = chain.scene();
    scene.quad_mesh = nullptr;
    scene.surface = nullptr;
    scene.control_nets = {};
    write_gltf(folder / GetParam(), scene);
    EXPECT_EQ(read(folder / GetParam()).nodes.size(), 3u); // root, part, blank
    std::filesystem::remove(folder / GetParam());

    EXPECT_THROW(write_gltf(folder / "no/such/folder.glb", scene), ExchangeError);
    chain.node.strain_minor[5] = std::nan("");
    EXPECT_THROW(write_gltf(folder / GetParam(), scene), InputError);
    scene.fields = nullptr;
    EXPECT_THROW(write_gltf(folder / GetParam(), scene), InputError);
    EXPECT_TRUE(folder.names().empty());
}

TEST(ColourMap, LightnessRisesEvenlyFromEndToEnd)
{
    // CIE lightness of the relative luminance, so that equal steps of the value look like equal
    // steps
    const auto lightness = [](double t) {
        const double y = Eigen::Vector3d(0.2126, 0.7152, 0.0722).dot(linear_rgb(viridis(t)));
        return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
    };
    const double even = (lightness(1) - lightness(0)) / 8;
    for (int i = 0; i < 8; ++i)
        EXPECT_NEAR(lightness((i + 1) / 8.0) - lightness(i / 8.0), even, 0.15 * even) << i;
    EXPECT_EQ(viridis(-1), viridis(0));
    EXPECT_EQ(viridis(2), viridis(1));
}

} // namespace spia::gltf_test

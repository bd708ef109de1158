#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/exchange/iga/mfem_topology.h"
#include "engine/exchange/iga/write_geopdes.h"
#include "engine/exchange/iga/write_gismo.h"
#include "engine/exchange/iga/write_iga_dyna.h"
#include "engine/exchange/iga/write_mfem.h"
#include "tests/support/iga_readers.h"
#include "tests/support/joined_patches.h"
#include "tests/support/known_surfaces.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::iga_test {
namespace {

/// The same joint, whichever side is named first.
bool holds(const std::vector<PatchInterface>& all, const PatchInterface& wanted)
{
    return std::any_of(all.begin(), all.end(), [&](const PatchInterface& i) {
        return i == wanted || i == PatchInterface{wanted.second, wanted.first, wanted.reversed};
    });
}

void expect_same_joints(const iga::Content& read, const MultiPatch& written)
{
    EXPECT_EQ(read.patches.interfaces.size(), written.interfaces.size());
    for (const PatchInterface& joint : written.interfaces)
        EXPECT_TRUE(holds(read.patches.interfaces, joint)) << name(joint.first) << ", " << name(joint.second);
    EXPECT_EQ(read.outer, outer_sides(written));
}

void expect_same_basis(const NurbsSurface& read, const NurbsSurface& written)
{
    EXPECT_EQ(read.degree_u, written.degree_u);
    EXPECT_EQ(read.degree_v, written.degree_v);
    EXPECT_EQ(read.knots_u, written.knots_u);
    EXPECT_EQ(read.knots_v, written.knots_v);
    EXPECT_EQ(read.weight, written.weight);
}

void expect_same_patches(const iga::Content& read, const MultiPatch& written)
{
    ASSERT_EQ(read.patches.patch.size(), written.patch.size());
    for (size_t p = 0; p < written.patch.size(); ++p) {
        expect_same_basis(read.patches.patch[p], written.patch[p]);
        EXPECT_EQ(read.patches.patch[p].control, written.patch[p].control);
    }
}

PatchField thickness_of(const MultiPatch& patches)
{
    PatchField field{"thickness", "mm", {}};
    for (const NurbsSurface& patch : patches.patch) // a function of the place, so that neighbours
                                                    // agree
        field.value.push_back(0.8 + 0.1 * (patch.control.colwise().sum().transpose().array() / 77).sin());
    return field;
}

class Iga : public testing::TestWithParam<patches::Sample> {};

TEST_P(Iga, GismoComesBackBitForBit)
{
    const MultiPatch& patches = GetParam().patches;
    const ScratchFolder folder;
    write_gismo(folder / "a.xml", patches);
    const iga::Content read = iga::read_gismo(folder / "a.xml");
    expect_same_patches(read, patches);
    expect_same_joints(read, patches);
    EXPECT_NO_THROW(require_watertight(read.patches));
    const std::string text = content_of(folder / "a.xml");
    const bool any_rational = std::any_of(patches.patch.begin(), patches.patch.end(),
                                          [](const NurbsSurface& s) { return !s.weight.isOnes(0); });
    EXPECT_EQ(text.find("TensorNurbs2") != text.npos, any_rational);

    const PatchField field = thickness_of(patches);
    write_gismo_field(folder / "t.xml", patches, field);
    const iga::Content values = iga::read_gismo(folder / "t.xml");
    EXPECT_EQ(values.values, field.value);
    expect_same_joints(values, patches);
    for (size_t p = 0; p < patches.patch.size(); ++p)
        expect_same_basis(values.patches.patch[p], patches.patch[p]);
}

TEST_P(Iga, MfemComesBackBitForBit)
{
    const MultiPatch& patches = GetParam().patches;
    const ScratchFolder folder;
    write_mfem(folder / "a.mesh", patches);
    // asks what MFEM asks of edges and knot vectors
    const iga::Content read = iga::read_mfem(folder / "a.mesh");
    expect_same_patches(read, patches);
    expect_same_joints(read, patches);
    const PatchField field = thickness_of(patches);
    write_mfem_field(folder / "a.gf", patches, field);
    EXPECT_EQ(iga::read_mfem_field(folder / "a.gf", patches), field.value);
}

TEST_P(Iga, GeopdesComesBackBitForBitAsProducts)
{
    const MultiPatch& patches = GetParam().patches;
    const ScratchFolder folder;
    write_geopdes(folder / "a.txt", patches);
    const iga::Content read = iga::read_geopdes(folder / "a.txt");
    expect_same_joints(read, patches);
    ASSERT_EQ(read.points.size(), patches.patch.size());
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        const NurbsSurface& s = patches.patch[p];
        expect_same_basis(read.patches.patch[p], s);
        EXPECT_EQ(read.points[p].topRows<3>(), (s.control.array().rowwise() * s.weight.transpose().array()).matrix());
    }
    MultiPatch divided = read.patches; // the same products and weights on both sides
    EXPECT_NO_THROW(require_watertight(divided));
}

TEST_P(Iga, LsDynaComesBackToTheDigitsOfItsColumns)
{
    const MultiPatch& patches = GetParam().patches;
    const ScratchFolder folder;
    std::vector<double> thickness;
    for (size_t p = 0; p < patches.patch.size(); ++p)
        thickness.push_back(0.75 + 0.05 * double(p));
    Material steel;
    steel.young_MPa = 206000;
    steel.poisson = 0.3;
    steel.density_kg_m3 = 7850;
    write_iga_dyna(folder / "a.k", patches, thickness, steel);
    const iga::Content read = iga::read_dyna(folder / "a.k");
    ASSERT_EQ(read.patches.patch.size(), patches.patch.size());
    EXPECT_EQ(read.thickness, thickness);
    const auto near = [](double a, double b) { return std::abs(a - b) <= 5e-13 * std::abs(b); };
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        const NurbsSurface &a = read.patches.patch[p], &b = patches.patch[p];
        EXPECT_EQ(a.degree_u, b.degree_u);
        EXPECT_EQ(a.degree_v, b.degree_v);
        EXPECT_TRUE(std::equal(a.knots_u.begin(), a.knots_u.end(), b.knots_u.begin(), b.knots_u.end(), near));
        EXPECT_TRUE(std::equal(a.knots_v.begin(), a.knots_v.end(), b.knots_v.begin(), b.knots_v.end(), near));
        for (Eigen::Index c = 0; c < b.control.size(); ++c)
            EXPECT_TRUE(near(a.control.data()[c], b.control.data()[c]));
        for (Eigen::Index c = 0; c < b.weight.size(); ++c)
            EXPECT_TRUE(near(a.weight[c], b.weight[c]));
    }
    // What is shared is shared in the file: equal numbers give equal fields.
    for (const PatchInterface& joint : patches.interfaces) {
        const NurbsSurface &a = read.patches.patch[size_t(joint.first.patch)],
                           &b = read.patches.patch[size_t(joint.second.patch)];
        std::vector<int> i = side_controls(a, joint.first.side), j = side_controls(b, joint.second.side);
        if (joint.reversed)
            std::reverse(j.begin(), j.end());
        for (size_t k = 0; k < i.size(); ++k)
            EXPECT_EQ(a.control.col(i[k]), b.control.col(j[k]));
    }
    std::istringstream lines(content_of(folder / "a.k"));
    for (std::string line; std::getline(lines, line);)
        EXPECT_TRUE(line[0] == '$' || line.size() <= 80) << line;
}

INSTANTIATE_TEST_SUITE_P(Every, Iga, testing::ValuesIn(patches::samples()), [](const auto& parameter) {
    std::string name = parameter.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

MultiPatch sample(const std::string& name)
{
    for (const patches::Sample& each : patches::samples())
        if (each.name == name)
            return each.patches;
    throw std::out_of_range(name);
}

TEST(IgaFiles, AreInTheUnitAskedForAndStayShared)
{
    const MultiPatch patches = sample("rational two reversed");
    const ScratchFolder folder;
    const auto expect_inches = [&](const iga::Content& read) {
        for (size_t p = 0; p < 2; ++p) {
            EXPECT_LT((read.patches.patch[p].control - patches.patch[p].control / 25.4).norm(), 1e-12);
            EXPECT_EQ(read.patches.patch[p].weight, patches.patch[p].weight);
        }
        EXPECT_NO_THROW(require_watertight(read.patches));
    };
    write_gismo(folder / "a.xml", patches, "a", LengthUnit::inch);
    expect_inches(iga::read_gismo(folder / "a.xml"));
    EXPECT_NE(content_of(folder / "a.xml").find("lengths inch"), std::string::npos);
    write_mfem(folder / "a.mesh", patches, "a", LengthUnit::inch);
    expect_inches(iga::read_mfem(folder / "a.mesh"));
    write_geopdes(folder / "a.txt", patches, "a", LengthUnit::inch);
    expect_inches(iga::read_geopdes(folder / "a.txt"));
    PatchField field = thickness_of(patches);
    write_mfem_field(folder / "t.gf", patches, field, "a", LengthUnit::inch);
    EXPECT_LT((iga::read_mfem_field(folder / "t.gf", patches)[1] - field.value[1] / 25.4).norm(), 1e-15);
    field.unit = "1"; // a strain has no unit of length
    write_mfem_field(folder / "t.gf", patches, field, "a", LengthUnit::inch);
    EXPECT_EQ(iga::read_mfem_field(folder / "t.gf", patches)[1], field.value[1]);
    // Newton, metre, second: Pa and kg/m3; in mm MPa and t/mm3.
    Material steel;
    steel.young_MPa = 206000;
    steel.poisson = 0.3;
    steel.density_kg_m3 = 7850;
    write_iga_dyna(folder / "m.k", patches, {0.8, 0.8}, steel, "a", LengthUnit::m);
    EXPECT_NE(content_of(folder / "m.k").find("         1    7850.0 2.060E+11       0.3"), std::string::npos)
        << content_of(folder / "m.k").substr(content_of(folder / "m.k").find("*MAT"));
    EXPECT_NEAR(iga::read_dyna(folder / "m.k").thickness[0], 0.0008, 1e-12);
    write_iga_dyna(folder / "mm.k", patches, {0.8, 0.8}, steel);
    EXPECT_NE(content_of(folder / "mm.k").find("         1  7.85E-09  206000.0       0.3"), std::string::npos)
        << content_of(folder / "mm.k").substr(content_of(folder / "mm.k").find("*MAT"));
}

TEST(IgaFiles, TakeAnyName)
{
    const MultiPatch patches = sample("polynomial two");
    const ScratchFolder folder;
    for (const std::string& name :
         {std::string("--><Geometry type=\"x\"> & -- ---"), std::string("a\n2 3 1 0 0\r\npatches\nb"),
          std::string("*END\n*END"), std::string("\xff\xfe\0x", 4), std::string(5000, '-'),
          std::string(118, 'x') + "\xc3\xa4\xc3\xa4"}) {
        SCOPED_TRACE(name);
        write_gismo(folder / "a.xml", patches, name);
        expect_same_patches(iga::read_gismo(folder / "a.xml"), patches);
        write_gismo_field(folder / "t.xml", patches, thickness_of(patches), name);
        EXPECT_EQ(iga::read_gismo(folder / "t.xml").values.size(), 2u);
        write_mfem(folder / "a.mesh", patches, name);
        expect_same_patches(iga::read_mfem(folder / "a.mesh"), patches);
        write_mfem_field(folder / "t.gf", patches, thickness_of(patches), name);
        EXPECT_EQ(iga::read_mfem_field(folder / "t.gf", patches).size(), 2u);
        write_geopdes(folder / "a.txt", patches, name);
        expect_same_joints(iga::read_geopdes(folder / "a.txt"), patches);
        Material steel;
        steel.young_MPa = 206000;
        steel.density_kg_m3 = 7850;
        write_iga_dyna(folder / "a.k", patches, {1, 1}, steel, name);
        EXPECT_EQ(iga::read_dyna(folder / "a.k").patches.patch.size(), 2u);
    }
}

template <class Write> std::string refusal(const Write& write)
{
    try {
        write();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(IgaFiles, RefuseWhatIsNoSurfaceAndLeaveNothing)
{
    const ScratchFolder folder;
    const auto each_refuses = [&](const MultiPatch& patches, const char* what) {
        Material steel;
        for (const std::string& text :
             {refusal([&] { write_gismo(folder / "a", patches); }), refusal([&] { write_mfem(folder / "a", patches); }),
              refusal([&] { write_geopdes(folder / "a", patches); }), refusal([&] {
                  write_iga_dyna(folder / "a", patches, {1, 1}, steel);
              })})
            EXPECT_NE(text.find(what), std::string::npos) << text;
        EXPECT_TRUE(folder.names().empty());
    };
    each_refuses({}, "no surface");
    MultiPatch bad = sample("rational two");
    bad.patch[1].weight[3] = 0;
    each_refuses(bad, "positive weight");
    bad = sample("rational two");
    bad.patch[0].control(1, 3) = std::nan("");
    each_refuses(bad, "finite point");
    bad = sample("rational two");
    bad.interfaces[0].reversed = true;
    each_refuses(bad, "not the same curve");
    const MultiPatch good = sample("rational two");
    PatchField field = thickness_of(good);
    field.value[1][3] = std::nan("");
    EXPECT_NE(refusal([&] { write_gismo_field(folder / "a", good, field); }).find("thickness"), std::string::npos);
    EXPECT_NE(refusal([&] { write_mfem_field(folder / "a", good, field); }).find("thickness"), std::string::npos);
    EXPECT_NE(refusal([&] { write_iga_dyna(folder / "a", good, {1, 0}, {}); }).find("not positive"), std::string::npos);
    EXPECT_NE(refusal([&] { write_iga_dyna(folder / "a", good, {1}, {}); }).find("1 thicknesses"), std::string::npos);
    EXPECT_TRUE(folder.names().empty());
    EXPECT_THROW(write_gismo(folder / "no" / "a", good), ExchangeError);
}

/// A ring of patches between two circles, nearly; with an odd number of twists a strip that is its
/// own back.
MultiPatch ring(int patches, int twists)
{
    std::vector<NurbsSurface> all;
    const auto place = [&](int k, bool outer) {
        const int turned = k == patches ? twists % 2 : 0;
        const double angle = 6.283185307179586 * (k % patches) / patches, radius = outer != bool(turned) ? 60 : 40;
        return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0);
    };
    for (int k = 0; k < patches; ++k) {
        NurbsSurface s = surfaces::one_span(2, 1);
        const double middle = 6.283185307179586 * (k + 0.5) / patches;
        for (int j = 0; j < 2; ++j) {
            s.control.col(s.index(0, j)) = place(k, j == 1);
            s.control.col(s.index(1, j)) << (70 + 20 * j) * std::cos(middle), (70 + 20 * j) * std::sin(middle), 0;
            s.control.col(s.index(2, j)) = place(k + 1, j == 1);
        }
        all.push_back(s);
    }
    return joined(all);
}

TEST(IgaFiles, MfemRefusesWhatItsMeshesCannotSay)
{
    const ScratchFolder folder;
    write_mfem(folder / "ring.mesh", ring(3, 0));
    expect_same_joints(iga::read_mfem(folder / "ring.mesh"), ring(3, 0));
    EXPECT_NE(refusal([&] { write_mfem(folder / "a", ring(3, 1)); }).find("other way round"), std::string::npos);
    EXPECT_NE(refusal([&] { write_mfem(folder / "a", ring(2, 0)); }).find("same two corners"), std::string::npos);
    EXPECT_NE(refusal([&] { write_mfem_field(folder / "a", ring(2, 0), thickness_of(ring(2, 0))); }).find("corners"),
              std::string::npos);
    NurbsSurface tube = patches::curved(100, false);
    const std::vector<int> begin = side_controls(tube, Side::v0), end = side_controls(tube, Side::v1);
    for (size_t k = 0; k < begin.size(); ++k)
        tube.control.col(end[k]) = tube.control.col(begin[k]);
    EXPECT_NE(refusal([&] { write_mfem(folder / "a", joined({tube})); }).find("closed in itself"), std::string::npos);
    // G+Smo and GeoPDEs can.
    for (const MultiPatch& patches : {ring(3, 1), ring(2, 0), joined({tube})}) {
        write_gismo(folder / "a.xml", patches);
        expect_same_joints(iga::read_gismo(folder / "a.xml"), patches);
        write_geopdes(folder / "a.txt", patches);
        expect_same_joints(iga::read_geopdes(folder / "a.txt"), patches);
    }
}

TEST(IgaFiles, MfemCountsCornersAndEdgesOnce)
{
    const MultiPatch five = sample("polynomial five around a corner");
    const MfemTopology topology = mfem_topology(five);
    EXPECT_EQ(topology.corners, 11);       // the middle, five spokes, five outer corners
    EXPECT_EQ(topology.edges.size(), 15u); // 5 spokes and 10 outer edges
    EXPECT_EQ(std::max_element(topology.edges.begin(), topology.edges.end(),
                               [](const auto& a, const auto& b) { return a.knots < b.knots; })
                  ->knots,
              4); // one strip per spoke
}

} // namespace
} // namespace spia::iga_test

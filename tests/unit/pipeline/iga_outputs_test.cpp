#include "engine/pipeline/outputs/iga_outputs.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "engine/coons/carry_field.h"
#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/nurbs/project.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "tests/support/iga_readers.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::iga_outputs_test {
namespace {

Session finished(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.grid.cells = 24;
    return completed(run_chain(std::move(session)));
}

TEST(IgaOutputs, HoldTheSurfaceOfTheChainBitForBit)
{
    const ScratchFolder folder;
    const Session session = finished("square-cup.obj");
    const auto files = write_outputs(session, folder / "out", iga_formats());
    EXPECT_EQ(files, output_files(session, folder / "out", iga_formats()));
    std::set<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
        names.insert(file.path().filename().string());
    EXPECT_EQ(names, (std::set<std::string>{"square-cup-gismo.xml", "square-cup-gismo-thickness.xml",
                                            "square-cup-gismo-plastic_strain.xml", "square-cup-mfem.mesh",
                                            "square-cup-mfem-thickness.gf", "square-cup-mfem-plastic_strain.gf",
                                            "square-cup-geopdes.txt", "square-cup-iga.k"}));
    const NurbsSurface& surface = session.surface->result.surface;
    const auto expect_surface = [&](const iga::Content& read) {
        ASSERT_EQ(read.patches.patch.size(), 1u);
        EXPECT_EQ(read.patches.patch[0].knots_u, surface.knots_u);
        EXPECT_EQ(read.patches.patch[0].knots_v, surface.knots_v);
        EXPECT_EQ(read.patches.patch[0].control, surface.control);
        EXPECT_EQ(read.outer.size(), 4u);
    };
    const auto out = folder / "out";
    expect_surface(iga::read_gismo(out / "square-cup-gismo.xml"));
    expect_surface(iga::read_mfem(out / "square-cup-mfem.mesh"));
    expect_surface(iga::read_geopdes(out / "square-cup-geopdes.txt"));

    // Thickness and strain at the nodes are those of the blank, carried to the nodes of the lifted
    // grid.
    const auto fields = surface_fields(session);
    EXPECT_EQ(iga::read_gismo(out / "square-cup-gismo-thickness.xml").values, fields[0].value);
    EXPECT_EQ(iga::read_gismo(out / "square-cup-gismo-plastic_strain.xml").values, fields[1].value);
    EXPECT_EQ(iga::read_mfem_field(out / "square-cup-mfem-thickness.gf", surface_patches(session)), fields[0].value);
    EXPECT_EQ(iga::read_mfem_field(out / "square-cup-mfem-plastic_strain.gf", surface_patches(session)),
              fields[1].value);
    const SheetFields& sheet = session.blank->node;
    const auto& fitted = session.surface->result;
    for (const auto& [field, values] :
         {std::pair{&fields[0], &sheet.thickness}, {&fields[1], &sheet.strain_equivalent}}) {
        const Eigen::VectorXd nodes = carry_field(*session.grid->result.filled, *values, session.lifted->place);
        EXPECT_GT(nodes.maxCoeff(), nodes.minCoeff() + 0.01);
        for (size_t j = 0; j < fitted.v.size(); ++j)
            for (size_t i = 0; i < fitted.u.size(); ++i)
                EXPECT_NEAR(evaluate_field(surface, field->value[0], fitted.u[i], fitted.v[j]),
                            nodes[Eigen::Index(i + j * fitted.u.size())], 1e-12);
    }
    const double mean = iga::read_dyna(out / "square-cup-iga.k").thickness.at(0);
    EXPECT_NEAR(mean, field_mean(surface, fields[0].value[0]), 1e-7);
    EXPECT_GT(mean, sheet.thickness.minCoeff());
    EXPECT_LT(mean, sheet.thickness.maxCoeff());
}

/// Within a tolerance the surface has data of its own: what the field says at the foot of a vertex
/// of the part is still what the vertex has.
TEST(IgaOutputs, FieldsOfASurfaceWithinAToleranceAreThoseOfThePart)
{
    Session session = finished("dome.obj");
    for (const FitParameters parameters : {FitParameters::blank, FitParameters::corrected}) {
        session.options.tolerance = 0.5;
        session.options.fit_parameters = parameters;
        session = run_stage(Stage::fit, std::move(session));
        ASSERT_TRUE(session.surface->fit && session.surface->fit->reached);
        const NurbsSurface& surface = session.surface->result.surface;
        const PatchField thickness = surface_fields(session).at(0);
        const Eigen::VectorXd& at_vertex = session.blank->node.thickness;
        const double range = at_vertex.maxCoeff() - at_vertex.minCoeff();
        const SurfaceProjection projection(surface);
        double sum = 0;
        for (int v = 0; v < at_vertex.size(); ++v) {
            const SurfaceFoot foot = projection.nearest(session.part->mesh.position.col(v));
            const double off = evaluate_field(surface, thickness.value[0], foot.u, foot.v) - at_vertex[v];
            sum += off * off;
        }
        EXPECT_LT(std::sqrt(sum / double(at_vertex.size())), 0.05 * range) << "of the least squares field";
    }
}

TEST(IgaOutputs, GoOverHolesOfThePart)
{
    const ScratchFolder folder;
    const Session session = finished("perforated-channel.obj");
    ASSERT_GT(session.grid->result.filled->holes, 0);
    const SheetFields& sheet = session.blank->node;
    const Eigen::VectorXd nodes = carry_field(*session.grid->result.filled, sheet.thickness, session.lifted->place);
    EXPECT_GE(nodes.minCoeff(), sheet.thickness.minCoeff() - 1e-12);
    EXPECT_LE(nodes.maxCoeff(), sheet.thickness.maxCoeff() + 1e-12);
    EXPECT_EQ(write_outputs(session, folder / "out", {"gismo"}).size(), 3u);
}

TEST(IgaOutputs, AreLeftOutWithoutASurface)
{
    const ScratchFolder folder;
    Session session = finished("dome.obj");
    OutputOptions options;
    options.name = "lid";
    options.unit = LengthUnit::m;
    EXPECT_EQ(write_outputs(session, folder / "out", {"geopdes", "iga-k"}, options),
              (std::vector<std::filesystem::path>{folder / "out" / "lid-geopdes.txt", folder / "out" / "lid-iga.k"}));
    EXPECT_NE(content_of(folder / "out" / "lid-iga.k").find("lengths m,"), std::string::npos);
    EXPECT_LT((iga::read_geopdes(folder / "out" / "lid-geopdes.txt").patches.patch[0].control -
               session.surface->result.surface.control / 1000)
                  .norm(),
              1e-12);
    EXPECT_THROW(require_place(session, folder / "new", {"mfem"}, {folder / "new" / "dome-mfem.mesh"}), ExchangeError);
    session.surface.reset();
    EXPECT_TRUE(write_outputs(session, folder / "none", iga_formats()).empty());
}

} // namespace
} // namespace spia::iga_outputs_test

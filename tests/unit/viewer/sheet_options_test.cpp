// What is chosen of the sheet besides its grade and thickness: a seam, the strains of the skins, a
// material of a tensile test.
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/project_file.h"
#include "engine/forming/material/material_library.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_file.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;

constexpr double radius = 25, height = 120; // mm
constexpr int around = 40, rows = 20;

struct SheetOptions : ModelFixture {
    ScratchFolder folder;

    std::string last_error() const
    {
        for (auto message = state.messages.rbegin(); message != state.messages.rend(); ++message)
            if (message->severity == Severity::error)
                return message->text;
        return "";
    }
    void open_tube()
    {
        shapes::write_mesh(folder / "tube.obj", shapes::pipe(radius, radius, height, around, rows));
        model.apply(OpenPart{folder / "tube.obj", ""});
        wait();
        ASSERT_NE(document.session.part, nullptr) << last_error();
    }
    Project saved_and_opened()
    {
        save_project(folder / "a.spia", document, state.view);
        return open_project(folder / "a.spia", assets / "materials");
    }
};

} // namespace

TEST_F(SheetOptions, ADrawnSeamCutsTheTubeThereAndUndoCutsItAsBefore)
{
    open_tube();
    const auto automatic = document.session.part->seam;
    ASSERT_EQ(automatic.size(), 1u);
    // From one end to the other on the far side: rows of the pipe follow each other.
    const int opposite = (automatic[0].front() % around + around / 2) % around;
    const SeamOptions seam{SeamOptions::Mode::given, {{opposite, opposite + rows * around}}};
    model.apply(SetSeam{seam});
    wait();
    ASSERT_EQ(last_error(), "");
    ASSERT_EQ(document.session.part->seam.size(), 1u);
    EXPECT_EQ(document.session.part->seam[0].size(), size_t(rows + 1));
    for (const int vertex : document.session.part->seam[0])
        EXPECT_EQ(vertex % around, opposite);
    EXPECT_EQ(first_stale(document), Stage::solve);
    EXPECT_EQ(saved_and_opened().document.session.options.read.seam, seam);
    model.apply(Undo{});
    EXPECT_EQ(document.session.part->seam, automatic);
    EXPECT_EQ(document.session.options.read.seam, SeamOptions{});
}

TEST_F(SheetOptions, RemeshingIsUndoneAndKeptInProjects)
{
    open_tube();
    const int given = document.session.part->mesh.triangles();
    RemeshOptions remesh;
    remesh.size = height / 6;
    model.apply(SetRemeshing{remesh});
    wait();
    ASSERT_EQ(last_error(), "");
    ASSERT_TRUE(document.session.part->remeshed);
    EXPECT_EQ(document.session.part->remeshed->size, height / 6);
    EXPECT_EQ(document.session.part->remeshed->original->triangles(), given);
    const int remeshed = document.session.part->mesh.triangles();
    EXPECT_NE(remeshed, given);
    EXPECT_EQ(saved_and_opened().document.session.options.read.remesh, remesh);
    model.apply(SetRemeshing{RemeshOptions{.size = 1e-6 * height}});
    wait();
    EXPECT_THAT(last_error(), HasSubstr("the size of remeshing is"));
    ASSERT_NE(document.session.part, nullptr);
    EXPECT_EQ(document.session.part->mesh.triangles(), remeshed);
    model.apply(SetRemeshing{});
    wait();
    EXPECT_FALSE(document.session.part->remeshed);
    EXPECT_EQ(document.session.part->mesh.triangles(), given);
    model.apply(Undo{});
    wait();
    EXPECT_EQ(document.session.part->mesh.triangles(), remeshed);
}

TEST_F(SheetOptions, ASeamThatIsNoneIsRefusedAndThePartStays)
{
    open_tube();
    model.apply(SetSeam{{SeamOptions::Mode::given, {}}});
    EXPECT_THAT(last_error(), HasSubstr("needs a path"));
    const auto before = document.session.part->seam;
    model.apply(SetSeam{{SeamOptions::Mode::given, {{0, 999'999}}}});
    wait();
    EXPECT_THAT(last_error(), HasSubstr("999999"));
    ASSERT_NE(document.session.part, nullptr);
    EXPECT_EQ(document.session.part->seam, before);
}

TEST_F(SheetOptions, SkinsAreFieldsOfABlankThatWasMadeWithThem)
{
    open("lipped-channel.obj");
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_FALSE(available(document.session, Field::outer_strain_major));
    EXPECT_THROW(values(document.session, Field::outer_strain_major, true), InputError);
    model.apply(SetSkins{true});
    EXPECT_EQ(first_stale(document), Stage::solve);
    EXPECT_TRUE(saved_and_opened().document.session.options.flatten.skins);
    model.apply(RunTo{Stage::solve});
    wait();
    const SkinStrains& skins = *document.session.blank->skins;
    EXPECT_EQ(values(document.session, Field::outer_strain_major, true), skins.outer.strain_major);
    EXPECT_EQ(values(document.session, Field::outer_strain_minor, true), skins.outer.strain_minor);
    EXPECT_EQ(values(document.session, Field::outer_strain_equivalent, true), skins.outer.strain_equivalent);
    EXPECT_EQ(values(document.session, Field::inner_strain_major, true), skins.inner.strain_major);
    EXPECT_EQ(values(document.session, Field::inner_strain_minor, true), skins.inner.strain_minor);
    EXPECT_EQ(values(document.session, Field::inner_strain_equivalent, true), skins.inner.strain_equivalent);
    EXPECT_EQ(values(document.session, Field::curvature, true), skins.curvature);
    const Eigen::VectorXd smooth = values(document.session, Field::curvature, false);
    EXPECT_EQ(smooth.size(), document.session.part->mesh.vertices());
    EXPECT_GE(smooth.minCoeff(), skins.curvature.minCoeff());
    EXPECT_LE(smooth.maxCoeff(), skins.curvature.maxCoeff());
    for (const FieldInfo& field : all_fields())
        EXPECT_EQ(of_skins(field.field), std::string(field.name).starts_with("outer_") ||
                                             std::string(field.name).starts_with("inner_") ||
                                             field.name == "curvature");
    model.apply(Undo{}); // the run
    model.apply(Undo{});
    EXPECT_FALSE(document.session.options.flatten.skins);
}

TEST_F(SheetOptions, ATensileTestBecomesTheMaterial)
{
    open();
    std::string rows = "true strain, true stress MPa\n"; // Hooke's line, then Hollomon's law over
                                                         // the plastic strain
    for (int k = 1; k <= 20; ++k)
        rows += fmt::format("{:.9g}, {:.9g}\n", 7.5 * k / 200'000, 7.5 * k);
    for (int k = 1; k <= 300; ++k) {
        const double plastic = 0.003 + 0.3 * k / 300, stress = 530 * std::pow(plastic, 0.23);
        rows += fmt::format("{:.9g}, {:.9g}\n", plastic + stress / 200'000, stress);
    }
    const auto table = folder / "bar.csv", out = folder / "mine.json";
    put(table, rows);
    MaterialFitOptions options;
    options.law = "hollomon";
    options.r90 = 1.4;
    model.apply(FitMaterial{table, out, options});
    ASSERT_EQ(last_error(), "");
    EXPECT_EQ(document.material, out.string());
    const Material& material = document.session.options.flatten.material;
    EXPECT_EQ(material.name, "mine");
    EXPECT_EQ(material.r90, 1.4);
    EXPECT_NEAR(std::get<Hollomon>(material.hardening).n, 0.23, 1e-3);
    EXPECT_NEAR(material.young_MPa, 200'000, 200);
    EXPECT_EQ(read_material(out), material);
    model.apply(Undo{});
    EXPECT_EQ(document.material, "mild_steel");

    model.apply(FitMaterial{table, table, options});
    EXPECT_THAT(last_error(), HasSubstr("overwritten"));
    EXPECT_EQ(content_of(table), rows);
    put(folder / "poor.csv", "strain stress MPa\n1 2\n");
    model.apply(FitMaterial{folder / "poor.csv", folder / "poor.json", {}});
    EXPECT_THAT(last_error(), HasSubstr("poor.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "poor.json"));
    EXPECT_EQ(document.material, "mild_steel");
}

} // namespace spia::viewer

#include "engine/report/figures/face_values.h"

#include <gmock/gmock.h>

#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/views.h"
#include "engine/report/figures/figures.h"
#include "engine/report/text/number_text.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/viewer_samples.h"

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace spia::viewer {
namespace {

const Session& solved_dome()
{
    static const Session session = document_of(dome, Stage::fit).session;
    return session;
}

/// A square of 10 x 10 cells with so much thinning of each face, which has no other strains.
Session with_thinning(const Eigen::VectorXd& thinning)
{
    Session session;
    PartFile part;
    part.mesh = shapes::rectangle(100, 100, 10, 10);
    for (int v = 0; v < part.mesh.vertices(); ++v)
        part.source_vertex.push_back(v);
    FlattenResult flat;
    flat.blank.position = part.mesh.position.topRows<2>();
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(part.mesh.triangles());
    flat.face.thinning = thinning;
    flat.face.thickness = 1 - thinning.array();
    for (Eigen::VectorXd* field : {&flat.face.strain_major, &flat.face.strain_minor, &flat.face.strain_equivalent,
                                   &flat.face.stress_major, &flat.face.stress_minor, &flat.face.stress_equivalent})
        *field = nothing;
    flat.face.strain_equivalent = thinning.cwiseAbs();
    flat.node.thinning = Eigen::VectorXd::Zero(part.mesh.vertices());
    Eigen::VectorXi faces = Eigen::VectorXi::Zero(part.mesh.vertices());
    for (int f = 0; f < part.mesh.triangles(); ++f)
        for (const int v : part.mesh.triangle.col(f)) {
            flat.node.thinning[v] += thinning[f];
            ++faces[v];
        }
    flat.node.thinning.array() /= faces.cast<double>().array();
    session.part = std::make_shared<PartFile>(std::move(part));
    session.blank = std::make_shared<FlattenResult>(std::move(flat));
    return session;
}

constexpr int faces_of_square = 200, peak = 77;

/// Nothing but one face, which became a quarter thinner, and its opposite.
Session with_a_peak()
{
    Eigen::VectorXd thinning = Eigen::VectorXd::Zero(faces_of_square);
    thinning[peak] = 0.25;
    thinning[3] = -0.12;
    return with_thinning(thinning);
}

std::vector<std::string> texts(const Scene& scene)
{
    std::vector<std::string> list;
    for (const SceneLabel& label : scene.labels)
        list.push_back(label.text);
    return list;
}

TEST(FaceValues, AreNeverUnderstatedByMeansAtVertices)
{
    const Session& session = solved_dome();
    for (const FieldInfo& field : all_fields()) {
        if (field.field == Field::none || !available(session, field.field))
            continue;
        const auto [least, greatest] = face_values(session, field.field).extremes();
        const Eigen::VectorXd smooth = values(session, field.field, false);
        const double rounding = 1e-12 * (1 + std::abs(least) + std::abs(greatest)) +
                                noise(field.field, part_figures(*session.part).diagonal);
        EXPECT_LE(least, smooth.minCoeff() + rounding) << field.name;
        EXPECT_GE(greatest, smooth.maxCoeff() - rounding) << field.name;
    }
}

TEST(FaceValues, OfTheSheetAreThoseThatLimitsAreHeldAgainst)
{
    const Session& session = solved_dome();
    const FaceValues thinning = face_values(session, Field::thinning);
    double greatest = -1, least = 1;
    for (const double each : session.blank->face.thinning) {
        greatest = std::max(greatest, each);
        least = std::min(least, each);
    }
    EXPECT_DOUBLE_EQ(thinning.extremes()[1], 100 * greatest);
    EXPECT_DOUBLE_EQ(thinning.value[thinning.greatest], 100 * greatest);
    EXPECT_DOUBLE_EQ(sheet_figures(session.blank->face).thinning[1], greatest);
    EXPECT_DOUBLE_EQ(sheet_figures(session.blank->face).thinning[0], least);
}

TEST(FaceValues, TheGreatestDeviationIsThatOfAllSamplesBothWays)
{
    const Session& session = solved_dome();
    const FaceValues deviation = face_values(session, Field::deviation);
    EXPECT_DOUBLE_EQ(deviation.value.cwiseAbs().maxCoeff(), session.surface->deviation.max());
    // The place is one: the face has a corner within its own size of the sample.
    Session raised = session;
    auto surface = std::make_shared<SurfaceStage>(*session.surface);
    const TriMesh& part = session.part->mesh;
    constexpr int face = 40;
    surface->deviation.surface_to_mesh.max = 7;
    surface->deviation.surface_to_mesh.where = part.position(Eigen::all, part.triangle.col(face)).rowwise().mean();
    raised.surface = surface;
    const FaceValues there = face_values(raised, Field::deviation);
    EXPECT_DOUBLE_EQ(std::abs(there.value[face]), 7);
    EXPECT_DOUBLE_EQ(there.value.cwiseAbs().maxCoeff(), 7);
}

TEST(FaceValues, NoiseIsNothingAndHasNoWorstFaces)
{
    Eigen::VectorXd rounding(faces_of_square);
    for (int f = 0; f < faces_of_square; ++f)
        rounding[f] = 1.63e-6 * std::sin(7. * f);
    const Session session = with_thinning(rounding);
    const TriMesh& part = session.part->mesh;
    for (const Field field : {Field::thinning, Field::strain_equivalent, Field::thickness}) {
        const FaceValues values = face_values(session, field);
        EXPECT_THAT(worst_faces(part, values, field, 6), IsEmpty()) << info(field).name;
        if (field != Field::thickness) {
            EXPECT_EQ(values.extremes(), (std::array{0., 0.})) << info(field).name;
        }
    }
    EXPECT_EQ(percent_range(without_noise(sheet_figures(session.blank->face)).thinning), "0 %");
    Session stressed = session;
    auto flat = std::make_shared<FlattenResult>(*session.blank);
    flat->face.stress_major.setConstant(12); // MPa: what the elastic law makes of it
    stressed.blank = flat;
    EXPECT_EQ(face_values(stressed, Field::stress_major).extremes()[1], 0) << "of a sheet that is not strained";
}

TEST(FaceValues, WorstFacesAreOnlyThoseThatAreBad)
{
    const Session session = with_a_peak();
    const TriMesh& part = session.part->mesh;
    EXPECT_THAT(worst_faces(part, face_values(session, Field::thinning), Field::thinning, 6), ElementsAre(peak));
    Eigen::VectorXd thicker = Eigen::VectorXd::Constant(faces_of_square, -0.03);
    thicker[9] = -0.01;
    const Session squeezed = with_thinning(thicker);
    EXPECT_THAT(worst_faces(part, face_values(squeezed, Field::thinning), Field::thinning, 6), IsEmpty())
        << "where the sheet became thicker it is nowhere thin";
}

TEST(FaceValues, LabelsAndLegendOfASmoothContourSayThemAndThatItIsSmoothed)
{
    ViewerState state;
    state.document.session = with_a_peak();
    for (const bool per_face : {false, true}) {
        state.document.display.per_face = per_face;
        SceneCache cache;
        const Scene shown = part_scene(state, cache, 600);
        EXPECT_THAT(texts(shown), testing::IsSupersetOf({"thinnest 0.750 mm (25.0 %)", "thickest 1.120 mm (-12.0 %)"}))
            << per_face;
        ASSERT_TRUE(shown.legend);
        EXPECT_GE(shown.legend->scale.greatest, 25) << per_face;
        EXPECT_EQ(shown.legend->note.find("smoothed") != std::string::npos, !per_face);
    }
}

TEST(FaceValues, ProbesSayTheValueOfTheirFace)
{
    ViewerState state;
    state.document.session = with_a_peak();
    state.document.probes.push_back({peak, {0.9, 0.05, 0.05}});
    SceneCache cache;
    EXPECT_THAT(texts(part_scene(state, cache, 600)), testing::Contains("P1  25.0 %"));
}

TEST(FaceValues, ThickeningIsThinningBelowNothingEverywhere)
{
    EXPECT_EQ(field_by_name("thickening"), Field::thinning);
    EXPECT_THAT(std::string(info(Field::thinning).help), HasSubstr("negative where it became thicker"));
}

TEST(FaceValues, AMarginIsThereOnlyWhereThereIsACurve)
{
    LimitsResult limits;
    EXPECT_FALSE(margin_of(limits, 1));
    limits.zones.distance = Eigen::Vector3d(0.2, std::nan(""), -0.03);
    EXPECT_EQ(margin_of(limits, 2), -0.03);
    EXPECT_FALSE(margin_of(limits, 1));
}

TEST(NumberText, HasNoSignedNothing)
{
    EXPECT_EQ(figure_text(-0.04, 1), "0");
    EXPECT_EQ(figure_text(-0.06, 1), "-0.1");
    EXPECT_EQ(figure_text(0.123, 2, true), "+0.12");
    EXPECT_EQ(plain_number(1381.2), "1381");
    EXPECT_EQ(plain_number(0.01234), "0.0123");
    EXPECT_EQ(percent_range({-0.0001, 0.0002}), "0 %");
    EXPECT_EQ(percent_range({-0.251, 0.236}), "-25.1 to 23.6 %");
    EXPECT_EQ(percent_range({0, 0.012}), "0 to 1.2 %");
}

} // namespace
} // namespace spia::viewer

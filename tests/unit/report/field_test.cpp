#include "engine/report/figures/field.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/run_chain.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

/// A part and a blank of which nothing but the places counts.
Session flattened(const TriMesh& part, const Eigen::Matrix2Xd& blank)
{
    Session session;
    PartFile file;
    file.mesh = part;
    session.part = std::make_shared<PartFile>(file);
    FlattenResult result;
    result.blank.position = blank;
    session.blank = std::make_shared<FlattenResult>(result);
    return session;
}

const Session& solved_dome()
{
    static const Session session = [] {
        Session s;
        s.file = SPIA_SOURCE_DIR "/assets/parts/dome.obj";
        s.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        return completed(run_chain(std::move(s)));
    }();
    return session;
}

} // namespace

TEST(Field, EachIsFoundByItsNameAndSaysWhatItIs)
{
    ASSERT_EQ(all_fields().size(), size_t(Field::deviation) + 1);
    for (const FieldInfo& field : all_fields()) {
        EXPECT_EQ(field_by_name(field.name), field.field);
        EXPECT_EQ(&info(field.field), &field);
        EXPECT_FALSE(field.label.empty());
        EXPECT_TRUE(field.help.ends_with("."));
    }
    EXPECT_THROW(field_by_name("thinnning"), InputError);
}

TEST(Field, WhatTheSessionHasNotIsNotAvailable)
{
    Session session;
    for (const FieldInfo& field : all_fields())
        if (field.field != Field::none) {
            EXPECT_FALSE(available(session, field.field));
            EXPECT_THROW(values(session, field.field, true), InputError);
        }
    session = solved_dome();
    session.surface = nullptr;
    EXPECT_TRUE(available(session, Field::area_change));
    EXPECT_FALSE(available(session, Field::deviation));
    EXPECT_EQ(values(session, Field::none, false).size(), 0);
}

TEST(Field, AreaChangeOfASheetStretchedEvenlyIsTheProductOfItsStretches)
{
    const TriMesh part = shapes::rectangle(30, 20, 6, 4);
    Eigen::Matrix2Xd blank = part.position.topRows<2>();
    blank.row(0) /= 1.2;
    blank.row(1) /= 0.9;
    const Session session = flattened(part, blank);
    for (const bool per_face : {true, false}) {
        const Eigen::VectorXd change = values(session, Field::area_change, per_face);
        ASSERT_EQ(change.size(), per_face ? part.triangles() : part.vertices());
        EXPECT_NEAR(change.minCoeff(), 8, 1e-10); // 1.2 * 0.9 = 1.08
        EXPECT_NEAR(change.maxCoeff(), 8, 1e-10);
    }
}

TEST(Field, AngleDistortionIsTheLargestChangeOfACornerInDegrees)
{
    TriMesh triangle;
    triangle.position.resize(3, 3);
    triangle.position << 0, 1, 0.5, 0, 0, std::sqrt(3) / 2, 0, 0, 0;
    triangle.triangle = Eigen::Vector3i(0, 1, 2);
    Eigen::Matrix2Xd flat(2, 3);
    flat << 0, 1, 0, 0, 0, 1; // 90, 45, 45 degrees against 60 each
    EXPECT_NEAR(values(flattened(triangle, flat), Field::angle_distortion, true)[0], 30, 1e-12);
    flat.row(1) *= -1; // seen from below: the same angles
    EXPECT_NEAR(values(flattened(triangle, flat), Field::angle_distortion, true)[0], 30, 1e-12);
}

TEST(Field, AVertexHasTheMeanOfTheFacesAroundItWeightedByTheirArea)
{
    // The left cell keeps its area, the right one, three times as large, was half as large.
    TriMesh part = shapes::rectangle(2, 1, 2, 1);
    for (int v = 0; v < part.vertices(); ++v)
        if (part.position(0, v) > 1.5)
            part.position(0, v) = 4;
    Eigen::Matrix2Xd blank = part.position.topRows<2>();
    for (int v = 0; v < part.vertices(); ++v)
        if (blank(0, v) > 1.5)
            blank(0, v) = 2.5;
    const Session session = flattened(part, blank);
    const Eigen::VectorXd change = values(session, Field::area_change, false);
    for (int v = 0; v < part.vertices(); ++v) {
        double sum = 0, area = 0;
        for (int f = 0; f < part.triangles(); ++f)
            if ((part.triangle.col(f).array() == v).any()) {
                const bool right = part.position(0, part.triangle.col(f)).maxCoeff() > 1.5;
                sum += right ? 1.5 * 100 : 0;
                area += right ? 1.5 : 0.5;
            }
        EXPECT_NEAR(change[v], sum / area, 1e-10);
    }
}

TEST(Field, OfASolvedPartAgreesWithVolumeConstancyAndKnownUnits)
{
    const Session& session = solved_dome();
    const double sheet = session.options.flatten.thickness;
    for (const bool per_face : {true, false}) {
        const Eigen::ArrayXd thickness = values(session, Field::thickness, per_face);
        const Eigen::ArrayXd thinning = values(session, Field::thinning, per_face);
        EXPECT_GT(thinning.abs().maxCoeff(), 1); // a dome is stretched by some percent
        EXPECT_LT((thinning - 100 * (1 - thickness / sheet)).abs().maxCoeff(), 1e-9);
        for (const FieldInfo& field : all_fields())
            if (field.field != Field::none && !of_skins(field.field)) {
                const Eigen::VectorXd all = values(session, field.field, per_face);
                ASSERT_EQ(all.size(), thickness.size()) << field.name;
                EXPECT_TRUE(all.allFinite()) << field.name;
            }
    }
    // The sheet keeps its volume: where the area grows the thickness shrinks, and both strains add
    // up.
    const Eigen::ArrayXd ratio = 1 - values(session, Field::thinning, true).array() / 100;
    const Eigen::ArrayXd change = values(session, Field::area_change, true).array() / 100;
    EXPECT_LT(((1 + change) * ratio - 1).abs().maxCoeff(), 1e-6);
    const Eigen::ArrayXd both =
        values(session, Field::strain_major, true).array() + values(session, Field::strain_minor, true).array();
    EXPECT_LT((both - (1 + change).log()).abs().maxCoeff(), 1e-6);
    EXPECT_GE((values(session, Field::strain_major, true) - values(session, Field::strain_minor, true)).minCoeff(), 0);
}

TEST(Field, DeviationOfAFaceIsThatOfItsFarthestCorner)
{
    const Session& session = solved_dome();
    const TriMesh& part = session.part->mesh;
    const Eigen::VectorXd at_vertex = values(session, Field::deviation, false);
    const Eigen::VectorXd of_face = values(session, Field::deviation, true);
    EXPECT_LE(at_vertex.cwiseAbs().maxCoeff(), session.surface->deviation.mesh_to_surface.max + 1e-15);
    for (int f = 0; f < part.triangles(); ++f) {
        const auto t = part.triangle.col(f);
        EXPECT_EQ(std::abs(of_face[f]), at_vertex(t).cwiseAbs().maxCoeff());
        EXPECT_TRUE((at_vertex(t).array() == of_face[f]).any()) << "with its sign";
    }
}

} // namespace spia

#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"
#include "tests/unit/unfold/step_fixture.h"

namespace spia {

using namespace steps;

TEST(UnfoldStep, TailoredPiecesKeepTheirGaugeAndTheRollingDirectionItsWay)
{
    const shapes::HatChannel shape{.triangles = 2000};
    const shapes::DevelopablePart hat = shapes::hat_channel(shape);
    const double middle = (hat.flat.row(0).minCoeff() + hat.flat.row(0).maxCoeff()) / 2;
    const auto is_top = [&](const Eigen::VectorXd& at) { return std::abs(at[0] - middle) < shape.top / 2; };
    const std::vector<int> top = faces_where(hat.flat, hat.mesh, is_top),
                           rest =
                               faces_where(hat.flat, hat.mesh, [&](const Eigen::VectorXd&at) { return !is_top(at); }),
                           thick =
                               faces_where(hat.flat, hat.mesh, [&](const Eigen::VectorXd&at) { return at[1] < 90; });
    FlattenOptions options = steel();
    options.process.tailored.push_back({"thick", thick, options.material, 1.5});
    const UnfoldStepResult tailored = unfold_step(hat.mesh, hat.mesh.position, {top, rest}, options);
    ASSERT_EQ(tailored.piece.size(), 2u);
    for (size_t k = 0; k < rest.size(); ++k) {
        const bool in = std::binary_search(thick.begin(), thick.end(), rest[k]);
        EXPECT_NEAR(tailored.face.thickness[Eigen::Index(k)], in ? 1.5 : 0.8, 1e-6);
    }
    // Planar anisotropy: the rim of a cup's wall has its waves along and across the rolling
    // direction, wherever the cup stands.
    const shapes::SharpCup form{.triangles = 3000};
    const shapes::AxisymmetricPart cup = shapes::sharp_cup(form);
    const auto mean_along = [&](const Eigen::Vector3d& way, const Eigen::MatrixXd& laid) {
        double sum = 0, count = 0;
        for (const int v : cup.rim)
            if (std::abs(cup.mesh.position.col(v).head<2>().normalized().dot(way.head<2>())) > 0.97) {
                sum += (laid.col(v) - laid.col(0)).norm();
                ++count;
            }
        return sum / count;
    };
    FlattenOptions ears = steel();
    ears.material.r0 = 1;
    ears.material.r45 = 1.6;
    ears.material.r90 = 2.9;
    const auto radius_along = [&](const Eigen::Vector3d& rolling, const Eigen::Vector3d& way) {
        const Eigen::Matrix3d turn = shapes::random_rotation(6);
        ears.process.rolling = turn * rolling;
        const TriMesh there = shapes::transformed(cup.mesh, turn, {1, 2, 3});
        UnfoldPick pick{faces_where(cup.arc_length.transpose(), cup.mesh,
                                    [&](const Eigen::VectorXd& s) { return s[0] < form.radius; }),
                        faces_where(cup.arc_length.transpose(), cup.mesh,
                                    [&](const Eigen::VectorXd& s) { return s[0] > form.radius; })};
        const Eigen::Matrix3d askew = turn * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        pick.target = PlaneFace{there.position.col(0), askew.leftCols<2>()};
        const UnfoldStepResult result = unfold_step(there, there.position, pick, ears);
        return mean_along(way, result.position);
    };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
    const double along = radius_along(x, x), across = radius_along(x, y);
    // The whole cup in one hit has the same waves.
    ears.process.rolling = x;
    ears.direction = Eigen::Vector3d::UnitZ();
    const Eigen::Matrix2Xd blank = flatten(cup.mesh, ears).blank.position;
    EXPECT_NEAR(mean_along(x, blank) - mean_along(y, blank), along - across, 0.1 * std::abs(along - across));
    EXPECT_GT(std::abs(along - across), 0.2); // mm
    // the mesh is no quarter
    EXPECT_NEAR(radius_along(y, y), along, 0.25 * std::abs(along - across));
    // the mesh is no quarter
    EXPECT_NEAR(radius_along(y, x), across, 0.25 * std::abs(along - across));
}

} // namespace spia

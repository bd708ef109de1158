// The five cases of an independent one-dimensional code (principle of virtual work along the
// meridian, 8001 nodes).
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/forming/flatten.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"

namespace spia {
namespace {

const std::filesystem::path folder = SPIA_SOURCE_DIR "/../shared/reference/axisymmetric";

/// Columns of the reference, by arc length along the meridian.
struct Reference {
    std::vector<double> s, thickness, blank_radius;
    double edge_radius, sheet_thickness;

    double at(const std::vector<double>& column, double where) const
    {
        const size_t i =
            std::clamp<size_t>(size_t(std::upper_bound(s.begin(), s.end(), where) - s.begin()), 1, s.size() - 1);
        const double t = (where - s[i - 1]) / (s[i] - s[i - 1]);
        return column[i - 1] + t * (column[i] - column[i - 1]);
    }
};

struct Case {
    Reference reference;
    FlattenOptions options;
    double binder_radius = 0, binder_traction = 0;
    Eigen::Matrix2Xd meridian;
};

Case read_case(const std::string& name)
{
    Case c;
    std::ifstream summary(folder / "summary.json");
    const auto json = nlohmann::json::parse(summary).at(name);
    const auto& m = json.at("material");
    const double r = m.at("r");
    c.options.material = {name, m.at("E"), 0.3, 7850, Swift{m.at("K"), m.at("e0"), m.at("n")}, r, r, r, ""};
    c.options.thickness = c.reference.sheet_thickness = m.at("h0");
    c.reference.edge_radius = json.at("blank_edge_radius_mm");
    if (!json.at("binder").is_null()) {
        c.binder_radius = json.at("binder").at("inner_radius_mm");
        c.binder_traction = json.at("binder").at("friction_traction_MPa");
    }
    std::ifstream csv(folder / (name + ".csv"));
    std::string line;
    std::getline(csv, line); // s, r, z, blank radius, strains, thickness, ...
    while (std::getline(csv, line)) {
        std::vector<double> value;
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            value.push_back(std::stod(cell));
        c.reference.s.push_back(value[0]);
        c.reference.blank_radius.push_back(value[3]);
        c.reference.thickness.push_back(value[6]);
    }
    c.meridian = shapes::read_meridian(folder / (name + ".meridian.csv"));
    return c;
}

struct Errors {
    double h;           ///< mm, mean edge
    double edge_radius; ///< relative
    double thinning;    ///< largest, away from the axis
    bool converged;
};

Errors solve(const Case& c, int triangles)
{
    const shapes::AxisymmetricPart part = shapes::axisymmetric(c.meridian, triangles);
    FlattenOptions options = c.options;
    if (c.binder_traction > 0) {
        constexpr double coefficient = 0.1;
        ContactRegion binder{"binder", {}, c.binder_traction / (2 * coefficient), {}, coefficient, 2};
        for (int f = 0; f < part.mesh.triangles(); ++f) {
            Eigen::Vector3d centre = Eigen::Vector3d::Zero();
            for (int a = 0; a < 3; ++a)
                centre += part.mesh.position.col(part.mesh.triangle(a, f)) / 3;
            if (centre.head<2>().norm() > c.binder_radius)
                binder.faces.push_back(f);
        }
        options.process.contact = {binder};
    }
    const FlattenResult result = flatten(part.mesh, options);
    Errors errors{shapes::mean_edge(part.mesh), 0, 0, result.report.converged};
    EXPECT_EQ(result.flipped_triangles, 0);
    EXPECT_LT(result.volume_error, 1e-11);
    const Eigen::Vector2d pole = result.blank.position.col(0);
    double radius = 0;
    for (int v : part.rim)
        radius += (result.blank.position.col(v) - pole).norm() / double(part.rim.size());
    errors.edge_radius = std::abs(radius / c.reference.edge_radius - 1);
    const double total = part.arc_length.maxCoeff(), near_axis = 0.1 * total;
    for (int v = 0; v < part.mesh.vertices(); ++v)
        if (const double s = part.arc_length[v]; s > near_axis && s < total - 2 * errors.h)
            errors.thinning = std::max(errors.thinning,
                                       std::abs(result.node.thickness[v] - c.reference.at(c.reference.thickness, s)) /
                                           c.reference.sheet_thickness);
    return errors;
}

class Axisymmetric : public testing::TestWithParam<const char*> {};

} // namespace

TEST_P(Axisymmetric, ConvergesToTheOneDimensionalReference)
{
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the reference solutions are not here: " << folder;
    const Case c = read_case(GetParam());
    std::vector<double> h, error;
    for (int triangles : {2500, 10000, 40000}) {
        const Errors e = solve(c, triangles);
        ASSERT_TRUE(e.converged) << triangles;
        h.push_back(e.h);
        error.push_back(e.edge_radius);
        std::printf("%s %d: h %.3f  radius %.2e  thinning %.4f\n", GetParam(), triangles, e.h, e.edge_radius,
                    e.thinning);
        if (triangles == 40000) {
            EXPECT_LT(e.edge_radius, 2e-4);
            EXPECT_LT(e.thinning, 0.005);
        }
    }
    EXPECT_GT(shapes::convergence_order(h, error), 1.6); // 2 in the limit; the coarse cup has four
                                                         // edges in a radius
}

INSTANTIATE_TEST_SUITE_P(Reference, Axisymmetric,
                         testing::Values("dome_flange_isotropic", "dome_flange_r177", "flat_cup_r177",
                                         "cone_cup_aluminium", "cone_cup_binder_friction"),
                         [](const auto& test) { return std::string(test.param); });

} // namespace spia
